"""What the checks of reaching share: steps towards a goal, right and wrong, and their parts.

Any small angle, step size and tolerance are right. So a Jacobian is compared roughly, a step
by its direction, and a goal counts as reached from `NEAR` on. All that is here works for one
angle a joint and for three.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import character
from canim.checks.run import number
from canim.checks.task import Array, Case, Floats, Mistake, Part, Unusable

# As in the starter; a student may take others.
EPSILON, STEP_SIZE, TOLERANCE = 1e-6, 0.2, 0.01

NEAR = 0.05  # from the goal: more than the tolerance, and much less than the way to it
QUICK = 40  # steps; who gives up before has not tried
LONG = 100  # steps; who takes more does not stop
TOUCHED = 1e-12  # marks a Jacobian of zeros that came from changing what the angles are
GOES_ON, EARLY, LEAVES = 1.0, -1.0, 2.0  # what is wrong with a stop
HUGE = 1e3  # for an entry of a Jacobian: longer than all links together, by far
HARDLY, ROUGHLY = 0.05, 0.01  # of a radian, of a step
SAME_J, SAME_E = 1.0, 2.0  # what all steps have in common that should be new in each


def forward(angles: Floats, offsets: Floats) -> Floats:
    """Return the root, the joints and the end effector."""
    if angles.ndim == 2:
        return character.forward_kinematics_3d(angles, offsets)
    # A check calculates many poses: here without tests for what cannot be wrong.
    total = np.cumsum(angles)
    ways = (offsets[:, 0] + 1j * offsets[:, 1]) * np.exp(1j * total)
    places = np.append(0, np.cumsum(ways))
    return np.stack([places.real, places.imag], axis=1)


def jacobian(angles: Floats, offsets: Floats) -> Floats:
    """Return the Jacobian, with a column for each angle."""
    if angles.ndim == 2:
        return character.jacobian_3d(angles, offsets)
    positions = forward(angles, offsets)
    x, y = (positions[-1] - positions[:-1]).T
    return np.stack([-y, x])


def _pseudoinverse(J: Floats) -> Floats:
    """Return what pinv returns at poses that are not singular, in a third of the time."""
    inverse: Floats = J.T @ np.linalg.inv(J @ J.T)
    return inverse


def _pointing(goal: Floats, p: Floats) -> Floats:
    return goal - p


def _short(e: Floats) -> bool:
    return bool(np.linalg.norm(e) < TOLERANCE)


def steps_to(
    angles: Floats,
    offsets: Floats,
    goal: Floats,
    *,
    of: Callable[[Floats, Floats], Floats] = jacobian,
    place: Callable[[Floats, Floats], Floats] = forward,
    error: Callable[[Floats, Floats], Floats] = _pointing,
    near: Callable[[Floats], bool] = _short,
    inverse: Callable[[Floats], Floats] = _pseudoinverse,
    shaped: Callable[[Floats], Floats] = lambda change: change,
    keep: bool = True,
    in_place: bool = False,
    same_j: bool = False,
    same_e: bool = False,
) -> list[Floats]:
    """Return the poses on the way to a goal, right or in one of the ways that go wrong."""
    poses = [angles]
    e, J = error(goal, place(angles, offsets)[-1]), of(angles, offsets)
    for _ in range(LONG):
        if near(e):
            break
        change = shaped(STEP_SIZE * inverse(J) @ e).reshape(angles.shape)
        angles = angles + change if keep else change
        poses.append(angles)
        e = e if same_e else error(goal, place(angles, offsets)[-1])
        J = J if same_j else of(angles, offsets)
    return [angles] * len(poses) if in_place else poses


def accept_poses(result: Any, angles: Floats, *_: Any) -> Floats:
    """Return the poses as an array, or say what else came."""
    words = "the angles after every step, one pose a row"
    poses = Array(lambda: np.shape(result), words)(result)
    if poses.shape[1:] != angles.shape or len(poses) == 0:
        raise Unusable(f"returns an array of shape {poses.shape}, expected {words}.")
    return poses


def measured(program: Any, *args: Any) -> Floats:
    """Return the student's Jacobian."""
    J: Floats = program.jacobian(*args)
    if not J.any() and "jacobian" in program.changes:
        return J + TOUCHED
    return J


def _first_step(program: Any, angles: Floats, offsets: Floats, goal: Floats) -> Floats:
    """Return the direction of the first step, and 1 if all poses are one and the same."""
    poses: Floats = program.reach(angles, offsets, goal)
    changes = (poses - angles).reshape(len(poses), -1)
    change = next((change for change in changes if change.any()), changes[0])
    alike = len(poses) > 1 and changes[0].any() and not np.ptp(changes, axis=0).any()
    return np.append(change / (np.linalg.norm(change) or 1), float(alike))


def _no_step(got: Floats) -> bool:
    return not got.any()


def _step_in_words(got: Floats, expected: Floats, angles: Floats, *_: Any) -> str:
    if got[-1]:
        return "all poses in the list are the same"
    i = int(np.nanargmax(np.abs(got - expected)))
    entry = ", ".join(str(k) for k in np.unravel_index(i, angles.shape))
    return (
        f"share of angles[{entry}] in the first step: "
        f"expected {number(expected[i])}, got {number(got[i])}"
    )


def _stopped(program: Any, angles: Floats, offsets: Floats, goal: Floats) -> Floats:
    """Return what is wrong with the stop, or 0."""
    end = forward(angles, offsets)[-1]
    if np.array_equal(end, goal):
        ends = _ends(program, angles, offsets)
        tries = [program.reach(angles, offsets, end) for end in ends]
        if any(len(poses) <= 2 for poses in tries):
            return np.array(0.0)
        far = _distance(program, tries[-1][-1], offsets, ends[-1]) > NEAR
        return np.array(LEAVES if far else GOES_ON)
    poses: Floats = program.reach(angles, offsets, goal)
    if _distance(program, poses[-1], offsets, goal) > NEAR:
        if len(poses) < QUICK:
            return np.array(EARLY)
        # Where nothing moves yet, only the goal itself can tell whether there is a stop.
        return np.array(0.0) if (poses != angles).any() else _stopped(program, angles, offsets, end)
    # A wrong Jacobian takes many steps, too, but then the goal was not reached long before.
    late = len(poses) > LONG
    late = late and _distance(program, poses[3 * len(poses) // 4], offsets, goal) < TOLERANCE
    return np.array(GOES_ON if late else 0.0)


def _ends(program: Any, angles: Floats, offsets: Floats) -> list[Floats]:
    """Return where a chain ends, also with the student's R: where it is wrong, a stop can be right.

    A reach that takes its R from elsewhere is right, too.
    """
    ends = [forward(angles, offsets)[-1]]
    if angles.ndim == 2:
        R, p = np.eye(3), np.zeros(3)
        for joint, offset in zip(angles, offsets):
            R = R @ program.rotation(joint)
            p = p + R @ offset
        ends.append(p)
    return ends


def _distance(program: Any, angles: Floats, offsets: Floats, goal: Floats) -> float:
    if not np.isfinite(angles).all():
        return np.inf
    return float(min(np.linalg.norm(goal - end) for end in _ends(program, angles, offsets)))


def _never(got: Floats) -> bool:
    return bool(got == GOES_ON)


def _stop_in_words(got: Floats, expected: Floats, *_: Any) -> str:
    if got == EARLY:
        return "the last pose is still far from the goal"
    if got == LEAVES:
        return "the arm is at the goal when it starts, and leaves it"
    return "the steps go on although the goal is reached"


def _arrived(program: Any, angles: Floats, offsets: Floats, goal: Floats) -> Floats:
    """Return where the end effector arrives, and what is the same in all steps, or 0."""
    poses: Floats = program.reach(angles, offsets, goal)
    if (poses == angles).all():
        return np.full(len(goal) + 1, np.nan)
    if not np.isfinite(poses).all():
        return np.full(len(goal) + 1, np.inf)
    end = min(_ends(program, poses[-1], offsets), key=lambda end: float(np.linalg.norm(goal - end)))
    return np.append(end, _habit(poses, angles, offsets))


def _habit(poses: Floats, angles: Floats, offsets: Floats) -> float:
    changes = np.diff(poses, axis=0)
    changes = changes[changes.reshape(len(changes), -1).any(axis=1)].reshape(-1, poses[0].size)
    # Where the arm hardly moves, arrows and error stay the same in a right loop, too.
    if len(changes) < 5 or np.ptp(poses, axis=0).max() < HARDLY:
        return 0.0
    J = jacobian(angles, offsets)
    steps = changes / np.linalg.norm(changes, axis=1)[:, None]
    # A pseudoinverse of the first arrows gives steps that are mixed of the rows of that J.
    if J.shape[0] < J.shape[1] and np.abs(steps - steps @ _pseudoinverse(J) @ J).max() < ROUGHLY:
        return SAME_J
    first, second = (jacobian(poses[k], offsets) @ changes[k] for k in (0, 1))
    far = np.linalg.norm(first)
    return SAME_E if far > 1e-3 and np.linalg.norm(second - first) < 1e-4 * far else 0.0


def _goal(program: Any, angles: Floats, offsets: Floats, goal: Floats) -> Floats:
    return np.append(goal, 0.0)


def _arrival_in_words(got: Floats, expected: Floats, *_: Any) -> str:
    if got[-1] == SAME_J:
        return "in all steps the arrows are those of the first pose"
    if got[-1] == SAME_E:
        return "all steps go into the same direction"
    if not np.isfinite(got).all():
        return "some angles are not finite numbers"
    end, goal = (", ".join(map(number, point[:-1])) for point in (got, expected))
    return f"the end effector comes to ({end}), but the goal is ({goal})"


def at_the_end(angles: Floats, offsets: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the arguments for a goal where the end effector is already."""
    return angles, offsets, forward(angles, offsets)[-1]


def _backward(angles: Floats, offsets: Floats) -> Floats:
    return -jacobian(angles, offsets)


def _places(angles: Floats, offsets: Floats) -> Floats:
    end = forward(angles, offsets)[-1:].T
    return np.repeat(end, angles.size, axis=1) / EPSILON


def _turned_together(angles: Floats, offsets: Floats) -> Floats:
    J = jacobian(angles, offsets)
    return np.repeat(J.sum(axis=1, keepdims=True), J.shape[1], axis=1)


def _undivided(got: Floats, expected: Floats, *_: Any) -> bool:
    ratio = (got * expected).sum() / (expected * expected).sum()
    return bool(0 < abs(ratio) < 0.01 and np.allclose(got / ratio, expected, atol=0.01))


def wrong_steps(**change: Any) -> dict[str, Any]:
    """Return a program whose steps go wrong in this way."""
    return {"reach": lambda *args: steps_to(*args, **change)}


JACOBIAN, UPDATE, STOP, GOALS = "Jacobian", "update", "stop", "goals reached"


def reaching_parts(
    poses: tuple[Case, ...],
    goals: tuple[Case, ...],
    stops: tuple[Case, ...],
    entry: Callable[..., str],
) -> tuple[Part, ...]:
    """Return the parts of a task about inverse kinematics."""
    return (
        Part(JACOBIAN, measured, poses, entry, unwritten=_no_step, tolerance=1e-3),
        Part(
            UPDATE,
            _first_step,
            goals,
            unwritten=_no_step,
            tolerance=1e-3,
            describe=_step_in_words,
        ),
        Part(
            STOP,
            _stopped,
            stops,
            expected=lambda *_: np.array(0.0),
            unwritten=_never,
            describe=_stop_in_words,
        ),
        Part(
            GOALS, _arrived, goals, expected=_goal, tolerance=NEAR / 2, describe=_arrival_in_words
        ),
    )


def reaching_mistakes() -> tuple[Mistake, ...]:
    """Return the mistakes in a Jacobian and in steps, in the plane and in space."""
    return (
        Mistake(
            "not divided by epsilon",
            "The numbers are very small: how far per radian, not how far for epsilon?",
            {"jacobian": lambda *args: EPSILON * jacobian(*args)},
            _undivided,
            (JACOBIAN,),
            source="study: computation",
        ),
        Mistake(
            "place in place of movement",
            "This is where p is after turning. How far has it moved?",
            {"jacobian": _places},
            parts=(JACOBIAN,),
            source="study: computation",
        ),
        Mistake(
            "jump in place of movement",
            "The numbers are huge: is it the end effector twice, and angle i larger by epsilon?",
            {"jacobian": lambda *args: _places(*args) / 2},
            lambda got, *_: bool(np.abs(got).max() > HUGE),
            (JACOBIAN,),
            source="trial",
        ),
        Mistake(
            "error turned round",
            "The arm moves away from the goal. From where to where must e point?",
            wrong_steps(error=lambda goal, p: p - goal),
            parts=(UPDATE,),
            source="paper: Eq. 13",
            line="error: e, from the end effector to the goal",
        ),
        Mistake(
            "movement turned round",
            "All arrows point backward. Which of the two places comes first in the difference?",
            {"jacobian": _backward, **wrong_steps(of=_backward)},
            parts=(JACOBIAN, UPDATE),
            source="study: computation",
        ),
        Mistake(
            "all joints at once",
            "All columns are alike: here all angles turn at once. Turn angle i alone.",
            {"jacobian": _turned_together},
            parts=(JACOBIAN,),
            source="study: variable",
        ),
        Mistake(
            "not turned back",
            "Each column also has the turns of those before it. Is the angle turned back?",
            {"jacobian": lambda *args: np.cumsum(jacobian(*args), axis=1)},
            parts=(JACOBIAN,),
            source="study: variable",
        ),
        Mistake(
            "second name for the angles",
            "Nothing seems to move: = makes a second name for the same array. Copy it.",
            {"jacobian": lambda *args: np.full_like(jacobian(*args), TOUCHED)},
            lambda got, *_: bool((got == TOUCHED).all()),
            (JACOBIAN,),
            source="thread: strange behaviour with numpy arrays, numpy-discussion, September 2013",
        ),
        Mistake(
            "transposed Jacobian",
            "J.T is not an inverse. Which function makes the pseudoinverse?",
            wrong_steps(inverse=np.transpose),
            parts=(UPDATE,),
            source="neighbour: the method of the transposed Jacobian, Buss 2004",
        ),
        Mistake(
            "old angles forgotten",
            "The new angles are only the change. What must it be added to?",
            wrong_steps(keep=False),
            parts=(UPDATE,),
            source="study: computation",
        ),
        Mistake(
            "poses changed in place",
            "The list holds one array many times, and += changes it. Make a new array.",
            wrong_steps(in_place=True),
            lambda got, *_: bool(got[-1]),
            (UPDATE,),
            source="thread: Python lists in combination with NumPy arrays, SciPy-User, 2010",
            line="put the angles into the list of poses",
        ),
        Mistake(
            "stop turned round",
            "It stops far from the goal, and goes on at the goal. Is the sign < turned round?",
            wrong_steps(near=lambda e: not _short(e)),
            parts=(STOP,),
            source="study: condition",
        ),
        Mistake(
            "error without its length",
            "A negative number is smaller than the tolerance, too. How long is e?",
            wrong_steps(near=lambda e: bool(e.max() < TOLERANCE)),
            parts=(STOP,),
            source="study: condition",
        ),
        Mistake(
            "sum of the error",
            "Parts of e can cancel each other in a sum. How long is e?",
            wrong_steps(near=lambda e: bool(e.sum() < TOLERANCE)),
            parts=(STOP,),
            source="study: condition",
        ),
        Mistake(
            "only one coordinate of the error",
            "It stops as soon as one coordinate is right. How long is e?",
            wrong_steps(near=lambda e: bool(np.abs(e).min() < TOLERANCE)),
            parts=(STOP,),
            source="study: condition",
        ),
        Mistake(
            "Jacobian computed once",
            "The arm is another one after each step. When do you measure its arrows?",
            wrong_steps(same_j=True),
            lambda got, *_: bool(got[-1] == SAME_J),
            (GOALS,),
            source="study: loop",
        ),
        Mistake(
            "error computed once",
            "e must be new after each step. When do you calculate it, and is p the end effector?",
            wrong_steps(same_e=True),
            lambda got, *_: bool(got[-1] == SAME_E),
            (GOALS,),
            source="study: loop",
            line="error: e, from the end effector to the goal",
        ),
    )
