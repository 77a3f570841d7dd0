"""Evaluate piecewise polynomials."""

from __future__ import annotations

import numpy as np

from canim._arguments import Floats, finite

# So many points are evaluated at a time that they stay in the cache.
_BLOCK = 2**15


def evaluate(t: Floats, knots: Floats, coefficients: Floats) -> Floats:
    """Return the piecewise polynomial at `t`; the end pieces go on outside the knots.

    `coefficients`, shape (order, pieces) or (order, pieces, dim), highest power first,
    belong to powers of w, which runs from 0 to 1 along each piece.
    """
    flat = t.ravel()
    widths = finite(np.diff(knots), "knots")
    order = len(coefficients)
    columns = coefficients.reshape(order, widths.size, -1).T.swapaxes(1, 2)
    pieces = np.concatenate([knots[np.newaxis, :-1], widths[np.newaxis], *columns])
    result = np.empty((len(columns), flat.size))
    for start in range(0, flat.size, _BLOCK):
        part = flat[start : start + _BLOCK]
        knot, width, *rest = _of_each(part, knots[1:-1], pieces)
        w = part - knot
        w /= width
        for row in result:
            value, *lower = rest[:order]
            del rest[:order]
            for coefficient in lower:
                value *= w
                value += coefficient
            row[start : start + _BLOCK] = value
    return result.T.reshape(t.shape + coefficients.shape[2:])


def _of_each(t: Floats, inner: Floats, pieces: Floats) -> Floats:
    """Return the columns of `pieces` for each `t`, or the one column that is for all."""
    if not (t[1:] >= t[:-1]).all():
        return pieces.take(np.searchsorted(inner, t, side="right"), axis=1)
    first, last = np.searchsorted(inner, t[[0, -1]], side="right")
    if first == last:
        return pieces[:, first]
    edges = np.searchsorted(t, inner[first:last])
    counts = np.diff(edges, prepend=0, append=t.size)
    return np.repeat(pieces[:, first : last + 1], counts, axis=1)
