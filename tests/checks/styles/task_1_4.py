"""Task 1.4 in other styles."""

import numpy as np

from canim import interpolation


def f__a_sine(x):
    return np.sin(x)


nodes__a_sine = [0.0, 0.5, 1.5, 3.0, 4.0]


def sample__all_at_once(f, nodes):
    return f(np.array(nodes))


def interpolate__all_at_once(f, nodes, x):
    return interpolation.lagrange_interpolate(nodes, sample__all_at_once(f, nodes), x)


def sample__as_a_list(f, nodes):
    return [f(node) for node in nodes]


def interpolate__by_the_basis(f, nodes, x):
    return sample__as_a_list(f, nodes) @ interpolation.lagrange_basis(nodes, x)


def interpolate__as_a_polynomial(f, nodes, x):
    return np.polyval(np.polyfit(nodes, sample__as_a_list(f, nodes), len(nodes) - 1), x)
