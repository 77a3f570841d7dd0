"""Task 1.7: what "done" means for the cubic Bézier curve."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import PATH
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task

T = np.linspace(0, 1, 11)
PAPER = np.array([[5.0, -10.0], [9.0, 38.0], [38.0, -5.0], [45.0, 15.0]])
LOOP = np.array([[0.0, 0.0], [6.0, 5.0], [-4.0, 6.0], [2.0, -1.0]])
NEVER_HALF = np.array([0.0, 0.2, 0.45, 0.8, 1.0])


def _pull(k: int) -> Part:
    """Return the part that moves control point `k` by (1, 1): the curve follows its weight."""
    cases = (Case((LOOP, T)), Case((LOOP, NEVER_HALF)))

    def measure(program: Any, P: Floats, t: Floats) -> Floats:
        return _change(program, k, P, t)

    def place(index: tuple[int, ...], P: Floats, t: Floats) -> str:
        return f"weight at t = {t[index[0]]:.3g}"

    return Part(f"pull of P{k}", measure, cases, place, unwritten=_nothing)


def _change(program: Any, k: int, P: Floats, t: Floats) -> Floats:
    moved = P.copy()
    moved[k] += 1
    change: Floats = program.cubic_bezier(moved, t) - program.cubic_bezier(P, t)
    return change


def _nothing(got: Floats) -> bool:
    return bool((np.isnan(got) | (got == 0)).all())


def _curve(program: Any, P: Floats, t: Floats) -> Floats:
    """Return the curve, or nan while some of its pulls are written and some are missing."""
    points: Floats = program.cubic_bezier(P, t)
    missing = [_nothing(_change(program, k, P, t)) for k in range(4)]
    return np.full_like(points, np.nan) if 0 < sum(missing) < 4 else points


def _coordinate(index: tuple[int, ...], P: Floats, t: Floats) -> str:
    return f"{'xy'[index[1]]} at t = {t[index[0]]:.3g}"


def _weighted(weights: Callable[[Floats], list[Floats]]) -> Callable[[Floats, Floats], Floats]:
    """Return the curve with four other weights."""

    def curve(P: Floats, t: Floats) -> Floats:
        points: Floats = np.array(weights(t)).T @ P
        return points

    return curve


_no_threes = _weighted(lambda t: [(1 - t) ** 3, (1 - t) ** 2 * t, (1 - t) * t**2, t**3])
_backwards = _weighted(lambda t: [t**3, 3 * t**2 * (1 - t), 3 * t * (1 - t) ** 2, (1 - t) ** 3])
_handles_swapped = _weighted(
    lambda t: [(1 - t) ** 3, 3 * (1 - t) * t**2, 3 * (1 - t) ** 2 * t, t**3]
)
_twos = _weighted(lambda t: [(1 - t) ** 3, 2 * (1 - t) ** 2 * t, 2 * (1 - t) * t**2, t**3])
_no_squares = _weighted(lambda t: [(1 - t) ** 3, 3 * (1 - t) * t, 3 * (1 - t) * t, t**3])
_quadratic = _weighted(lambda t: [(1 - t) ** 2, 2 * (1 - t) * t, t**2, 0 * t])


def _first_moment_only(P: Floats, t: Floats) -> Floats:
    points = interpolation.bezier_curve(P, t)
    points[1:] = np.nan
    return points


def _rows_after_it(got: Floats, *_: Any) -> bool:
    return bool(np.isnan(got[1:]).all() and not np.isnan(got[0]).any())


def _own_points(P: Floats, t: Floats) -> Floats:
    return interpolation.bezier_curve(PAPER, t)


TASK = Task(
    id="1.7",
    name="plot_cubic_bezier",
    title="Draw a cubic Bézier curve",
    block="interpolation",
    writes="a loop with four terms, about 6 lines",
    minutes=25,
    figure="Fig. 4b",
    questions=4,
    builds_on=("1.6",),
    functions=(
        Function(
            "cubic_bezier",
            "cubic_bezier(P, t)",
            Array(lambda P, t: (len(t), 2), "one row per value of t, with x and y"),
            interpolation.bezier_curve,
        ),
    ),
    parts=(
        *(_pull(k) for k in range(4)),
        Part(
            "curve", _curve, (Case((PAPER, T)), Case((LOOP, NEVER_HALF))), _coordinate, picture=PATH
        ),
    ),
    lines={
        "pull of P0": "pull of P0: (1 - s)^3 times P0",
        "pull of P1": "pull of P1: the formula above",
        "pull of P2": "pull of P2: the formula above",
        "pull of P3": "pull of P3: the formula above",
        "curve": "point: the sum of the four pulls",
    },
    mistakes=(
        Mistake(
            "no factors 3",
            "At every moment the four weights must add up to 1. Are there factors missing?",
            {"cubic_bezier": _no_threes},
            source="study: computation",
        ),
        Mistake(
            "factors of the quadratic curve",
            "The factor 2 belongs to the quadratic curve. What stands there in the cubic one?",
            {"cubic_bezier": _twos},
            source="neighbour: the quadratic curve",
        ),
        Mistake(
            "t and 1 - t swapped",
            "Your curve runs backwards: where must it be at t = 0?",
            {"cubic_bezier": _backwards},
            source="study: variable",
        ),
        Mistake(
            "handles swapped",
            "P1 pulls most in the first half of the time. Compare the squares of P1 and P2.",
            {"cubic_bezier": _handles_swapped},
            source="study: variable",
        ),
        Mistake(
            "squares missing",
            "In each of the four terms the powers of t and 1 - t together give 3.",
            {"cubic_bezier": _no_squares},
            source="study: computation",
        ),
        Mistake(
            "quadratic curve",
            "This is still the quadratic curve, which knows only three points.",
            {"cubic_bezier": _quadratic},
            source="neighbour: the quadratic curve",
        ),
        Mistake(
            "return in the loop",
            "Only the first moment is there. Does return stand in the loop?",
            {"cubic_bezier": _first_moment_only},
            _rows_after_it,
            source="study: function",
            line="return all points",
        ),
        Mistake(
            "fixed control points",
            "The curve does not follow the points it is given. Does it use P as it comes in?",
            {"cubic_bezier": _own_points},
            source="study: variable",
        ),
    ),
    canim_functions=(interpolation.bezier_curve, interpolation.de_casteljau),
)
