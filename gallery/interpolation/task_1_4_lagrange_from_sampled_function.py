r"""
.. _task-1-4:

Task 1.4: Rebuild a curve from samples
======================================

You pick a curve, keep only a few of its points, and rebuild it from these. A recorded
movement is stored like this: as samples, and a rule that fills the gaps.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

# The window of the picture: change it to suit your own curve.
left, right = 0.5, 3.5
bottom, top = 0.0, 2.2
x = np.linspace(left, right, 301)

# %%
# Expected result
# ---------------
# Here the curve is :math:`f(x) = 1/x` (green), sampled at 1, 2 and 3 (red). The rebuilt
# curve :math:`L` (dashed) is not the same as :math:`f`. But at the samples they meet.
# You will choose a curve of your own.

from canim import interpolation


def reciprocal(x):
    """Return the height of the example."""
    return 1 / x


samples = np.array([1.0, 2.0, 3.0])

# Picture: A dashed green curve f falls from height 2 at x = 0.5 to 0.3 at x = 3.5. A dashed
# black curve L crosses it at three red dots, at x = 1, 2 and 3. Left of the first dot L runs
# well below f, between the dots close to it, right of the last one above it.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(left, right), ylim=(bottom, top), xlabel="x", ylabel="y")
L = interpolation.lagrange_interpolate(samples, reciprocal(samples), x)
ax.plot(x, reciprocal(x), "--", color="mediumseagreen", linewidth=4, label="f")
ax.plot(x, L, "--", color="black", label="L")
ax.plot(samples, reciprocal(samples), "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# A flip book holds a few pictures of a movement. Between two pictures your eye must guess.
# With samples it is the same. To **sample** a curve :math:`f` means: choose some places
# :math:`x_k`, the nodes, and write down the height of the curve at each.
#
# .. math::
#
#    y_k = f(x_k)
#
# From now on we forget :math:`f`. All we have is the list of points
# :math:`(x_k, y_k)`. From :ref:`Task 1.3 <task-1-3>` we know a curve :math:`L` through all
# of them. At every node it is right:
#
# .. math::
#
#    L(x_k) = y_k = f(x_k)
#
# Between the nodes :math:`L` is only a guess. How good is it? That depends on the curve,
# and on the nodes. In the picture the guess is good between 1 and 3. Its largest error
# there is 0.046, at :math:`x = 1.35`. To the left of the first sample the error is more
# than ten times as large: there :math:`L` knows nothing, and :math:`f` climbs fast.
#
# Two rules for your choice: the nodes must differ from each other, and :math:`f` must have
# a value at each. The curve :math:`1/x` has none at 0. More in
# :cite:t:`BerrutTrefethen2004`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    f(x):
#        return the height of your curve
#
#    nodes: three places or more
#
#    sample(f, nodes):
#        for every node k:
#            value k = f at node k
#        return the values
#
#    interpolate(f, nodes, x):
#        values = the samples of f at the nodes
#        L = the Lagrange curve through these
#        return L

# %%
# Your task
# ---------
# Choose your curve ``f`` and at least three nodes. Then write the two functions. For
# :math:`L`, call ``canim.interpolation.lagrange_interpolate(nodes, values, x)``. It needs the
# whole name: the function is in the part ``interpolation`` of ``canim``. Or copy your own from
# Task 1.3, with the two functions it uses.
#
# In ``sample(f, nodes)`` the first argument is a function. It is used like any other:
# ``f(2)`` is its value at 2. What is not written yet is ``nan`` ("not a number"), and whatever
# you add to ``nan`` or multiply by it stays ``nan``. Your curve may not fit the window at
# once: change ``left``, ``right``, ``bottom`` and ``top`` at the beginning of the program.


def f(x):
    """Return the height of your curve at x."""
    return np.nan * x  # TODO: your curve, such as 1 / x or np.sin(x)


nodes = np.array([1.0, np.nan, np.nan])  # TODO: three places or more; the first is given


def sample(f, nodes):
    """Return the values: the height of f at each node."""
    values = np.full(len(nodes), np.nan)
    # TODO: values
    return values


def interpolate(f, nodes, x):
    """Return L, made from the samples of f at the nodes, at every x."""
    values = sample(f, nodes)
    L = np.full(len(x), np.nan)
    # TODO: L, from nodes and values
    return L


# %%
# Check and draw
# --------------
# The check works with your curve and your nodes, and then tries two others. Before you
# start it says:

canim.check("1.4", f=f, nodes=nodes, sample=sample, interpolate=interpolate)

# Picture: The same axes as above, still empty. The curves f and L are named as missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(left, right), ylim=(bottom, top), xlabel="x", ylabel="y")
heights = [f(place) for place in x]
known = np.isfinite([*nodes, *sample(f, nodes)]).all()  # L needs every node and value
ax.plot(x, heights, "--", color="mediumseagreen", linewidth=4, label="f")
L = interpolate(f, nodes, x) if known else np.nan * x
ax.plot(x, L, "--", color="black", label="L")
ax.plot(nodes, sample(f, nodes), "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Take ``1 / (1 + 25 * x**2)`` as your curve and 11 nodes ``np.linspace(-1, 1, 11)``. Set
#    ``left, right = -1, 1`` and ``bottom, top = -1, 2``. Where will :math:`L` be far from
#    :math:`f`? Predict, then draw it. This is called Runge's phenomenon.
# 2. Will more equally spaced nodes help? Predict, then try 21.
# 3. Now take ``np.cos(np.pi * (np.arange(11) + 0.5) / 11)`` as nodes: Chebyshev nodes. What is
#    different about their places, and what about the error?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.lagrange_interpolate`. About nodes that crowd towards
# the ends: :cite:t:`BerrutTrefethen2004`. Next: :ref:`Task 1.5 <task-1-5>`, where
# many small curves take the place of one.
