"""Time blendshapes against NumPy's einsum and against reading the shapes once."""

from __future__ import annotations

from tempfile import TemporaryDirectory

import numpy as np
from timing import Row, compare, typical

from canim.character import delta_blendshape, global_blendshape, load_expressions
from canim.data import face, save_expressions

SHAPES, VERTICES, FRAMES = 50, 100_000, 64


def agreement() -> None:
    """Hold global and delta blendshapes against each other, in double precision."""
    head = face()
    weights = np.random.default_rng(0).dirichlet(np.ones(1 + len(head.shapes)))
    whole = global_blendshape(np.concatenate([head.neutral[None], head.shapes]), weights)
    deltas = delta_blendshape(head.neutral, head.shapes, weights[1:])
    assert np.abs(whole - deltas).max() <= 1e-12 * np.abs(head.neutral).max()


def mixing() -> list[Row]:
    rng = np.random.default_rng(1)
    shapes = rng.normal(size=(SHAPES, VERTICES, 3)).astype(np.float32)
    weights = rng.dirichlet(np.ones(SHAPES), FRAMES)
    single = weights.astype(np.float32)
    neutral, numbers = shapes[0].copy(), shapes.ravel()
    for ours, exact in (
        (global_blendshape(shapes, weights[0]), np.einsum("k,kvc->vc", weights[0], shapes)),
        (
            delta_blendshape(neutral, shapes, weights[0] + 1),
            neutral + np.einsum("k,kvc->vc", weights[0] + 1, shapes - neutral),
        ),
    ):
        assert ours.dtype == np.float32
        assert np.abs(ours - exact).max() <= 1e-4

    def one() -> object:
        return global_blendshape(shapes, weights[0])

    def all_frames() -> object:
        return global_blendshape(shapes, weights)

    what = f"{SHAPES} shapes × 1e5 vertices in float32"
    film = f"`global_blendshape`, {FRAMES} frames at once"
    return [
        compare(
            f"`global_blendshape`, {what}",
            one,
            {"reading the shapes once": lambda: np.vdot(numbers, numbers)},
            0.8,
            repeats=25,
        ),
        compare(
            "the same",
            one,
            {"`einsum`": lambda: np.einsum("k,kvc->vc", weights[0], shapes)},
            3,
        ),
        compare(
            "the same",
            one,
            {"`einsum`, weights in float32": lambda: np.einsum("k,kvc->vc", single[0], shapes)},
        ),
        compare(
            f"`delta_blendshape`, {what}",
            lambda: delta_blendshape(neutral, shapes, weights[0]),
            {
                "`einsum` of the differences": lambda: (
                    neutral + np.einsum("k,kvc->vc", weights[0], shapes - neutral)
                )
            },
            3,
        ),
        compare(
            film,
            all_frames,
            {"`einsum`": lambda: np.einsum("fk,kvc->fvc", weights, shapes)},
            10,
            repeats=3,
        ),
        compare(
            film,
            all_frames,
            {"`einsum`, weights in float32": lambda: np.einsum("fk,kvc->fvc", single, shapes)},
            repeats=3,
        ),
    ]


def loading() -> Row:
    with TemporaryDirectory() as folder:
        save_expressions(folder)
        seconds = typical({"canim": lambda: load_expressions(folder)}, repeats=5)["canim"]
    return Row("`load_expressions`, 25 OBJ files", seconds, 0.5, "limit", 1)


def rows() -> list[Row]:
    agreement()
    return [*mixing(), loading()]
