"""Films for pages: points on curves, the construction of a curve, images that turn into others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from canim.plotting.images import Floats, edges, mesh

MILLISECONDS = 40  # per frame: 25 frames in a second


def animate_construction(
    ax: Axes, frames: Sequence[Sequence[ArrayLike]], hold: int = 12
) -> FuncAnimation:
    """Make a film of a construction that ends, in every frame, in one point of a curve.

    Each level is drawn as a chain of points, in a colour of its own. The last level is the
    pen: it leaves the curve behind.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Where to draw; set its limits before.
    frames : sequence of sequences of array_like, shape (n, 2)
        For each frame the points of each level. The last level has one point.
    hold : int
        Number of frames for which the end is shown.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it in a variable for as long as the figure is shown.

    Raises
    ------
    ValueError
        If there is no frame, or frames differ in how many levels they have.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from canim.interpolation import de_casteljau
    >>> from canim.plotting import animate_construction
    >>> corners = [(0, 0), (1, 2), (2, 0)]
    >>> fig, ax = plt.subplots()
    >>> film = animate_construction(ax, [de_casteljau(corners, k / 50) for k in range(51)])
    >>> fig.canvas.draw()  # shows the first moment; plt.show() plays all
    >>> plt.close(fig)
    """
    levels = [[np.asarray(level, float) for level in frame] for frame in frames]
    same_lengths("frames", {f"frame {k}": frame for k, frame in enumerate(levels)}, "levels")
    pen = np.array([frame[-1][0] for frame in levels])
    (trace,) = ax.plot([], [], color="C0", linewidth=3.5)
    chains = [
        ax.plot([], [], "o-", color=color, linewidth=1.5, markersize=6)[0]
        for color in _level_colors(len(levels[0]) - 1)
    ]
    (dot,) = ax.plot([], [], "o", color="C0", markersize=11)

    def draw(frame: int) -> list[Artist]:
        for chain, points in zip(chains, levels[frame]):
            chain.set_data(points[:, 0], points[:, 1])
        trace.set_data(pen[: frame + 1, 0], pen[: frame + 1, 1])
        dot.set_data(pen[frame : frame + 1, 0], pen[frame : frame + 1, 1])
        return [trace, *chains, dot]

    return film(ax, draw, len(levels), hold)


def animate_points(ax: Axes, paths: Mapping[str, ArrayLike], hold: int = 12) -> FuncAnimation:
    """Make a film of points that move; their names stand above.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Where to draw; set its limits before.
    paths : mapping of str to array_like, shape (frames, 2)
        For each name where its point is, frame by frame.
    hold : int
        Number of frames for which the end is shown.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it in a variable for as long as the figure is shown.

    Raises
    ------
    ValueError
        If there is no path, a path is empty, or one is longer than another.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import numpy as np
    >>> from canim.plotting import animate_points
    >>> x = np.linspace(0, 1, 51)
    >>> fig, ax = plt.subplots()
    >>> film = animate_points(
    ...     ax, {"even": np.column_stack([x, x]), "late": np.column_stack([x, x**3])}
    ... )
    >>> fig.canvas.draw()  # shows the first moment; plt.show() plays all
    >>> plt.close(fig)
    """
    points = [np.asarray(path, float) for path in paths.values()]
    same_lengths("paths", dict(zip(paths, points)), "points")
    dots = [
        ax.plot(*path[:1].T, "o", color=f"C{k}", markersize=12)[0] for k, path in enumerate(points)
    ]
    # Beside the dots, names would hide dots, the curve and each other.
    ax.legend(
        dots,
        list(paths),
        loc="lower left",
        bbox_to_anchor=(0, 1),
        ncols=len(paths),
        labelcolor="linecolor",
        frameon=False,
    )

    def draw(frame: int) -> list[Artist]:
        for dot, path in zip(dots, points):
            dot.set_data(path[frame : frame + 1, 0], path[frame : frame + 1, 1])
        return [*dots]

    return film(ax, draw, len(points[0]), hold)


def animate_morph(
    ax: Axes,
    frames: Sequence[ArrayLike],
    poses: Sequence[ArrayLike] | None = None,
    triangles: ArrayLike | None = None,
    hold: int = 12,
) -> FuncAnimation:
    """Make a film of images; triangles may move over it.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Where to draw. Its frame and grid are taken away.
    frames : sequence of array_like
        Images of one shape.
    poses : sequence of array_like, shape (n, 2), optional
        For each frame its key points.
    triangles : array_like of int, shape (F, 3), optional
        The numbers of each triangle's corners; needed where there are poses.
    hold : int
        Number of frames for which the end is shown.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it in a variable for as long as the figure is shown.

    Raises
    ------
    TypeError
        If there are poses and no triangles.
    ValueError
        If there is no frame, or there are more or fewer poses than frames.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import numpy as np
    >>> from canim.plotting import animate_morph
    >>> fig, ax = plt.subplots()
    >>> film = animate_morph(ax, [np.full((9, 9), grey) for grey in range(0, 250, 25)])
    >>> fig.canvas.draw()  # shows the first moment; plt.show() plays all
    >>> plt.close(fig)
    """
    sequences: dict[str, Sequence[Any]] = {"frames": frames}
    if poses is not None:
        if triangles is None:
            raise TypeError("triangles must be given where poses are given.")
        sequences["poses"] = poses
    same_lengths("frames, poses", sequences, "entries")
    ax.set_axis_off()
    # Black and white are the same in all frames, also of grey images.
    image = ax.imshow(np.asarray(frames[0]), cmap="gray", vmin=0, vmax=255)
    artists: list[Artist] = [image]
    if poses is not None and triangles is not None:
        lines = mesh(poses[0], triangles)
        ax.add_collection(lines)
        artists.append(lines)

    def draw(frame: int) -> list[Artist]:
        image.set_data(np.asarray(frames[frame]))
        if poses is not None and triangles is not None:
            lines.set_segments(edges(poses[frame], triangles))
        return artists

    return film(ax, draw, len(frames), hold)


def same_lengths(name: str, sequences: Mapping[str, Sequence[Any] | Floats], what: str) -> None:
    """Refuse a film of nothing, and sequences of which one ends before another."""
    counts = {key: len(sequence) for key, sequence in sequences.items()}
    if not all(counts.values()) or not counts:
        raise ValueError(f"{name} must not be empty.")
    first, count = next(iter(counts.items()))
    for key, other in counts.items():
        if other != count:
            raise ValueError(
                f"{name} must all have as many {what}, but {first} has {count} and {key} {other}."
            )


def _level_colors(count: int) -> list[str]:
    """Return a colour for each level: grey for what is given, then one after the other."""
    return ["gray", *(f"C{k}" for k in range(1, count))]


def film(ax: Axes, draw: Any, count: int, hold: int) -> FuncAnimation:
    """Return a film of the figure of `ax`: `count` frames, the last one held."""
    frames = [*range(count), *[count - 1] * hold]
    figure: Any = ax.figure.figure  # the whole one, also where ax is in a subfigure
    return FuncAnimation(figure, draw, frames=frames, interval=MILLISECONDS)
