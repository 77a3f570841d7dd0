r"""
.. _task-1-6:

Task 1.6: Draw the weights of a Bézier curve
============================================

You draw the curves that say how strongly each control point pulls at each moment. Fonts,
drawing programs and camera paths mix their points with exactly these weights.
"""

from math import comb  # noqa: F401

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

n = 3  # the degree: n + 1 control points, so n + 1 curves
t = np.linspace(0, 1, 101)  # 101 moments from the start to the end

# %%
# Expected result
# ---------------
# For the degree :math:`n = 3` there are four curves, one for each control point. Your
# program draws them for any :math:`n`.

from canim import interpolation

# Picture: Four curves for t from 0 to 1. b0 falls from 1 to 0. b1 is a hill with its top
# at one third, b2 the same hill mirrored with its top at two thirds. b3 rises from 0 to 1.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(0, 1), ylim=(0, 1.05), xlabel="time t", ylabel="weight")
for i, curve in enumerate(interpolation.bernstein_basis(n, t)):
    ax.plot(t, curve, label=f"b{i}")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# You shape a **Bézier curve** with a few points, the **control points**
# :math:`\mathbf{P}_0` to :math:`\mathbf{P}_n`. At every moment :math:`t` each of them
# pulls with its own weight :math:`b_{i,n}(t)`. The point of the curve is the sum of all
# control points, each times its weight:
#
# .. math::
#
#    \mathbf{B}(t) = \sum_{i=0}^{n} b_{i,n}(t)\, \mathbf{P}_i
#
# The number :math:`n` is the **degree** of the curve. Count with care: from 0 to
# :math:`n` there are :math:`n + 1` control points, and so :math:`n + 1` weights.
#
# Where do the weights come from? From a game with a coin. The coin is bent: it shows heads
# with probability :math:`t` and tails with probability :math:`1 - t`. You toss it three
# times. How likely is it to see heads exactly once?
#
# * Take one such series of tosses: heads, tails, tails. Its probability is
#   :math:`t\,(1 - t)\,(1 - t)`. Heads bring the **powers** of :math:`t`, tails the
#   powers of :math:`1 - t`.
# * Heads may also come second or third. There are three such series, all equally likely:
#   the **number of ways** is 3.
#
# The answer is :math:`3\,t\,(1 - t)^2`. In the same way, :math:`n` tosses show heads
# exactly :math:`i` times with the probability
#
# .. math::
#
#    b_{i,n}(t) = \binom{n}{i}\, t^i\, (1 - t)^{n - i}.
#
# The symbol :math:`\binom{n}{i}` is read ":math:`n` choose :math:`i`". It is the number
# of ways to choose :math:`i` of :math:`n` tosses:
#
# .. code-block:: text
#
#    n = 1:    1   1
#    n = 2:    1   2   1
#    n = 3:    1   3   3   1
#    n = 4:    1   4   6   4   1
#
# These curves are the **Bernstein polynomials**. Some number of heads must come up. So, at
# every moment, all the weights together are 1:

# Picture: The four weights stacked on top of each other as coloured layers. Together they
# fill the height from 0 to 1 at every time: b0 fills it at the start, b3 at the end.
fig, ax = plt.subplots()
ax.set(xlim=(0, 1), ylim=(0, 1), xlabel="time t", ylabel="weights, stacked")
ax.grid(visible=False)
ax.stackplot(t, interpolation.bernstein_basis(n, t), edgecolor="white", linewidth=1.5)
for i, place in enumerate([(0.12, 0.35), (0.36, 0.5), (0.64, 0.5), (0.88, 0.65)]):
    ax.text(*place, f"b{i}", color="white", fontsize=14, ha="center", va="center")

# %%
# No weight is negative, and together they are one whole. That is why a Bézier curve never
# leaves the space between its control points: put a rubber band around them, and the curve
# stays inside. More in :cite:t:`ShirleyMarschner2009`, chapter 15, and
# :cite:t:`Farin2002`, chapters 3 and 4.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    bernstein_basis(n, t):
#        for i from 0 to n:
#            powers:
#                t to the power i,
#                times 1 - t to the power n - i
#            number of ways:
#                n choose i
#            row i:
#                number of ways times powers
#        return the n + 1 rows

# %%
# Your task
# ---------
# Write the missing curves, for any degree :math:`n`. The first curve is given: no heads,
# one way. Python counts the ways for you: ``comb(5, 2)`` is the number of ways to choose
# 2 of 5. The program runs as it is. What is not written yet is ``nan`` ("not a number"),
# which draws nothing.


def bernstein_basis(n, t):
    """Return n + 1 curves as rows: B[0] is the first, B[n] the last."""
    B = np.full((n + 1, len(t)), np.nan)
    B[0] = (1 - t) ** n  # first curve: given
    # TODO: a loop over all other rows, up to B[n]:
    # TODO:     powers of t and of 1 - t
    # TODO:     times the number of ways
    return B


# %%
# Check and draw
# --------------
# Run the program after every line you write. The check tries other degrees as well.
# Before you start it says:

canim.check("1.6", bernstein_basis=bernstein_basis)

# Picture: The same axes as above. Only the curve b0 is there; b1, b2 and b3 are named as
# missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(0, 1), ylim=(0, 1.05), xlabel="time t", ylabel="weight")
B = bernstein_basis(n, t)
for i in range(n + 1):
    ax.plot(t, B[i], label=f"b{i}")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. At which moments is one of the weights exactly 1? Which control points does the curve
#    pass through, then?
# 2. Predict for :math:`n = 5`: how many curves are there, and at which time is each of
#    them highest? Then set ``n = 5`` and look.
# 3. Set ``n = 10``. How high is the middle curve, b5? What does that mean for somebody
#    who drags one of eleven control points?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.bernstein_basis`. Next: :ref:`Task 1.7 <task-1-7>`,
# where the weights for :math:`n = 3` make a curve.
