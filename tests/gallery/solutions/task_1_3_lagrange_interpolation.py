import numpy as np


def lagrange_basis(nodes, x):
    """Return one row per node: row j is the curve ℓj at every x."""
    n = len(nodes)
    basis = np.ones((n, len(x)))
    for j in range(n):
        for m in range(n):
            if m != j:
                basis[j] = basis[j] * factor(nodes, x, j, m)
    return basis


def lagrange_interpolate(nodes, values, x):
    """Return L, the curve through all points, at every x."""
    basis = lagrange_basis(nodes, x)
    L = np.zeros(len(x))
    for j in range(len(nodes)):
        L = L + values[j] * basis[j]
    return L
