"""Task 3.3: what "done" means for a chain in space: three angles a joint, three coordinates."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import character
from canim.checks.chains import (
    JACOBIAN,
    STOP,
    TOLERANCE,
    UPDATE,
    accept_poses,
    at_the_end,
    forward,
    jacobian,
    reaching_mistakes,
    reaching_parts,
    steps_to,
    wrong_steps,
)
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task


def about(axis: int, angle: float) -> Floats:
    """Return the matrix that turns by an angle about the axis with this number."""
    c, s = np.cos(angle), np.sin(angle)
    R = np.eye(3)
    y, z = (axis + 1) % 3, (axis + 2) % 3
    R[[y, y, z, z], [y, z, y, z]] = c, -s, s, c
    return R


def rotation(angles: Floats, order: tuple[int, ...] = (0, 1, 2), sign: int = 1) -> Floats:
    """Return Rx Ry Rz, or another product; with another `sign` the one about y goes wrong."""
    signs = np.array([1, sign, 1])
    product: Floats = np.eye(3)
    for axis in order:
        product = product @ about(axis, signs[axis] * angles[axis])
    return product


def _wrong_rotation(turn: Callable[[Floats], Floats]) -> dict[str, Any]:
    return {"rotation": turn}


def _entry(index: tuple[int, ...], *args: Any) -> str:
    return f"row {index[0]}, column {index[1]} of R"


def _column(index: tuple[int, ...], *args: Any) -> str:
    return f"{'xyz'[index[0]]} of column {index[1]}"


def _unturned(R: Floats) -> bool:
    return np.array_equal(R, np.eye(3))


def _other_order(angles: Floats, offsets: Floats) -> Floats:
    J = jacobian(angles, offsets)
    columns: Floats = J.reshape(3, -1, 3).swapaxes(1, 2).reshape(J.shape)
    return columns


def _overlapping(angles: Floats, offsets: Floats) -> Floats:
    J = jacobian(angles, offsets)
    columns = np.zeros(J.shape)
    for i, k in np.ndindex(angles.shape):
        columns[:, i + k] = J[:, 3 * i + k]
    return columns


def _joints_as_in_the_plane(angles: Floats, offsets: Floats) -> Floats:
    J = jacobian(angles, offsets).reshape(3, -1, 3)
    return np.repeat(J.sum(axis=2), 3, axis=1)


def _turn(*degrees: float) -> Case:
    angles: Floats = np.radians(np.array(degrees, dtype=float))
    return Case((angles,), f"angles {degrees}°")


def _arm(seed: int, count: int, *goal: float) -> tuple[Floats, ...]:
    """Return angles, links of different lengths and directions, and perhaps a goal."""
    random = np.random.default_rng(seed)
    angles, offsets = random.uniform(0.2, 0.9, (count, 3)), random.uniform(0.4, 1.0, (count, 3))
    return (angles, offsets, np.array(goal)) if goal else (angles, offsets)


PAGE = (
    np.radians([[20.0, 10.0, 0.0], [-40.0, 30.0, 10.0], [-30.0, 20.0, 0.0]]),
    np.array([[0.0, 0.0, 1.0]] * 3),
)
END = forward(*PAGE)[-1]
ROTATION = "rotation"

TASK = Task(
    id="3.3",
    name="inverse_kinematics_3D",
    title="Reach for goals in space",
    block="character",
    writes="a rotation in space, a Jacobian and an update, about 15 lines",
    minutes=60,
    figure="Fig. 14",
    questions=4,
    builds_on=("3.1", "3.2"),
    functions=(
        Function(
            "rotation",
            "rotation(angles)",
            Array(lambda angles: (3, 3), "a matrix of three rows and three columns"),
            rotation,
        ),
        Function(
            "jacobian",
            "jacobian(angles, offsets)",
            Array(
                lambda angles, offsets: (3, angles.size),
                "x, y and z in three rows, a column per angle",
            ),
            jacobian,
        ),
        Function("reach", "reach(angles, offsets, goal)", accept_poses, steps_to),
    ),
    parts=(
        Part(
            ROTATION,
            lambda program, angles: program.rotation(angles),
            (_turn(35, -50, 110), _turn(0, 30, 0), _turn(0, 0, 30)),
            _entry,
            unwritten=_unturned,
        ),
        *reaching_parts(
            (Case(PAGE, "3 links"), Case(_arm(1, 2), "2 links")),
            (
                Case((*PAGE, np.array([1.2, -0.7, 0.9])), "3 links"),
                Case(_arm(2, 2, 0.6, -1.1, 0.8), "2 links"),
            ),
            (
                Case(at_the_end(*PAGE), "goal at the end effector"),
                *(
                    Case((*PAGE, END + way), "3 links")
                    for way in np.array(
                        [[0.4, 0.4, -1.5], [-0.6, -0.7, -0.8], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.5]]
                    )
                ),
            ),
            _column,
        ),
    ),
    lines={
        "rotation": "return Rx times Ry times Rz",
        "Jacobian": "column 3 i + k: how far p has moved, divided by epsilon",
        "update": (
            "update: add step size times pseudoinverse of J times e, as a table, to the angles"
        ),
        "stop": "stop: if e is shorter than the tolerance",
        "goals reached": "at most 200 times:",
    },
    mistakes=(
        Mistake(
            "order turned round",
            "This is Rz Ry Rx. Which of the three stands on the left?",
            _wrong_rotation(lambda angles: rotation(angles, (2, 1, 0))),
            source="thread: rotations order - Euler angle, OpenGL forums, August 2009",
        ),
        Mistake(
            "y and z exchanged in the order",
            "This is Rx Rz Ry. Which of the three stands in the middle?",
            _wrong_rotation(lambda angles: rotation(angles, (0, 2, 1))),
            source="thread: rotations order - Euler angle, OpenGL forums, August 2009",
        ),
        Mistake(
            "x and y exchanged in the order",
            "This is Ry Rx Rz. Which of the three stands on the left?",
            _wrong_rotation(lambda angles: rotation(angles, (1, 0, 2))),
            source="thread: rotations order - Euler angle, OpenGL forums, August 2009",
        ),
        Mistake(
            "minus sign of y",
            "About y it turns the wrong way: there the minus sign stands in the last row.",
            _wrong_rotation(lambda angles: rotation(angles, sign=-1)),
            source="study: computation",
            line="Rx, Ry, Rz: about x, y and z",
        ),
        Mistake(
            "about z clockwise",
            "About z it turns clockwise. Which of the two sines has the minus sign?",
            _wrong_rotation(lambda angles: rotation(angles * [1, 1, -1])),
            source="study: computation",
            line="Rx, Ry, Rz: about x, y and z",
        ),
        Mistake(
            "degrees",
            "np.cos and np.sin want radians, and the angles are in radians already.",
            _wrong_rotation(lambda angles: rotation(np.radians(angles))),
            source="thread: stackoverflow.com/q/1237085",
            line="Rx, Ry, Rz: about x, y and z",
        ),
        Mistake(
            "degrees in place of radians",
            "np.cos and np.sin want radians, but here they get degrees.",
            _wrong_rotation(lambda angles: rotation(np.degrees(angles))),
            source="thread: stackoverflow.com/q/1237085",
            line="Rx, Ry, Rz: about x, y and z",
        ),
        Mistake(
            "entry by entry",
            "Here * multiplies entry by entry. A product of matrices is written with @.",
            _wrong_rotation(lambda angles: np.prod(list(map(about, range(3), angles)), axis=0)),
            source="thread: matrix multiplication, SciPy-User, January 2012",
        ),
        Mistake(
            "only about x",
            "This turns about x alone. R is a product of three rotations.",
            _wrong_rotation(lambda angles: rotation(angles, (0,))),
            source="study: computation",
        ),
        Mistake(
            "about x left out",
            "The rotation about x is missing in the product.",
            _wrong_rotation(lambda angles: rotation(angles, (1, 2))),
            source="study: computation",
        ),
        Mistake(
            "about z left out",
            "The rotation about z is missing in the product.",
            _wrong_rotation(lambda angles: rotation(angles, (0, 1))),
            source="study: computation",
        ),
        Mistake(
            "all angles of a joint at once",
            "The columns of a joint are alike: all its angles turn at once. Turn angle i, k alone.",
            {"jacobian": _joints_as_in_the_plane},
            parts=(JACOBIAN,),
            source="trial",
            line="turned: the angles, with angle i, k larger by epsilon",
        ),
        Mistake(
            "columns in another order",
            "The columns are in another order: first the three angles of the first joint.",
            {"jacobian": _other_order},
            parts=(JACOBIAN,),
            source="study: array",
        ),
        Mistake(
            "columns written over",
            "Some columns are written twice, others never. How many does each joint need?",
            {"jacobian": _overlapping},
            parts=(JACOBIAN,),
            source="study: array",
        ),
        Mistake(
            "change in another order",
            "The change has other columns than J has: whose angle is the second of them?",
            {"reach": lambda *args: steps_to(*args, shaped=lambda c: c.reshape(3, -1).T)},
            parts=(UPDATE,),
            source="study: array",
        ),
        Mistake(
            "length without z",
            "It stops where x and y are right, but not z. How long is all of e?",
            wrong_steps(near=lambda e: bool(np.linalg.norm(e[:2]) < TOLERANCE)),
            parts=(STOP,),
            source="trial",
        ),
        *reaching_mistakes(),
    ),
    canim_functions=(
        character.jacobian_3d,
        character.numeric_jacobian,
        character.inverse_kinematics,
        character.inverse_kinematics_batch,
    ),
)
