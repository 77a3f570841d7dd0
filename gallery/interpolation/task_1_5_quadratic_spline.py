r"""
.. _task-1-5:

Task 1.5: A smooth path from small pieces
=========================================

You join short curves into one smooth path through all points. Long movements with many
key frames are made of pieces like these.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

x = np.array([-3.0, -1.0, 1.0, 3.0])  # the knots
y = np.array([15.0, 5.0, 8.0, 9.0])  # the heights there
start = "straight"  # or "flat"

# %%
# Expected result
# ---------------
# Three pieces through four points. The first piece is a straight line. At the inner knots
# the pieces meet without a corner.

from canim import interpolation

# Picture: A straight blue piece f0 falls from (-3, 15) to (-1, 5). An orange piece f1 goes on
# in the same direction, turns, and climbs to (1, 8). A green piece f2 goes on upwards, makes a
# hill as high as 12.3 and falls to (3, 9). The four points are red.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(-3.5, 3.5), ylim=(0, 16), xlabel="x", ylabel="y")
for i, (a, b, c) in enumerate(interpolation.quadratic_spline(x, y, start).coefficients):
    t = np.linspace(x[i], x[i + 1], 51)
    ax.plot(t, a * t**2 + b * t + c, label=f"f{i}")
ax.plot(x, y, "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# A toy railway is built from short curved tracks. A train can use it if every track begins
# where the one before ended, and in the same direction. A **spline** is such a railway. Its
# tracks are the pieces, the places where they meet are the **knots**.
#
# Our pieces are quadratic polynomials. Piece :math:`i` goes from point :math:`i` to point
# :math:`i + 1`:
#
# .. math::
#
#    f_i(x) &= a_i x^2 + b_i x + c_i \\
#    f_i'(x) &= 2 a_i x + b_i
#
# The second line is its slope. With :math:`K` points there are :math:`K - 1` pieces, so
# :math:`3 (K - 1)` numbers are unknown. We need as many equations. Here they are:
#
# **Piece i begins at point i.** One equation per piece:
#
# .. math::
#
#    a_i x_i^2 + b_i x_i + c_i = y_i
#
# **Piece i ends at point i + 1.** The same at its other end, again one per piece.
#
# **Equal slopes.** At an inner knot, the piece that ends has the same slope as the one that
# begins. There are :math:`K - 2` inner knots. At the knot :math:`x_1`:
#
# .. math::
#
#    2 a_0 x_1 + b_0 = 2 a_1 x_1 + b_1
#
# **Start.** We have one equation less than we need. So we may choose how the first piece
# starts. *Straight* makes it a straight line: :math:`a_0 = 0`. *Flat* gives it the slope
# zero at the first point: :math:`f_0'(x_0) = 0`.
#
# To let the computer solve all this, we write a table. Each row is one equation. Each piece
# has three columns, one for each of its numbers. The right side goes into an extra column.
# For that, bring all unknowns to the left side. The equal slopes become:
#
# .. math::
#
#    2 a_0 x_1 + b_0 - 2 a_1 x_1 - b_1 = 0
#
# The table for our four points looks like this:

A, right = interpolation.quadratic_spline_system(x, y, start)
rows = [f"piece {i} {does}" for i in range(3) for does in ("begins", "ends")]
rows += ["equal slopes", "equal slopes", "start"]

# Picture: A table of nine rows and nine columns, with a tenth column for the right side. The
# columns belong to a, b and c of the three pieces, three in each colour. The first six rows,
# "piece 0 begins" to "piece 2 ends", fill three columns each, further right from piece to
# piece. Two rows "equal slopes" fill the columns a and b of two neighbouring pieces, and the
# row "start" has a 1 in the first column. All else is empty.
fig, ax = plt.subplots()
ax.set(xlim=(-0.5, 10.1), ylim=(8.6, -0.5))
ax.set_xticks([*range(9), 9.5], [f"{n}{i}" for i in range(3) for n in "abc"] + ["right"])
ax.set_yticks(range(9), rows)
ax.tick_params(length=0, labeltop=True, labelbottom=False)
ax.spines[:].set_visible(False)
ax.grid(visible=False)
for row, column in np.argwhere(A):
    ax.add_patch(plt.Rectangle((column - 0.46, row - 0.43), 0.92, 0.86, color=f"C{column // 3}"))
    ax.text(column, row, f"{A[row, column]:g}", color="white", ha="center", va="center")
for row, number in enumerate(right):
    ax.text(9.5, row, f"{number:g}", ha="center", va="center")

# %%
# Why care about the start? Because a quadratic spline does not forget. The slope where a
# piece ends depends on the slope where it begins. If the first slope is too small, the next
# is too large, the one after too small again, and so on to the end. Here are eleven points
# of a sine curve. Its true slope at the start is 1. With the flat start, the path zigzags
# around the curve all the way, by up to 0.16. With the straight start, here the better
# guess, it misses by 0.02 at most. For other curves flat may be better.

knots = np.linspace(0, 2 * np.pi, 11)
place = np.linspace(0, 2 * np.pi, 501)

# Picture: One wave of a sine curve with eleven red points on it. The spline with the flat start
# swings above and below the wave between all points, by up to 0.16, until the end. The spline
# with the straight start lies on the wave, as far as the eye can tell.
fig, ax = plt.subplots()
ax.set(xlim=(0, 2 * np.pi), ylim=(-1.3, 1.5), xlabel="x", ylabel="y")
for name, style in (("straight", "-"), ("flat", "--")):
    spline = interpolation.quadratic_spline(knots, np.sin(knots), name)
    ax.plot(place, spline(place), style, label=name)
ax.plot(knots, np.sin(knots), "o", color="red")
canim.plotting.label_curves(ax)

# %%
# So the pieces have a common slope at the knots, but the bend still jumps there: a quadratic
# spline is smooth once, not twice. Cubic pieces do better. More in
# :cite:t:`ShirleyMarschner2009`, chapter 15, and :cite:t:`DeBoor2001`, chapter 6.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    quadratic_spline_system(x, y, start):
#        pieces = number of points - 1
#        A: all zeros,  b: no numbers yet
#        for every piece i:
#            piece i begins at point i:
#                its columns: x_i^2, x_i, 1
#                right side:  y_i
#            piece i ends at point i + 1:
#                the same with point i + 1
#        for every inner knot x_(i+1):
#            equal slopes:
#                columns of piece i:
#                    2 x_(i+1), 1, 0
#                columns of piece i + 1:
#                    the same, minus signs
#                right side: 0
#        start, one row:
#            straight: a_0 = 0
#            flat:     slope at x_0 = 0
#        return A, b

# %%
# Your task
# ---------
# Write the missing rows of ``A`` and ``b``, one equation a row. The numbers
# :math:`a_i, b_i, c_i` of piece :math:`i` have the columns ``3 * i``, ``3 * i + 1`` and
# ``3 * i + 2``. The equation of each piece's beginning is given: the line that begins with
# ``A[2 * i, 3 * i : 3 * i + 3]`` fills the columns ``3 * i``, ``3 * i + 1`` and ``3 * i + 2``
# of row ``2 * i``. Use the rows named in the comments, so that no equation overwrites
# another.
#
# The ends belong in the same loop. The equal slopes need a new loop after it, with one round
# less: ``pieces - 1``.
#
# Where ``b`` is ``nan`` ("not a number"), the row is not written yet: also write a right side
# that is 0. Solving is given. It leaves out such rows, so you see your path grow: first steps,
# then a path with corners, then a smooth one.


def quadratic_spline_system(x, y, start):
    """Return A and b: one row of A and one number of b per equation."""
    pieces = len(x) - 1
    A = np.zeros((3 * pieces, 3 * pieces))
    b = np.full(3 * pieces, np.nan)
    for i in range(pieces):
        A[2 * i, 3 * i : 3 * i + 3] = [x[i] ** 2, x[i], 1]  # piece i begins: given
        b[2 * i] = y[i]
        # TODO: row 2 * i + 1, piece i ends
    # TODO: rows 2 * pieces + i, equal slopes of piece i and piece i + 1
    # TODO: the last row, start: one equation if start == "straight", another if "flat"
    return A, b


def solve(A, b):
    """Return a, b, c of each piece: given. While rows are missing, pieces stay straight."""
    A, b = np.asarray(A), np.asarray(b)
    written = ~np.isnan(b)
    bend = np.tile([1e-4, 1e-2, 1], len(b) // 3)  # little a, some b, as much c as needed
    return (np.linalg.lstsq(A[written] * bend, b[written])[0] * bend).reshape(-1, 3)


# %%
# Check and draw
# --------------
# Run the program after every equation you write. The check tries both starts and other
# points. Before you begin it says:

canim.check("1.5", quadratic_spline_system=quadratic_spline_system)

# Picture: The same axes and red points as above. Each piece is a level line from its point to
# the right, like steps: only its beginning is known yet.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(-3.5, 3.5), ylim=(0, 16), xlabel="x", ylabel="y")
for i, (a, b, c) in enumerate(solve(*quadratic_spline_system(x, y, start))):
    t = np.linspace(x[i], x[i + 1], 51)
    ax.plot(t, a * t**2 + b * t + c, label=f"f{i}")
ax.plot(x, y, "o", color="red")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Set ``start`` to ``"flat"``. Which pieces will change? Predict, then draw it.
# 2. Lift the last point from 9 to 12. Which pieces change now? Compare with Task 1.3,
#    where one point moved the whole curve.
# 3. What would be lost if you left out the equations of the equal slopes?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.quadratic_spline_system` and
# :func:`canim.interpolation.quadratic_spline`, which finds the pieces one after the other,
# without a table. Next: :ref:`Task 1.6 <task-1-6>`, where points pull at a curve that does
# not pass through them.
