"""Draw chains of links, flat or in space."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

# What a goal, links and joints, the root and the end effector look like.
_GOAL = {"color": "C1", "marker": "x", "markersize": 15, "markeredgewidth": 4}
_LINKS = {"color": "C0", "marker": "o", "markersize": 9, "linewidth": 5}
_ROOT = {"color": "red", "marker": "o", "markersize": 13}
_END = {"color": "C3", "marker": "s", "markersize": 11}


def draw_chain(ax: Axes, positions: ArrayLike, *, ink: float = 1) -> None:
    """Draw a chain: links and joints, a red dot at its root, a square at its end effector.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Where to draw, with ``projection="3d"`` for a chain in space; set its limits before.
    positions : array_like, shape (N + 1, 2) or (N + 1, 3)
        The root, the joints and the end effector. Points that are nan are left out.
    ink : float
        From 0, not seen, to 1, full colours.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from canim.plotting import draw_chain
    >>> fig, ax = plt.subplots()
    >>> draw_chain(ax, [(0, 0), (0, 1), (1, 1)])
    >>> len(ax.lines)
    3
    """
    xyz = np.asarray(positions, dtype=float)
    for points, look in [(xyz, _LINKS), (xyz[:1], _ROOT), (xyz[-1:], _END)]:
        _plot(ax, points, look | {"color": _mixed(ax, str(look["color"]), ink)})


def _plot(ax: Any, points: Floats, look: dict[str, Any]) -> Any:
    (line,) = ax.plot(*points.T, **look)
    return line


def _mixed(ax: Axes, color: str, ink: float) -> tuple[float, ...]:
    """Return the colour, mixed with the ground: links that are see-through would show joints."""
    ground = np.array(to_rgb(ax.get_facecolor()))
    return tuple((1 - ink) * ground + ink * np.array(to_rgb(color)))
