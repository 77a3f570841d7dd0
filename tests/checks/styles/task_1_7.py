"""Task 1.7 in other styles."""

import itertools

import numpy as np


def cubic_bezier__as_a_matrix(P, t):
    weights = np.array([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3])
    return weights.T @ P


def cubic_bezier__with_x_and_y_apart(P, t):
    def mixed(p):
        u = 1 - t
        return u**3 * p[0] + 3 * u**2 * t * p[1] + 3 * u * t**2 * p[2] + t**3 * p[3]

    return list(zip(mixed(P[:, 0]), mixed(P[:, 1])))


def cubic_bezier__by_halving_lines(P, t):
    points = []
    for s in t:
        level = list(P)
        while len(level) > 1:
            level = [(1 - s) * p + s * q for p, q in itertools.pairwise(level)]
        points.append(level[0])
    return points
