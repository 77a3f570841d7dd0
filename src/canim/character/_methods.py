"""One iteration of each way to bring end effectors to their goals, and what helps them all."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from canim._arguments import Floats
from canim.character._poses import Chain, Pose, norm, turned, unit

# Every step returns the next angles.
Step = Callable[[Chain, Pose], Floats]

# The most that an angle turns in one step along a Jacobian, in radians.
_TURN = 0.49

# The farthest that such a step looks ahead, in lengths of the chain.
_AHEAD = 0.25

# So little damping stands for the pseudoinverse where a pose is singular.
_TRACE = 1e-9

# How often `bend` halves its interval, and how often it draws a straight line after that.
_HALVINGS = 10
_LINES = 3


def pseudoinverse(chain: Chain, pose: Pose) -> Floats:
    """Follow the pseudoinverse of the Jacobian."""
    return _follow_jacobian(chain, pose, 0)


def damped(chain: Chain, pose: Pose) -> Floats:
    """Follow the Jacobian with damped least squares, the less damped the nearer the goal."""
    return _follow_jacobian(chain, pose, 0.02)


def _follow_jacobian(chain: Chain, pose: Pose, damping: float) -> Floats:
    ahead = np.minimum(pose.distance, _AHEAD)
    way = pose.way * (ahead / pose.distance)[:, None]
    turns = chain.least_turns(pose, way, damping * ahead + _TRACE)
    most = np.maximum.reduce(np.abs(turns), axis=1, keepdims=True)
    turns *= _TURN / np.maximum(most, _TURN)
    return pose.angles + turns.reshape(pose.angles.shape)


def ccd(chain: Chain, pose: Pose) -> Floats:
    """Turn one angle after another, from the last, to where the goal is nearest."""
    effector = pose.joints[:, -1]
    angles = pose.angles.reshape(len(effector), -1).copy()
    parts = angles.shape[1] // len(chain.lengths)
    for k in reversed(range(angles.shape[1])):
        radius, tangent = chain.circle(pose, k, effector)
        way = pose.goals - pose.joints[:, k // parts]
        turn = np.arctan2((tangent * way).sum(axis=1), (radius * way).sum(axis=1))
        angles[:, k] += turn
        effector = effector + (np.cos(turn) - 1)[:, None] * radius + np.sin(turn)[:, None] * tangent
    return angles.reshape(pose.angles.shape)


def fabrik(chain: Chain, pose: Pose) -> Floats:
    """Pull the joints after the end effector to the goal, then back to the root."""
    joints = pose.joints.copy()
    links = np.diff(joints, axis=1) / chain.lengths[:, None]
    joints[:, -1] = pose.goals
    for k in reversed(range(links.shape[1])):
        direction = unit(joints[:, k + 1] - joints[:, k], links[:, k])
        joints[:, k] = joints[:, k + 1] - chain.lengths[k] * direction
    joints[:, 0] = 0
    for k in range(links.shape[1]):
        links[:, k] = unit(joints[:, k + 1] - joints[:, k], links[:, k])
        joints[:, k + 1] = joints[:, k] + chain.lengths[k] * links[:, k]
    return chain.aimed(pose.angles, links)


METHODS: dict[str, Step] = {
    "pseudoinverse": pseudoinverse,
    "damped": damped,
    "ccd": ccd,
    "fabrik": fabrik,
}


def point(chain: Chain, pose: Pose) -> Floats:
    """Come as close as can be to goals out of reach: straighten or fold along their direction."""
    along = unit(pose.goals, unit(pose.joints[:, -1], chain.directions[0]))
    return chain.extreme(pose.angles, along, norm(pose.goals) > (1 + chain.inner) / 2)


def bend(chain: Chain, pose: Pose) -> Floats:
    """Bend the whole chain until it reaches as far as the goal, and turn it there.

    On the way to the straight pose, or to the folded one, the distance between root and end
    effector takes every value in between; halving, then straight lines, find the right one.
    """
    reach = norm(pose.goals)
    along = unit(pose.goals, chain.directions[0])
    shorter = norm(pose.joints[:, -1]) < reach
    turn = chain.extreme(pose.angles, along, shorter) - pose.angles

    def at(share: Floats) -> tuple[Floats, Floats, Floats]:
        """Return angles and joints at a share of the turn, and how much too far these reach."""
        angles = pose.angles + share.reshape(-1, *[1] * (turn.ndim - 1)) * turn
        joints, _ = chain.bent(angles)
        return angles, joints, norm(joints[:, -1]) - reach

    low, high = np.zeros_like(reach), np.ones_like(reach)
    above, below = at(low)[2], at(high)[2]
    for count in range(_HALVINGS + _LINES):
        fall = np.where(above == below, 1, above - below)
        part = 0.5 if count < _HALVINGS else above / fall
        middle = low + part * (high - low)
        angles, joints, excess = at(middle)
        beyond = (excess < 0) != shorter
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
        above, below = np.where(beyond, above, excess), np.where(beyond, excess, below)
    links = np.diff(joints, axis=1) / chain.lengths[:, None]
    return chain.aimed(angles, turned(links, unit(joints[:, -1], along), along))
