r"""
.. _task-1-7:

Task 1.7: Draw a cubic Bézier curve
===================================

You draw the curve that four points pull into shape. Letters, drawings and the paths of
cameras are made of such curves.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

# The control points P0, P1, P2 and P3, one a row.
P = np.array([[5.0, -10.0], [9.0, 38.0], [38.0, -5.0], [45.0, 15.0]])
t = np.linspace(0, 1, 101)  # 101 moments from the start to the end

# %%
# Expected result
# ---------------
# The curve starts at :math:`\mathbf{P}_0` and ends at :math:`\mathbf{P}_3`. The two
# points between only pull at it. The dashed line joins the control points in their order:
# it is the **control polygon**.

from canim import interpolation

# Picture: A curve from P0 at the bottom left to P3 at the right. It rises steeply, bends to
# the right below P1, runs almost level and rises again to P3. A dashed grey line joins P0,
# P1 high above the curve, P2 below it, and P3.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(0, 50), ylim=(-15, 45), xlabel="x", ylabel="y")
ax.plot(P[:, 0], P[:, 1], "o--", color="gray", linewidth=1.5)
for k in range(4):
    ax.annotate(f"P{k}", P[k], xytext=(9, -5), textcoords="offset points")
ax.plot(*interpolation.bezier_curve(P, t).T, label="curve")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# Look at a machine that draws such a curve. Three carts run along the three sides of the
# control polygon. A bar joins each cart to the next, and a slider runs along each bar. A
# last bar joins the two sliders, and on it slides the pen. All start together, at
# :math:`t = 0`, and all arrive together, at :math:`t = 1`.

fig, ax = plt.subplots()
ax.set(xlim=(0, 50), ylim=(-15, 45), xlabel="x", ylabel="y")
for k in range(4):
    ax.annotate(f"P{k}", P[k], xytext=(9, -5), textcoords="offset points")
# Film: Three points run along the three sides of the control polygon. Two points run along
# the two bars between them, and one point, the pen, along the bar between those two. The
# pen leaves the Bézier curve behind.
film = canim.plotting.animate_construction(ax, [interpolation.de_casteljau(P, s) for s in t])

# %%
# This is **de Casteljau's construction**. It does one thing again and again: it mixes two
# points. A mix of two control points is the line from one to the other:
#
# .. math::
#
#    \mathbf{B}(t) = (1 - t)\,\mathbf{P}_0 + t\,\mathbf{P}_1
#
# Now mix twice, as the sliders do: the mix of :math:`\mathbf{P}_0` and
# :math:`\mathbf{P}_1` with the mix of :math:`\mathbf{P}_1` and :math:`\mathbf{P}_2`.
# Multiply out and you have the **quadratic** Bézier curve:
#
# .. math::
#
#    \mathbf{B}(t) = {} & (1-t)^2\, \mathbf{P}_0 \\
#    {} + {} & 2\,(1-t)\, t\, \mathbf{P}_1 \\
#    {} + {} & t^2\, \mathbf{P}_2
#
# Mix once more, as the pen does, and you have the **cubic** one, with four points:
#
# .. math::
#
#    \mathbf{B}(t) = {} & (1-t)^3\, \mathbf{P}_0 \\
#    {} + {} & 3\,(1-t)^2\, t\, \mathbf{P}_1 \\
#    {} + {} & 3\,(1-t)\, t^2\, \mathbf{P}_2 \\
#    {} + {} & t^3\, \mathbf{P}_3
#
# Each line is the **pull** of one control point: a weight times the point. The weights are
# the four curves of :ref:`Task 1.6 <task-1-6>`.
#
# The film shows more. The curve leaves :math:`\mathbf{P}_0` towards
# :math:`\mathbf{P}_1`, and it comes into :math:`\mathbf{P}_3` from :math:`\mathbf{P}_2`.
# So :math:`\mathbf{P}_1` and :math:`\mathbf{P}_2` are the two **handles** with which an
# artist bends the curve. More in :cite:t:`ShirleyMarschner2009`, chapter 15.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    cubic_bezier(P, t):
#        for every moment s in t:
#            pull of P0:  (1 - s)^3 times P0
#            pull of P1:  the formula above
#            pull of P2:  the formula above
#            pull of P3:  the formula above
#            point:       the sum of the four pulls
#        return all points

# %%
# Your task
# ---------
# The line and the quadratic curve are given: read them first. In their loops, ``k`` counts
# 0, 1, 2, ... and ``s`` is the moment: ``enumerate`` gives both. Then write the cubic one.
# ``P[0]`` is a point with an x and a y; a number times ``P[0]`` is a point, and so is the
# sum of two points. The program runs as it is. What is not written yet is ``nan`` ("not a
# number"), which draws nothing. Whatever you add to ``nan`` stays ``nan``: a sum begins
# with 0.


def linear_bezier(P, t):
    """Return one point per moment, as rows: the line from P[0] to P[1]."""
    points = np.full((len(t), 2), np.nan)
    for k, s in enumerate(t):
        points[k] = (1 - s) * P[0] + s * P[1]
    return points


def quadratic_bezier(P, t):
    """Return one point per moment, as rows: the curve of P[0], P[1] and P[2]."""
    points = np.full((len(t), 2), np.nan)
    for k, s in enumerate(t):
        points[k] = (1 - s) ** 2 * P[0] + 2 * (1 - s) * s * P[1] + s**2 * P[2]
    return points


def cubic_bezier(P, t):
    """Return one point per moment, as rows: the curve of P[0], P[1], P[2] and P[3]."""
    points = np.full((len(t), 2), np.nan)
    # TODO: for every moment, the sum of four pulls:
    # TODO:     pull of P0, pull of P1, pull of P2, pull of P3
    return points


# %%
# Check and draw
# --------------
# The check looks at each pull alone, and, once you have all four, at the whole curve. With
# the pull of P0 alone, the picture shows a line from P0 to (0, 0): that is normal. Before you
# start the check says:

canim.check("1.7", cubic_bezier=cubic_bezier)

# Picture: The same axes as above with the four control points and the dashed line between
# them. A text says that the curve is missing.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(0, 50), ylim=(-15, 45), xlabel="x", ylabel="y")
ax.plot(P[:, 0], P[:, 1], "o--", color="gray", linewidth=1.5)
for k in range(4):
    ax.annotate(f"P{k}", P[k], xytext=(9, -5), textcoords="offset points")
points = np.asarray(cubic_bezier(P, t))
ax.plot(points[:, 0], points[:, 1], label="curve")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. You move only P1, straight up. Which part of the curve moves most, and which points
#    stay where they are? Predict it, then change P1 and look.
# 2. Where does the quadratic curve of P0, P1 and P2 end? Predict it, then draw it in the
#    same way, with ``quadratic_bezier(P, t)``.
# 3. Turn the order of the points round: ``cubic_bezier(P[::-1], t)``. What happens to the
#    picture, and what to a ball that rolls along the curve?
# 4. Move the points so that the curve crosses itself. Where must they lie?
#
# Read more
# ---------
# In canim: :func:`canim.interpolation.bezier_curve` and
# :func:`canim.interpolation.de_casteljau`. Next: :ref:`Task 1.8 <task-1-8>`, where many
# curves make one shape.
