"""Task 1.1: what "done" means for the Hermite basis."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import values_over
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task, at

CASES = (
    Case((np.linspace(0, 1, 11),)),
    Case((np.array([0.0, 0.25, 0.5, 1.0]),)),
    Case((np.array([0.3]),), "one value of t"),
)

CURVE = values_over("t")


def _row(k: int) -> Callable[..., Any]:
    return lambda program, t: program.hermite_basis(t)[k]


def _misprint(t: Floats) -> Floats:
    basis = interpolation.hermite_basis(t)
    basis[1] = -3 * t**3 + 3 * t**2
    return basis


def _value_and_slope_swapped(t: Floats) -> Floats:
    return interpolation.hermite_basis(t)[[0, 2, 1, 3]]


def _plus_in_h3(t: Floats) -> Floats:
    basis = interpolation.hermite_basis(t)
    basis[3] = t**3 + t**2
    return basis


def _start_slope_without_2(t: Floats) -> Floats:
    basis = interpolation.hermite_basis(t)
    basis[2] = t**3 - t**2 + t
    return basis


def _start_slope_without_its_last_term(t: Floats) -> Floats:
    basis = interpolation.hermite_basis(t)
    basis[2] = t**3 - 2 * t**2
    return basis


def _slopes_swapped(t: Floats) -> Floats:
    return interpolation.hermite_basis(t)[[0, 1, 3, 2]]


def _decreasing_end_value(t: Floats) -> Floats:
    basis = interpolation.hermite_basis(t)
    basis[1] = 2 * t**3 - 3 * t**2
    return basis


TASK = Task(
    id="1.1",
    name="plot_hermite_basis",
    title="Draw the four Hermite curves",
    block="interpolation",
    writes="three formulas, 3 lines",
    minutes=20,
    figure="Fig. 1a",
    questions=3,
    functions=(
        Function(
            "hermite_basis",
            "hermite_basis(t)",
            Array(lambda t: (4, len(t)), "four rows, one number per value of t"),
            interpolation.hermite_basis,
        ),
    ),
    parts=(
        Part("H0, start value", _row(0), CASES, at("t"), picture=CURVE),
        Part("H1, end value", _row(1), CASES, at("t"), picture=CURVE),
        Part("H2, start slope", _row(2), CASES, at("t"), picture=CURVE),
        Part("H3, end slope", _row(3), CASES, at("t"), picture=CURVE),
    ),
    lines={
        "H0, start value": "H0, start value: 2 t^3 - 3 t^2 + 1",
        "H1, end value": "H1, end value: the formula above",
        "H2, start slope": "H2, start slope: the formula above",
        "H3, end slope": "H3, end slope: the formula above",
    },
    mistakes=(
        Mistake(
            "misprint",
            "Some texts misprint a number in H1. Which value must H1 have at t = 1?",
            {"hermite_basis": _misprint},
            source="paper: Eq. 4",
        ),
        Mistake(
            "value and slope swapped",
            "Two rows stand in each other's place. Which row belongs to the end value?",
            {"hermite_basis": _value_and_slope_swapped},
            source="notation: elsewhere the order is f(0), f'(0), f(1), f'(1)",
        ),
        Mistake(
            "plus in H3",
            "Look at the sign between the two terms of H3: what must it be at t = 1?",
            {"hermite_basis": _plus_in_h3},
            source="study: computation",
        ),
        Mistake(
            "factor of H2",
            "Compare the factor before t squared in H2 with the formula.",
            {"hermite_basis": _start_slope_without_2},
            source="study: computation",
        ),
        Mistake(
            "H2 without its last term",
            "H2 must be 0 at t = 1. Are all three terms of the formula there?",
            {"hermite_basis": _start_slope_without_its_last_term},
            source="trial",
        ),
        Mistake(
            "slopes swapped",
            "H2 is a hill and H3 a valley. Which of your two rows is the hill?",
            {"hermite_basis": _slopes_swapped},
            source="trial",
        ),
        Mistake(
            "signs of H1",
            "H1 starts at 0 and goes up to 1. Where does yours go?",
            {"hermite_basis": _decreasing_end_value},
            source="study: computation",
        ),
    ),
    canim_functions=(interpolation.hermite_basis,),
)
