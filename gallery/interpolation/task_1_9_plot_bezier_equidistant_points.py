r"""
.. _task-1-9:

Task 1.9: Walk a curve in equal steps
=====================================

You measure the length of a curve and place points on it at equal distances. With them a
camera or a car follows a curve at one constant speed.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim
from canim.interpolation import bezier_curve

plt.style.use("canim.style")

P = np.array([[5.0, -10.0], [9.0, 38.0], [38.0, -5.0], [45.0, 15.0]])  # as in Task 1.7
count = 18  # how many points to place
t = np.linspace(0, 1, 101)

# %%
# Expected result
# ---------------
# Above, 18 points at equal steps of the time :math:`t`: they are far apart at the ends and
# crowd in the middle. Below, 18 points at equal distances along the same curve.

from canim import interpolation

# Picture: The same curve twice, with 18 dots each. Above, at equal time steps, the dots are
# far apart near both ends and close together in the middle. Below, with equal spacing, the
# way from dot to dot is the same everywhere.
fig, axes = plt.subplots(2, 1, num="Expected result", figsize=(6.4, 6.8), sharex=True)
by_time = bezier_curve(P, np.linspace(0, 1, count))
by_distance = interpolation.equidistant_points(P, count)
for ax, dots, name in [
    (axes[0], by_time, "equal time steps"),
    (axes[1], by_distance, "equal spacing"),
]:
    ax.set(xlim=(0, 50), ylim=(-13, 18), aspect="equal")
    ax.plot(*bezier_curve(P, t).T, color="gray", linewidth=1.5)
    ax.plot(dots[:, 0], dots[:, 1], "o", label=name)
    canim.plotting.label_curves(ax)

# %%
# In a film the difference is plain to see:

fig, ax = plt.subplots()
ax.set(xlim=(-3, 53), ylim=(-15, 19), aspect="equal")
ax.plot(*bezier_curve(P, t).T, color="gray", linewidth=1.5)
paths = {
    "equal time steps": bezier_curve(P, t),
    "constant speed": interpolation.equidistant_points(P, len(t)),
}
# Film: Two dots follow the same curve; they start and arrive together. The dot at equal time
# steps rushes ahead, slows down in the middle, and hurries again at the end. The other one
# keeps the same speed all the way.
film = canim.plotting.animate_points(ax, paths)

# %%
# Theory
# ------
# A Bézier curve tells where you are at the time :math:`t`. It does not promise that you
# move evenly. Where its control points are far apart, the curve is fast; where they are
# close, it is slow. So equal steps of time give unequal steps on the curve.
#
# To walk evenly you need the length of the way. For a cubic curve there is no simple
# formula for it. So measure it as you would measure a winding path on a map: put short
# straight pieces along it, the **chords**, and add them up.

samples = bezier_curve(P, np.linspace(0, 1, 6))

# Picture: The curve in grey with six dots on it and five straight chords from dot to dot.
# The curve bends away from the chords.
fig, ax = plt.subplots()
ax.set(xlim=(0, 50), ylim=(-13, 18), aspect="equal", title="6 samples, 5 chords")
ax.plot(*bezier_curve(P, t).T, color="gray", linewidth=1.5)
ax.plot(*samples.T, "o-", color="C1")

# %%
# With :math:`N` samples :math:`\mathbf{B}_0, \dots, \mathbf{B}_{N-1}` of the curve there
# are :math:`N - 1` chords, each from one sample forward to the next. The **length** is
# about
#
# .. math::
#
#    L \approx \sum_{k=0}^{N-2} \|\mathbf{B}_{k+1} - \mathbf{B}_k\|.
#
# The bars :math:`\|\;\|` mean the length of the arrow between them; such steps from one
# sample to the next are called **forward differences**. The more samples, the better.
#
# Now the points at equal distances. Walk along the curve with a measuring wheel. At every
# sample, write down the distance **walked** so far, and where you are:
#
# .. code-block:: text
#
#    sample    0      1      2      3    ...
#    walked   0.0   12.0   19.9   25.4   ...
#    x        5.0    6.9   10.0   14.1   ...
#
# Then turn the question round: *where* are you when you have walked 16? Look into the
# table. 16 is about half way from 12.0 to 19.9, so :math:`x` is about half way from 6.9 to
# 10.0. NumPy reads tables in this way: ``np.interp(16, walked, x)``. Give it many
# distances in place of the 16, and you get as many answers.
#
# The **goals** are the distances at which you want your points: from 0 to the length, in
# equal steps. Both ends belong to them, so 18 points have 17 steps between them. More in
# :cite:t:`ShirleyMarschner2009`, chapter 17.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    compute_arc_length(P, samples):
#        points: samples of the curve
#        length: 0
#        for each point but the last:
#            chord: the way to the next point
#            add its length to the length
#        return the length
#
#    equidistant_points(P, count):
#        points: many samples of the curve
#        walked: 0 at the first point;
#            at each other point, walked
#            at the point before, plus the chord
#        goals: count distances in equal steps,
#            from 0 to the whole length
#        places: x and y at each goal,
#            from the table
#        return the places

# %%
# Your task
# ---------
# First write the length, then the points. ``np.linalg.norm(b - a)`` is the distance from
# the point ``a`` to the point ``b``. The program runs as it is. What is not written yet is
# ``nan`` ("not a number"), which draws nothing. Whatever you add to ``nan`` stays ``nan``: a
# sum begins with 0.


def compute_arc_length(P, samples):
    """Return the length of the curve: the sum of the chords between its samples."""
    points = bezier_curve(P, np.linspace(0, 1, samples))
    length = np.nan
    # TODO: length: start with 0 and add every chord, from each point to the next
    return length


def equidistant_points(P, count):
    """Return points at equal distances along the curve, one a row, with both ends."""
    points = bezier_curve(P, np.linspace(0, 1, 1000))
    walked = np.full(1000, np.nan)
    walked[0] = 0  # walked: at the first point nothing
    places = np.full((count, 2), np.nan)
    # TODO: walked: the distance so far at all other points, one after the other
    # TODO: goals, with np.linspace
    # TODO: places: both columns, x and y, with np.interp
    return places


# %%
# Check and draw
# --------------
# The check knows that your length is not exact, and allows for it. It judges the places when
# both columns are there, x and y. Before you start it says:

canim.check("1.9", compute_arc_length=compute_arc_length, equidistant_points=equidistant_points)

# Picture: The same two curves as above. The upper one has its 18 dots at equal time steps;
# below, a text says that the equal spacing is missing.
fig, axes = plt.subplots(2, 1, num="Yours", figsize=(6.4, 6.8), sharex=True)
by_time = bezier_curve(P, np.linspace(0, 1, count))
by_distance = np.asarray(equidistant_points(P, count))
for ax, dots, name in [
    (axes[0], by_time, "equal time steps"),
    (axes[1], by_distance, "equal spacing"),
]:
    ax.set(xlim=(0, 50), ylim=(-13, 18), aspect="equal")
    ax.plot(*bezier_curve(P, t).T, color="gray", linewidth=1.5)
    ax.plot(dots[:, 0], dots[:, 1], "o", label=name)
    canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Is the sum of the chords longer or shorter than the curve? Predict it, then print
#    ``compute_arc_length(P, 3)``, and the same with 10 and 100 samples.
# 2. You move P2 to (44, 13), close to P3. Where do the points at equal time steps crowd
#    then? Predict it, then try it.
# 3. When does an animator want equal distances, and when rather not? Think of a train and
#    of a ball that is thrown.
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.arc_length` and
# :func:`canim.interpolation.equidistant_points`. This was the last task about curves. Next:
# :ref:`Task 2.1 <task-2-1>`, where you bend pictures.
