"""Task 1.3 in other styles."""

import numpy as np


def lagrange_basis__with_lists(nodes, x):
    rows = []
    for j, node in enumerate(nodes):
        others = [other for m, other in enumerate(nodes) if m != j]
        rows.append(
            [np.prod([(place - other) / (node - other) for other in others]) for place in x]
        )
    return rows


def lagrange_interpolate__with_lists(nodes, values, x):
    rows = lagrange_basis__with_lists(nodes, x)
    return [sum(value * row[i] for value, row in zip(values, rows)) for i in range(len(x))]


def lagrange_basis__numerator_and_denominator_apart(nodes, x):
    basis = np.empty((len(nodes), len(x)))
    for j in range(len(nodes)):
        others = np.delete(nodes, j)
        basis[j] = np.prod(x[:, None] - others, axis=1) / np.prod(nodes[j] - others)
    return basis


def lagrange_interpolate__as_a_product(nodes, values, x):
    return values @ lagrange_basis__numerator_and_denominator_apart(nodes, x)


def lagrange_interpolate__from_the_equations(nodes, values, x):
    n = len(nodes)
    return np.polyval(np.linalg.solve(np.vander(nodes, n), values), x)
