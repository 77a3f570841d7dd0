"""Linear interpolation: the straight way from one value or point to another."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from canim._arguments import Floats, finite, floats

__all__ = ["lerp"]


@np.errstate(all="ignore")
def lerp(start: ArrayLike, end: ArrayLike, t: ArrayLike) -> Floats:
    r"""Interpolate linearly between two values, points or sets of points.

    .. math:: \mathbf{L}(t) = (1 - t)\,\mathbf{P}_0 + t\,\mathbf{P}_1

    Parameters
    ----------
    start, end : array_like
        :math:`\mathbf{P}_0` and :math:`\mathbf{P}_1`: two numbers, two points of shape
        (dim,), or two arrays of any one shape.
    t : array_like
        Parameters, of any shape: 0 is the start, 1 the end. Other values lie on the same
        line, before the start or beyond the end.

    Returns
    -------
    ndarray, shape (\*t.shape, \*start.shape)
        One value or point for each parameter; exactly `start` at 0 and `end` at 1.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If `start` and `end` have different shapes, an argument is not finite, or a result
        does not fit a float.

    Notes
    -----
    A Bézier curve of degree 1, the first step to :ref:`Task 1.7 <task-1-7>`.

    References
    ----------
    P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd ed., 2009, chapter 15.

    Examples
    --------
    >>> from canim.interpolation import lerp
    >>> lerp((0, 1), (4, 3), [0, 0.25, 1])
    array([[0. , 1. ],
           [1. , 1.5],
           [4. , 3. ]])
    """
    first, last, parameters = floats(start, "start"), floats(end, "end"), floats(t, "t")
    if first.shape != last.shape:
        raise ValueError(
            f"start and end must have the same shape, but have {first.shape} and {last.shape}."
        )
    # The parameters run along the last axes while computing: NumPy is quick along a long axis.
    result = np.multiply.outer(first, 1 - parameters)
    result += np.multiply.outer(last, parameters)
    axes = range(first.ndim)
    return np.moveaxis(finite(result, "start, end, t"), axes, [axis - first.ndim for axis in axes])
