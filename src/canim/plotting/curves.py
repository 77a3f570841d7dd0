"""Name curves where they run, so that no legend is needed."""

from __future__ import annotations

from itertools import product
from typing import Any

import matplotlib.patheffects as effects
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.transforms import Bbox
from numpy.typing import NDArray

Floats = NDArray[np.float64]


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
    ax.figure.canvas.figure.draw_without_rendering()
    named = [line for line in ax.lines if not str(line.get_label()).startswith("_")]
    drawn = {line: _pixels(ax, line) for line in named}
    taken = [points for line in ax.lines if len(points := drawn.get(line, _pixels(ax, line)))]
    inside = ax.get_window_extent()
    size = ax.figure.dpi / 72 * 12
    missing = 0
    for line, points in drawn.items():
        name = str(line.get_label())
        style: dict[str, Any] = {"color": line.get_color(), "fontsize": 12}
        if not len(points):
            where: dict[str, Any] = {"transform": ax.transAxes, "ha": "right", "va": "top"}
            ax.text(0.98, 0.96 - 0.08 * missing, f"{name} is missing", **style, **where)
            missing += 1
            continue
        half = np.array([0.3 * len(name) + 0.3, 0.7]) * size
        best = _farthest(points, half, inside, taken)
        x, y = ax.transData.inverted().transform(best)
        text = ax.text(x, y, name, **style, ha="center", va="center")
        text.set_path_effects([effects.withStroke(linewidth=3, foreground=ax.get_facecolor())])
        taken.append(best + half * np.array(list(product((-1, 0, 1), repeat=2))))


def _pixels(ax: Axes, line: Line2D) -> Floats:
    """Return the points of `line` in pixels, those that are nan left out."""
    xy = np.column_stack(line.get_data(orig=False)).astype(float)
    xy = xy[np.isfinite(xy).all(axis=1)]
    if not len(xy):
        return np.empty((0, 2))
    pixels = ax.transData.transform(xy)
    # Long straight pieces get points in between, or names would be put on them.
    steps = np.linspace(0, len(pixels) - 1, 200)
    return np.column_stack([np.interp(steps, np.arange(len(pixels)), p) for p in pixels.T])


def _farthest(points: Floats, half: Floats, inside: Bbox, taken: list[Floats]) -> Floats:
    """Return the centre, beside the curve, whose box keeps farthest from all else."""
    sides = np.array([(0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0)])
    centres = (points[::4, None] + sides * half).reshape(-1, 2)
    fits = np.all((centres - half > inside.min) & (centres + half < inside.max), axis=1)
    centres = centres[fits] if fits.any() else centres
    gaps = np.full(len(centres), np.inf)
    for other in taken:
        # Distance from the box of the name, not from its centre.
        apart = np.abs(centres[:, None] - other) - half * 0.9
        gaps = np.minimum(gaps, np.hypot(*np.maximum(apart, 0).T).T.min(axis=1))
    best: Floats = centres[np.argmax(np.minimum(gaps, 25))]
    return best
