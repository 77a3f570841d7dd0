r"""
.. _task-1-3:

Task 1.3: One curve through all points
======================================

You draw the one smooth curve of lowest degree that passes through all given points. An
animator uses it where a thing must be at certain places, and no slopes are known.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

nodes = np.array([-8.0, -1.0, 2.0, 7.0])  # where the points are, from left to right
values = np.array([-5.0, 5.0, -8.0, 9.0])  # how high they are
x = np.linspace(-9, 8, 341)

# %%
# Expected result
# ---------------
# First four curves, one for each point. Each is 1 at its own node (red) and 0 at the nodes
# of the others (black). They do not know yet how high the points are.

from canim import interpolation

basis = interpolation.lagrange_basis(nodes, x)

# Picture: Four curves over x from -9 to 8. Red dots at height 1 and black dots at height 0
# stand above the nodes -8, -1, 2 and 7. Each curve passes through one red dot and, at the three
# other nodes, through the black dots.
fig, ax = plt.subplots(num="Expected result: basis")
ax.set(xlim=(-9, 8), ylim=(-1.2, 1.8), xlabel="x", ylabel="weight")
for j in range(len(nodes)):
    ax.plot(x, basis[j], label=f"ℓ{j}")
ax.plot(nodes, np.zeros(len(nodes)), "o", color="black")
ax.plot(nodes, np.ones(len(nodes)), "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Then the same curves, each stretched to the height of its point. Where one of them passes
# through its red point, the others are 0. So their sum :math:`L` (dashed) passes through
# all points.

# Picture: Four red points, at (-8, -5), (-1, 5), (2, -8) and (7, 9). Four coloured curves each
# pass through one of the points and are 0 below or above the others. A dashed black curve L
# passes through all four points.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(-9, 8), ylim=(-16, 18), xlabel="x", ylabel="y")
for j in range(len(nodes)):
    ax.plot(x, values[j] * basis[j], label=f"{values[j]:g} ℓ{j}")
L = interpolation.lagrange_interpolate(nodes, values, x)
ax.plot(x, L, "--", color="black", label="L")
ax.plot(nodes, values, "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# Think of four lamps in a row. A good panel has one dimmer for each lamp: it sets the
# brightness of its own lamp and leaves the others as they are. Then every pattern of light
# is easy to set.
#
# The points are the lamps. Their places :math:`x_0, x_1, \dots` are called **nodes**, their
# heights :math:`y_0, y_1, \dots` are the brightness. For each node :math:`j` we want a
# dimmer: a curve :math:`\ell_j` ("ell j") that is 1 at its own node and 0 at every other.
#
# How do we make a curve that is 0 at the node :math:`x_m`? The difference
# :math:`x - x_m` is 0 there. To make it 1 at our own node :math:`x_j`, we divide by the
# value that it has there:
#
# .. math::
#
#    \frac{x - x_m}{x_j - x_m}
#
# This **factor** is a straight line: 0 at :math:`x_m` and 1 at :math:`x_j`. Multiply such
# factors, one for each other node. A product is 0 as soon as one of its factors is 0, and
# ones multiplied stay 1. With three nodes, the first curve has two factors:
#
# .. math::
#
#    \ell_0(x) = \frac{x - x_1}{x_0 - x_1} \cdot
#                \frac{x - x_2}{x_0 - x_2}
#
# With :math:`n` nodes each curve has :math:`n - 1` factors. The sign :math:`\prod` means:
# multiply all of these.
#
# .. math::
#
#    \ell_j(x) = \prod_{\substack{m = 0 \\ m \ne j}}^{n - 1}
#                \frac{x - x_m}{x_j - x_m}
#
# These are the **Lagrange basis polynomials**. Now set every dimmer to the height of its
# point, and add:
#
# .. math::
#
#    L(x) = \sum_{j = 0}^{n - 1} y_j \, \ell_j(x)
#
# At the node :math:`x_2`, say, all terms but one are 0. What is left is
# :math:`y_2 \cdot 1`. More in :cite:t:`BerrutTrefethen2004`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    factor(nodes, x, j, m):
#        return (x - x_m) / (x_j - x_m)
#
#    lagrange_basis(nodes, x):
#        for every node j:
#            row j of the basis = 1
#            for every node m:
#                if m is not j:
#                    multiply row j by the factor
#        return the basis
#
#    lagrange_interpolate(nodes, values, x):
#        L = 0
#        for every node j:
#            add y_j times row j of the basis
#        return L

# %%
# Your task
# ---------
# Write the basis, then :math:`L`. Both must work for any number of nodes: count them with
# ``len(nodes)``. The factor is given.
#
# What is not written yet is ``nan`` ("not a number"), which draws nothing. Whatever you
# multiply or add to ``nan`` stays ``nan``. So begin each product with 1, and the sum with 0.


def factor(nodes, x, j, m):
    """Return the straight line that is 1 at node j and 0 at node m."""
    return (x - nodes[m]) / (nodes[j] - nodes[m])


def lagrange_basis(nodes, x):
    """Return one row per node: row j is the curve ℓj at every x."""
    n = len(nodes)
    basis = np.full((n, len(x)), np.nan)
    # TODO: for every node j: basis[j] begins with 1, then multiply
    return basis


def lagrange_interpolate(nodes, values, x):
    """Return L, the curve through all points, at every x."""
    basis = lagrange_basis(nodes, x)
    L = np.full(len(x), np.nan)
    # TODO: L begins with 0, then add
    return L


# %%
# Check and draw
# --------------
# Begin with the basis and look at its picture: is every curve 1 at its own node? The check
# also tries other nodes, and other numbers of them. Before you start it says:

canim.check("1.3", lagrange_basis=lagrange_basis, lagrange_interpolate=lagrange_interpolate)

# Picture: The axes of the first picture with its red and black dots. The four curves are named
# as missing.
basis = lagrange_basis(nodes, x)
fig, ax = plt.subplots(num="Yours: basis")
ax.set(xlim=(-9, 8), ylim=(-1.2, 1.8), xlabel="x", ylabel="weight")
for j in range(len(nodes)):
    ax.plot(x, basis[j], label=f"ℓ{j}")
ax.plot(nodes, np.zeros(len(nodes)), "o", color="black")
ax.plot(nodes, np.ones(len(nodes)), "o", color="red")
canim.plotting.label_curves(ax)

# Picture: The axes of the second picture with its four red points. The four curves and L are
# named as missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(-9, 8), ylim=(-16, 18), xlabel="x", ylabel="y")
for j in range(len(nodes)):
    ax.plot(x, values[j] * basis[j], label=f"{values[j]:g} ℓ{j}")
L = lagrange_interpolate(nodes, values, x)
ax.plot(x, L, "--", color="black", label="L")
ax.plot(nodes, values, "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Set all four ``values`` to 1. Predict :math:`L`, then draw it. Why is it so?
# 2. Lift only the last point, from 9 to 14. Which part of :math:`L` will move? Predict it,
#    then draw it. Would an animator like that?
# 3. Add a fifth point. Which curves of the basis change? Which lines of your program?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.lagrange_basis` and
# :func:`canim.interpolation.lagrange_interpolate`, which takes a faster way to the same
# curve. Next: :ref:`Task 1.4 <task-1-4>`, where the points come from a curve that you
# choose.
