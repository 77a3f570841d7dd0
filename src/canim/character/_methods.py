"""One iteration of each way to bring end effectors to their goals, for many chains at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from canim._arguments import Floats
from canim.character._poses import Chain, Pose, norm, turned, unit

Step = Callable[[Chain, Pose, Floats], Floats]

# The most that an angle turns in one step along a Jacobian: a little below 0.5 radians, which
# no angle may exceed from one picture of a film to the next.
TURN = 0.49

# The farthest, in lengths of the chain, that such a step looks ahead.
_AHEAD = 0.25

# Halving an interval so often leaves what a float cannot tell apart.
_HALVINGS = 52


def pseudoinverse(chain: Chain, pose: Pose, goals: Floats) -> Floats:
    """Follow the pseudoinverse of the Jacobian."""
    return _follow_jacobian(chain, pose, goals, 0)


def damped(chain: Chain, pose: Pose, goals: Floats) -> Floats:
    """Follow the Jacobian with damped least squares, the less damped the nearer the goal."""
    return _follow_jacobian(chain, pose, goals, 0.02)


def _follow_jacobian(chain: Chain, pose: Pose, goals: Floats, damping: float) -> Floats:
    error = goals - pose.joints[:, -1]
    error *= np.minimum(1, _AHEAD / norm(error))[:, None]
    jacobian = chain.jacobian(pose)
    square = jacobian @ jacobian.swapaxes(1, 2)
    diagonal = np.einsum("gii->gi", square)
    # A trace of damping stands for the pseudoinverse where a pose is singular.
    diagonal += (1e-9 * diagonal.sum(axis=1) + damping * norm(error))[:, None]
    weights = np.linalg.solve(square, error[:, :, None])
    turns = (jacobian.swapaxes(1, 2) @ weights)[:, :, 0]
    turns *= (TURN / np.maximum(np.abs(turns).max(axis=1), TURN))[:, None]
    return pose.angles + turns.reshape(pose.angles.shape)


def ccd(chain: Chain, pose: Pose, goals: Floats) -> Floats:
    """Turn one angle after another, from the last, to where the goal is nearest."""
    effector = pose.joints[:, -1]
    angles = pose.angles.reshape(len(goals), -1).copy()
    parts = angles.shape[1] // len(chain.offsets)
    for k in reversed(range(angles.shape[1])):
        radius, tangent = chain.circle(pose, k, effector)
        way = goals - pose.joints[:, k // parts]
        turn = np.arctan2((tangent * way).sum(axis=1), (radius * way).sum(axis=1))
        angles[:, k] += turn
        effector = effector + (np.cos(turn) - 1)[:, None] * radius + np.sin(turn)[:, None] * tangent
    return angles.reshape(pose.angles.shape)


def fabrik(chain: Chain, pose: Pose, goals: Floats) -> Floats:
    """Pull the joints after the end effector to the goal, then back to the root."""
    joints = pose.joints.copy()
    links = np.diff(joints, axis=1) / chain.lengths[:, None]
    joints[:, -1] = goals
    for k in reversed(range(links.shape[1])):
        direction = unit(joints[:, k + 1] - joints[:, k], links[:, k])
        joints[:, k] = joints[:, k + 1] - chain.lengths[k] * direction
    joints[:, 0] = 0
    for k in range(links.shape[1]):
        links[:, k] = unit(joints[:, k + 1] - joints[:, k], links[:, k])
        joints[:, k + 1] = joints[:, k] + chain.lengths[k] * links[:, k]
    return chain.aimed(pose.angles, links)


def point(chain: Chain, pose: Pose, goals: Floats) -> Floats:
    """Come as close as can be to goals out of reach: straighten, or fold, along their direction."""
    distance = norm(goals)
    along = unit(goals, unit(pose.joints[:, -1], chain.directions[0]))
    return chain.extreme(pose.angles, along, distance > (1 + chain.inner) / 2)


def bend(chain: Chain, pose: Pose, goals: Floats) -> Floats:
    """Bend the whole chain, until it is as long as the goal is far, and turn it there.

    On the way to the straight pose, or to the folded one, the distance between root and end
    effector takes every value in between; halving finds the right one.
    """
    distance = norm(goals)
    longer = distance > norm(pose.joints[:, -1])
    along = unit(goals, chain.directions[0])
    shape = (-1, *[1] * (pose.angles.ndim - 1))
    way = chain.extreme(pose.angles, along, longer) - pose.angles
    low, high = np.zeros(len(goals)), np.ones(len(goals))
    for _ in range(_HALVINGS):
        share = (low + high) / 2
        bent = chain.pose(pose.angles + share.reshape(shape) * way)
        beyond = (norm(bent.joints[:, -1]) < distance) != longer
        low, high = np.where(beyond, low, share), np.where(beyond, share, high)
    effector = unit(bent.joints[:, -1], along)
    links = np.diff(bent.joints, axis=1) / chain.lengths[:, None]
    return chain.aimed(bent.angles, turned(links, effector, along))


METHODS: dict[str, Step] = {
    "pseudoinverse": pseudoinverse,
    "damped": damped,
    "ccd": ccd,
    "fabrik": fabrik,
}
