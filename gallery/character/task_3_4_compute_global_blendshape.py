r"""
.. _task-3-4:

Task 3.4: Mix a face from other faces
=====================================

You mix faces, as a painter mixes colours: half of this one, half of that one. With a handful
of shapes and one number for each of them, an animator makes thousands of expressions.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

face = canim.data.face()  # a head and its expressions
names = ["neutral", *face.expressions]
shapes = np.array([face.neutral, *face.shapes])  # names[k] is the name of shapes[k]
smile = [names.index("smile_left"), names.index("smile_right")]
first, second = names.index("mouth_open"), names.index("pucker")

# %%
# Expected result
# ---------------
# One face turns into another and back. The curves show how much of each is in the mix: the
# two **weights**.

from canim import character

time = np.linspace(0, 1, 49)
t = (1 - np.cos(2 * np.pi * time)) / 2  # slow at both ends, and back again
weights = np.zeros((len(t), len(shapes)))
weights[:, first], weights[:, second] = 1 - t, t
poses = character.global_blendshape(shapes, weights)

# Film: Left, a head: its mouth closes from wide open to puckered lips, and opens again. Right,
# two curves over time: the weight of "mouth open" falls from 1 to 0 and rises again, the
# weight of "pucker" does the opposite. A line moves over them.
fig, (left, right) = plt.subplots(1, 2, figsize=(6.4, 3.4), width_ratios=[1, 1.1])
right.plot(time, 1 - t, label="mouth open")
right.plot(time, t, label="pucker")
right.set(xlim=(0, 1), ylim=(-0.05, 1.05), xticks=(), xlabel="time", ylabel="weight")
canim.plotting.label_curves(right)
mouth_film = canim.plotting.animate_face(
    left, face, poses, room=0.9, clock=right, times=time, hold=0
)

# %%
# These are all the shapes that you can mix. Left and right are those of the head itself.

# Picture: The same head 25 times, with names: neutral, blink left, blink right, brow down left,
# and so on to tongue out. Each shows one small change: one eye is closed, a brow is up, the
# cheeks are full of air, a corner of the mouth smiles.
fig, axes = plt.subplots(5, 5, figsize=(6.4, 10.2))
for ax in axes.flat:
    ax.set_axis_off()
for ax, name, shape in zip(axes.flat, names, shapes):
    canim.plotting.draw_face(ax, face, shape, room=0.9)
    ax.set_title(name.replace("_", "\n", 1).replace("_", " "), fontsize=14, pad=2, loc="center")

# %%
# Theory
# ------
# In a computer a head is a **mesh**. It has points, called **vertices**; each is three numbers,
# x, y and z. Triangles join the vertices and make a skin of them. They are called **faces**, a
# word that is a little unlucky here.
#
# An artist moves the vertices of the neutral face until it smiles, and saves this as a new
# shape. No vertex is added and none is lost: the shapes have the **same topology**. So vertex
# number 7 is the same spot of skin in every shape, and all shapes have the same triangles.

from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

corner = np.argmax(np.abs(face.expressions["smile_left"] - face.neutral).sum(axis=1))
a, b, c = face.faces.T
joined = coo_array(
    (np.ones(2 * len(a)), (np.append(a, b), np.append(b, c))), [len(face.neutral)] * 2
)
parts = connected_components(joined, directed=False)[1]  # skin, teeth, tongue, eyes
skin = face.faces[parts[a] == parts[corner]]

# Picture: The mouth of the head, twice: left neutral, right with a smile on one side. Around the
# corner of the mouth thin lines show the triangles of the skin. A red dot marks the same vertex
# in both: in the smile it is higher and farther out, and the triangles around it are pulled along.
fig, axes = plt.subplots(1, 2, figsize=(6.4, 2.5))
near = np.linalg.norm(face.neutral[skin].mean(axis=1) - face.neutral[corner], axis=1) < 2.4
x, y = face.neutral[corner, :2]
for ax, name in zip(axes, ["neutral", "smile_left"]):
    vertices = shapes[names.index(name)]
    canim.plotting.draw_face(ax, face, vertices, turn=0)
    a, b, c = vertices[skin].transpose(1, 0, 2)
    ahead = np.cross(b - a, c - a)[:, 2] > 0
    ax.triplot(*vertices[:, :2].T, skin[near & ahead], color="black", linewidth=0.6)
    ax.plot(*vertices[corner, :2], "o", color="red", markersize=9)
    ax.set(xlim=(x - 6.5, x + 2.5), ylim=(y - 2.5, y + 3.5))
    ax.set_title(f"{name.replace('_', ' ')}, vertex {corner}")

# %%
# Now vertices can be mixed one by one, and a mix of shapes is a shape again. Give each shape
# :math:`\mathbf{b}_k` a weight :math:`w_k`, multiply, and add:
#
# .. math::
#
#    \mathbf{f} = \sum_{k=0}^{K} w_k\, \mathbf{b}_k
#
# Such a weighted sum is called a **linear combination**. Start every vertex at zero, and add
# one shape after the other. Shape 0 is the neutral face: it needs a weight as the others do.
#
# The film above uses two shapes only. At the moment :math:`t`, from 0 to 1, the first one has
# the weight :math:`1 - t`, the second one :math:`t`, and all others have 0. These **weights of
# a moment** always **sum to one**: it is like a recipe, where half a glass of juice and half a
# glass of water fill one glass.
#
# What if the glass gets too full? A wide smile wants the left corner of the mouth *and* the
# right one: "smile left" with the weight 1, and "smile right" with the weight 1. **Predict**,
# before you look at the picture: what do you see if the weights sum to 2? And if they sum to
# one half?

sums = [0.5, 1, 1.5, 2]

# Picture: Four times the smiling head, each with the neutral height as two dashed lines. With the
# sum 0.5 it is half as large, with 1 it has the right size but only a small smile, with 1.5 it
# is half as large again, and with 2 it is twice as large.
fig, axes = plt.subplots(1, 4, num="What the sum does", figsize=(6.4, 2.6))
for ax, total in zip(axes, sums):
    weights = np.zeros(len(shapes))
    weights[smile] = total / 2
    canim.plotting.draw_face(ax, face, character.global_blendshape(shapes, weights), room=2)
    ax.set_title(f"sum {total:g}")
    for y in face.neutral[:, 1].min(), face.neutral[:, 1].max():
        ax.axhline(y, color="0.5", linewidth=1, linestyle="--")

# %%
# The dashed lines are the top and the bottom of the neutral head: the head itself is scaled!
# Each shape holds a whole head, and a small change. Two times the head is a head of twice the
# size. And with the sum 1, where the size is right, there is only half a smile on each side.
#
# It grows out of the **origin**, the point where x, y and z are 0. Here this is the middle of
# the head. If the origin were on the floor, as it is for a whole figure, the head would
# also fly away upwards.
#
# So here only weights that sum to one are of use. Task 3.5 lifts this limit. More in
# :cite:t:`LewisEtAl2014`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    global_blendshape(shapes, weights):
#        start: every vertex at zero
#        weighted sum: for each shape,
#            add its weight times the shape
#        return the vertices
#
#    weights_at(t, count,
#               first, second):
#        weights of a moment: all 0,
#            but 1 - t for the first
#            and t for the second shape
#        return the weights

# %%
# Your task
# ---------
# Write the weighted sum, then the weights of a moment. A shape is an array of shape
# ``(V, 3)``: one row for each of the V vertices. NumPy multiplies and adds all of them at
# once. The program runs as it is: until you write the sum, all faces are neutral.


def global_blendshape(shapes, weights):
    """Return the vertices of the mix. shapes[0] is the neutral face."""
    vertices = shapes[0].copy()  # the neutral face, for now
    # TODO: start: every vertex at zero, in place of the line above
    # TODO: weighted sum: for each shape, add its weight times the shape
    return vertices


def weights_at(t, count, first, second):
    """Return count weights: at t = 0 shape first has all, at t = 1 shape second."""
    weights = np.zeros(count)
    # TODO: weights of a moment: one for shape number first, one for number second
    return weights


# %%
# Check and draw
# --------------
# Your program saves a film as ``film.gif``, beside the program: open it in a browser. If your
# Python opens windows, one of them has a slider for every weight. Before you start the check
# says:

canim.check("3.4", global_blendshape=global_blendshape, weights_at=weights_at)

# Picture: The neutral head four times, always of the same size. Nothing is written yet.
fig, axes = plt.subplots(1, 4, num="Yours", figsize=(6.4, 2.6))
for ax, total in zip(axes, [0.5, 1, 1.5, 2]):
    weights = np.zeros(len(shapes))
    weights[smile] = total / 2  # half of it for each side
    canim.plotting.draw_face(ax, face, global_blendshape(shapes, weights), room=2)
    ax.set_title(f"sum {total:g}")

moments = np.linspace(0, 1, 13)
rows = [weights_at(t, len(shapes), first, second) for t in moments]
poses = [global_blendshape(shapes, row) for row in rows]
fig, ax = plt.subplots(num="Your film", figsize=(2.6, 3.4))
# Film: The neutral head, which does not move. Nothing is written yet.
your_film = canim.plotting.animate_face(ax, face, poses, room=0.9, hold=0)
your_film.save("film.gif", writer="pillow", fps=10, dpi=100)

sliders = canim.plotting.weight_sliders(
    face, names, lambda weights: global_blendshape(shapes, weights), weights
)

# %%
# Think about it
# --------------
# 1. Predict: what is left of the head if all weights are 0? And if only the neutral face has
#    a weight, 0.1? Then try it.
# 2. What happens when the weights sum to more than one, and why?
# 3. Give smile left the weight 1 and smile right the weight 1. Which weight must the neutral
#    face have, so that the sum is one? Predict what you will see, and try it.
#
# Read more
# ---------
# In canim: :func:`canim.character.global_blendshape` and
# :func:`canim.character.load_expressions`, which reads OBJ files of your own.
# :func:`canim.data.save_expressions` writes the head of this page as OBJ files; here they are
# `in one zip <../../starters/canim-head.zip>`__. Next: :ref:`Task 3.5 <task-3-5>`, where faces
# no longer swell.
