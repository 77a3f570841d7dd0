"""Evaluate piecewise polynomials."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from canim._arguments import Floats, finite

# So many points are evaluated at a time that they stay in the cache.
_BLOCK = 2**14

# From so many points a piece, a block for each piece is quicker than a table look-up.
_LONG_PIECE = 2000


def evaluate(t: Floats, knots: Floats, coefficients: Floats) -> Floats:
    """Return the piecewise polynomial at `t`; the end pieces go on outside the knots.

    `coefficients`, shape (order, pieces) or (order, pieces, dim), highest power first,
    belong to powers of w, which runs from 0 to 1 along each piece.
    """
    flat = t.ravel()
    widths = finite(np.diff(knots), "knots")
    order = len(coefficients)
    columns = coefficients.reshape(order, widths.size, -1).T.swapaxes(1, 2)
    table = np.concatenate([knots[np.newaxis, :-1], widths[np.newaxis], *columns])
    result = np.empty((len(columns), flat.size))
    for piece, span in _spans(flat, knots[1:-1]):
        knot, width, *rest = table.take(piece, axis=1)
        w = flat[span] - knot
        w /= width
        for row in result:
            leading, *middle, constant = rest[:order]
            del rest[:order]
            value = leading * w
            for coefficient in middle:
                value += coefficient
                value *= w
            np.add(value, constant, out=row[span])
    return result.T.reshape(t.shape + coefficients.shape[2:])


def _spans(t: Floats, inner: Floats) -> Iterator[tuple[int | NDArray[np.intp], slice]]:
    """Yield blocks of `t` with the number of their piece, or of the piece of each point."""
    if (t[1:] >= t[:-1]).all():
        edges = np.array([0, *np.searchsorted(t, inner), t.size])
        if t.size >= _LONG_PIECE * (inner.size + 1):
            for piece, (first, last) in enumerate(pairwise(edges.tolist())):
                for start in range(first, last, _BLOCK):
                    yield piece, slice(start, min(start + _BLOCK, last))
            return
        pieces = np.repeat(np.arange(inner.size + 1, dtype=np.int32), np.diff(edges))
    else:
        pieces = np.searchsorted(inner, t, side="right")
    for start in range(0, t.size, _BLOCK):
        span = slice(start, start + _BLOCK)
        yield pieces[span], span
