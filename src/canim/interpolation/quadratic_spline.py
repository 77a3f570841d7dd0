"""Quadratic splines: parabolas that join with one slope."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from canim._arguments import Floats, finite, floats, increasing, vector
from canim.interpolation._piecewise import evaluate

__all__ = ["QuadraticSpline", "quadratic_spline", "quadratic_spline_system"]

Start = Literal["straight", "flat"] | float

# The full matrix of more points would fill the memory of a small computer.
_MOST_POINTS = 3000


@dataclass(frozen=True, eq=False, repr=False)
class QuadraticSpline:
    """The spline that :func:`quadratic_spline` makes; call it to evaluate it.

    Attributes
    ----------
    knots : ndarray, shape (K,)
        Where the pieces begin and end.
    values, slopes : ndarray, shape (K,)
        Value and slope at each knot.
    coefficients : ndarray, shape (K - 1, 3)
        a, b, c of each piece a x² + b x + c, as `numpy.polyval` takes them. Far from 0 the
        powers of x are so large that little is left of a sum of them: with knots one apart
        near 1e8 no digit is right. Calling the spline has no such error.

    Examples
    --------
    >>> from canim.interpolation import quadratic_spline
    >>> spline = quadratic_spline([0, 1, 2], [0, 1, 0])
    >>> spline([0.5, 1, 1.5])
    array([0.5, 1. , 1. ])
    >>> spline.slopes
    array([ 1.,  1., -3.])
    """

    knots: Floats
    values: Floats
    slopes: Floats
    coefficients: Floats

    @np.errstate(all="ignore")
    def __call__(self, x: ArrayLike) -> Floats:
        r"""Evaluate the spline.

        Parameters
        ----------
        x : array_like
            Where to evaluate, of any shape and in any order. Outside the knots the first
            and the last piece go on.

        Returns
        -------
        ndarray, shape (\*x.shape,)
            The values of the spline.

        Raises
        ------
        TypeError
            If `x` does not hold real numbers.
        ValueError
            If `x` is not finite, or a result does not fit a float.
        """
        # Powers of x lose digits far from 0; counted from its knot, a piece is exact there.
        rise = np.diff(self.values)
        start = np.diff(self.knots) * self.slopes[:-1]
        pieces = np.stack([rise - start, start, self.values[:-1]])
        return evaluate(floats(x, "x"), self.knots, pieces, "x")


@np.errstate(all="ignore")
def quadratic_spline(x: ArrayLike, y: ArrayLike, start: Start = "straight") -> QuadraticSpline:
    r"""Find the quadratic spline through given points.

    The slopes :math:`m_i` at the knots follow from the first one and from the slopes
    :math:`s_i` of the straight lines between the points:

    .. math::

       m_{i+1} = 2 s_i - m_i, \qquad s_i = \frac{y_{i+1} - y_i}{x_{i+1} - x_i}.

    Parameters
    ----------
    x : array_like, shape (K,)
        The knots, at least two, increasing.
    y : array_like, shape (K,)
        The value at each knot.
    start : {"straight", "flat"} or float
        How the spline starts: with a straight line (:math:`a_0 = 0`), with slope zero, or
        with the slope that is given.

    Returns
    -------
    QuadraticSpline
        Call it to evaluate it; it has ``knots``, ``values``, ``slopes``, and
        ``coefficients`` a, b, c of shape (K - 1, 3).

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape, `x` does not increase, `start` is another word, an
        argument is not finite, or a result does not fit a float.

    Notes
    -----
    The spline has one slope at every knot, but not one second derivative: it is C1. An error
    in the start slope comes back at every knot, with alternating sign and undamped.
    Theory: :ref:`Task 1.5 <task-1-5>`.

    References
    ----------
    C. de Boor, *A Practical Guide to Splines*, revised ed., 2001, chapter VI.

    Examples
    --------
    >>> from canim.interpolation import quadratic_spline
    >>> spline = quadratic_spline([-3, -1, 1, 3], [15, 5, 8, 9])
    >>> spline.coefficients
    array([[ 0.  , -5.  ,  0.  ],
           [ 3.25,  1.5 ,  3.25],
           [-3.75, 15.5 , -3.75]])
    >>> spline([-2, 0, 2])
    array([10.  ,  3.25, 12.25])
    """
    knots, values, slope = _checked(x, y, start)
    widths = finite(knots[1:] - knots[:-1], "x")
    lines = (values[1:] - values[:-1]) / widths
    first = lines[0] if slope is None else slope
    # With every other sign turned the recurrence is a running sum, rounding included.
    slopes = np.concatenate([[first], -2 * lines])
    slopes[2::2] *= -1
    np.cumsum(slopes, out=slopes)
    slopes[1::2] *= -1
    a = (lines - slopes[:-1]) / widths
    part = a * knots[:-1]
    b = slopes[:-1] - 2 * part
    c = values[:-1] - (slopes[:-1] - part) * knots[:-1]
    coefficients = finite(np.array([a, b, c]), "x, y, start").T
    return QuadraticSpline(knots.copy(), values.copy(), finite(slopes, "x, y, start"), coefficients)


@np.errstate(all="ignore")
def quadratic_spline_system(
    x: ArrayLike, y: ArrayLike, start: Start = "straight"
) -> tuple[Floats, Floats]:
    r"""Write the quadratic spline through given points as a linear system.

    The unknowns are :math:`a_0, b_0, c_0, a_1, b_1, c_1, \dots`, three a piece
    :math:`f_i(x) = a_i x^2 + b_i x + c_i`, for i from 0 to K - 2. The rows are

    .. math::

       f_i(x_i) = y_i, \quad f_i(x_{i+1}) &= y_{i+1} && \text{two for each piece,} \\
       f_i'(x_{i+1}) - f_{i+1}'(x_{i+1}) &= 0 && \text{one for each inner knot,} \\
       a_0 = 0 \ \text{ or } \ f_0'(x_0) &= m_0 && \text{the start.}

    Parameters
    ----------
    x : array_like, shape (K,)
        The knots, from 2 to 3000 of them, increasing.
    y : array_like, shape (K,)
        The value at each knot.
    start : {"straight", "flat"} or float
        How the spline starts: with a straight line (:math:`a_0 = 0`), with slope zero, or
        with the slope that is given.

    Returns
    -------
    A : ndarray, shape (3 (K - 1), 3 (K - 1))
        The matrix of the system, one equation a row.
    b : ndarray, shape (3 (K - 1),)
        Its right-hand side.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape, `x` does not increase or has more than 3000 knots,
        `start` is another word, an argument is not finite, or a result does not fit a float.

    Notes
    -----
    The full system shows where the spline comes from; :func:`quadratic_spline` finds the
    same one without a matrix. It also finds it far from 0, where this matrix, which holds
    powers of x, cannot be solved. Theory: :ref:`Task 1.5 <task-1-5>`.

    References
    ----------
    C. de Boor, *A Practical Guide to Splines*, revised ed., 2001, chapter VI.

    Examples
    --------
    >>> import numpy as np
    >>> from canim.interpolation import quadratic_spline_system
    >>> A, b = quadratic_spline_system([0, 1, 2], [0, 1, 0])
    >>> A
    array([[ 0.,  0.,  1.,  0.,  0.,  0.],
           [ 1.,  1.,  1.,  0.,  0.,  0.],
           [ 0.,  0.,  0.,  1.,  1.,  1.],
           [ 0.,  0.,  0.,  4.,  2.,  1.],
           [ 2.,  1.,  0., -2., -1.,  0.],
           [ 1.,  0.,  0.,  0.,  0.,  0.]])
    >>> np.linalg.solve(A, b).reshape(-1, 3)
    array([[ 0.,  1.,  0.],
           [-2.,  5., -2.]])
    """
    knots, values, slope = _checked(x, y, start)
    if len(knots) > _MOST_POINTS:
        raise ValueError(
            f"x must have at most {_MOST_POINTS} numbers for a full matrix, but has {len(knots)}."
        )
    pieces = len(knots) - 1
    A, b = np.zeros((3 * pieces, 3 * pieces)), np.zeros(3 * pieces)
    value_rows = np.stack([knots**2, knots, np.ones_like(knots)], axis=1)
    slope_rows = np.stack([2 * knots, np.ones_like(knots), np.zeros_like(knots)], axis=1)
    for i in range(pieces):
        A[2 * i : 2 * i + 2, 3 * i : 3 * i + 3] = value_rows[i : i + 2]
        b[2 * i : 2 * i + 2] = values[i : i + 2]
    for i in range(1, pieces):
        A[2 * pieces + i - 1, 3 * i - 3 : 3 * i] = slope_rows[i]
        A[2 * pieces + i - 1, 3 * i : 3 * i + 3] -= slope_rows[i]
    if slope is None:
        A[-1, 0] = 1
    else:
        A[-1, :3], b[-1] = slope_rows[0], slope
    return finite(A, "x"), b


def _checked(x: ArrayLike, y: ArrayLike, start: Start) -> tuple[Floats, Floats, float | None]:
    """Return knots, values and start slope; None stands for a straight start."""
    knots, values = increasing(x, "x", 2), vector(y, "y")
    if len(knots) != len(values):
        raise ValueError(
            f"x and y must have the same number of values, but have {len(knots)} and {len(values)}."
        )
    if isinstance(start, str):
        if start not in ("straight", "flat"):
            raise ValueError(f'start must be "straight", "flat" or a slope, but is {start!r}.')
        return knots, values, None if start == "straight" else 0.0
    slope = floats(start, "start")
    if slope.ndim:
        raise ValueError(f"start must be a single slope, but has shape {slope.shape}.")
    return knots, values, float(slope)
