"""Draw the picture of README.md: four figures of the first block, by canim's own functions."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from canim import interpolation
from canim.plotting import label_curves

plt.style.use("canim.style")
blue, vermilion, green, *_ = plt.rcParams["axes.prop_cycle"].by_key()["color"]
t = np.linspace(0, 1, 200)
fig, ((basis, curve), (shape, steps)) = plt.subplots(2, 2, figsize=(9.6, 7.2))

basis.set(title="Hermite basis", xlim=(0, 1), ylim=(-0.3, 1.1))
for number, values in enumerate(interpolation.hermite_basis(t)):
    basis.plot(t, values, label=f"H{number}")

curve.set(title="Bézier curve", xlim=(-2, 52), ylim=(-15, 45))
control = np.array([[5, -10], [9, 38], [38, -5], [45, 15]])
curve.plot(*control.T, "o--", color="0.55", linewidth=1.5)
curve.plot(*interpolation.bezier_curve(control, t).T, color=blue)
for number, (x, y) in enumerate(control):
    curve.annotate(f"P{number}", (x, y), (7, 5), textcoords="offset points")

shape.set(title="Smooth closed shape", xlim=(-5.2, 5.2), ylim=(-3.6, 3.6), aspect="equal")
corners = np.array([[0, 1.6], [4, 0.4], [-0.6, -2.8], [-4, 0.2]])
leaving = np.array([[1.6, 1.1], [0.4, -2.2], [-1.8, 0.2], [0.1, 1.9]])
ends = np.roll(corners, -1, axis=0)
arriving = ends - np.roll(leaving, -1, axis=0)
segments = np.stack([corners, corners + leaving, arriving, ends], axis=1)
for scale, color in ((1, green), (0.6, vermilion)):
    points = interpolation.transform_points(segments.reshape(-1, 2), scale=scale)
    path = interpolation.bezier_path(points.reshape(4, 4, 2), np.linspace(0, 4, 400))
    shape.plot(*path.T, color=color)

steps.set(title="Equal steps along a curve", xlim=(-2, 52), ylim=(-15, 45))
steps.plot(*interpolation.bezier_curve(control, t).T, color="0.55", linewidth=1.5)
steps.plot(*interpolation.equidistant_points(control, 18).T, "o", color=vermilion)

label_curves(basis)
target = Path(__file__).parent / "_static/canim.png"
fig.savefig(target, dpi=125, metadata={"Software": None})
# Few colours are enough for line art, and make the file a third as large.
Image.open(target).convert("RGB").quantize(64).save(target, optimize=True)
print(f"{target}: {target.stat().st_size // 1000} KB")
