"""Task 3.1: what "done" means for a rotation and for the joints of a chain."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import character
from canim.checks.picture import CHAIN
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task


def rotation(angle: float) -> Floats:
    """Return the matrix that turns by an angle in radians, counter-clockwise."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def translation(offset: Floats) -> Floats:
    """Return the matrix that moves by an offset."""
    return np.array([[1.0, 0.0, offset[0]], [0.0, 1.0, offset[1]], [0.0, 0.0, 1.0]])


def _turn_then_move(R: Floats, Z: Floats) -> Floats:
    product: Floats = R @ Z
    return product


def _move_then_turn(R: Floats, Z: Floats) -> Floats:
    product: Floats = Z @ R
    return product


def chain(
    angles: Floats,
    offsets: Floats,
    *,
    turn: Callable[[float], Floats] = rotation,
    first: Callable[[Floats, Floats], Floats] = _turn_then_move,
    link: Callable[[Floats, Floats], Floats] = _turn_then_move,
    join: Callable[[Floats, Floats, Floats], Floats] = lambda T, new, start: T @ new,
    angle_of: Callable[[int], int] = lambda i: i,
    offset_of: Callable[[int], int] = lambda i: i,
    row: int = 0,
    links: Callable[[int], int] = lambda count: count,
) -> Floats:
    """Return the positions of a chain, right or in one of the ways in which it goes wrong.

    `join(T, new, start)` gets the product so far, the new link and the first link.
    """
    positions = np.full((len(angles) + 1, 2), np.nan)
    positions[0] = 0, 0
    T = start = first(turn(angles[0]), translation(offsets[0]))
    positions[1] = T[:2, 2]
    for i in range(1, min(links(len(angles)), len(angles))):
        new = link(turn(angles[angle_of(i)]), translation(offsets[offset_of(i)]))
        T = join(T, new, start)
        positions[i + 1] = T[row, :2] if row else T[:2, 2]
    return positions


def _placed_one_after_the_other(angles: Floats, offsets: Floats) -> Floats:
    steps = [rotation(angle)[:2, :2] @ offset for angle, offset in zip(angles, offsets)]
    return np.vstack([[0, 0], np.cumsum(steps, axis=0)])


def _first_link_twice(angles: Floats, offsets: Floats) -> Floats:
    again = np.append(angles[0], angles), np.vstack([offsets[0], offsets])
    positions = chain(*again)[1:]
    positions[0] = 0, 0
    return positions


def _row_too_early(angles: Floats, offsets: Floats) -> Floats:
    positions = chain(angles, offsets)
    positions[1:-1] = positions[2:]
    positions[-1] = np.nan
    return positions


def _wrong_rotation(turn: Callable[[float], Floats]) -> dict[str, Any]:
    return {"rotation": turn, "forward_kinematics": _chain(turn=turn)}


def _chain(**change: Any) -> Callable[[Floats, Floats], Floats]:
    return lambda angles, offsets: chain(angles, offsets, **change)


def _wrong_chain(**change: Any) -> dict[str, Any]:
    return {"forward_kinematics": _chain(**change)}


def _without_minus(angle: float) -> Floats:
    R = rotation(angle)
    R[0, 1] = -R[0, 1]
    return R


def _entry(index: tuple[int, ...], *args: Any) -> str:
    return f"row {index[0]}, column {index[1]} of R"


def _coordinate(index: tuple[int, ...], *args: Any) -> str:
    row, column = index
    return f"{'xy'[column]} of " + (f"the end of link {row}" if row else "the root")


def _unturned(R: Floats) -> bool:
    return np.array_equal(R, np.eye(3)) or bool(np.isnan(R).all())


def _only_the_first(positions: Floats) -> bool:
    return bool(np.isnan(positions[2:]).all())


def _pose(*degrees: float) -> Case:
    angles = np.radians(np.array(degrees, dtype=float))
    offsets = np.array([[0.0, 1.0]] * len(degrees))
    return Case((angles, offsets), f"angles ({', '.join(f'{d:g}' for d in degrees)})°")


def _other(seed: int, count: int) -> Case:
    """Return a chain of any length whose links rest in different directions."""
    random = np.random.default_rng(seed)
    angles, offsets = random.uniform(-2, 2, count), random.uniform(0.3, 1.5, (count, 2))
    return Case((angles, offsets), f"a chain of {count} links")


ROTATION, JOINTS, CHAINS = "rotation", "next joints", "chains of other lengths"
BOTH = (JOINTS, CHAINS)

TASK = Task(
    id="3.1",
    name="plot_skeleton",
    title="Bend an arm with a few angles",
    block="character",
    writes="a rotation matrix and a product of matrices, about 7 lines",
    minutes=40,
    figure="Fig. 11",
    questions=3,
    functions=(
        Function(
            "rotation",
            "rotation(angle)",
            Array(lambda angle: (3, 3), "a matrix of three rows and three columns"),
            rotation,
        ),
        Function(
            "forward_kinematics",
            "forward_kinematics(angles, offsets)",
            Array(
                lambda angles, offsets: (len(angles) + 1, 2),
                "the root and the end of each link, one row each",
            ),
            chain,
        ),
    ),
    parts=(
        Part(
            ROTATION,
            lambda program, angle: program.rotation(angle),
            tuple(Case((float(np.radians(d)),), f"{d}°") for d in (35, -70, 160)),
            _entry,
            unwritten=_unturned,
        ),
        Part(
            JOINTS,
            lambda program, *args: program.forward_kinematics(*args),
            (_pose(-70, 0, 35), _pose(160, -40, 95), _pose(0, 0, 0)),
            _coordinate,
            unwritten=_only_the_first,
            picture=CHAIN,
        ),
        Part(
            CHAINS,
            lambda program, *args: program.forward_kinematics(*args),
            (_other(1, 4), _other(2, 7), _other(3, 2)),
            _coordinate,
            unwritten=_only_the_first,
            picture=CHAIN,
        ),
    ),
    lines={
        "rotation": "return R, the matrix that turns by this angle",
        "next joints": "T times its R times its Z is the new T",
        "chains of other lengths": "next joints: for each further joint",
    },
    mistakes=(
        Mistake(
            "rotation not written",
            "The chain stays straight, for R does not turn. Write rotation first.",
            {"rotation": lambda angle: np.eye(3), **_wrong_chain(turn=lambda angle: np.eye(3))},
            parts=BOTH,
            source="authors",
            line="return R, the matrix that turns by this angle",
        ),
        Mistake(
            "radians of radians",
            "The angle is in radians already. Which line converts it again?",
            _wrong_rotation(lambda angle: rotation(np.radians(angle))),
            source="thread: stackoverflow.com/q/1237085",
        ),
        Mistake(
            "degrees",
            "np.cos and np.sin want radians, but here they get degrees.",
            _wrong_rotation(lambda angle: rotation(np.degrees(angle))),
            source="thread: stackoverflow.com/q/1237085",
        ),
        Mistake(
            "clockwise",
            "This turns clockwise. Which of the two sines has the minus sign?",
            _wrong_rotation(lambda angle: rotation(-angle)),
            source="study: computation",
        ),
        Mistake(
            "no minus sign",
            "The first row and the second row are not alike. Where is a minus sign?",
            _wrong_rotation(_without_minus),
            source="study: computation",
        ),
        Mistake(
            "sine and cosine exchanged",
            "An angle of 0 must not turn at all. What are its sine and its cosine?",
            _wrong_rotation(lambda angle: rotation(np.pi / 2 - angle)),
            source="study: computation",
        ),
        Mistake(
            "whole numbers",
            "R has only whole numbers, and what you put in is cut off. Start with np.eye(3).",
            _wrong_rotation(lambda angle: np.trunc(rotation(angle))),
            source="thread: floats in an integer array, numpy-discussion, May 2012",
        ),
        Mistake(
            "moved, then turned",
            "Z R moves first and turns then: the new link does not turn. Which order is T?",
            _wrong_chain(link=_move_then_turn),
            source="study: computation",
        ),
        Mistake(
            "moved, then turned, also at the first joint",
            "In all links R and Z stand in the wrong order, also in the first one.",
            _wrong_chain(first=_move_then_turn, link=_move_then_turn),
            source="study: computation",
            line="first joint: T is its R times its Z",
        ),
        Mistake(
            "new link on the left",
            "The new link stands to the left of T. It starts where the chain ends so far.",
            _wrong_chain(join=lambda T, new, start: new @ T),
            source="study: computation",
        ),
        Mistake(
            "next joints not turned",
            "The next links go straight on: they are moved, but not turned. Where is their R?",
            _wrong_chain(link=lambda R, Z: Z),
            source="trial",
        ),
        Mistake(
            "links not joined",
            "Each link starts at the root again. What became of the links before it?",
            _wrong_chain(join=lambda T, new, start: new),
            source="study: variable",
        ),
        Mistake(
            "only joined to the first",
            "Each link starts at the end of the first one. Does T grow in your loop?",
            _wrong_chain(join=lambda T, new, start: start @ new),
            source="study: loop",
        ),
        Mistake(
            "only its own angle",
            "Each link turns by its own angle alone. The joints before it must turn it too.",
            {"forward_kinematics": _placed_one_after_the_other},
            source="study: concept",
        ),
        Mistake(
            "offset of the link before",
            "A link has the length of the link before it. Which offset belongs to joint i?",
            _wrong_chain(offset_of=lambda i: i - 1),
            parts=(CHAINS,),
            source="study: array",
        ),
        Mistake(
            "always the first offset",
            "All links are as long as the first one. Which offset belongs to joint i?",
            _wrong_chain(offset_of=lambda i: 0),
            parts=(CHAINS,),
            source="study: array",
        ),
        Mistake(
            "angle of the joint before",
            "A joint turns by the angle of the joint before it. Which angle belongs to joint i?",
            _wrong_chain(angle_of=lambda i: i - 1),
            source="study: array",
        ),
        Mistake(
            "always the first angle",
            "All joints turn by the first angle. Which angle belongs to joint i?",
            _wrong_chain(angle_of=lambda i: 0),
            source="study: array",
        ),
        Mistake(
            "first link twice",
            "Your loop uses the first link again. With which number must it start?",
            {"forward_kinematics": _first_link_twice},
            source="study: loop",
            line="next joints: for each further joint",
        ),
        Mistake(
            "all of the joint before",
            "Your loop is one link behind: which angle and which offset belong to joint i?",
            _wrong_chain(angle_of=lambda i: i - 1, offset_of=lambda i: i - 1),
            source="study: array",
            line="next joints: for each further joint",
        ),
        Mistake(
            "row too early",
            "Each position is one row too early: row 0 is the root, row 1 the first link.",
            {"forward_kinematics": _row_too_early},
            source="study: array",
            line="position: the last column of T",
        ),
        Mistake(
            "position from a row, or products of numbers",
            "The position is in the last column of T, not in its row. And @ multiplies matrices.",
            _wrong_chain(row=2),
            source="thread: matrix multiplication, SciPy-User, January 2012",
            line="position: the last column of T",
        ),
        Mistake(
            "last link left out",
            "The last link is missing: where does your loop end? Is return behind it, not in it?",
            _wrong_chain(links=lambda count: count - 1),
            source="study: loop",
            line="next joints: for each further joint",
        ),
        Mistake(
            "three links only",
            "This works for three links only. Where in your program is the number of links?",
            _wrong_chain(links=lambda count: 3),
            parts=(CHAINS,),
            source="matlab: written for a fixed number of points",
            line="next joints: for each further joint",
        ),
    ),
    canim_functions=(character.forward_kinematics_2d, character.joint_transforms),
)
