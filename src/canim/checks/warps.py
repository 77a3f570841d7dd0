"""What the checks of warping share: numbered images, the forward warp, holes in words.

The images are numbered: red and green of a pixel are its column and row. So a pixel that
arrived tells where it came from.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.spatial import Delaunay

from canim.checks.run import number
from canim.checks.task import Floats

# What pixels look like at which none arrives; numbered images do not have this colour.
HOLE = np.array([255.0, 0.0, 255.0])
STEP = 8  # between the colours of neighbours, so that no colour is mistaken for another
EDGE = 1e-9  # weights this near to 0 are on an edge


def numbered(width: int, height: int) -> Any:
    """Return an image whose pixel (u, v) has the colour (8 u, 8 v, 7)."""
    v, u = np.mgrid[:height, :width]
    image: Any = np.stack([STEP * u, STEP * v, 0 * u + 7], axis=2).astype(np.uint8)
    return image


def columns(corners: Floats) -> Floats:
    """Return the corners as columns x, y, 1."""
    return np.vstack([corners.T, np.ones(3)])


def affine_map(source: Floats, target: Floats) -> Floats:
    """Return the matrix that takes the source corners to the target corners."""
    return columns(target) @ np.linalg.inv(columns(source))


def inside(
    corners: Floats, x: Any, y: Any, least: float = -EDGE, enough: Callable[..., Any] = np.all
) -> Any:
    """Tell for each pixel whether no weight is below `least`."""
    weights = np.linalg.inv(columns(corners)) @ [x.ravel(), y.ravel(), np.ones(x.size)]
    return enough(weights >= least, axis=0).reshape(x.shape)


def not_all(large: Any, axis: int) -> Any:
    """Tell for each pixel whether a weight is too small."""
    return ~large.all(axis=axis)


def up(numbers: Any) -> Any:
    """Return the nearest whole numbers, halves rounded up."""
    return np.floor(numbers + 0.5).astype(int)


def cut(numbers: Floats) -> Any:
    """Return the numbers without their decimals."""
    return numbers.astype(int)


def sent(
    image: Floats,
    source: Floats,
    target: Floats,
    triangles: Any,
    *,
    round_to: Callable[[Floats], Any] = up,
    find_in: str = "source",
    least: float = -EDGE,
    enough: Callable[..., Any] = np.all,
    make_map: Callable[[Floats, Floats], Floats] = affine_map,
    weigh: str = "uv",
    move: str = "uv",
    read: str = "vu",
    write: str = "yx",
    bounds: str = "xy",
    first: int = 0,
    rows: int = 0,
    cols: int = 0,
    swap_sizes: bool = False,
    wrap: bool = False,
) -> Floats:
    """Return the image warped forward, right or in one of the ways in which it goes wrong."""
    height, width = image.shape[:2]
    last = (width, height) if swap_sizes else (height, width)
    v, u = np.mgrid[first : min(last[0], height) - rows, first : min(last[1], width) - cols]
    warped = np.full(image.shape, HOLE)
    for corners in triangles:
        corners_found = (source if find_in == "source" else target)[corners]
        found = inside(corners_found, *((u, v) if weigh == "uv" else (v, u)), least, enough)
        a, b = u[found], v[found]
        point = [a, b, 0 * a + 1] if move == "uv" else [b, a, 0 * a + 1]
        x, y = round_to((make_map(source[corners], target[corners]) @ point)[:2])
        stays = (x < width) & (y < height) & ((x >= 0) & (y >= 0) | wrap)
        if bounds == "yx":
            stays &= (x < height) & (y < width)
        a, b, x, y = a[stays], b[stays], x[stays], y[stays]
        if write == "vu":
            warped[b, a] = image[y, x]
            continue
        colours = image[a, b] if read == "uv" else image[b, a]
        warped[(x, y) if write == "xy" else (y, x)] = colours
    return warped


def is_filled(image: Floats) -> Floats:
    """Return 1 for each pixel that is not a hole, 0 for the others."""
    filled: Floats = (image != HOLE).any(axis=2).astype(float)
    return filled


def nothing(got: Floats) -> bool:
    """Tell whether a colour or an image is all hole, or a mask of what is filled all empty."""
    return bool((got == (0 if got.ndim == 2 else HOLE)).all())


def _in_words(colour: Floats) -> str:
    if (colour == HOLE).all():
        return "a hole"
    u, v = colour[:2] / STEP
    if colour[2] != 7 or u % 1 or v % 1:
        return f"the colour ({', '.join(map(number, colour))})"
    return f"the colour of pixel ({u:g}, {v:g})"


def describe(
    got: Floats, expected: Floats, *args: Any, in_words: Callable[[Floats], str] = _in_words
) -> str:
    """Say for one pixel what is expected there and what came, and how many are wrong."""
    height, width = expected.shape[:2]
    wrong = got != expected if got.ndim == 2 else (got != expected).any(axis=2)
    y, x = (int(k) for k in np.argwhere(wrong)[0])
    if got.ndim == 3:
        words = f"expected {in_words(expected[y, x])}, got {in_words(got[y, x])}"
    elif expected[y, x]:
        words = "expected a colour, got a hole"
    else:
        words = "expected a hole, got a colour"
    others = int(wrong.sum()) - 1
    more = f" (and at {others} more)" if others else ""
    return f"{width} × {height} image, at ({x}, {y}): {words}{more}"


def toy(width: int, height: int) -> tuple[Floats, Floats, Any]:
    """Return key points like those of the toy pair, with the frame, and their triangles.

    The triangulation of the source points alone would turn a triangle over.
    """
    size = np.array([width - 1, height - 1]) / 255
    a = np.array([[78.3, 73.1], [78.7, 186.2], [147.4, 186.9]]) * size
    b = np.array([[120.2, 25.3], [157.1, 139.6], [218.8, 47.2]]) * size
    frame = np.array(
        [[0, 0], [width - 1, 0], [0, height - 1], [width - 1, height - 1]], dtype=float
    )
    # The frame moves out a little: no place is a whole number, which rounding might miss.
    moved = frame + np.array([[-0.23, -0.31], [0.27, -0.29], [-0.21, 0.33], [0.29, 0.24]])
    a, b = np.vstack([a, frame]), np.vstack([b, moved])
    return a, b, Delaunay((a + b) / 2).simplices


def shifted() -> tuple[Floats, Floats, Any]:
    """Return two triangles that hardly move: each pixel arrives where it was."""
    a = np.array([[2.0, 2.0], [17.0, 2.0], [17.0, 12.0], [2.0, 17.0]])
    return a, a + 0.25, np.array([[0, 1, 2], [0, 2, 3]])


SQUARE, WIDE = numbered(20, 20), numbered(24, 15)
