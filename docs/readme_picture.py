"""Draw the picture of README.md: a curve, a morph, an arm and two faces, by canim itself."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import canim
from canim import character, interpolation, warping
from canim.plotting import draw_chain, draw_face

plt.style.use("canim.style")
_, vermilion, green, *_ = plt.rcParams["axes.prop_cycle"].by_key()["color"]
fig = plt.figure(figsize=(9.6, 7.2), layout="none")


def title(x, y, text):
    fig.text(x, y, text, fontsize=17)


title(0.03, 0.945, "Curves")
shape = fig.add_axes((0.03, 0.5, 0.44, 0.43), aspect="equal", xlim=(-5.2, 5.2), ylim=(-3.6, 3.4))
corners = np.array([[0, 1.6], [4, 0.4], [-0.6, -2.8], [-4, 0.2]])
leaving = np.array([[1.6, 1.1], [0.4, -2.2], [-1.8, 0.2], [0.1, 1.9]])
ends = np.roll(corners, -1, axis=0)
arriving = ends - np.roll(leaving, -1, axis=0)
segments = np.stack([corners, corners + leaving, arriving, ends], axis=1)
for scale, color in ((1, green), (0.6, vermilion)):
    points = interpolation.transform_points(segments.reshape(-1, 2), scale=scale)
    path = interpolation.bezier_path(points.reshape(4, 4, 2), np.linspace(0, 4, 400))
    shape.plot(*path.T, color=color)
for start, handle in zip(corners, leaving):
    shape.plot(*np.transpose([start - handle, start + handle]), "o-", color="0.6", linewidth=1.5)
shape.plot(*corners.T, "o", color=green, markersize=10)
shape.set_axis_off()

title(0.53, 0.945, "Morphs")
portraits = canim.data.portraits()
for column, t in enumerate((0, 0.5, 1)):
    ax = fig.add_axes((0.53 + 0.15 * column, 0.56, 0.14, 0.34))
    ax.imshow(warping.morph(*portraits, t))
    ax.set_axis_off()

title(0.03, 0.445, "Arms that reach")
arm = fig.add_axes((0.03, 0.02, 0.44, 0.4), aspect="equal", xlim=(-1.7, 2.9), ylim=(-0.3, 3.1))
links, goal = [(0, 1.2), (0, 1.0), (0, 0.8)], (2.3, 1.1)
way = character.inverse_kinematics(np.radians([25, -10, 30]), links, goal).history
poses = [character.forward_kinematics_2d(pose, links) for pose in way]
shown = np.linspace(0, len(poses) - 1, 5).round().astype(int)
for k, number in enumerate(shown):
    draw_chain(arm, poses[number], ink=(0.15, 0.25, 0.35, 0.5, 1)[k])
arm.plot(*goal, "x", color=vermilion, markersize=16, markeredgewidth=4)
arm.set_axis_off()

title(0.53, 0.445, "Faces that speak")
face = canim.data.face()
for column, name in enumerate(("happy", "surprised")):
    ax = fig.add_axes((0.53 + 0.23 * column, 0.01, 0.21, 0.42))
    weights = face.weights(canim.data.MIXES[name])
    draw_face(ax, face, character.delta_blendshape(face.neutral, face.shapes, weights))

target = Path(__file__).parent / "_static/canim.png"
fig.savefig(target, dpi=125, metadata={"Software": None})
Image.open(target).convert("RGB").quantize(256).save(target, optimize=True)
print(f"{target}: {target.stat().st_size // 1000} KB")
