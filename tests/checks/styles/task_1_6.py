"""Task 1.6 in other styles."""

from math import factorial

import numpy as np


def bernstein_basis__with_factorials(n, t):
    ways = [factorial(n) / factorial(i) / factorial(n - i) for i in range(n + 1)]
    return [ways[i] * t**i * (1 - t) ** (n - i) for i in range(n + 1)]


def bernstein_basis__from_the_degree_below(n, t):
    rows = [np.ones(len(t))]
    for _ in range(n):
        left, right = [0 * t, *rows], [*rows, 0 * t]
        rows = [t * a + (1 - t) * b for a, b in zip(left, right)]
    return rows


def bernstein_basis__moment_by_moment(n, t):
    ways = [1]
    for i in range(n):
        ways.append(ways[-1] * (n - i) // (i + 1))
    columns = [[w * s**i * (1 - s) ** (n - i) for i, w in enumerate(ways)] for s in t]
    return np.array(columns).T
