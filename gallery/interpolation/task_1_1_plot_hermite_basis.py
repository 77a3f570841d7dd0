r"""
.. _task-1-1:

Task 1.1: Draw the four Hermite curves
======================================

You draw the four curves that mix two positions and two speeds into one smooth
movement. An animator says where a thing is and how fast it goes at two moments; these
curves fill in all the moments between.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

t = np.linspace(0, 1, 101)  # 101 moments from the start to the end

# %%
# Expected result
# ---------------
# Four curves over the time :math:`t`, which runs from 0 (the start) to 1 (the end).

from canim import interpolation

# Picture: Four curves for t from 0 to 1. H0 falls from 1 to 0, H1 rises from 0 to 1; they
# cross at one half. H2 makes a low hill above zero and H3 a low valley below zero.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(0, 1), ylim=(-0.25, 1.1), xlabel="time t", ylabel="weight")
for k, curve in enumerate(interpolation.hermite_basis(t)):
    ax.plot(t, curve, label=f"H{k}")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# Think of a mixing desk with four sliders, one for each wish of the animator:
#
# * the value at the start, :math:`f(0)`,
# * the value at the end, :math:`f(1)`,
# * the slope at the start, :math:`f'(0)`,
# * the slope at the end, :math:`f'(1)`.
#
# The slope says how fast the value changes. The little dash marks it: read :math:`f'` as
# "f prime", the slope of :math:`f`. Each wish has its own weight, and the
# weight changes with the time :math:`t`. The movement is the sum of the four wishes,
# each times its weight:
#
# .. math::
#
#    f(t) = {} & H_0(t)\, f(0) + H_1(t)\, f(1) \\
#          {} + {} & H_2(t)\, f'(0) + H_3(t)\, f'(1)
#
# The four weights are the **Hermite basis functions**:
#
# .. math::
#
#    H_0(t) &= 2t^3 - 3t^2 + 1 \\
#    H_1(t) &= -2t^3 + 3t^2 \\
#    H_2(t) &= t^3 - 2t^2 + t \\
#    H_3(t) &= t^3 - t^2
#
# Look at the picture at :math:`t = 0`: there :math:`H_0` is 1 and the three others are
# 0, so :math:`f(0)` is mixed in alone. At :math:`t = 1` it is :math:`H_1` that is 1.
# :math:`H_2` and :math:`H_3` are 0 at both ends: they do not move the ends, they only
# bend the way between them.
#
# Where do the formulas come from? Four wishes fix the four numbers of a cubic
# polynomial. :ref:`Task 1.2 <task-1-2>` shows how. More in
# :cite:t:`ShirleyMarschner2009`, chapter 15.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    hermite_basis(t):
#        H0, start value:  2 t^3 - 3 t^2 + 1
#        H1, end value:    the formula above
#        H2, start slope:  the formula above
#        H3, end slope:    the formula above
#        return H0, H1, H2, H3

# %%
# Your task
# ---------
# Write the three missing curves. :math:`H_0` is given: in Python ``t**3`` means
# :math:`t^3`. The four curves are the rows of one table ``H``. So in the program
# :math:`H_1` is written ``H[1]``, and so on.
#
# The program runs as it is. What is not written yet is ``nan`` ("not a number"), which
# draws nothing.


def hermite_basis(t):
    """Return the four curves as rows: H[0] is H0, and so on."""
    H = np.full((4, len(t)), np.nan)
    H[0] = 2 * t**3 - 3 * t**2 + 1  # start value: given
    # TODO: H[1], end value
    # TODO: H[2], start slope
    # TODO: H[3], end slope
    return H


# %%
# Check and draw
# --------------
# Run the program after every line you write. The report says what is done and what is
# still to write. Before you start it says:

canim.check("1.1", hermite_basis=hermite_basis)

# Picture: The same axes as above. Only the curve H0 is there; H1, H2 and H3 are named as
# missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(0, 1), ylim=(-0.25, 1.1), xlabel="time t", ylabel="weight")
H = hermite_basis(t)
for k in range(4):
    ax.plot(t, H[k], label=f"H{k}")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Look at :math:`H_0` and :math:`H_1` at any time. What is their sum? Predict it, then
#    draw it with ``ax.plot(t, H[0] + H[1])``. Why must it be so?
# 2. A ball goes from one place to another. It rests at both: its speed is 0 at the start
#    and at the end. Which of the four curves does its movement need, and which not?
# 3. Some books print a 3 in place of the first 2 in :math:`H_1`. How does your picture
#    show that this cannot be right?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.hermite_basis`. Next: :ref:`Task 1.2 <task-1-2>`,
# where the four curves make a movement.
