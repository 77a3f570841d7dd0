"""Task 1.1 in other styles."""

import numpy as np


def hermite_basis__with_loops_and_lists(t):
    rows = [[], [], [], []]
    for s in t:
        rows[0].append(2 * s * s * s - 3 * s * s + 1)
        rows[1].append(3 * s * s - 2 * s * s * s)
        rows[2].append(s * (s - 1) * (s - 1))
        rows[3].append(s * s * (s - 1))
    return rows


def hermite_basis__as_a_matrix(t):
    M = np.array([[2, -3, 0, 1], [-2, 3, 0, 0], [1, -2, 1, 0], [1, -1, 0, 0]])
    return M @ np.array([t**3, t**2, t, np.ones(len(t))])


def hermite_basis__as_a_tuple_of_polynomials(t):
    return tuple(
        np.polyval(c, t) for c in ([2, -3, 0, 1], [-2, 3, 0, 0], [1, -2, 1, 0], [1, -1, 0, 0])
    )


def hermite_basis__one_from_the_other(t):
    h1 = t**2 * (3 - 2 * t)
    return np.vstack([1 - h1, h1, t * (1 - t) ** 2, -(t**2) * (1 - t)])
