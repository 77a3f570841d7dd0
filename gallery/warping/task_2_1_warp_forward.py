r"""
.. _task-2-1:

Task 2.1: Send every pixel to its new place
===========================================

You bend a picture: a few points are pulled to new places, and all pixels follow. Film makers
do this to let a face age or a portrait smile.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim
from canim.plotting import draw_triangulation, pick_points, progress

plt.style.use("canim.style")

click = False  # True: click key points of your own
image_a, image_b, points_a, points_b = canim.data.toy_triangles(size=160)
points_a, points_b = pick_points(image_a, image_b, points_a, points_b, click=click)
points_a = canim.warping.add_frame_points(points_a, image_a.shape)
points_b = canim.warping.add_frame_points(points_b, image_b.shape)
triangles = canim.warping.triangulate(points_a, points_b)  # each row: the numbers of 3 points
hole = 255, 0, 255  # a loud colour, for pixels that stay empty

# %%
# Expected result
# ---------------
# Above, the two pictures with their key points and triangles. Below, each is bent into the
# shape of the other. The loud pixels are **holes**: no pixel arrived there.

from canim import warping

# Picture: Four images. Above, a green triangle and an orange triangle of another shape, each
# with red key points at its corners and with thin lines that join them and the corners of the
# image to triangles. Below, the green triangle in the shape of the orange one, and the orange
# one in the shape of the green one; both are covered with a regular pattern of loud pink holes
# where triangles grew.
fig, axes = plt.subplots(2, 2, num="Expected result", figsize=(6.4, 6.9))
draw_triangulation(axes[0, 0], image_a, points_a, triangles)
draw_triangulation(axes[0, 1], image_b, points_b, triangles)
axes[0, 0].set_title("image A")
axes[0, 1].set_title("image B")
for ax, name, image, source, target in [
    (axes[1, 0], "A to B", image_a, points_a, points_b),
    (axes[1, 1], "B to A", image_b, points_b, points_a),
]:
    warped, filled = warping.warp_forward(image, source, target, triangles)
    warped[~filled] = hole
    ax.set_axis_off()
    ax.set_title(f"{name}: {np.sum(~filled)} holes")
    ax.imshow(warped, interpolation="nearest")

# %%
# **Other pictures.** How to take the portraits, or pictures of your own, says
# :ref:`Task 2.3 <task-2-3>`. Here take small ones, for instance with ``size=(240, 320)``: the
# loops visit every pixel once for each triangle.

# %%
# Theory
# ------
# A computer sees only colours, not a nose and not a corner. You have to tell it what belongs
# together: this point here is that point there. Such pairs are called **correspondences**,
# the points **key points**. Each red point in A has its partner in B.
#
# And the pixels between the key points? Think of a sheet of rubber with the picture on it.
# Pins hold it at the key points. Move the pins, and the rubber between them follows. To
# calculate this, the sheet is cut into **triangles**, with the key points as corners. Four
# more key points, in the corners of the image, hold the frame.
#
# There are many ways to join points to triangles. A **Delaunay** triangulation avoids long
# thin ones. It is made once, from the points half way between A and B, and used for both
# images. That is given. If you made it from the points of A alone, a triangle may turn
# over in B. This is called a **fold**, and the picture lies double there:

from scipy.spatial import Delaunay

of_a = Delaunay(points_a).simplices


def side(points):
    """Return 1 for each triangle whose corners go clockwise, and -1 for the others."""
    edges = np.diff(points[of_a], axis=1)
    return np.sign(np.linalg.det(edges))


folded = of_a[side(points_a) != side(points_b)]

# Picture: Image B twice with triangles over it. Left, made from the points half way: all
# triangles lie side by side. Right, made from the points of A: one triangle, filled in red,
# lies on top of its neighbours.
fig, (good, bad) = plt.subplots(1, 2)
draw_triangulation(good, image_b, points_b, triangles)
draw_triangulation(bad, image_b, points_b, of_a)
for corners in points_b[folded]:
    bad.fill(*corners.T, color="red", alpha=0.6)
good.set_title("from the points half way")
bad.set_title("from A alone: a fold")

# %%
# **Inside.** Which triangle is a pixel in? Hang a triangle of cardboard on a finger, and
# put a weight on each corner. With the right three weights it balances at the pixel. The
# three together are 1, so each is the share of one corner:

corners = np.array([[10.0, 80.0], [120.0, 70.0], [45.0, 10.0]])
T = np.vstack([corners.T, np.ones(3)])

# Picture: A triangle with three dots. A dot in the middle has the weights 0.33, 0.33, 0.33; a
# dot nearer to one corner has 0.60, 0.30, 0.10; a red dot outside has one weight below zero.
fig, ax = plt.subplots()
ax.set(xlim=(0, 140), ylim=(90, 0), aspect="equal")
ax.set_axis_off()
ax.fill(*corners.T, color="C0", alpha=0.15)
ax.plot(*corners[[0, 1, 2, 0]].T, "o-", color="C0")
for point in [corners.mean(axis=0), np.array([0.6, 0.3, 0.1]) @ corners, np.array([110, 30])]:
    weights = np.linalg.solve(T, [*point, 1])
    color = "C2" if weights.min() >= 0 else "red"
    ax.plot(*point, "o", color=color, markersize=10)
    text = ", ".join(f"{weight:.2f}" for weight in weights)
    ax.annotate(text, point, xytext=(0, 9), textcoords="offset points", color=color, ha="center")

# %%
# Inside of the triangle no weight is below 0. On an edge one weight is 0. Outside, one is
# negative: there you would have to pull upwards. These weights :math:`w_1, w_2, w_3` are the
# **barycentric coordinates** of the pixel :math:`(u, v)`. They fulfil
#
# .. math::
#
#    \underbrace{\begin{pmatrix} x_1 & x_2 & x_3 \\ y_1 & y_2 & y_3 \\ 1 & 1 & 1
#    \end{pmatrix}}_{\mathbf{T}}
#    \begin{pmatrix} w_1 \\ w_2 \\ w_3 \end{pmatrix}
#    = \begin{pmatrix} u \\ v \\ 1 \end{pmatrix} .
#
# Each **corner is a column** of :math:`\mathbf{T}`: :math:`x`, :math:`y` and a 1. The last
# row says that the weights add up to 1. So the weights are
# :math:`\mathbf{T}^{-1} (u, v, 1)^\mathsf{T}`. A computer rounds: a weight that should be 0
# may come out as -0.0000000000000001. So we ask for "not below ``-1e-9``", to count the edges
# in.
#
# **Affine map.** A matrix :math:`\mathbf{A}` shall take the three corners of a triangle in
# the source to its three corners in the target:
#
# .. math::
#
#    \mathbf{A}\, \mathbf{T}_\text{src} = \mathbf{T}_\text{dst}
#
# Solve this for :math:`\mathbf{A}`: which matrix do you have to put behind both sides? The
# map moves, turns, scales and shears; straight lines stay straight. The 1 below each point
# makes it possible to *move* with a matrix. Every triangle has a map of its own. On the edge
# between two triangles both maps agree, so nothing tears.
#
# **Forward.** Every pixel :math:`(u, v)` of the source is sent to its **place** in the
# target,
#
# .. math::
#
#    \begin{pmatrix} x \\ y \\ 1 \end{pmatrix}
#    = \mathbf{A} \begin{pmatrix} u \\ v \\ 1 \end{pmatrix},
#
# and leaves its **colour** there. But :math:`x` and :math:`y` are hardly ever whole numbers:
# round them to the nearest pixel. And places outside of the image are left out. What happens
# where a triangle grows?

row = np.arange(6)

# Picture: Two rows of squares. In the upper row six pixels from light to dark blue, with an
# arrow from each to the lower row, which is eleven squares long. There the six blue pixels
# have pink holes between them.
fig, ax = plt.subplots()
ax.set(xlim=(-0.7, 10.7), ylim=(4.2, -0.8), aspect="equal")
ax.set_axis_off()
for x in range(11):
    fill = plt.cm.Blues(0.3 + 0.06 * x) if x % 2 == 0 else np.array(hole) / 255
    ax.add_patch(plt.Rectangle((x - 0.5, 3), 1, 1, facecolor=fill, edgecolor="white"))
for u in row:
    fill = plt.cm.Blues(0.3 + 0.12 * u)
    ax.add_patch(plt.Rectangle((u + 2, -0.5), 1, 1, facecolor=fill, edgecolor="white"))
    ax.annotate("", (2 * u, 2.95), (u + 2.5, 0.6), arrowprops={"arrowstyle": "->", "lw": 1.5})

# %%
# Six pixels cannot fill eleven places. The rest stays empty. More in
# :cite:t:`ShirleyMarschner2009`, chapters 2 and 6, and :cite:t:`GlasbeyMardia1998`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    affine_map(source, target):
#        corners as columns: T_source and T_target
#        affine map: A with  A T_source = T_target
#        return A
#
#    warp_forward(image, source, target, triangles):
#        for each triangle:
#            A: the affine map from its source corners
#               to its target corners
#            for each row v and each column u:
#                weights of (u, v) in the source triangle
#                inside: if no weight is below -1e-9
#                    place: A times (u, v, 1), rounded
#                    colour: if the place is in the image,
#                        copy the pixel to it

# %%
# Your task
# ---------
# Write the affine map, then send the pixels. Corners as columns and the weights are given.
# An image is a table: ``image[v, u]`` is the pixel in row ``v`` and column ``u``, that is at
# the point :math:`(u, v)`. ``np.linalg.inv(M)`` is the inverse of the matrix ``M``, and ``@``
# multiplies matrices. ``source[corners]`` are the three corners of a triangle, a point a row.
# ``int(np.floor(x + 0.5))`` is the whole number nearest to ``x``. The program runs as it is:
# what is not written yet stays empty.


def columns(corners):
    """Return the matrix T of three corners: each is a column x, y, 1."""
    return np.vstack([corners.T, np.ones(3)])


def affine_map(source, target):
    """Return the 3x3 matrix that takes three source corners to three target corners."""
    T_source, T_target = columns(source), columns(target)  # corners as columns: given
    A = np.full((3, 3), np.nan)
    # TODO: affine map: A @ T_source must be T_target
    return A


def warp_forward(image, source, target, triangles):
    """Return a new image with every pixel sent to its place."""
    warped = np.full(image.shape, hole, dtype=np.uint8)
    height, width = image.shape[:2]
    for corners in progress(triangles):
        A = affine_map(source[corners], target[corners])
        to_weights = np.linalg.inv(columns(source[corners]))  # weights: to_weights @ [u, v, 1]
        # TODO: inside: loop over each row v and column u; if no weight is below -1e-9:
        # TODO: place: A @ [u, v, 1] is x, y, 1; round x and y
        # TODO: colour: copy image[v, u], if the place is in the image
    return warped


# %%
# Check and draw
# --------------
# The check uses small images, so it is quick. Your own picture takes a few seconds. Before
# you start the check says:

canim.check("2.1", affine_map=affine_map, warp_forward=warp_forward)

# Picture: The same four images. Below, nothing is drawn yet: both images are one loud pink
# square, all holes.
fig, axes = plt.subplots(2, 2, num="Yours", figsize=(6.4, 6.9))
draw_triangulation(axes[0, 0], image_a, points_a, triangles)
draw_triangulation(axes[0, 1], image_b, points_b, triangles)
axes[1, 0].imshow(warp_forward(image_a, points_a, points_b, triangles), interpolation="nearest")
axes[1, 1].imshow(warp_forward(image_b, points_b, points_a, triangles), interpolation="nearest")
for ax, name in zip(axes.flat, ["image A", "image B", "A to B", "B to A"]):
    holes = np.sum(np.all(ax.images[0].get_array() == hole, axis=2))
    ax.set(title=f"{name}: {holes} holes")
    ax.set_axis_off()

# %%
# Think about it
# --------------
# 1. Predict: in which of the triangles will there be holes, and where will there be none?
#    Compare with your picture.
# 2. Which artefacts does forward warping leave, and why? What happens where a triangle
#    shrinks?
# 3. Set ``click = True`` and click key points of your own. What do you see if two of them
#    change their places?
#
# Read more
# ---------
# In canim: :func:`canim.warping.warp_forward`, :func:`canim.warping.affine_transforms` and
# :func:`canim.warping.triangulate`. Next: :ref:`Task 2.2 <task-2-2>`, where the holes go away.
