r"""
.. _task-3-2:

Task 3.2: Let an arm reach for a goal
=====================================

You choose a point, and the arm finds the angles by itself, in small smooth steps. In games and
films a foot finds the stair and a hand the door in this way.
"""

import matplotlib.pyplot as plt
import numpy as np

import canim
from canim.character import forward_kinematics_2d  # Task 3.1, in a fast form
from canim.plotting import animate_chain

plt.style.use("canim.style")

click = False  # True: you choose the goals
offsets = np.array([[0.0, 1.0], [0.0, 1.0], [0.0, 1.0]])  # the chain of Task 3.1
start = np.radians([-20.0, 50.0, 40.0])
goals = np.random.default_rng(249).uniform(-2, 2, (5, 2))  # at random, all within reach
step_size = 0.2
tolerance = 0.01  # nearer than this is there

# %%
# Expected result
# ---------------
# The orange cross is the **goal**. The chain reaches it, and then the next one.

from canim import character


def smoothly(angles, offsets, goal):
    """Return poses whose end effector goes straight to the goal, slower and slower."""
    first = forward_kinematics_2d(angles, offsets)[-1]
    count = np.log(tolerance / np.linalg.norm(goal - first)) / np.log(1 - step_size)
    poses = [angles]
    for share in 1 - (1 - step_size) ** np.arange(1, count + 1):
        near = first + share * (goal - first)
        poses.append(character.inverse_kinematics(poses[-1], offsets, near).angles)
    return poses


fig, ax = plt.subplots(num="Expected result", figsize=(4.2, 4.2))
ax.set(xlim=(-3.3, 3.3), ylim=(-3.3, 3.3), aspect="equal")
ax.set(xticks=(-3, 0, 3), yticks=(-3, 0, 3))
# Film: A chain of three blue links stands on its red root in the middle. An orange cross appears,
# and the chain bends until the square at its end covers the cross. The cross jumps to another
# place, and the chain follows, five times. It is quick at first, and slows down near the goal.
expected_film = animate_chain(ax, smoothly, forward_kinematics_2d, start, offsets, goals)

# %%
# And how far the end effector is from the first goal, step by step. At each step a fifth of
# the way is done. So the distance gets smaller and smaller; on this scale, where each line is
# a tenth of the one above, it falls in a straight line.


def distances(poses, goal):
    """Return for each pose how far the end effector is from the goal."""
    return [np.linalg.norm(goal - forward_kinematics_2d(pose, offsets)[-1]) for pose in poses]


# Picture: A line that falls from a distance of about 3 at step 0 straight down to 0.01 at step
# 25. A dashed line marks the tolerance, 0.01.
fig, ax = plt.subplots()
ax.set(xlabel="step", ylabel="distance from the goal", yscale="log", ylim=(0.003, 6))
ax.plot(distances(smoothly(start, offsets, goals[0]), goals[0]), "o-", markersize=4)
ax.axhline(tolerance, color="C1", linestyle="--")

# %%
# Theory
# ------
# In Task 3.1 you gave the angles and got the position: forward kinematics. Now you give the
# position, the goal, and want the angles. This is **inverse kinematics**, and it is much
# harder. For most arms there is no formula. There can be many answers, or none at all:

two = [(0.0, 1.5), (0.0, 1.5)]
goal = np.array([1.6, 1.4])

# Picture: Two panels with a chain of two links and an orange cross. Left, two poses for the same
# goal, one with the elbow above, one with the elbow below. Right, a goal outside of a dashed
# circle: the stretched arm points at it and is too short.
fig, (many, none) = plt.subplots(1, 2, figsize=(6.4, 3.2))
many.set(xlim=(-0.8, 2.6), ylim=(-0.6, 2.2), aspect="equal", title="two answers")
none.set(xlim=(-0.6, 3.8), ylim=(-0.5, 3.1), aspect="equal", title="none")
many.set_axis_off()
none.set_axis_off()
many.plot(*goal, "x", color="C1", markersize=15, markeredgewidth=4)
reached = np.linalg.norm(goal)
bend, lean = np.arccos(reached / 3), np.arctan2(*goal)
for side, ink in [(-1, 0.35), (1, 1)]:
    pose = [side * bend - lean, -2 * side * bend]
    canim.plotting.draw_chain(many, forward_kinematics_2d(pose, two), ink=ink)
far = np.array([3.1, 2.3])
none.plot(*far, "x", color="C1", markersize=15, markeredgewidth=4)
turn = np.linspace(-0.15, 1.7, 50)
none.plot(3 * np.cos(turn), 3 * np.sin(turn), "--", color="gray", linewidth=1.5)
canim.plotting.draw_chain(none, forward_kinematics_2d([-np.arctan2(*far), 0], two))

# %%
# So do what you would do in the dark. Turn one joint a very little, and feel where the hand
# goes. Turn it back, try the next one. Then you know what each joint can do for you, and you
# make a small step. And again, from the new pose.
#
# **The Jacobian.** For each joint there is an arrow: where, and how fast, the end effector
# :math:`\mathbf{p}` moves when only this joint turns.

pose = np.radians([-50, 60, 50])
positions = forward_kinematics_2d(pose, offsets)
arrows = character.jacobian_2d(pose, offsets).T

# Picture: A bent chain. At its end effector start three arrows, with the numbers of the joints.
# Each one is at a right angle to a dotted line that leads to its joint; the farther away the
# joint, the longer the arrow.
fig, ax = plt.subplots()
ax.set(xlim=(-3.3, 3.2), ylim=(-0.5, 3.3), aspect="equal")
ax.set_axis_off()
canim.plotting.draw_chain(ax, positions, ink=0.4)
for i, (joint, arrow) in enumerate(zip(positions, arrows)):
    color = f"C{(1, 2, 4)[i]}"
    ax.plot(*np.transpose([joint, positions[-1]]), ":", color=color, linewidth=2)
    ax.quiver(*positions[-1], *arrow, color=color, scale=1, scale_units="xy", angles="xy", zorder=3)
    name = positions[-1] + (1 + 0.4 / np.linalg.norm(arrow)) * arrow
    ax.text(*name, f"joint {i + 1}", color=color, ha="center", va="center")

# %%
# These arrows, as columns side by side, are a matrix: the **Jacobian** :math:`\mathbf{J}`.
# Here it has two rows, :math:`x` and :math:`y`, and a column for each joint. To measure
# column :math:`i`, turn only joint :math:`i` by a tiny angle :math:`\varepsilon`, look how
# far the end effector has moved, and divide by :math:`\varepsilon`:
#
# .. math::
#
#    \mathbf{j}_i = \frac{\mathbf{p}(\theta_i + \varepsilon) - \mathbf{p}(\theta_i)}
#    {\varepsilon}
#
# All other angles stay as they are. Turn joint :math:`i` back before you try the next one.
#
# **The error.** The arrow from the end effector to the goal :math:`\mathbf{g}`, this is where
# you want to go:
#
# .. math::
#
#    \mathbf{e} = \mathbf{g} - \mathbf{p}
#
# **The update.** If the angles change by :math:`\Delta\theta`, the end effector moves by about
# :math:`\mathbf{J}\,\Delta\theta`: so much of the first arrow, so much of the second, and so
# on. How much of each gives :math:`\mathbf{e}`? With a square matrix you would take its
# inverse. Three arrows in the plane are too many for that: there are many ways to mix them.
# The **pseudoinverse** :math:`\mathbf{J}^{+}` finds the one that turns the joints least:
#
# .. math::
#
#    \Delta\theta = \alpha\, \mathbf{J}^{+} \mathbf{e}
#
# The number :math:`\alpha` is the **step size**. An arrow is straight, but a hand moves on a
# circle: the arrow is right only for a small step. With :math:`\alpha = 1` you want all of
# the way at once, and land beside the goal. With :math:`\alpha = 0.2` you go a fifth of
# the way, then measure new arrows. They are others now, for the arm is another one.
#
# **The stop.** You are there when :math:`\mathbf{e}` is shorter than a tolerance. And if the
# goal is out of reach? Then you never are. So count the steps, and give up after 200.
#
# **When things go wrong.** Stretch your arm, and try to pull your hand straight back to the
# shoulder, by turning the joints a little. None of them does it: all arrows point sideways.

straight = np.radians([-60, 0, 0])
end = forward_kinematics_2d(straight, offsets)

# Picture: A stretched chain. The three arrows at its end effector lie on one line, at right
# angles to the chain. The goal, a cross, lies on the chain itself, where no arrow leads.
fig, ax = plt.subplots()
ax.set(xlim=(-0.6, 5.4), ylim=(-0.5, 4.9), aspect="equal")
ax.set_axis_off()
canim.plotting.draw_chain(ax, end, ink=0.4)
ax.plot(*end[1:3].mean(axis=0), "x", color="C1", markersize=15, markeredgewidth=4)
for i, arrow in enumerate(character.jacobian_2d(straight, offsets).T):
    color = f"C{(1, 2, 4)[i]}"
    ax.quiver(*end[-1], *arrow, color=color, scale=1, scale_units="xy", angles="xy", zorder=3)
    ax.text(*(end[-1] + arrow + (0.1, 0.15)), f"joint {i + 1}", color=color)

# %%
# Such a pose is called **singular**. *Exactly* there, the arm does not know how to begin. *Close*
# to it, it must turn its joints very far for a tiny step, and jumps. That is why our chain
# starts bent. And when a goal is out of reach, the arm stretches, becomes singular, and
# trembles.
#
# **Other ways.** There are many more; here are three.
#
# * **Damped least squares** turns the joints a little less than the pseudoinverse, and most
#   where it would turn them far. It does not jump near a singular pose.
# * **Cyclic coordinate descent** (CCD) needs no Jacobian. It takes one joint at a time, the
#   last one first, and turns it so that the end effector points at the goal.
# * **FABRIK** does not even know angles. It puts the end effector on the goal, and pulls the links
#   after it, one by one; then it puts the root back, and pulls the links the other way.
#
# Here all four reach for the same goals. Each one shows its own steps, only slowed down. The
# third goal is out of reach:

ways = {
    "pseudoinverse": "pseudoinverse",
    "damped": "damped least squares",
    "ccd": "CCD",
    "fabrik": "FABRIK",
}
film_goals = np.array([[2.2, 0.6], [-1.2, -1.6], [-2.6, 2.6]])
histories = []
for method in ways:
    pose, history = start, []
    for goal in film_goals:
        found = character.inverse_kinematics(
            pose, offsets, goal, method=method, max_iterations=30, closest=False
        )
        slow = canim.plotting.slow_poses(found.history, 0.25)[:45]
        history.append([forward_kinematics_2d(angles, offsets) for angles in slow])
        pose = slow[-1]
    histories.append(history)

fig, axes = plt.subplots(2, 2, figsize=(4.6, 5))
for ax, name in zip(axes.flat, ways.values()):
    ax.set(xlim=(-3.3, 3.3), ylim=(-3.3, 3.3), aspect="equal", title=name)
    ax.add_patch(plt.Circle((0, 0), 3, fill=False, linestyle="--", color="gray"))
    ax.set_axis_off()
# Film: Four panels with the same chain and the same orange cross, which goes to three places.
# For the first two, within reach, pseudoinverse and damped least squares move alike, nearly
# straight to the cross. CCD swings in from the end of the chain, FABRIK comes around from
# outside, and both end in other poses. The third is beyond the dashed circle of what can be
# reached: all four stretch towards it; the two above go on trembling.
ways_film = canim.plotting.animate_chains(axes.flat, histories, film_goals)

# %%
# And counted, for 1000 goals within reach and 1000 out of reach, with at most 200 steps. *Done*
# are those that end as near to the goal as can be, up to a thousandth of the chain's length.
# *Steps* and *error*, in lengths of the chain, are those of a typical goal, the median.

random = np.random.default_rng(1)
turns = random.uniform(0, 2 * np.pi, 1000)
directions = np.column_stack([np.cos(turns), np.sin(turns)])
starts = random.uniform(-2, 2, (1000, 3))
print(" " * 24 + "within reach          out of reach")
print(" " * 23 + "done  steps   error   done  steps   error")
for method, name in ways.items():
    line = f"{name:<22}"
    for nearest, farthest in [(0.3, 2.9), (3.1, 4.5)]:
        goals_1000 = random.uniform(nearest, farthest, (1000, 1)) * directions
        found = character.inverse_kinematics_batch(
            starts, offsets, goals_1000, method=method, closest=False
        )
        beyond = np.linalg.norm(goals_1000, axis=1) - 3
        error = (found.error - beyond.clip(0)) / 3
        steps = np.median(found.iterations)
        line += f"{np.mean(error < 1e-3):5.0%}  {steps:5.0f} {np.median(error):7.0e} "
    print(line)

# %%
# Out of reach, nobody tells these methods that they are as near as can be: they use up all their
# steps, and the first two tremble. So ``canim`` asks first whether a goal is within
# reach, and stretches the chain towards it where it is not.
#
# More in :cite:t:`AristidouLasenbyChrysanthouShamir2018` and :cite:t:`Buss2004`.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    jacobian(angles, offsets):
#        p: where the end effector is
#        for each joint i:
#            turned: the angles, with angle i
#                    larger by epsilon
#            column i: how far p has moved,
#                      divided by epsilon
#        return J, all columns
#
#    reach(angles, offsets, goal):
#        at most 200 times:
#            error: e, from the end effector
#                   to the goal
#            stop: if e is shorter than
#                  the tolerance
#            update: add step size times
#                    pseudoinverse of J times e
#                    to the angles
#            put the angles into the list of poses
#        return all poses

# %%
# Your task
# ---------
# Write the Jacobian, then the loop: error, stop, update. Programs count from 0: joint 1 has
# ``angles[0]`` and column 0, ``J[:, 0]``. The loop ends after 200 steps, that is given, and so
# is the list of poses. ``forward_kinematics_2d(angles, offsets)[-1]`` is the end effector.
# ``np.linalg.pinv(J)`` is the pseudoinverse, ``np.linalg.norm(e)`` the length of ``e``, and
# ``break`` leaves a loop. An array has only one place in the memory: ``b = a`` is a second
# name for it, ``b = a.copy()`` is a second array. The program runs as it is: the chain does
# not move yet.


def jacobian(angles, offsets):
    """Return J, shape (2, N): column i is where the end effector moves with joint i."""
    epsilon = 1e-6
    J = np.zeros((2, len(angles)))
    p = forward_kinematics_2d(angles, offsets)[-1]  # end effector: given
    # TODO: column i: for each joint, turn it alone by epsilon, and see how p moves
    return J


def reach(angles, offsets, goal):
    """Return all poses on the way to the goal, one a row; the first is angles."""
    poses = [angles]
    for _ in range(200):
        # TODO: error: e, from the end effector to the goal
        # TODO: stop: leave the loop where e is shorter than tolerance
        # TODO: update: new angles, with step_size, the pseudoinverse of J, and e
        poses.append(angles)
    return poses


# %%
# Check and draw
# --------------
# Your film shows each of your steps. With ``click = True`` you choose the goals. On this page you
# put them on a picture; in a window of its own, the chain follows your mouse. Before you start
# the check says:

canim.check("3.2", jacobian=jacobian, reach=reach)

fig, ax = plt.subplots(num="Yours", figsize=(4.2, 4.2))
ax.set(xlim=(-3.3, 3.3), ylim=(-3.3, 3.3), aspect="equal")
ax.set(xticks=(-3, 0, 3), yticks=(-3, 0, 3))
# Film: The chain does not move. The orange cross jumps from goal to goal.
film = animate_chain(ax, reach, forward_kinematics_2d, start, offsets, goals, click=click)

poses = reach(start, offsets, goals[0])
ends = [forward_kinematics_2d(angles, offsets)[-1] for angles in poses]
# Picture: The distance from the first goal stays the same in all 200 steps: a level line.
fig, ax = plt.subplots(num="Yours: distance")
ax.set(xlabel="step", ylabel="distance from the goal", yscale="log", ylim=(0.003, 6))
ax.plot(np.linalg.norm(goals[0] - ends, axis=1), "o-", markersize=4)
ax.axhline(tolerance, color="C1", linestyle="--")

# %%
# Think about it
# --------------
# 1. Predict: what does the film look like with a step size of 1? And of 2? Try both.
# 2. Predict: what happens if a goal is out of reach, at (4, 0)? Then try it, with ``goals``
#    of your own. How does the chain end?
# 3. Start with all angles 0, ``start = np.zeros(3)``, and with the goal (0, 2). What happens,
#    and why?
# 4. The chain has three angles, and the goal two coordinates. What is the third angle good
#    for?
#
# Read more
# ---------
# In canim: :func:`canim.character.inverse_kinematics`, :func:`canim.character.jacobian_2d` and
# :func:`canim.character.numeric_jacobian`. Next:
# :ref:`Task 3.3 <task-3-3>`, where the arm leaves the plane.
