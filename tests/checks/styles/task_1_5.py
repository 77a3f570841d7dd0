"""Task 1.5 in other styles."""

import numpy as np


def _rows(x, y, start):
    pieces = len(x) - 1
    for i in range(pieces):
        for k in (i, i + 1):
            row = np.zeros(3 * pieces)
            row[3 * i : 3 * i + 3] = x[k] ** 2, x[k], 1
            yield row, y[k]
    for i in range(1, pieces):
        row = np.zeros(3 * pieces)
        row[3 * i - 3 : 3 * i] = 2 * x[i], 1, 0
        row[3 * i : 3 * i + 3] = -2 * x[i], -1, 0
        yield row, 0
    first = np.zeros(3 * pieces)
    first[:2] = (1, 0) if start == "straight" else (2 * x[0], 1)
    yield first, 0


def quadratic_spline_system__as_lists(x, y, start):
    rows, sides = zip(*_rows(x, y, start))
    return [list(row) for row in rows], list(sides)


def quadratic_spline_system__rows_the_other_way_round(x, y, start):
    rows, sides = zip(*_rows(x, y, start))
    return np.array(rows)[::-1], np.array(sides)[::-1]


def quadratic_spline_system__with_other_signs_and_factors(x, y, start):
    rows, sides = map(np.array, zip(*_rows(x, y, start)))
    factors = np.where(np.arange(len(rows)) % 2, -1.0, 2.0)
    return rows * factors[:, None], sides * factors


def quadratic_spline_system__start_first(x, y, start):
    *rest, first = _rows(x, y, start)
    rows, sides = zip(first, *rest)
    return np.array(rows), np.array(sides)
