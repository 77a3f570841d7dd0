"""Draw faces that are meshes: pictures, films, and sliders for the weights of expressions.

What is drawn is smoother than the mesh: each triangle becomes four, and the new corners are put
on the curved surface that the normals suggest (as in PN triangles). A light at the side shows
form; hollows are darker, which makes lips, lids and wrinkles stand out.
"""

from __future__ import annotations

import importlib.util
import logging
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, Protocol

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import TriMesh
from matplotlib.tri import Triangulation
from matplotlib.widgets import Slider
from numpy.typing import ArrayLike, NDArray

from canim.plotting.films import film, same_lengths

Floats = NDArray[np.float64]

# For each light the direction to it (the camera is at z > 0) and how bright it is.
LIGHTS = (((0.5, 0.45, 0.74), 0.72), ((-0.7, 0.15, 0.7), 0.2))
AMBIENT, SHINE, SHARPNESS = 0.3, 0.1, 25
_SKIN = 0.85, 0.65, 0.55
_MARGIN = 1.08  # how much larger than the neutral face a picture is
_DARK = 1.5  # how much darker a hollow is

# A missing library of the system ends a process that renders: so another one tries.
_PROBE = """
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow
window = vtkRenderWindow()
window.SetOffScreenRendering(True)
window.AddRenderer(vtkRenderer())
window.Render()
"""


class Mesh(Protocol):
    """What is drawn of a `canim.character.Face`: its neutral vertices, triangles, colours."""

    neutral: Any
    faces: Any
    colors: Any


def draw_face(
    ax: Axes, face: Mesh, vertices: ArrayLike | None = None, *, room: float = 1, turn: float = 0.3
) -> None:
    """Draw a face, lit from the front and the side.

    Place and size of the picture follow from the neutral face alone. So a face that is larger
    or elsewhere is seen to be so.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Where to draw. Its frame and grid are taken away.
    face : canim.character.Face
        The face: its triangles, its colours, and its neutral vertices.
    vertices : array_like, shape (V, 3), optional
        Where the vertices are now. Without them the neutral face is drawn; where one is nan,
        it is said that the face is missing.
    room : float
        Size of the picture: how many times the neutral face fits into it. Below 1 the neck is
        cut off.
    turn : float
        Angle in radians by which the head is turned to its own left.

    Notes
    -----
    The picture is drawn by pyvista where it is installed and can render, and else by
    matplotlib.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from canim.data import face
    >>> from canim.plotting import draw_face
    >>> head = face()
    >>> fig, ax = plt.subplots()
    >>> draw_face(ax, head, head.expressions["smile_left"])
    """
    _Picture(ax, face, room, turn).show(face.neutral if vertices is None else vertices)


def animate_face(
    ax: Axes | Sequence[Axes],
    face: Mesh,
    poses: ArrayLike | Sequence[ArrayLike],
    *,
    room: float = 1,
    turn: float = 0.3,
    clock: Axes | None = None,
    times: Sequence[float] | None = None,
    hold: int = 12,
) -> FuncAnimation:
    """Make a film of a face.

    Parameters
    ----------
    ax : matplotlib.axes.Axes or sequence of matplotlib.axes.Axes
        Where to draw; more than one for films beside each other.
    face : canim.character.Face
        The face: its triangles, its colours, and its neutral vertices.
    poses : array_like, shape (frames, V, 3)
        For each frame its vertices; for more than one axes a sequence of these.
    room, turn : float
        As in `draw_face`.
    clock : matplotlib.axes.Axes, optional
        Axes with curves over time: an upright line moves over them.
    times : sequence of float, optional
        For each frame where that line is; needed where there is a clock.
    hold : int
        Number of frames for which the end is shown.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it in a variable for as long as the figure is shown.

    Raises
    ------
    TypeError
        If there is a clock and no times.
    ValueError
        If there is no frame, or axes, poses and times differ in number.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import numpy as np
    >>> from canim.character import Face
    >>> from canim.plotting import animate_face
    >>> corners = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    >>> face = Face(corners, {"nod": [(-1, -1, 0), (1, -1, 0), (0, 1, 1)]}, [(0, 1, 2)])
    >>> poses = [face.neutral + t * (face.shapes[0] - face.neutral) for t in np.linspace(0, 1, 11)]
    >>> fig, ax = plt.subplots()
    >>> film = animate_face(ax, face, poses)
    >>> fig.canvas.draw()  # shows the first moment; plt.show() plays all
    >>> plt.close(fig)
    """
    axes: Any = [ax] if isinstance(ax, Axes) else ax
    takes: Any = [poses] if isinstance(ax, Axes) else poses
    same_lengths("ax, poses", {"ax": axes, "poses": takes}, "entries")
    parts = {f"poses[{k}]": take for k, take in enumerate(takes)}
    if clock is not None:
        if times is None:
            raise TypeError("times must be given where a clock is given.")
        parts["times"] = times
    same_lengths("poses, times", parts, "entries")
    pictures = [_Picture(one, face, room, turn) for one in axes]
    line = None if clock is None else clock.axvline(np.nan, color="0.3", linewidth=2)

    def draw(frame: int) -> list[Artist]:
        for picture, take in zip(pictures, takes):
            picture.show(take[frame])
        if line is not None and times is not None:
            line.set_xdata([times[frame]] * 2)
        return []

    return film(axes[0], draw, len(takes[0]), hold)


def weight_sliders(
    face: Mesh,
    names: Sequence[str],
    blend: Callable[[Floats], ArrayLike],
    weights: ArrayLike = 0,
    *,
    room: float = 1.4,
) -> list[Slider]:
    """Open a window with a face and a slider for each weight; elsewhere do nothing.

    Parameters
    ----------
    face : canim.character.Face
        The face: its triangles, its colours, and its neutral vertices.
    names : sequence of str
        What stands beside each slider.
    blend : callable
        Returns the vertices for weights, shape (len(names),).
    weights : array_like, shape (len(names),), or float
        The weights at the start.
    room : float
        As in `draw_face`.

    Returns
    -------
    list of matplotlib.widgets.Slider
        Keep it in a variable for as long as the window is open. It is empty where there is no
        window, as in a notebook.

    Examples
    --------
    >>> from canim.character import Face, delta_blendshape
    >>> from canim.plotting import weight_sliders
    >>> corners = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    >>> face = Face(corners, {"nod": [(-1, -1, 0), (1, -1, 0), (0, 1, 1)]}, [(0, 1, 2)])
    >>> sliders = weight_sliders(
    ...     face,
    ...     list(face.expressions),
    ...     lambda weights: delta_blendshape(face.neutral, face.shapes, weights),
    ...     face.weights({"nod": 1}),
    ... )
    """
    figure: Any = plt.figure("Weights", figsize=(9, 6), layout="none")
    if figure.canvas.required_interactive_framework is None:
        plt.close(figure)
        return []
    picture = _Picture(figure.add_axes((0, 0, 0.55, 1)), face, room, 0.3)
    step = 0.94 / len(names)
    sliders = [
        Slider(
            figure.add_axes((0.74, 0.97 - (k + 1) * step, 0.18, step)),
            name.replace("_", " "),
            0,
            2,
            valinit=weight,
        )
        for k, (name, weight) in enumerate(
            zip(names, np.broadcast_to(np.asarray(weights, float), len(names)))
        )
    ]

    def show(_: float = 0) -> None:
        picture.show(blend(np.array([slider.val for slider in sliders])))
        figure.canvas.draw_idle()

    for slider in sliders:
        slider.label.set_x(-0.06)  # clear of the knob
        slider.on_changed(show)
    show()
    return sliders


class _Picture:
    """A picture of a face, which can change."""

    def __init__(self, ax: Axes, face: Mesh, room: float, turn: float) -> None:
        self._ax = ax
        self._surface = _Surface(face)
        self._artist: Artist | None = None
        cos, sin = np.cos(turn), np.sin(turn)
        self._turn = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
        x, y, z = room * _MARGIN * np.abs(self._surface.neutral).max(axis=0)
        x = np.hypot(x, z / 4)  # a head that is turned is wider
        lift = y * max(0, 1 / room - 1)  # cut the neck, not the crown
        ax.set(xlim=(-x, x), ylim=(lift - y, lift + y), aspect="equal")
        ax.set_axis_off()

    def show(self, vertices: ArrayLike) -> None:
        """Draw the face anew."""
        if self._artist is not None:
            self._artist.remove()
        points = np.asarray(vertices, dtype=float)
        if points.shape != self._surface.neutral.shape or not np.isfinite(points).all():
            self._artist = self._ax.text(0, 0, "the face is missing", ha="center")
            return
        triangles = (*self._surface.fine(points @ self._turn.T), self._surface.faces)
        if pyvista_renders():
            from canim.plotting.faces_3d import Rendered

            self._artist = self._ax.add_artist(Rendered(*triangles))
        else:
            self._artist = self._ax.add_artist(_painted(*triangles))


class _Surface:
    """The smooth surface of a mesh: each triangle is divided into four."""

    def __init__(self, face: Mesh) -> None:
        self.neutral = np.asarray(face.neutral, dtype=float)
        self._corners = np.asarray(face.faces).T
        count = len(self.neutral)
        a, b, c = self._corners
        sides = np.sort(np.concatenate([(a, b), (b, c), (c, a)], axis=1), axis=0)
        numbers, middles = np.unique(sides[0] * count + sides[1], return_inverse=True)
        self._ends = np.stack([numbers // count, numbers % count])
        ab, bc, ca = count + middles.reshape(3, -1)
        fours = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        self.faces = np.concatenate([np.stack(corners, axis=1) for corners in fours])
        self._neighbours = np.bincount(self._ends.ravel().astype(np.intp), minlength=count)
        colors = np.full((count, 3), _SKIN) if face.colors is None else np.asarray(face.colors)
        self._colors = self._with_middles(colors)

    def fine(self, points: Floats) -> tuple[Floats, Floats, Floats]:
        """Return points, normals and colours of the smooth surface through `points`."""
        a, b, c = points[self._corners]
        normals = _unit(_sums(self._corners, np.stack([np.cross(b - a, c - a)] * 3), points))
        start, end = self._ends
        way = points[end] - points[start]
        # How far the end is above the start, and the start above the end.
        over = (way * normals[start]).sum(axis=1), -(way * normals[end]).sum(axis=1)
        fine = self._with_middles(points)
        fine[len(points) :] -= (over[0] * normals[start].T + over[1] * normals[end].T).T / 8
        # A vertex below its neighbours is in a hollow.
        steep = (np.stack(over) / np.maximum(np.linalg.norm(way, axis=1), 1e-300))[..., None]
        depth = _sums(self._ends, steep, points) / np.maximum(self._neighbours, 1)[:, None]
        shade = 1 - np.clip(_DARK * (depth - 0.05), 0, 0.6)
        colors = self._colors * self._with_middles(shade)
        return fine, _unit(self._with_middles(normals)), colors

    def _with_middles(self, values: Floats) -> Floats:
        start, end = values[self._ends]
        return np.concatenate([values, (start + end) / 2])


def _sums(numbers: Any, values: Floats, points: Floats) -> Floats:
    """Return for each of the points the sum of the values that have its number."""
    columns = values.reshape(-1, values.shape[-1]).T
    places = numbers.ravel().astype(np.intp)  # in the browser's Python, with 32 bits, it must be
    sums = [np.bincount(places, column, len(points)) for column in columns]
    return np.stack(sums, axis=1)


def _unit(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: Floats = vectors / np.maximum(lengths, 1e-300)
    return unit


def _painted(points: Floats, normals: Floats, colors: Floats, faces: Any) -> Artist:
    """Return triangles in the light, the far ones first, so that the near ones hide them."""
    a, b, c = points[faces.T, :2]
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    seen = faces[ux * vy > uy * vx]
    seen = seen[np.argsort(points[seen, 2].sum(axis=1))]
    # matplotlib wants a triangle even where none is seen.
    triangles: Any = TriMesh(
        Triangulation(points[:, 0], points[:, 1], seen if len(seen) else faces[:1])
    )
    triangles.set(facecolor=_lit(normals, colors), visible=bool(len(seen)))
    shown: Artist = triangles
    return shown


def _lit(normals: Floats, colors: Floats) -> Floats:
    """Return the colours in the light: soft from all lights, with a shine from the first."""
    directions = _unit(np.array([direction for direction, _ in LIGHTS]))
    brightness = np.array([brightness for _, brightness in LIGHTS])
    light = AMBIENT + np.clip(normals @ directions.T, 0, 1) @ brightness
    mirror = _unit(directions[:1] + np.array([0, 0, 1])).T
    shine = SHINE * np.clip(normals @ mirror, 0, 1) ** SHARPNESS
    lit: Floats = np.clip(colors * light[:, None] + shine, 0, 1)
    return lit


@cache
def pyvista_renders() -> bool:
    """Tell whether pyvista is installed and can render; ask only once."""
    if importlib.util.find_spec("pyvista") is None:
        return False
    if sys.platform == "linux" and not os.environ.get("DISPLAY"):
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    renders = subprocess.run([sys.executable, "-c", _PROBE], capture_output=True).returncode == 0
    if not renders:
        logging.getLogger(__name__).warning(
            "pyvista cannot render here (is a library for OpenGL missing?): "
            "faces are drawn with matplotlib."
        )
    return renders
