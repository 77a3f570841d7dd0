"""Task 0.0 in other styles."""

import numpy as np


def blend__with_the_way(a, b, t):
    return a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])


def blend__with_loops_and_lists(a, b, t):
    return [[(1 - s) * a[k] + s * b[k] for s in t] for k in range(2)]


def blend__with_outer_products(a, b, t):
    return np.outer(a, 1 - t) + np.outer(b, t)
