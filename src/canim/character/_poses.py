"""Poses of many chains of the same links at once: where they are, how they move, how to aim them.

Arrays begin with the axis of the goals, G. A chain begins at the origin, and its lengths add up
to 1.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from canim._arguments import Floats
from canim.character._chain import accumulated, rotations

Truths = NDArray[np.bool_]


class Pose(NamedTuple):
    """Chains that have been bent, and what is left to their goals.

    Frames are what else the pose has shown: in the plane the joints as complex numbers, in space
    the accumulated rotations (G, N + 1, 3, 3).
    """

    angles: Floats  # (G, N) or (G, N, 3)
    joints: Floats  # (G, N + 1, d)
    frames: NDArray[Any]
    goals: Floats  # (G, d)
    way: Floats  # (G, d)
    distance: Floats  # (G,)

    def only(self, chosen: Truths) -> Pose:
        """Return the poses of some goals."""
        numbers = np.flatnonzero(chosen)
        return Pose(*(values.take(numbers, axis=0) for values in self))


class Chain(ABC):
    """Links, given by their lengths (N,) and unit directions (N, d) in the rest pose."""

    def __init__(self, lengths: Floats, directions: Floats) -> None:
        self.lengths = lengths
        self.directions = directions
        # The distance from the root that the end effector cannot fall below.
        self.inner = max(0.0, 2 * float(lengths.max()) - 1)

    def pose(self, angles: Floats, goals: Floats) -> Pose:
        """Bend the chains."""
        joints, frames = self.bent(angles)
        way = goals - joints[:, -1]
        return Pose(angles, joints, frames, goals, way, norm(way))

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
        a, c = ends[middle] - b, 1 - ends[middle]
        # Where the height on the middle side stands, and how long it is (Heron).
        foot = (a**2 + b**2 - c**2) / (2 * b)
        height = math.sqrt(max(0.0, (0.5 - a) * (0.5 - b) * (0.5 - c) / 2)) * 2 / b
        across = height * square_to(along)
        directions = self.straight(along)
        directions[:, :middle] = unit(-foot * along - across, along)[:, None]
        directions[:, middle + 1 :] = unit((foot - b) * along + across, along)[:, None]
        return directions

    def extreme(self, angles: Floats, along: Floats, far: Truths) -> Floats:
        """Return the angles of the pose that ends farthest along (G, d) units, or nearest."""
        directions = np.where(far[:, None, None], self.straight(along), self.folded(along))
        return self.aimed(angles, directions)

    @abstractmethod
    def bent(self, angles: Floats) -> tuple[Floats, NDArray[Any]]:
        """Return the joints and the frames."""

    @abstractmethod
    def least_turns(self, pose: Pose, way: Floats, damping: Floats) -> Floats:
        r"""Return the damped least squares :math:`J^T (J J^T + \lambda^2 I)^{-1} e`.

        The ways e are (G, d), the damping factors :math:`\lambda^2` are (G,), the turns (G, n).
        """

    @abstractmethod
    def circle(self, pose: Pose, k: int, effector: Floats) -> tuple[Floats, Floats]:
        """Return radius and tangent of the circle of the end effectors when angle k turns."""

    @abstractmethod
    def aimed(self, angles: Floats, directions: Floats) -> Floats:
        """Return those angles near `angles` whose links have the unit directions (G, N, d)."""


class Flat(Chain):
    """Chains in the plane, one angle a joint."""

    def __init__(self, lengths: Floats, directions: Floats) -> None:
        super().__init__(lengths, directions)
        self.turns = as_complex(directions)
        self.links = lengths * self.turns

    def bent(self, angles: Floats) -> tuple[Floats, NDArray[Any]]:
        links = 1j * np.add.accumulate(angles, axis=1)
        np.exp(links, out=links)
        links *= self.links
        joints = np.zeros((len(links), links.shape[1] + 1), dtype=complex)
        np.add.accumulate(links, axis=1, out=joints[:, 1:])
        return joints.view(float).reshape(*joints.shape, 2), joints

    def least_turns(self, pose: Pose, way: Floats, damping: Floats) -> Floats:
        # In complex numbers the columns of J are i times the arms, and 2 (J Jᵀ + λ² I) w is
        # s w - t w̄, which is 2 e.
        arms = pose.frames[:, -1:] - pose.frames[:, :-1]
        mirrored = arms.conj()
        s = np.vecdot(arms, arms).real + 2 * damping
        t = np.vecdot(mirrored, arms)
        e = way.view(complex)[:, 0]
        w = 2 * (s * e + t * e.conj()) / (s * s - (t * t.conj()).real)
        turns: Floats = (mirrored * w[:, None]).imag
        return turns

    def circle(self, pose: Pose, k: int, effector: Floats) -> tuple[Floats, Floats]:
        arm = effector - pose.joints[:, k]
        return arm, arm[:, ::-1] * (-1, 1)

    def aimed(self, angles: Floats, directions: Floats) -> Floats:
        turns = as_complex(directions) / self.turns
        turns[:, 1:] /= turns[:, :-1].copy()
        return unwrapped(np.angle(turns), angles)


class Space(Chain):
    """Chains in space, three angles a joint."""

    def __init__(self, lengths: Floats, directions: Floats) -> None:
        super().__init__(lengths, directions)
        self.links = (lengths[:, None] * directions)[:, :, None]

    def bent(self, angles: Floats) -> tuple[Floats, NDArray[Any]]:
        frames = accumulated(rotations(angles))
        joints = np.zeros(frames.shape[:-1])
        np.add.accumulate((frames[:, 1:] @ self.links)[..., 0], axis=1, out=joints[:, 1:])
        return joints, frames

    def axes(self, pose: Pose, joints: slice) -> list[Floats]:
        """Return the axes (G, n, 3) about which the three angles of some joints turn."""
        before, after = pose.frames[:, :-1][:, joints], pose.frames[:, 1:][:, joints]
        # x as it was before, y turned by Rx, z turned by Rx·Ry (Rz leaves it).
        angle = pose.angles[:, joints, :1]
        y = np.cos(angle) * before[..., 1] + np.sin(angle) * before[..., 2]
        return [before[..., 0], y, after[..., 2]]

    def least_turns(self, pose: Pose, way: Floats, damping: Floats) -> Floats:
        arms = pose.joints[:, -1:] - pose.joints[:, :-1]
        columns = np.empty((*arms.shape, 3))
        for k, axis in enumerate(self.axes(pose, slice(None))):
            cross(axis, arms, out=columns[:, :, k])
        columns = columns.reshape(len(arms), -1, 3)
        square = columns.swapaxes(1, 2) @ columns
        square.reshape(-1, 9)[:, ::4] += damping[:, None]
        turns: Floats = (columns @ np.linalg.solve(square, way[:, :, None]))[:, :, 0]
        return turns

    def circle(self, pose: Pose, k: int, effector: Floats) -> tuple[Floats, Floats]:
        joint, which = divmod(k, 3)
        axis = self.axes(pose, slice(joint, joint + 1))[which][:, 0]
        arm = effector - pose.joints[:, joint]
        tangent = cross(axis, arm, np.empty_like(arm))
        return cross(tangent, axis, np.empty_like(arm)), tangent

    def aimed(self, angles: Floats, directions: Floats) -> Floats:
        local = rotations(angles)
        before = np.broadcast_to(np.eye(3), (len(angles), 3, 3))
        for k, direction in enumerate(self.directions):
            frame = before @ local[:, k]
            # Of length 1 exactly, or errors would double from link to link.
            start = frame @ direction
            start /= norm(start)[:, None]
            after = turned(frame.swapaxes(1, 2), start, directions[:, k]).swapaxes(1, 2)
            local[:, k] = before.swapaxes(1, 2) @ after
            before = after
        return euler_angles(local, angles)


def as_complex(points: Floats) -> NDArray[np.complex128]:
    """Return points (..., 2) as numbers x + iy."""
    return points[..., 0] + 1j * points[..., 1]


def cross(a: Floats, b: Floats, out: Floats) -> Floats:
    """Write the products of vectors (..., 3) into `out`."""
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.subtract(a[..., j] * b[..., k], a[..., k] * b[..., j], out=out[..., i])
    return out


def norm(vectors: Floats) -> Floats:
    """Return the lengths of the vectors on the last axis."""
    lengths: Floats = np.sqrt(np.vecdot(vectors, vectors))
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
