"""Task 1.9: what "done" means for the length of a curve and for points at equal distances.

A sampled length or place is never exact: the tolerances accept any good approximation.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import PATH
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task, Unusable

PAPER = np.array([[5.0, -10.0], [9.0, 38.0], [38.0, -5.0], [45.0, 15.0]])
ARCH = np.array([[0.0, 0.0], [2.0, 30.0], [30.0, 30.0], [40.0, 0.0]])
LINE = np.array([[10.0, 20.0], [30.0, 0.0], [40.0, -10.0], [50.0, -20.0]])

# With few samples, a chord more or less is seen. Two counts of samples are in use, N points
# or N chords: they differ by 0.2 % of the length, a missing chord by 7 % at least.
LENGTHS = (
    Case((PAPER, 10), "10 samples"),
    Case((ARCH, 12), "another curve, 12 samples"),
    Case((LINE, 8), "a straight line, 8 samples"),
)
POINTS = (
    Case((PAPER, 18), "18 points"),
    Case((ARCH, 7), "another curve, 7 points"),
    Case((LINE, 12), "a straight line, 12 points"),
)
ENDS, SPACING = "places: both ends", "places: equal spacing"


def _number(result: Any, *args: Any) -> Floats:
    numbers = Array(lambda: np.shape(result), "one number")(result)
    if numbers.size != 1:
        raise Unusable(f"returns {numbers.size} numbers, expected one: the length.")
    return numbers.reshape(())


def _length(program: Any, P: Floats, samples: int) -> Floats:
    length: Floats = program.compute_arc_length(P, samples)
    return length


def _ends(program: Any, P: Floats, count: int) -> Floats:
    ends: Floats = program.equidistant_points(P, count)[[0, -1]]
    return ends


def _between(program: Any, P: Floats, count: int) -> Floats:
    points: Floats = program.equidistant_points(P, count)[1:-1]
    return points


def _column_missing(got: Floats) -> bool:
    return bool(np.isnan(got).all(axis=0).any())


def _end(index: tuple[int, ...], P: Floats, count: int) -> str:
    return f"{'xy'[index[1]]} of the {('first', 'last')[index[0]]} point"


def _inner(index: tuple[int, ...], P: Floats, count: int) -> str:
    return f"{'xy'[index[1]]} of point {index[0] + 2}"


def _chords(P: Floats, samples: int) -> Floats:
    points = interpolation.bezier_curve(P, np.linspace(0, 1, samples))
    return np.diff(points, axis=0)


def _lengths(P: Floats, samples: int) -> Floats:
    lengths: Floats = np.linalg.norm(_chords(P, samples), axis=1)
    return lengths


def _along(fractions: Callable[[int], Floats]) -> Callable[[Floats, int], Floats]:
    """Return a function that places points at these fractions of the length."""

    def places(P: Floats, count: int) -> Floats:
        points = interpolation.bezier_curve(P, np.linspace(0, 1, 2001))
        walked = np.append(0, np.cumsum(_lengths(P, 2001)))
        goals = walked[-1] * fractions(count)
        return np.column_stack([np.interp(goals, walked, column) for column in points.T])

    return places


def _without_last(P: Floats, count: int) -> Floats:
    points = interpolation.equidistant_points(P, count)
    points[-1] = np.nan
    return points


def _sample_behind(P: Floats, count: int) -> Floats:
    points = interpolation.bezier_curve(P, np.linspace(0, 1, 1000))
    walked = np.append(0, np.cumsum(_lengths(P, 1000)))
    behind = np.searchsorted(walked, np.linspace(0, walked[-1], count), side="right") - 1
    places: Floats = points[behind]
    return places


def _by_a_sample(got: Floats, expected: Floats, P: Floats, count: int) -> bool:
    step = interpolation.arc_length(P) / (count - 1)
    return bool(np.linalg.norm(got - expected, axis=1).max() < 0.1 * step)


def _start_is_off(got: Floats, expected: Floats, P: Floats, count: int) -> bool:
    away = np.linalg.norm(got - expected, axis=1)
    return bool(0 < away[0] < 0.1 * interpolation.arc_length(P) / (count - 1))


def _from_table(
    P: Floats, count: int, walked: Floats | None = None, first: int = 0, end: float | None = None
) -> Floats:
    """Return the places as the starter finds them, with this wrong in them."""
    points = interpolation.bezier_curve(P, np.linspace(0, 1, 1000))[first:]
    if walked is None:
        walked = np.append(0, np.cumsum(_lengths(P, 1000)))
    goals = np.linspace(0, walked[-1] if end is None else end, count)
    return np.column_stack([np.interp(goals, walked, column) for column in points.T])


def _without_zero(P: Floats, count: int) -> Floats:
    return _from_table(P, count, walked=np.cumsum(_lengths(P, 1000)), first=1)


def _not_added(P: Floats, count: int) -> Floats:
    return _from_table(P, count, walked=np.append(0, _lengths(P, 1000)))


def _both_x(P: Floats, count: int) -> Floats:
    places: Floats = interpolation.equidistant_points(P, count)[:, [0, 0]]
    return places


TASK = Task(
    id="1.9",
    name="plot_bezier_equidistant_points",
    title="Walk a curve in equal steps",
    block="interpolation",
    writes="a sum of chords and a walk along the curve, about 8 lines",
    minutes=45,
    figure="Figs. 6a and 6b",
    questions=3,
    builds_on=("1.7",),
    functions=(
        Function(
            "compute_arc_length",
            "compute_arc_length(P, samples)",
            _number,
            interpolation.arc_length,
        ),
        Function(
            "equidistant_points",
            "equidistant_points(P, count)",
            Array(lambda P, count: (count, 2), "one row per point, both ends included"),
            interpolation.equidistant_points,
        ),
    ),
    parts=(
        Part("length", _length, LENGTHS, tolerance=0.01),
        # 3 in 10,000 of the size are a few in 1000 of the distance from point to point.
        Part(ENDS, _ends, POINTS, _end, unwritten=_column_missing, tolerance=3e-4, picture=PATH),
        Part(
            SPACING,
            _between,
            POINTS,
            _inner,
            unwritten=_column_missing,
            tolerance=3e-4,
            picture=PATH,
        ),
    ),
    lines={
        "length": "add its length to the length",
        "places: both ends": "goals: count distances in equal steps, from 0 to the whole length",
        "places: equal spacing": "places: x and y at each goal, from the table",
    },
    mistakes=(
        Mistake(
            "last chord missing",
            "Ten points have nine chords. How many does your loop add?",
            {"compute_arc_length": lambda P, samples: _lengths(P, samples)[:-1].sum()},
            parts=("length",),
            source="study: loop, fence posts",
            line="for each point but the last:",
        ),
        Mistake(
            "squares added",
            "You add the squares of the chords. What is missing before the sum?",
            {"compute_arc_length": lambda P, samples: (_lengths(P, samples) ** 2).sum()},
            parts=("length",),
            source="study: computation",
            line="chord: the way to the next point",
        ),
        Mistake(
            "along the axes",
            "A chord goes straight, not first along x and then along y.",
            {"compute_arc_length": lambda P, samples: np.abs(_chords(P, samples)).sum()},
            parts=("length",),
            source="study: computation",
            line="chord: the way to the next point",
        ),
        Mistake(
            "from end to end",
            "This is the straight way from the start to the end, without the curve between.",
            {"compute_arc_length": lambda P, samples: float(np.linalg.norm(P[-1] - P[0]))},
            parts=("length",),
            source="study: loop",
            line="for each point but the last:",
        ),
        Mistake(
            "control polygon",
            "This is the length of the control polygon. The chords join points of the curve.",
            {
                "compute_arc_length": lambda P, samples: np.linalg.norm(
                    np.diff(P, axis=0), axis=1
                ).sum()
            },
            parts=("length",),
            source="study: variable",
            line="points: samples of the curve",
        ),
        Mistake(
            "a single chord",
            "This is the last chord alone. Does your loop add, or does it begin anew?",
            {"compute_arc_length": lambda P, samples: _lengths(P, samples)[-1]},
            parts=("length",),
            source="study: loop",
        ),
        Mistake(
            "equal time steps",
            "These points are at equal steps of time. Where does the distance walked come in?",
            {
                "equidistant_points": lambda P, count: interpolation.bezier_curve(
                    P, np.linspace(0, 1, count)
                )
            },
            parts=(ENDS, SPACING),
            source="thread: gamedev.stackexchange.com/q/105230",
            line="places: x and y at each goal, from the table",
        ),
        Mistake(
            "chords not added up",
            "Is each distance walked longer than the one before? It must add the new chord.",
            {"equidistant_points": _not_added},
            parts=(ENDS, SPACING),
            source="study: loop",
            line=(
                "walked: 0 at the first point; at each other point, walked at the "
                "point before, plus the chord"
            ),
        ),
        Mistake(
            "goals from 0 to 1",
            "The last goal is 1. Which distance has been walked at the end of the curve?",
            {"equidistant_points": lambda P, count: _from_table(P, count, end=1.0)},
            parts=(ENDS, SPACING),
            source="study: computation",
            line="goals: count distances in equal steps, from 0 to the whole length",
        ),
        Mistake(
            "x in both columns",
            "Both columns hold x. Which column of the points belongs to y?",
            {"equidistant_points": _both_x},
            parts=(ENDS, SPACING),
            source="study: variable",
            line="places: x and y at each goal, from the table",
        ),
        Mistake(
            "last point missing",
            "The last row is empty: does your loop reach it?",
            {"equidistant_points": _without_last},
            parts=(ENDS, SPACING),
            source="matlab: never reaches the end point",
            line="places: x and y at each goal, from the table",
        ),
        Mistake(
            "one step short",
            "The last goal is not the whole length: how many steps lie between the points?",
            {"equidistant_points": _along(lambda count: np.arange(count) / count)},
            parts=(ENDS, SPACING),
            source="study: loop, fence posts",
            line="goals: count distances in equal steps, from 0 to the whole length",
        ),
        Mistake(
            "first point missing",
            "The first goal is not 0: the start of the curve is one of the points.",
            {"equidistant_points": _along(lambda count: np.arange(1, count + 1) / count)},
            parts=(ENDS, SPACING),
            source="study: loop, fence posts",
            line="goals: count distances in equal steps, from 0 to the whole length",
        ),
        Mistake(
            "walked without the 0",
            "What has been walked at the very first point? Is that in your table?",
            {"equidistant_points": _without_zero},
            _start_is_off,
            (ENDS,),
            source="study: loop, fence posts",
            line=(
                "walked: 0 at the first point; at each other point, walked at the "
                "point before, plus the chord"
            ),
        ),
        Mistake(
            "nearest sample",
            "Nearly right: a goal lies between two samples, so mix these two.",
            {"equidistant_points": _sample_behind},
            _by_a_sample,
            (SPACING,),
            source="matlab: always snaps to a sample",
        ),
    ),
    canim_functions=(
        interpolation.arc_length,
        interpolation.equidistant_points,
        interpolation.equidistant_parameters,
    ),
)
