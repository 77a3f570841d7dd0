"""The pictures and key points that come with canim."""

from __future__ import annotations

import io
import json
import re
import runpy
import warnings
import zlib
from importlib import metadata, resources

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from canim.data import ImagePair, keypoints, portraits, read_image, toy_triangles
from canim.warping import morph_frames, triangulate

FOLDER = resources.files("canim.data") / "portraits"


# --- Toy triangles


def test_toy_triangles_at_their_first_size(root):
    pair = toy_triangles()
    toy = json.loads((root / "tests/cases/warping.json").read_text("utf-8"))["toy"]
    assert isinstance(pair, ImagePair)
    assert pair.points_a.tolist() == toy["points_a"] == keypoints("toy_a").tolist()
    assert pair.points_b.tolist() == toy["points_b"] == keypoints("toy_b").tolist()


@pytest.mark.parametrize("size", [16, 160, 256])
def test_toy_triangles_are_where_their_points_are(size):
    image_a, image_b, points_a, points_b = toy_triangles(size)
    np.testing.assert_allclose(points_a, keypoints("toy_a") * (size - 1) / 255)
    for image, points, colour in (
        (image_a, points_a, (0, 158, 115)),
        (image_b, points_b, (230, 159, 0)),
    ):
        assert image.shape == (size, size, 3)
        assert image.dtype == np.uint8
        x, y = points.mean(axis=0).round().astype(int)
        assert tuple(image[y, x]) == colour
        assert tuple(image[0, 0]) == tuple(image[-1, -1]) == (243, 243, 240)
        # The ink on the page is the triangle's area.
        ground, ink = image[0, 0].astype(float), np.array(colour, dtype=float)
        cover = ((image - ground) @ (ink - ground)).sum() / ((ink - ground) @ (ink - ground))
        (ax, ay), (bx, by) = points[1] - points[0], points[2] - points[0]
        assert cover == pytest.approx(abs(ax * by - ay * bx) / 2, rel=0.02, abs=1.5)


@pytest.mark.parametrize(
    ("size", "error"), [(15, ValueError), (-1, ValueError), (2.5, TypeError), (None, TypeError)]
)
def test_toy_triangles_of_no_size(size, error):
    with pytest.raises(error, match=r"^size must be a whole number"):
        toy_triangles(size)


# --- Portraits


def test_no_triangle_of_the_portraits_folds():
    image_a, image_b, points_a, points_b = portraits()
    assert image_a.shape == image_b.shape == (400, 360, 3)
    assert points_a.shape == points_b.shape == (48, 2)
    assert len(triangulate(points_a, points_b)) > 70
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        frames = morph_frames(image_a[::, ::], image_b, points_a, points_b, 11)
    assert frames[5].std() > 30


def test_portraits_are_made_from_the_pictures_they_name(root, tmp_path):
    made = runpy.run_path(str(root / "docs/portraits.py"))
    made["write"](tmp_path)
    pins = (root / "constraints.txt").read_text("utf-8")
    pinned = f"\npillow=={metadata.version('pillow')} " in pins
    for name in ("collins.jpg", "hopper.jpg"):
        again, ours = (tmp_path / name).read_bytes(), (FOLDER / name).read_bytes()
        levels = [np.asarray(Image.open(io.BytesIO(data)), dtype=float) for data in (again, ours)]
        assert np.abs(levels[0] - levels[1]).max() <= 8
        if pinned:
            assert again == ours, "run nox -s portraits"
    sources = (FOLDER / "SOURCES.md").read_text("utf-8")
    for portrait in made["PORTRAITS"]:
        row = next(line for line in sources.splitlines() if line.startswith(f"| `{portrait.name}"))
        assert row.endswith(f"| {', '.join(map(str, portrait.box))} |")
        assert portrait.digest in sources


def test_each_call_gives_its_own_arrays():
    first, second = portraits(), portraits()
    for one, two in zip(first, second, strict=True):
        one[:] = 0
        assert two.any()
    keypoints("toy_a")[:] = 0
    assert keypoints("toy_a").any()


@pytest.mark.parametrize("name", ["", "Collins", "toy", None, 3, ["toy_a"]])
def test_unknown_key_points(name):
    known = '"collins", "hopper", "toy_a", "toy_b"'
    with pytest.raises(
        ValueError, match=f"^name must be one of {known}, but is {re.escape(repr(name))}"
    ):
        keypoints(name)


# --- Picture files


def save(path, array, **options):
    Image.fromarray(array).save(path, **options)
    return path


def test_read_image_keeps_colours(tmp_path):
    rgb = np.random.default_rng(0).integers(0, 256, (7, 5, 3), dtype=np.uint8)
    found = read_image(save(tmp_path / "rgb.png", rgb))
    assert found.dtype == np.uint8
    assert found.flags.writeable
    assert np.array_equal(found, rgb)
    grey = read_image(str(save(tmp_path / "grey.png", rgb[:, :, 0])))
    assert np.array_equal(grey, np.repeat(rgb[:, :, :1], 3, axis=2))


def test_read_image_shows_white_through(tmp_path):
    rgba = np.zeros((1, 3, 4), dtype=np.uint8)
    rgba[0, 1] = (0, 0, 0, 255)
    rgba[0, 2] = (0, 0, 0, 51)
    found = read_image(save(tmp_path / "rgba.png", rgba))
    assert found[0].tolist() == [[255] * 3, [0] * 3, [204] * 3]


def test_read_image_turns_photographs_upright(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6  # The camera was held on its side.
    lying = np.zeros((20, 40, 3), dtype=np.uint8)
    assert read_image(save(tmp_path / "photo.jpg", lying, exif=exif)).shape == (40, 20, 3)


def test_read_image_brings_the_middle_to_a_size(tmp_path):
    wide = np.zeros((20, 60, 3), dtype=np.uint8)
    wide[:, 20:40] = 255
    path = save(tmp_path / "wide.png", wide)
    assert np.array_equal(read_image(path, size=(20, 20)), np.full((20, 20, 3), 255))
    assert read_image(path, size=[7, 900]).shape == (900, 7, 3)


@pytest.mark.parametrize(
    ("size", "kind", "told"),
    [
        (640, TypeError, r"^size must be \(width, height\), but is 640"),
        ((640,), ValueError, r"^size must be \(width, height\), but is \(640,\)"),
        ((3, 4, 3), ValueError, r"^size must be \(width, height\), but is \(3, 4, 3\)"),
        ((480, 640.0), TypeError, r"^size must be a whole number, but is 640\.0"),
        ((0, 640), ValueError, r"^size must be a whole number from 1 up, but is 0"),
    ],
)
def test_read_image_refuses_what_is_no_size(tmp_path, size, kind, told):
    path = save(tmp_path / "x.png", np.zeros((4, 4, 3), dtype=np.uint8))
    with pytest.raises(kind, match=told):
        read_image(path, size=size)


@pytest.mark.parametrize("dtype", [np.uint16, np.int32, np.float32])
def test_read_image_refuses_deep_pictures(tmp_path, dtype):
    path = save(tmp_path / "deep.tif", np.full((4, 4), 1000, dtype=dtype))
    with pytest.raises(ValueError, match=r"^path: .*deep\.tif holds greys of more than 8 bits"):
        read_image(path)


def test_read_image_reads_colours_of_16_bits(tmp_path):
    # Pillow writes none: one row of two pixels, (0, 128, 255) and (255, 1, 16) in the high bytes.
    row = b"\0" + bytes([0, 0, 128, 7, 255, 255, 255, 0, 1, 2, 16, 250])
    header = (2).to_bytes(4) + (1).to_bytes(4) + bytes([16, 2, 0, 0, 0])
    chunks = [(b"IHDR", header), (b"IDAT", zlib.compress(row)), (b"IEND", b"")]
    (tmp_path / "deep.png").write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + b"".join(
            len(data).to_bytes(4) + name + data + zlib.crc32(name + data).to_bytes(4)
            for name, data in chunks
        )
    )
    assert read_image(tmp_path / "deep.png").tolist() == [[[0, 128, 255], [255, 1, 16]]]


@pytest.mark.parametrize(
    ("head", "what"),
    [
        (b"\0\0\0\x18ftypheic\0\0\0\0mif1heic", "is a HEIC photograph, as phones make them"),
        (b"\0\0\0\x24ftypmif1\0\0\0\0mif1heix", "is a HEIC photograph"),
        (b"\0\0\0\x1cftyphevc\0\0\0\0", "is a HEIC photograph"),
        (b"\0\0\0\x20ftypavif\0\0\0\0", "is an AVIF picture"),
        (b"\0\0\0\x14ftypqt  \0\0\0\0", "is a film"),
        (b"\0\0\0\x20ftypisom\0\0\0\0", "is a film"),
        (b"\xff\x0a\xfa\x1f", "is a JPEG XL picture"),
        (b"\0\0\0\x0cJXL \r\n\x87\n", "is a JPEG XL picture"),
        (b"%PDF-1.7\n", "is a PDF document"),
        (b'<?xml version="1.0"?>\n<!-- a -->\n<svg xmlns="x">', "is an SVG drawing"),
        (b"<html>a page</html>", "cannot be read as a picture"),
        (b"", "cannot be read as a picture"),
    ],
)
def test_read_image_says_what_to_do_with_what_it_does_not_read(tmp_path, head, what):
    path = tmp_path / "photo.jpg"  # Who sends a file may give it a name that is not true.
    path.write_bytes(head)
    ending = "Open it in a program that shows it, and save it as JPEG or PNG."
    with pytest.raises(ValueError, match=rf"^path: .*photo\.jpg {what}.*\. {ending}$"):
        read_image(path)


@pytest.mark.parametrize("path", [None, 3, b"x.png", ["x.png"]])
def test_read_image_refuses_what_is_no_name(path):
    with pytest.raises(TypeError, match=r"^path must be the name of a file"):
        read_image(path)


def test_read_image_of_no_file(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"missing\.png"):
        read_image(tmp_path / "missing.png")


@given(st.sampled_from(["PNG", "JPEG", "GIF", "TIFF"]), st.data())
def test_read_image_of_a_damaged_file(tmp_path_factory, kind, data):
    buffer = io.BytesIO()
    Image.fromarray(toy_triangles(16).image_a).save(buffer, kind)
    damaged = bytearray(buffer.getvalue())
    for place in data.draw(st.lists(st.integers(0, len(damaged) - 1), max_size=5)):
        damaged[place] ^= data.draw(st.integers(1, 255))
    damaged = damaged[: data.draw(st.integers(0, len(damaged)))]
    path = tmp_path_factory.mktemp("damaged") / "picture"
    path.write_bytes(damaged)
    refusal = ""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            assert read_image(path).shape[2] == 3
        except ValueError as error:
            refusal = str(error)
    assert refusal == "" or refusal.startswith(f"path: {path} ")
