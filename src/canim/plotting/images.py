"""Draw key points and triangles on images, click key points, show how far a loop has come."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, TypeVar

import matplotlib.patheffects as effects
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backend_bases import KeyEvent, MouseEvent
from matplotlib.collections import LineCollection
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Pair = tuple[NDArray[Any], NDArray[Any]]  # of the left and the right image
Item = TypeVar("Item")

_LATE = 0.3  # seconds; what is done sooner needs no bar
_BAR = 30  # characters
_LONGEST = 640  # pixels; programs with a loop over all pixels take minutes for larger images


def draw_points(ax: Axes, points: ArrayLike, *, numbers: bool = False) -> None:
    """Draw key points on an image, as red dots.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        The axes with the image.
    points : array_like, shape (n, 2)
        Key points (x, y) in pixels. Points that are nan are left out.
    numbers : bool
        Whether to write beside each point its number, from 0.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from canim.plotting import draw_points
    >>> fig, ax = plt.subplots()
    >>> draw_points(ax, [(10, 20), (30, 5)], numbers=True)
    >>> [text.get_text() for text in ax.texts]
    ['0', '1']
    """
    xy = np.reshape(np.asarray(points, dtype=float), (-1, 2))
    ax.plot(xy[:, 0], xy[:, 1], "o", color="red", markersize=5, clip_on=False)
    for number, point in enumerate(xy):
        if numbers and np.isfinite(point).all():
            ax.annotate(
                str(number),
                (point[0], point[1]),
                xytext=(6, 6),
                textcoords="offset points",
                bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none"},
            )


def draw_triangulation(ax: Axes, image: ArrayLike, points: ArrayLike, triangles: ArrayLike) -> None:
    """Draw an image with the triangles over it, and their corners as red dots.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Where to draw. Its frame and grid are taken away.
    image : array_like, shape (h, w), (h, w, 3) or (h, w, 4)
        The image; a grey one is drawn in grey.
    points : array_like, shape (n, 2)
        Key points (x, y) in pixels. Triangles at points that are nan are left out.
    triangles : array_like of int, shape (F, 3)
        The numbers of each triangle's corners.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import numpy as np
    >>> from canim.plotting import draw_triangulation
    >>> fig, ax = plt.subplots()
    >>> draw_triangulation(ax, np.zeros((9, 9)), [(0, 0), (8, 0), (0, 8)], [(0, 1, 2)])
    >>> len(ax.images), len(ax.lines)
    (1, 1)
    """
    ax.set_axis_off()
    ax.imshow(np.asarray(image), cmap="gray", interpolation="nearest")
    ax.add_collection(mesh(points, triangles))
    draw_points(ax, points)


def progress(items: Sequence[Item]) -> Iterator[Item]:
    """Go through a list, and show in a terminal how far it has come.

    Elsewhere, in a notebook or a check, nothing is written; neither where all is done soon.

    Parameters
    ----------
    items : sequence
        What to go through.

    Yields
    ------
    object
        Each of the items.

    Examples
    --------
    >>> from canim.plotting import progress
    >>> for item in progress(["first", "second"]):
    ...     print(item)
    first
    second
    """
    terminal = sys.stdout is not None and sys.stdout.isatty()
    start, shown = time.monotonic(), False
    for number, item in enumerate(items):
        if terminal and time.monotonic() - start > _LATE:
            _show_progress(number, len(items))
            shown = True
        yield item
    if shown:
        _show_progress(len(items), len(items))
        print()


def _show_progress(done: int, count: int) -> None:
    full = _BAR * done // count
    # The return at the start writes the bar over the one before.
    print(f"\r[{'#' * full}{'.' * (_BAR - full)}] {done} of {count}", end="", flush=True)


def pick_points(
    image_a: ArrayLike,
    image_b: ArrayLike,
    points_a: ArrayLike,
    points_b: ArrayLike,
    *,
    click: bool = False,
) -> Pair:
    """Let a person click matching points on two images, or take those of the last time.

    Click a point on the left image, then the same point on the right one, and so on. The
    Backspace key takes the last click back, Enter ends. The points are saved in a file beside
    the program; as long as it is there, they are used in place of the given ones. Delete it to
    have these back.

    Parameters
    ----------
    image_a, image_b : array_like, shape (h, w), (h, w, 3) or (h, w, 4)
        The two images.
    points_a, points_b : array_like, shape (n, 2)
        The points (x, y) to use where none were clicked.
    click : bool
        Whether to click now. Where there is no window to click in, that is said, and the
        points are those of the last time or the given ones.

    Returns
    -------
    points_a, points_b : ndarray, shape (n, 2)
        Row i of one matches row i of the other.

    Raises
    ------
    ValueError
        If the images differ in width or height.

    Examples
    --------
    >>> import numpy as np
    >>> from canim.plotting import pick_points
    >>> image = np.zeros((9, 9))
    >>> pick_points(image, image, [(3, 4)], [(5, 4)])
    (array([[3., 4.]]), array([[5., 4.]]))
    """
    images = np.asarray(image_a), np.asarray(image_b)
    _check_sizes(images)
    path = _points_file()
    clicked = _click(images) if click else None
    if clicked:
        _save_points(path, images, clicked)
        print(f"{len(clicked[0])} key points are saved in {path.name}.")
        return clicked
    saved = _saved_points(path, images)
    if saved is None:
        return np.asarray(points_a, dtype=float), np.asarray(points_b, dtype=float)
    print(f"The key points are those in {path.name}. Delete this file to have the first ones back.")
    return saved


def _check_sizes(images: Pair) -> None:
    """Refuse images that cannot be warped into each other; tell if they are very large."""
    (height, width), other = (image.shape[:2] for image in images)
    scale = min(1.0, _LONGEST / max(height, width))
    small = f'canim.data.read_image("...", size=({round(scale * width)}, {round(scale * height)}))'
    if other != (height, width):
        raise ValueError(
            f"image_a is {width} × {height} pixels and image_b {other[1]} × {other[0]}; they must "
            f"have one size. Read both with {small}."
        )
    if height * width > _LONGEST**2:
        print(
            f"The images have {width} × {height} pixels, so this program takes minutes or hours. "
            f"It is quick if you read both with {small}."
        )


class _Clicks:
    """The points clicked so far, drawn as they come; the images take turns."""

    def __init__(self, figure: Any, images: Pair) -> None:
        self.points: list[tuple[float, float]] = []
        self._canvas = figure.canvas
        self._axes = figure.subplots(1, 2)
        self._images = images
        for name in ("button_press", "key_press", "close"):
            self._canvas.mpl_connect(f"{name}_event", getattr(self, f"_{name}"))
        self._draw()

    def pair(self) -> Pair | None:
        """Return the points of both images; the last one without its match is left out."""
        count = len(self.points) // 2
        if count == 0:
            return None
        a, b = np.array(self.points[: 2 * count]).reshape(-1, 2, 2).transpose(1, 0, 2)
        return a, b

    def _button_press(self, event: MouseEvent) -> None:
        turn = len(self.points) % 2
        # While a tool of the window (zoom, pan) is on, clicks belong to it.
        busy = getattr(self._canvas.toolbar, "mode", "")
        if event.inaxes is self._axes[turn] and event.button == 1 and not busy:
            height, width = self._images[turn].shape[:2]
            x, y = float(event.xdata or 0), float(event.ydata or 0)
            self.points.append((min(max(x, 0), width - 1), min(max(y, 0), height - 1)))
            self._draw()

    def _key_press(self, event: KeyEvent) -> None:
        if event.key == "backspace" and self.points:
            self.points.pop()
            self._draw()
        elif event.key == "enter":
            self._canvas.stop_event_loop()

    def _close(self, event: object) -> None:
        self._canvas.stop_event_loop()

    def _draw(self) -> None:
        turn = len(self.points) % 2
        for side, (ax, image) in enumerate(zip(self._axes, self._images)):
            ax.clear()
            ax.set_axis_off()
            ax.imshow(image, cmap="gray")
            draw_points(ax, self.points[side::2], numbers=True)
        self._axes[turn].set_title(f"Click point {len(self.points) // 2} here")
        self._axes[1 - turn].set_title("Backspace: take back. Enter: ready.")
        self._canvas.draw_idle()


def _click(images: Pair) -> Pair | None:
    """Open a window and return what is clicked; None where there is none or nothing."""
    figure: Any = plt.figure(
        "Click the same points on both images", figsize=(11, 5.5), layout="none"
    )
    try:
        if figure.canvas.required_interactive_framework is None:
            print("There is no window to click in, so the saved points are used.")
            return None
        clicks = _Clicks(figure, images)
        figure.show()
        figure.canvas.start_event_loop(0)
    finally:
        plt.close(figure)
    pair = clicks.pair()
    if pair is None:
        print("No pair of points was clicked, so the saved points are used.")
    return pair


def _points_file() -> Path:
    """Return the file for clicked points: beside the program, or in a notebook's folder."""
    program = getattr(sys.modules["__main__"], "__file__", None)
    if program is None:
        return Path("key_points.json")
    return Path(program).with_name(f"{Path(program).stem}_points.json")


def _save_points(path: Path, images: Pair, points: Pair) -> None:
    sizes = [image.shape[:2] for image in images]
    content = {"sizes": sizes, "points_a": points[0].tolist(), "points_b": points[1].tolist()}
    path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def _saved_points(path: Path, images: Pair) -> Pair | None:
    """Return the points in the file; None if it is missing, damaged or for other images."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        a, b = (np.array(content[name], dtype=float) for name in ("points_a", "points_b"))
        sizes = [tuple(size) for size in content["sizes"]]
    except FileNotFoundError:
        return None
    except (OSError, ValueError, TypeError, KeyError):
        print(f"{path.name} cannot be read and is not used.")
        return None
    if sizes != [image.shape[:2] for image in images]:
        print(f"{path.name} is for images of another size and is not used.")
        return None
    return a, b


def mesh(points: ArrayLike, triangles: ArrayLike) -> LineCollection:
    """Return triangles as lines that are seen on dark and on bright images."""
    lines = LineCollection(edges(points, triangles), colors="white", linewidths=1)
    lines.set_path_effects([effects.withStroke(linewidth=2.4, foreground="#333333")])
    return lines


def edges(points: ArrayLike, triangles: ArrayLike) -> list[Floats]:
    """Return each triangle as a closed line; those with a corner that is nan are left out."""
    xy = np.asarray(points, dtype=float)
    corners = np.asarray(triangles, dtype=int)
    lines = xy[corners[:, [0, 1, 2, 0]]]
    return [line for line in lines if np.isfinite(line).all()]
