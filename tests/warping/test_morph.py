"""Morphing, against plain sums of warped images, and the GIF files that come of it."""

from __future__ import annotations

import io
import tracemalloc
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from scipy.spatial import KDTree

from canim.warping import (
    add_frame_points,
    morph,
    morph_frames,
    save_gif,
    triangulate,
    warp_backward,
)

KINDS = [
    (dtype, channels)
    for dtype in (np.uint8, np.uint16, np.float32, np.float64)
    for channels in ((), (3,), (4,))
]


def random_pair(shape, dtype=np.uint8, seed=0, count=8, move=0.1):
    rng = np.random.default_rng(seed)
    images = rng.integers(0, 256, (2, *shape)).astype(dtype)
    if images.dtype.kind == "f":
        images /= 255
    size = np.array(shape[1::-1]) - 1.0
    points = rng.uniform(0.1, 0.9, (count, 2)) * size
    return *images, points, (1 - move) * points + move * rng.uniform(0, 1, (count, 2)) * size


def exact_morph(image_a, image_b, points_a, points_b, t):
    """Add two images that were warped in floating point."""
    a, b = add_frame_points(points_a, image_a.shape), add_frame_points(points_b, image_a.shape)
    triangles, between = triangulate(a, b), (1 - t) * a + t * b
    return (1 - t) * warp_backward(image_a.astype(float), a, between, triangles) + (
        t * warp_backward(image_b.astype(float), b, between, triangles)
    )


# --- Morph


@pytest.mark.parametrize(("dtype", "channels"), KINDS)
@pytest.mark.parametrize("t", [0.25, 0.5, 0.8])
def test_morph_is_the_sum_of_two_warps(dtype, channels, t):
    pair = random_pair((41, 37, *channels), dtype)
    exact, found = exact_morph(*pair, t), morph(*pair, t)
    assert found.dtype == dtype
    assert found.shape == exact.shape
    atol = {"u1": 0.65, "u2": 0.5 + 1e-6, "f4": 1e-6, "f8": 1e-12}[np.dtype(dtype).str[1:]]
    assert np.abs(found - exact).max() <= atol


@pytest.mark.parametrize(("dtype", "channels"), KINDS)
def test_morph_begins_and_ends_with_the_images(dtype, channels):
    image_a, image_b, a, b = random_pair((11, 13, *channels), dtype)
    for given_triangles in (None, [(0, 1, 2)]):
        begin = morph(image_a, image_b, a, b, 0, given_triangles)
        end = morph(image_a, image_b, a, b, 1.0, given_triangles)
        assert begin.tobytes() == image_a.tobytes()
        assert end.tobytes() == image_b.tobytes()
        assert not np.shares_memory(begin, image_a)
        assert not np.shares_memory(end, image_b)


@given(st.floats(0, 1), st.integers(0, 2**32))
def test_bytes_are_within_one_level(t, seed):
    image_a, image_b, a, b = random_pair((23, 29, 3), np.uint8, seed)
    image_a, image_b = image_a // 128 * 255, image_b // 128 * 255
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        found, exact = morph(image_a, image_b, a, b, t), exact_morph(image_a, image_b, a, b, t)
    assert np.abs(found - np.floor(exact + 0.5)).max() <= 1
    assert np.abs(found - exact).max() < 0.75


@given(st.floats(0, 1), st.integers(0, 255), st.integers(0, 255))
def test_plain_images_are_blended_and_rounded_once(t, level_a, level_b):
    _, _, a, b = random_pair((9, 9), move=0.02)
    image_a, image_b = np.full((2, 9, 9), [[[level_a]], [[level_b]]], dtype=np.uint8)
    exact = (1 - t) * level_a + t * level_b
    found = morph(image_a, image_b, a, b, t)
    assert np.abs(found - exact).max() <= 0.5 + 0.05
    assert morph(image_a, image_a, a, b, t).tolist() == image_a.tolist()
    assert len(np.unique(found)) == 1


def test_halves_are_rounded_up_after_blending():
    _, _, a, b = random_pair((9, 9), move=0.02)
    image_a, image_b = np.full((2, 9, 9, 3), 212, dtype=np.uint8)
    image_b += 1
    # Rounded before they are added, 106 and 106.5 make 213 or 212.
    assert (morph(image_a, image_b, a, b, 0.5) == 213).all()
    assert (morph(image_b, image_b, a, b, 0.5) == 213).all()


def test_morph_backwards_is_the_same():
    image_a, image_b, a, b = random_pair((20, 20), float)
    there, back = morph(image_a, image_b, a, b, 0.3), morph(image_b, image_a, b, a, 0.7)
    np.testing.assert_allclose(there, back, rtol=0, atol=1e-12)


def test_points_in_between_carry_their_colour():
    image_a, image_b = np.zeros((2, 21, 21))
    image_a[10, 4], image_b[10, 16] = 1, 1
    for t in (0.25, 0.5, 0.75):
        found = morph(image_a, image_b, [(4, 10)], [(16, 10)], t)
        assert found.argmax() == 10 * 21 + 4 + 12 * t
        assert found.max() == pytest.approx(1)


def test_frame_points_are_added_where_they_are_missing():
    image_a, image_b, a, b = random_pair((20, 30))
    framed = [add_frame_points(points, (20, 30)) for points in (a, b)]
    expected = morph(image_a, image_b, a, b, 0.4)
    for count in range(1, 5):
        some = [points[: len(a) + count] for points in framed]
        assert np.array_equal(morph(image_a, image_b, *some, 0.4), expected)
    assert np.array_equal(morph(image_a, image_b, *framed, 0.4, triangulate(*framed)), expected)


def test_given_triangles_are_used_as_they_are():
    image_a, image_b = np.full((2, 10, 10), 100, dtype=np.uint8)
    points = [(2, 2), (8, 2), (2, 8)]
    found = morph(image_a, image_b, points, points, 0.5, [(0, 1, 2)])
    inside = np.array([[x >= 2 and y >= 2 and x + y <= 10 for x in range(10)] for y in range(10)])
    assert np.array_equal(found, np.where(inside, 100, 0))


# --- Frames


@pytest.mark.parametrize("count", [2, 3, 8])
def test_frames_are_morphs_at_equal_steps(count):
    pair = random_pair((16, 18, 3))
    frames = morph_frames(*pair, count)
    assert isinstance(frames, list)
    assert len(frames) == count
    for k, frame in enumerate(frames):
        assert np.array_equal(frame, morph(*pair, k / (count - 1)))
    assert frames[0].tobytes() == pair[0].tobytes()
    assert frames[-1].tobytes() == pair[1].tobytes()


def test_folds_are_named_once():
    image = np.zeros((10, 10), dtype=np.uint8)
    a, b = [(3, 5), (6, 5)], [(6, 4), (3, 6)]
    for call in (
        lambda: morph(image, image, a, b, 0.5),
        lambda: morph_frames(image, image, a, b, 9),
    ):
        with pytest.warns(
            UserWarning, match=r"lose their area: \d+ \(points \d, \d, \d\)"
        ) as caught:
            call()
        assert len(caught) == 1
        assert caught[0].filename == __file__


def test_a_triangle_that_folds_on_the_way_only_is_named():
    # Two points circle each other: upright at both ends, flat or turned over between.
    corners = np.array([(0, 0), (20, 0), (0, 20), (20, 20)], dtype=float)
    a = np.vstack([corners, [(8, 10), (12, 10), (10, 4)]])
    b = np.vstack([corners, [(12, 10), (8, 10), (10, 16)]])
    image = np.zeros((21, 21), dtype=np.uint8)
    with pytest.warns(UserWarning, match=r"0 \(points 4, 5, 6\)"):
        morph(image, image, a, b, 0.5, [(4, 5, 6)])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        morph(image, image, a, b, 0.25, [(4, 5, 6)])


@pytest.mark.parametrize("channels", [(), (3,), (4,)])
def test_memory_is_a_few_times_the_image(channels):
    pair = random_pair((1000, 1000, *channels), count=71, move=0.001)
    morph(*pair, 0.5)
    tracemalloc.start()
    morph(*pair, 0.5)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak <= 12 * pair[0].nbytes


# --- GIF


def read_gif(path):
    with Image.open(path) as film:
        frames = []
        for k in range(film.n_frames):
            film.seek(k)
            frames.append(np.asarray(film.convert("RGB")).astype(float))
        return frames, film.info


def decibels(frames, found):
    error = np.mean(
        [(np.asarray(f, dtype=float) - g) ** 2 for f, g in zip(frames, found, strict=True)]
    )
    return 10 * np.log10(255**2 / max(error, 1e-9))


def photographs(count=6, size=160):
    """Return smooth noise, as rich in colours as a photograph."""
    rng = np.random.default_rng(0)
    rough = rng.integers(0, 256, (2, 12, 12, 3), dtype=np.uint8)
    grain = rng.normal(0, 3, (size, size, 3))
    first, last = (
        np.asarray(Image.fromarray(image).resize((size, size), Image.Resampling.BICUBIC))
        for image in rough
    )
    steps = np.linspace(0, 1, count)
    return [((1 - t) * first + t * last + grain).clip(0, 255).astype(np.uint8) for t in steps]


def drawings(count=6, size=160):
    """Return smooth-edged discs of several colours that move over a white ground."""
    y, x = np.mgrid[:size, :size]
    frames = []
    for k in range(count):
        frame = np.full((size, size, 3), 255.0)
        for i, colour in enumerate([(31, 119, 180), (255, 127, 14), (44, 160, 44), (214, 39, 40)]):
            distance = np.hypot(x - 30 - 25 * i - 2.3 * k, y - 40 - 20 * i + 1.7 * k)
            cover = np.clip(18.5 - distance, 0, 1)[:, :, None]
            frame = frame * (1 - cover) + cover * colour
        frames.append(np.floor(frame + 0.5).astype(np.uint8))
    return frames


def plain_gif(frames):
    first, *others = map(Image.fromarray, frames)
    film = io.BytesIO()
    first.save(film, "GIF", save_all=True, append_images=others)
    return read_gif(film)[0]


@pytest.mark.parametrize("count", [1, 6, 40])
def test_gif_of_photographs_is_as_good_as_that_of_pillow(tmp_path, count):
    frames = photographs(count, 80)
    assert save_gif(tmp_path / "film.gif", frames) is None
    found, info = read_gif(tmp_path / "film.gif")
    assert decibels(frames, found) >= decibels(frames, plain_gif(frames)) - 0.5
    assert info["loop"] == 0
    assert info["duration"] == 100


def test_gif_of_a_short_film_has_a_palette_for_each_end(tmp_path):
    grain = photographs(2, 80)
    frames = [
        grain[0] // 2 * np.array([1, 2, 0], np.uint8),
        grain[1] // 2 * np.array([1, 0, 2], np.uint8),
    ]
    save_gif(tmp_path / "film.gif", frames)
    found, _ = read_gif(tmp_path / "film.gif")
    assert decibels(frames, found) >= decibels(frames, plain_gif(frames)) - 0.5


def test_gif_of_photographs_has_the_nearest_colours(tmp_path):
    frames = photographs(2, 80)
    save_gif(tmp_path / "film.gif", frames)
    for frame, found in zip(frames, read_gif(tmp_path / "film.gif")[0], strict=True):
        palette = np.unique(found.reshape(-1, 3), axis=0)
        nearest = KDTree(palette).query(frame)[0]
        assert np.mean((found - frame) ** 2) * 3 <= 1.015 * np.mean(nearest**2)


def test_gif_of_drawings_keeps_their_colours(tmp_path):
    frames = drawings()
    save_gif(str(tmp_path / "film.gif"), frames)
    found, _ = read_gif(tmp_path / "film.gif")
    assert decibels(frames, found) >= 40
    assert all((frame[0, 0] == 255).all() for frame in found)


def test_gif_of_grey_images_is_exact(tmp_path):
    frames = list(np.random.default_rng(0).integers(0, 256, (3, 20, 30), dtype=np.uint8))
    save_gif(tmp_path / "film.gif", frames)
    found, _ = read_gif(tmp_path / "film.gif")
    for frame, again in zip(frames, found, strict=True):
        assert np.array_equal(again, np.repeat(frame[:, :, None], 3, axis=2))


def test_gif_shows_white_through_what_is_transparent(tmp_path):
    frame = np.zeros((10, 10, 4), dtype=np.uint8)
    frame[:, 5:] = (255, 0, 0, 255)
    frame[:, 8:, 3] = 51
    save_gif(tmp_path / "film.gif", [frame])
    (found,), _ = read_gif(tmp_path / "film.gif")
    assert found[0].tolist() == [[255] * 3] * 5 + [[255, 0, 0]] * 3 + [[255, 204, 204]] * 2


@pytest.mark.parametrize(
    ("fps", "duration"), [(1, 1000), (2.5, 400), (30, 30), (50, 20), (0.01, 100_000)]
)
def test_gif_holds_the_frame_rate(tmp_path, fps, duration):
    frames = [np.full((4, 4), level, dtype=np.uint8) for level in (0, 255)]
    save_gif(tmp_path / "film.gif", iter(frames), fps)
    assert read_gif(tmp_path / "film.gif")[1]["duration"] == duration


@pytest.mark.parametrize(
    ("frame", "fps", "most", "more"),
    [
        (np.zeros((4, 4), dtype=np.uint8), 0.01, 6, 7),
        (np.zeros((4, 4), dtype=np.uint8), 0.1, 65, 66),
        (np.zeros((4, 4), dtype=np.uint8), 0.2, 131, 132),
        # The frames of a photograph are equal as long as they share a palette.
        (photographs(1, 20)[0], 0.01, 6, 14),
    ],
)
def test_gif_holds_a_still_picture_as_long_as_it_can(tmp_path, frame, fps, most, more):
    film = tmp_path / "film.gif"
    save_gif(film, [frame] * most, fps)
    assert read_gif(film)[1]["duration"] == most * 1000 / fps
    film.unlink()
    words = rf"^fps: {more} equal frames in a row stay for .* s at fps={fps}, .* 655\.35 s"
    with pytest.raises(ValueError, match=words):
        save_gif(film, [frame] * more, fps)
    assert not film.exists()


def test_gif_may_last_longer_than_one_picture_in_it(tmp_path):
    frames = np.random.default_rng(0).integers(0, 256, (9, 4, 4), dtype=np.uint8)
    save_gif(tmp_path / "film.gif", list(frames), 0.01)
    assert len(read_gif(tmp_path / "film.gif")[0]) == 9


@pytest.mark.parametrize("shape", [(65536, 1), (1, 65536)])
def test_gif_has_a_largest_side(tmp_path, shape):
    frames = np.zeros((2, *shape), dtype=np.uint8)
    with pytest.raises(ValueError, match=r"^frames\[0\] has 65536 pixels on a side, .* 65535\.$"):
        save_gif(tmp_path / "film.gif", frames)
    save_gif(
        tmp_path / "film.gif", [frame[1:] if shape[1] == 1 else frame[:, 1:] for frame in frames]
    )
    assert max(read_gif(tmp_path / "film.gif")[0][0].shape) == 65535


def test_gif_may_be_one_pixel_or_one_column(tmp_path):
    for shape in ((1, 1), (1, 1, 3), (7, 1, 3), (1, 7, 4)):
        frames = np.random.default_rng(0).integers(0, 256, (3, *shape), dtype=np.uint8)
        save_gif(tmp_path / "film.gif", list(frames))
        assert read_gif(tmp_path / "film.gif")[0][0].shape == (*shape[:2], 3)


def test_gif_replaces_an_older_one_and_leaves_nothing_else(tmp_path):
    film = tmp_path / "film.gif"
    film.write_bytes(b"old")
    save_gif(film, photographs(2, 20))
    assert [path.name for path in tmp_path.iterdir()] == ["film.gif"]
    assert film.read_bytes()[:6] == b"GIF89a"
    again = film.read_bytes()
    save_gif(film, photographs(2, 20))
    assert film.read_bytes() == again, "the same frames make the same file"
