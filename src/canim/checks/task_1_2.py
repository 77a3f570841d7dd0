"""Task 1.2: what "done" means for the coefficients and the curve of Hermite interpolation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import values_over
from canim.checks.program import Stopped
from canim.checks.run import number
from canim.checks.task import Array, Case, Data, Floats, Function, Mistake, Part, Task, at

M = interpolation.HERMITE_MATRIX
WISHES = ("f(0)", "f(1)", "f'(0)", "f'(1)")
# Those of the paper come first. They are equal to each other in three of four numbers, so
# that many mistakes only show with the others.
GIVEN = ((1.0, 1.0, 0.0, 1.0), (-2.0, 0.5, 3.0, -1.0), (0.0, 1.0, 0.0, 0.0))
TIMES = np.linspace(0, 1, 11)


def _label(given: tuple[float, ...]) -> str:
    return ", ".join(f"{wish} = {value:g}" for wish, value in zip(WISHES, given))


COEFFICIENTS = tuple(Case(given, _label(given)) for given in GIVEN)
CURVES = tuple(
    Case((times, *given), _label(given))
    for given, times in zip(GIVEN, (TIMES, TIMES, np.array([0.0, 0.3, 1.0])))
)


def _row(k: int) -> Part:
    return Part(
        f"M, row for {'abcd'[k]}",
        lambda program: program.M[k],
        expected=lambda program: M[k],
        describe=_wrong_number,
    )


def _wrong_number(got: Floats, expected: Floats) -> str:
    """Return which number differs, but not what is right: that is the answer."""
    k = int(np.argmax(~np.isclose(got, expected)))
    if np.isnan(got[k]):
        return f"number for {WISHES[k]}: not written yet"
    return f"number for {WISHES[k]}: {number(got[k])} is not right"


def _own_or_right(own: Any, right: Floats, tried: Floats) -> Floats:
    """Return what follows from the student's own M, where that is what the student got.

    What is right is as good: the numbers can be found without M. So a wrong number of M is
    told once, in its row.
    """
    follows: Floats = np.asarray(own, dtype=float)
    return follows if np.allclose(tried, follows, atol=1e-6, equal_nan=True) else right


def _matrix(program: Any) -> Floats:
    try:
        matrix: Floats = program.M
    except Stopped:
        return M  # told where the rows are judged
    return matrix


def _expected_coefficients(program: Any, *given: float) -> Floats:
    own = _matrix(program) @ np.array(given)
    right = interpolation.hermite_coefficients(*given)
    return _own_or_right(own, right, program.hermite_coefficients(*given))


def _expected_curve(program: Any, t: Floats, *given: float) -> Floats:
    """Return the curve of the student's own coefficients, where these stop of M, or the right."""
    got = program.hermite_curve(t, *given)
    right = interpolation.hermite_curve(t, *given)
    try:
        a, b, c, d = program.hermite_coefficients(*given)
    except Stopped:
        a, b, c, d = _matrix(program) @ np.array(given)
    return _own_or_right(a * t**3 + b * t**2 + c * t + d, right, got)


def _any_nan(got: Floats) -> bool:
    # A row of M that is missing leaves nan in some of the results only.
    return bool(np.isnan(got).any())


def _with_matrix(matrix: Floats) -> dict[str, Any]:
    return _with_coefficients(lambda f0, f1, d0, d1: matrix @ np.array([f0, f1, d0, d1]), matrix)


def _with_coefficients(coefficients: Callable[..., Any], matrix: Floats = M) -> dict[str, Any]:
    def curve(t: Floats, f0: float, f1: float, d0: float, d1: float) -> Any:
        a, b, c, d = coefficients(f0, f1, d0, d1)
        return a * t**3 + b * t**2 + c * t + d

    return {"M": matrix, "hermite_coefficients": coefficients, "hermite_curve": curve}


def _wishes_in_another_order(f0: float, f1: float, d0: float, d1: float) -> Any:
    return M @ np.array([f0, d0, f1, d1])


def _product_turned_round(f0: float, f1: float, d0: float, d1: float) -> Any:
    return np.array([f0, f1, d0, d1]) @ M


def _powers_turned_round(t: Floats, f0: float, f1: float, d0: float, d1: float) -> Any:
    a, b, c, d = interpolation.hermite_coefficients(f0, f1, d0, d1)
    return d * t**3 + c * t**2 + b * t + a


def _constant_forgotten(t: Floats, f0: float, f1: float, d0: float, d1: float) -> Any:
    return interpolation.hermite_curve(t, f0, f1, d0, d1) - f0


def _slope_in_place_of_curve(t: Floats, f0: float, f1: float, d0: float, d1: float) -> Any:
    a, b, c, _ = interpolation.hermite_coefficients(f0, f1, d0, d1)
    return 3 * a * t**2 + 2 * b * t + c


TASK = Task(
    id="1.2",
    name="hermite_interpolation",
    title="One movement from four wishes",
    block="interpolation",
    writes="three rows of a matrix, a product and a polynomial, 5 lines",
    minutes=35,
    figure="Fig. 1b",
    questions=3,
    builds_on=("1.1",),
    functions=(
        Function(
            "hermite_coefficients",
            "hermite_coefficients(f0, f1, d0, d1)",
            Array(lambda *given: (4,), "the four numbers a, b, c, d"),
            interpolation.hermite_coefficients,
        ),
        Function(
            "hermite_curve",
            "hermite_curve(t, f0, f1, d0, d1)",
            Array(lambda t, *given: t.shape, "one number per value of t"),
            interpolation.hermite_curve,
        ),
    ),
    data=(Data("M", Array(lambda: (4, 4), "four rows of four numbers", verb="is")),),
    parts=(
        *(_row(k) for k in range(4)),
        Part(
            "coefficients",
            lambda program, *given: program.hermite_coefficients(*given),
            COEFFICIENTS,
            lambda index, *given: "abcd"[index[0]],
            expected=_expected_coefficients,
            unwritten=_any_nan,
        ),
        Part(
            "curve",
            lambda program, *args: program.hermite_curve(*args),
            CURVES,
            at("t"),
            expected=_expected_curve,
            unwritten=_any_nan,
            picture=values_over("t"),
        ),
    ),
    lines={
        "M, row for a": "M, row for a: 2, -2, 1, 1",
        "M, row for b": "M, row for b: from the formula for b",
        "M, row for c": "M, row for c: from the equation for f'(0)",
        "M, row for d": "M, row for d: from the equation for f(0)",
        "coefficients": "coefficients: M times wishes",
        "curve": "curve: a t^3 + b t^2 + c t + d",
    },
    mistakes=(
        Mistake(
            "wishes in another order",
            "In which order do the columns of M stand? The wishes need the same order.",
            _with_coefficients(_wishes_in_another_order),
            source="notation: elsewhere the order is f(0), f'(0), f(1), f'(1)",
            line="wishes: f0, f1, d0, d1",
        ),
        Mistake(
            "product turned round",
            "In a product of a matrix and a list of numbers, which of the two comes first?",
            _with_coefficients(_product_turned_round),
            source="paper: Section 5 multiplies points as rows",
        ),
        Mistake(
            "columns of M in another order",
            "Compare the second and the third column of M with the order of the wishes.",
            _with_matrix(np.array([M[0], *M[1:, [0, 2, 1, 3]]])),
            source="notation: elsewhere the order is f(0), f'(0), f(1), f'(1)",
        ),
        Mistake(
            "slopes exchanged in the row for b",
            "In the row for b, which number belongs to the start slope, which to the end slope?",
            _with_matrix(np.array([M[0], M[1, [0, 1, 3, 2]], M[2], M[3]])),
            source="study: computation",
        ),
        Mistake(
            "signs of the row for b",
            "Look at the signs in the row for b.",
            _with_matrix(np.array([M[0], -M[1], M[2], M[3]])),
            source="study: computation",
        ),
        Mistake(
            "rows for c and d exchanged",
            "At t = 0 only d is left of the cubic. Which wish is the height at t = 0?",
            _with_matrix(M[[0, 1, 3, 2]]),
            source="study: array",
        ),
        Mistake(
            "the four equations in place of M",
            "These rows take a, b, c, d and give the wishes. M goes the other way.",
            _with_matrix(np.array([M[0], [1, 1, 1, 1], [0, 0, 1, 0], [3, 2, 1, 0]])),
            source="study: concept",
        ),
        Mistake(
            "powers turned round",
            "Which of the four numbers belongs to the highest power of t?",
            {"M": M, "hermite_curve": _powers_turned_round},
            source="notation: numpy.polynomial counts powers upwards, numpy.polyval downwards",
        ),
        Mistake(
            "constant forgotten",
            "Your curve has the right shape at the wrong height: is every term there?",
            {"M": M, "hermite_curve": _constant_forgotten},
            source="study: computation",
        ),
        Mistake(
            "slope in place of the curve",
            "This is how fast the curve rises. Which formula gives its height?",
            {"M": M, "hermite_curve": _slope_in_place_of_curve},
            source="study: concept",
        ),
    ),
    canim_functions=(interpolation.hermite_coefficients, interpolation.hermite_curve),
)
