r"""
.. _task-2-2:

Task 2.2: Ask where every pixel comes from
==========================================

You bend a picture again, but turn the question round: not "where does this pixel go?" but
"where does it come from?". Then no hole can be left. Most programs that bend pictures do
it in this way.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim
from canim.plotting import pick_points, progress
from canim.warping import affine_transforms

plt.style.use("canim.style")

click = False  # True: click key points of your own
image_a, image_b, points_a, points_b = canim.data.toy_triangles(size=160)
points_a, points_b = pick_points(image_a, image_b, points_a, points_b, click=click)
points_a = canim.warping.add_frame_points(points_a, image_a.shape)
points_b = canim.warping.add_frame_points(points_b, image_b.shape)
triangles = canim.warping.triangulate(points_a, points_b)
hole = 255, 0, 255  # a loud colour, for pixels that stay empty

# %%
# Expected result
# ---------------
# On the left the pictures of :ref:`Task 2.1 <task-2-1>`, with their holes. On the right the
# same pictures, warped backward: there is not a single hole.

from canim import warping

# Picture: Four images. On the left a green triangle in the shape of the orange one and, below,
# an orange triangle in the shape of the green one, both full of pink holes. On the right the
# same two triangles without a hole, with clean straight edges.
fig, axes = plt.subplots(2, 2, num="Expected result", figsize=(6.4, 6.9))
for row, name, image, source, target in [
    (axes[0], "A to B", image_a, points_a, points_b),
    (axes[1], "B to A", image_b, points_b, points_a),
]:
    forward, filled = warping.warp_forward(image, source, target, triangles)
    forward[~filled] = hole
    backward = warping.warp_backward(image, source, target, triangles, fill=hole)
    for ax, warped in zip(row, (forward, backward)):
        holes = np.sum(np.all(warped == hole, axis=2))
        ax.set(title=f"{name}: {holes} holes")
        ax.set_axis_off()
        ax.imshow(warped, interpolation="nearest")

# %%
# **Other pictures.** How to take the portraits, or pictures of your own, says
# :ref:`Task 2.3 <task-2-3>`. Here take small ones, for instance with ``size=(240, 320)``: the
# loops visit every pixel once for each triangle.

# %%
# Theory
# ------
# Forward warping is like throwing balls into a row of boxes. Some boxes get two, some get
# none. Backward warping goes from box to box and fetches a ball for each. No box is left out.

u = np.linspace(0, 5, 11)

# Picture: Two rows of squares. In the lower row eleven pixels; from each of them an arrow goes
# up to the row of six pixels above, often to a place between two of these. All eleven squares
# are filled, in even steps from light to dark blue.
fig, ax = plt.subplots()
ax.set(xlim=(-0.7, 10.7), ylim=(4.2, -0.8), aspect="equal")
ax.set_axis_off()
for x in range(11):
    fill = plt.cm.Blues(0.3 + 0.06 * x)
    ax.add_patch(plt.Rectangle((x - 0.5, 3), 1, 1, facecolor=fill, edgecolor="white"))
    ax.annotate("", (u[x] + 2.5, 0.6), (x, 2.95), arrowprops={"arrowstyle": "->", "lw": 1.5})
for k in range(6):
    fill = plt.cm.Blues(0.3 + 0.12 * k)
    ax.add_patch(plt.Rectangle((k + 2, -0.5), 1, 1, facecolor=fill, edgecolor="white"))

# %%
# **Inside.** Now you go through the pixels :math:`(x, y)` of the *new* image. So you ask in
# which triangle of the **target** points each of them lies. The weights are those of
# :ref:`Task 2.1 <task-2-1>`, with other corners.
#
# **Place.** The map :math:`\mathbf{A}` takes the source to the target. You want to go the
# other way, so you need its inverse:
#
# .. math::
#
#    \begin{pmatrix} u \\ v \\ 1 \end{pmatrix}
#    = \mathbf{A}^{-1} \begin{pmatrix} x \\ y \\ 1 \end{pmatrix}
#
# **Colour.** The place :math:`(u, v)` lies between four pixels. Which colour is there? The
# quick answer is that of the **nearest** pixel. The better one is a mix of all four. The
# nearer a pixel, the larger its share. This is **bilinear** interpolation:

few = np.array([[0.9, 0.2], [0.1, 0.6]])

# Picture: Four large grey squares and a red dot between their centres, nearer to the top left
# one. Beside each centre is written its share: 0.42, 0.28, 0.18, 0.12. Dotted lines show the
# way f to the right and the way g down.
fig, ax = plt.subplots()
ax.set(xlim=(-0.9, 1.9), ylim=(1.5, -0.5), aspect="equal")
ax.set_axis_off()
ax.imshow(few, cmap="gray", vmin=-0.6, vmax=1.2, interpolation="nearest")
f, g = 0.4, 0.3
for x, y, share in [(0, 0, 0.6 * 0.7), (1, 0, 0.4 * 0.7), (0, 1, 0.6 * 0.3), (1, 1, 0.4 * 0.3)]:
    ax.plot(x, y, "s", color="black")
    ax.text(x, y - 0.12 if y == 0 else y + 0.24, f"{share:.2f}", ha="center")
ax.plot([0, f, f], [g, g, 0], ":", color="red")
ax.plot(f, g, "o", color="red", markersize=12)
ax.text(f / 2, g + 0.14, "f", color="red", ha="center")
ax.text(f + 0.04, g / 2 + 0.05, "g", color="red")

# %%
# Let :math:`f` be how far :math:`u` is to the right of the left pixels, and :math:`g` how far
# :math:`v` is below the upper ones, both from 0 to 1. First mix from left to right, in the
# upper row and in the lower row. Then mix these two from top to bottom:
#
# .. math::
#
#    \mathbf{c}_\text{up} &= (1 - f)\,\mathbf{c}_{00} + f\,\mathbf{c}_{10} \\
#    \mathbf{c}_\text{low} &= (1 - f)\,\mathbf{c}_{01} + f\,\mathbf{c}_{11} \\
#    \mathbf{c} &= (1 - g)\,\mathbf{c}_\text{up} + g\,\mathbf{c}_\text{low}
#
# You know this mix: it is the straight line from a start to an end. Here the first index counts
# columns and the second one rows; in the program it is ``image[row, column]``. Look what the
# mix does to an edge:

nearest = warping.warp_backward(image_a, points_a, points_b, triangles, "nearest")
bilinear_ = warping.warp_backward(image_a, points_a, points_b, triangles)

# Picture: A close-up of the lower tip of the green triangle, twice. Left, nearest: the edges
# are rough stairs of hard green squares. Right, bilinear: squares of mixed colours along the
# edges make them look smooth.
fig, axes = plt.subplots(1, 2)
for ax, name, warped in [(axes[0], "nearest", nearest), (axes[1], "bilinear", bilinear_)]:
    ax.imshow(warped, interpolation="nearest")
    ax.set(xlim=(82, 112), ylim=(92, 62), title=name)
    ax.set_axis_off()

# %%
# Two traps. The colours of an image are whole numbers from 0 to 255, of the type ``uint8``.
# They cannot be negative: 10 - 20 becomes 246! So keep to the form above, without
# differences of colours. And a mix has decimals, so the new image is calculated with
# decimals and rounded once, at the end. More in :cite:t:`GlasbeyMardia1998` and
# :cite:t:`ShirleyMarschner2009`, chapter 11.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    bilinear(image, u, v):
#        column, row: of the pixel above and to the left
#        f, g: how far u, v are from it
#        mix the two pixels of the upper row
#        mix the two pixels of the lower row
#        return the mix of both
#
#    warp_backward(image, source, target, triangles):
#        for each triangle:
#            A: its affine map from source to target
#            for each row y and each column x
#            of the new image:
#                weights of (x, y) in the target triangle
#                inside: if no weight is below -1e-9
#                    place: inverse of A times (x, y, 1)
#                    colour: bilinear, at this place

# %%
# Your task
# ---------
# Write the bilinear mix, then ask every pixel. The pixel above and to the left is given; at
# the right and lower rim of the image it is one further in, so that there are always four.
# The map of Task 2.1 is given as well. The weights you calculate as there:
# ``np.vstack([points.T, np.ones(3)])`` puts three ``points`` in columns, and its inverse times
# :math:`(x, y, 1)` are the weights. The program runs as it is: what is not written yet stays
# empty.


def bilinear(image, u, v):
    """Return the colour of the image at (u, v), between the centres of its pixels."""
    height, width = image.shape[:2]
    u, v = np.clip(u, 0, width - 1), np.clip(v, 0, height - 1)  # not outside: given
    column, row = min(int(u), width - 2), min(int(v), height - 2)  # above, to the left: given
    f, g = u - column, v - row
    colour = np.array(hole, dtype=float)
    # TODO: bilinear: mix the upper row, mix the lower row, mix both
    return colour


def warp_backward(image, source, target, triangles):
    """Return a new image; each of its pixels asks where it comes from."""
    warped = np.full(image.shape, hole, dtype=float)
    height, width = image.shape[:2]
    for corners in progress(triangles):
        A = affine_transforms(source, target, [corners])[0]  # the map of Task 2.1: given
        # TODO: inside: loop over each row y and column x; if (x, y) is in the target triangle:
        # TODO: place: where in the source does (x, y) come from?
        # TODO: colour: bilinear at this place
    return np.round(warped).astype(np.uint8)


# %%
# Check and draw
# --------------
# The check uses small images, so it is quick. Your own picture takes a few seconds. Before
# you start the check says:

canim.check("2.2", bilinear=bilinear, warp_backward=warp_backward)

# Picture: Two images side by side. Nothing is drawn yet: both are one loud pink square, all
# holes.
fig, axes = plt.subplots(1, 2, num="Yours")
axes[0].imshow(warp_backward(image_a, points_a, points_b, triangles), interpolation="nearest")
axes[1].imshow(warp_backward(image_b, points_b, points_a, triangles), interpolation="nearest")
for ax, name in zip(axes, ["A to B", "B to A"]):
    holes = np.sum(np.all(ax.images[0].get_array() == hole, axis=2))
    ax.set(title=f"{name}: {holes} holes")
    ax.set_axis_off()

# %%
# Think about it
# --------------
# 1. Predict: what would you see if you looked for (x, y) in the triangles of the source points?
#    Then try it.
# 2. How good is the warped image, and why are the holes gone? What happens now where a
#    triangle shrinks?
# 3. Warp A to B, and the result back to A. Do you get A again? Look at the edges.
#
# Read more
# ---------
# In canim: :func:`canim.warping.warp_backward`. Next: :ref:`Task 2.3 <task-2-3>`, where one
# picture turns into the other.
