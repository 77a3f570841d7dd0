"""Task 1.8: what "done" means for smooth joints, a closed shape and its copy.

The student's shape is judged by its joints: what each asks for follows from the shape.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import PATH
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task, Unusable

POINTS = np.array([[5.0, -10.0], [13.0, -2.0], [5.0, 20.0], [25.0, 20.0]])
STAY = np.array([0.0, 0.0])
RIGHT = np.array([10.0, 0.0])
AWAY = np.array([-3.0, 4.0])

# A shape without a kink: the paper's, with (6, -2) where the old material has (6, 0).
SMOOTH = np.array(
    [
        POINTS,
        [[25, 20], [45, 20], [35, -2], [43, -10]],
        [[43, -10], [51, -18], [20, -18], [13, -10]],
        [[13, -10], [6, -2], [-3, -18], [5, -10]],
    ]
)
JOINTS = ("joint 1 to 2", "joint 2 to 3", "joint 3 to 4", "joint 4 to 1")
MOVED = ("move", "scale, turn, move")


def _segments(result: Any) -> Floats:
    words = "four segments, each with four points, each with x and y"
    segments = Array(lambda: (4, 4, 2), words)(result)
    for number, P in enumerate(segments, 1):
        if np.array_equal(P[0], P[1]) or np.array_equal(P[2], P[3]):
            raise Unusable(
                f"returns a handle of segment {number} that lies on its end point: "
                "without a length it has no direction."
            )
    return segments


def _next_handle(program: Any, second_last: Floats, last: Floats) -> Floats:
    handle: Floats = program.next_handle(second_last, last)
    return handle


def _at_joint(segments: Floats, joint: int) -> tuple[Floats, Floats]:
    """Return two points and their handles: those that are free, and those that depend on them.

    At the last joint it is the end of segment 4 that depends on the start of segment 1.
    """
    if joint == 3:
        free, dependent = segments[0, :2], segments[3, [3, 2]]
    else:
        free, dependent = segments[joint, [3, 2]], segments[joint + 1, :2]
    if np.isnan(free).any() or np.isnan(dependent).any():
        return np.full((2, 2), np.nan), np.full((2, 2), np.nan)
    return free, dependent


def _joint(program: Any, joint: int) -> Floats:
    return _at_joint(program.closed_shape(), joint)[1]


def _smooth_joint(program: Any, joint: int) -> Floats:
    """Return what the joint needs, or what is there if it is that.

    A joint that follows the student's own next handle is right: a wrong one is told once.
    """
    (point, handle), dependent = _at_joint(program.closed_shape(), joint)
    smooth = np.array([point, 2 * point - handle])
    # Points may be written with a few decimals: what bends by a third of a degree is smooth.
    near = 0.005 * np.linalg.norm(handle - point)
    if np.isnan(point).any() or np.abs(dependent - smooth).max() < near:
        return dependent
    own = np.array([point, program.next_handle(handle, point)])
    return dependent if np.abs(dependent - own).max() < near else smooth


def _point_of_joint(index: tuple[int, ...], joint: int) -> str:
    if joint == 3:
        what = ("end of segment 4", "last handle of segment 4")[index[0]]
    else:
        what = ("start", "first handle")[index[0]] + f" of segment {joint + 2}"
    return f"{what}, {'xy'[index[1]]}"


def _transformed(program: Any, points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    result: Floats = program.transform(points, scale, angle, move)
    return result


def _whole(program: Any, points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    """Return the transformed points, or nan where scale or move alone are not right."""
    unturned = _transformed(program, points, scale, 0.0, move)
    if not _same(unturned, scale * points + move):
        return np.full_like(points, np.nan)
    return _transformed(program, points, scale, angle, move)


def _moved(program: Any, points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    moved: Floats = _transformed(program, points, scale, angle, move)
    return moved - _transformed(program, points, scale, angle, STAY)


def _nothing(got: Floats) -> bool:
    return bool(np.isnan(got).all() or (got == 0).all())


def _coordinate(index: tuple[int, ...], *args: Any) -> str:
    return f"{'xy'[index[-1]]} of point {index[0] + 1}"


def _xy(index: tuple[int, ...], *args: Any) -> str:
    return "xy"[index[-1]]


def _same(a: Floats, b: Floats) -> bool:
    return bool(np.allclose(a, b, rtol=0, atol=1e-6 * max(1.0, float(np.abs(b).max()))))


def _gap(got: Floats, expected: Floats, joint: int) -> bool:
    return not _same(got[0], expected[0])


def _copied(got: Floats, expected: Floats, joint: int) -> bool:
    return _same(got[0], expected[0]) and _same(got[1] - got[0], expected[0] - expected[1])


def _other_length(got: Floats, expected: Floats, joint: int) -> bool:
    a, b = got[1] - got[0], expected[1] - expected[0]
    across, along = a[0] * b[1] - a[1] * b[0], a @ b
    return _same(got[0], expected[0]) and bool(along > 0 and abs(across) < 1e-6 * along)


def _free(got: Floats, expected: Floats, joint: int) -> bool:
    known = (_gap, _copied, _other_length)
    return not any(applies(got, expected, joint) for applies in known)


def _shape(
    *changes: tuple[tuple[int, int], tuple[float, float]],
) -> dict[str, Callable[[], Floats]]:
    """Return a program with points of the smooth shape changed."""
    segments = SMOOTH.copy()
    for place, point in changes:
        segments[place] = point
    return {"closed_shape": lambda: segments}


def _only_x_goes_on(second_last: Floats, last: Floats) -> Floats:
    return np.array([2 * last[0] - second_last[0], second_last[1]])


def _transform(change: Callable[..., Floats]) -> dict[str, Callable[..., Floats]]:
    return {"transform": change}


def _y_stays(points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    return interpolation.transform_points(points, scale, angle, (move[0], 0))


def _x_for_both(points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    return interpolation.transform_points(points, scale, angle, (move[0], move[0]))


def _scaled_last(points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    return interpolation.transform_points(points + move, scale, angle)


def _turned_last(points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    return interpolation.transform_points(scale * points + move, 1, angle)


def _only_x_scaled(points: Floats, scale: float, angle: float, move: Floats) -> Floats:
    return interpolation.transform_points(points * [scale, 1], 1, angle, move)


TASK = Task(
    id="1.8",
    name="plot_bezier_segments",
    title="Join curves to a smooth shape",
    block="interpolation",
    writes="a handle, two segments and a transformation, about 8 lines",
    minutes=55,
    figure="Fig. 5",
    questions=3,
    builds_on=("1.6", "1.7"),
    functions=(
        Function(
            "next_handle",
            "next_handle(second_last, last)",
            Array(lambda second_last, last: (2,), "one point with x and y"),
            interpolation.next_control_point,
        ),
        Function("closed_shape", "closed_shape()", _segments),
        Function(
            "transform",
            "transform(points, scale, angle, move)",
            Array(lambda points, *_: points.shape, "one row per point, with x and y"),
            interpolation.transform_points,
        ),
    ),
    parts=(
        Part(
            "next handle",
            _next_handle,
            (
                Case((POINTS[2], POINTS[3]), "after (5, 20) and (25, 20)"),
                Case(
                    (np.array([35.0, -2.0]), np.array([43.0, -10.0])),
                    "after (35, -2) and (43, -10)",
                ),
                Case((np.array([1.0, 2.0]), np.array([0.0, 0.0])), "after (1, 2) and (0, 0)"),
            ),
            _xy,
        ),
        *(
            Part(
                name,
                _joint,
                (Case((joint,)),),
                _point_of_joint,
                expected=_smooth_joint,
                picture=PATH,
            )
            for joint, name in enumerate(JOINTS)
        ),
        Part(
            "scale",
            _transformed,
            (
                Case((POINTS, 0.5, 0.0, STAY), "scale 0.5"),
                Case((POINTS, 3.0, 0.0, STAY), "scale 3"),
            ),
            _coordinate,
            picture=PATH,
        ),
        Part(
            "move",
            _moved,
            (
                Case((POINTS, 0.5, 0.0, RIGHT), "scale 0.5, move (10, 0), way moved"),
                Case((POINTS, 3.0, 0.0, AWAY), "scale 3, move (-3, 4), way moved"),
            ),
            _coordinate,
            unwritten=_nothing,
        ),
        Part(
            "scale, turn, move",
            _whole,
            (
                Case((POINTS, 2.0, 0.7, AWAY), "scale 2, angle 0.7, move (-3, 4)"),
                Case((POINTS, 0.5, -2.0, -AWAY), "scale 0.5, angle -2, move (3, -4)"),
            ),
            _coordinate,
            picture=PATH,
        ),
    ),
    lines={
        "next handle": "next handle: go from second_last to last, then the same way once more",
        "joint 1 to 2": (
            "joint 1 to 2: segment 2 starts where segment 1 ends, with the next "
            "handle; then come two free points"
        ),
        "joint 2 to 3": "joint 2 to 3: the same for segment 3",
        "joint 3 to 4": "joint 3 to 4: the same for segment 4",
        "joint 4 to 1": (
            "joint 4 to 1: segment 4 ends where segment 1 starts; its last handle "
            "is found from the first handle of segment 1, as a next handle is"
        ),
        "scale": "scale: multiply x and y",
        "move": "move: add to x and to y",
        "scale, turn, move": "turn by the angle",
    },
    mistakes=(
        Mistake(
            "handle copied",
            "This handle lies back on the curve. In which direction must the next one go on?",
            {"next_handle": lambda second_last, last: second_last},
            parts=("next handle",),
            source="study: concept",
        ),
        Mistake(
            "mirrored about the wrong point",
            "You go on from the wrong one of the two points: the joint is at last.",
            {"next_handle": lambda second_last, last: 2 * second_last - last},
            parts=("next handle",),
            source="study: variable",
        ),
        Mistake(
            "mirrored about the origin",
            "This goes through (0, 0). The way must go through the joint, which is at last.",
            {"next_handle": lambda second_last, last: -second_last},
            parts=("next handle",),
            source="study: concept",
        ),
        Mistake(
            "the joint itself",
            "This is the joint itself. The handle lies further on: which way, and how far?",
            {"next_handle": lambda second_last, last: last},
            parts=("next handle",),
            source="study: variable",
        ),
        Mistake(
            "only x goes on",
            "Only x goes on. What has y to do in the next handle?",
            {"next_handle": _only_x_goes_on},
            parts=("next handle",),
            source="study: computation",
        ),
        Mistake(
            "way instead of point",
            "This is only the way from one point to the other. From where does it start?",
            {"next_handle": lambda second_last, last: last - second_last},
            parts=("next handle",),
            source="study: concept",
        ),
        Mistake(
            "gap",
            "There is a gap: the two segments share no point at this joint.",
            _shape(((2, 0), (40.0, -10.0))),
            _gap,
            JOINTS[:3],
            source="authors",
        ),
        Mistake(
            "not closed",
            "The shape is open: where must segment 4 end?",
            _shape(((3, 3), (8.0, -12.0))),
            _gap,
            JOINTS[3:],
            source="authors",
        ),
        Mistake(
            "handle copied at a joint",
            "Both handles lie on the same side of this joint, so the curve turns back.",
            _shape(((3, 1), (20.0, -18.0))),
            _copied,
            JOINTS,
            source="study: concept",
        ),
        Mistake(
            "other length",
            "The direction is right, the length is not: a train would change its speed at once.",
            _shape(((2, 1), (47.0, -14.0))),
            _other_length,
            JOINTS,
            source="authors",
        ),
        Mistake(
            "kink",
            "This handle is not free: the handle before it decides where it goes.",
            _shape(((3, 1), (6.0, 0.0))),
            _free,
            JOINTS[:3],
            source="matlab: the joint at (13, -10) is kinked",
        ),
        Mistake(
            "last handle chosen freely",
            "The last handle is not free: look at the first handle of segment 1.",
            _shape(((3, 2), (-3.0, -10.0))),
            _free,
            JOINTS[3:],
            source="matlab: the joint at (13, -10) is kinked",
        ),
        Mistake(
            "moved before scaling",
            "The move is scaled as well: in which order must the two come?",
            _transform(_scaled_last),
            parts=MOVED,
            source="study: computation",
            line="scale: multiply x and y",
        ),
        Mistake(
            "moved before turning",
            "The move is turned as well: write it below the line that turns.",
            _transform(_turned_last),
            parts=MOVED,
            source="study: computation",
            line="turn by the angle",
        ),
        Mistake(
            "y not moved",
            "Only x is moved. What has y to do?",
            _transform(_y_stays),
            parts=MOVED,
            source="study: computation",
            line="move: add to x and to y",
        ),
        Mistake(
            "same move for x and y",
            "x and y are moved by the same number, but the move has two.",
            _transform(_x_for_both),
            parts=MOVED,
            source="study: array",
            line="move: add to x and to y",
        ),
        Mistake(
            "only x scaled",
            "Is y scaled as well?",
            _transform(_only_x_scaled),
            parts=("scale", *MOVED),
            source="study: computation",
            line="scale: multiply x and y",
        ),
    ),
    canim_functions=(interpolation.next_control_point, interpolation.transform_points),
)
