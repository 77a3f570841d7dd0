"""Task 1.2 in other styles."""

import numpy as np

M__without_arrays = [[2, -2, 1, 1], [-3, 3, -2, -1], [0, 0, 1, 0], [1, 0, 0, 0]]


def hermite_coefficients__without_arrays(f0, f1, d0, d1):
    wishes = (f0, f1, d0, d1)
    return [sum(m * w for m, w in zip(row, wishes)) for row in M__without_arrays]


def hermite_curve__without_arrays(t, f0, f1, d0, d1):
    a, b, c, d = hermite_coefficients__without_arrays(f0, f1, d0, d1)
    return [((a * s + b) * s + c) * s + d for s in t]


M__by_inverting = np.linalg.inv([[0, 0, 0, 1], [1, 1, 1, 1], [0, 0, 1, 0], [3, 2, 1, 0]])


def hermite_coefficients__by_inverting(*wishes):
    return np.dot(M__by_inverting, wishes)


def hermite_curve__by_inverting(t, *wishes):
    return np.polyval(hermite_coefficients__by_inverting(*wishes), t)


def hermite_coefficients__from_the_formulas(f0, f1, d0, d1):
    return 2 * (f0 - f1) + d0 + d1, 3 * (f1 - f0) - 2 * d0 - d1, d0, f0


def hermite_curve__with_powers_as_columns(t, f0, f1, d0, d1):
    T = np.column_stack([t**3, t**2, t, t**0])
    return T @ np.array(M__without_arrays) @ [f0, f1, d0, d1]
