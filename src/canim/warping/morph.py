"""Turn one image into another, step by step, and save the film as a GIF."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Iterable, Iterator
from itertools import groupby, pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from PIL import Image as Pictures
from scipy.spatial import KDTree

from canim._arguments import Floats, floats, whole_number
from canim.warping.triangulation import (
    Integers,
    add_frame_points,
    matching_points,
    triangle_corners,
    triangulate,
)
from canim.warping.warp import (
    Image,
    bilinear_planes,
    blend_warped,
    checked_image,
    warn_of_folds,
)

__all__ = ["morph", "morph_frames", "save_gif"]

# Up to so many photographs of a GIF share a palette, made from so many of their pixels.
_RUN = 15
_SAMPLE = 3_000
# A GIF counts pixels, and hundredths of a second, with two bytes.
_MOST = 65_535


def morph(
    image_a: ArrayLike,
    image_b: ArrayLike,
    points_a: ArrayLike,
    points_b: ArrayLike,
    t: float,
    triangles: ArrayLike | None = None,
) -> Image:
    r"""Blend two images after warping both to key points in between.

    .. math::

        \mathbf{p}_i(t) &= (1 - t)\, \mathbf{a}_i + t\, \mathbf{b}_i \\
        M(t) &= (1 - t)\, W_{\mathbf{a} \to \mathbf{p}(t)}[A]
        + t\, W_{\mathbf{b} \to \mathbf{p}(t)}[B]

    where W is `warp_backward` with bilinear interpolation. Whole numbers are rounded once, at
    the end.

    Parameters
    ----------
    image_a, image_b : array_like, shape (h, w), (h, w, 3) or (h, w, 4)
        Two images of the same size and type: grey, RGB or RGBA; uint8, uint16 or float.
    points_a, points_b : array_like, shape (n, 2)
        Key points (x, y) in pixels; row i of one matches row i of the other.
    t : float
        The moment, from 0 (`image_a`) to 1 (`image_b`).
    triangles : array_like of int, shape (F, 3), optional
        The numbers of each triangle's corners. Without it the corners of the image that are no
        key points become some (`add_frame_points`), and `triangulate` finds the triangles; the
        whole image is covered then. Pixels outside given triangles are 0 in between.

    Returns
    -------
    ndarray
        The image in between, of the same shape and type. For t = 0 and t = 1 it is a copy of
        `image_a` or `image_b`, bit for bit.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind, or the images differ in type.
    ValueError
        If an argument has a wrong shape or is not finite, the images differ in size, a point
        lies outside them, `t` is not from 0 to 1, or no triangles can be found.

    Warns
    -----
    UserWarning
        If triangles turn over or lose their area; it names them.

    Notes
    -----
    Theory: Task 2.3.

    References
    ----------
    C. A. Glasbey, K. V. Mardia, *A review of image-warping methods*, Journal of Applied
    Statistics 25(2), 1998.

    Examples
    --------
    A bright spot moves two pixels to the right and gets brighter; halfway there:

    >>> import numpy as np
    >>> from canim.warping import morph
    >>> image_a, image_b = np.zeros((2, 3, 7), dtype=np.uint8)
    >>> image_a[1, 2], image_b[1, 4] = 100, 201
    >>> middle = morph(image_a, image_b, [(2, 1)], [(4, 1)], 0.5)
    >>> int(middle[1, 3])
    151
    """
    moment = floats(t, "t")
    if moment.ndim or not 0 <= moment <= 1:
        raise ValueError(f"t must be one number from 0 to 1, but is {t!r}.")
    mesh = _checked(image_a, image_b, points_a, points_b, triangles)
    return next(_frames(*mesh, moment[None]))


def morph_frames(
    image_a: ArrayLike,
    image_b: ArrayLike,
    points_a: ArrayLike,
    points_b: ArrayLike,
    count: int,
) -> list[Image]:
    r"""Make the frames of a film that turns one image into another.

    .. math:: M(t_k), \qquad t_k = \frac{k}{n - 1}, \qquad k = 0, \dots, n - 1

    with the in-between images M of `morph`.

    Parameters
    ----------
    image_a, image_b : array_like, shape (h, w), (h, w, 3) or (h, w, 4)
        Two images of the same size and type: grey, RGB or RGBA; uint8, uint16 or float.
    points_a, points_b : array_like, shape (n, 2)
        Key points (x, y) in pixels; row i of one matches row i of the other.
    count : int
        The number of frames, 2 or more: the first is `image_a`, the last `image_b`.

    Returns
    -------
    list of ndarray
        The frames, each of the shape and type of the images.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind, or the images differ in type.
    ValueError
        If an argument has a wrong shape or is not finite, the images differ in size, a point
        lies outside them, `count` is below 2, or no triangles can be found.

    Warns
    -----
    UserWarning
        If triangles turn over or lose their area in a frame; it names them, once.

    Notes
    -----
    Theory: Task 2.3.

    Examples
    --------
    >>> import numpy as np
    >>> from canim.warping import morph_frames
    >>> dark, bright = np.full((2, 8, 8), [[[0]], [[200]]], dtype=np.uint8)
    >>> frames = morph_frames(dark, bright, [(3, 3)], [(5, 5)], count=5)
    >>> [int(frame[4, 4]) for frame in frames]
    [0, 50, 100, 150, 200]
    """
    times = np.linspace(0, 1, whole_number(count, "count", 2))
    mesh = _checked(image_a, image_b, points_a, points_b, None)
    return list(_frames(*mesh, times))


def save_gif(path: str | os.PathLike[str], frames: Iterable[ArrayLike], fps: float = 10) -> None:
    r"""Save frames as an animated GIF that starts again at its end.

    A GIF has 256 colours. Drawings, most of whose pixels equal their right-hand neighbour, get a
    palette for every frame, which keeps nearly all of their few colours. Of photographs up to 15
    in a row share one, which is many times quicker.

    Parameters
    ----------
    path : str or path
        The file to write. The old file of this name, if there is one, is replaced when the new
        one is complete.
    frames : sequence of array_like, each of shape (h, w), (h, w, 3) or (h, w, 4)
        uint8 images of one shape: grey, RGB or RGBA, whose transparent parts become white.
    fps : float
        Frames per second, above 0 and up to 50. A GIF counts hundredths of a second, so the
        time of a frame is rounded to these.

    Raises
    ------
    OSError
        If the file cannot be written; nothing is left of it then.
    TypeError
        If an argument is of the wrong type, or a frame does not hold uint8 numbers.
    ValueError
        If there is no frame, a frame has a wrong shape or more than 65535 pixels on a side,
        `fps` is out of range, or equal frames in a row stay for more than 655.35 s.

    Notes
    -----
    Theory: Task 2.3.

    References
    ----------
    M. Gervautz, W. Purgathofer, *A Simple Method for Color Quantization: Octree Quantization*,
    New Trends in Computer Graphics, Springer, 1988.

    Examples
    --------
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from canim.warping import save_gif
    >>> black, white = np.zeros((20, 30), dtype=np.uint8), np.full((20, 30), 255, dtype=np.uint8)
    >>> save_gif("blink.gif", [black, white], fps=2)
    >>> Path("blink.gif").read_bytes()[:6]
    b'GIF89a'
    >>> Path("blink.gif").unlink()
    """
    try:
        target = Path(path)
    except TypeError as error:
        raise TypeError(f"path must be the name of a file, but is {path!r}.") from error
    if not target.name:
        raise ValueError(f"path must name a file, but is {str(path)!r}.")
    rate = floats(fps, "fps")
    if rate.ndim or not 0.01 <= rate <= 50:
        raise ValueError(f"fps must be one number from 0.01 to 50, but is {fps!r}.")
    images = _checked_frames(frames)
    drawn = images[0].ndim == 2 or _is_drawing(images)
    pictures = [*map(Pictures.fromarray, images)] if drawn else _with_shared_palettes(images)
    delay = round(100 / float(rate))
    if delay * len(pictures) > _MOST:
        _check_stills(pictures, delay, fps)
    first, *others = pictures
    film = io.BytesIO()
    first.save(
        *(film, "GIF"),
        save_all=True,
        append_images=others,
        duration=10 * delay,
        loop=0,
        optimize=drawn,
        interlace=False,
    )

    part = target.with_name(target.name + ".part")
    try:
        part.write_bytes(film.getbuffer())
        part.replace(target)
    except OSError as error:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
        raise OSError(error.errno, error.strerror, str(target)) from error


def _frames(
    image_a: Image, image_b: Image, a: Floats, b: Floats, triangles: Integers, times: Floats
) -> Iterator[Image]:
    poses = a + times[:, None, None] * (b - a)
    # At the ends the points are exactly those that came.
    poses[times == 0], poses[times == 1] = a, b
    warn_of_folds(np.concatenate([[a, b], poses]), triangles, stacklevel=4)
    planes = [bilinear_planes(image_a), bilinear_planes(image_b)]
    for t, pose in zip(times.tolist(), poses):
        if t in (0, 1):
            yield (image_b if t else image_a).copy()
        else:
            ground = np.zeros_like(image_a, order="C")
            yield blend_warped(planes, [a, b], [1 - t, t], pose, triangles, ground)


def _checked(
    image_a: ArrayLike,
    image_b: ArrayLike,
    points_a: ArrayLike,
    points_b: ArrayLike,
    triangles: ArrayLike | None,
) -> tuple[Image, Image, Floats, Floats, Integers]:
    first, second = checked_image(image_a, "image_a"), checked_image(image_b, "image_b")
    height, width = shape = first.shape[0], first.shape[1]
    if second.shape[:2] != shape:
        raise ValueError(
            f"image_b is {second.shape[1]} × {second.shape[0]} pixels and image_a "
            f"{width} × {height}; make them equal, for instance with "
            f"PIL.Image.fromarray(image_b).resize(({width}, {height})), and scale points_b alike."
        )
    if second.shape != first.shape:
        raise ValueError(
            f"image_b has the shape {second.shape} and image_a {first.shape}; "
            "both must be grey, RGB or RGBA."
        )
    if second.dtype != first.dtype:
        raise TypeError(
            f"image_b is of type {second.dtype} and image_a of type {first.dtype}; "
            "both must be of one type."
        )
    if triangles is None:
        a, b = _framed(points_a, points_b, shape)
        return first, second, a, b, triangulate(a, b)
    a, b = matching_points(points_a, points_b, "points_a", "points_b", shape)
    return first, second, a, b, triangle_corners(triangles, len(a))


def _framed(
    points_a: ArrayLike, points_b: ArrayLike, shape: tuple[int, int]
) -> tuple[Floats, Floats]:
    """Add the corners of the images that are not among the points."""
    a, b = matching_points(points_a, points_b, "points_a", "points_b", shape, minimum=1)
    for corner in add_frame_points([], shape):
        in_a, in_b = (a == corner).all(axis=1), (b == corner).all(axis=1)
        apart = np.flatnonzero(in_a != in_b)
        if apart.size:
            one, other = ("points_a", "points_b") if in_a[apart[0]] else ("points_b", "points_a")
            raise ValueError(
                f"{one}[{apart[0]}] is a corner of the image, but {other}[{apart[0]}] is not; "
                "a corner stays where it is."
            )
        if not in_a.any():
            a, b = np.vstack([a, corner]), np.vstack([b, corner])
    return a, b


def _checked_frames(frames: Iterable[ArrayLike]) -> list[Image]:
    if isinstance(frames, np.ndarray) and frames.ndim == 3 and frames.shape[2] in (3, 4):
        raise ValueError("frames must be a list of images, but is one image; write [image].")
    try:
        images = [checked_image(frame, f"frames[{i}]") for i, frame in enumerate(frames)]
    except TypeError as error:
        if np.iterable(frames):
            raise
        raise TypeError(f"frames must be a list of images, but is {frames!r}.") from error
    if not images:
        raise ValueError("frames must hold one image or more, but is empty.")
    for i, image in enumerate(images):
        side = max(image.shape[:2])
        if side > _MOST:
            raise ValueError(f"frames[{i}] has {side} pixels on a side, but a GIF at most {_MOST}.")
        if image.dtype != np.uint8:
            raise TypeError(f"frames[{i}] must be of type uint8, but is of type {image.dtype}.")
        if image.shape != images[0].shape:
            raise ValueError(
                f"frames[{i}] has the shape {image.shape}, but frames[0] {images[0].shape}."
            )
    if images[0].shape[2:] == (4,):
        return [_on_white(image) for image in images]
    return images


def _check_stills(pictures: list[Pictures.Image], delay: int, fps: float) -> None:
    """Refuse equal frames in a row that stay too long: Pillow makes one of them."""
    runs = groupby(picture.convert("RGB").tobytes() for picture in pictures)
    count = max(sum(1 for _ in run) for _, run in runs)
    if count * delay > _MOST:
        raise ValueError(
            f"fps: {count} equal frames in a row stay for {count * delay / 100:g} s at "
            f"fps={fps!r}, but a GIF holds a picture for at most {_MOST / 100} s. Take a larger "
            f"fps or fewer of these frames."
        )


def _on_white(image: Image) -> Image:
    cover = image[:, :, 3:] / 255.0
    return np.floor(image[:, :, :3] * cover + 255 * (1 - cover) + 0.5).astype(np.uint8)


def _is_drawing(images: list[Image]) -> bool:
    """Tell flat colours from photographs by a few rows of a few frames."""
    few = np.stack([image[::32] for image in images[:: len(images) // 8 + 1]])
    flat = (few[:, :, 1:] == few[:, :, :-1]).all(axis=3)
    return bool(2 * np.count_nonzero(flat) > flat.size)


def _with_shared_palettes(images: list[Image]) -> list[Pictures.Image]:
    # A short film has two: a single one would have to serve both ends of a morph.
    count = max(2, -(-len(images) // _RUN))
    edges = np.linspace(0, len(images), count + 1).round().astype(int).tolist()
    runs = [images[a:b] for a, b in pairwise(edges) if a < b]
    return [picture for run in runs for picture in _with_one_palette(run)]


def _with_one_palette(images: list[Image]) -> list[Pictures.Image]:
    """Give every pixel of some frames its nearest colour of one palette."""
    palette = _palette(images)
    # Pillow decides once for 4 × 4 × 4 colours, by the darkest: two levels down it is the middle.
    darker = Pictures.new("P", (1, 1))
    darker.putpalette((np.maximum(palette, 2) - 2).tobytes())
    film = Pictures.fromarray(np.concatenate(images))
    numbers = np.asarray(film.quantize(palette=darker, dither=Pictures.Dither.NONE))
    pictures = [Pictures.fromarray(part) for part in np.split(numbers, len(images))]
    for picture in pictures:
        picture.putpalette(palette.tobytes())
    return pictures


def _palette(images: list[Image]) -> Image:
    """Return up to 256 colours: an octree of a sample, then a few steps of k-means."""
    rng = np.random.default_rng(0)
    height, width = images[0].shape[:2]
    size = _SAMPLE // len(images) + 1
    parts = [image[rng.integers(0, height, size), rng.integers(0, width, size)] for image in images]
    sample = np.concatenate(parts)
    octree = Pictures.fromarray(sample[None]).quantize(256, Pictures.Quantize.FASTOCTREE)
    palette = np.reshape(np.array(octree.getpalette(), dtype=np.float64), (-1, 3))
    for _ in range(3):
        nearest = KDTree(palette).query(sample)[1]
        count = np.bincount(nearest, minlength=len(palette))
        for channel in range(3):
            total = np.bincount(nearest, sample[:, channel], minlength=len(palette))
            np.divide(total, count, out=palette[:, channel], where=count > 0)
        palette[count == 0] = sample[rng.integers(0, len(sample), np.count_nonzero(count == 0))]
    return np.rint(palette).astype(np.uint8)
