"""What a chain of links is made of: its arguments, checked, and its rotations."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from canim._arguments import Floats, floats, points


def chain(
    angles: ArrayLike,
    offsets: ArrayLike,
    root: ArrayLike | None,
    dimension: int | None = None,
    goals: int | None = None,
) -> tuple[Floats, Floats, Floats]:
    """Return angles (N,) or (N, 3), offsets (N, d) and root (d,) that fit each other.

    With a number of goals, the angles may also begin with the axis of the goals.
    """
    offsets = links(offsets, dimension)
    count, dimension = offsets.shape
    shape = (count,) if dimension == 2 else (count, 3)
    angles = floats(angles, "angles")
    if angles.shape != shape and (goals is None or angles.shape != (goals, *shape)):
        each = "one angle" if dimension == 2 else "three angles"
        more = "" if goals is None else f" or, with a pose for each goal, {(goals, *shape)}"
        raise ValueError(
            f"angles must hold {each} for each of the {count} links in offsets, "
            f"shape {shape}{more}, but has shape {angles.shape}."
        )
    base = np.zeros(dimension) if root is None else place(root, "root", dimension)
    return angles, offsets, base


def links(value: ArrayLike, dimension: int | None = None) -> Floats:
    """Return `value` as offsets (N, d) of one or more links, each of some length."""
    offsets = points(value, "offsets", 0)
    if offsets.shape[1] not in ((2, 3) if dimension is None else (dimension,)):
        wanted = "(N, 2) or (N, 3)" if dimension is None else f"(N, {dimension})"
        raise ValueError(
            f"offsets must hold one link a row, shape {wanted}, but has shape {offsets.shape}."
        )
    if len(offsets) == 0:
        raise ValueError("offsets needs 1 or more links, but has 0.")
    short = np.flatnonzero(~offsets.any(axis=1))
    if short.size:
        raise ValueError(f"offsets[{short[0]}] has the length 0; every link needs a length.")
    return offsets


def place(value: ArrayLike, name: str, dimension: int) -> Floats:
    """Return `value` as one point of the chain's plane or space."""
    point = floats(value, name)
    if point.shape != (dimension,):
        raise ValueError(
            f"{name} must be one point of {dimension} numbers, but has shape {point.shape}."
        )
    return point


def flat_rotations(angles: Floats) -> Floats:
    """Return for every link the rotation of all joints up to its own: (N,) to (N, 2, 2)."""
    total = np.cumsum(angles)
    c, s = np.cos(total), np.sin(total)
    return np.stack([c, -s, s, c], axis=-1).reshape(-1, 2, 2)


def rotations(angles: Floats) -> Floats:
    """Return for every joint Rx·Ry·Rz: (..., 3) to (..., 3, 3)."""
    cosine, sine = np.cos(angles), np.sin(angles)
    a, b, c = cosine[..., 0, None], cosine[..., 1], cosine[..., 2]
    sa, sb, sc = sine[..., 0, None], sine[..., 1], sine[..., 2]
    # The rows of Ry·Rz; Rx mixes the second and the third.
    result = np.empty((*angles.shape, 3))
    result[..., 0, 0], result[..., 0, 1], result[..., 0, 2] = b * c, -b * sc, sb
    result[..., 1, 0], result[..., 1, 1], result[..., 1, 2] = sc, c, 0
    result[..., 2, 0], result[..., 2, 1], result[..., 2, 2] = -sb * c, sb * sc, b
    y, z = result[..., 1, :], result[..., 2, :]
    result[..., 1, :], result[..., 2, :] = a * y - sa * z, sa * y + a * z
    return result


def accumulated(rotations: Floats) -> Floats:
    """Return the products along the chain, (..., N + 1, 3, 3); the first is the identity."""
    *goals, count, _, _ = rotations.shape
    result = np.empty((*goals, count + 1, 3, 3))
    result[..., 0, :, :] = np.eye(3)
    for k in range(count):
        np.matmul(result[..., k, :, :], rotations[..., k, :, :], out=result[..., k + 1, :, :])
    return result
