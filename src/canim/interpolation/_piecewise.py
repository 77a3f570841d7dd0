"""Evaluate piecewise polynomials."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from canim._arguments import Floats, finite

# So many points are evaluated at a time that they stay in the cache.
_BLOCK = 2**15

# A block of at most so many pieces is quicker done piece by piece.
_FEW = 10


def evaluate(t: Floats, knots: Floats, coefficients: Floats, names: str) -> Floats:
    """Return the piecewise polynomial at `t`; the end pieces go on outside the knots.

    `coefficients`, shape (order, pieces) or (order, pieces, dim), highest power first,
    belong to powers of w, which runs from 0 to 1 along each piece. `names` are the arguments
    to name where the result does not fit a float.
    """
    flat = t.ravel()
    widths = finite(np.diff(knots), "knots")
    order = len(coefficients)
    columns = coefficients.reshape(order, widths.size, -1).T.swapaxes(1, 2)
    pieces = np.concatenate([knots[np.newaxis, :-1], widths[np.newaxis], *columns])
    result = np.empty((len(columns), flat.size))
    for span, (knot, width, *rest) in _spans(flat, knots[1:-1], pieces):
        w = flat[span] - knot
        w /= width
        for row in result:
            leading, *middle, constant = rest[:order]
            del rest[:order]
            value = leading * w
            for coefficient in middle:
                value += coefficient
                value *= w
            finite(np.add(value, constant, out=row[span]), names)
    return result.T.reshape(t.shape + coefficients.shape[2:])


def _spans(t: Floats, inner: Floats, pieces: Floats) -> Iterator[tuple[slice, Floats]]:
    """Yield spans of `t`, each with its column of `pieces`, or with a column for every point."""
    for start in range(0, t.size, _BLOCK):
        part = t[start : start + _BLOCK]
        span = slice(start, start + part.size)
        if not (part[1:] >= part[:-1]).all():
            yield span, pieces.take(np.searchsorted(inner, part, side="right"), axis=1)
            continue
        first, last = np.searchsorted(inner, part[[0, -1]], side="right")
        edges = np.array([0, *np.searchsorted(part, inner[first:last]), part.size])
        if last - first < _FEW:
            for piece, (begin, end) in enumerate(pairwise((edges + start).tolist()), first):
                yield slice(begin, end), pieces[:, piece]
        else:
            yield span, np.repeat(pieces[:, first : last + 1], np.diff(edges), axis=1)
