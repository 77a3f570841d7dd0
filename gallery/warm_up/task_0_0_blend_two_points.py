r"""
.. _task-0-0:

Task 0.0: Blend two points
==========================

You move a point from one place to another. Animators do little else: they say where a
thing is at two moments, and the computer finds the places between. With this small task
you also learn how all the tasks work.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

a = np.array([1.0, 1.0])  # the start
b = np.array([7.0, 4.0])  # the end
t = np.linspace(0, 1, 11)  # 11 moments from the start to the end

# %%
# Expected result
# ---------------
# This is what you will make: the places of a point :math:`p` at 11 moments. It begins at
# :math:`a` and ends at :math:`b`.

from canim import interpolation

# Picture: Eleven dots in equal steps on the straight way from the point a, at the lower
# left, to the point b, at the upper right.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(0, 8), ylim=(0, 5), xlabel="x", ylabel="y")
ax.plot(*a, "o", markersize=14, label="a")
ax.plot(*b, "o", markersize=14, label="b")
ax.plot(*interpolation.lerp(a, b, t).T, "o", label="p")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# Think of a drink made of two juices. If 1/4 is orange juice, then 3/4 is apple juice: the
# two shares together are always 1. A place between two points is mixed in the same way.
# It has a share of the point :math:`a` and a share of the point :math:`b`:
#
# .. math::
#
#    p = (1 - t)\, a + t\, b
#
# The number :math:`t` is the share of :math:`b`. At :math:`t = 0` there is nothing of
# :math:`b`, so the point is at :math:`a`. At :math:`t = 1` it is at :math:`b`. In between
# it is on the straight way from one to the other:

# Picture: The way from a to b. At t = 1/4 the point p has gone a quarter of the way: it is
# near a, which has the larger share.
fig, ax = plt.subplots(num="Shares")
ax.set(xlim=(0, 8), ylim=(0, 5), xlabel="x", ylabel="y")
ax.plot(*np.array([a, b]).T, color="0.75")
for name, share in {"a": 0, "b": 1, "p: 3/4 of a, 1/4 of b": 1 / 4}.items():
    ax.plot(*interpolation.lerp(a, b, share), "o", markersize=14, label=name)
canim.plotting.label_curves(ax)

# %%
# A point has two numbers, :math:`x` and :math:`y`. Each is mixed by itself, with the same
# shares:
#
# .. math::
#
#    x &= (1 - t)\, a_x + t\, b_x \\
#    y &= (1 - t)\, a_y + t\, b_y
#
# Curves, pictures that turn into each other, and faces: all are mixed like this, with other
# shares. More in :cite:t:`ShirleyMarschner2009`, chapter 2.

# %%
# Pseudocode
# ----------
# This is the program in words. The numbers of a point are counted from 0, so :math:`a_x` is
# written ``a[0]`` in Python, and :math:`a_y` is written ``a[1]``.
#
# .. code-block:: text
#
#    blend(a, b, t):
#        x: 1 - t times a_x, plus t times b_x
#        y: the same with a_y and b_y
#        return x and y

# %%
# Your task
# ---------
# Write the two lines that are marked ``TODO``: put the right formula in place of
# ``np.full(len(t), np.nan)``. A product needs a star: ``t * b[0]``. Write one line, run the
# program, look, and then write the other.
#
# The program runs as it is. What is not written yet is ``nan`` ("not a number"), which
# draws nothing.


def blend(a, b, t):
    """Return x and y of the point between a and b, for every moment in t."""
    x = np.full(len(t), np.nan)  # TODO: x
    y = np.full(len(t), np.nan)  # TODO: y
    return x, y


# %%
# Check and draw
# --------------
# ``canim.check`` tries your function and says how far you are. Before you start it says:

canim.check("0.0", blend=blend)

# Picture: The same axes as above with the points a and b only; p is named as missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(0, 8), ylim=(0, 5), xlabel="x", ylabel="y")
ax.plot(*a, "o", markersize=14, label="a")
ax.plot(*b, "o", markersize=14, label="b")
x, y = blend(a, b, t)
ax.plot(x, y, "o", label="p")
canim.plotting.label_curves(ax)

# %%
# What else the check can tell you is shown on the page
# :doc:`How tasks and checks work </students/tasks_and_checks>`.

# %%
# Think about it
# --------------
# 1. Where is the point at :math:`t = 1/2`? Say it before you calculate it.
# 2. Where would it be at :math:`t = 2`? Predict it, then change the third line of the
#    numbers at the top to ``t = np.linspace(0, 2, 11)``, and make the axes larger.
# 3. Use :math:`t^2`, in Python ``t**2``, in place of :math:`t`, in both lines. What changes:
#    the way, or the speed on it?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.lerp`. Next: :ref:`Task 1.1 <task-1-1>`, where also
# the speed at both ends is mixed in.
