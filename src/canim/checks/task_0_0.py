"""Task 0.0, the warm-up: what "done" means for a point between two points."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import values_over
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task, at

CASES = (
    Case((np.array([1.0, 1.0]), np.array([7.0, 4.0]), np.linspace(0, 1, 11))),
    Case((np.array([-2.0, 5.0]), np.array([3.0, -1.0]), np.linspace(0, 1, 5)), "other points"),
    Case((np.array([0.5, 2.0]), np.array([0.0, 8.0]), np.array([0.3])), "one value of t"),
)


def _mixed(a: Floats, b: Floats, t: Floats) -> Floats:
    mixed: Floats = interpolation.lerp(a, b, t).T
    return mixed


def _part(name: str, row: int) -> Part:
    def measure(program: Any, a: Floats, b: Floats, t: Floats) -> Any:
        return program.blend(a, b, t)[row]

    return Part(name, measure, CASES, at("t", 2), picture=values_over("t", 2))


def _wrong(mixed: Callable[[Floats, Floats, Floats], Floats]) -> dict[str, Any]:
    """Return a program that mixes each number of two points in a wrong way."""
    return {"blend": lambda a, b, t: np.array([mixed(p, q, t) for p, q in zip(a, b)])}


TASK = Task(
    id="0.0",
    name="blend_two_points",
    title="Blend two points",
    block="warm_up",
    writes="two formulas, 2 lines",
    minutes=10,
    figure="",
    questions=3,
    functions=(
        Function(
            "blend",
            "blend(a, b, t)",
            Array(lambda a, b, t: (2, len(t)), "x and y, one number of each per value of t"),
            _mixed,
        ),
    ),
    parts=(_part("x", 0), _part("y", 1)),
    lines={
        "x": "x: 1 - t times a_x, plus t times b_x",
        "y": "y: the same with a_y and b_y",
    },
    mistakes=(
        Mistake(
            "shares exchanged",
            "At t = 0 the point must be at a. Where is it with your shares?",
            _wrong(lambda p, q, t: t * p + (1 - t) * q),
            source="study: variable",
        ),
        Mistake(
            "only the way",
            "This is only a part of the way from a to b. From where does it start?",
            _wrong(lambda p, q, t: t * (q - p)),
            source="study: computation",
        ),
        Mistake(
            "all of a",
            "The two shares must be 1 together. How large is the share of a?",
            _wrong(lambda p, q, t: p + t * q),
            source="study: computation",
        ),
        Mistake(
            "always half way",
            "The point stays in the middle at all moments. Where does t come in?",
            _wrong(lambda p, q, t: np.full(len(t), (p + q) / 2)),
            source="study: variable",
        ),
        Mistake(
            "x in both lines",
            "Both numbers are those of x. Which number of a point is its y?",
            {"blend": lambda a, b, t: _mixed(a, b, t)[[0, 0]]},
            source="study: array",
        ),
    ),
    canim_functions=(interpolation.lerp,),
)
