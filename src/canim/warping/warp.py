"""Move the pixels of an image with the triangles over its key points."""

from __future__ import annotations

import reprlib
import warnings
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from canim._arguments import Floats, floats
from canim.warping.triangulation import (
    Integers,
    Spans,
    affine_maps,
    folds,
    matching_points,
    triangle_corners,
    triangle_spans,
)

__all__ = ["warp_backward", "warp_forward"]

Image = NDArray[Any]

# Pixels and rows worked on at a time: few enough that their numbers stay in the cache.
_BLOCK = 2**14
_ROWS = 64

# Bilinear weights of bytes are whole numbers that add up to 2¹³, so that the sums of three
# colours fit one integer: 255 · 2¹³ and the half for rounding need 21 of its 64 bits.
_BITS = 13
_ONE = 1 << _BITS
_LANE = 21
_HALVES = (1 | 1 << _LANE | 1 << 2 * _LANE) << (_BITS - 1)

# Places in byte images have 18 bits for the fraction and 13 for the pixel. A step that is wrong by
# half a unit makes a mistake of at most 2⁻¹¹ pixels within a piece of a span.
_FINE = 18
_PIECE = 256


def warp_forward(
    image: ArrayLike, source: ArrayLike, target: ArrayLike, triangles: ArrayLike
) -> tuple[Image, NDArray[np.bool_]]:
    r"""Send every pixel of an image to its place in the warped image.

    A pixel (u, v) in triangle i of the source points goes to

    .. math::

        \begin{pmatrix} x \\ y \\ 1 \end{pmatrix} =
        \mathbf{A}_i \begin{pmatrix} u \\ v \\ 1 \end{pmatrix},
        \qquad \text{rounded to } \lfloor x + \tfrac{1}{2} \rfloor,
        \lfloor y + \tfrac{1}{2} \rfloor .

    Where triangles grow, pixels stay empty: holes. Where several arrive, the last one in
    reading order stays.

    Parameters
    ----------
    image : array_like, shape (h, w), (h, w, 3) or (h, w, 4)
        Grey, RGB or RGBA; uint8, uint16 or float.
    source, target : array_like, shape (n, 2)
        Key points (x, y) in pixels: where they are in `image`, where they shall be.
    triangles : array_like of int, shape (F, 3)
        The numbers of each triangle's corners, as from `triangulate`.

    Returns
    -------
    warped : ndarray
        The new image, of the same shape and type; 0 where no pixel arrived.
    filled : ndarray of bool, shape (h, w)
        Where a pixel arrived.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind.
    ValueError
        If an argument has a wrong shape or is not finite, or a point lies outside the image.

    Warns
    -----
    UserWarning
        If triangles turn over or lose their area; it names them.

    Notes
    -----
    Theory: Task 2.1.

    References
    ----------
    C. A. Glasbey, K. V. Mardia, *A review of image-warping methods*, Journal of Applied
    Statistics 25(2), 1998.

    Examples
    --------
    A row of pixels is stretched to twice its length:

    >>> import numpy as np
    >>> from canim.warping import warp_forward
    >>> image = np.array([[7, 8, 9, 0, 0], [7, 8, 9, 0, 0]], dtype=np.uint8)
    >>> source, target = [(0, 0), (2, 0), (0, 1), (2, 1)], [(0, 0), (4, 0), (0, 1), (4, 1)]
    >>> warped, filled = warp_forward(image, source, target, [(0, 1, 2), (1, 3, 2)])
    >>> warped
    array([[7, 0, 8, 0, 9],
           [7, 0, 8, 0, 9]], dtype=uint8)
    >>> int((~filled).sum())
    4
    """
    pixels = checked_image(image, "image")
    height, width = shape = pixels.shape[0], pixels.shape[1]
    before, after, corners = checked_mesh(source, target, triangles, shape)
    warn_of_folds(np.stack([before, after]), corners, stacklevel=3)

    spans = triangle_spans(before, corners, shape)
    track = _track(spans, before, after, corners, shape)
    warped, filled = np.zeros_like(pixels, order="C"), np.zeros(shape, dtype=bool)
    colours, flat, flat_filled = _rows(pixels), _rows(warped), filled.reshape(-1)
    for block in _blocks(spans):
        x, y = _nearest(_along(track, block))
        inside = (x < width) & (y < height)
        place = (y * width + x)[inside]
        flat[place] = colours[block.pixels][inside]
        flat_filled[place] = True
    return warped, filled


def warp_backward(
    image: ArrayLike,
    source: ArrayLike,
    target: ArrayLike,
    triangles: ArrayLike,
    interpolation: str = "bilinear",
    fill: ArrayLike = 0,
) -> Image:
    r"""Ask for every pixel of the warped image where it comes from.

    A pixel (x, y) in triangle i of the target points takes its colour from

    .. math::

        \begin{pmatrix} u \\ v \\ 1 \end{pmatrix} =
        \mathbf{A}_i^{-1} \begin{pmatrix} x \\ y \\ 1 \end{pmatrix} .

    This place lies between pixels. ``"bilinear"`` mixes the four around it: with the fractions
    :math:`f = u - \lfloor u \rfloor` and :math:`g = v - \lfloor v \rfloor`, from top left to
    bottom right,

    .. math:: (1-f)(1-g)\,c_{00} + f(1-g)\,c_{10} + (1-f)g\,c_{01} + fg\,c_{11} ;

    ``"nearest"`` takes the pixel :math:`\lfloor u + \tfrac12 \rfloor, \lfloor v + \tfrac12
    \rfloor`. No pixel inside a triangle stays empty.

    Parameters
    ----------
    image : array_like, shape (h, w), (h, w, 3) or (h, w, 4)
        Grey, RGB or RGBA; uint8, uint16 or float.
    source, target : array_like, shape (n, 2)
        Key points (x, y) in pixels: where they are in `image`, where they shall be.
    triangles : array_like of int, shape (F, 3)
        The numbers of each triangle's corners, as from `triangulate`.
    interpolation : {"bilinear", "nearest"}
        How to read between pixels.
    fill : float, or array_like with one number a channel
        The colour of pixels outside all triangles.

    Returns
    -------
    ndarray
        The new image, of the same shape and type; whole numbers are rounded.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind.
    ValueError
        If an argument has a wrong shape or is not finite, a point lies outside the image,
        `interpolation` is unknown, or `fill` does not fit the image.

    Warns
    -----
    UserWarning
        If triangles turn over or lose their area; it names them. Where triangles overlap,
        the colour is that of one of them.

    Notes
    -----
    Neighbouring triangles leave no gap and do not overlap. Bilinear colours of a uint8 image
    are within one grey level of the exact ones, those of other images are exact. Theory:
    Task 2.2.

    References
    ----------
    C. A. Glasbey, K. V. Mardia, *A review of image-warping methods*, Journal of Applied
    Statistics 25(2), 1998.

    Examples
    --------
    >>> import numpy as np
    >>> from canim.warping import warp_backward
    >>> image = np.array([[0, 20, 40, 0, 0], [0, 20, 40, 0, 0]], dtype=np.uint8)
    >>> source, target = [(0, 0), (2, 0), (0, 1), (2, 1)], [(0, 0), (4, 0), (0, 1), (4, 1)]
    >>> warp_backward(image, source, target, [(0, 1, 2), (1, 3, 2)])
    array([[ 0, 10, 20, 30, 40],
           [ 0, 10, 20, 30, 40]], dtype=uint8)
    """
    pixels = checked_image(image, "image")
    shape = pixels.shape[0], pixels.shape[1]
    before, after, corners = checked_mesh(source, target, triangles, shape)
    if interpolation not in ("bilinear", "nearest"):
        raise ValueError(
            f'interpolation must be "bilinear" or "nearest", but is {reprlib.repr(interpolation)}.'
        )
    ground = _ground(pixels, fill)
    warn_of_folds(np.stack([before, after]), corners, stacklevel=3)
    if interpolation == "bilinear":
        return blend_warped([bilinear_planes(pixels)], [before], [1.0], after, corners, ground)

    height, width = shape
    spans = triangle_spans(after, corners, shape)
    track = _track(spans, after, before, corners, shape)
    colours, flat = _rows(pixels), _rows(ground)
    for block in _blocks(spans):
        x, y = _nearest(_along(track, block))
        # A point may lie on the rim of the image, half a pixel beyond the last centre.
        place = np.minimum(y, height - 1) * width + np.minimum(x, width - 1)
        flat[block.pixels] = colours[place]
    return ground


def bilinear_planes(image: Image) -> list[Image]:
    """Return the channels as flat arrays, each with its rim repeated one pixel outwards.

    The three colours of a byte image share one plane of integers, 21 bits each, so that one
    multiplication weighs all three.
    """
    channels = list(np.moveaxis(image.reshape(*image.shape[:2], -1), 2, 0))
    if _bytewise(image) and len(channels) > 1:
        return [_plane(channels[:3]), *(_plane([channel]) for channel in channels[3:])]
    return [_plane([channel]) for channel in channels]


def blend_warped(
    images: Sequence[list[Image]],
    sources: Sequence[Floats],
    shares: Sequence[float],
    target: Floats,
    triangles: Integers,
    ground: Image,
) -> Image:
    """Warp images given as planes, add each times its share, round once; paint `ground`."""
    shape = ground.shape[0], ground.shape[1]
    bytewise = _bytewise(ground)
    spans = triangle_spans(target, triangles, shape)
    if bytewise:
        spans = _pieces(spans)
    tracks = []
    for source in sources:
        first, step = _track(spans, target, source, triangles, shape)
        # From here on the rim is part of the image: its first pixel is (0, 0).
        track = _Track(first + 1, step)
        tracks.append(_packed(track) if bytewise else track)
    weigh = _byte_weights if bytewise else _real_weights
    stride = shape[1] + 2
    flat = _rows(ground)
    for block in _blocks(spans):
        sums = [np.full(block.size, _start(plane, bytewise)) for plane in images[0]]
        for planes, track, share in zip(images, tracks, shares):
            corner, weights = weigh(_along(track, block), share, stride)
            for step, weight in zip((0, 1, stride, stride + 1), weights):
                for plane, total in zip(planes, sums):
                    total += plane[step:].take(corner, mode="wrap") * weight
        flat[block.pixels] = _colours(sums, flat.shape[1], ground.dtype, bytewise)
    return ground


def checked_image(value: ArrayLike, name: str) -> Image:
    """Return an image as an array of one of the types that can be warped."""
    image = np.asarray(value)
    dtype = image.dtype.newbyteorder("=")
    if dtype not in (np.uint8, np.uint16) and dtype.kind != "f":
        raise TypeError(f"{name} must be of type uint8, uint16 or float, but is of type {dtype}.")
    if image.ndim not in (2, 3) or (image.ndim == 3 and image.shape[2] not in (3, 4)):
        raise ValueError(
            f"{name} must have the shape (height, width), (height, width, 3) or "
            f"(height, width, 4), but has shape {image.shape}."
        )
    if image.size == 0:
        raise ValueError(f"{name} has no pixels, its shape is {image.shape}.")
    if dtype.kind == "f":
        floats(image, name)
    return image.astype(dtype, copy=False)


def checked_mesh(
    source: ArrayLike, target: ArrayLike, triangles: ArrayLike, shape: tuple[int, int]
) -> tuple[Floats, Floats, Integers]:
    """Return the points and triangles of a warp within an image."""
    before, after = matching_points(source, target, "source", "target", shape)
    return before, after, triangle_corners(triangles, len(before))


def warn_of_folds(poses: Floats, triangles: Integers, stacklevel: int) -> None:
    """Name the triangles that turn over or lose their area between poses (poses, n, 2)."""
    folded = folds(poses, triangles)
    if folded:
        warnings.warn(
            f"These triangles turn over or lose their area: {folded}. Parts of the image will "
            "lie on top of each other; move their points or leave some out.",
            stacklevel=stacklevel,
        )


class _Track(NamedTuple):
    """Where the pixels of each span come from, or go to: the first one's place and the step.

    Both have the shape (2, spans), or (spans,) where x and y are packed into one integer.
    """

    first: NDArray[Any]
    step: NDArray[Any]


def _track(
    spans: Spans,
    here: Floats,
    there: Floats,
    triangles: Integers,
    shape: tuple[int, int],
) -> _Track:
    y, x = np.divmod(spans.start, shape[1])
    maps = affine_maps(here, there, triangles)[:, :2].transpose(1, 2, 0)
    maps = np.ascontiguousarray(maps).take(spans.triangle, axis=2)
    first = maps[:, 0] * x + maps[:, 1] * y + maps[:, 2]
    last = first + maps[:, 0] * (spans.length - 1)
    # The ends of a span lie inside their triangle up to rounding, but a thin one magnifies that.
    limit = np.array(shape[::-1])[:, None] - 0.5
    first, last = first.clip(-0.5, limit), last.clip(-0.5, limit)
    step = (last - first) / np.maximum(spans.length - 1, 1)
    return _Track(first, step)


class _Block(NamedTuple):
    """Some spans: which, the lengths of each and of those before it, and their pixels."""

    part: slice
    length: Integers
    before: Integers
    size: int
    pixels: slice | Integers


def _blocks(spans: Spans) -> Iterator[_Block]:
    """Divide the spans into blocks of about `_BLOCK` pixels."""
    ends = np.cumsum(spans.length)
    cuts = np.searchsorted(ends, np.arange(_BLOCK, spans.length.sum(), _BLOCK)) + 1
    edges = np.unique([0, *cuts, len(ends)]).tolist()
    for part in map(slice, edges, edges[1:]):
        start, length = spans.start[part], spans.length[part]
        before = ends[part] - length
        before -= before[0]
        count = int(length.sum())
        pixels: slice | Integers = slice(start[0], start[0] + count)
        if start[-1] + length[-1] != start[0] + count:  # Some pixels are in no triangle.
            pixels = np.arange(count) + np.repeat(start - before, length)
        yield _Block(part, length, before, count, pixels)


def _bytewise(image: Image) -> bool:
    """Tell whether an image is one of bytes, and not too large for packed places."""
    return image.dtype == np.uint8 and max(image.shape[:2]) + 2 <= 1 << (31 - _FINE)


def _pieces(spans: Spans) -> Spans:
    """Cut long spans into pieces."""
    count = -(-spans.length // _PIECE)
    done = _PIECE * (np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count))
    triangle, start, length = (np.repeat(part, count) for part in spans)
    return Spans(triangle, start + done, np.minimum(length - done, _PIECE))


def _packed(track: _Track) -> _Track:
    """Pack the x and y of places into the halves of one integer, in units of 2⁻¹⁸.

    A step along a span is then one addition for both. A negative x borrows from y, and the next
    addition pays it back; the places themselves are never negative.
    """
    first, step = (np.rint(part * 2**_FINE).astype(np.int64) for part in track)
    first += 1 << (_FINE - _BITS - 1)  # Places are cut to 13 bits later; now that rounds them.
    return _Track((first[1] << 32) + first[0], (step[1] << 32) + step[0])


def _along(track: _Track, block: _Block) -> NDArray[Any]:
    """Return the places of the pixels of a block, (2, pixels) or packed (pixels,)."""
    step, first = track.step[..., block.part], track.first[..., block.part]
    places = np.repeat(step, block.length, axis=-1)
    places *= np.arange(block.size, dtype=places.dtype)
    places += np.repeat(first - step * block.before, block.length, axis=-1)
    return places


def _nearest(places: Floats) -> Integers:
    # A calculated half may come out a little too small; halves go up.
    return np.floor(places + (0.5 + 1e-9)).astype(np.intp)


def _byte_weights(places: Integers, share: float, stride: int) -> tuple[Integers, list[Integers]]:
    """Return the pixels above and to the left of packed places, and the weights of all four.

    Weights are in units of 2⁻¹³. They add up to the share, and none is negative.
    """
    x, y = places.astype(np.int32), (places >> 32).astype(np.int32)
    corner = ((y >> _FINE) * stride + (x >> _FINE)).astype(np.intp)
    for fraction in (x, y):
        fraction >>= _FINE - _BITS
        fraction &= _ONE - 1
    both = x * y >> _BITS
    x -= both
    y -= both
    whole = round(share * _ONE)
    if whole < _ONE:
        for weight in (x, y, both):
            weight *= whole
            weight >>= _BITS
    return corner, [whole - x - y - both, x, y, both]


def _real_weights(places: Floats, share: float, stride: int) -> tuple[Integers, list[Floats]]:
    """Return the pixels above and to the left of places, and the weights of all four."""
    cell = places.astype(np.intp)
    f, g = places - cell
    both = f * g
    return cell[1] * stride + cell[0], [
        share * weight for weight in (1 - f - g + both, f - both, g - both, both)
    ]


def _start(plane: Image, bytewise: bool) -> np.generic:
    """Return what the sum for a plane begins with: a half where it is rounded by cutting off."""
    if not bytewise:
        return np.float64(0)
    return np.int64(_HALVES) if plane.dtype == np.int64 else np.int32(1 << (_BITS - 1))


def _colours(sums: list[Image], channels: int, dtype: np.dtype[Any], bytewise: bool) -> Image:
    """Return sums of planes as pixels, one a row; whole numbers rounded half up."""
    colours = np.empty((len(sums[0]), channels), dtype)
    for k in range(channels):
        if bytewise:
            # What lies above the eight bits of this colour is cut off by its type.
            sums[k // 3] >>= _LANE if k % 3 else _BITS
            colours[:, k] = sums[k // 3]
        else:
            colours[:, k] = sums[k] if dtype.kind == "f" else np.floor(sums[k] + 0.5)
    return colours


def _plane(channels: Sequence[Image]) -> Image:
    """Pack channels into one flat plane, and repeat its rim one pixel outwards."""
    height, width = channels[0].shape
    dtype = channels[0].dtype if len(channels) == 1 else np.int64
    plane = np.empty((height + 2, width + 2), dtype)
    for top in range(0, height, _ROWS):
        rows = slice(top, top + _ROWS)
        packed = channels[-1][rows].astype(dtype)
        for channel in channels[-2::-1]:
            packed <<= _LANE
            packed |= channel[rows]
        plane[1:-1, 1:-1][rows] = packed
    plane[0], plane[-1] = plane[1], plane[-2]
    plane[:, 0], plane[:, -1] = plane[:, 1], plane[:, -2]
    return plane.reshape(-1)


def _ground(image: Image, fill: ArrayLike) -> Image:
    """Return an image like another, painted with one colour."""
    colour = floats(fill, "fill")
    if colour.shape not in ((), image.shape[2:]):
        raise ValueError(
            f"fill must be one number, or one for each channel, shape {image.shape[2:]}, "
            f"but has shape {colour.shape}."
        )
    if (
        image.dtype.kind == "u"
        and not (
            (colour == np.floor(colour)) & (colour >= 0) & (colour <= np.iinfo(image.dtype).max)
        ).all()
    ):
        raise ValueError(
            f"fill must hold whole numbers from 0 to {np.iinfo(image.dtype).max}, as the image "
            f"does, but is {fill!r}."
        )
    return np.full(image.shape, colour, dtype=image.dtype)


def _rows(image: Image) -> Image:
    """Return the pixels one a row, their channels as columns."""
    return image.reshape(image.shape[0] * image.shape[1], -1)
