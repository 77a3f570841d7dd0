r"""
.. _task-3-5:

Task 3.5: Mix what changes in a face
====================================

You make a face smile, shout and speak, and it keeps its size. You add only what each
expression changes. Animated films and games move their faces in this way.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim
from canim.interpolation import hermite_spline

plt.style.use("canim.style")

face = canim.data.face()
shapes = face.shapes  # the expressions; the neutral face is not among them
mixes = canim.data.MIXES | {"blink": {"blink_left": 1, "blink_right": 1}}
moods = [(mix, weight) for mix in ("happy", "surprised") for weight in (1, 1.5, 2)]

# What the face says: how much of each mix there is at 0.0, 0.2, 0.4, ... seconds.
says = {
    "M": [0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    "A": [0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0],
    "O": [0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0],
    "blink": [0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0],
    "happy": [0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1],
}
knots, times = np.linspace(0, 2.4, 13), np.linspace(0, 2.4, 61)
curves = np.column_stack([hermite_spline(times, knots, says[mix], 0 * knots) for mix in says])
speech = curves @ [face.weights(mixes[mix]) for mix in says]  # weights, frame by frame

# %%
# Expected result
# ---------------
# A face that speaks. It says "Mama", blinks, says "Oh!", and smiles. Each curve is the weight of
# a mix of expressions; the curves are Hermite splines, as in Block 1.

from canim import character

poses = character.delta_blendshape(face.neutral, shapes, speech)

# Film: Left, a head that says "Mama", blinks, says "Oh" with round lips, and smiles. Right, the
# weights over 2.4 seconds: bumps for M and A in turns, one for blink, one for O, and at the
# end that of happy, which stays. A line moves over the curves.
fig, (left, right) = plt.subplots(1, 2, figsize=(6.4, 3.4), width_ratios=[1, 1.3])
fine = np.linspace(0, times[-1], 481)
for name, values in says.items():
    right.plot(fine, hermite_spline(fine, knots, values, 0 * knots), label=name)
right.set(xlim=(0, times[-1]), ylim=(-0.05, 1.15), xlabel="seconds", ylabel="weight")
canim.plotting.label_curves(right)
talking_film = canim.plotting.animate_face(left, face, poses, room=0.9, clock=right, times=times)

# %%
# A weight can be larger than 1. The expression is exaggerated, and the head keeps its size:

# Picture: The head in two rows, happy above and surprised below, with the weights 1, 1.5 and 2.
# The smile grows to that of a clown. The mouth of the surprised one opens more and more, the
# brows rise. The head is of the same size everywhere.
fig, axes = plt.subplots(2, 3, num="Expected result", figsize=(4.8, 4.2))
for ax, (mix, weight) in zip(axes.flat, moods):
    row = weight * face.weights(mixes[mix])
    vertices = character.delta_blendshape(face.neutral, shapes, row)
    canim.plotting.draw_face(ax, face, vertices, room=0.9)
    ax.set_title(f"{mix}, {weight:g}", fontsize=11)

# %%
# Theory
# ------
# In Task 3.4 each shape came with a whole head, and a sum of two heads is a head of twice the
# size. But "smile left" is not about the back of the head! Most of its vertices are just where
# they are in the neutral face :math:`\mathbf{b}_0`.
#
# **Deltas.** So subtract the neutral face from each expression :math:`\mathbf{b}_k`. What is
# left is what the expression *changes*. Such a difference is called a **delta**:
#
# .. math::
#
#    \mathbf{d}_k = \mathbf{b}_k - \mathbf{b}_0
#
# A delta is no face. It holds one arrow for each vertex: where to, and how far. Where the
# expression changes nothing, the arrow is zero, and that is most of the head. Deltas are
# **local**. What moves is orange; the number says how many of all vertices move:

shown = ["smile_left", "mouth_open", "blink_right", "brows_up_inner"]

# Picture: Four grey heads. Vertices that an expression moves are orange, the more the farther:
# with smile left a cheek and a corner of the mouth, with mouth open the chin and the lips, with
# blink right an eyelid, with brows up inner the middle of the forehead.
fig, axes = plt.subplots(1, 4, figsize=(6.4, 2.7))
for ax, name in zip(axes, shown):
    way = np.linalg.norm(face.expressions[name] - face.neutral, axis=1)
    orange = (way / way.max())[:, None] ** 0.5
    colors = (1 - orange) * [0.75, 0.75, 0.75] + orange * [0.95, 0.35, 0.05]
    painted = character.Face(face.neutral, face.expressions, face.faces, colors)
    canim.plotting.draw_face(ax, painted, room=0.9)
    ax.set_title(f"{name.replace('_', ' ')}\nmoves {np.mean(way > 0):.0%}", fontsize=11)

# %%
# **Weighted sum.** Start with the neutral face, whole, and add each delta with its weight:
#
# .. math::
#
#    \mathbf{f} = \mathbf{b}_0 + \sum_{k=1}^{K} w_k\, \mathbf{d}_k
#
# The neutral face has no weight of its own. If all other weights are 0, it is the result. A
# vertex that no delta moves stays where it is, **whatever the weights are**. Here the weights
# of Task 3.4 once more, the old way above and the new way below:

# Picture: Two rows of four heads with the sums 0.5, 1, 1.5 and 2. Above, with whole shapes, the
# head grows from half to twice its size. Below, with deltas, it keeps its size, and only its
# smile grows.
fig, axes = plt.subplots(2, 4, figsize=(6.4, 4), height_ratios=[2, 1.05])
whole = np.array([face.neutral, *shapes])
for above, below, total in zip(*axes, [0.5, 1, 1.5, 2]):
    weights = face.weights({"smile_left": total / 2, "smile_right": total / 2})
    swollen = character.global_blendshape(whole, [0, *weights])
    canim.plotting.draw_face(above, face, swollen, room=2)
    vertices = character.delta_blendshape(face.neutral, shapes, weights)
    canim.plotting.draw_face(below, face, vertices, room=2)
    below.set_ylim(-16, 16)
    above.set_title(f"sum {total:g}")

# %%
# Both ways are the same formula if the neutral face gets the weight that is left,
# :math:`w_0 = 1 - w_1 - \dots - w_K`. Then the weights sum to one by themselves.
#
# Films, games and phones work with deltas. A phone that films your face can turn it into some
# fifty weights, many times a second. They have names such as ``jawOpen`` and
# ``mouthSmileLeft``, and each of them moves one delta. The head of a film hero may have hundreds.
#
# Two things can still go wrong. Deltas that move the same vertices add up: a smile and a frown
# pull at the same corners of the mouth. And with large weights a face does what no face can
# do; you have seen it. More in :cite:t:`LewisEtAl2014`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    deltas(neutral, shapes):
#        deltas: each shape
#            minus the neutral face
#        return the deltas
#
#    delta_blendshape(neutral, shapes,
#                     weights):
#        start: the neutral face
#        weighted sum: for each shape,
#            add its weight times its delta
#        return the vertices

# %%
# Your task
# ---------
# Write the deltas, then their weighted sum. ``shapes`` is an array of shape ``(K, V, 3)``: K
# expressions, each with V rows, one for each vertex. The program runs as it is: until you
# write the sum, the face stays neutral.


def deltas(neutral, shapes):
    """Return what each expression changes: an array of the same shape as shapes."""
    changes = np.zeros(shapes.shape)
    # TODO: deltas: each shape minus the neutral face
    return changes


def delta_blendshape(neutral, shapes, weights):
    """Return the vertices of the neutral face with all the weighted changes."""
    vertices = neutral.copy()  # start: the neutral face, given
    # TODO: weighted sum: for each shape, add its weight times its delta
    return vertices


# %%
# Check and draw
# --------------
# Your program saves the film of the speaking face as ``talk.gif``, beside the program: open
# it in a browser. If your Python opens windows, one of them has a slider for every weight.
# Before you start the check says:

canim.check("3.5", deltas=deltas, delta_blendshape=delta_blendshape)

# Picture: The neutral head in two rows of three. Nothing is written yet.
fig, axes = plt.subplots(2, 3, num="Yours", figsize=(4.8, 4.2))
for ax, (mix, weight) in zip(axes.flat, moods):
    row = weight * face.weights(mixes[mix])
    vertices = delta_blendshape(face.neutral, shapes, row)
    canim.plotting.draw_face(ax, face, vertices, room=0.9)
    ax.set_title(f"{mix}, {weight:g}", fontsize=11)

poses = [delta_blendshape(face.neutral, shapes, row) for row in speech[::3]]
fig, ax = plt.subplots(num="Your film", figsize=(2.6, 3.4))
# Film: The neutral head, which does not move. Nothing is written yet.
your_film = canim.plotting.animate_face(ax, face, poses, room=0.9, hold=0)
your_film.save("talk.gif", writer="pillow", fps=8, dpi=100)

sliders = canim.plotting.weight_sliders(
    face, list(face.expressions), lambda row: delta_blendshape(face.neutral, shapes, row)
)

# %%
# Think about it
# --------------
# 1. Predict: what does the weight -1 do to a smile? And what do smile and frown look like if
#    both have the weight 1? Then try it.
# 2. Why does the head keep its size here, also if the weights sum to more than one?
# 3. Let the face say something of your own: change the numbers in the table ``says``.
#
# Read more
# ---------
# In canim: :func:`canim.character.delta_blendshape` and
# :func:`canim.interpolation.hermite_spline`. This was the last task of the course: back to the
# :ref:`first one <task-1-1>`.
