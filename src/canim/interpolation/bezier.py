"""Bézier curves: the Bernstein basis, curves, their construction, and smooth joints."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Iterator
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from canim._arguments import Floats, finite, floats, points, whole_number

__all__ = [
    "bernstein_basis",
    "bezier_curve",
    "bezier_path",
    "de_casteljau",
    "joint_kinks",
    "next_control_point",
    "transform_points",
]

# Beyond this degree the binomial coefficients soon leave the range of a float.
_LARGEST_DEGREE = 1000

# A block of basis rows has at most this many numbers, so that it stays in the cache.
_BLOCK_SIZE = 2**17


def bernstein_basis(degree: int, t: ArrayLike) -> Floats:
    r"""Evaluate the Bernstein polynomials of one degree.

    .. math:: b_{k,n}(t) = \binom{n}{k}\, t^k (1 - t)^{n-k}, \qquad k = 0, \dots, n.

    Parameters
    ----------
    degree : int
        The degree n, from 0 to 1000.
    t : array_like
        Parameters, of any shape. The curve lies over 0 to 1; other values are accepted.

    Returns
    -------
    ndarray, shape (degree + 1, \*t.shape)
        One basis function after the other.

    Raises
    ------
    TypeError
        If `degree` is not whole, or `t` does not hold real numbers.
    ValueError
        If `degree` is out of range, `t` is not finite, or a result does not fit a float.

    Notes
    -----
    Degree n has n + 1 functions. Between 0 and 1 none is negative and together they are 1.
    Theory: :ref:`Task 1.6 <task-1-6>`.

    References
    ----------
    G. Farin, *Curves and Surfaces for CAGD: A Practical Guide*, 5th ed., 2002.

    Examples
    --------
    >>> from canim.interpolation import bernstein_basis
    >>> bernstein_basis(2, [0, 0.5, 1])
    array([[1.  , 0.25, 0.  ],
           [0.  , 0.5 , 0.  ],
           [0.  , 0.25, 1.  ]])
    """
    degree = whole_number(degree, "degree", 0)
    if degree > _LARGEST_DEGREE:
        raise ValueError(f"degree must be at most {_LARGEST_DEGREE}, but is {degree}.")
    parameters = floats(t, "t")
    basis = finite(basis_rows(degree, parameters.ravel()), "t")
    return basis.reshape(degree + 1, *parameters.shape)


def bezier_curve(control_points: ArrayLike, t: ArrayLike) -> Floats:
    r"""Evaluate a Bézier curve of any degree.

    .. math:: \mathbf{B}(t) = \sum_{k=0}^{n} b_{k,n}(t)\, \mathbf{P}_k

    with the Bernstein polynomials :math:`b_{k,n}` of :func:`bernstein_basis`.

    Parameters
    ----------
    control_points : array_like, shape (n + 1, dim)
        One point a row; n + 1 points make a curve of degree n.
    t : array_like
        Parameters, of any shape: 0 is the first control point, 1 the last.

    Returns
    -------
    ndarray, shape (\*t.shape, dim)
        The points of the curve.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape or is not finite, there are more than 1001 control
        points, or a result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 1.7 <task-1-7>`.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 15.

    Examples
    --------
    >>> from canim.interpolation import bezier_curve
    >>> bezier_curve([(5, -10), (9, 38), (38, -5), (45, 15)], 0.5)
    array([23.875, 13.   ])
    """
    corners = control_polygon(control_points)
    parameters = floats(t, "t")
    flat = parameters.ravel()
    evaluate = _horner if 1 <= len(corners) - 1 <= 3 else bernstein_sum
    with np.errstate(over="ignore", invalid="ignore"):
        curve = evaluate(corners, flat)
    return finite(curve, "control_points and t").reshape(*parameters.shape, corners.shape[1])


def de_casteljau(control_points: ArrayLike, t: float) -> list[Floats]:
    r"""Construct one point of a Bézier curve by repeated linear interpolation.

    .. math::

        \mathbf{P}_i^{(0)} = \mathbf{P}_i, \qquad
        \mathbf{P}_i^{(r)} = (1 - t)\,\mathbf{P}_i^{(r-1)} + t\,\mathbf{P}_{i+1}^{(r-1)}.

    Parameters
    ----------
    control_points : array_like, shape (n + 1, dim)
        One point a row.
    t : float
        One parameter.

    Returns
    -------
    list of ndarray
        n + 1 levels. The first is a copy of the control points, shape (n + 1, dim); each has
        one point less than the one before; the last, shape (1, dim), is the curve's point.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape or is not finite, or a result does not fit a float.

    Notes
    -----
    The first points of all levels are the control points of the curve's part before `t`, the
    last points those of the part after it. Theory: :ref:`Task 1.7 <task-1-7>`.

    References
    ----------
    W. Boehm, A. Müller, *On de Casteljau's algorithm*, Computer Aided Geometric Design, 1999.

    Examples
    --------
    >>> from canim.interpolation import de_casteljau
    >>> for level in de_casteljau([(0, 0), (2, 4), (4, 0)], 0.5):
    ...     print(level.tolist())
    [[0.0, 0.0], [2.0, 4.0], [4.0, 0.0]]
    [[1.0, 2.0], [3.0, 2.0]]
    [[2.0, 2.0]]
    """
    levels = [control_polygon(control_points).copy()]
    at = _number(t, "t")
    with np.errstate(over="ignore", invalid="ignore"):
        while len(levels[-1]) > 1:
            levels.append((1 - at) * levels[-1][:-1] + at * levels[-1][1:])
    return [finite(level, "control_points and t") for level in levels]


def bezier_path(segments: ArrayLike, t: ArrayLike) -> Floats:
    r"""Evaluate a path of cubic Bézier segments, one after the other.

    .. math:: \mathbf{S}(t) = \mathbf{B}_i(t - i), \qquad i = \min(\lfloor t \rfloor, m - 1).

    Parameters
    ----------
    segments : array_like, shape (m, 4, dim)
        The four control points of each of the m segments.
    t : array_like
        Parameters from 0 to m, of any shape. The whole part chooses the segment, the rest is
        the parameter on it: 1.5 is the middle of the second segment. A whole number is the
        beginning of a segment; m is the end of the last.

    Returns
    -------
    ndarray, shape (\*t.shape, dim)
        The points of the path.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If `segments` has a wrong shape, `t` leaves the path, or a number is not finite.

    Notes
    -----
    Theory: :ref:`Task 1.8 <task-1-8>`.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 15.

    Examples
    --------
    >>> from canim.interpolation import bezier_path
    >>> bezier_path([[(0, 0), (1, 0), (2, 0), (3, 0)], [(3, 0), (4, 0), (5, 1), (6, 2)]], [1, 2])
    array([[3., 0.],
           [6., 2.]])
    """
    cubics = _segments(segments)
    parameters = floats(t, "t")
    flat = parameters.ravel()
    outside = (flat < 0) | (flat > len(cubics))
    if outside.any():
        raise ValueError(
            f"t must be from 0 to {len(cubics)}, the number of segments, "
            f"but holds {flat[outside.argmax()]}."
        )
    path = np.empty((flat.size, cubics.shape[2]))
    with np.errstate(over="ignore"):
        for part in _blocks(flat.size, 4):
            index = np.minimum(flat[part].astype(np.intp), len(cubics) - 1)
            basis = basis_rows(3, flat[part] - index)
            np.einsum("kn,nkd->nd", basis, cubics[index], out=path[part])
    return finite(path, "segments").reshape(*parameters.shape, cubics.shape[2])


def next_control_point(second_last: ArrayLike, last: ArrayLike) -> Floats:
    r"""Return the first handle of the segment that continues a Bézier curve smoothly.

    .. math:: \mathbf{Q}_1 = 2\,\mathbf{P}_n - \mathbf{P}_{n-1}

    mirrors the last handle about the joint :math:`\mathbf{P}_n = \mathbf{Q}_0`: the new segment
    (of the same degree) leaves in the same direction and at the same speed, that is, C1.

    Parameters
    ----------
    second_last, last : array_like, shape (dim,) or (..., dim)
        The last two control points of the segment, or of many segments.

    Returns
    -------
    ndarray
        The handle, of the same shape.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If the arguments are no points, differ in shape, are not finite, or the result does not
        fit a float.

    Notes
    -----
    Theory: :ref:`Task 1.8 <task-1-8>`.

    References
    ----------
    G. Farin, *Curves and Surfaces for CAGD: A Practical Guide*, 5th ed., 2002.

    Examples
    --------
    >>> from canim.interpolation import next_control_point
    >>> next_control_point((38, -5), (45, 15))
    array([52., 35.])
    """
    handle, joint = floats(second_last, "second_last"), floats(last, "last")
    if joint.ndim == 0 or joint.size == 0:
        raise ValueError(f"last must be a point, shape (dim,), but has shape {joint.shape}.")
    if handle.shape != joint.shape:
        raise ValueError(
            f"second_last must have the shape of last, {joint.shape}, but has shape {handle.shape}."
        )
    with np.errstate(over="ignore", invalid="ignore"):
        return finite(joint + (joint - handle), "second_last and last")


def joint_kinks(segments: ArrayLike, closed: bool = False) -> tuple[Floats, Floats]:
    r"""Measure how far the joints of a path of cubic segments are from smooth.

    Where a segment P meets the next one Q, the angle is the one between the arriving direction
    :math:`\mathbf{P}_3 - \mathbf{P}_2` and the leaving direction
    :math:`\mathbf{Q}_1 - \mathbf{Q}_0`; the mismatch is

    .. math::

        \max\left(\|\mathbf{Q}_0 - \mathbf{P}_3\|,\;
        \|(\mathbf{Q}_1 - \mathbf{Q}_0) - (\mathbf{P}_3 - \mathbf{P}_2)\|\right),

    the gap between the segments or the difference of their handles (one third of the difference
    of the derivatives), whichever is larger. It is 0 where the path is C1.

    Parameters
    ----------
    segments : array_like, shape (m, 4, dim)
        The four control points of each of the m segments.
    closed : bool
        Whether the last segment is joined to the first.

    Returns
    -------
    angles : ndarray, shape (m - 1,), or (m,) if closed
        Radians, from 0 to pi, at the end of every segment that has a next one. A handle that
        coincides with its joint gives no direction; the next control point that differs gives
        it then. A segment that is a single point has none at all: its angles are 0.
    mismatches : ndarray, of the same shape
        Distance from C1, a length.

    Raises
    ------
    TypeError
        If `segments` does not hold real numbers, or `closed` is not a truth value.
    ValueError
        If `segments` has a wrong shape, is not finite, or a result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 1.8 <task-1-8>`.

    References
    ----------
    W. Kahan, *How Futile are Mindless Assessments of Roundoff in Floating-Point Computation?*,
    2006: the formula for the angle that keeps its accuracy near 0 and pi.

    Examples
    --------
    A joint at (13, -10) that turns from the direction (-7, 8) to (-7, 10):

    >>> import numpy as np
    >>> from canim.interpolation import joint_kinks
    >>> angles, mismatches = joint_kinks([[(51, -18), (30, -18), (20, -18), (13, -10)],
    ...                                   [(13, -10), (6, 0), (-3, -18), (5, -10)]])
    >>> np.degrees(angles).round(1), mismatches
    (array([6.2]), array([2.]))
    """
    if not isinstance(closed, bool | np.bool_):
        raise TypeError(f"closed must be True or False, but is {reprlib.repr(closed)}.")
    arriving = _segments(segments)
    leaving = np.roll(arriving, -1, axis=0)
    if not closed:
        arriving, leaving = arriving[:-1], leaving[:-1]
    with np.errstate(over="ignore", invalid="ignore"):
        gaps = leaving[:, 0] - arriving[:, 3]
        handles = (leaving[:, 1] - leaving[:, 0]) - (arriving[:, 3] - arriving[:, 2])
        mismatches = np.maximum(lengths(gaps), lengths(handles))
        forward = -_first_directions(arriving[:, ::-1])
        onward = _first_directions(leaving)
        halves = np.arctan2(lengths(forward - onward), lengths(forward + onward))
    known = forward.any(axis=1) & onward.any(axis=1)
    angles = np.where(known, 2 * halves, 0.0)
    return finite(angles, "segments"), finite(mismatches, "segments")


def transform_points(
    points: ArrayLike,
    scale: float = 1,
    angle: float = 0,
    translate: ArrayLike = (0, 0),
) -> Floats:
    r"""Scale points, turn them about the origin, then move them.

    .. math::

        \mathbf{p}' = s \begin{pmatrix} \cos\varphi & -\sin\varphi \\
        \sin\varphi & \cos\varphi \end{pmatrix} \mathbf{p} + \mathbf{d}

    Parameters
    ----------
    points : array_like, shape (n, 2) or (..., 2)
        Points of the plane; the segments of a path, shape (m, 4, 2), will do as well.
    scale : float
        The factor s.
    angle : float
        The angle in radians, counter-clockwise where y points up.
    translate : array_like, shape (2,)
        The displacement d.

    Returns
    -------
    ndarray
        The moved points, of the same shape.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape, is not finite, or a result does not fit a float.

    Notes
    -----
    A Bézier curve moves with its control points: transform these, not the curve. Because of the
    scale this is a similarity, not a rigid motion. Theory: :ref:`Task 1.8 <task-1-8>`.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 6.

    Examples
    --------
    >>> from canim.interpolation import transform_points
    >>> transform_points([(4, 2), (6, 8)], scale=0.5, translate=(10, 0))
    array([[12.,  1.],
           [13.,  4.]])
    """
    start = floats(points, "points")
    if start.ndim == 0 or start.shape[-1] != 2 or start.size == 0:
        raise ValueError(
            f"points must hold (x, y) a row, shape (n, 2), but has shape {start.shape}."
        )
    factor, turn = _number(scale, "scale"), _number(angle, "angle")
    shift = floats(translate, "translate")
    if shift.shape != (2,):
        raise ValueError(f"translate must be one point, shape (2,), but has shape {shift.shape}.")
    cos, sin = math.cos(turn), math.sin(turn)
    with np.errstate(over="ignore", invalid="ignore"):
        moved = (factor * start) @ np.array([[cos, sin], [-sin, cos]]) + shift
    return finite(moved, "points, scale and translate")


def control_polygon(value: ArrayLike) -> Floats:
    """Return checked control points."""
    corners = points(value, "control_points")
    if len(corners) > _LARGEST_DEGREE + 1:
        raise ValueError(
            f"control_points must be at most {_LARGEST_DEGREE + 1}, but are {len(corners)}."
        )
    return corners


def basis_rows(degree: int, t: Floats) -> Floats:
    """Return the Bernstein basis at a flat array of parameters, nothing checked."""
    rows = np.empty((degree + 1, t.size))
    with np.errstate(over="ignore", invalid="ignore"):
        for part in _blocks(t.size, degree + 1):
            _fill_basis(rows[:, part], t[part])
    return rows


def bernstein_sum(corners: Floats, t: Floats) -> Floats:
    """Evaluate as the sum of basis functions, accurate at every degree."""
    curve = np.empty((t.size, corners.shape[1]))
    scratch = np.empty((len(corners), min(t.size, _block_length(len(corners)))))
    for part in _blocks(t.size, len(corners)):
        basis = scratch[:, : t[part].size]
        _fill_basis(basis, t[part])
        np.matmul(basis.T, corners, out=curve[part])
    return curve


def lengths(vectors: Floats) -> Floats:
    """Return the lengths of the rows; scaled, so that no square over- or underflows."""
    largest = np.abs(vectors).max(axis=-1)
    largest[largest == 0] = 1
    scaled: Floats = largest * np.linalg.norm(vectors / largest[..., None], axis=-1)
    return scaled


def _horner(corners: Floats, t: Floats) -> Floats:
    """Evaluate in powers of t: the fastest way, but it loses digits where the degree is high."""
    degree, dim = len(corners) - 1, corners.shape[1]
    coefficients = [corners[0]]
    for k in range(1, degree + 1):
        corners = corners[1:] - corners[:-1]
        coefficients.append(math.comb(degree, k) * corners[0])
    curve = np.empty((t.size, dim))
    for part in _blocks(t.size, 4):
        for axis in range(dim):
            value = coefficients[-1][axis] * t[part]
            for coefficient in coefficients[-2:0:-1]:
                value += coefficient[axis]
                value *= t[part]
            np.add(value, coefficients[0][axis], out=curve[part, axis])
    return curve


def _fill_basis(rows: Floats, t: Floats) -> None:
    degree = len(rows) - 1
    rows[0] = 1
    for k in range(degree):
        np.multiply(rows[k], t, out=rows[k + 1])
    rows *= _binomials(degree)
    power = rest = 1 - t
    for k in reversed(range(degree)):
        rows[k] *= power
        power = power * rest


@cache
def _binomials(degree: int) -> Floats:
    return np.array([[math.comb(degree, k)] for k in range(degree + 1)], dtype=np.float64)


def _block_length(rows: int) -> int:
    return max(_BLOCK_SIZE // rows, 1)


def _blocks(count: int, rows: int) -> Iterator[slice]:
    step = _block_length(rows)
    return (slice(start, start + step) for start in range(0, count, step))


def _segments(value: ArrayLike) -> Floats:
    segments = floats(value, "segments")
    if segments.ndim != 3 or segments.shape[1] != 4 or segments.size == 0:
        raise ValueError(
            "segments must hold four control points for each segment, shape (m, 4, dim), "
            f"but has shape {segments.shape}."
        )
    return segments


def _number(value: ArrayLike, name: str) -> float:
    number = floats(value, name)
    if number.ndim != 0:
        raise ValueError(f"{name} must be one number, but has shape {number.shape}.")
    return float(number)


def _first_directions(segments: Floats) -> Floats:
    """Return unit vectors from each first point to the next one that differs, or zeros."""
    steps = segments[:, 1:] - segments[:, :1]
    first = steps.any(axis=2).argmax(axis=1)
    step = steps[np.arange(len(steps)), first]
    largest = np.abs(step).max(axis=1, keepdims=True)
    step = step / np.where(largest > 0, largest, 1)
    norm = np.linalg.norm(step, axis=1, keepdims=True)
    unit: Floats = step / np.maximum(norm, 1)
    return unit
