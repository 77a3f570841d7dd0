r"""
.. _task-1-10:

Task 1.10: Start and stop gently
================================

You let a movement start slowly, speed up, and slow down before it ends. Animators call it
"slow in and slow out". It is the first thing that makes a movement look alive.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

t = np.linspace(0, 1, 101)  # the time, from the start to the end of the movement

# %%
# Expected result
# ---------------
# The curve shows how much of the way is done at every time. It is flat at both ends: there
# the movement is slow. The dashed line is a movement at an even speed.

from canim.checks.task_1_10 import ease_in_out as right

# Picture: A curve from (0, 0) to (1, 1). It begins level, is steepest in the middle, and ends
# level, like a flat letter S. A dashed straight line joins the same two corners.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(0, 1), ylim=(-0.1, 1.1), xlabel="time t", ylabel="done")
ax.plot(t, t, "--", color="gray")
ax.plot(t, right(t), label="gently")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# A train leaves a station. During the first half of the time it gains speed. Its way is
#
# .. math:: s(t) = 2 t^2, \quad 0 \le t \le \tfrac12 .
#
# At half time half of the way is done. Then it brakes, and braking is gaining speed, seen in
# a film that runs backwards. So the way that is *left* at the time :math:`t` is the way that
# was done at the time :math:`1 - t`:
#
# .. math:: 1 - s(t) = 2 (1 - t)^2, \quad \tfrac12 \le t \le 1 .
#
# More about such movements in :cite:t:`Lasseter1987`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    ease_in_out(t):
#        speed up:   in the first half,
#                    2 t^2 is done
#        slow down:  in the second half,
#                    all but what is left
#        return what is done

# %%
# Your task
# ---------
# Write the line for the second half. In ``first`` stands, for every time, whether it belongs
# to the first half; ``~first`` is the opposite.


def ease_in_out(t):
    """Return how much of the way is done at every time t."""
    done = np.full(len(t), np.nan)
    first = t <= 0.5
    done[first] = 2 * t[first] ** 2  # speed up: given
    # TODO: slow down, where ~first
    return done


# %%
# Check and draw
# --------------
# Run the program after you have written the line. Before you start the check says:

canim.check("1.10", ease_in_out=ease_in_out)

# Picture: The same axes. Of the curve there is the first half, up to the middle.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(0, 1), ylim=(-0.1, 1.1), xlabel="time t", ylabel="done")
ax.plot(t, t, "--", color="gray")
ax.plot(t, ease_in_out(t), label="gently")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Predict: when is the movement fastest? Then draw its speed, with
#    ``ax.plot(t, np.gradient(ease_in_out(t), t))``.
# 2. A ball falls and stays on the floor. Which half of your curve does it need?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.hermite_curve` starts and stops gently too, if both
# slopes are 0. Back to :ref:`Task 1.2 <task-1-2>`.
