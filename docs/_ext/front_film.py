"""The film of the front page: a curve, a morph, an arm and a face, all at once, by canim."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation

import canim
from canim import character, interpolation, warping
from canim.plotting import draw_chain, draw_face, slow_poses

FRAMES, HOLD, MILLISECONDS = 104, 8, 66
# What the face does, at equal distances in time.
MOODS = ({}, canim.data.MIXES["happy"], canim.data.MIXES["surprised"], canim.data.MIXES["happy"])


def smooth(t):
    """Return the way walked until the time t: slow at both ends, as in Task 1.1."""
    return interpolation.hermite_curve(np.clip(t, 0, 1), 0, 1, 0, 0)


def curve(ax):
    """Draw a closed curve of four segments with a pen; return what draws one moment."""
    corners = np.array([[0, 1.6], [4, 0.4], [-0.6, -2.8], [-4, 0.2]])
    leaving = np.array([[1.6, 1.1], [0.4, -2.2], [-1.8, 0.2], [0.1, 1.9]])
    ends = np.roll(corners, -1, axis=0)
    arriving = ends - np.roll(leaving, -1, axis=0)
    path = np.stack([corners, corners + leaving, arriving, ends], axis=1)
    for point, handle in zip(corners, leaving):
        ax.plot(*np.transpose([point - handle, point + handle]), "o-", color="0.6", linewidth=1.5)
    ax.plot(*corners.T, "o", color="C2", markersize=9)
    (line,) = ax.plot([], [], color="C2")
    (pen,) = ax.plot([], [], "o", color="C1", markersize=9)
    ax.set(aspect="equal", xlim=(-4.8, 4.8), ylim=(-3.4, 3))

    def show(t):
        walked = interpolation.bezier_path(path, np.linspace(0, 4 * smooth(t), 200))
        line.set_data(*walked.T)
        pen.set_data(*walked[-1:].T)

    return show


def morph(ax):
    """Turn one portrait into the other."""
    portraits = canim.data.portraits()
    image = ax.imshow(portraits[0])
    return lambda t: image.set_data(warping.morph(*portraits, float(smooth((t - 0.1) / 0.8))))


def arm(ax):
    """Let an arm reach for three goals, one after the other."""
    links, angles, poses = [(0, 1.2), (0, 1.0), (0, 0.8)], np.radians([40, 20, 10]), []
    goals = [(1.1, 2.2), (2.2, 0.9), (-0.6, 2.1)]
    for goal in goals:
        way = slow_poses(character.inverse_kinematics(angles, links, goal).history, 0.02)
        poses.append([character.forward_kinematics_2d(pose, links) for pose in way])
        angles = way[-1]
    (cross,) = ax.plot([], [], "x", color="C1", markersize=14, markeredgewidth=4)
    given = len(ax.lines)
    ax.set(aspect="equal", xlim=(-1.4, 3), ylim=(-0.5, 2.7))

    def show(t):
        for part in ax.lines[given:]:
            part.remove()
        number = min(int(3 * t), 2)
        step = smooth(1.25 * (3 * t - number)) * (len(poses[number]) - 1)
        draw_chain(ax, poses[number][round(float(step))])
        cross.set_data(*np.transpose([goals[number]]))

    return show


def face(ax):
    """Mix the moods of a face."""
    head = canim.data.face()
    weights = np.array([head.weights(mood) for mood in MOODS])

    def show(t):
        before = min(int(3 * t), 2)
        now = interpolation.lerp(weights[before], weights[before + 1], smooth(3 * t - before))
        for image in [*ax.images, *ax.collections]:
            image.remove()
        draw_face(ax, head, character.delta_blendshape(head.neutral, head.shapes, now), room=0.9)

    return show


def film():
    """Return the film, of four pictures that move at the same time."""
    plt.style.use("canim.style")
    figure, axes = plt.subplots(2, 2, figsize=(6.4, 5.2))
    parts = {
        "Curves": curve,
        "Morphs": morph,
        "Arms that reach": arm,
        "Faces that speak": face,
    }
    shows = []
    for number, (ax, (title, make)) in enumerate(zip(axes.flat, parts.items())):
        x, y = 0.02 + 0.51 * (number % 2), 0.07 + 0.47 * (number < 2)
        figure.text(x, y + 0.405, title, fontsize=16)
        ax.set_position((x, y, 0.45, 0.385))
        ax.set_anchor("W")
        shows.append(make(ax))
        ax.set_axis_off()

    def draw(frame):
        for show in shows:
            show(frame / (FRAMES - 1))
        return []

    frames = [*range(FRAMES), *[FRAMES - 1] * HOLD]
    return FuncAnimation(figure, draw, frames=frames, interval=MILLISECONDS)
