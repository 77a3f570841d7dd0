"""Wrong arguments are refused in one sentence that names them; nothing is changed or left."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from canim.warping import (
    add_frame_points,
    affine_transforms,
    morph,
    morph_frames,
    save_gif,
    triangulate,
    warp_backward,
    warp_forward,
)

POINTS = np.array([(0, 0), (9, 0), (0, 7), (9, 7), (4, 3)], dtype=float)
MOVED = np.array([(0, 0), (9, 0), (0, 7), (9, 7), (5, 4)], dtype=float)
TRIANGLES = np.array([(0, 1, 4), (1, 3, 4), (3, 2, 4), (2, 0, 4)])
IMAGE = np.arange(8 * 10 * 3, dtype=np.uint8).reshape(8, 10, 3)

WARP = {"image": IMAGE, "source": POINTS, "target": MOVED, "triangles": TRIANGLES}
PAIR = {"image_a": IMAGE, "image_b": IMAGE[::-1], "points_a": POINTS, "points_b": MOVED}
CALLS = {
    add_frame_points: {"points": POINTS, "shape": (8, 10, 3)},
    triangulate: {"points_a": POINTS, "points_b": MOVED},
    affine_transforms: {"source": POINTS, "target": MOVED, "triangles": TRIANGLES},
    warp_forward: WARP,
    warp_backward: {**WARP, "interpolation": "nearest", "fill": 7},
    morph: {**PAIR, "t": 0.5, "triangles": TRIANGLES},
    morph_frames: {**PAIR, "count": 3},
}


def cases(*names):
    return [(call, name) for call, given in CALLS.items() for name in names if name in given]


def refuses(call, error, match, **changed):
    before = {name: np.copy(value) for name, value in CALLS[call].items()}
    with pytest.raises(error, match=match) as caught:
        call(**{**CALLS[call], **changed})
    text = str(caught.value)
    assert text[-1] == "."
    assert "\n" not in text
    for name, value in CALLS[call].items():
        assert np.array_equal(value, before[name])


# --- Points

POINT_SETS = cases("points", "source", "target", "points_a", "points_b")
IN_IMAGE = [
    (call, name) for call, name in POINT_SETS if call not in (triangulate, affine_transforms)
]


@pytest.mark.parametrize(("call", "name"), POINT_SETS)
@pytest.mark.parametrize(
    ("bad", "error"),
    [
        (np.where(POINTS == 4, math.nan, POINTS), ValueError),
        (np.where(POINTS == 4, math.inf, POINTS), ValueError),
        (POINTS + 1j, TypeError),
        (POINTS > 3, TypeError),
        (POINTS.astype(object), TypeError),
        ("points", TypeError),
        (None, TypeError),
        (POINTS[0], ValueError),
        (POINTS.T, ValueError),
        (np.column_stack([POINTS, POINTS[:, 0]]), ValueError),
        ([[0, 0], [1]], ValueError),
    ],
)
def test_points_that_are_no_pairs_of_finite_numbers(call, name, bad, error):
    refuses(call, error, rf"^{name}\b", **{name: bad})


@pytest.mark.parametrize(("call", "name"), IN_IMAGE)
@pytest.mark.parametrize("bad", [(-0.6, 3), (9.6, 3), (4, -3), (4, 7.6), (1e300, 0)])
def test_points_outside_the_image(call, name, bad):
    points = POINTS.copy()
    points[4] = bad
    match = rf"^{name}\[4\] is \({bad[0]:g}, {bad[1]:g}\), outside .* 0 to 9, y from 0 to 7\.$"
    refuses(call, ValueError, match.replace("+", r"\+"), **{name: points})


@pytest.mark.parametrize(("call", "name"), [c for c in POINT_SETS if c[0] is not add_frame_points])
def test_counts_that_differ(call, name):
    refuses(
        call,
        ValueError,
        r"has [45] points and .* has [45]; each point needs its match",
        **{name: POINTS[:4]},
    )


@pytest.mark.parametrize("call", [triangulate, affine_transforms, warp_forward, warp_backward])
def test_fewer_than_three_points(call):
    both = [name for name in CALLS[call] if name in ("source", "target", "points_a", "points_b")]
    few = dict.fromkeys(both, POINTS[:2])
    refuses(call, ValueError, rf"^{both[0]} needs 3 or more points, but has 2\.$", **few)


def test_collinear_points():
    line = np.column_stack([np.arange(5.0), np.arange(5.0)])
    refuses(triangulate, ValueError, "lie on one line", points_a=line, points_b=line)
    refuses(
        affine_transforms,
        ValueError,
        r"^source: the corners of triangle 1 \(points 1, 3, 4\)",
        source=[(0, 0), (9, 0), (0, 7), (9, 6), (9, 3)],
    )


@pytest.mark.parametrize("name", ["points_a", "points_b"])
@pytest.mark.parametrize("call", [triangulate, morph_frames])
def test_duplicate_points(call, name):
    other = {"points_a": "points_b", "points_b": "points_a"}[name]
    points = np.vstack([POINTS[:4], [(4, 3), (2, 2), (5, 2), (2, 2)]])
    unlike = np.vstack([POINTS[:4], [(4, 3), (2, 3), (5, 2), (3, 2)]])
    match = rf"^{name}\[5\] and {name}\[7\] are the same point, \(2, 2\)"
    refuses(call, ValueError, match, **{name: points, other: unlike})


def test_points_that_swap_places():
    a = np.vstack([POINTS[:4], [(3, 3), (5, 3)]])
    b = np.vstack([POINTS[:4], [(5, 3), (3, 3)]])
    refuses(triangulate, ValueError, "points 4 and 5 meet", points_a=a, points_b=b)


def test_corner_that_leaves_its_place():
    at_corner, inside = [(0, 0), (4, 4)], [(1, 1), (4, 4)]
    for a, b, match in (
        (at_corner, inside, r"^points_a\[0\] is a corner of the image, but points_b\[0\] is not"),
        (inside, at_corner, r"^points_b\[0\] is a corner of the image, but points_a\[0\] is not"),
    ):
        refuses(morph_frames, ValueError, match, points_a=a, points_b=b)


# --- Triangles


@pytest.mark.parametrize(("call", "name"), cases("triangles"))
@pytest.mark.parametrize(
    ("bad", "error", "match"),
    [
        (TRIANGLES[0], ValueError, "three corners a row"),
        (TRIANGLES[:, :2], ValueError, "three corners a row"),
        (TRIANGLES[:0], ValueError, "three corners a row"),
        (TRIANGLES.astype(float), TypeError, "whole numbers, but is of type float64"),
        (TRIANGLES > 2, TypeError, "whole numbers, but is of type bool"),
        ([("a", "b", "c")], TypeError, "whole numbers, but is of type <U1"),
        (TRIANGLES + 1, ValueError, "0 to 4, but holds 5"),
        (TRIANGLES - 1, ValueError, "0 to 4, but holds -1"),
    ],
)
def test_triangles(call, name, bad, error, match):
    refuses(call, error, rf"^triangles must hold .*{match}", triangles=bad)


# --- Images

IMAGES = cases("image", "image_a", "image_b")


@pytest.mark.parametrize(("call", "name"), IMAGES)
@pytest.mark.parametrize(
    ("bad", "error", "match"),
    [
        (IMAGE > 3, TypeError, "bool"),
        (IMAGE + 1j, TypeError, "complex128"),
        (IMAGE.astype(object), TypeError, "object"),
        (IMAGE.astype(np.int64), TypeError, "int64"),
        (IMAGE.astype(np.int8), TypeError, "int8"),
        ("photo.png", TypeError, "<U9"),
        (None, TypeError, "object"),
        (IMAGE[:0], ValueError, r"has no pixels, its shape is \(0, 10, 3\)"),
        (IMAGE[:, :0], ValueError, r"has no pixels, its shape is \(8, 0, 3\)"),
        (IMAGE[:, :, :2], ValueError, r"but has shape \(8, 10, 2\)"),
        (IMAGE[None], ValueError, r"but has shape \(1, 8, 10, 3\)"),
        (IMAGE[0, 0], ValueError, r"but has shape \(3,\)"),
        (np.where(IMAGE == 9, math.nan, 1.0), ValueError, r"\[0, 3, 0\] is nan"),
        (np.where(IMAGE == 9, math.inf, 1.0), ValueError, r"\[0, 3, 0\] is inf"),
    ],
)
def test_images(call, name, bad, error, match):
    refuses(call, error, rf"^{name}.*{match}", **{name: bad})


@pytest.mark.parametrize("call", [morph, morph_frames])
def test_images_that_do_not_match(call):
    refuses(
        call,
        ValueError,
        r"^image_b is 9 × 7 pixels and image_a 10 × 8; .*\.resize\(\(10, 8\)\)",
        image_b=IMAGE[:7, :9],
    )
    refuses(call, ValueError, r"^image_b has the shape \(8, 10\)", image_b=IMAGE[:, :, 0])
    refuses(call, TypeError, r"^image_b is of type float64", image_b=IMAGE / 255)


@pytest.mark.parametrize(
    "shape", [(1, 1), (1, 5), (5, 1), (0, 4), (5,), (), "ab", 7, (4.0, 4), None]
)
def test_images_too_small_for_triangles(shape):
    match = rf"^shape must be .* but is {re.escape(repr(shape))}\.$"
    with pytest.raises((ValueError, TypeError), match=match):
        add_frame_points([(0, 0)], shape)


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (5, 1, 3)])
def test_morph_of_images_too_small_for_triangles(shape):
    image = np.zeros(shape, dtype=np.uint8)
    with pytest.raises(ValueError, match="image of 2 × 2 or more pixels"):
        morph(image, image, [(0, 0)], [(0, 0)], 0.5)


# --- Everything else


@pytest.mark.parametrize(
    ("bad", "error"),
    [
        (-0.01, ValueError),
        (1.01, ValueError),
        (math.nan, ValueError),
        ([0.5], ValueError),
        ("half", TypeError),
        (None, TypeError),
        (True, TypeError),
    ],
)
def test_moments(bad, error):
    refuses(morph, error, r"^t must", t=bad)


@pytest.mark.parametrize(
    ("bad", "error"), [(1, ValueError), (0, ValueError), (-5, ValueError), (2.5, TypeError)]
)
def test_counts_of_frames(bad, error):
    refuses(morph_frames, error, r"^count must be a whole number", count=bad)


@pytest.mark.parametrize("bad", ["cubic", "", None, 1, b"nearest", ["nearest"]])
def test_interpolation(bad):
    refuses(warp_backward, ValueError, r'^interpolation must be "bilinear"', interpolation=bad)


@pytest.mark.parametrize(
    ("bad", "error"),
    [
        (-1, ValueError),
        (256, ValueError),
        (0.5, ValueError),
        ([1, 2], ValueError),
        ([[1, 2, 3]], ValueError),
        (math.nan, ValueError),
        ("red", TypeError),
        (None, TypeError),
    ],
)
def test_fill(bad, error):
    refuses(warp_backward, error, r"^fill must", fill=bad)


# --- GIF

FRAMES = [IMAGE, IMAGE[::-1]]


@pytest.mark.parametrize(
    ("bad", "error", "match"),
    [
        ([], ValueError, "is empty"),
        (7, TypeError, "but is 7"),
        (None, TypeError, "but is None"),
        ([IMAGE, None], TypeError, r"\[1\] must be of type uint8"),
        ([IMAGE / 255], TypeError, r"\[0\] must be of type uint8, but is of type float64"),
        ([IMAGE, IMAGE[:4]], ValueError, r"\[1\] has the shape \(4, 10, 3\)"),
        (IMAGE, ValueError, "must be a list of images, but is one image"),
        ([IMAGE[:0]], ValueError, r"\[0\] has no pixels"),
    ],
)
def test_frames(tmp_path, bad, error, match):
    with pytest.raises(error, match=rf"^frames.*({match})"):
        save_gif(tmp_path / "film.gif", bad)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("bad", "error"),
    [(0, ValueError), (-1, ValueError), (51, ValueError), (math.nan, ValueError), ("1", TypeError)],
)
def test_frame_rates(tmp_path, bad, error):
    with pytest.raises(error, match=r"^fps must"):
        save_gif(tmp_path / "film.gif", FRAMES, bad)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("bad", "error"), [("", ValueError), (None, TypeError), (3, TypeError)])
def test_paths_that_are_none(bad, error):
    with pytest.raises(error, match=r"^path must"):
        save_gif(bad, FRAMES)


def test_a_path_that_cannot_be_written_leaves_nothing(tmp_path):
    (tmp_path / "folder.gif").mkdir()
    (tmp_path / "file").write_text("text", encoding="utf-8")
    before = sorted(tmp_path.rglob("*"))
    for path in ("missing/film.gif", "folder.gif", "file/film.gif", "x" * 300 + ".gif"):
        with pytest.raises(OSError, match=re.escape(path)):
            save_gif(tmp_path / path, FRAMES)
        assert sorted(tmp_path.rglob("*")) == before


def test_a_full_disk_leaves_the_old_film(tmp_path, monkeypatch):
    film = tmp_path / "film.gif"
    film.write_bytes(b"old")

    def write_half(self, data):
        with self.open("wb") as file:
            file.write(bytes(data)[:10])
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(type(film), "write_bytes", write_half)
    with pytest.raises(OSError, match="No space left on device"):
        save_gif(film, FRAMES)
    assert [path.name for path in tmp_path.iterdir()] == ["film.gif"]
    assert film.read_bytes() == b"old"
