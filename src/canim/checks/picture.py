"""Draw what is expected and, beside it, what a student's program gave."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

# In inches and dots per inch: half as wide as a figure of a page, sharp on a phone.
SIZE, DPI = (4.8, 2.7), 150
# Told apart without colour too: a broad pale line, and a thin dashed one with points.
EXPECTED = {"label": "expected", "linewidth": 6, "marker": "o", "markersize": 9, "alpha": 0.4}
YOURS = {"label": "yours", "linewidth": 2, "linestyle": "--", "marker": "o", "markersize": 4}


@dataclass(frozen=True)
class Picture:
    """A way to draw a part: `paint(figure, got, expected, *args)`, and what is then seen."""

    paint: Callable[..., None]
    words: str


@dataclass(frozen=True)
class Drawing:
    """What is to be drawn of a part: what came and what is expected for these arguments."""

    part: str
    picture: Picture
    got: Floats
    expected: Floats
    args: tuple[Any, ...]

    @property
    def text(self) -> str:
        """The picture in words, for those who cannot see it."""
        return f"{self.part}: {self.picture.words}"


def values_over(name: str, argument: int = 0) -> Picture:
    """Return a picture of numbers over that argument; of several rows the one most wrong."""

    def paint(figure: Any, got: Floats, expected: Floats, *args: Any) -> None:
        if got.ndim > 1:
            off = np.nan_to_num(np.abs(got - expected), nan=np.inf).max(axis=1)
            got, expected = got[np.argmax(off)], expected[np.argmax(off)]
        x = args[argument]
        _both(figure, (x, expected), (x, got)).set(xlabel=name)

    return Picture(paint, "the expected curve is broad and pale, yours thin and dashed.")


def _points(figure: Any, got: Floats, expected: Floats, *args: Any) -> None:
    _both(figure, expected.T, got.T, aspect="equal", adjustable="datalim")


def _graph(figure: Any, got: Floats, expected: Floats, *args: Any) -> None:
    _both(figure, expected.T, got.T)


def _both(figure: Any, expected: Any, got: Any, **axes: Any) -> Any:
    from canim.plotting import label_curves

    ax = figure.subplots()
    ax.set(**axes)
    ax.plot(*expected, **EXPECTED)
    ax.plot(*got, **YOURS)
    ax.margins(0.12)
    label_curves(ax)
    return ax


def _images(figure: Any, got: Floats, expected: Floats, *args: Any) -> None:
    whole = 255 if got.ndim == 3 else 1
    differ = (~np.isclose(got, expected)).reshape(*got.shape[:2], -1).any(axis=2)
    images = {"expected": expected / whole, "yours": got / whole, "differ here": differ}
    for ax, (title, image) in zip(figure.subplots(1, 3), images.items()):
        ax.imshow(np.clip(np.nan_to_num(image), 0, 1), cmap="gray", vmin=0, vmax=1)
        ax.set_title(title)
        ax.set_axis_off()


CHAIN = Picture(_points, "the expected joints are joined by a broad pale line, yours by dashes.")
PATH = Picture(_points, "the expected points are joined by a broad pale line, yours by dashes.")
GRAPH = Picture(_graph, "the expected curve is broad and pale, yours thin and dashed.")
IMAGES = Picture(_images, "the expected image, yours, and in white where the two differ.")


def png(drawings: Sequence[Drawing], *, titles: bool = False) -> bytes:
    """Return the drawings, one below the other, as a small PNG file."""
    from matplotlib import style
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    width, height = SIZE
    drawn, small = io.BytesIO(), io.BytesIO()
    # A figure of its own, so that the student's figures and their style stay as they are.
    with style.context("canim.style"):
        figure = Figure(figsize=(width, (height + 0.3 * titles) * len(drawings)))
        FigureCanvasAgg(figure)
        for part, drawing in zip(figure.subfigures(len(drawings), squeeze=False)[:, 0], drawings):
            if titles:
                part.suptitle(drawing.part, x=0.02, ha="left")
            drawing.picture.paint(part, drawing.got, drawing.expected, *drawing.args)
        figure.savefig(drawn, format="png", dpi=DPI)
    plain = Image.open(drawn).convert("RGB").quantize(48, dither=Image.Dither.NONE)
    plain.save(small, format="png", optimize=True)
    return small.getvalue()
