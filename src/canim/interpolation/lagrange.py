"""Lagrange interpolation: the one polynomial of lowest degree through all points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from canim._arguments import Floats, finite, floats, rows, vector

__all__ = ["lagrange_basis", "lagrange_interpolate"]

# The weights take a time that grows with the square of the number of nodes.
_MOST_NODES = 10_000

# The Lebesgue function of nodes for which a sum of ratios is as good as their product.
_MOST_LOST = 10

# So many points and nodes are taken at a time that a table of them stays in the cache.
_POINTS, _NODES = 4096, 16


@np.errstate(all="ignore")
def lagrange_basis(nodes: ArrayLike, x: ArrayLike) -> Floats:
    r"""Evaluate the Lagrange basis polynomials.

    .. math:: \ell_j(x) = \prod_{m \ne j} \frac{x - x_m}{x_j - x_m}

    Parameters
    ----------
    nodes : array_like, shape (n,)
        :math:`x_j`, up to 10,000 different numbers in any order.
    x : array_like
        Where to evaluate, of any shape.

    Returns
    -------
    ndarray, shape (n, \*x.shape)
        One basis polynomial after the other: 1 at its own node and 0 at all others.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape or is not finite, a node is repeated, or a result
        does not fit a float.

    Notes
    -----
    The n polynomials add up to 1 everywhere. Theory: :ref:`Task 1.3 <task-1-3>`.

    References
    ----------
    J.-P. Berrut, L. N. Trefethen, *Barycentric Lagrange Interpolation*, SIAM Review 46(3),
    2004.

    Examples
    --------
    >>> from canim.interpolation import lagrange_basis
    >>> lagrange_basis([0, 1, 2], [0, 1, 3])
    array([[ 1.,  0.,  1.],
           [ 0.,  1., -3.],
           [ 0.,  0.,  3.]])
    """
    order, z, size, weights = _weights(nodes)
    places = floats(x, "x")
    flat = places.ravel()
    basis = np.empty((z.size, flat.size))
    step = max(1, _POINTS * _NODES // z.size)
    for start in range(0, flat.size, step):
        part = flat[start : start + step]
        ratios = size / (part - z[:, np.newaxis])
        product = np.multiply.reduce(ratios, axis=0)
        ratios *= weights[:, np.newaxis]
        ratios /= product
        at_node, node = _at_nodes(part, product, z)
        ratios[:, at_node] = 0
        ratios[node, at_node] = 1
        basis[order, start : start + step] = ratios
    return finite(basis, "nodes, x").reshape(z.size, *places.shape)


@np.errstate(all="ignore")
def lagrange_interpolate(nodes: ArrayLike, values: ArrayLike, x: ArrayLike) -> Floats:
    r"""Evaluate the polynomial of lowest degree through given points.

    With the weights :math:`w_j = 1 / \prod_{m \ne j} (x_j - x_m)`,

    .. math::

       L(x) = \sum_j y_j\, \ell_j(x) = \prod_m (x - x_m) \sum_j \frac{w_j\, y_j}{x - x_j}.

    Parameters
    ----------
    nodes : array_like, shape (n,)
        :math:`x_j`, up to 10,000 different numbers in any order.
    values : array_like, shape (n,) or (n, dim)
        :math:`y_j`, a value or point at each node.
    x : array_like
        Where to evaluate, of any shape.

    Returns
    -------
    ndarray, shape (\*x.shape,) or (\*x.shape, dim)
        Values, or points where `values` are points; at a node exactly its value.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If an argument has a wrong shape or is not finite, a node is repeated, or a result
        does not fit a float.

    Notes
    -----
    The right-hand form takes n steps a point, once the weights are known, where the sum of
    products takes n². Many nodes at equal distances let any polynomial swing wildly between
    the outer ones; Chebyshev nodes do not: for such, the product is taken from its equal,
    one over :math:`\sum_j w_j / (x - x_j)`, which is quicker.
    Theory: :ref:`Task 1.3 <task-1-3>`, :ref:`Task 1.4 <task-1-4>`.

    References
    ----------
    J.-P. Berrut, L. N. Trefethen, *Barycentric Lagrange Interpolation*, SIAM Review 46(3),
    2004. N. J. Higham, *The Numerical Stability of Barycentric Lagrange Interpolation*, IMA
    Journal of Numerical Analysis 24(4), 2004.

    Examples
    --------
    >>> from canim.interpolation import lagrange_interpolate
    >>> lagrange_interpolate([1, 2, 3], [1, 1 / 2, 1 / 3], [1, 1.5, 3]).round(4)
    array([1.    , 0.7083, 0.3333])
    """
    order, z, size, weights = _weights(nodes)
    given = rows(values, "values", z.size)
    places = floats(x, "x")
    flat = places.ravel()
    columns = given[order].reshape(z.size, -1).T
    # Near a node the sum grows beyond the values; without their power of two it has room.
    exponent = np.frexp(np.abs(columns).max())[1]
    table = np.vstack([np.ldexp(columns, -exponent) * weights, weights])
    steady = _are_steady(z, size, weights)
    result = np.empty((flat.size, len(columns)))
    buffer = np.empty((_NODES, _POINTS))
    for start in range(0, flat.size, _POINTS):
        part = flat[start : start + _POINTS]
        adds = steady and z.min() <= part.min() and part.max() <= z.max()
        sums, product = np.zeros((len(table), part.size)), np.ones(part.size)
        for first in range(0, z.size, _NODES):
            near = z[first : first + _NODES, np.newaxis]
            ratios = np.subtract(part, near, out=buffer[: len(near), : part.size])
            np.divide(size, ratios, out=ratios)
            sums += table[:, first : first + _NODES] @ ratios
            if not adds:
                product *= np.multiply.reduce(ratios, axis=0)
        if adds:
            product = sums[-1]
        quotients = np.ldexp(sums[:-1] / product, exponent)
        at_node, node = _at_nodes(part, product, z)
        quotients[:, at_node] = columns[:, node]
        result[start : start + _POINTS] = quotients.T
    return finite(result, "nodes, values, x").reshape(places.shape + given.shape[1:])


def _weights(nodes: ArrayLike) -> tuple[NDArray[np.intp], Floats, float, Floats]:
    """Return an order of the nodes, the nodes in it, their size and their weights.

    The size is a mean distance: differences are divided by it so that products of many
    neither overflow nor underflow. The order is mixed for the same reason: nodes that
    follow each other lie far apart.
    """
    given = vector(nodes, "nodes")
    if given.size > _MOST_NODES:
        raise ValueError(
            f"nodes must be at most {_MOST_NODES} for one polynomial, but are {given.size}."
        )
    golden = (np.sqrt(5) - 1) / 2
    ranks = np.argsort(given, kind="stable")
    repeated = np.flatnonzero(np.diff(given[ranks]) == 0)
    if repeated.size:
        i, j = ranks[repeated[0]], ranks[repeated[0] + 1]
        raise ValueError(f"nodes must differ, but nodes[{i}] and nodes[{j}] are {given[i]}.")
    order = ranks[np.argsort(np.arange(given.size) * golden % 1)]
    z = given[order]
    differences = np.abs(z[:_NODES, np.newaxis] - z)
    size = float(np.exp(np.log(differences[differences > 0]).mean())) if z.size > 1 else 1.0
    weights = np.empty_like(z)
    for start in range(0, z.size, _NODES):
        ratios = size / (z[start : start + _NODES, np.newaxis] - z)
        ratios[np.arange(len(ratios)), np.arange(start, start + len(ratios))] = 1
        weights[start : start + _NODES] = np.multiply.reduce(ratios, axis=1)
    if not _normal(weights).all():
        raise ValueError(
            "nodes: too many, too far apart or too uneven, their weights do not fit a float."
        )
    return order, z, size, weights


def _are_steady(z: Floats, size: float, weights: Floats) -> bool:
    r"""Tell whether the product of ratios may be taken from their weighted sum, its equal.

    The sum is quicker, as a row of a matrix product. It loses as many digits as the Lebesgue
    function :math:`\sum_j |\ell_j|` has, which grows fast but for nodes such as Chebyshev's;
    between neighbours it is largest near the middle.
    """
    ranked = np.sort(z)
    middles = (ranked[1:] + ranked[:-1]) / 2
    for start in range(0, middles.size, _NODES):
        ratios = size / (middles[start : start + _NODES, np.newaxis] - z)
        product = np.abs(ratios @ weights)
        if not (np.abs(ratios) @ np.abs(weights) <= _MOST_LOST * product).all():
            return False
    return True


def _at_nodes(x: Floats, product: Floats, z: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return which `x` are nodes, or too close to tell from them, and which nodes.

    There the product is infinite; where it is so elsewhere the polynomial is out of reach.
    """
    bad = np.flatnonzero(~_normal(product))
    if bad.size == 0:
        return bad, bad
    ranks = np.argsort(z)
    gaps = np.concatenate([[np.inf], np.diff(z[ranks]), [np.inf]])
    right = np.clip(np.searchsorted(z, x[bad], sorter=ranks), 1, z.size - 1)
    before, after = np.abs(x[bad] - z[ranks[right - 1]]), np.abs(x[bad] - z[ranks[right]])
    nearest = np.where(before < after, right - 1, right)
    # Nearer than this to the node, measured by its neighbours, there is nothing to tell.
    limit = 1e-100 * np.minimum(gaps[nearest], gaps[nearest + 1])
    if not (np.minimum(before, after) <= limit).all():
        raise ValueError("nodes, x: too large, the result does not fit a float.")
    return bad, ranks[nearest]


def _normal(numbers: Floats) -> NDArray[np.bool_]:
    """Return which numbers are finite and keep all their digits."""
    return np.isfinite(numbers) & (np.abs(numbers) >= np.finfo(np.float64).tiny)
