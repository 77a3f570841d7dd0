r"""
.. _task-3-3:

Task 3.3: Reach for goals in space
==================================

Your arm leaves the plane: each joint turns about three axes, and the arm reaches for goals in
front, behind, above and below. Characters in games and films are moved in this way.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim
from canim.plotting import animate_chain

plt.style.use("canim.style")

offsets = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]])  # three links, upwards
start = np.radians([[20.0, 10.0, 0.0], [-40.0, 30.0, 10.0], [-30.0, 20.0, 0.0]])  # a row a joint
goals = np.random.default_rng(82).uniform(-1.6, 1.6, (3, 3))  # at random, all within reach
step_size, tolerance = 0.2, 0.01
room = {"xlim": (-2, 2), "ylim": (-2, 2), "zlim": (-2, 2), "xlabel": "x", "ylabel": "y"}
room |= {"xticks": (-2, 0, 2), "yticks": (-2, 0, 2), "zticks": (-2, 0, 2)}

# %%
# Expected result
# ---------------
# A chain of three links in space, and a goal. Their shadows on the floor tell how near they are.
# Each joint has three angles.

from canim import character


def smoothly(angles, offsets, goal):
    """Return poses whose end effector goes straight to the goal, slower and slower."""
    first = character.forward_kinematics_3d(angles, offsets)[-1]
    count = np.log(tolerance / np.linalg.norm(goal - first)) / np.log(1 - step_size)
    poses = [angles]
    for share in 1 - (1 - step_size) ** np.arange(1, count + 1):
        near = first + share * (goal - first)
        poses.append(character.inverse_kinematics(poses[-1], offsets, near).angles)
    return poses


fig = plt.figure(num="Expected result", figsize=(4.4, 4.2))
ax = fig.add_subplot(projection="3d", **room)
# Film: A chain of three blue links stands on its red root in the middle of a room, and throws
# a shadow on the floor. An orange cross with its own shadow appears, and the chain bends until
# the square at its end covers it; then the next one, three times.
expected_film = animate_chain(ax, smoothly, character.forward_kinematics_3d, start, offsets, goals)

# %%
# A second view: the three poses in which it arrives, as solid bodies. It is drawn with pyvista;
# where that cannot render, matplotlib draws the poses from above.

from canim.plotting.faces import pyvista_renders

arrivals, pose = [], start
for goal in goals:
    pose = smoothly(pose, offsets, goal)[-1]
    arrivals.append(character.forward_kinematics_3d(pose, offsets))


def rendered(arrivals):
    """Return a picture of bodies: links are tubes, joints are balls."""
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=(1280, 800))
    plotter.set_background("#fcfcfa")
    floor = pyvista.Plane(center=(0, 0, -2), i_size=5, j_size=5)
    plotter.add_mesh(floor, color="#ecece6", lighting=False)
    for positions, color in zip(arrivals, ["#1470c8", "#06543a", "#a9409f"]):
        links = pyvista.MultipleLines(positions).tube(radius=0.08)
        plotter.add_mesh(links, color=color, smooth_shading=True)
        balls = [(center, 0.14, color) for center in positions[1:-1]]
        ends = [(positions[0], 0.2, "red"), (positions[-1], 0.16, "#c8480a")]
        for center, radius, paint in balls + ends:
            ball = pyvista.Sphere(radius=radius, center=center)
            plotter.add_mesh(ball, color=paint, smooth_shading=True)
        shadow = links.copy()
        shadow.points[:, 2] = -1.98
        plotter.add_mesh(shadow, color="#cfcfc8", lighting=False)
    plotter.camera_position = [(7.4, -7.4, 3.3), (0, 0, -0.9), (0, 0, 1)]
    return plotter.screenshot(return_img=True)


# Picture: Three bent arms in three colours grow from one red ball and end in an orange ball
# each. Their shadows lie on a floor below.
fig, ax = plt.subplots()
ax.set_axis_off()
if pyvista_renders():
    ax.imshow(rendered(arrivals))
else:
    ax.set(xlim=(-2, 2), ylim=(-2, 2), aspect="equal")
    for positions in arrivals:
        canim.plotting.draw_chain(ax, positions[:, :2])

# %%
# Theory
# ------
# Your elbow can only bend. But your shoulder is a ball: you can lift your arm to the side, lift
# it to the front, and turn it about itself. Such a joint has **three degrees of freedom**. It
# takes three angles, one about each axis. Three such joints have nine angles: a row of three
# for each joint.

# Picture: Three arrows from one point, the axes x, y and z, in three colours. Around each of them a
# curved arrow shows the positive direction of turning: from y to z around x, from z to x
# around y, and from x to y around z.
fig = plt.figure()
ax = fig.add_subplot(projection="3d", xlim=(-0.2, 1), ylim=(-0.2, 1), zlim=(-0.2, 1))
ax.set_axis_off()
turn = np.linspace(0.2, 1.4, 30)
for axis, color in enumerate(["C1", "C2", "C0"]):
    tip = np.eye(3)[axis]
    ax.quiver(0, 0, 0, *tip, color=color, arrow_length_ratio=0.1, linewidth=3)
    ax.text(*(1.1 * tip), "xyz"[axis], color=color, fontsize=16, ha="center", va="center")
    arc = np.zeros((30, 3))
    arc[:, axis] = 0.55
    arc[:, (axis + 1) % 3] = 0.3 * np.cos(turn)
    arc[:, (axis + 2) % 3] = 0.3 * np.sin(turn)
    ax.plot(*arc.T, color=color)
    ax.quiver(*arc[-2], *(arc[-1] - arc[-2]), color=color, length=4, arrow_length_ratio=1.5)

# %%
# **Rotation.** To turn about an axis in space is to turn in the plane of the other two, as in
# Task 3.1. A positive angle turns like a screw that goes the way of the axis. About
# :math:`x` it turns from :math:`y` to :math:`z`:
#
# .. math::
#
#    \mathbf{R}_x = \begin{pmatrix} 1 & 0 & 0 \\ 0 & \cos a & -\sin a \\
#    0 & \sin a & \cos a \end{pmatrix}
#
# About :math:`y` it turns from :math:`z` to :math:`x`. Mind the minus sign, for
# :math:`z` comes *before* :math:`x` here:
#
# .. math::
#
#    \mathbf{R}_y = \begin{pmatrix} \cos b & 0 & \sin b \\ 0 & 1 & 0 \\
#    -\sin b & 0 & \cos b \end{pmatrix}
#
# About :math:`z` it turns from :math:`x` to :math:`y`, as you know it from the plane. A
# joint does all three. Our order is
#
# .. math::
#
#    \mathbf{R} = \mathbf{R}_x\, \mathbf{R}_y\, \mathbf{R}_z .
#
# The order is a choice, but once chosen you must keep it. Put a book on the table and try:
# turn it up, then to the left. Put it back, turn it to the left, then up. It lies
# differently.

quarter = np.pi / 2
corners = np.array([[0, 0, 0], [0.7, 0, 0], [0.7, 1, 0], [0, 1, 0]])
x_then_z = character.joint_transforms([[quarter, 0, quarter]], [[0, 0, 1]])[-1][:3, :3]
z_then_x = character.joint_transforms([[0, 0, quarter], [quarter, 0, 0]], [[0, 0, 1], [0, 0, 1]])[
    -1
][:3, :3]

# Picture: Three panels with a flat blue page in space, which has one orange edge. Left, it lies
# on the floor. Middle and right it has been turned by a quarter about x and by a quarter about
# z, in two orders: it stands upright in two different planes.
fig = plt.figure(figsize=(6.4, 2.5))
names = ["before", r"$R_x R_z$", r"$R_z R_x$"]
for k, (R, name) in enumerate(zip([np.eye(3), x_then_z, z_then_x], names), 1):
    ax = fig.add_subplot(1, 3, k, projection="3d", title=name)
    ax.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(0, 1), xticks=(), yticks=(), zticks=())
    ax.set_xlabel("x", labelpad=-12)
    ax.set_ylabel("y", labelpad=-12)
    ax.set_box_aspect((2, 2, 1))
    page = corners @ R.T
    ax.plot_trisurf(*page.T, triangles=[(0, 1, 2), (0, 2, 3)], color="C0", alpha=0.6)
    ax.plot(*page[[0, 3]].T, color="C1", linewidth=5)

# %%
# One thing is new, and strange. With the middle angle at 90°, :math:`\mathbf{R}_x` and
# :math:`\mathbf{R}_z` turn about the same line. Three angles, but only two ways to turn: a
# degree of freedom is lost. This is called **gimbal lock**. Pilots and animators know it
# well.
#
# **The chain** is that of Task 3.1. The rotations are accumulated from joint to joint, and
# each product turns the offset of its link. It is given.
#
# **The Jacobian** has three rows now, :math:`x`, :math:`y` and :math:`z`, and a column for
# *every* angle: three for the first joint, then three for the second, and so on. With three
# joints there are nine columns. The arrows at the end effector:

positions = character.forward_kinematics_3d(start, offsets)
arrows = character.jacobian_3d(start, offsets).T

# Picture: The bent chain in its room, and nine arrows at its end effector, in three colours, one
# for each joint. Arrows that belong to the lowest joint are the longest.
fig = plt.figure()
ax = fig.add_subplot(projection="3d", **room)
canim.plotting.draw_chain(ax, positions, ink=0.4)
for k, arrow in enumerate(arrows):
    ax.quiver(*positions[-1], *(0.6 * arrow), color=f"C{(1, 2, 4)[k // 3]}", linewidth=2.5)

# %%
# **The update** is the one of Task 3.2:
#
# .. math::
#
#    \Delta\theta = \alpha\, \mathbf{J}^{+} (\mathbf{g} - \mathbf{p})
#
# It is a list of nine numbers, in the order of the columns. The angles are a table of three
# rows. ``change.reshape(angles.shape)`` makes a table of the list: the first three numbers
# are the first row.
#
# Nine angles for three coordinates: there are far more ways to reach the goal than the arm
# needs. A real arm has limits at its joints, and takes an easy pose. More in
# :cite:t:`AristidouLasenbyChrysanthouShamir2018`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    rotation(angles a, b, c):
#        Rx, Ry, Rz: about x, y and z
#        return Rx times Ry times Rz
#
#    jacobian(angles, offsets):
#        p: where the end effector is
#        for each joint i:
#            for each of its angles k:
#                turned: the angles, with
#                    angle i, k larger by epsilon
#                column 3 i + k: how far p has
#                    moved, divided by epsilon
#        return J, all columns
#
#    reach(angles, offsets, goal):
#        at most 200 times:
#            error: e, from the end effector
#                   to the goal
#            stop: if e is shorter than
#                  the tolerance
#            update: add step size times
#                    pseudoinverse of J times e,
#                    as a table, to the angles
#            put the angles into the list of poses
#        return all poses

# %%
# Your task
# ---------
# Write the rotation, the Jacobian and the loop. The rotation about :math:`x` is given, and so
# is the chain. ``angles[i, k]`` is angle ``k`` of joint ``i``; both begin at 0, and
# ``angles.size`` is the number of all angles. The program runs as it is: the chain stands
# straight and does not move.


def rotation(angles):
    """Return R of one joint: Rx Ry Rz, of its angles about x, y and z."""
    a, b, c = angles
    Rx = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])  # given
    R = np.eye(3)
    # TODO: rotation: Ry with b, Rz with c, and the product of the three
    return R


def forward_kinematics(angles, offsets):
    """Return the root and the end of each link, one a row: given."""
    positions, R = [np.zeros(3)], np.eye(3)
    for joint, offset in zip(angles, offsets):
        R = R @ rotation(joint)
        positions.append(positions[-1] + R @ offset)
    return np.array(positions)


def jacobian(angles, offsets):
    """Return J, shape (3, 3 N): three columns for each joint, one joint after the other."""
    epsilon = 1e-6
    J = np.zeros((3, angles.size))
    p = forward_kinematics(angles, offsets)[-1]  # end effector: given
    # TODO: column 3 i + k: for each joint i and each k, turn angle i, k alone by epsilon
    return J


def reach(angles, offsets, goal):
    """Return all poses on the way to the goal, one a row; the first is angles."""
    poses = [angles]
    for _ in range(200):
        # TODO: error, stop and update: as in Task 3.2; the change becomes a table
        poses.append(angles)
    return poses


# %%
# Check and draw
# --------------
# In a window you can drag the room with the mouse and look at it from all sides. Before you
# start the check says:

canim.check("3.3", rotation=rotation, jacobian=jacobian, reach=reach)

fig = plt.figure(num="Yours", figsize=(4.4, 4.2))
ax = fig.add_subplot(projection="3d", **room)
# Film: The chain stands straight and does not move. The orange cross jumps from goal to goal.
film = animate_chain(ax, reach, forward_kinematics, start, offsets, goals)

# %%
# Think about it
# --------------
# 1. Predict: which of the nine arrows are zero when the arm stands straight up, with all
#    angles 0? Then look at ``jacobian(0 * start, offsets)``.
# 2. What does a step size of 1 do to the film, and why?
# 3. Where does the chain end if a goal is out of reach? Try ``goals`` of your own.
# 4. Which of these poses can your own arm not do? How would you forbid them?
#
# Read more
# ---------
# In canim: :func:`canim.character.inverse_kinematics`,
# :func:`canim.character.forward_kinematics_3d` and :func:`canim.character.jacobian_3d`.
# Next: :ref:`Task 3.4 <task-3-4>`, where faces are mixed.
