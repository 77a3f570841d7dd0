"""Task 1.6: what "done" means for the weights of a Bézier curve."""

from __future__ import annotations

from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task

# Every t holds 0.5, where all powers of degree n are alike: there a row is the number of
# ways, divided by 2 to the power n, whatever else is wrong with it.
CASES = (
    Case((3, np.linspace(0, 1, 11)), "n = 3"),
    Case((5, np.linspace(0, 1, 9)), "n = 5"),
    Case((4, np.array([0.1, 0.5, 0.7])), "n = 4"),
    Case((1, np.array([0.0, 0.25, 0.5])), "n = 1"),
)
POWERS, WAYS = "powers", "number of ways"


def _first(program: Any, n: int, t: Floats) -> Floats:
    row: Floats = program.bernstein_basis(n, t)[0]
    return row


def _ways(program: Any, n: int, t: Floats) -> Floats:
    ways: Floats = program.bernstein_basis(n, t)[1:, t == 0.5].ravel() * 2**n
    return ways


def _powers(program: Any, n: int, t: Floats) -> Floats:
    with np.errstate(all="ignore"):
        powers: Floats = program.bernstein_basis(n, t)[1:] / _ways(program, n, t)[:, None]
    return powers


def _row_of_way(index: tuple[int, ...], n: int, t: Floats) -> str:
    return f"b{index[0] + 1}"


def _row_and_time(index: tuple[int, ...], n: int, t: Floats) -> str:
    return f"powers of b{index[0] + 1} at t = {t[index[1]]:.3g}"


def _time(index: tuple[int, ...], n: int, t: Floats) -> str:
    return f"b0 at t = {t[index[0]]:.3g}"


def _no_ways(n: int, t: Floats) -> Floats:
    return np.array([t**i * (1 - t) ** (n - i) for i in range(n + 1)])


def _times_swapped(n: int, t: Floats) -> Floats:
    return interpolation.bernstein_basis(n, t)[::-1]


def _last_row_missing(n: int, t: Floats) -> Floats:
    basis = interpolation.bernstein_basis(n, t)
    basis[n] = np.nan
    return basis


def _power_n_of_the_rest(n: int, t: Floats) -> Floats:
    ways = interpolation.bernstein_basis(n, np.array([0.5])) * 2**n
    return np.array([ways[i] * t**i * (1 - t) ** n for i in range(n + 1)])


def _powers_of_t_alone(n: int, t: Floats) -> Floats:
    ways = interpolation.bernstein_basis(n, np.array([0.5])) * 2**n
    basis = np.array([ways[i] * t**i for i in range(n + 1)])
    basis[0] = (1 - t) ** n
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
        Part("first curve", _first, CASES, _time),
        Part(POWERS, _powers, CASES, _row_and_time),
        Part(WAYS, _ways, CASES, _row_of_way),
    ),
    mistakes=(
        Mistake(
            "no number of ways",
            "The powers stand for one row of tosses. How many rows have heads i times?",
            {"bernstein_basis": _no_ways},
        ),
        Mistake(
            "t and 1 - t swapped",
            "The last curve must be 1 at t = 1. Which of t and 1 - t has the power i?",
            {"bernstein_basis": _times_swapped},
        ),
        Mistake(
            "n instead of n + 1 curves",
            "The last row is empty. Which is the last number that your range reaches?",
            {"bernstein_basis": _last_row_missing},
        ),
        Mistake(
            "power n of 1 - t",
            "n tosses in all, i of them heads: how many tails are left for 1 - t?",
            {"bernstein_basis": _power_n_of_the_rest},
        ),
        Mistake(
            "no powers of 1 - t",
            "The powers of t are the heads. Where are the tails?",
            {"bernstein_basis": _powers_of_t_alone},
        ),
        Mistake(
            "degree 3 only",
            "All is right for n = 3. Is there a number in your loop where n belongs?",
            {"bernstein_basis": _only_degree_3},
            _right_for_3,
        ),
    ),
    canim_functions=(interpolation.bernstein_basis,),
)
