"""Triangles over key points: their corners, their affine maps, and the pixels inside them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import Delaunay, QhullError

from canim._arguments import Floats, floats, points, whole_number

__all__ = ["add_frame_points", "affine_transforms", "triangulate"]

Integers = NDArray[np.intp]

# Pixels this close to an edge belong to the triangle, so that rounding leaves no gap.
_TOLERANCE = 1e-9

# Twice the area, in square pixels, below which a triangle is a line.
_FLAT = 1e-9


def add_frame_points(points: ArrayLike, shape: tuple[int, ...]) -> Floats:
    r"""Append the centres of the four corner pixels of an image.

    .. math:: (0, 0), \quad (w - 1, 0), \quad (0, h - 1), \quad (w - 1, h - 1)

    With them the triangles cover the whole image, and its frame stays where it is.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        Key points (x, y) in pixels; n may be 0.
    shape : tuple of int
        The shape of the image, ``image.shape``: height, width and perhaps channels.

    Returns
    -------
    ndarray, shape (n + 4, 2)
        The points, then top left, top right, bottom left and bottom right.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind.
    ValueError
        If a point lies outside the image, or the image has fewer than 2 × 2 pixels.

    Notes
    -----
    Theory: Task 2.1.

    Examples
    --------
    >>> from canim.warping import add_frame_points
    >>> add_frame_points([(3, 2)], shape=(6, 8))
    array([[3., 2.],
           [0., 0.],
           [7., 0.],
           [0., 5.],
           [7., 5.]])
    """
    try:
        height, width = (whole_number(size, "shape", 2) for size in tuple(shape)[:2])
    except (TypeError, ValueError) as error:
        raise type(error)(
            f"shape must be that of an image of 2 × 2 or more pixels, (height, width, ...), "
            f"but is {shape!r}."
        ) from error
    corners = [(0, 0), (width - 1, 0), (0, height - 1), (width - 1, height - 1)]
    if floats(points, "points").size == 0:
        return np.array(corners, dtype=np.float64)
    return np.concatenate([image_points(points, "points", (height, width)), corners])


def triangulate(points_a: ArrayLike, points_b: ArrayLike) -> Integers:
    r"""Divide the plane between matching points of two images into triangles.

    The triangles are those of the Delaunay triangulation of the mean points

    .. math:: \mathbf{m}_i = \tfrac{1}{2} (\mathbf{a}_i + \mathbf{b}_i),

    in which no circle through the corners of a triangle has a point inside. One list of
    triangles serves both images, and the mean treats them alike: a triangulation of one image's
    points alone is more likely to turn triangles over in the other.

    Parameters
    ----------
    points_a, points_b : array_like, shape (n, 2)
        Key points (x, y) in pixels; row i of one matches row i of the other.

    Returns
    -------
    ndarray of int, shape (F, 3)
        The numbers of each triangle's corners, that is, rows of `points_a` and `points_b`.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If there are fewer than three points, the counts differ, two points of one image or two
        mean points coincide, or the mean points lie on one line.

    Notes
    -----
    Theory: Task 2.1.

    References
    ----------
    C. B. Barber, D. P. Dobkin, H. Huhdanpaa, *The Quickhull Algorithm for Convex Hulls*, ACM
    Transactions on Mathematical Software 22(4), 1996.

    Examples
    --------
    >>> from canim.warping import triangulate
    >>> points = [(0, 0), (4, 0), (4, 3), (0, 3), (2, 1)]
    >>> triangles = triangulate(points, points)
    >>> sorted(sorted(corners) for corners in triangles.tolist())
    [[0, 1, 4], [0, 3, 4], [1, 2, 4], [2, 3, 4]]
    """
    a, b = matching_points(points_a, points_b, "points_a", "points_b")
    for name, corners in (("points_a", a), ("points_b", b)):
        _, first, number = np.unique(corners, axis=0, return_index=True, return_inverse=True)
        again = np.flatnonzero(first[number.ravel()] != np.arange(len(corners)))
        if again.size:
            i, j = first[number.ravel()[again[0]]], again[0]
            raise ValueError(
                f"{name}[{i}] and {name}[{j}] are the same point, {_pair(corners[i])}; "
                "leave out one of the two, in both images."
            )
    try:
        delaunay = Delaunay(a / 2 + b / 2)
    except QhullError as error:
        raise ValueError(
            "points_a and points_b cannot be joined to triangles: "
            "the points halfway between them lie on one line."
        ) from error
    if len(delaunay.coplanar):
        i, _, j = sorted(delaunay.coplanar.tolist())[0]
        raise ValueError(
            f"points_a and points_b: halfway between the images, points {min(i, j)} and "
            f"{max(i, j)} meet; perhaps they were swapped in one image."
        )
    triangles: Integers = delaunay.simplices.astype(np.intp)
    return triangles


def affine_transforms(source: ArrayLike, target: ArrayLike, triangles: ArrayLike) -> Floats:
    r"""Find for each triangle the affine map that takes it from one image to the other.

    With the corners as columns :math:`[x, y, 1]^\mathsf{T}` of the 3×3 matrices
    :math:`\mathbf{T}_\text{src}` and :math:`\mathbf{T}_\text{dst}`,

    .. math::

        \mathbf{A}\, \mathbf{T}_\text{src} = \mathbf{T}_\text{dst}
        \quad\Rightarrow\quad
        \mathbf{A} = \mathbf{T}_\text{dst}\, \mathbf{T}_\text{src}^{-1}.

    Parameters
    ----------
    source, target : array_like, shape (n, 2)
        Key points (x, y) before and after.
    triangles : array_like of int, shape (F, 3)
        The numbers of each triangle's corners, as from `triangulate`.

    Returns
    -------
    ndarray, shape (F, 3, 3)
        One matrix a triangle. It acts on a column :math:`[x, y, 1]^\mathsf{T}`; the last row is
        0, 0, 1.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind.
    ValueError
        If an argument has a wrong shape, or the corners of a source triangle lie on one line.

    Notes
    -----
    Theory: Task 2.1.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 6.

    Examples
    --------
    >>> from canim.warping import affine_transforms
    >>> affine_transforms([(0, 0), (1, 0), (0, 1)], [(5, 7), (7, 7), (5, 8)], [(0, 1, 2)])
    array([[[2., 0., 5.],
            [0., 1., 7.],
            [0., 0., 1.]]])
    """
    before, after = matching_points(source, target, "source", "target")
    corners = triangle_corners(triangles, len(before))
    flat = np.flatnonzero(_is_flat(before, corners))
    if flat.size:
        raise ValueError(
            f"source: the corners of triangle {flat[0]} (points {_trio(corners[flat[0]])}) "
            "lie on one line, so no map can take it anywhere."
        )
    return affine_maps(before, after, corners)


class Spans(NamedTuple):
    """Runs of pixels of one triangle in one row, in reading order, without overlap.

    Pixels are counted row by row: pixel (x, y) of an image of width w has number y·w + x.
    """

    triangle: Integers
    start: Integers
    length: Integers


def triangle_spans(points: Floats, triangles: Integers, shape: tuple[int, int]) -> Spans:
    """Find the pixels inside triangles; one without an area has none.

    Rows are cut by the edges; both triangles of an edge calculate its cuts alike, top to bottom,
    so that no pixel between them is lost. Where spans overlap, on an edge or in a fold, the one
    that begins first keeps the pixels.
    """
    height, width = shape
    corners = points[triangles]
    order = np.argsort(corners[:, :, 1], axis=1, kind="stable")
    x, y = np.moveaxis(np.take_along_axis(corners, order[:, :, None], axis=1), 2, 0)
    top, middle, bottom = y.T
    first = np.maximum(np.ceil(top - _TOLERANCE), 0).astype(np.intp)
    last = np.minimum(np.floor(bottom + _TOLERANCE), height - 1).astype(np.intp)
    rows = np.where(_is_flat(points, triangles), 0, np.maximum(last - first + 1, 0))
    triangle = np.repeat(np.arange(len(triangles)), rows)
    row = np.arange(len(triangle)) + np.repeat(first + rows - np.cumsum(rows), rows)

    # Three edges a triangle: upper, lower, and the long one on the other side of both.
    x0, y0 = x[:, [0, 1, 0]], y[:, [0, 1, 0]]
    drop = y[:, [1, 2, 2]] - y0
    slope = np.divide(x[:, [1, 2, 2]] - x0, drop, out=np.zeros_like(drop), where=drop > _TOLERANCE)
    level = np.clip(row, top[triangle], bottom[triangle])
    short = 3 * triangle + (level >= middle[triangle] - _TOLERANCE)
    cuts = [
        x0.take(edge) + np.maximum(level - y0.take(edge), 0) * slope.take(edge)
        for edge in (short, 3 * triangle + 2)
    ]
    left = np.maximum(np.ceil(np.minimum(*cuts) - _TOLERANCE), 0).astype(np.intp)
    right = np.minimum(np.floor(np.maximum(*cuts) + _TOLERANCE), width - 1).astype(np.intp)

    start, end = row * width + left, row * width + right + 1
    order = np.argsort(start, kind="stable")
    triangle, start, end = triangle[order], start[order], end[order]
    start[1:] = np.maximum(start[1:], np.maximum.accumulate(end)[:-1])
    kept = start < end
    return Spans(triangle[kept], start[kept], (end - start)[kept])


def affine_maps(source: Floats, target: Floats, triangles: Integers) -> Floats:
    """Return the maps of triangles; that of a flat one is not finite."""
    origin, moved = source[triangles[:, 0]], target[triangles[:, 0]]
    edges = source[triangles[:, 1:]] - origin[:, None]
    moved_edges = target[triangles[:, 1:]] - moved[:, None]
    # With the edges as rows, edges @ linear.T == moved_edges.
    (ax, ay), (bx, by) = edges[:, 0].T, edges[:, 1].T
    adjugate = np.array([[by, -ay], [-bx, ax]]).transpose(2, 0, 1)
    maps = np.zeros((len(triangles), 3, 3))
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        linear = (adjugate @ moved_edges / (ax * by - ay * bx)[:, None, None]).transpose(0, 2, 1)
        maps[:, :2, :2] = linear
        maps[:, :2, 2] = moved - np.einsum("fij,fj->fi", linear, origin)
    maps[:, 2, 2] = 1
    return maps


def folds(corners: Floats, triangles: Integers) -> str:
    """Name the triangles that turn over or lose their area between poses (poses, n, 2)."""
    areas = _double_areas(corners, triangles)
    same = (areas > _FLAT).all(axis=0) | (areas < -_FLAT).all(axis=0)
    return ", ".join(f"{i} (points {_trio(triangles[i])})" for i in np.flatnonzero(~same))


def image_points(value: ArrayLike, name: str, shape: tuple[int, int]) -> Floats:
    """Return key points that lie on the pixels of an image."""
    corners = _plane_points(value, name)
    limit = np.array(shape[::-1]) - 0.5
    outside = ((corners < -0.5) | (corners > limit)).any(axis=1)
    if outside.any():
        i = int(outside.argmax())
        raise ValueError(
            f"{name}[{i}] is {_pair(corners[i])}, outside the image: "
            f"x goes from 0 to {shape[1] - 1}, y from 0 to {shape[0] - 1}."
        )
    return corners


def matching_points(
    value_a: ArrayLike,
    value_b: ArrayLike,
    name_a: str,
    name_b: str,
    shape: tuple[int, int] | None = None,
    minimum: int = 3,
) -> tuple[Floats, Floats]:
    """Return two sets of points that match; they lie on the image if its shape is given."""
    pair = []
    for value, name in ((value_a, name_a), (value_b, name_b)):
        corners = image_points(value, name, shape) if shape else _plane_points(value, name)
        if len(corners) < minimum:
            raise ValueError(f"{name} needs {minimum} or more points, but has {len(corners)}.")
        pair.append(corners)
    if len(pair[0]) != len(pair[1]):
        raise ValueError(
            f"{name_a} has {len(pair[0])} points and {name_b} has {len(pair[1])}; "
            "each point needs its match."
        )
    return pair[0], pair[1]


def triangle_corners(value: ArrayLike, count: int) -> Integers:
    """Return checked corner numbers of triangles over `count` points."""
    triangles = np.asarray(value)
    if triangles.ndim != 2 or triangles.shape[1] != 3 or len(triangles) == 0:
        raise ValueError(
            f"triangles must hold three corners a row, shape (F, 3), "
            f"but has shape {triangles.shape}."
        )
    if triangles.dtype.kind not in "iu":
        raise TypeError(f"triangles must hold whole numbers, but is of type {triangles.dtype}.")
    wrong = (triangles < 0) | (triangles >= count)
    if wrong.any():
        raise ValueError(
            f"triangles must hold numbers of points, 0 to {count - 1}, "
            f"but holds {triangles[wrong][0]}."
        )
    return triangles.astype(np.intp)


def _double_areas(corners: Floats, triangles: Integers) -> Floats:
    """Return twice the signed area of each triangle, for points of shape (..., n, 2)."""
    a, b, c = np.moveaxis(corners[..., triangles, :], -2, 0)
    areas: Floats = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1])
    areas -= (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
    return areas


def _is_flat(corners: Floats, triangles: Integers) -> NDArray[np.bool_]:
    flat: NDArray[np.bool_] = np.abs(_double_areas(corners, triangles)) <= _FLAT
    return flat


def _plane_points(value: ArrayLike, name: str) -> Floats:
    corners = points(value, name)
    if corners.shape[1] != 2:
        raise ValueError(f"{name} must hold (x, y) a row, but has shape {corners.shape}.")
    return corners


def _pair(point: Floats) -> str:
    return f"({point[0]:g}, {point[1]:g})"


def _trio(corners: Integers) -> str:
    return ", ".join(map(str, corners.tolist()))
