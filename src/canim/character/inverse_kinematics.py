"""From a goal to the angles with which the end effector of a chain reaches it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from canim._arguments import Floats, finite, floats, points, whole_number
from canim.character._chain import chain, place
from canim.character._methods import METHODS, Step, bend, point
from canim.character._poses import Chain, Flat, Space

__all__ = ["IKBatchResult", "IKResult", "inverse_kinematics", "inverse_kinematics_batch"]

Whole = NDArray[np.intp]

# In so many iterations the error must fall to a quarter, or the chain is bent as one.
_PATIENCE = 10

# So is it if the first iteration changes the error by less, in lengths of the chain.
_STILL = 1e-12

# The most that an angle turns from one picture to the next, in radians: below 0.5 by a margin
# for rounding.
_PICTURE = 0.499

# Larger angles, in radians, have too few digits left for small turns.
_LARGEST = 1e6

# Goals are searched in groups of so many angles: their arrays fit the cache of a processor.
_GROUP = 20_000


class IKResult(NamedTuple):
    """What :func:`inverse_kinematics` found.

    Attributes
    ----------
    angles : ndarray, shape (N,) or (N, 3)
        The angles of the last pose in radians.
    positions : ndarray, shape (N + 1, d)
        Its root, joints and end effector.
    error : float
        The distance from its end effector to the goal.
    iterations : int
        How many iterations it took.
    converged : bool
        Whether the error is within the tolerance.
    reachable : bool
        Whether any pose of the chain comes within the tolerance of the goal.
    history : ndarray, shape (steps, N) or (steps, N, 3)
        The angles from the start to the last pose, one entry per picture of a film. No angle
        changes by more than 0.5 radians from entry to entry: where an iteration turns a joint
        by more, entries in between are added.
    """

    angles: Floats
    positions: Floats
    error: float
    iterations: int
    converged: bool
    reachable: bool
    history: Floats


class IKBatchResult(NamedTuple):
    """What :func:`inverse_kinematics_batch` found for G goals.

    Attributes
    ----------
    angles : ndarray, shape (G, N) or (G, N, 3)
        The angles of the last poses in radians.
    positions : ndarray, shape (G, N + 1, d)
        Their roots, joints and end effectors.
    error : ndarray, shape (G,)
        The distance from each end effector to its goal.
    iterations : ndarray of int, shape (G,)
        How many iterations each goal took.
    converged : ndarray of bool, shape (G,)
        Whether the error is within the tolerance.
    reachable : ndarray of bool, shape (G,)
        Whether any pose of the chain comes within the tolerance of the goal.
    """

    angles: Floats
    positions: Floats
    error: Floats
    iterations: Whole
    converged: NDArray[np.bool_]
    reachable: NDArray[np.bool_]


class _Options(NamedTuple):
    step: Step
    tolerance: float
    max_iterations: int
    closest: bool


def inverse_kinematics(
    angles: ArrayLike,
    offsets: ArrayLike,
    goal: ArrayLike,
    *,
    root: ArrayLike | None = None,
    method: str = "pseudoinverse",
    tolerance: float = 1e-5,
    max_iterations: int = 200,
    closest: bool = True,
) -> IKResult:
    r"""Find angles with which the end effector of a chain reaches a goal.

    From the error :math:`\mathbf{e} = \mathbf{g} - \mathbf{p}` between the goal and the end
    effector each iteration finds a change of the angles. With the Jacobian
    :math:`\mathbf{J}` and its pseudoinverse, or with damped least squares, this is

    .. math::

        \Delta\theta = \mathbf{J}^+ \mathbf{e}, \qquad
        \Delta\theta = \mathbf{J}^\mathsf{T}
            (\mathbf{J} \mathbf{J}^\mathsf{T} + \lambda^2 \mathbf{I})^{-1} \mathbf{e}.

    Parameters
    ----------
    angles : array_like, shape (N,) or (N, 3)
        Where to start: in the plane one angle a joint, in space three (about x, y and z), in
        radians.
    offsets : array_like, shape (N, d)
        Each link in the rest pose, from its joint to the next; d is 2 or 3.
    goal : array_like, shape (d,)
        Where the end effector shall come to.
    root : array_like, shape (d,), optional
        The place of the first joint; without it the origin.
    method : {"pseudoinverse", "damped", "ccd", "fabrik"}
        How to come nearer, see Notes.
    tolerance : float, default: 1e-5
        The error that is small enough, in lengths of the chain.
    max_iterations : int, default: 200
        When to give up.
    closest : bool, default: True
        Whether to help the method, see Notes: then a goal out of reach ends in the pose that
        comes closest. False leaves every goal to the bare method.

    Returns
    -------
    IKResult
        ``angles, positions, error, iterations, converged, reachable, history``.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind.
    ValueError
        If shapes do not fit each other, there is no link, a link has no length, a number is not
        finite, an angle is beyond a million radians, `method` is not known, `tolerance` is not
        above 0, `max_iterations` is below 1, or the result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 3.2 <task-3-2>`.

    * ``"pseudoinverse"`` and ``"damped"`` follow the formulas above. A step looks ahead by at
      most a quarter of the chain's length and turns no joint by more than 0.49 radians, as a
      Jacobian is right only nearby. The damping :math:`\lambda^2` is
      :math:`0.02 \, |\mathbf{e}|` where the chain is 1 long: much far from the goal, none at it.
    * ``"ccd"``, cyclic coordinate descent, turns one angle after another, from the end effector
      to the root, each to where the end effector is nearest to the goal.
    * ``"fabrik"`` moves the joints themselves: the end effector to the goal, each joint after
      it at its distance, then the same from the root. The angles are those nearest to the ones
      before whose links point from joint to joint.

    A goal is out of reach if it is farther away than the chain is long, or nearer than one link
    is longer than all others together. With `closest` the chain then points at it, straight or
    folded. It is also helped if the first iteration changes nothing, as in a straight chain
    that points at the goal, or if ten iterations do not quarter the error: then it is unfolded,
    or folded, until its end effector is as far from the root as the goal, and turned to the
    goal as one.

    References
    ----------
    S. R. Buss, *Introduction to Inverse Kinematics with Jacobian Transpose, Pseudoinverse and
    Damped Least Squares Methods*, 2004.

    A. Aristidou, J. Lasenby, Y. Chrysanthou, A. Shamir, *Inverse Kinematics Techniques in
    Computer Graphics: A Survey*, Computer Graphics Forum 37(6), 2018.

    Examples
    --------
    >>> from canim.character import inverse_kinematics
    >>> arm = [(0, 1), (0, 1), (0, 1)]
    >>> result = inverse_kinematics([0.1, 0.2, 0.3], arm, (2, 1))
    >>> result.converged, result.reachable
    (True, True)
    >>> result.positions[-1].round(3)
    array([2., 1.])
    >>> inverse_kinematics([0.1, 0.2, 0.3], arm, (0, 5)).positions.round(9) + 0
    array([[0., 0.],
           [0., 1.],
           [0., 2.],
           [0., 3.]])
    """
    start, links, base = chain(angles, offsets, root)
    target = place(goal, "goal", links.shape[1])
    options = _options(method, tolerance, max_iterations, closest)
    film = [start]
    found = _solve(start[None], links, base, target[None], options, film)
    return IKResult(
        found.angles[0],
        found.positions[0],
        float(found.error[0]),
        int(found.iterations[0]),
        bool(found.converged[0]),
        bool(found.reachable[0]),
        _divided(film),
    )


def inverse_kinematics_batch(
    angles: ArrayLike,
    offsets: ArrayLike,
    goals: ArrayLike,
    *,
    root: ArrayLike | None = None,
    method: str = "pseudoinverse",
    tolerance: float = 1e-5,
    max_iterations: int = 200,
    closest: bool = True,
) -> IKBatchResult:
    """Find angles for many goals at once; much faster than one after another.

    Parameters
    ----------
    angles : array_like, shape (N,), (N, 3), (G, N) or (G, N, 3)
        Where to start, for all goals or for each, in radians.
    offsets : array_like, shape (N, d)
        Each link in the rest pose, from its joint to the next; d is 2 or 3.
    goals : array_like, shape (G, d)
        Where the end effector shall come to, one goal a row.
    root : array_like, shape (d,), optional
        The place of the first joint; without it the origin.
    method : {"pseudoinverse", "damped", "ccd", "fabrik"}
        How to come nearer, see Notes.
    tolerance : float, default: 1e-5
        The error that is small enough, in lengths of the chain.
    max_iterations : int, default: 200
        When to give up.
    closest : bool, default: True
        Whether to help the method, see Notes: then a goal out of reach ends in the pose that
        comes closest. False leaves every goal to the bare method.

    Returns
    -------
    IKBatchResult
        ``angles, positions, error, iterations, converged, reachable``, each with a row for every
        goal. There is no history.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind.
    ValueError
        If shapes do not fit each other, there is no link, a link has no length, a number is not
        finite, an angle is beyond a million radians, `method` is not known, `tolerance` is not
        above 0, `max_iterations` is below 1, or the result does not fit a float.

    See Also
    --------
    inverse_kinematics : The same for one goal, with the methods and a history.

    Notes
    -----
    Theory: :ref:`Task 3.2 <task-3-2>`.

    Examples
    --------
    >>> from canim.character import inverse_kinematics_batch
    >>> arm = [(0, 1), (0, 1), (0, 1)]
    >>> found = inverse_kinematics_batch([0.1, 0.2, 0.3], arm, [(2, 1), (-1, 1), (0, 5)])
    >>> found.converged, found.reachable
    (array([ True,  True, False]), array([ True,  True, False]))
    >>> found.positions[:, -1].round(3) + 0
    array([[ 2.,  1.],
           [-1.,  1.],
           [ 0.,  3.]])
    """
    targets = points(goals, "goals")
    start, links, base = chain(angles, offsets, root, goals=len(targets))
    if targets.shape[1] != links.shape[1]:
        raise ValueError(
            f"goals must hold one point a row, shape (G, {links.shape[1]}) as offsets, "
            f"but has shape {targets.shape}."
        )
    shape = (len(links),) if links.shape[1] == 2 else (len(links), 3)
    starts = np.broadcast_to(start, (len(targets), *shape))
    options = _options(method, tolerance, max_iterations, closest)
    return _solve(starts, links, base, targets, options)


def _options(method: str, tolerance: float, max_iterations: int, closest: bool) -> _Options:
    if not isinstance(method, str) or method not in METHODS:
        *names, last = (f'"{name}"' for name in METHODS)
        raise ValueError(f"method must be {', '.join(names)} or {last}, but is {method!r}.")
    near = floats(tolerance, "tolerance")
    if near.ndim or near <= 0:
        raise ValueError(f"tolerance must be one number above 0, but is {tolerance!r}.")
    if not isinstance(closest, bool | np.bool_):
        raise TypeError(f"closest must be True or False, but is {closest!r}.")
    count = whole_number(max_iterations, "max_iterations", 1)
    return _Options(METHODS[method], float(near), count, bool(closest))


def _solve(
    starts: Floats,
    links: Floats,
    root: Floats,
    goals: Floats,
    options: _Options,
    film: list[Floats] | None = None,
) -> IKBatchResult:
    """Solve where the root is the origin and the chain's length is 1."""
    if np.abs(starts).max() > _LARGEST:
        raise ValueError(
            f"angles must lie between {-_LARGEST:g} and {_LARGEST:g} radians, "
            f"but one is {starts.flat[np.abs(starts).argmax()]:g}."
        )
    with np.errstate(over="ignore"):
        lengths = np.hypot.reduce(links, axis=1)
        size = finite(lengths.sum(), "offsets")
        targets = finite(finite(goals - root, "goal and root") / size, "goal")
    body = (Flat if links.shape[1] == 2 else Space)(lengths / size, links / lengths[:, None])
    distance = np.hypot.reduce(targets, axis=1)
    beyond = distance - 1
    if body.inner > 0:
        beyond = np.maximum(beyond, body.inner - distance)
    # Steps towards goals that are far out of reach do not depend on how far.
    targets = targets * np.minimum(1, 4 / np.maximum(distance, 4))[:, None]

    angles, iterations = starts.copy(), np.zeros(len(goals), dtype=np.intp)
    joints = np.empty((len(goals), len(links) + 1, links.shape[1]))
    group = max(1, _GROUP // starts[0].size)
    for part in (slice(first, first + group) for first in range(0, len(goals), group)):
        found = angles[part], joints[part], iterations[part]
        _search(body, found, targets[part], beyond[part], options, film)
    with np.errstate(over="ignore"):
        positions = finite(root + size * joints, "offsets and root")
        error = finite(np.hypot.reduce(goals - positions[:, -1], axis=1), "goal")
    near = options.tolerance * size
    return IKBatchResult(
        angles, positions, error, iterations, error <= near, beyond <= options.tolerance
    )


def _search(
    body: Chain,
    found: tuple[Floats, Floats, Whole],
    goals: Floats,
    beyond: Floats,
    options: _Options,
    film: list[Floats] | None,
) -> None:
    """Write what is found into angles, joints and iterations; put the poses of one into a film."""
    angles, joints, iterations = found
    # A little less, so that rounding does not undo what was reached.
    tolerance = options.tolerance * (1 - 1e-6)
    outside = options.closest & (beyond > -tolerance / 2)
    left = np.arange(len(goals))
    pose = body.pose(angles, goals)
    earlier = pose.distance
    for count in range(options.max_iterations):
        ended = pose.distance <= tolerance
        if count == 1:
            ended |= outside[left]
        if np.count_nonzero(ended):
            done, stay = left[ended], ~ended
            angles[done], joints[done] = pose.angles[ended], pose.joints[ended]
            iterations[done] = count
            pose, left, earlier = pose.only(stay), left[stay], earlier[stay]
        if not left.size:
            return
        turned = options.step(body, pose)
        if options.closest and (count < 2 or count % _PATIENCE == 0):
            if count == 0:
                helped, help_ = outside[left], point
            elif count == 1:
                helped, help_ = np.abs(pose.distance - earlier) < _STILL, bend
            else:
                helped, help_ = pose.distance > earlier / 4, bend
                earlier = pose.distance
            if np.count_nonzero(helped):
                turned[helped] = help_(body, pose.only(helped))
        pose = body.pose(turned, pose.goals)
        if film is not None:
            film.append(turned[0])
    angles[left], joints[left], iterations[left] = pose.angles, pose.joints, count + 1


def _divided(film: list[Floats]) -> Floats:
    """Divide large turns from one pose to the next into several pictures."""
    poses = np.array(film)
    turns = np.abs(poses[1:] - poses[:-1])
    if turns.max(initial=0) <= _PICTURE:
        return poses
    pictures = [film[0]]
    for before, after, turn in zip(film, film[1:], turns):
        parts = math.ceil(turn.max() / _PICTURE)
        pictures += [before + (after - before) * (k / parts) for k in range(1, parts)]
        pictures.append(after)
    return np.array(pictures)
