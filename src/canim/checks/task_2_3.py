"""Task 2.3: what "done" means for a morph: the points in between, two warps and the blend.

To see one of the two warps alone, the other image is black; to see the blend alone, both
images are of one colour.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.spatial import Delaunay

from canim import warping
from canim.checks.picture import IMAGES
from canim.checks.run import number
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task
from canim.checks.warps import describe, nothing, numbered

HALF = 0.5 + 1e-6  # the most that rounding changes a colour


def _between(points_a: Floats, points_b: Floats, t: float) -> Floats:
    points: Floats = (1 - t) * points_a + t * points_b
    return points


def _blended(a: Floats, b: Floats, t: float) -> Floats:
    blend: Floats = (1 - t) * a + t * b
    return blend


def morphed(
    image_a: Any,
    image_b: Any,
    points_a: Floats,
    points_b: Floats,
    triangles: Any,
    t: float,
    *,
    between: Callable[[Floats, Floats, float], Floats] = _between,
    ends: Callable[[Floats, Floats, Floats], tuple[Floats, ...]] = lambda a, b, p: (a, p, b, p),
    kind: type = float,
    keep: Callable[[Any], Any] = np.asarray,
    blend: Callable[[Floats, Floats, float], Floats] = _blended,
) -> Floats:
    """Return the morph with decimals, right or in one of the ways in which it goes wrong.

    `ends` says from which points to which A is warped, and then B.
    """
    points = between(points_a, points_b, t)
    from_a, to_a, from_b, to_b = ends(points_a, points_b, points)
    a, b = image_a.astype(kind), image_b.astype(kind)
    warped_a = keep(warping.warp_backward(a, from_a, to_a, triangles)).astype(float)
    warped_b = keep(warping.warp_backward(b, from_b, to_b, triangles)).astype(float)
    return blend(warped_a, warped_b, t)


def _morph(program: Any, *args: Any) -> Floats:
    """Return the student's image; colours that only rounding makes different are the same."""
    got: Floats = program.morph(*args)
    expected = morphed(*args)
    near: Any = np.abs(got - expected) <= HALF
    result: Floats = np.where(near, expected, got)
    return result


def _in_words(colour: Floats) -> str:
    return f"the colour ({', '.join(map(number, colour))})"


def _describe(got: Floats, expected: Floats, *args: Any) -> str:
    return f"t = {args[-1]:g}, {describe(got, expected, *args, in_words=_in_words)}"


def _coordinate(index: tuple[int, ...], *args: Any) -> str:
    return f"{'xy'[index[1]]} of point {index[0]}"


def _points() -> tuple[Floats, Floats, Any]:
    """Return the toy pair's points, scaled, with the frame; made from A, a triangle folds."""
    a, b = (19 / 255 * np.array(points) for points in (_A, _B))
    frame = warping.add_frame_points([], (20, 20))
    a, b = np.vstack([a, frame]), np.vstack([b, frame])
    return a, b, warping.triangulate(a, b)


_A = [(78.3, 73.1), (78.7, 186.2), (147.4, 186.9)]
_B = [(120.2, 25.3), (157.1, 139.6), (218.8, 47.2)]
POINTS_A, POINTS_B, TRIANGLES = _points()
IMAGE: Any = numbered(20, 20) + np.uint8(40)
TURNED: Any = IMAGE[:, ::-1].copy()
BLACK: Any = np.zeros_like(IMAGE)
MESH = (POINTS_A, POINTS_B, TRIANGLES)


def _plain(grey: int) -> Any:
    return np.full((20, 20, 3), grey, dtype=np.uint8)


DIM, BRIGHT = _plain(101), _plain(202)


def _byte_blend(a: Floats, b: Floats, t: float) -> Floats:
    """Blend with a difference of bytes, which cannot be negative."""
    return a + t * ((b - a) % 256)


def _changed(**change: Any) -> dict[str, Any]:
    return {"morph": lambda *args: np.round(morphed(*args, **change))}


def _cut_off(*args: Any) -> Floats:
    return np.floor(morphed(*args))


def _triangles_of_a(*args: Any) -> Floats:
    image_a, image_b, points_a, points_b, _, t = args
    return morphed(image_a, image_b, points_a, points_b, Delaunay(points_a).simplices, t)


BETWEEN, WARP_A, WARP_B, BLEND = "points in between", "warp of A", "warp of B", "blend"
WARPS = (WARP_A, WARP_B)

TASK = Task(
    id="2.3",
    name="incremental_warp_backward",
    title="Turn one face into another",
    block="warping",
    writes="points in between, two warps and a blend, about 6 lines",
    minutes=40,
    figure="Figs. 9 and 10",
    questions=3,
    builds_on=("2.1", "2.2"),
    functions=(
        Function(
            "points_between",
            "points_between(points_a, points_b, t)",
            Array(lambda points_a, *_: points_a.shape, "one row per point, with x and y"),
            _between,
        ),
        Function(
            "morph",
            "morph(image_a, image_b, points_a, points_b, triangles, t)",
            Array(lambda image_a, *_: image_a.shape, "an image as large as those it is given"),
            morphed,
        ),
    ),
    parts=(
        Part(
            BETWEEN,
            lambda program, *args: program.points_between(*args),
            tuple(Case((POINTS_A, POINTS_B, t), f"t = {t:g}") for t in (0.25, 0.0, 0.7, 1.0)),
            _coordinate,
        ),
        Part(
            WARP_A,
            _morph,
            tuple(Case((IMAGE, BLACK, *MESH, t)) for t in (0.25, 0.7, 0.0)),
            unwritten=nothing,
            describe=_describe,
            picture=IMAGES,
        ),
        Part(
            WARP_B,
            _morph,
            tuple(Case((BLACK, TURNED, *MESH, t)) for t in (0.25, 0.7, 1.0)),
            unwritten=nothing,
            describe=_describe,
            picture=IMAGES,
        ),
        Part(
            BLEND,
            _morph,
            (Case((DIM, BRIGHT, *MESH, 0.3)), Case((BRIGHT, DIM, *MESH, 0.3))),
            unwritten=nothing,
            describe=_describe,
            picture=IMAGES,
        ),
    ),
    lines={
        "points in between": "return the points on the straight way from points_a to points_b",
        "warp of A": "two warps: A from its points to these, B from its points to these",
        "warp of B": "two warps: A from its points to these, B from its points to these",
        "blend": "blend: 1 - t of A and t of B, with decimals",
    },
    mistakes=(
        Mistake(
            "points from B to A",
            "At t = 0 the points must be those of A. Which are they here?",
            {"points_between": lambda a, b, t: _between(b, a, t)},
            parts=(BETWEEN,),
            source="study: variable",
        ),
        Mistake(
            "always half way",
            "The points are half way at every moment. Where does t come in?",
            {"points_between": lambda a, b, t: (a + b) / 2},
            parts=(BETWEEN,),
            source="study: variable",
        ),
        Mistake(
            "only the way",
            "This is only a part of the way from A to B. From where does it start?",
            {"points_between": lambda a, b, t: t * (b - a)},
            parts=(BETWEEN,),
            source="study: computation",
        ),
        Mistake(
            "points rounded",
            "Points may lie between the pixels: do not round them.",
            {"points_between": lambda a, b, t: np.round(_between(a, b, t))},
            parts=(BETWEEN,),
            source="trial",
        ),
        Mistake(
            "no shares",
            "The two images are added in full. How large is the share of each?",
            _changed(blend=lambda a, b, t: (a + b) % 256),
            source="trial",
            line="blend: 1 - t of A and t of B, with decimals",
        ),
        Mistake(
            "shares exchanged",
            "The film runs backward in its colours: how large is the share of A at t = 0?",
            _changed(blend=lambda a, b, t: _blended(b, a, t)),
            source="study: variable",
            line="blend: 1 - t of A and t of B, with decimals",
        ),
        Mistake(
            "same map for both",
            "Both images are warped with the same map. From which points does B start?",
            _changed(ends=lambda a, b, p: (a, p, a, p)),
            source="study: variable",
            line="two warps: A from its points to these, B from its points to these",
        ),
        Mistake(
            "images start from each other's points",
            "A starts from the points of B, and B from those of A.",
            _changed(ends=lambda a, b, p: (b, p, a, p)),
            source="study: variable",
            line="two warps: A from its points to these, B from its points to these",
        ),
        Mistake(
            "not warped",
            "This is a cross-fade: the images are blended, but not warped.",
            _changed(ends=lambda a, b, p: (a, a, b, b)),
            source="study: concept",
            line="two warps: A from its points to these, B from its points to these",
        ),
        Mistake(
            "warped to the end",
            "The images are warped the whole way, not to the points in between.",
            _changed(ends=lambda a, b, p: (a, b, b, a)),
            source="neighbour: Task 2.2 warps the whole way",
            line="two warps: A from its points to these, B from its points to these",
        ),
        Mistake(
            "source and target exchanged",
            "Which points come first in warp_backward, those before or those after?",
            _changed(ends=lambda a, b, p: (p, a, p, b)),
            source="study: function",
            line="two warps: A from its points to these, B from its points to these",
        ),
        Mistake(
            "always the points half way",
            "The form is the same at every moment. Which t does points_between get?",
            _changed(between=lambda a, b, t: (a + b) / 2),
            source="study: variable",
            line="points in between: at the moment t",
        ),
        Mistake(
            "always half and half",
            "Both shares are one half at every moment. Where does t come in?",
            _changed(blend=lambda a, b, t: (a + b) / 2),
            source="study: variable",
            line="blend: 1 - t of A and t of B, with decimals",
        ),
        Mistake(
            "triangles of A",
            "Use the triangles that are given. Others turn over on the way.",
            {"morph": _triangles_of_a},
            parts=WARPS,
            source="matlab: triangles of the source points turn over",
            line="two warps: A from its points to these, B from its points to these",
        ),
        Mistake(
            "warped images rounded",
            "The images are rounded before they are blended. Round only once, at the end.",
            _changed(keep=np.round),
            source="matlab: rounds each image before adding",
            line="return the blend, rounded once",
        ),
        Mistake(
            "shares rounded",
            "Each share is rounded before the two are added. Round only once, at the end.",
            _changed(blend=lambda a, b, t: np.round((1 - t) * a) + np.round(t * b)),
            source="matlab: rounds each image before adding",
            line="return the blend, rounded once",
        ),
        Mistake(
            "decimals cut off",
            "Colours are cut off, not rounded, at the end.",
            {"morph": _cut_off},
            source="thread: astype(int) truncates and doesn't round, numpy-discussion, 2011",
            line="return the blend, rounded once",
        ),
        Mistake(
            "difference of bytes",
            "A difference of two colours cannot be negative here. Use the images with decimals.",
            _changed(kind=np.uint8, blend=_byte_blend),
            source="thread: stackoverflow.com/q/26678132",
            line="blend: 1 - t of A and t of B, with decimals",
        ),
    ),
    canim_functions=(warping.morph, warping.morph_frames),
)
