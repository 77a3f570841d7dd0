"""Task 3.2: what "done" means for a measured Jacobian and for steps towards a goal."""

from __future__ import annotations

from typing import Any

import numpy as np

from canim import character
from canim.checks.chains import (
    accept_poses,
    at_the_end,
    forward,
    jacobian,
    reaching_mistakes,
    reaching_parts,
    steps_to,
)
from canim.checks.task import Array, Case, Floats, Function, Task


def _entry(index: tuple[int, ...], *args: Any) -> str:
    return f"{'xy'[index[0]]} of column {index[1]}"


def _arm(seed: int, count: int, *goal: float) -> tuple[Floats, ...]:
    """Return angles, links of different lengths and directions, and perhaps a goal."""
    random = np.random.default_rng(seed)
    angles, offsets = random.uniform(0.3, 0.9, count), random.uniform(0.5, 1.2, (count, 2))
    return (angles, offsets, np.array(goal)) if goal else (angles, offsets)


PAGE = np.radians([-20.0, 50.0, 40.0]), np.array([[0.0, 1.0]] * 3)
END = forward(*PAGE)[-1]

TASK = Task(
    id="3.2",
    name="inverse_kinematics_2D",
    title="Let an arm reach for a goal",
    block="character",
    writes="a Jacobian and a loop of small steps, about 11 lines",
    minutes=60,
    figure="Fig. 13",
    questions=4,
    builds_on=("3.1",),
    functions=(
        Function(
            "jacobian",
            "jacobian(angles, offsets)",
            Array(
                lambda angles, offsets: (2, len(angles)), "x and y in two rows, a column per joint"
            ),
            jacobian,
        ),
        Function("reach", "reach(angles, offsets, goal)", accept_poses, steps_to),
    ),
    parts=reaching_parts(
        (
            Case(PAGE, "3 links"),
            Case(_arm(1, 5), "5 links"),
            Case(_arm(2, 2), "2 links"),
        ),
        (
            Case((*PAGE, np.array([1.2, 0.7])), "3 links"),
            Case(_arm(1, 5, -1.0, -1.4), "5 links"),
            Case(_arm(3, 4, 1.5, 1.0), "4 links"),
        ),
        (
            Case(at_the_end(*PAGE), "goal at the end effector"),
            *(
                Case((*PAGE, END + way), "3 links")
                for way in np.array([[0.9, -1.2], [-0.9, -1.5], [0.0, -1.5], [1.0, 0.0]])
            ),
        ),
        _entry,
    ),
    lines={
        "Jacobian": "column i: how far p has moved, divided by epsilon",
        "update": "update: add step size times pseudoinverse of J times e to the angles",
        "stop": "stop: if e is shorter than the tolerance",
        "goals reached": "at most 200 times:",
    },
    mistakes=reaching_mistakes(),
    canim_functions=(
        character.jacobian_2d,
        character.numeric_jacobian,
        character.inverse_kinematics,
        character.inverse_kinematics_batch,
    ),
)
