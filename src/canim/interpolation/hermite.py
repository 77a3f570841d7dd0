"""Cubic Hermite interpolation: curves with given ends and given slopes there."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from canim._arguments import Floats, finite, floats, increasing, rows
from canim.interpolation._piecewise import evaluate

__all__ = [
    "HERMITE_MATRIX",
    "hermite_basis",
    "hermite_coefficients",
    "hermite_curve",
    "hermite_spline",
]

HERMITE_MATRIX: Floats = np.array(
    [
        [2.0, -2.0, 1.0, 1.0],
        [-3.0, 3.0, -2.0, -1.0],
        [0.0, 0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0, 0.0],
    ]
)
"""Turns f(0), f(1), f'(0), f'(1) into the coefficients of the cubic, highest power first."""
HERMITE_MATRIX.flags.writeable = False


@np.errstate(all="ignore")
def hermite_basis(t: ArrayLike) -> Floats:
    r"""Evaluate the four cubic Hermite basis functions.

    .. math::

       H_0(t) &= 2t^3 - 3t^2 + 1 \\
       H_1(t) &= -2t^3 + 3t^2 \\
       H_2(t) &= t^3 - 2t^2 + t \\
       H_3(t) &= t^3 - t^2

    Parameters
    ----------
    t : array_like
        Parameters, of any shape. The curve lies over 0 to 1; other values are accepted.

    Returns
    -------
    ndarray, shape (4, \*t.shape)
        The functions that weigh f(0), f(1), f'(0) and f'(1), in this order.

    Raises
    ------
    TypeError
        If `t` does not hold real numbers.
    ValueError
        If `t` is not finite, or a result does not fit a float.

    Notes
    -----
    :math:`H_0 + H_1 = 1` everywhere. Theory: :ref:`Task 1.1 <task-1-1>`.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 15.

    Examples
    --------
    >>> from canim.interpolation import hermite_basis
    >>> hermite_basis([0, 0.5, 1])
    array([[ 1.   ,  0.5  ,  0.   ],
           [ 0.   ,  0.5  ,  1.   ],
           [ 0.   ,  0.125,  0.   ],
           [ 0.   , -0.125,  0.   ]])
    """
    t = floats(t, "t")
    s = 1 - t
    basis = np.empty((4, *t.shape))
    # As products the functions lose no digits where they are small, near 0 and 1.
    basis[0] = (1 + 2 * t) * s * s
    basis[1] = (1 + 2 * s) * t * t
    basis[2] = t * s * s
    basis[3] = 0 - s * t * t  # not -s: its zeros would print as -0
    return finite(basis, "t")


@np.errstate(all="ignore")
def hermite_coefficients(f0: ArrayLike, f1: ArrayLike, d0: ArrayLike, d1: ArrayLike) -> Floats:
    r"""Find the cubic that has the given values and slopes at 0 and 1.

    .. math::

       \begin{bmatrix} a \\ b \\ c \\ d \end{bmatrix} = \mathbf{M}
       \begin{bmatrix} f(0) \\ f(1) \\ f'(0) \\ f'(1) \end{bmatrix},
       \qquad f(t) = a t^3 + b t^2 + c t + d

    with the Hermite matrix :math:`\mathbf{M}`, ``HERMITE_MATRIX``.

    Parameters
    ----------
    f0, f1 : array_like, shape () or (dim,)
        Value or point at t = 0 and at t = 1.
    d0, d1 : array_like, shape () or (dim,)
        Slope or tangent at t = 0 and at t = 1.

    Returns
    -------
    ndarray, shape (4,) or (4, dim)
        The coefficients a, b, c, d: highest power first, as `numpy.polyval` takes them.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If the four shapes differ or are no points, an argument is not finite, or a result
        does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 1.2 <task-1-2>`.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 15.

    Examples
    --------
    >>> from canim.interpolation import hermite_coefficients
    >>> hermite_coefficients(1, 1, 0, 1)
    array([ 1., -1.,  0.,  1.])
    """
    return finite(HERMITE_MATRIX @ _ends(f0, f1, d0, d1), "f0, f1, d0, d1")


@np.errstate(all="ignore")
def hermite_curve(
    t: ArrayLike, f0: ArrayLike, f1: ArrayLike, d0: ArrayLike, d1: ArrayLike
) -> Floats:
    r"""Evaluate the cubic that has the given values and slopes at 0 and 1.

    .. math:: f(t) = H_0(t)\, f(0) + H_1(t)\, f(1) + H_2(t)\, f'(0) + H_3(t)\, f'(1)

    with the basis functions :math:`H_k` of :func:`hermite_basis`.

    Parameters
    ----------
    t : array_like
        Parameters, of any shape: 0 is the start, 1 the end. Other values are accepted.
    f0, f1 : array_like, shape () or (dim,)
        Value or point at t = 0 and at t = 1.
    d0, d1 : array_like, shape () or (dim,)
        Slope or tangent at t = 0 and at t = 1.

    Returns
    -------
    ndarray, shape (\*t.shape,) or (\*t.shape, dim)
        Values, or points where the ends are points; exactly `f0` at 0 and `f1` at 1.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If the shapes of the ends differ or are no points, an argument is not finite, or a
        result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 1.2 <task-1-2>`.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 15.

    Examples
    --------
    >>> from canim.interpolation import hermite_curve
    >>> hermite_curve([0, 0.5, 1], 1, 1, 0, 1)
    array([1.   , 0.875, 1.   ])
    >>> hermite_curve([0, 0.5, 1], (0, 0), (2, 0), (0, 4), (0, -4))
    array([[0., 0.],
           [1., 1.],
           [2., 0.]])
    """
    ends = _ends(f0, f1, d0, d1)
    curve = np.tensordot(ends, hermite_basis(t), axes=(0, 0))
    finite(curve, "t, f0, f1, d0, d1")
    return curve if ends.ndim == 1 else np.moveaxis(curve, 0, -1)


@np.errstate(all="ignore")
def hermite_spline(t: ArrayLike, knots: ArrayLike, values: ArrayLike, slopes: ArrayLike) -> Floats:
    r"""Evaluate the piecewise cubic through given values with given slopes.

    Over each piece, with :math:`h = x_{i+1} - x_i` and :math:`w = (t - x_i) / h`,

    .. math:: f(t) = H_0(w)\, f_i + H_1(w)\, f_{i+1} + h\, (H_2(w)\, d_i + H_3(w)\, d_{i+1}).

    Neighbouring pieces share value and slope, so the curve is C1.

    Parameters
    ----------
    t : array_like
        Where to evaluate, of any shape and in any order; increasing order is quickest.
        Outside the knots the first and the last piece go on.
    knots : array_like, shape (K,)
        :math:`x_i`, at least two, increasing.
    values : array_like, shape (K,) or (K, dim)
        :math:`f_i`, a value or point at each knot.
    slopes : array_like, shape (K,) or (K, dim)
        :math:`d_i`, the derivatives by t there.

    Returns
    -------
    ndarray, shape (\*t.shape,) or (\*t.shape, dim)
        Values, or points where `values` are points.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape, `knots` do not increase, an argument is not finite,
        or a result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 1.2 <task-1-2>`.

    References
    ----------
    C. de Boor, *A Practical Guide to Splines*, revised ed., 2001, chapter IV.

    Examples
    --------
    >>> from canim.interpolation import hermite_spline
    >>> hermite_spline([0, 1, 2, 3], knots=[0, 2, 3], values=[0, 4, 0], slopes=[0, 0, 0])
    array([0., 2., 4., 0.])
    """
    t, knots = floats(t, "t"), increasing(knots, "knots", 2)
    values, slopes = (
        rows(value, name, len(knots)) for value, name in ((values, "values"), (slopes, "slopes"))
    )
    if values.shape != slopes.shape:
        raise ValueError(
            f"values and slopes must have the same shape, "
            f"but have {values.shape} and {slopes.shape}."
        )
    widths = np.diff(knots).reshape(-1, *[1] * (values.ndim - 1))
    ends = np.stack([values[:-1], values[1:], widths * slopes[:-1], widths * slopes[1:]])
    coefficients = np.tensordot(HERMITE_MATRIX, ends, axes=1)
    return evaluate(t, knots, coefficients, "t, knots, values, slopes")


def _ends(f0: ArrayLike, f1: ArrayLike, d0: ArrayLike, d1: ArrayLike) -> Floats:
    """Return the four values or points below each other."""
    ends = [floats(v, name) for v, name in ((f0, "f0"), (f1, "f1"), (d0, "d0"), (d1, "d1"))]
    shapes = [end.shape for end in ends]
    if len(set(shapes)) > 1 or ends[0].ndim > 1 or ends[0].size == 0:
        raise ValueError(
            "f0, f1, d0, d1 must be four numbers or four points of shape (dim,), "
            f"but have shapes {', '.join(map(str, shapes))}."
        )
    return np.stack(ends)
