"""Poses of many chains of the same links at once: where they are, how they move, how to aim them.

Arrays begin with the axis of the goals, G. A chain begins at the origin, and its lengths add up
to 1.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from canim._arguments import Floats
from canim.character._chain import accumulated, rotations


@dataclass
class Pose:
    """Angles (G, N) or (G, N, 3), joints (G, N + 1, d), in space also axes (G, 3, N, 3)."""

    angles: Floats
    joints: Floats
    axes: Floats

    def __getitem__(self, chosen: NDArray[np.bool_]) -> Pose:
        return Pose(self.angles[chosen], self.joints[chosen], self.axes[chosen])


class Chain(ABC):
    """Links, given by their lengths (N,) and unit directions (N, d) in the rest pose."""

    def __init__(self, lengths: Floats, directions: Floats) -> None:
        self.lengths = lengths
        self.directions = directions
        self.offsets = lengths[:, None] * directions
        self.inner = max(0.0, 2 * float(lengths.max()) - 1)

    def extreme(self, angles: Floats, along: Floats, far: NDArray[np.bool_]) -> Floats:
        """Return the angles of the pose that ends farthest along (G, d) units, or nearest."""
        directions = np.where(far[:, None, None], self.straight(along), self.folded(along))
        return self.aimed(angles, directions)

    @abstractmethod
    def pose(self, angles: Floats) -> Pose:
        """Bend the chains."""

    @abstractmethod
    def jacobian(self, pose: Pose) -> Floats:
        """Return how the end effectors move with every angle, (G, d, n)."""

    @abstractmethod
    def circle(self, pose: Pose, k: int, effector: Floats) -> tuple[Floats, Floats]:
        """Return radius and tangent of the circle of the end effectors when angle k turns."""

    def straight(self, along: Floats) -> Floats:
        """Return the directions (G, N, d) of a pose that leads straight along (G, d) units."""
        return np.repeat(along[:, None], len(self.lengths), axis=1)

    def folded(self, along: Floats) -> Floats:
        """Return the directions of a pose that ends as near to the root as can be.

        It is a triangle whose middle side is the link at half the length. A link that is longer
        than all others together is that side; the others lie flat on it.
        """
        ends = self.lengths.cumsum()
        middle = int(np.searchsorted(ends, 0.5))
        b = self.lengths[middle]
        a = ends[middle] - b
        c = 1 - ends[middle]
        directions = self.straight(along)
        for side, here, opposite, sign in (
            (slice(middle), a, c, 1),
            (slice(middle + 1, None), c, a, -1),
        ):
            cosine = min(1.0, (here**2 + b**2 - opposite**2) / (2 * here * b)) if here > 0 else 1.0
            sine = sign * math.sqrt(1 - cosine**2)
            directions[:, side] = -(cosine * along + sine * square_to(along))[:, None]
        return directions

    @abstractmethod
    def aimed(self, angles: Floats, directions: Floats) -> Floats:
        """Return those angles near `angles` whose links have the unit directions (G, N, d)."""


class Flat(Chain):
    """Chains in the plane, one angle a joint."""

    def pose(self, angles: Floats) -> Pose:
        joints = np.zeros((len(angles), len(self.offsets) + 1), dtype=complex)
        links = np.exp(1j * angles.cumsum(axis=1)) * as_complex(self.offsets)
        links.cumsum(axis=1, out=joints[:, 1:])
        return Pose(angles, joints.view(float).reshape(*joints.shape, 2), angles)

    def jacobian(self, pose: Pose) -> Floats:
        arms = pose.joints[:, -1:] - pose.joints[:, :-1]
        return np.stack([-arms[..., 1], arms[..., 0]], axis=1)

    def circle(self, pose: Pose, k: int, effector: Floats) -> tuple[Floats, Floats]:
        arm = effector - pose.joints[:, k]
        return arm, arm[:, ::-1] * (-1, 1)

    def aimed(self, angles: Floats, directions: Floats) -> Floats:
        turns = as_complex(directions) / as_complex(self.directions)
        turns[:, 1:] /= turns[:, :-1].copy()
        return unwrapped(np.angle(turns), angles)


class Space(Chain):
    """Chains in space, three angles a joint."""

    def pose(self, angles: Floats) -> Pose:
        frames = accumulated(rotations(angles))
        joints = np.zeros((len(angles), len(self.offsets) + 1, 3))
        links = (frames @ self.offsets[:, :, None])[..., 0]
        links.cumsum(axis=1, out=joints[:, 1:])
        axes = np.empty((len(angles), 3, len(self.offsets), 3))
        axes[:, :, 0, :2] = np.eye(3)[:, :2]
        axes[:, :, 1:, :2] = np.moveaxis(frames[:, :-1, :, :2], 2, 1)
        axes[:, :, :, 2] = np.moveaxis(frames[..., 2], 2, 1)
        # The y axis, turned by Rx; what was the z axis before is its product with the others.
        cosine, sine = np.cos(angles[:, None, :, 0]), np.sin(angles[:, None, :, 0])
        x, y = axes[..., 0], axes[..., 1]
        z = np.stack([cross(x, y, i) for i in range(3)], axis=1)
        axes[..., 1] = cosine * y + sine * z
        return Pose(angles, joints, axes)

    def jacobian(self, pose: Pose) -> Floats:
        arms = np.moveaxis(pose.joints[:, -1:] - pose.joints[:, :-1], 2, 1)[..., None]
        jacobian = np.stack([cross(pose.axes, arms, i) for i in range(3)], axis=1)
        return jacobian.reshape(len(arms), 3, -1)

    def circle(self, pose: Pose, k: int, effector: Floats) -> tuple[Floats, Floats]:
        axis = pose.axes[:, :, k // 3, k % 3]
        arm = effector - pose.joints[:, k // 3]
        tangent = np.stack([cross(axis, arm, i) for i in range(3)], axis=1)
        return np.stack([cross(tangent, axis, i) for i in range(3)], axis=1), tangent

    def aimed(self, angles: Floats, directions: Floats) -> Floats:
        local = rotations(angles)
        before = np.broadcast_to(np.eye(3), (len(angles), 3, 3))
        for k, direction in enumerate(self.directions):
            frame = before @ local[:, k]
            # Of length 1 exactly, or errors would double from link to link.
            start = frame @ direction
            start /= norm(start)[:, None]
            columns = turned(frame.swapaxes(1, 2), start, directions[:, k])
            after = columns.swapaxes(1, 2)
            local[:, k] = before.swapaxes(1, 2) @ after
            before = after
        return euler_angles(local, angles)


def as_complex(points: Floats) -> NDArray[np.complex128]:
    """Return points (..., 2) as numbers x + iy."""
    return points[..., 0] + 1j * points[..., 1]


def cross(a: Floats, b: Floats, i: int) -> Floats:
    """Return component i of the product of vectors whose components are on axis 1."""
    j, k = (i + 1) % 3, (i + 2) % 3
    return a[:, j] * b[:, k] - a[:, k] * b[:, j]


def norm(vectors: Floats) -> Floats:
    """Return the lengths of the vectors on the last axis."""
    lengths: Floats = np.sqrt((vectors * vectors).sum(axis=-1))
    return lengths


def unit(vectors: Floats, otherwise: Floats) -> Floats:
    """Return the vectors at length 1, and `otherwise` for those without a length."""
    length = norm(vectors)[..., None]
    return np.where(length > 0, vectors / np.where(length > 0, length, 1), otherwise)


def turned(vectors: Floats, start: Floats, end: Floats) -> Floats:
    """Turn vectors (G, M, d) by the least rotation that takes `start` to `end`, (G, d) units.

    It is two reflections: in the plane square to `start`, then in that which leads on to `end`.
    """
    middle = start + end
    # Between opposite directions is any that is square to them.
    middle = np.where(norm(middle)[:, None] > 1e-8, middle, square_to(start))
    middle /= norm(middle)[:, None]
    for mirror in (start, middle):
        along = vectors @ mirror[:, :, None]
        vectors = vectors - 2 * along * mirror[:, None]
    return vectors


def square_to(directions: Floats) -> Floats:
    """Return unit vectors square to those given, (G, d)."""
    least = np.eye(directions.shape[1])[np.abs(directions).argmin(axis=1)]
    square: Floats = least - directions * (directions * least).sum(axis=1, keepdims=True)
    return square / norm(square)[:, None]


def unwrapped(angles: Floats, near: Floats) -> Floats:
    """Return the same angles up to whole turns, as near as possible to others."""
    return angles + 2 * np.pi * np.round((near - angles) / (2 * np.pi))


def euler_angles(rotations: Floats, near: Floats) -> Floats:
    """Return for rotations Rx·Ry·Rz (..., 3, 3) the angles (..., 3) nearest to others."""
    r = np.moveaxis(rotations, (-2, -1), (0, 1))
    # With the y angle at a right angle x and z turn about the same axis: x may stay.
    level = np.hypot(r[1, 2], r[2, 2]) > 1e-9
    first = np.where(level, np.arctan2(-r[1, 2], r[2, 2]), near[..., 0])
    found = []
    for a in (first, first + np.pi):
        cosine, sine = np.cos(a), np.sin(a)
        b = np.arctan2(r[0, 2], cosine * r[2, 2] - sine * r[1, 2])
        c = np.arctan2(cosine * r[1, 0] + sine * r[2, 0], cosine * r[1, 1] + sine * r[2, 1])
        found.append(unwrapped(np.stack([a, b, c], axis=-1), near))
    one, other = (np.abs(angles - near).sum(axis=-1, keepdims=True) for angles in found)
    return np.where(one <= other, *found)
