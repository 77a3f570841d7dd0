"""Pairs of images with matching key points, for warping and morphing."""

from __future__ import annotations

import json
import os
import re
from importlib import resources
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps

from canim._arguments import Floats, whole_number

__all__ = ["ImagePair", "keypoints", "portraits", "read_image", "toy_triangles"]

Bytes = NDArray[np.uint8]

_PORTRAITS = resources.files("canim.data") / "portraits"

# The toy pair's corners, for a size of 256.
_TOY_SIZE = 256
_TOY = {
    "toy_a": [(78, 73), (78, 186), (147, 186)],
    "toy_b": [(120, 25), (157, 139), (218, 47)],
}
# How files begin that Pillow does not read, from which byte on, and what they are.
_NO_PICTURE_HERE = [
    (4, rb"ftyp(hei|hev|mif1|msf1)", "a HEIC photograph, as phones make them"),
    (4, rb"ftyp(avif|avis)", "an AVIF picture"),
    (4, rb"ftyp|moov", "a film"),
    (0, rb"\xff\x0a|\0\0\0\x0cJXL ", "a JPEG XL picture"),
    (0, rb"%PDF", "a PDF document"),
    (0, rb"\s*(<\?xml[^>]*>\s*)?(<!--.*?-->\s*|<!DOCTYPE[^>]*>\s*)*<svg", "an SVG drawing"),
]
_GROUND = (243, 243, 240)
_GREEN = (0, 158, 115)
_ORANGE = (230, 159, 0)


class ImagePair(NamedTuple):
    """Two images of one shape with matching key points, (x, y) in pixels.

    It can be taken apart: ``image_a, image_b, points_a, points_b = toy_triangles()``.
    """

    image_a: Bytes
    image_b: Bytes
    points_a: Floats
    points_b: Floats


def toy_triangles(size: int = 256) -> ImagePair:
    r"""Draw a green and an orange triangle, with their corners as key points.

    .. math:: \mathbf{p} \mapsto \frac{s - 1}{255}\, \mathbf{p}

    takes the key points of the pair of 256 × 256 pixels to a pair of size s.

    Parameters
    ----------
    size : int
        Width and height of both images in pixels, 16 or more.

    Returns
    -------
    ImagePair
        ``image_a`` and ``image_b``, shape (size, size, 3), uint8; ``points_a`` and
        ``points_b``, shape (3, 2). The corners of the images are no key points: add them with
        `canim.warping.add_frame_points`.

    Raises
    ------
    TypeError
        If `size` is not a whole number.
    ValueError
        If `size` is below 16.

    Notes
    -----
    They are the pair of Tasks 2.1 to 2.3.

    Examples
    --------
    >>> from canim.data import toy_triangles
    >>> pair = toy_triangles(size=160)
    >>> pair.image_a.shape
    (160, 160, 3)
    >>> pair.points_b.round(1).tolist()
    [[74.8, 15.6], [97.9, 86.7], [135.9, 29.3]]
    """
    scale = (whole_number(size, "size", 16) - 1) / (_TOY_SIZE - 1)
    points_a, points_b = scale * keypoints("toy_a"), scale * keypoints("toy_b")
    return ImagePair(
        _triangle(points_a, _GREEN, size), _triangle(points_b, _ORANGE, size), points_a, points_b
    )


def portraits() -> ImagePair:
    """Load two portraits, of Eileen Collins and Grace Hopper, with 48 key points.

    Returns
    -------
    ImagePair
        ``image_a`` (Collins) and ``image_b`` (Hopper), shape (400, 360, 3), uint8;
        ``points_a`` and ``points_b``, shape (48, 2). The corners of the images are no key
        points: add them with `canim.warping.add_frame_points`.

    Notes
    -----
    Both pictures are in the public domain; ``SOURCES.md`` beside them says where they come
    from. They are the pair of Task 2.3.

    Examples
    --------
    >>> from canim.data import portraits
    >>> image_a, image_b, points_a, points_b = portraits()
    >>> image_a.shape, points_a.shape
    ((400, 360, 3), (48, 2))
    """
    images = []
    for name in ("collins", "hopper"):
        with resources.as_file(_PORTRAITS / f"{name}.jpg") as path:
            images.append(read_image(path))
    return ImagePair(images[0], images[1], keypoints("collins"), keypoints("hopper"))


def keypoints(name: str) -> Floats:
    """Return the key points of one image.

    Parameters
    ----------
    name : {"collins", "hopper", "toy_a", "toy_b"}
        A portrait of `portraits`, or a triangle of `toy_triangles` at its size of 256.

    Returns
    -------
    ndarray, shape (n, 2)
        Points (x, y) in pixels; row i of one image matches row i of its partner.

    Raises
    ------
    ValueError
        If there is no image of this name.

    Examples
    --------
    >>> from canim.data import keypoints
    >>> keypoints("toy_a")
    array([[ 78.,  73.],
           [ 78., 186.],
           [147., 186.]])
    """
    sets: dict[str, Any] = dict(_TOY)
    text = (_PORTRAITS / "keypoints.json").read_text(encoding="utf-8")
    sets.update(json.loads(text))
    if not isinstance(name, str) or name not in sets:
        names = ", ".join(f'"{known}"' for known in sorted(sets))
        raise ValueError(f"name must be one of {names}, but is {name!r}.")
    return np.array(sets[name], dtype=np.float64)


def read_image(path: str | os.PathLike[str], size: tuple[int, int] | None = None) -> Bytes:
    """Read a picture file as an RGB image.

    Parameters
    ----------
    path : str or path
        A JPEG, PNG, GIF or other picture file. Of a film the first frame is read; a photograph
        that carries the position of the camera is turned upright.
    size : (int, int), optional
        The width and height in pixels that the image shall have. Its middle is taken, as large
        as it can be in this shape, and made smaller or larger.

    Returns
    -------
    ndarray of uint8, shape (h, w, 3)
        The image; transparent parts have become white.

    Raises
    ------
    OSError
        If there is no such file, or it may not be read.
    TypeError
        If `path` is not the name of a file, or `size` does not hold whole numbers.
    ValueError
        If the file is damaged, is no picture or one that Pillow does not read, such as a HEIC
        photograph, or holds greys of more than 8 bits. Colours of 16 bits are read as 8. Or if
        `size` is not a width and a height from 1 up.

    Examples
    --------
    >>> from pathlib import Path
    >>> from canim.data import read_image, toy_triangles
    >>> from PIL import Image
    >>> Image.fromarray(toy_triangles(64).image_a).save("toy.png")
    >>> read_image("toy.png").shape
    (64, 64, 3)
    >>> read_image("toy.png", size=(30, 40)).shape
    (40, 30, 3)
    >>> Path("toy.png").unlink()
    """
    if not isinstance(path, str | os.PathLike):
        raise TypeError(f"path must be the name of a file, but is {path!r}.")
    if size is not None:
        try:
            width, height = size
        except (TypeError, ValueError) as error:
            raise type(error)(f"size must be (width, height), but is {size!r}.") from error
        size = whole_number(width, "size", 1), whole_number(height, "size", 1)
    with open(path, "rb") as file:
        try:
            with Image.open(file) as picture:
                upright = ImageOps.exif_transpose(picture)
                deep = upright.mode[0] in "IF"
                colours = upright.convert("RGBA")
        except Exception as error:  # Damaged files make Pillow raise errors of many kinds.
            file.seek(0)
            kind = _kind(file.read(1024))
            raise ValueError(
                f"path: {os.fspath(path)} {kind}. "
                f"Open it in a program that shows it, and save it as JPEG or PNG."
            ) from error
    if deep:
        raise ValueError(
            f"path: {os.fspath(path)} holds greys of more than 8 bits; save it with 8."
        )
    white = Image.new("RGBA", colours.size, "white")
    image = Image.alpha_composite(white, colours).convert("RGB")
    if size:
        image = ImageOps.fit(image, size, Image.Resampling.LANCZOS)
    return np.array(image)


def _kind(head: bytes) -> str:
    """Say what a file is that Pillow does not read; people trust its name, which may be wrong."""
    for start, pattern, what in _NO_PICTURE_HERE:
        if re.match(pattern, head[start:], re.DOTALL):
            return f"is {what}, which canim does not read"
    return "cannot be read as a picture"


def _triangle(corners: Floats, colour: tuple[int, int, int], size: int) -> Bytes:
    """Draw a triangle whose edge pixels are mixed with the ground by how far it covers them."""
    y, x = np.mgrid[:size, :size]
    following = np.roll(corners, -1, axis=0)
    (ax, ay), (bx, by) = corners.T[:, :, None, None], following.T[:, :, None, None]
    inside = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / np.hypot(bx - ax, by - ay)
    # The sign tells clockwise from counter-clockwise corners.
    inside *= np.sign(inside[:, *np.rint(corners.mean(axis=0)[::-1]).astype(int)])[:, None, None]
    cover = np.clip(inside.min(axis=0) + 0.5, 0, 1)[:, :, None]
    mixed = cover * colour + (1 - cover) * _GROUND
    image: Bytes = np.floor(mixed + 0.5).astype(np.uint8)
    return image
