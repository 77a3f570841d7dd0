r"""
.. _task-1-2:

Task 1.2: One movement from four wishes
=======================================

You turn four wishes into one curve: where a movement starts, where it ends, and how fast
it goes at both moments. This is what happens between two key frames in every animation
program.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

t = np.linspace(0, 1, 101)
f0, f1 = 1.0, 1.0  # two wishes: the heights at t = 0 and at t = 1
d0, d1 = 0.0, 1.0  # two wishes: the slopes at t = 0 and at t = 1

# %%
# Expected result
# ---------------
# A jumper stands with the head at height 1. A second later the head is at height 1 again,
# but now it moves upwards. What happens in between? The jumper bends the knees: the curve
# dips before it rises.
#
# The red points are the heights that we ask for. The dashed lines show the slopes.

from canim import interpolation

# Picture: A curve from a red point at height 1 to a red point at height 1. It leaves the first
# point level, sinks to 0.85 at two thirds of the time, and rises through the second point. A
# dashed level line touches it at the first point, a dashed rising line at the second.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(-0.25, 1.25), ylim=(0.7, 1.3), xlabel="time t", ylabel="height")
ax.plot([-0.2, 0.2], [f0 - 0.2 * d0, f0 + 0.2 * d0], "--", color="gray")
ax.plot([0.8, 1.2], [f1 - 0.2 * d1, f1 + 0.2 * d1], "--", color="gray")
ax.plot(t, interpolation.hermite_curve(t, f0, f1, d0, d1), label="f")
ax.plot([0, 1], [f0, f1], "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# We look for a cubic polynomial, because it has four numbers to choose, and we have four
# wishes:
#
# .. math::
#
#    f(t) &= a t^3 + b t^2 + c t + d \\
#    f'(t) &= 3 a t^2 + 2 b t + c
#
# The second line is the slope. Put the start, :math:`t = 0`, and the end, :math:`t = 1`,
# into both lines. Nearly everything falls away:
#
# .. math::
#
#    f(0) &= d \\
#    f(1) &= a + b + c + d \\
#    f'(0) &= c \\
#    f'(1) &= 3a + 2b + c
#
# These are four equations for the four numbers. Two of them give :math:`c` and :math:`d`
# at once. The two others then give :math:`a` and :math:`b`:
#
# .. math::
#
#    a = {} & 2 f(0) - 2 f(1) \\
#        & {} + f'(0) + f'(1) \\
#    b = {} & {-3} f(0) + 3 f(1) \\
#        & {} - 2 f'(0) - f'(1)
#
# Every answer is a mix of the four wishes. So it is enough to write down how much of each
# wish goes in: four numbers for :math:`a`, four for :math:`b`, and so on. This table is the
# **Hermite matrix** :math:`\mathbf{M}`:
#
# .. math::
#
#    \begin{bmatrix} a \\ b \\ c \\ d \end{bmatrix} =
#    \mathbf{M}
#    \begin{bmatrix} f(0) \\ f(1) \\ f'(0) \\ f'(1) \end{bmatrix}
#
# Think of a recipe book. Each row of :math:`\mathbf{M}` is one recipe, and the wishes are
# the ingredients. The row for :math:`a` is 2, −2, 1, 1: two parts of :math:`f(0)`, minus
# two parts of :math:`f(1)`, one part of each slope. A wish that does not occur counts 0:
# from :math:`a = f(1)` would come the row 0, 1, 0, 0. More in
# :cite:t:`ShirleyMarschner2009`, chapter 15.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    M, row for a:  2, -2, 1, 1
#    M, row for b:  from the formula for b
#    M, row for c:  from the equation for f'(0)
#    M, row for d:  from the equation for f(0)
#
#    hermite_coefficients(f0, f1, d0, d1):
#        wishes:        f0, f1, d0, d1
#        coefficients:  M times wishes
#        return coefficients
#
#    hermite_curve(t, f0, f1, d0, d1):
#        a, b, c, d:  the coefficients
#        curve:       a t^3 + b t^2 + c t + d
#        return curve

# %%
# Your task
# ---------
# Fill in three rows of ``M``, with plain numbers. Then write one line for the coefficients
# and one for the curve. In Python, ``M @ wishes`` multiplies a matrix by a list of numbers. The
# order of the two matters.
#
# In the program ``f0`` is :math:`f(0)`, ``f1`` is :math:`f(1)`, ``d0`` is :math:`f'(0)` and
# ``d1`` is :math:`f'(1)`. The number ``d`` is something else: the last of the coefficients.
# What is not written yet is ``nan`` ("not a number"). Whatever you add to ``nan`` or multiply
# by it stays ``nan``.

M = np.full((4, 4), np.nan)
M[0] = [2, -2, 1, 1]  # row for a: given
# TODO: M[1], row for b
# TODO: M[2], row for c
# TODO: M[3], row for d


def hermite_coefficients(f0, f1, d0, d1):
    """Return the four numbers a, b, c, d of the cubic."""
    wishes = np.array([f0, f1, d0, d1])
    coefficients = np.full(4, np.nan)
    # TODO: coefficients
    return coefficients


def hermite_curve(t, f0, f1, d0, d1):
    """Return the height of the curve at every value of t."""
    a, b, c, d = hermite_coefficients(f0, f1, d0, d1)
    curve = np.full(len(t), np.nan)
    # TODO: curve
    return curve


# %%
# Check and draw
# --------------
# Run the program after every line you write. The report says what is done and what is
# still to write. Before you start it says:

canim.check("1.2", M=M, hermite_coefficients=hermite_coefficients, hermite_curve=hermite_curve)

# Picture: The same axes as above, with the two red points and the two dashed lines. The curve f
# is named as missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(-0.25, 1.25), ylim=(0.7, 1.3), xlabel="time t", ylabel="height")
ax.plot([-0.2, 0.2], [f0 - 0.2 * d0, f0 + 0.2 * d0], "--", color="gray")
ax.plot([0.8, 1.2], [f1 - 0.2 * d1, f1 + 0.2 * d1], "--", color="gray")
ax.plot(t, hermite_curve(t, f0, f1, d0, d1), label="f")
ax.plot([0, 1], [f0, f1], "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Set the end slope ``d1`` to -1. Predict the new curve, with a sketch on paper. Then run
#    the program. Which wish makes the old curve dip?
# 2. Read the first column of ``M`` from top to bottom. Where have you seen these four
#    numbers before? Why are they here?
# 3. A second movement begins where this one ends. Which two of its wishes are already
#    fixed, if nobody shall see a jump or a jerk?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.hermite_coefficients`,
# :func:`canim.interpolation.hermite_curve`, and :func:`canim.interpolation.hermite_spline`
# for many key frames in a row. Next: :ref:`Task 1.3 <task-1-3>`, where a curve passes
# through any number of points.
