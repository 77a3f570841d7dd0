"""Task 1.10: what "done" means for a movement that starts and stops gently."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task, at

FIRST = (Case((np.linspace(0, 0.5, 6),)), Case((np.array([0.3]),), "one value of t"))
SECOND = (Case((np.linspace(0.6, 1, 5),)), Case((np.array([0.7]),), "one value of t"))


def ease_in_out(t: Floats) -> Floats:
    """Return what is right."""
    return np.where(t <= 0.5, 2 * t**2, 1 - 2 * (1 - t) ** 2)


def _second_half(wrong: Callable[[Floats], Floats]) -> dict[str, Any]:
    return {"ease_in_out": lambda t: np.where(t <= 0.5, 2 * t**2, wrong(t))}


TASK = Task(
    id="1.10",
    name="ease_in_out",
    title="Start and stop gently",
    block="interpolation",
    writes="one half of a curve, 1 line",
    minutes=15,
    figure="",
    questions=2,
    functions=(
        Function(
            "ease_in_out",
            "ease_in_out(t)",
            Array(lambda t: (len(t),), "one number per value of t"),
            ease_in_out,
        ),
    ),
    parts=(
        Part("speed up", lambda program, t: program.ease_in_out(t), FIRST, at("t")),
        Part("slow down", lambda program, t: program.ease_in_out(t), SECOND, at("t")),
    ),
    lines={
        "speed up": "speed up: in the first half, 2 t^2 is done",
        "slow down": "slow down: in the second half, all but what is left",
    },
    mistakes=(
        Mistake(
            "goes on speeding up",
            "The movement goes on speeding up, past the end. Where does it brake?",
            _second_half(lambda t: 2 * t**2),
            source="authors",
        ),
        Mistake(
            "what is left",
            "This is the way that is left. How much of the way is done?",
            _second_half(lambda t: 2 * (1 - t) ** 2),
            source="authors",
        ),
        Mistake(
            "time not turned round",
            "How much time is left at the time t? That is what has to be squared.",
            _second_half(lambda t: 1 - 2 * t**2),
            source="authors",
        ),
    ),
)
