import numpy as np

import canim


def f(x):
    """Return the height of your curve at x."""
    return 1 / x


nodes = np.array([1, 2, 3])


def sample(f, nodes):
    """Return the values: the height of f at each node."""
    values = np.zeros(len(nodes))
    for k in range(len(nodes)):
        values[k] = f(nodes[k])
    return values


def interpolate(f, nodes, x):
    """Return L, made from the samples of f at the nodes, at every x."""
    values = sample(f, nodes)
    L = canim.interpolation.lagrange_interpolate(nodes, values, x)
    return L
