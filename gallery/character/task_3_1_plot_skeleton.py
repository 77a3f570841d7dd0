r"""
.. _task-3-1:

Task 3.1: Bend an arm with a few angles
=======================================

You bend an arm: you choose one angle for each joint, and the program finds where the hand is.
Every animated character, from a hand to a dragon, is posed in this way.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

# The chain: each link in the rest pose, from its joint to the next. Here one unit upwards.
offsets = np.array([[0.0, 1.0], [0.0, 1.0], [0.0, 1.0]])
poses = [(0, 0, 0), (-70, 0, 35), (160, -40, 95)]  # the angles of the joints, in degrees

# %%
# Expected result
# ---------------
# An arm of three links in three poses. The red dot is its root, which does not move. The
# square is its end.

from canim import character

# Picture: Three panels with a chain of three blue links. Left, the rest pose: the chain stands
# straight up on its red root. Middle, angles (-70, 0, 35): two links in one line to the right,
# the last one bent upwards. Right, angles (160, -40, 95): the chain goes down to the left,
# then further down, and its last link to the right.
fig, axes = plt.subplots(1, 3, num="Expected result", figsize=(6.4, 2.6))
for ax, degrees in zip(axes, poses):
    ax.set(xlim=(-3.3, 3.3), ylim=(-3.3, 3.3), xticks=(-3, 0, 3), yticks=(-3, 0, 3))
    ax.set(aspect="equal", title=f"{degrees}°")
    canim.plotting.draw_chain(ax, character.forward_kinematics_2d(np.radians(degrees), offsets))

# %%
# Theory
# ------
# Hold out your arm. It has stiff pieces, the bones, and they are joined by **joints**: the
# shoulder, the elbow, the wrist. In animation a stiff piece is called a **link**, and links
# one after the other are a **chain**. One end, the **root**, stays where it is. The other end
# is the **end effector**, for it is the part that does something: it points, it grasps.

angles = np.radians([-60, 50, 45])
positions = character.forward_kinematics_2d(angles, offsets)
directions = np.pi / 2 + np.cumsum(angles)

# Picture: A bent chain with names. A red dot is the root, with joint 1; blue lines are the
# links 1, 2 and 3; between them are the joints 2 and 3; a square is the end effector. At each
# joint a dashed line goes on straight, and an arc from it to the link is the angle of the joint.
fig, ax = plt.subplots()
ax.set(xlim=(-1.7, 3.9), ylim=(-0.4, 3.1), aspect="equal")
ax.set_axis_off()
before = np.pi / 2
for i, (joint, direction) in enumerate(zip(positions, directions), 1):
    ahead = joint + 0.75 * np.array([np.cos(before), np.sin(before)])
    ax.plot(*np.transpose([joint, ahead]), "--", color="gray", linewidth=1.5)
    turn = np.linspace(before, direction, 30)
    ax.plot(*(joint[:, None] + 0.55 * np.array([np.cos(turn), np.sin(turn)])), color="C1")
    middle = joint + 0.75 * np.array([np.cos(turn[15]), np.sin(turn[15])])
    ax.text(*middle, rf"$\theta_{i}$", color="C1", ha="center", va="center", fontsize=16)
    before = direction
canim.plotting.draw_chain(ax, positions)
for text, place, shift in [
    ("root, joint 1", positions[0], (-14, 0)),
    ("joint 2", positions[1], (14, -8)),
    ("joint 3", positions[2], (14, -6)),
    ("end effector", positions[3], (-14, 6)),
    ("link 1", positions[:2].mean(axis=0), (10, -14)),
    ("link 2", positions[1:3].mean(axis=0), (-10, 4)),
    ("link 3", positions[2:].mean(axis=0), (-10, -8)),
]:
    side = "left" if shift[0] > 0 else "right"
    ax.annotate(text, place, xytext=shift, textcoords="offset points", ha=side, va="center")

# %%
# Each joint turns by one **angle** :math:`\theta_i`. It is measured from where the link would
# go straight on, the dashed line. A positive angle turns to the left, counter-clockwise. So
# here :math:`\theta_1` is negative, the others are positive. This chain has three angles. They
# are its **degrees of freedom**: three numbers say all about its pose. To find the positions
# from the angles is called **forward kinematics**.
#
# Now turn your shoulder, and nothing else. The elbow moves, the wrist moves, the fingers move:
# all that comes after a joint turns with it.

# Picture: Four chains that share the first link and then fan out: only the angle of joint 2
# changes, and the links 2 and 3 turn together, like a stiff piece.
fig, ax = plt.subplots()
ax.set(xlim=(-2.2, 3.4), ylim=(-0.3, 3.2), aspect="equal", title="only joint 2 turns")
for ink, second in [(0.25, 70), (0.25, 40), (0.25, 10), (1, -20)]:
    bent = np.radians([-30, second, 40])
    canim.plotting.draw_chain(ax, character.forward_kinematics_2d(bent, offsets), ink=ink)

# %%
# How do you calculate this? Walk along the arm like a tortoise. At the root it looks the way
# the rest pose goes. **Turn** by the first angle, **move** along the first link. Turn by the
# second angle, move along the second link. And so on. It never needs to know where it is:
# each turn is measured from where it looks.
#
# Turning and moving are matrices. As in Task 2.1, a point has a third number, 1, so that a
# matrix can move it. These are called **homogeneous** coordinates. To turn by :math:`\theta`:
#
# .. math::
#
#    \mathbf{R} = \begin{pmatrix} \cos\theta & -\sin\theta & 0 \\
#    \sin\theta & \cos\theta & 0 \\ 0 & 0 & 1 \end{pmatrix}
#
# To move by the offset :math:`(x, y)` of the link:
#
# .. math::
#
#    \mathbf{Z} = \begin{pmatrix} 1 & 0 & x \\ 0 & 1 & y \\ 0 & 0 & 1 \end{pmatrix}
#
# A link is both: :math:`\mathbf{T} = \mathbf{R}\,\mathbf{Z}`. Read it from left to right,
# as the tortoise walks: first turn, then move. The order matters. Move first, turn
# then, and the tortoise has walked straight on:

c, s = np.cos(0.9), np.sin(0.9)
R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
Z = np.array([[1, 0, 0], [0, 1, 1.2], [0, 0, 1]])

# Picture: Two panels, each with a link and two small arrows at its end, red and green, that
# show where the tortoise looks. Left, R Z: the link leans to the left. Right, Z R: the link
# stands straight up, and only the two arrows at its end are turned.
fig, axes = plt.subplots(1, 2, figsize=(6.4, 3.0))
for ax, T, name in [(axes[0], R @ Z, "R Z: turn, move"), (axes[1], Z @ R, "Z R: move, turn")]:
    ax.set(xlim=(-1.6, 1.6), ylim=(-0.3, 2.0), aspect="equal", title=name)
    canim.plotting.draw_chain(ax, [(0, 0), T[:2, 2]])
    for axis, color in [(0, "red"), (1, "C2")]:
        ax.quiver(*T[:2, 2], *T[:2, axis], color=color, scale=2, scale_units="xy", zorder=3)

# %%
# For the whole chain, write the links one after the other, from the root to the end:
#
# .. math::
#
#    {}^0\mathbf{T}_N = \mathbf{T}_1\, \mathbf{T}_2 \cdots \mathbf{T}_N
#
# This is the **accumulated product**. After each factor, stop and look at it: the last column
# of the matrix is the place where the tortoise is, with a 1 below. The first two columns are
# the directions of its own :math:`x` and :math:`y`:

transforms = character.joint_transforms(angles, offsets)

# Picture: The bent chain of before. At the root and at the end of each link are two small
# arrows, red for x and green for y. They turn from link to link, and each green arrow
# has the direction of the link that ends there. Beside them stands the product of that place: T1,
# then T1 T2, then T1 T2 T3.
fig, ax = plt.subplots()
ax.set(xlim=(-1.2, 4.4), ylim=(-0.4, 3.1), aspect="equal")
ax.set_axis_off()
canim.plotting.draw_chain(ax, positions, ink=0.35)
for T, name in zip(transforms, ["", "$T_1$", "$T_1 T_2$", "$T_1 T_2 T_3$"]):
    for axis, color in [(0, "red"), (1, "C2")]:
        ax.quiver(*T[:2, 2], *T[:2, axis], color=color, scale=2, scale_units="xy", zorder=3)
    beside = T[:2, 2] - 0.38 * (T[:2, 0] + T[:2, 1])
    ax.text(*beside, name, ha="center", va="center", fontsize=16)

# %%
# Robot engineers have a standard form of :math:`\mathbf{T}`, with four numbers for each
# joint, named after Denavit and Hartenberg. Ours is a simpler one. More in
# :cite:t:`ShirleyMarschner2009`, chapter 17, and :cite:t:`Kay2005`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    rotation(angle):
#        return R, the matrix that turns
#               by this angle
#
#    forward_kinematics(angles, offsets):
#        root: at (0, 0)
#        first joint: T is its R times its Z
#            position: the last column of T
#        next joints: for each further joint
#            T times its R times its Z
#                is the new T
#            position: the last column of T
#        return all positions

# %%
# Your task
# ---------
# Write the rotation, then the next joints. The translation and the first joint are given.
# ``np.cos`` and ``np.sin`` want radians, and the angles are in radians already. ``@``
# multiplies matrices. Your program must work for a chain of any length: ``len(angles)`` is
# the number of its joints. The program runs as it is: what is not written yet does not turn,
# or is ``nan`` and not drawn.


def rotation(angle):
    """Return R: it turns by an angle in radians, counter-clockwise."""
    R = np.eye(3)
    # TODO: rotation: the cosine and sine of the angle, in rows and columns 0 and 1
    return R


def translation(offset):
    """Return Z: it moves by the offset x, y of a link."""
    Z = np.eye(3)
    Z[:2, 2] = offset
    return Z


def forward_kinematics(angles, offsets):
    """Return the root and the end of each link, one a row: shape (N + 1, 2)."""
    positions = np.full((len(angles) + 1, 2), np.nan)
    positions[0] = 0, 0  # root: given
    T = rotation(angles[0]) @ translation(offsets[0])  # first joint: given
    positions[1] = T[:2, 2]  # the last column without its 1
    # TODO: next joints: for each further joint, the new T and its position
    return positions


# %%
# Check and draw
# --------------
# Before you start, only the first link is there, and it does not turn. The check says:

canim.check("3.1", rotation=rotation, forward_kinematics=forward_kinematics)

# Picture: The same three panels. In each there is only the first link, straight up on its red
# root.
fig, axes = plt.subplots(1, 3, num="Yours", figsize=(6.4, 2.6))
for ax, degrees in zip(axes, poses):
    positions = forward_kinematics(np.radians(degrees), offsets)
    ax.set(xlim=(-3.3, 3.3), ylim=(-3.3, 3.3), xticks=(-3, 0, 3), yticks=(-3, 0, 3))
    ax.set(aspect="equal", title=f"{degrees}°")
    ax.plot(*positions.T, "o-", color="C0", linewidth=5, markersize=9)
    ax.plot(*positions[0], "o", color="red", markersize=13)  # root
    ax.plot(*positions[-1], "s", color="C3", markersize=11)  # end effector

# %%
# Think about it
# --------------
# 1. Predict: what does the chain look like with the angles (90, 90, 90), and where is its end
#    effector? Then try it.
# 2. Predict: only the angle of the first joint changes, and goes once around. What does the
#    end effector draw? And if only the last angle changes?
# 3. Make a chain of six links of different lengths. Which lines of your program must change?
#
# Read more
# ---------
# In canim: :func:`canim.character.forward_kinematics_2d` and
# :func:`canim.character.joint_transforms`. Next: :ref:`Task 3.2 <task-3-2>`, where the arm
# finds its angles by itself.
