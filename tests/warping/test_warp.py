"""Forward and backward warping, against plain loops, scikit-image and what always holds."""

from __future__ import annotations

import json
import math
import tracemalloc
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial import Delaunay
from skimage.transform import PiecewiseAffineTransform, warp

from canim.warping import (
    add_frame_points,
    affine_transforms,
    triangulate,
    warp_backward,
    warp_forward,
)

CASES = json.loads((Path(__file__).parents[1] / "cases/warping.json").read_text("utf-8"))
TOY = CASES["toy"]
KINDS = [
    (dtype, channels)
    for dtype in (np.uint8, np.uint16, np.float32, np.float64)
    for channels in ((), (3,), (4,))
]


def random_image(shape, dtype=np.uint8, seed=0):
    rng = np.random.default_rng(seed)
    if np.dtype(dtype).kind == "f":
        return rng.normal(size=shape).astype(dtype)
    return rng.integers(0, np.iinfo(dtype).max, shape, dtype=dtype, endpoint=True)


def random_mesh(shape, count=8, seed=0, move=0.04):
    """Return key points with the frame, moved ones, and their triangles."""
    rng = np.random.default_rng(seed)
    size = np.array(shape[1::-1]) - 1.0
    inner = rng.uniform(0.1, 0.9, (count, 2)) * size
    moved = inner + rng.uniform(-move, move, (count, 2)) * size
    moved = size / 2 + (moved - size / 2) * 0.4 / (0.4 + move)
    source, target = add_frame_points(inner, shape), add_frame_points(moved, shape)
    return source, target, triangulate(source, target)


def barycentric(corners, x, y):
    return np.linalg.solve(np.vstack([corners.T, np.ones(3)]), [x, y, 1])


def loop_places(points, images_of_points, triangles, shape):
    """Yield each pixel that lies in a triangle, and its place in the other image."""
    for y, x in np.ndindex(shape[:2]):
        for corners in triangles:
            weights = barycentric(points[corners], x, y)
            if weights.min() >= -1e-9:
                yield y, x, *(weights @ images_of_points[corners])
                break


def loop_bilinear(image, u, v):
    height, width = image.shape[:2]
    u, v = min(max(u, 0), width - 1), min(max(v, 0), height - 1)
    left, top = min(math.floor(u), width - 2), min(math.floor(v), height - 2)
    f, g = u - left, v - top
    c = image[top : top + 2, left : left + 2].astype(float)
    return (
        (1 - f) * (1 - g) * c[0, 0]
        + f * (1 - g) * c[0, 1]
        + (1 - f) * g * c[1, 0]
        + f * g * c[1, 1]
    )


def loop_backward(image, source, target, triangles):
    warped = np.zeros(image.shape)
    for y, x, u, v in loop_places(target, source, triangles, image.shape):
        warped[y, x] = loop_bilinear(image, u, v)
    return warped


# --- Backward


@pytest.mark.parametrize(("dtype", "channels"), KINDS)
@pytest.mark.parametrize("size", [(17, 23), (23, 17)])
def test_bilinear_is_the_loop(dtype, channels, size):
    image = random_image((*size, *channels), dtype)
    source, target, triangles = random_mesh(size)
    exact = loop_backward(image, source, target, triangles)
    warped = warp_backward(image, source, target, triangles)
    assert warped.dtype == dtype
    if dtype == np.uint8:
        assert np.abs(warped - exact).max() < 0.6
    elif dtype == np.uint16:
        assert np.abs(warped - exact).max() <= 0.5 + 1e-6
    else:
        np.testing.assert_allclose(
            warped, exact, rtol=0, atol=1e-5 if dtype == np.float32 else 1e-11
        )


@pytest.mark.parametrize(("dtype", "channels"), KINDS)
def test_nearest_is_the_loop(dtype, channels):
    image = random_image((17, 23, *channels), dtype)
    source, target, triangles = random_mesh(image.shape)
    expected = np.zeros_like(image)
    for y, x, u, v in loop_places(target, source, triangles, image.shape):
        expected[y, x] = image[math.floor(v + 0.5), math.floor(u + 0.5)]
    warped = warp_backward(image, source, target, triangles, "nearest")
    assert warped.dtype == dtype
    assert np.array_equal(warped, expected)


@pytest.mark.parametrize("shape", [(40, 60), (60, 40, 3)])
def test_bilinear_is_scikit_image(shape):
    image = random_image(shape, float)
    source, target, _ = random_mesh(shape, 12)
    if hasattr(PiecewiseAffineTransform, "from_estimate"):
        transform = PiecewiseAffineTransform.from_estimate(target, source)
    else:
        transform = PiecewiseAffineTransform()
        assert transform.estimate(target, source)
    expected = warp(image, transform, mode="edge", preserve_range=True)
    warped = warp_backward(image, source, target, Delaunay(target).simplices)
    # scikit-image loses some pixels of the rim to rounding.
    np.testing.assert_allclose(warped[1:-1, 1:-1], expected[1:-1, 1:-1], rtol=0, atol=1e-9)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, float])
def test_bilinear_by_hand(dtype):
    case = CASES["bilinear"]
    image = np.array(case["image"], dtype=dtype)
    around_first_pixel = [(-0.4, -0.4), (0.4, -0.4), (0, 0.4)]
    for place, exact in zip(case["places"], case["exact"], strict=True):
        with pytest.warns(UserWarning, match="lose their area"):
            warped = warp_backward(image, [place] * 3, around_first_pixel, [(0, 1, 2)], fill=7)
        assert warped[0, 0] == (exact if dtype is float else math.floor(exact + 0.5))
        assert (warped.reshape(-1)[1:] == 7).all()


@pytest.mark.parametrize("interpolation", ["bilinear", "nearest"])
@pytest.mark.parametrize(("dtype", "channels"), KINDS)
def test_points_that_stay_change_nothing(dtype, channels, interpolation):
    image = random_image((31, 29, *channels), dtype)
    points, _, triangles = random_mesh(image.shape)
    warped = warp_backward(image, points, points, triangles, interpolation)
    if image.dtype.kind == "u":
        assert np.array_equal(warped, image)
    np.testing.assert_allclose(warped, image, rtol=0, atol=1e-5 if dtype == np.float32 else 1e-11)


@pytest.mark.parametrize(("dtype", "channels"), KINDS)
def test_one_colour_stays_that_colour(dtype, channels):
    source, target, triangles = random_mesh((50, 50))
    for value in (0, 1, 254, np.iinfo(dtype).max if np.dtype(dtype).kind == "u" else 1e6):
        image = np.full((50, 50, *channels), value, dtype=dtype)
        np.testing.assert_allclose(warp_backward(image, source, target, triangles), image, 1e-6)


@given(st.integers(0, 2**32), st.integers(2, 40), st.integers(2, 40), st.integers(1, 30))
def test_bytes_are_within_one_level_and_every_pixel_is_filled(seed, height, width, count):
    source, target, triangles = random_mesh((height, width), count, seed, move=0.3)
    # Black and white noise is the hardest image.
    image = random_image((height, width, 3), np.uint8, seed) // 128 * 255
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        warped = warp_backward(image, source, target, triangles, fill=77)
        exact = warp_backward(image.astype(float), source, target, triangles, fill=-1e9)
    assert exact.min() > -1e-6
    assert np.abs(warped - exact).max() < 0.6
    assert np.abs(warped - np.floor(exact + 0.5)).max() <= 1


@example(np.zeros((3, 2)), np.array([(1, 5e-324), (0, 1), (0, 0)]))
@example(np.array([(2.0, 0), (0, 0), (0, 0)]), np.array([(1.1e-308, 0), (0, 1), (0, 0)]))
@given(
    arrays(float, (3, 2), elements=st.floats(-0.5, 9.4)),
    arrays(float, (3, 2), elements=st.floats(-0.5, 9.4)),
)
def test_thin_triangles_keep_to_the_range_of_the_image(source, target):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        for image in (np.full((10, 10, 3), 200, dtype=np.uint8), np.full((10, 10), 200.0)):
            warped = warp_backward(image, source, target, [(0, 1, 2)], fill=200)
            np.testing.assert_allclose(warped, 200, rtol=1e-12)
            warp_forward(image, source, target, [(0, 1, 2)])
            warp_backward(image, source, target, [(0, 1, 2)], "nearest")


def test_a_pixel_just_outside_a_thin_triangle_does_not_read_beyond_the_image():
    image = np.repeat(np.arange(10, dtype=np.uint8)[:, None] * 20, 10, axis=1)
    source = [(0, 0), (9, 0), (9, 9)]
    target = [(0, 5e-10), (9, 5e-10), (9, 9e-10)]
    for pixels in (image, image / 255):
        for interpolation in ("bilinear", "nearest"):
            warped = warp_backward(pixels, source, target, [(0, 1, 2)], interpolation, fill=0)
            assert (warped == 0).all()


def test_fill_is_the_colour_outside_all_triangles():
    image = random_image((20, 20, 3), seed=3)
    points = [(5, 5), (15, 5), (5, 15)]
    for interpolation in ("bilinear", "nearest"):
        warped = warp_backward(image, points, points, [(0, 1, 2)], interpolation, fill=(9, 8, 7))
        inside = np.zeros((20, 20), dtype=bool)
        for y, x in np.ndindex(20, 20):
            inside[y, x] = x >= 5 and y >= 5 and x + y <= 20
        assert np.array_equal(warped[inside], image[inside])
        assert (warped[~inside] == (9, 8, 7)).all()
    floating = warp_backward(image / 255, points, points, [(0, 1, 2)], fill=-0.5)
    assert (floating[~inside] == -0.5).all()


def test_a_triangle_between_all_pixels_fills_none():
    image = random_image((8, 8))
    points = [(2.2, 2.2), (2.8, 2.2), (2.2, 2.8)]
    assert (warp_backward(image, points, points, [(0, 1, 2)], fill=5) == 5).all()
    assert not warp_forward(image, points, points, [(0, 1, 2)])[1].any()


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1, 3)])
def test_narrow_images(shape):
    image = random_image(shape)
    height, width = shape[:2]
    corners = [(-0.5, -0.5), (width - 0.5, -0.5), (-0.5, height - 0.5), (width - 0.5, height - 0.5)]
    triangles = triangulate(corners, corners)
    for interpolation in ("bilinear", "nearest"):
        warped = warp_backward(image, corners, corners, triangles, interpolation)
        assert np.array_equal(warped, image)
    warped, filled = warp_forward(image, corners, corners, triangles)
    assert np.array_equal(warped, image)
    assert filled.all()


def test_a_point_on_the_rim_reads_the_rim():
    image = random_image((6, 6))
    target = [(0, 0), (5, 0), (0, 5)]
    for corner, pixel in (((-0.5, -0.5), image[0, 0]), ((5.5, 5.5), image[5, 5])):
        for interpolation in ("bilinear", "nearest"):
            with pytest.warns(UserWarning, match="lose their area"):
                warped = warp_backward(image, [corner] * 3, target, [(0, 1, 2)], interpolation)
            assert (warped[np.add.outer(range(6), range(6)) <= 5] == pixel).all()


def test_images_may_be_views_read_only_and_of_another_byte_order():
    image = random_image((30, 40, 3))
    source, target, triangles = random_mesh(image.shape)
    expected = warp_backward(image, source, target, triangles)
    expected_forward = warp_forward(image, source, target, triangles)[0]
    padded = np.zeros((60, 80, 6), dtype=np.uint8)
    padded[::2, ::2, ::2] = image
    frozen = image.copy()
    frozen.flags.writeable = False
    for view in (padded[::2, ::2, ::2], np.asfortranarray(image), frozen, image[::-1][::-1]):
        before = view.copy()
        warped = warp_backward(view, source, target, triangles)
        assert warped.flags.c_contiguous
        assert warped.flags.writeable
        assert np.array_equal(warped, expected)
        assert np.array_equal(warp_forward(view, source, target, triangles)[0], expected_forward)
        assert np.array_equal(view, before)
    big = image[:, :, 0].astype(">u2")
    assert warp_backward(big, source, target, triangles).dtype == np.uint16


# --- Forward


@pytest.mark.parametrize(("dtype", "channels"), KINDS)
def test_forward_is_the_loop(dtype, channels):
    image = random_image((23, 17, *channels), dtype)
    source, target, _ = random_mesh(image.shape, move=0.2, seed=5)
    triangles = Delaunay(source).simplices
    expected, filled = np.zeros_like(image), np.zeros((23, 17), dtype=bool)
    for v, u, x, y in loop_places(source, target, triangles, image.shape):
        place = math.floor(y + 0.5), math.floor(x + 0.5)
        expected[place], filled[place] = image[v, u], True
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        found = warp_forward(image, source, target, triangles)
    assert found[0].dtype == dtype
    assert np.array_equal(found[0], expected)
    assert np.array_equal(found[1], filled)
    assert 0 < filled.mean() < 1


@pytest.mark.parametrize("way", ["a_to_b", "b_to_a"])
def test_holes_of_the_toy_pair(way):
    shape = TOY["size"], TOY["size"]
    source, target = (add_frame_points(TOY[f"points_{name}"], shape) for name in way.split("_to_"))
    triangles = triangulate(source, target)
    image = np.full(shape, 200, dtype=np.uint8)
    warped, filled = warp_forward(image, source, target, triangles)
    assert (~filled).sum() == TOY["holes"][way]
    assert np.array_equal(warped == 200, filled)
    assert (warp_backward(image, source, target, triangles) == 200).all()


def test_a_pixel_that_lands_outside_is_left_out():
    image = random_image((5, 5))
    target = [(-0.5, -0.5), (4.5, -0.5), (-0.5, 4.5), (4.5, 4.5)]
    source = [(0, 0), (4, 0), (0, 4), (4, 4)]
    warped, filled = warp_forward(image, source, target, [(0, 1, 2), (1, 3, 2)])
    # x = 4 goes to 4.5, which is rounded to 5, beyond the last column; so it is with y.
    kept = np.zeros((5, 5), dtype=bool)
    kept[:4, :4] = True
    assert np.array_equal(filled, kept)
    assert np.array_equal(warped, np.where(kept, image, 0))


# --- Folds


def test_folded_triangles_are_named():
    source = np.array([(0, 0), (9, 0), (0, 9), (9, 9), (3, 5), (6, 5)], dtype=float)
    target = source.copy()
    target[[4, 5]] = source[[5, 4]] + [(0, 1), (0, -1)]
    triangles = triangulate(source, source)
    change = [
        np.sign(np.linalg.det(affine_transforms(source, target, triangles[[i]])[0])) < 0
        for i in range(len(triangles))
    ]
    names = ", ".join(
        f"{i} (points {', '.join(map(str, triangles[i]))})" for i in np.flatnonzero(change)
    )
    assert names
    image = np.zeros((10, 10), dtype=np.uint8)
    for call in (warp_forward, warp_backward):
        with pytest.warns(UserWarning, match="turn over") as caught:
            call(image, source, target, triangles)
        assert len(caught) == 1
        assert f": {names}. " in str(caught[0].message)
        assert caught[0].filename == __file__


# --- Size


def peak(call):
    tracemalloc.start()
    call()
    size = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return size


@pytest.mark.parametrize(("dtype", "channels"), KINDS)
def test_memory_is_a_few_times_the_image(dtype, channels):
    image = random_image((1000, 1000, *channels), dtype)
    mesh = random_mesh(image.shape, 71, move=0.01)
    for call in (warp_forward, warp_backward):
        call(image, *mesh)
        assert peak(lambda call=call: call(image, *mesh)) <= 12 * image.nbytes


@pytest.mark.parametrize("shape", [(8000, 8000), (20, 9000)])
def test_a_large_image(shape):
    image = np.zeros(shape, dtype=np.uint8)
    image[:, ::2] = 255
    middle = np.array(shape[::-1]) / 2
    source = add_frame_points([middle + 0.5], image.shape)
    target = add_frame_points([middle * (1.05, 0.975) + 0.25], image.shape)
    triangles = triangulate(source, target)
    warped = warp_backward(image, source, target, triangles)
    height, width = shape
    rows = slice(height // 2 - 1, None, height // 8)
    exact = np.zeros(image[rows].shape)
    maps = affine_transforms(target, source, triangles)
    for i, y in enumerate(range(*rows.indices(height))):
        x = np.arange(float(width))
        places = np.stack([x, np.full(width, float(y)), np.ones(width)])
        for corners, matrix in zip(triangles, maps, strict=True):
            columns = np.vstack([target[corners].T, np.ones(3)])
            inside = np.linalg.solve(columns, places).min(axis=0) >= -1e-9
            u = (matrix @ places)[0, inside]
            f = u - np.floor(u)
            exact[i, inside] = 255 * np.where(np.floor(u) % 2 == 0, 1 - f, f)
    assert np.abs(warped[rows] - exact).max() < 0.75
