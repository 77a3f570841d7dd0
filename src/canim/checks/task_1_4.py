"""Task 1.4: what "done" means for a curve that the student chooses, samples and rebuilds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.crash import Crash
from canim.checks.picture import GRAPH
from canim.checks.program import Stopped
from canim.checks.run import number
from canim.checks.task import Array, Case, Data, Floats, Function, Mistake, Part, Task, Unusable

Curve = Callable[[Any], Any]


def _hill(x: Any) -> Any:
    return 1 / (1 + x**2)


def _wave(x: Any) -> Any:
    return np.cos(x) + x / 2


PAGES_NODES = np.array([1.0, 2.0, 3.0])
OTHER_NODES = np.array([0.0, 2.0, -1.5, 1.0, 4.0])  # in no order, and more than three


def _accept_height(result: Any, x: Any) -> Any:
    return _HEIGHTS(result, x)[()]


_HEIGHTS = Array(lambda x: np.shape(x), "one number per x")


def _accept_nodes(value: Any) -> Floats:
    try:
        nodes = np.asarray(value)
        if nodes.dtype.kind not in "biuf":
            raise ValueError
    except ValueError:
        raise Unusable("must be a list of numbers.") from None
    if nodes.ndim != 1:
        raise Unusable(f"must be one list of numbers, but has shape {nodes.shape}.")
    if len(nodes) < 3:
        raise Unusable(f"must hold at least three places, but holds {len(nodes)}.")
    nodes = nodes.astype(float)
    if np.isinf(nodes).any():
        raise Unusable("holds a place that is infinite.")
    known, times = np.unique(nodes[~np.isnan(nodes)], return_counts=True)
    if (times > 1).any():
        twice = known[times > 1][0]
        raise Unusable(f"holds {twice:g} more than once: no two samples may share a place.")
    return nodes


def _sample(f: Curve, nodes: Floats) -> Floats:
    """Return the heights of `f` at the nodes, whether or not it takes whole arrays."""
    try:
        return np.array([f(node) for node in nodes], dtype=float)
    except Stopped as one_by_one:
        if not isinstance(one_by_one.problem, Crash):
            raise
        try:
            return np.asarray(f(nodes), dtype=float)
        except Stopped:
            raise one_by_one from None


def _own_nodes(program: Any) -> Floats | None:
    """Return the student's nodes once all are chosen."""
    nodes = program.nodes
    return None if np.isnan(nodes).any() else nodes


def _f(program: Any) -> Floats:
    try:
        nodes = _own_nodes(program)
    except Stopped:
        nodes = None  # told where the nodes are judged
    if nodes is None:
        return _sample(program.f, PAGES_NODES)
    heights = _sample(program.f, nodes)
    if np.isfinite(heights).all():
        return heights
    if np.isnan(heights).all() and np.isnan(_sample(program.f, PAGES_NODES)).all():
        return heights
    worst = int(np.flatnonzero(~np.isfinite(heights))[0])
    raise Stopped(
        "f",
        f"f is {heights[worst]:g} at your node {nodes[worst]:g}: it has no height there. "
        "Choose another node or another f.",
    )


def _own(program: Any) -> tuple[Curve, Floats] | None:
    """Return the student's curve and nodes once both are chosen."""
    nodes = _own_nodes(program)
    if nodes is None or np.isnan(_f(program)).any():
        return None
    return program.f, nodes


def _samples(program: Any, *given: Any) -> Any:
    chosen = given or _own(program)
    return program.sample(*chosen) if chosen else np.empty(0)


def _curve(program: Any, *given: Any) -> Any:
    """Return rows of a place and the height of L there; no row while nothing is known."""
    if not given:
        own = _own(program)
        given = (*own, _places(own[1])) if own else ()
    if not given:
        return np.empty((0, 2))
    f, nodes, x = given
    try:
        return np.column_stack([x, program.interpolate(f, nodes, x)])
    except Stopped:
        # L cannot be made of samples that are not written yet: no mistake.
        if np.isnan(program.sample(f, nodes)).all():
            return np.column_stack([x, np.nan * x])
        raise


def _places(nodes: Floats) -> Floats:
    """Return the nodes and places between them."""
    return np.sort(np.concatenate([nodes, np.linspace(nodes.min(), nodes.max(), 12)]))


def _at_node(index: tuple[int, ...], *given: Any) -> str:
    return f"at nodes[{index[0]}]"


def _nothing_yet(got: Floats) -> bool:
    return bool(np.isnan(got).all())


def _no_height_yet(got: Floats) -> bool:
    return bool(np.isnan(got[:, 1]).all())


def _at_x(got: Floats, expected: Floats, *given: Any) -> str:
    """Return where the two differ most: the places come with the heights."""
    error = np.nan_to_num(np.abs(got - expected)[:, 1], nan=np.inf)
    (x, right), height = expected[error.argmax()], got[error.argmax(), 1]
    label = {_hill: HILL, _wave: WAVE}[given[0]] if given else OWN.label
    return f"{label}, at x = {x:.3g}: expected {number(right)}, got {number(height)}"


OWN = Case((), "your f and nodes")
HILL = "f(x) = 1/(1 + x**2) at 1, 2, 3"
WAVE = "f(x) = cos(x) + x/2 at 0, 2, -1.5, 1, 4"


def _interpolate(f: Curve, nodes: Floats, x: Floats) -> Floats:
    return interpolation.lagrange_interpolate(nodes, _sample(f, nodes), x)


def _places_as_values(f: Curve, nodes: Floats) -> Any:
    return nodes


def _straight_through_places(f: Curve, nodes: Floats, x: Floats) -> Any:
    return x


def _at_numbers(f: Curve, nodes: Floats) -> Any:
    return _sample(f, np.arange(len(nodes), dtype=float))


def _through_samples_at_numbers(f: Curve, nodes: Floats, x: Floats) -> Any:
    values = _at_numbers(f, nodes)
    if not np.isfinite(values).all():
        return np.full(len(x), np.nan)
    return interpolation.lagrange_interpolate(nodes, values, x)


def _first_three(f: Curve, nodes: Floats) -> Any:
    return np.append(_sample(f, nodes[:3]), np.full(len(nodes) - 3, np.nan))


def _through_first_three(f: Curve, nodes: Floats, x: Floats) -> Any:
    return _interpolate(f, nodes[:3], x)


def _exchanged(f: Curve, nodes: Floats, x: Floats) -> Any:
    return interpolation.lagrange_interpolate(_sample(f, nodes), nodes, x)


def _straight_pieces(f: Curve, nodes: Floats, x: Floats) -> Any:
    order = np.argsort(nodes)
    return np.interp(x, nodes[order], _sample(f, nodes)[order])


def _f_itself(f: Curve, nodes: Floats, x: Floats) -> Any:
    return _sample(f, x)


TASK = Task(
    id="1.4",
    name="lagrange_from_sampled_function",
    title="Rebuild a curve from samples",
    block="interpolation",
    writes="a curve of your choice, its nodes, its samples and L, about 5 lines",
    minutes=25,
    figure="Fig. 2b",
    questions=3,
    builds_on=("1.3",),
    functions=(
        Function("f", "f(x)", _accept_height),
        Function(
            "sample",
            "sample(f, nodes)",
            Array(lambda f, nodes: (len(nodes),), "one number per node"),
            _sample,
        ),
        Function(
            "interpolate",
            "interpolate(f, nodes, x)",
            Array(lambda f, nodes, x: (len(x),), "one number per x"),
            _interpolate,
        ),
    ),
    data=(Data("nodes", _accept_nodes),),
    parts=(
        Part("f, your curve", _f),
        Part(
            "nodes, three or more",
            lambda program: program.nodes,
            unwritten=lambda nodes: bool(np.isnan(nodes).any()),
        ),
        Part(
            "values, the samples",
            _samples,
            (
                OWN,
                Case((_hill, PAGES_NODES), HILL),
                Case((_wave, OTHER_NODES), WAVE),
            ),
            _at_node,
            unwritten=_nothing_yet,
        ),
        Part(
            "L, the rebuilt curve",
            _curve,
            (
                OWN,
                Case((_hill, PAGES_NODES, _places(PAGES_NODES)), HILL),
                Case((_wave, OTHER_NODES, _places(OTHER_NODES)), WAVE),
            ),
            unwritten=_no_height_yet,
            describe=_at_x,
            picture=GRAPH,
        ),
    ),
    lines={
        "f, your curve": "return the height of your curve",
        "nodes, three or more": "nodes: three places or more",
        "values, the samples": "value k = f at node k",
        "L, the rebuilt curve": "L = the Lagrange curve through these",
    },
    mistakes=(
        Mistake(
            "places as values",
            "Your samples are the nodes themselves. What turns a place into a height?",
            {"sample": _places_as_values, "interpolate": _straight_through_places},
            source="study: variable",
        ),
        Mistake(
            "sampled at 0, 1, 2",
            "You sample at 0, 1, 2 and so on. Where are the places to sample at?",
            {"sample": _at_numbers, "interpolate": _through_samples_at_numbers},
            source="study: array",
        ),
        Mistake(
            "first three nodes only",
            "The nodes after the third are left out. How many nodes are there?",
            {"sample": _first_three, "interpolate": _through_first_three},
            source="matlab: written for a fixed number of points",
            line="for every node k:",
        ),
        Mistake(
            "nodes and values exchanged",
            "Look at the order of what you hand to lagrange_interpolate.",
            {"interpolate": _exchanged},
            source="study: function",
        ),
        Mistake(
            "straight pieces",
            "Your curve is a chain of straight pieces. Which curve did Task 1.3 make?",
            {"interpolate": _straight_pieces},
            source="neighbour: np.interp, as in Task 1.9",
        ),
        Mistake(
            "f itself",
            "This is f itself. L may only use the samples.",
            {"interpolate": _f_itself},
            source="study: concept",
        ),
    ),
)
