r"""
.. _task-1-8:

Task 1.8: Join curves to a smooth shape
=======================================

You join four Bézier curves to one closed shape without a kink, and make a smaller copy of
it. Long paths and outlines are never one curve: they are many, joined so well that nobody
sees where.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

weights = canim.interpolation.bernstein_basis(3, np.linspace(0, 1, 51))  # Task 1.6


def draw(ax, segments, name, handles=True):
    """Draw the curve of all segments as one line, and perhaps the handles in grey."""
    curve = np.vstack([weights.T @ P for P in segments])
    ax.plot(curve[:, 0], curve[:, 1], label=name)
    if handles:  # from point 0 to 1 and from 2 to 3
        x, y = np.reshape(segments, (-1, 2, 2)).T
        ax.plot(x, y, "o-", color="gray", linewidth=1, markersize=4)


# %%
# Expected result
# ---------------
# A closed shape of four curves, and inside it the copy: half as large and moved to the
# right. The thin grey lines are the **handles** of the shape. At every joint, two of them
# lie on one line. Your own shape may look different, as long as it is smooth.

from canim import interpolation

start, handle = np.array([5.0, -10.0]), np.array([13.0, -2.0])
shape = []
for second, end in [[(5, 20), (25, 20)], [(35, -2), (43, -10)], [(20, -18), (13, -10)]]:
    shape.append(np.array([start, handle, second, end], dtype=float))
    start, handle = shape[-1][3], interpolation.next_control_point(*shape[-1][2:])
last = interpolation.next_control_point(shape[0][1], shape[0][0])
shape.append(np.array([start, handle, last, shape[0][0]]))
copy = interpolation.transform_points(shape, scale=0.5, translate=(10, 0))

# Picture: A smooth closed shape like a bell with a small loop at its lower left corner.
# Inside it lies the same shape, half as large. At each of the four joints of the shape two
# thin grey handles form one straight line.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(-5, 55), ylim=(-22, 24), xlabel="x", ylabel="y", aspect="equal")
draw(ax, shape, "shape")
draw(ax, copy, "copy", handles=False)
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# Think of a toy train on rails. You put a second piece of rail behind the first. If its
# end only touches, the train still jumps: the new rail points somewhere else. The train
# rolls on quietly if, at the joint, both rails have
#
# * the same **place**,
# * the same **direction**,
# * and, for a film, the same **speed**.
#
# The derivative of a curve holds direction and speed in one. The first curve has the
# points :math:`\mathbf{P}_0` to :math:`\mathbf{P}_3`, the next one :math:`\mathbf{Q}_0`
# to :math:`\mathbf{Q}_3`. A cubic Bézier curve arrives and leaves along its handles,
# with three times their length:
#
# .. math::
#
#    \mathbf{B}_P'(1) &= 3\,(\mathbf{P}_3 - \mathbf{P}_2) \\
#    \mathbf{B}_Q'(0) &= 3\,(\mathbf{Q}_1 - \mathbf{Q}_0)
#
# Same place means :math:`\mathbf{Q}_0 = \mathbf{P}_3`. Same direction and speed mean that
# the two derivatives are equal. A joint with both is called :math:`C^1`.
#
# So the **next handle** :math:`\mathbf{Q}_1` is not free. You find it when you set the two
# derivatives equal and solve for :math:`\mathbf{Q}_1`. Look at the handles in the picture
# above to see what comes out: go from :math:`\mathbf{P}_2` to :math:`\mathbf{P}_3`, then the
# same way once more. You are at :math:`\mathbf{Q}_1`. From (1, 2) to (4, 3) you go 3 to the
# right and 1 up; the same way once more, and you are at (7, 4).
#
# In a **closed shape** the last curve ends where the first one starts. There is a joint
# there as well! The first curve is already drawn, so now the last handle is the one that
# is not free.
#
# How much does it matter? Here one handle is only 2 units too high. The kink is small. But
# a camera on this path would jerk, and on the body of a car everybody would see it in the
# reflections:

kinked = np.array(shape)
kinked[3, 1] = (6, 0)
angle = np.degrees(interpolation.joint_kinks(kinked, closed=True)[0][2])

# Picture: Two drawings side by side. Left, the bell with its control polygon dashed and a red
# ring around the joint near its lower left corner. Right, a close-up of that joint: the two
# handles do not form one straight line, there is a kink of about 6 degrees.
fig, (whole, near) = plt.subplots(1, 2)
whole.set(xlim=(-5, 55), ylim=(-30, 30), title="one bad joint", xticks=(), yticks=())
near.set(xlim=(8, 18), ylim=(-15, -5), title=f"kink of {angle:.1f}°", xticks=(), yticks=())
for ax in (whole, near):
    ax.set_aspect("equal")
    draw(ax, kinked, "")
    ax.plot(*kinked[3, 0], "o", color="red", fillstyle="none", markersize=18)
whole.plot(*kinked.reshape(-1, 2).T, "--", color="gray", linewidth=1)
near.axline(kinked[2, 2], kinked[2, 3], color="red", linestyle=":", linewidth=1.5)

# %%
# The dotted red line goes on straight from the arriving handle. The leaving handle misses
# it.
#
# **The copy.** A Bézier curve follows its control points: transform the points, and the
# curve drawn from them is transformed in the same way. You need not touch the curve
# itself. The order counts: first **scale**, then turn, then **move**. With the scale
# :math:`s`, the angle :math:`\varphi` and the move :math:`\mathbf{d}`:
#
# .. math::
#
#    x' &= s\,(x \cos\varphi - y \sin\varphi) + d_x \\
#    y' &= s\,(x \sin\varphi + y \cos\varphi) + d_y
#
# Scaling and turning are about the point :math:`(0, 0)`. The three together keep the form
# and change the size: a **similarity**. Without the scale it is a rigid motion. More in
# :cite:t:`ShirleyMarschner2009`, chapters 6 and 15, and :cite:t:`Farin2002`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    next_handle(second_last, last):
#        next handle: go from second_last to last,
#            then the same way once more
#
#    closed_shape():
#        segment 1: four points of your choice
#        joint 1 to 2: segment 2 starts where
#            segment 1 ends, with the next handle;
#            then come two free points
#        joint 2 to 3: the same for segment 3
#        joint 3 to 4: the same for segment 4
#        joint 4 to 1: segment 4 ends where
#            segment 1 starts; its last handle is
#            found from the first handle of
#            segment 1, as a next handle is
#
#    transform(points, scale, angle, move):
#        scale: multiply x and y
#        turn by the angle
#        move:  add to x and to y

# %%
# Your task
# ---------
# Write the next handle, then close the shape, then make the copy. A segment has four
# points: start, handle, handle, end. Python counts from 0: segment 1 is ``S[0]``, and
# ``S[0, 3]`` is its last point. Segments 1 and 2 are given, but segment 2 needs your next
# handle. Where a point is free, choose what you like. The program runs as it is.
# What is not written yet is ``nan`` ("not a number"), which draws nothing.


def next_handle(second_last, last):
    """Return the handle that goes on smoothly from these two points, arrays of x and y."""
    handle = np.array([np.nan, np.nan])
    # TODO: next handle: go from second_last to last, then the same way once more
    return handle


def closed_shape():
    """Return four segments, each with four points."""
    S = np.full((4, 4, 2), np.nan)
    S[0] = [(5, -10), (13, -2), (5, 20), (25, 20)]
    S[1] = [S[0, 3], next_handle(S[0, 2], S[0, 3]), (35, -2), (43, -10)]  # joint 1 to 2
    # TODO: joint 2 to 3: write segment 3, S[2]; it may end at (13, -10)
    # TODO: joint 3 to 4: write segment 4, S[3]
    # TODO: joint 4 to 1: S[3] ends at S[0, 0]; last handle: on from S[0, 1] and S[0, 0]
    return S


def transform(points, scale, angle, move):
    """Return the points, an (x, y) in each row, scaled, turned and moved."""
    x, y = np.nan * points[:, 0], np.nan * points[:, 1]  # TODO: scale
    c, s = np.cos(angle), np.sin(angle)
    x, y = x * c - y * s, x * s + y * c  # turn: given
    # TODO: move: add move[0] to x and move[1] to y
    return np.column_stack([x, y])


# %%
# Check and draw
# --------------
# The check looks at the joints of your shape, not at the shape itself. In the picture, the
# grey handle at the right belongs to segment 2, whose curve waits for your next handle.
# Before you start the check says:

canim.check("1.8", next_handle=next_handle, closed_shape=closed_shape, transform=transform)

# Picture: The same axes as above. Of the shape only segment 1, a curve at the left, and one
# grey handle at the right are there; a text says that the copy is missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(-5, 55), ylim=(-22, 24), xlabel="x", ylabel="y", aspect="equal")
shape = np.asarray(closed_shape())
draw(ax, shape, "shape")
copy = [transform(P, 0.5, 0, np.array([10, 0])) for P in shape]
draw(ax, copy, "copy", handles=False)
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. Predict: what do you see if the next handle points the right way but is twice as
#    long? And what does a train on the curve do? Then try it in segment 2.
# 2. Predict which copy you get with the scale -1 and the move (50, 0), and which if you
#    move first and scale after, with the old numbers. Then try both.
# 3. Your four segments have 16 points. How many of them can you choose freely?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.next_control_point`,
# :func:`canim.interpolation.joint_kinks` and
# :func:`canim.interpolation.transform_points`. Next: :ref:`Task 1.9 <task-1-9>`, where
# the train keeps its speed.
