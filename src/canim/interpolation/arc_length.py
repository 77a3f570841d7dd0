"""The length of a Bézier curve, and points at equal distances along it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, lru_cache

import numpy as np
from numpy.typing import ArrayLike

from canim._arguments import Floats, finite, whole_number
from canim.interpolation.bezier import (
    basis_rows,
    bernstein_sum,
    bezier_curve,
    control_polygon,
    lengths,
)

__all__ = ["arc_length", "equidistant_parameters", "equidistant_points"]

# The interval is divided into these parts, and so is every cell that is not yet exact.
_PARTS = np.arange(16) / 16
# Nodes of the quadrature rules in a cell: the coarse ones tell how good the fine one is.
_COARSE, _FINE = 8, 16
# Largest difference of the rules in a cell, as a share of the whole length.
_TOLERANCE = 1e-11
# Targets are worked on in blocks, so that many of them need little memory.
_BLOCK_SIZE = 2**16
# A few rounds of Newton's method are enough; where rounding leaves no better result, it stops.
_ROUNDS = 64


def arc_length(control_points: ArrayLike, samples: int | None = None) -> float:
    r"""Measure the length of a Bézier curve.

    .. math::

        s = \int_0^1 \|\mathbf{B}'(t)\|\,dt
        \;\approx\; \sum_{i=1}^{N-1} \|\mathbf{B}(t_i) - \mathbf{B}(t_{i-1})\|,
        \qquad t_i = \frac{i}{N - 1}.

    Parameters
    ----------
    control_points : array_like, shape (n + 1, dim)
        One point a row.
    samples : int, optional
        With a number N, 2 or more, the sum on the right: the chords between N points of the
        curve, both ends included. Without one, the integral.

    Returns
    -------
    float
        The length. The sum is never longer than the curve; the integral is accurate to 1e-10
        of the length of the control polygon.

    Raises
    ------
    TypeError
        If `control_points` does not hold real numbers, or `samples` is not whole.
    ValueError
        If `control_points` has a wrong shape or is not finite, `samples` is below 2, or the
        length does not fit a float.

    Notes
    -----
    The integral has no closed form. It is computed by Gauss-Legendre quadrature; where several
    rules disagree, as near a cusp, the interval is divided further. Theory:
    :ref:`Task 1.9 <task-1-9>`.

    References
    ----------
    P. J. Davis, P. Rabinowitz, *Methods of Numerical Integration*, 2nd ed., 1984.

    Examples
    --------
    >>> from canim.interpolation import arc_length
    >>> corners = [(5, -10), (9, 38), (38, -5), (45, 15)]
    >>> round(arc_length(corners), 9)
    59.886741958
    >>> round(arc_length(corners, samples=100), 6)
    59.883442
    """
    with np.errstate(over="ignore"):
        if samples is None:
            hodograph, scale = _scaled_hodograph(control_polygon(control_points))
            total = scale * sum(part.sum() for _, _, part in _cells(hodograph)) if scale else 0.0
        else:
            parameters = np.linspace(0, 1, whole_number(samples, "samples", 2))
            curve = bezier_curve(control_points, parameters)
            total = lengths(curve[1:] - curve[:-1]).sum()
    return float(finite(np.asarray(total), "control_points"))


def equidistant_points(control_points: ArrayLike, count: int) -> Floats:
    r"""Find points of a Bézier curve at equal distances along it.

    .. math:: \mathbf{B}(t_i) \quad\text{with}\quad
        \int_0^{t_i} \|\mathbf{B}'(t)\|\,dt = \frac{i}{N - 1}\, s, \qquad i = 0, \dots, N - 1

    where s is the length of the curve, see :func:`arc_length`.

    Parameters
    ----------
    control_points : array_like, shape (n + 1, dim)
        One point a row.
    count : int
        The number N of points, 2 or more: both ends are included.

    Returns
    -------
    ndarray, shape (count, dim)
        The points, one a row; the first is the first control point, the last the last.

    Raises
    ------
    TypeError
        If `control_points` does not hold real numbers, or `count` is not whole.
    ValueError
        If `control_points` has a wrong shape or is not finite, `count` is below 2, or a result
        does not fit a float.

    Notes
    -----
    The distances, measured along the curve, are equal to 1e-9 of its length. Theory:
    :ref:`Task 1.9 <task-1-9>`.

    References
    ----------
    B. Guenter, R. Parent, *Computing the arc length of parametric curves*, IEEE Computer
    Graphics and Applications 10(3), 1990.

    Examples
    --------
    >>> from canim.interpolation import equidistant_points
    >>> equidistant_points([(0, 0), (0, 0), (6, 3)], 4).round(9)
    array([[0., 0.],
           [2., 1.],
           [4., 2.],
           [6., 3.]])
    """
    found = bezier_curve(control_points, equidistant_parameters(control_points, count))
    found[[0, -1]] = np.asarray(control_points)[[0, -1]]
    return found


def equidistant_parameters(control_points: ArrayLike, count: int) -> Floats:
    r"""Find the parameters of points at equal distances along a Bézier curve.

    .. math:: \int_0^{t_i} \|\mathbf{B}'(t)\|\,dt = \frac{i}{N - 1}\, s

    Parameters
    ----------
    control_points : array_like, shape (n + 1, dim)
        One point a row. If all are the same point, every parameter is right, and the result is
        equally spaced.
    count : int
        The number N of parameters, 2 or more.

    Returns
    -------
    ndarray, shape (count,)
        Parameters from 0 to 1, both included, never decreasing.

    Raises
    ------
    TypeError
        If `control_points` does not hold real numbers, or `count` is not whole.
    ValueError
        If `control_points` has a wrong shape or is not finite, `count` is below 2, or the
        control points are too far apart for a float.

    Notes
    -----
    Newton's method on the length, which stays between bounds that are halved where the speed is
    near zero, as at a cusp. Theory: :ref:`Task 1.9 <task-1-9>`.

    References
    ----------
    B. Guenter, R. Parent, *Computing the arc length of parametric curves*, IEEE Computer
    Graphics and Applications 10(3), 1990.

    Examples
    --------
    >>> from canim.interpolation import equidistant_parameters
    >>> equidistant_parameters([(0, 0), (0, 0), (4, 0)], 5).round(9)
    array([0.        , 0.5       , 0.70710678, 0.8660254 , 1.        ])
    """
    corners = control_polygon(control_points)
    t = np.linspace(0, 1, whole_number(count, "count", 2))
    hodograph, scale = _scaled_hodograph(corners)
    if scale == 0:
        return t
    starts = np.sort(np.concatenate([cells for cells, _, _ in _cells(hodograph)]))
    # In parts of these cells the speed hardly varies: few nodes and few steps are enough there.
    starts = (starts[:, None] + np.outer(np.diff(starts, append=1), _PARTS)).ravel()
    widths = np.diff(starts, append=1)
    nodes, weights = _gauss(_COARSE)
    sizes = widths * (_speeds(hodograph, starts[:, None] + np.outer(widths, nodes)) @ weights)
    ends = sizes.cumsum()
    tolerance = 5 * _tolerance(ends[-1])
    block = max(_BLOCK_SIZE // len(corners), 1)
    for part in (slice(first, first + block) for first in range(0, t.size, block)):
        targets = t[part] * ends[-1]
        cell = np.minimum(np.searchsorted(ends, targets), ends.size - 1)
        rest = targets - (ends - sizes)[cell]
        t[part] = _solve(hodograph, starts[cell], widths[cell], sizes[cell], rest, tolerance)
    t[0], t[-1] = 0, 1
    return t


def _scaled_hodograph(corners: Floats) -> tuple[Floats, float]:
    """Return the control points of the derivative, their largest number 1, and the scale."""
    with np.errstate(over="ignore"):
        steps = finite(corners[1:] - corners[:-1], "control_points")
    largest = float(np.abs(steps).max(initial=0))
    # Squares of scaled numbers neither overflow nor vanish.
    return steps / (largest or 1), largest


def _tolerance(length: float) -> float:
    """Return the error allowed in a cell; the second part is what rounding leaves."""
    return _TOLERANCE * length + 1e-16


@cache
def _gauss(count: int) -> tuple[Floats, Floats]:
    """Return the nodes and weights of a Gauss-Legendre rule on 0 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return (nodes + 1) / 2, weights / 2


@cache
def _lobatto(count: int) -> tuple[Floats, Floats]:
    """Return the nodes and weights of a Gauss-Lobatto rule on 0 to 1, both ends included."""
    legendre = np.polynomial.Legendre.basis(count - 1)
    inner = legendre.deriv().roots().real  # numpy 2.5 returns them as complex numbers
    nodes = np.concatenate([[-1], inner, [1]])
    return (nodes + 1) / 2, 1 / (count * (count - 1) * legendre(nodes) ** 2)


@cache
def _rules() -> tuple[Floats, Floats]:
    """Return the nodes of three rules in a row, and their weights in three columns.

    The first two tell how good the last is. One would not be enough: at a cusp it errs as much
    as the last by chance, and where it has no nodes at the ends, a cusp can hide there. With
    these two, the last rule's error at a cusp is below the larger of the differences.
    """
    rules = _lobatto(_COARSE + 1), _gauss(_COARSE), _gauss(_FINE)
    sizes = [nodes.size for nodes, _ in rules]
    weights = np.concatenate([weights for _, weights in rules])
    columns = np.repeat(np.eye(len(rules)), sizes, axis=0) * weights[:, None]
    return np.concatenate([nodes for nodes, _ in rules]), columns


@lru_cache(maxsize=8)
def _first_basis(degree: int) -> Floats:
    return basis_rows(degree, np.add.outer(_PARTS, _rules()[0] / _PARTS.size).ravel())


def _speeds(hodograph: Floats, t: Floats, basis: Floats | None = None) -> Floats:
    velocity = bernstein_sum(hodograph, t.ravel()) if basis is None else basis.T @ hodograph
    speeds: Floats = len(hodograph) * np.sqrt(np.einsum("nd,nd->n", velocity, velocity))
    return speeds.reshape(t.shape)


def _cells(hodograph: Floats) -> Iterator[tuple[Floats, float, Floats]]:
    """Divide 0 to 1 into cells whose lengths are exact; yield starts, width, lengths."""
    nodes, weights = _rules()
    starts, width = _PARTS, 1 / _PARTS.size
    basis: Floats | None = _first_basis(len(hodograph) - 1)
    tolerance = 0.0
    while starts.size:
        speeds = _speeds(hodograph, np.add.outer(starts, width * nodes), basis)
        *coarse, fine = width * (speeds @ weights).T
        tolerance = tolerance or _tolerance(fine.sum())
        good = np.abs(coarse - fine).max(axis=0) <= tolerance
        yield starts[good], width, fine[good]
        starts = np.add.outer(starts[~good], width * _PARTS).ravel()
        width, basis = width / _PARTS.size, None


def _solve(
    hodograph: Floats,
    starts: Floats,
    widths: Floats,
    sizes: Floats,
    targets: Floats,
    tolerance: float,
) -> Floats:
    """Return the parameters where each target length from the start of its cell is reached."""
    nodes, weights = _gauss(_COARSE // 2)
    # One more node, of no weight, gives the speed at the end.
    nodes, weights = np.append(nodes, 1), np.append(weights, 0)
    share = np.clip(targets / np.maximum(sizes, tolerance), 0, 1)
    result = starts + widths * share
    low, high = np.zeros_like(share), np.ones_like(share)
    waiting, rounds = np.arange(share.size), 0
    while waiting.size and rounds < _ROUNDS:
        spans = share * widths
        speeds = _speeds(hodograph, np.multiply.outer(spans, nodes) + starts[:, None])
        miss = spans * (speeds @ weights) - targets
        low, high = np.where(miss < 0, share, low), np.where(miss > 0, share, high)
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            newton = share - miss / (widths * speeds[:, -1])
        # Where the speed is near zero, as at a cusp, Newton's step leaves the bounds: halve them.
        share = np.where((low < newton) & (newton < high), newton, (low + high) / 2)
        far = np.abs(miss) > tolerance
        waiting, rounds = waiting[far], rounds + 1
        starts, widths, targets, share, low, high = (
            values[far] for values in (starts, widths, targets, share, low, high)
        )
        result[waiting] = starts + widths * share
    return result
