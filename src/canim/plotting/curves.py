"""Name curves where they run, so that no legend is needed."""

from __future__ import annotations

from itertools import product
from typing import Any

import matplotlib.patheffects as effects
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from numpy.typing import NDArray

Floats = NDArray[np.float64]

# In pixels at 100 dots per inch: from a curve to its name, and from a name to the nearest
# other curve, beyond which it does not matter how far away that is.
_BESIDE, _FAR = 3, 60


def label_curves(ax: Axes) -> None:
    """Write the label of each curve beside it; say of curves that are all nan: missing.

    Curves are the lines of `ax` that were drawn with ``label=...``. A name goes where it
    is farthest from the other curves and names. Call it last, when the limits of the
    axes are set.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        The axes with the curves.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from canim.plotting import label_curves
    >>> fig, ax = plt.subplots()
    >>> _ = ax.plot([0, 1], [0, 1], label="up")
    >>> _ = ax.plot([0, 1], [float("nan")] * 2, label="down")
    >>> label_curves(ax)
    >>> [text.get_text() for text in ax.texts]
    ['up', 'down is missing']
    """
    figure: Any = ax.figure.figure  # the whole one, also where ax is in a subfigure
    figure.draw_without_rendering()
    inside = ax.get_window_extent()
    pixel = figure.dpi / 100
    drawn = {line: _pixels(line) for line in ax.lines}
    names = [_corners_and_middles(text.get_window_extent()) for text in ax.texts]
    missing = []
    for line in ax.lines:
        if str(line.get_label()).startswith("_"):
            continue
        points = drawn[line]
        text = ax.text(0, 0, str(line.get_label()), color=line.get_color(), fontsize=12)
        text.set_path_effects([effects.withStroke(linewidth=3, foreground=ax.get_facecolor())])
        if not len(points):
            text.set_text(f"{line.get_label()} is missing")
            missing.append(text)
            continue
        box = text.get_window_extent()
        half = np.array([box.width, box.height]) / 2
        others = [drawn[other] for other in ax.lines if other is not line] + names
        beside = _BESIDE * pixel
        if line.get_marker() != "None":
            beside += line.get_markersize() / 2 * figure.dpi / 72
        best = _farthest(points, half, inside, others, beside, _FAR * pixel)
        text.set(position=ax.transData.inverted().transform(best), ha="center", va="center")
        names.append(_corners_and_middles(Bbox([best - half, best + half])))
    _put_into_a_corner(ax, missing, [*drawn.values(), *names])


def _put_into_a_corner(ax: Axes, texts: list[Text], others: list[Floats]) -> None:
    """Put the texts below each other into the corner that is freest of `others`."""
    if not texts:
        return
    axes = ax.get_window_extent()
    boxes = [text.get_window_extent() for text in texts]
    step = 1.4 * max(box.height for box in boxes)
    half = np.array([max(box.width for box in boxes), step * len(boxes)]) / 2
    # The first of the best is taken: that at the top right, where nothing is in its way.
    signs = np.array([(1, 1), (-1, 1), (1, -1), (-1, -1)])
    middle, size = np.add(axes.min, axes.max) / 2, np.subtract(axes.max, axes.min)
    centres = middle + signs * (0.48 * size - half)
    room = np.min([np.minimum(_gaps(centres, half, other), step) for other in others], axis=0)
    corner = int(np.argmax(room))
    x = centres[corner, 0] + signs[corner, 0] * half[0]
    top = centres[corner, 1] + half[1]
    for k, text in enumerate(texts):
        text.set(position=ax.transAxes.inverted().transform((x, top - k * step)))
        text.set(transform=ax.transAxes, va="top", ha="right" if signs[corner, 0] > 0 else "left")


def _pixels(line: Line2D) -> Floats:
    """Return points of `line` in pixels, with points in between, those that are nan left out."""
    xy = np.column_stack(line.get_data(orig=False)).astype(float)
    pixels = line.get_transform().transform(xy)
    if len(pixels) > 1 and line.get_linestyle() != "None":
        # Long straight pieces get points in between, or names would be put on them.
        steps = np.linspace(0, len(pixels) - 1, 301)
        pixels = np.column_stack([np.interp(steps, np.arange(len(pixels)), p) for p in pixels.T])
    points: Floats = pixels[np.isfinite(pixels).all(axis=1)]
    return points


def _corners_and_middles(box: Bbox) -> Floats:
    middle, half = np.add(box.min, box.max) / 2, np.subtract(box.max, box.min) / 2
    points: Floats = middle + half * np.array(list(product((-1, 0, 1), repeat=2)))
    return points


def _farthest(
    points: Floats, half: Floats, inside: Bbox, others: list[Floats], beside: float, far: float
) -> Floats:
    """Return the centre, beside the curve, whose box keeps farthest from all else."""
    directions: list[Any] = [d for d in product((0, 1, -1), repeat=2) if any(d)]
    sides = np.array(directions) * (half + beside)
    centres = (points[:: max(1, len(points) // 50), None] + sides).reshape(-1, 2)
    fits = np.all((centres - half > inside.min) & (centres + half < inside.max), axis=1)
    centres = centres[fits] if fits.any() else centres
    score = np.full(len(centres), far)
    for other in others:
        # Curves are dense enough for half of their points; single points all count.
        score = np.minimum(score, _gaps(centres, half, other[:: 2 if len(other) > 100 else 1]))
    # On its own curve a name is hard to read; away from it, it seems to belong to another.
    score += 10 * np.minimum(_gaps(centres, half, points), beside)
    # Among places that are as good, one in the middle is found first.
    middle, size = np.add(inside.min, inside.max) / 2, np.subtract(inside.max, inside.min)
    score -= np.abs((centres - middle) / size).max(axis=1)
    best: Floats = centres[np.argmax(score)]
    return best


def _gaps(centres: Floats, half: Floats, points: Floats) -> Floats:
    """Return how far the box around each centre is from the nearest point."""
    if not len(points):
        return np.full(len(centres), np.inf)
    apart = np.maximum(np.abs(centres[:, None] - points) - half, 0)
    gaps: Floats = np.hypot(apart[..., 0], apart[..., 1]).min(axis=1)
    return gaps
