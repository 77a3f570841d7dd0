r"""
.. _task-2-3:

Task 2.3: Turn one face into another
====================================

You make a film in which one picture turns into another, without a cut and without a ghost.
It is called a **morph**. You bend both pictures, and blend them.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim
from canim.plotting import draw_triangulation, pick_points, progress

plt.style.use("canim.style")

click = False  # True: click key points of your own
image_a, image_b, points_a, points_b = canim.data.toy_triangles(size=160)  # or portraits()
points_a, points_b = pick_points(image_a, image_b, points_a, points_b, click=click)
points_a = canim.warping.add_frame_points(points_a, image_a.shape)
points_b = canim.warping.add_frame_points(points_b, image_b.shape)
triangles = canim.warping.triangulate(points_a, points_b)
hole = 255, 0, 255  # a loud colour, for what is not written yet

# %%
# Expected result
# ---------------
# Five moments of the film, with the triangles as they move. The form and the colour change
# together.

from canim import warping

# Picture: Five images in a row. The first is a green triangle, the last an orange triangle of
# another shape. In between the triangle moves, turns and changes its colour little by little;
# thin lines, the mesh of triangles, move with it.
fig, axes = plt.subplots(1, 5, num="Expected result", figsize=(6.4, 1.6))
for ax, t in zip(axes, np.linspace(0, 1, 5)):
    moment = warping.morph(image_a, image_b, points_a, points_b, t, triangles)
    draw_triangulation(ax, moment, (1 - t) * points_a + t * points_b, triangles)
    ax.set_title(f"t = {t:.2f}")

# %%
# As a film:

times = (1 - np.cos(np.linspace(0, np.pi, 61))) / 2  # slow at both ends
frames = [warping.morph(image_a, image_b, points_a, points_b, t, triangles) for t in times]
poses = [(1 - t) * points_a + t * points_b for t in times]
fig, ax = plt.subplots(figsize=(4, 4))
# Film: A green triangle turns into an orange one of another shape. A mesh of thin lines is
# fixed at the corners of the image and moves with the triangle.
toy_film = canim.plotting.animate_morph(ax, frames, poses, triangles)

# %%
# Your program will save its film as a file, ``morph.gif``, which every browser can show:

moments = np.linspace(0, 1, 21)
frames = [warping.morph(image_a, image_b, points_a, points_b, t, triangles) for t in moments]
# GIF: The green triangle turns into the orange one, without the mesh, in even steps. Then it
# starts again.
warping.save_gif("morph.gif", frames, fps=10)

# %%
# The same program, with two portraits and 48 key points: Eileen Collins, the first woman who
# commanded a space shuttle, turns into Grace Hopper, who built one of the first compilers.

face_a, face_b, keys_a, keys_b = canim.data.portraits()
faces = [warping.morph(face_a, face_b, keys_a, keys_b, t) for t in times]
fig, ax = plt.subplots(figsize=(3.6, 4))
# Film: The face of Eileen Collins, with short brown hair, turns into that of Grace Hopper, with
# glasses and the cap of a navy uniform. Eyes, nose and mouth stay sharp all the time, they move
# from one face to the other.
face_film = canim.plotting.animate_morph(ax, faces)

# %%
# **Other pictures.** To take the two portraits in your program, change the line with
# ``toy_triangles`` to:
#
# .. code-block:: python
#
#    image_a, image_b, points_a, points_b = canim.data.portraits()
#
# For pictures of your own, press *Add pictures*. On your own computer, put the files beside
# the program. Below the line with ``toy_triangles`` write two lines with their names:
#
# .. code-block:: python
#
#    image_a = canim.data.read_image("a.jpg", size=(480, 640))
#    image_b = canim.data.read_image("b.jpg", size=(480, 640))
#
# Both must have one ``size``, here 480 pixels wide and 640 high. Set ``click = True`` and put
# key points on them: the eyes, the nose, the mouth, the outline of the head.

# %%
# Theory
# ------
# The simplest way from one picture to another is a **cross-fade**: the first one gets weaker,
# the second one stronger. Half way you see two mouths and two heads of hair: **ghosts**. The
# lower row is a cross-fade, the upper row a morph of the same two pictures:

# Picture: Two rows of five portraits, from Eileen Collins on the left to Grace Hopper on the
# right. In the upper row, the morph, each face has clear eyes and one mouth. In the lower row, the
# cross-fade, the three pictures in the middle show both faces at once, with two mouths and
# two outlines of the head.
fig, axes = plt.subplots(2, 5, figsize=(6.4, 3.1))
for column, t in zip(axes.T, np.linspace(0, 1, 5)):
    fade = np.round((1 - t) * face_a + t * face_b).astype(np.uint8)
    column[0].imshow(warping.morph(face_a, face_b, keys_a, keys_b, t))
    column[1].imshow(fade)
    column[0].set_title(f"t = {t:.2f}", fontsize=11)
    for ax in column:
        ax.set_axis_off()

# %%
# A morph first brings the two faces to the same form. Then a mouth lies on a mouth, and the
# blend shows one mouth, not two. Every moment :math:`t` of the film, from 0 to 1, takes three
# steps.
#
# **Points in between.** Where are the key points at the moment :math:`t`? On the straight way
# from their place in A to their place in B:
#
# .. math::
#
#    \mathbf{p}(t) = (1 - t)\,\mathbf{a} + t\,\mathbf{b}
#
# **Two warps.** Both pictures are warped to these points. A goes from its points to
# :math:`\mathbf{p}(t)`, and B goes from *its* points to :math:`\mathbf{p}(t)`. So each
# triangle has two maps, and at each moment they are new ones.
#
# **Blend.** Now both pictures have the same form. Mix their colours, as in a cross-fade:
#
# .. math::
#
#    M(t) = (1 - t)\,W_A(t) + t\,W_B(t)
#
# :math:`W_A` and :math:`W_B` are the two warped pictures. At :math:`t = 0` the morph is A,
# at :math:`t = 1` it is B. Calculate with decimals, and round only once, at the end: 70.7
# and 60.6 are 131.3, but 71 and 61 are 132.
#
# What can still go wrong?
#
# * **Ghosts.** What has no partner cannot move to it. Look at the cap and at the glasses: they
#   only fade in.
# * **Folds.** If two key points change sides on their way, a triangle turns over, and the
#   picture lies double there. The cure: move the points, or leave one out.
#
# More in :cite:t:`GlasbeyMardia1998`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    points_between(points_a, points_b, t):
#        return the points on the straight way
#               from points_a to points_b
#
#    morph(image_a, image_b, points_a, points_b,
#          triangles, t):
#        points in between: at the moment t
#        two warps: A from its points to these,
#                   B from its points to these
#        blend: 1 - t of A and t of B, with decimals
#        return the blend, rounded once
#
#    for each moment t from 0 to 1:
#        frame: the morph at t
#    save all frames as a film

# %%
# Your task
# ---------
# Write the points in between, then the morph. Task 2.2 is given, in a fast form:
# ``canim.warping.warp_backward(image, source, target, triangles)``. If the image has decimals,
# the warped one has them too. Saving the film is given as well. The program runs as it is:
# what is not written yet is a loud pink.


def points_between(points_a, points_b, t):
    """Return the key points at the moment t."""
    points = np.full(points_a.shape, np.nan)
    # TODO: points in between: on the straight way from points_a to points_b
    return points


def morph(image_a, image_b, points_a, points_b, triangles, t):
    """Return the image at the moment t: A at t = 0, B at t = 1."""
    a, b = image_a.astype(float), image_b.astype(float)  # with decimals: given
    blend = np.full(a.shape, hole, dtype=float)
    # TODO: points in between: at the moment t
    # TODO: two warps: with canim.warping.warp_backward, both a and b to these points
    # TODO: blend: mix the two warped images
    return np.round(blend).astype(np.uint8)  # rounded once: given


# %%
# Check and draw
# --------------
# Your program writes the film into the file ``morph.gif``, beside the program. Open it in a
# browser. Before you start the check says:

canim.check("2.3", points_between=points_between, morph=morph)

moments = np.linspace(0, 1, 21)
frames = [morph(image_a, image_b, points_a, points_b, triangles, t) for t in progress(moments)]
canim.warping.save_gif("morph.gif", frames, fps=10)

# Picture: Five images in a row. Nothing is written yet: all five are loud pink squares.
fig, axes = plt.subplots(1, 5, num="Yours", figsize=(6.4, 1.6))
for ax, frame, t in zip(axes, frames[::5], moments[::5]):
    draw_triangulation(ax, frame, points_between(points_a, points_b, t), triangles)
    ax.set_title(f"t = {t:.2f}")

# %%
# Think about it
# --------------
# 1. Predict: what do you see at t = 0.5 if both images are warped with the map of A?
#    Then try it.
# 2. What does a morph show that a cross-fade does not? Which ghosts are left between the two
#    portraits, and which key points would help?
# 3. Morph two pictures of your own, with ``canim.data.read_image``. Which pairs look good,
#    and which do not?
#
# Read more
# ---------
# In canim: :func:`canim.warping.morph`, :func:`canim.warping.morph_frames` and
# :func:`canim.warping.save_gif`. This was the last task about pictures. Next:
# :ref:`Task 3.1 <task-3-1>`, where you bend an arm.
