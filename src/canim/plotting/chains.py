"""Draw chains of links, flat or in space, and films in which they reach for goals."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backend_bases import MouseEvent
from matplotlib.colors import to_rgb
from numpy.typing import ArrayLike, NDArray

from canim.plotting.films import MILLISECONDS, same_lengths

Floats = NDArray[np.float64]
Reach = Callable[[Any, Any, Any], Any]  # angles, offsets, goal -> angles, one pose a row
Forward = Callable[[Any, Any], Any]  # angles, offsets -> positions

_HOLD = 8  # frames for which a chain rests at its goal

# What a goal, links and joints, the root and the end effector look like.
_GOAL = {"color": "C1", "marker": "x", "markersize": 15, "markeredgewidth": 4}
_LINKS = {"color": "C0", "marker": "o", "markersize": 9, "linewidth": 5}
_ROOT = {"color": "red", "marker": "o", "markersize": 13}
_END = {"color": "C3", "marker": "s", "markersize": 11}
_SHADOW = {"color": "#cfcfc8", "linewidth": 4}
_SHADOW_OF_GOAL = {"color": "#cfcfc8", "marker": "x", "markersize": 9, "markeredgewidth": 3}


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
    if xyz.shape[1] == 3:
        _plot(ax, _on_the_floor(ax, xyz), _SHADOW)
    for points, look in [(xyz, _LINKS), (xyz[:1], _ROOT), (xyz[-1:], _END)]:
        _plot(ax, points, look | {"color": _mixed(ax, str(look["color"]), ink)})


def slow_poses(poses: ArrayLike, largest: float = 0.1) -> Floats:
    """Put poses in between, so that a film of them is slow enough to follow.

    Parameters
    ----------
    poses : array_like, shape (n, N) or (n, N, 3)
        The angles of a chain, one pose after the other.
    largest : float
        The most by which an angle may change from one pose to the next, in radians.

    Returns
    -------
    ndarray, shape (m, N) or (m, N, 3)
        All poses that were given, with others between them.

    Raises
    ------
    ValueError
        If `largest` is not more than 0.

    Examples
    --------
    >>> from canim.plotting import slow_poses
    >>> slow_poses([(0, 0), (0.2, 0.1)])
    array([[0.  , 0.  ],
           [0.1 , 0.05],
           [0.2 , 0.1 ]])
    """
    if not largest > 0:
        raise ValueError(f"largest must be more than 0, but is {largest}.")
    angles = np.asarray(poses, dtype=float)
    slow = [angles[:1]]
    for before, after in pairwise(angles):
        count = max(1, int(np.ceil(np.abs(after - before).max() / largest - 1e-9)))
        slow.append(np.linspace(before, after, count + 1)[1:])
    return np.concatenate(slow)


def animate_chain(
    ax: Axes,
    reach: Reach,
    forward: Forward,
    angles: ArrayLike,
    offsets: ArrayLike,
    goals: ArrayLike,
    *,
    click: bool = False,
) -> FuncAnimation:
    """Make a film of a chain that reaches for goals, one after the other.

    With `click`, in a window, the goal is where the mouse is, and the chain follows it.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Where to draw, with ``projection="3d"`` for a chain in space; set its limits before.
    reach : callable
        Gets angles, offsets and a goal; returns angles, one pose a row, up to the goal.
    forward : callable
        Gets angles and offsets; returns the root, the joints and the end effector.
    angles : array_like, shape (N,) or (N, 3)
        The first pose.
    offsets : array_like, shape (N, 2) or (N, 3)
        The links of the chain.
    goals : array_like, shape (n, 2) or (n, 3)
        Where to reach, in this order.
    click : bool
        Whether to follow the mouse; for flat chains. Where there is no window, that is said,
        and the film of `goals` is made.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it in a variable for as long as the figure is shown.

    Raises
    ------
    ValueError
        If there is no goal.

    Examples
    --------
    A chain that moves in one step to where its angles are the coordinates of the goal:

    >>> import matplotlib.pyplot as plt
    >>> from canim.character import forward_kinematics_2d
    >>> from canim.plotting import animate_chain
    >>> fig, ax = plt.subplots()
    >>> film = animate_chain(
    ...     ax,
    ...     lambda angles, offsets, goal: [angles, goal],
    ...     forward_kinematics_2d,
    ...     (0, 0),
    ...     [(0, 1), (0, 1)],
    ...     [(0.5, 0.2), (1.0, 0.1)],
    ... )
    >>> plt.close(fig)
    """
    xy = np.asarray(goals, dtype=float)
    same_lengths("goals", {"goals": xy}, "points")
    canvas: Any = ax.figure.canvas
    window = canvas.required_interactive_framework is not None
    if click and window:
        return _follow_mouse(ax, _Mouse(ax, reach, forward, angles, offsets, xy[0]))
    if click:
        print("There is no window for the mouse, so the chain reaches for the given goals.")
    histories, pose = [], np.asarray(angles, dtype=float)
    for goal in xy:
        poses = reach(pose.copy(), offsets, goal.copy())
        finite = [new for new in poses if np.isfinite(new).all()] or [pose]
        histories.append(_without_rest([forward(pose, offsets) for pose in finite]))
        pose = np.array(finite[-1], dtype=float)
    return animate_chains([ax], [histories], xy)


def animate_chains(
    axes: Sequence[Axes], histories: Sequence[Sequence[ArrayLike]], goals: ArrayLike
) -> FuncAnimation:
    """Make a film of several chains that reach for the same goals; the first waits for the last.

    Parameters
    ----------
    axes : sequence of matplotlib.axes.Axes
        Where to draw, one for each chain; all in one figure.
    histories : sequence of sequences of array_like, shape (frames, N + 1, 2 or 3)
        For each chain, and for each goal: the positions, frame by frame.
    goals : array_like, shape (n, 2) or (n, 3)
        Where the chains reach to.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it in a variable for as long as the figure is shown.

    Raises
    ------
    ValueError
        If there is no chain or no goal, or not a history for each chain and each goal.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from canim.plotting import animate_chains
    >>> fig, (left, right) = plt.subplots(1, 2)
    >>> quick = [[[(0, 0), (0, 1)], [(0, 0), (1, 0)]]]
    >>> slow = [[[(0, 0), (0, 1)], [(0, 0), (0.6, 0.8)], [(0, 0), (1, 0)]]]
    >>> film = animate_chains([left, right], [quick, slow], [(1, 0)])
    >>> plt.close(fig)
    """
    xyz = np.asarray(goals, dtype=float)
    same_lengths("axes, histories", {"axes": axes, "histories": histories}, "chains")
    for k, history in enumerate(histories):
        same_lengths("goals, histories", {"goals": xyz, f"histories[{k}]": history}, "goals")
    films: list[list[Floats]] = [[np.asarray(f, dtype=float) for f in h] for h in histories]
    shown = [_Shown(ax, film[0][0], xyz[0]) for ax, film in zip(axes, films)]
    frames = [
        (goal, frame)
        for goal in range(len(xyz))
        for frame in range(max(len(film[goal]) for film in films) + _HOLD)
    ]

    def draw(moment: tuple[int, int]) -> list[Artist]:
        goal, frame = moment
        for chain, film in zip(shown, films):
            chain.show(film[goal][min(frame, len(film[goal]) - 1)], xyz[goal])
        return []

    figure: Any = axes[0].figure.figure
    # Without a window only one picture is seen: the moment when the first goal is reached.
    still = sum(goal == 0 for goal, _ in frames) - 1
    seen = frames if figure.canvas.required_interactive_framework else frames[still:]
    animation = FuncAnimation(
        figure, draw, frames=frames, init_func=lambda: draw(seen[0]), interval=MILLISECONDS
    )
    # A film that is never drawn, for there is no window, warns when the program ends.
    figure.canvas.draw()
    return animation


class _Shown:
    """A chain and its goal on the axes, which move."""

    def __init__(self, ax: Axes, xyz: Floats, goal: Floats) -> None:
        self._ax = ax
        # What comes later hides what came before.
        looks = (
            [_GOAL, _LINKS, _ROOT, _END]
            if len(goal) == 2
            else [_SHADOW, _SHADOW_OF_GOAL, _GOAL, _LINKS, _ROOT, _END]
        )
        self._lines = [_plot(ax, xyz, look) for look in looks]
        self.show(xyz, goal)

    def show(self, xyz: Floats, goal: Floats) -> None:
        parts = [goal[None], xyz, xyz[:1], xyz[-1:]]
        if len(goal) == 3:
            parts[:0] = _on_the_floor(self._ax, xyz), _on_the_floor(self._ax, goal[None])
        for line, points in zip(self._lines, parts, strict=True):
            (line.set_data if len(goal) == 2 else line.set_data_3d)(*points.T)


class _Mouse:
    """A chain that goes one pose on for each picture, to where the mouse was last."""

    def __init__(
        self,
        ax: Axes,
        reach: Reach,
        forward: Forward,
        angles: ArrayLike,
        offsets: ArrayLike,
        goal: Floats,
    ) -> None:
        self._ax, self._reach, self._forward, self._offsets = ax, reach, forward, offsets
        self._pose = np.asarray(angles, dtype=float)
        self.goal = goal
        self._poses: Iterator[Any] | None = None
        for name in ("button_press_event", "motion_notify_event"):
            ax.figure.canvas.mpl_connect(name, self._moved)

    def _moved(self, event: MouseEvent) -> None:
        if event.inaxes is self._ax and event.xdata is not None and event.ydata is not None:
            self.goal = np.array([event.xdata, event.ydata])
            self._poses = None

    def positions(self) -> Floats:
        """Return where the chain is."""
        return np.asarray(self._forward(self._pose, self._offsets), dtype=float)

    def move(self) -> None:
        """Go on to the next pose, if the goal is not reached yet."""
        if self._poses is None:
            poses = self._reach(self._pose.copy(), self._offsets, self.goal.copy())
            self._poses = iter(poses[1:])
        self._pose = np.asarray(next(self._poses, self._pose), dtype=float)


def _follow_mouse(ax: Axes, mouse: _Mouse) -> FuncAnimation:
    shown = _Shown(ax, mouse.positions(), mouse.goal)
    ax.set_title("Move the mouse")

    def draw(_: int) -> list[Artist]:
        mouse.move()
        shown.show(mouse.positions(), mouse.goal)
        return []

    figure: Any = ax.figure.figure
    return FuncAnimation(figure, draw, interval=MILLISECONDS, cache_frame_data=False)


def _without_rest(positions: list[Any]) -> list[Any]:
    """Return the positions up to the last one that is another than the one before it."""
    moves = [k for k in range(1, len(positions)) if not np.array_equal(*positions[k - 1 : k + 1])]
    return positions[: moves[-1] + 1 if moves else 1]


def _plot(ax: Any, points: Floats, look: dict[str, Any]) -> Any:
    (line,) = ax.plot(*points.T, **look)
    return line


def _on_the_floor(ax: Any, xyz: Floats) -> Floats:
    """Return the shadow: without it, nobody sees how near a chain or a goal in space is."""
    shadow = xyz.copy()
    shadow[:, 2] = ax.get_zlim()[0]
    return shadow


def _mixed(ax: Axes, color: str, ink: float) -> tuple[float, ...]:
    """Return the colour, mixed with the ground: links that are see-through would show joints."""
    ground = np.array(to_rgb(ax.get_facecolor()))
    return tuple((1 - ink) * ground + ink * np.array(to_rgb(color)))
