"""Task 1.6: what "done" means for the weights of a Bézier curve."""

from __future__ import annotations

from collections.abc import Callable
from math import comb
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import values_over
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task

# Every t holds 0.5, where all powers of degree n are alike: there a right row is the number
# of ways, divided by 2 to the power n.
CASES = (
    Case((3, np.linspace(0, 1, 11)), "n = 3"),
    Case((5, np.linspace(0, 1, 9)), "n = 5"),
    Case((4, np.array([0.1, 0.5, 0.7])), "n = 4"),
    Case((1, np.array([0.0, 0.25, 0.5])), "n = 1"),
)
FIRST, POWERS, WAYS = "first curve", "powers", "number of ways"


def _first(program: Any, n: int, t: Floats) -> Floats:
    row: Floats = program.bernstein_basis(n, t)[0]
    return row


def _others(program: Any, n: int, t: Floats) -> Floats:
    rows: Floats = program.bernstein_basis(n, t)[1:]
    return rows


def _only_powers_wrong(program: Any, n: int, t: Floats) -> Floats:
    """Return the student's rows where their powers are right, and right rows elsewhere."""
    got, powers = _others(program, n, t), _powers(n, t)[1:]
    right = interpolation.bernstein_basis(n, t)[1:]
    for row, whole, bare in zip(right, got, powers):
        if _multiple(whole, bare):
            row[:] = whole
        # Powers alone are compared with powers alone.
        elif np.abs(whole - bare).max() < np.abs(whole - row).max():
            row[:] = bare
    return right


def _ways(program: Any, n: int, t: Floats) -> Floats:
    """Return the numbers of ways, or nan where wrong powers hide them."""
    rows = [zip(_others(program, *c.args), _powers(*c.args)[1:]) for c in CASES]
    if not all(_multiple(row, powers) for pairs in rows for row, powers in pairs):
        return np.full(n, np.nan)
    ways: Floats = _others(program, n, t)[:, t == 0.5].ravel() * 2**n
    return ways


def _multiple(row: Floats, powers: Floats) -> bool:
    """Tell whether a row is its powers times one number, 0 or more."""
    times = row @ powers / (powers @ powers)
    near = np.abs(row - times * powers).max() <= 1e-6 * max(1.0, np.abs(row).max())
    return bool(times >= 0 and near)


def _no_curves(got: Floats) -> bool:
    return bool(np.isnan(got).all() or (got == 0).all())


def _row_of_way(index: tuple[int, ...], n: int, t: Floats) -> str:
    return f"b{index[0] + 1}"


def _row_and_time(index: tuple[int, ...], n: int, t: Floats) -> str:
    return f"b{index[0] + 1} at t = {t[index[1]]:.3g}"


def _time(index: tuple[int, ...], n: int, t: Floats) -> str:
    return f"b0 at t = {t[index[0]]:.3g}"


def _powers(n: int, t: Floats) -> Floats:
    return np.array([t**i * (1 - t) ** (n - i) for i in range(n + 1)])


def _times_swapped(n: int, t: Floats) -> Floats:
    return interpolation.bernstein_basis(n, t)[::-1]


def _last_row_missing(n: int, t: Floats) -> Floats:
    basis = interpolation.bernstein_basis(n, t)
    basis[n] = np.nan
    return basis


def _last_row(got: Floats, expected: Floats, n: int, t: Floats) -> bool:
    return bool(np.isnan(got[-1]).all() and not np.isnan(got[:-1]).any())


def _second_row_only(n: int, t: Floats) -> Floats:
    basis = interpolation.bernstein_basis(n, t)
    basis[2:] = np.nan
    return basis


def _rows_after_it(got: Floats, expected: Floats, n: int, t: Floats) -> bool:
    return bool(np.isnan(got[1:]).all() and not np.isnan(got[0]).any())


def _power_n_of_the_rest(n: int, t: Floats) -> Floats:
    return np.array([comb(n, i) * t**i * (1 - t) ** n for i in range(n + 1)])


def _minus_after_power(n: int, t: Floats) -> Floats:
    return np.array([comb(n, i) * t**i * (1 - t) ** n - i for i in range(n + 1)])


def _minus_i(got: Floats, expected: Floats, n: int, t: Floats) -> bool:
    i = np.arange(1, n + 1)
    counts = np.array([comb(n, k) for k in i])
    wanted = _power_n_of_the_rest(n, t)[1:]
    return any(all(map(_multiple, got + (c * i)[:, None], wanted)) for c in (1, counts))


def _powers_of_t_alone(n: int, t: Floats) -> Floats:
    basis = np.array([comb(n, i) * t**i for i in range(n + 1)])
    basis[0] = (1 - t) ** n
    return basis


def _with(basis: Callable[[int, Floats], Floats]) -> Callable[..., bool]:
    """Return a test for rows with these powers, whatever their number of ways."""

    def applies(got: Floats, expected: Floats, n: int, t: Floats) -> bool:
        rows = basis(n, t)
        return all(map(_multiple, np.atleast_2d(got), rows[:1] if got.ndim == 1 else rows[1:]))

    return applies


def _comb_turned_round(n: int, t: Floats) -> Floats:
    basis = _powers(n, t)
    basis[1:n] = 0
    return basis


def _only_degree_3(n: int, t: Floats) -> Floats:
    basis = np.full((n + 1, len(t)), np.nan)
    basis[:4] = interpolation.bernstein_basis(3, t)[: n + 1]
    basis[0] = (1 - t) ** n
    return basis


def _right_for_3(got: Floats, expected: Floats, n: int, t: Floats) -> bool:
    return n != 3


TASK = Task(
    id="1.6",
    name="compute_bezier_basis",
    title="Draw the weights of a Bézier curve",
    block="interpolation",
    writes="a loop over the curves, 3 lines",
    minutes=25,
    figure="Fig. 4a",
    questions=3,
    functions=(
        Function(
            "bernstein_basis",
            "bernstein_basis(n, t)",
            Array(lambda n, t: (n + 1, len(t)), "n + 1 rows, one number per value of t"),
            interpolation.bernstein_basis,
        ),
    ),
    parts=(
        Part(FIRST, _first, CASES, _time, picture=values_over("t", 1)),
        Part(
            POWERS,
            _others,
            CASES,
            _row_and_time,
            expected=_only_powers_wrong,
            unwritten=_no_curves,
            picture=values_over("t", 1),
        ),
        Part(WAYS, _ways, CASES, _row_of_way, unwritten=_no_curves),
    ),
    lines={
        "first curve": "t to the power i, times 1 - t to the power n - i",
        "powers": "t to the power i, times 1 - t to the power n - i",
        "number of ways": "n choose i",
    },
    mistakes=(
        Mistake(
            "t and 1 - t swapped",
            "The last curve must be 1 at t = 1. Which of t and 1 - t has the power i?",
            {"bernstein_basis": _times_swapped},
            _with(_times_swapped),
            (FIRST, POWERS),
            source="study: variable",
        ),
        Mistake(
            "n instead of n + 1 curves",
            "The last row is empty. Which is the last number that your range reaches?",
            {"bernstein_basis": _last_row_missing},
            _last_row,
            (POWERS,),
            source="paper: Eq. 9 takes n for both the number and the degree",
            line="for i from 0 to n:",
        ),
        Mistake(
            "return in the loop",
            "Only b1 is there. Does return stand in the loop, and end it after one round?",
            {"bernstein_basis": _second_row_only},
            _rows_after_it,
            (POWERS,),
            source="study: function",
            line="return the n + 1 rows",
        ),
        Mistake(
            "power n of 1 - t",
            "n tosses in all, i of them heads: how many tails are left for 1 - t?",
            {"bernstein_basis": _power_n_of_the_rest},
            _with(_power_n_of_the_rest),
            (POWERS,),
            source="study: computation",
        ),
        Mistake(
            "exponent without brackets",
            "Which does Python do first, the power or the minus? Look at the exponent n - i.",
            {"bernstein_basis": _minus_after_power},
            _minus_i,
            (POWERS,),
            source="study: computation",
        ),
        Mistake(
            "no powers of 1 - t",
            "The powers of t are the heads. Where are the tails?",
            {"bernstein_basis": _powers_of_t_alone},
            _with(_powers_of_t_alone),
            (POWERS,),
            source="study: computation",
        ),
        Mistake(
            "no number of ways",
            "The powers stand for one series of tosses. How many series have heads i times?",
            {"bernstein_basis": _powers},
            parts=(WAYS,),
            source="study: computation",
            line="number of ways times powers",
        ),
        Mistake(
            "comb turned round",
            "You choose i of n tosses: in which order does comb want the two numbers?",
            {"bernstein_basis": _comb_turned_round},
            parts=(WAYS,),
            source="study: function",
        ),
        Mistake(
            "degree 3 only",
            "All is right for n = 3. Is there a number in your loop where n belongs?",
            {"bernstein_basis": _only_degree_3},
            _right_for_3,
            source="matlab: written for a fixed number of points",
            line="for i from 0 to n:",
        ),
    ),
    canim_functions=(interpolation.bernstein_basis,),
)
