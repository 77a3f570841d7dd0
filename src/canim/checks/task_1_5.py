"""Task 1.5: what "done" means for the linear system of a quadratic spline.

Equations are compared as a set: in any order, times any number, and also where a student
takes a sum or difference of two of them. An equation is there if the rows that are
written imply it. There are as many rows as equations, so if all are there, none is wrong.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

import numpy as np

from canim import interpolation
from canim.checks.run import number
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task, Unusable

System = tuple[Floats, Floats]
SAME = 1e-7  # of equations at length one
POINTS = (
    (np.array([-3.0, -1.0, 1.0, 3.0]), np.array([15.0, 5.0, 8.0, 9.0])),
    (np.array([1.0, 2.0, 4.0]), np.array([3.0, -1.0, 2.0])),
    (np.array([-2.0, -0.5, 1.0, 1.5, 3.0, 5.0]), np.array([1.0, 4.0, -2.0, 0.0, 3.0, 3.5])),
)


def _cases(*starts: str) -> tuple[Case, ...]:
    return tuple(
        Case((x, y, start), f'{len(x)} points, start = "{start}"')
        for x, y in POINTS
        for start in starts
    )


def _accept(result: Any, x: Floats, y: Floats, start: Any) -> Floats:
    """Return one row of A and the number of b per equation; nan where nothing is written."""
    count = 3 * (len(x) - 1)
    if result is None:
        raise Unusable("returns nothing (None). Is the line with return missing?")
    try:
        A, b = result
    except (TypeError, ValueError):
        raise Unusable("must return two things: A and b.") from None
    A = Array(
        lambda: (count, count), "a row per equation, three columns per piece", "returns, as A,"
    )(A)
    b = np.ravel(b) if np.shape(b) == (count, 1) else b
    b = Array(lambda: (count,), "one number per equation", "returns, as b,")(b)
    empty = np.all(A == 0, axis=1, keepdims=True)[:, 0]
    for k in range(count):
        if not empty[k] and np.isfinite(A[k]).all() and np.isnan(b[k]):
            raise Unusable(
                f"writes row {k} of A, but b[{k}] is still nan. What is the right side there?"
            )
        if empty[k] and b[k] and np.isfinite(b[k]):
            raise Unusable(f"writes b[{k}], but row {k} of A is all zeros.")
    system = np.column_stack([A, b])
    system[empty | ~np.isfinite(system).all(axis=1)] = np.nan
    return system


def _scaled(row: Floats, equation: Floats) -> Floats:
    """Return the row, times what makes most of its numbers those of the equation.

    So what a student writes as on the page, but for a number or two, stays as it is. So
    does what has at most one number in common with the equation, whatever the factor.
    """
    common = np.flatnonzero((np.abs(_unit(row[None]))[0] > 1e-9) & (equation != 0))
    # Where as many agree on one factor as on another: that of the smallest number.
    common = common[np.argsort(np.abs(equation[common]), kind="stable")]
    factors = row[common] / equation[common]
    agree = np.isclose(factors[:, None], factors, rtol=1e-9, atol=0).sum(axis=0)
    scaled: Floats = row / factors[np.argmax(agree)] if agree.max(initial=0) > 1 else row
    return scaled


def _unit(rows: Floats) -> Floats:
    """Return the rows at length one; scaled, so that no square over- or underflows."""
    rows = rows / np.abs(rows).max(axis=1, keepdims=True)
    unit: Floats = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    return unit


def _outside(rows: Floats, others: Floats) -> Floats:
    """Return how far each row, at length one, is from the sums of multiples of the others."""
    rows = _unit(rows)
    if not len(others):
        return np.ones(len(rows))
    _, sizes, directions = np.linalg.svd(_unit(others), full_matrices=False)
    directions = directions[sizes > 1e-9 * sizes[0]]
    apart: Floats = np.linalg.norm(rows - rows @ directions.T @ directions, axis=1)
    return apart


def _spare(system: Floats, right: Floats) -> list[int]:
    """Return the rows that are wrong, and those that say what other rows say already."""
    written = np.flatnonzero(np.isfinite(system).all(axis=1))
    inside = _outside(system[written], right) < SAME
    spare, kept = list(written[~inside]), list[int]()
    # Rows that are equations of ours come first: of two that say the same, these are meant.
    for k in sorted(written[inside], key=lambda k: float(_likeness(system[[k]], right).max()) < 1):
        if _outside(system[[k]], system[kept])[0] < SAME:
            spare.append(k)
        else:
            kept.append(k)
    return spare


def _likeness(rows: Floats, right: Floats) -> Floats:
    """Return from 0 to 1 how much each row is like each equation, whatever the signs."""
    likeness: Floats = np.round(np.abs(_unit(rows)) @ np.abs(_unit(right)).T, 9)
    return likeness


def _compared(system: Floats, right: Floats) -> Floats:
    """Return, for each right equation: itself if the rows imply it, else what stands for it.

    That is the spare row most like it, or else nan.
    """
    found = right.copy()
    written = np.isfinite(system).all(axis=1)
    absent = _outside(right, system[written]) > SAME
    found[absent] = np.nan
    spare = _spare(system, right)
    if not spare:
        return found
    # Without the right side, which may be alike by chance. A row in its place is meant.
    likeness = _likeness(system[spare, :-1], right[:, :-1])
    likeness[np.arange(len(spare)), spare] += 0.5
    likeness[:, ~absent] = -1
    while (best := float(likeness.max())) >= 0:
        row, equation = np.argwhere(likeness == best)[0]
        found[equation] = _scaled(system[spare[row]], right[equation])
        likeness[row], likeness[:, equation] = -1, -1
    return found


def _equations(which: Callable[[int], slice]) -> Callable[..., Floats]:
    def measure(program: Any, x: Floats, y: Floats, start: Any) -> Floats:
        right = np.column_stack(interpolation.quadratic_spline_system(x, y, start))
        rows = _compared(program.quadratic_spline_system(x, y, start), right)
        return rows[which(len(x) - 1)]

    return measure


def _describe(name: Callable[..., str]) -> Callable[..., str]:
    """Return what names the first wrong equation; `name(k, x, y)` says what it is for."""

    def describe(got: Floats, expected: Floats, x: Floats, y: Floats, start: Any) -> str:
        wrong = ~np.isclose(got, expected, rtol=0, atol=1e-6 * np.abs(expected).max()).all(axis=1)
        # An equation that is there and wrong says more than one that is missing.
        k = int(np.argmax(wrong + np.isfinite(got).all(axis=1) * wrong))
        where = f"{len(x)} points, {name(k, x, y)}"
        if np.isnan(got[k]).any():
            return f"{where}: no row says this."
        return f"{where}: expected {_in_words(expected[k])}, got {_in_words(got[k])}"

    return describe


def _in_words(row: Floats) -> str:
    """Return an equation as text: 4 a0 - 2 b0 + c0 = 5."""
    text = ""
    for k in np.flatnonzero(np.abs(row[:-1]) > 1e-9):
        sign = ("- " if text else "-") if row[k] < 0 else ("+ " if text else "")
        size = "" if abs(abs(row[k]) - 1) < 1e-9 else f"{number(abs(row[k]))} "
        text += f"{sign}{size}{'abc'[k % 3]}{k // 3} "
    return f"{text}= {number(row[-1])}"


def _begins(k: int, x: Floats, y: Floats) -> str:
    return f"piece {k} begins at ({x[k]:g}, {y[k]:g})"


def _ends(k: int, x: Floats, y: Floats) -> str:
    return f"piece {k} ends at ({x[k + 1]:g}, {y[k + 1]:g})"


def _slopes(k: int, x: Floats, y: Floats) -> str:
    return f"equal slopes of pieces {k} and {k + 1} at x = {x[k + 1]:g}"


def _straight(k: int, x: Floats, y: Floats) -> str:
    return "straight start"


def _flat(k: int, x: Floats, y: Floats) -> str:
    return f"flat start at x = {x[0]:g}"


BEGINS, ENDS, SLOPES = "piece i begins", "piece i ends", "equal slopes"
STRAIGHT, FLAT = 'start = "straight"', 'start = "flat"'


def _changed(change: Callable[..., None], *starts: str) -> dict[str, Any]:
    """Return the right function, but `change(A, b, x, y, start)` made to what it returns."""

    def system(x: Floats, y: Floats, start: Any) -> System:
        A, b = interpolation.quadratic_spline_system(x, y, start)
        if start in starts or not starts:
            change(A, b, x, y, start)
        return A, b

    return {"quadratic_spline_system": system}


def _last_knot_left_out(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    A[-2], b[-2] = 0, np.nan


def _ends_at_its_beginning(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    for i in range(len(x) - 1):
        A[2 * i + 1] = A[2 * i]


def _ends_at_first_height(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    b[1 : 2 * len(x) - 2 : 2] = y[:-1]


def _all_in_the_first_columns(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    for i in range(len(x) - 1):
        A[2 * i + 1] = 0
        A[2 * i + 1, :3] = [x[i + 1] ** 2, x[i + 1], 1]


def _ends_over_beginnings(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    for i in range(len(x) - 1):
        A[2 * i], b[2 * i] = A[2 * i + 1], b[2 * i + 1]
        A[2 * i + 1], b[2 * i + 1] = 0, np.nan


def _ends_in_the_row_of_the_next_beginning(
    A: Floats, b: Floats, x: Floats, y: Floats, start: Any
) -> None:
    for i in range(len(x) - 1):
        A[2 * i + 1], b[2 * i + 1] = 0, np.nan
        A[2 * i + 2, 3 * i : 3 * i + 3] += [x[i + 1] ** 2, x[i + 1], 1]


def _slopes_over_the_last_end(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    slopes = A[2 * len(x) - 2, :6].copy()
    _ends_in_the_row_of_the_next_beginning(A, b, x, y, start)
    A[2 * len(x) - 2, :6] = slopes


def _slope_rows(A: Floats, x: Floats) -> Floats:
    return A[2 * len(x) - 2 : -1]


def _slopes_added(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    rows = _slope_rows(A, x)
    for i, row in enumerate(rows):
        row[3 * i + 3 :] *= -1


def _without_two(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    A[2 * len(x) - 2 :, ::3] /= 2
    if start == "straight":
        A[-1, 0] = 1


def _slopes_at_the_knot_before(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    for i, row in enumerate(_slope_rows(A, x)):
        row[[3 * i, 3 * i + 3]] = 2 * x[i], -2 * x[i]


def _each_at_its_own_knot(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    for i, row in enumerate(_slope_rows(A, x)):
        row[[3 * i, 3 * i + 3]] = 2 * x[i], -2 * x[i + 1]


def _heights_for_slopes(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    for i, row in enumerate(_slope_rows(A, x)):
        knot = [x[i + 1] ** 2, x[i + 1], 1]
        row[3 * i : 3 * i + 6] = [*knot, *np.negative(knot)]


def _bends_for_slopes(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    for i, row in enumerate(_slope_rows(A, x)):
        row[:] = 0
        row[[3 * i, 3 * i + 3]] = 2, -2


def _always(start: Literal["straight", "flat"]) -> dict[str, Any]:
    return {
        "quadratic_spline_system": lambda x, y, asked: interpolation.quadratic_spline_system(
            x, y, start
        )
    }


def _start_row(number_of: Callable[[Floats], Any]) -> Callable[..., None]:
    def change(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
        A[-1, :3] = number_of(x)

    return change


def _last_piece(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    A[-1] = 0
    A[-1, -3] = 1


def _last_column(A: Floats, b: Floats, x: Floats, y: Floats, start: Any) -> None:
    A[-1] = 0
    A[-1, -1] = 1


def _some_are_missing(got: Floats, expected: Floats, *args: Any) -> bool:
    there = np.isfinite(got).all(axis=1)
    return not there.all() and np.allclose(got[there], expected[there])


TASK = Task(
    id="1.5",
    name="quadratic_spline",
    title="A smooth path from small pieces",
    block="interpolation",
    writes="rows of a linear system, about 12 lines",
    minutes=75,
    figure="Fig. 3",
    questions=3,
    functions=(
        Function(
            "quadratic_spline_system",
            "quadratic_spline_system(x, y, start)",
            _accept,
            interpolation.quadratic_spline_system,
        ),
    ),
    parts=(
        Part(
            BEGINS,
            _equations(lambda pieces: slice(0, 2 * pieces, 2)),
            _cases("straight", "flat"),
            unwritten=lambda got: False,  # they are given: where they are gone, that is told
            describe=_describe(_begins),
        ),
        Part(
            ENDS,
            _equations(lambda pieces: slice(1, 2 * pieces, 2)),
            _cases("straight", "flat"),
            describe=_describe(_ends),
        ),
        Part(
            SLOPES,
            _equations(lambda pieces: slice(2 * pieces, 3 * pieces - 1)),
            _cases("straight", "flat"),
            describe=_describe(_slopes),
        ),
        Part(
            STRAIGHT,
            _equations(lambda pieces: slice(3 * pieces - 1, None)),
            _cases("straight"),
            describe=_describe(_straight),
        ),
        Part(
            FLAT,
            _equations(lambda pieces: slice(3 * pieces - 1, None)),
            _cases("flat"),
            describe=_describe(_flat),
        ),
    ),
    lines={
        "piece i begins": "piece i begins at point i:",
        "piece i ends": "piece i ends at point i + 1:",
        "equal slopes": "equal slopes:",
        'start = "straight"': "straight: a_0 = 0",
        'start = "flat"': "flat: slope at x_0 = 0",
    },
    mistakes=(
        Mistake(
            "inner knot left out",
            "Not every inner knot has its equation. Where does your loop end?",
            _changed(_last_knot_left_out),
            applies=_some_are_missing,
            parts=(SLOPES,),
            source="study: loop",
            line="for every inner knot x_(i+1):",
        ),
        Mistake(
            "ends where it begins",
            "Piece i ends at point i + 1. Which x stands in your row?",
            _changed(_ends_at_its_beginning),
            source="paper: 4.3 mixes two index bases",
            line="the same with point i + 1",
        ),
        Mistake(
            "height of the first point",
            "Piece i ends at point i + 1. Which y stands on the right side?",
            _changed(_ends_at_first_height),
            source="paper: 4.3 mixes two index bases",
            line="the same with point i + 1",
        ),
        Mistake(
            "columns of piece 0",
            "All your rows use the columns of piece 0. Which columns belong to piece i?",
            _changed(_all_in_the_first_columns),
            source="study: array",
            line="its columns: x_i^2, x_i, 1",
        ),
        Mistake(
            "row written twice",
            "A later equation overwrites this one. Does every equation have a row of its own?",
            _changed(_ends_over_beginnings),
            source="study: array",
        ),
        Mistake(
            "ends in the row of the next beginning",
            "Rows are written twice: look at the row numbers. In which row does piece i end?",
            _changed(_ends_in_the_row_of_the_next_beginning),
            source="trial",
        ),
        Mistake(
            "ends in the row of the next beginning, slopes over the last",
            "Rows are written twice: look at the row numbers, first at those of the ends.",
            _changed(_slopes_over_the_last_end),
            source="trial",
        ),
        Mistake(
            "slopes added",
            "Equal slopes: one slope minus the other is 0. Which signs do you need?",
            _changed(_slopes_added),
            source="study: computation",
            line="the same, minus signs",
        ),
        Mistake(
            "2 forgotten in the slope",
            "The slope of a x^2 + b x + c is 2 a x + b. Look at the column of a.",
            _changed(_without_two),
            source="study: computation",
            line="2 x_(i+1), 1, 0",
        ),
        Mistake(
            "slopes at the knot before",
            "Pieces i and i + 1 meet at the knot i + 1. Which x stands in your row?",
            _changed(_slopes_at_the_knot_before),
            source="paper: 4.3 mixes two index bases",
            line="for every inner knot x_(i+1):",
        ),
        Mistake(
            "slopes at two knots",
            "You compare slopes at two different places. Where do the two pieces meet?",
            _changed(_each_at_its_own_knot),
            source="paper: 4.3 mixes two index bases",
            line="for every inner knot x_(i+1):",
        ),
        Mistake(
            "heights in place of slopes",
            "This row says once more that the heights are equal. What is the slope of a piece?",
            _changed(_heights_for_slopes),
            source="study: concept",
            line="2 x_(i+1), 1, 0",
        ),
        Mistake(
            "bends in place of slopes",
            "This row makes the bends equal, 2 a. Which terms has the slope of a piece?",
            _changed(_bends_for_slopes),
            source="paper: 4.3 makes second derivatives continuous",
            line="2 x_(i+1), 1, 0",
        ),
        Mistake(
            "start always straight",
            "The start is straight here, though flat is asked for. Does your code look at start?",
            _always("straight"),
            source="paper: 4.3 names two end conditions and chooses none",
        ),
        Mistake(
            "start always flat",
            "The start is flat here, though straight is asked for. Does your code look at start?",
            _always("flat"),
            source="paper: 4.3 names two end conditions and chooses none",
        ),
        Mistake(
            "flat at x = 0",
            "b alone is the slope at x = 0. Where does the first piece begin?",
            _changed(_start_row(lambda x: [0, 1, 0]), "flat"),
            source="study: computation",
        ),
        Mistake(
            "height in place of the flat start",
            "This row sets a height to zero. What is the slope of the first piece?",
            _changed(_start_row(lambda x: [x[0] ** 2, x[0], 1]), "flat"),
            source="study: concept",
        ),
        Mistake(
            "last piece straight",
            "Your row speaks of the last piece. Which column holds a of the first?",
            _changed(_last_piece, "straight"),
            source="study: array",
        ),
        Mistake(
            "last column",
            "Your number stands in the last column. Which unknown belongs there?",
            _changed(_last_column, "straight"),
            source="study: array",
        ),
    ),
    canim_functions=(interpolation.quadratic_spline_system, interpolation.quadratic_spline),
)
