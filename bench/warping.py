"""Time warping, morphing and GIF writing against scikit-image, OpenCV and Pillow."""

from __future__ import annotations

import io
import tempfile
from pathlib import Path

import cv2
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image
from scipy.ndimage import map_coordinates
from scipy.spatial import Delaunay
from skimage import data
from skimage.transform import PiecewiseAffineTransform, warp
from timing import Row, compare, typical

from canim.data import portraits
from canim.warping import (
    add_frame_points,
    affine_transforms,
    morph_frames,
    save_gif,
    warp_backward,
)

cv2.setNumThreads(1)


def mesh(size):
    """Return 75 key points, four of them the corners, before and after, and their triangles."""
    rng = np.random.default_rng(0)
    cells = np.stack(np.unravel_index(np.arange(71), (9, 8)), axis=1)
    inner = (cells + rng.uniform(0.3, 0.7, (71, 2))) * (size - 1) / (9, 8)
    moved = inner + rng.uniform(-0.1, 0.1, (71, 2)) * (size - 1) / (9, 8)
    source, target = (add_frame_points(points, (size, size)) for points in (inner, moved))
    return source, target, Delaunay(target).simplices


def exact_warp(image, source, target):
    """Look up every pixel's triangle and colour with SciPy."""
    y, x = np.mgrid[: image.shape[0], : image.shape[1]].astype(float)
    delaunay = Delaunay(target)
    triangle = delaunay.find_simplex(np.stack([x, y], axis=-1))
    assert (triangle >= 0).all()
    maps = affine_transforms(target, source, delaunay.simplices)[triangle]
    u, v, _ = np.einsum("yxij,jyx->iyx", maps, np.stack([x, y, np.ones_like(x)]))
    channels = np.moveaxis(image.astype(float), 2, 0)
    return np.stack(
        [map_coordinates(c, (v, u), order=1, mode="nearest") for c in channels], axis=-1
    )


def warp_triangles(image, source, target, triangles):
    """Warp triangle by triangle with OpenCV, cutting each out by a mask, as tutorials do."""
    warped = np.zeros_like(image)
    for corners in triangles:
        before, after = np.float32(source[corners]), np.float32(target[corners])
        (u, v, width, height) = cv2.boundingRect(before)
        part = image[v : v + height, u : u + width]
        (x, y, width, height) = cv2.boundingRect(after)
        affine = cv2.getAffineTransform(before - np.float32((u, v)), after - np.float32((x, y)))
        piece = cv2.warpAffine(
            part, affine, (width, height), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REFLECT_101
        )
        mask = np.zeros((height, width, 3), dtype=np.float32)
        cv2.fillConvexPoly(mask, np.int32(after - (x, y)), (1.0, 1.0, 1.0), cv2.LINE_AA, 0)
        place = warped[y : y + height, x : x + width]
        place[:] = place * ((1.0, 1.0, 1.0) - mask)
        place[:] = place + piece * mask
    return warped


def backward(size: int) -> list[Row]:
    image = np.random.default_rng(1).integers(0, 256, (size, size, 3), dtype=np.uint8)
    source, target, triangles = mesh(size)

    def ours():
        return warp_backward(image, source, target, triangles)

    difference = np.abs(ours() - np.floor(exact_warp(image, source, target) + 0.5)).max()
    assert difference <= 1, difference

    def scikit_image():
        return warp(image, PiecewiseAffineTransform.from_estimate(target, source))

    def opencv():
        return warp_triangles(image, source, target, triangles)

    name = f"`warp_backward`, {size} × {size} RGB, 75 key points"
    peer = "scikit-image `PiecewiseAffineTransform`, `warp`"
    return [
        compare(name, ours, {peer: scikit_image}, 35, repeats=5),
        compare(name, ours, {"OpenCV, triangle by triangle": opencv}, 1.5),
    ]


def large_portraits():
    image_a, image_b, a, b = portraits()
    scale = 511 / (np.array(image_a.shape[1::-1]) - 1)
    images = [np.array(Image.fromarray(image).resize((512, 512))) for image in (image_a, image_b)]
    return *images, a * scale, b * scale


def film() -> Row:
    pair = large_portraits()
    frames = morph_frames(*pair, 60)
    assert np.array_equal(frames[0], pair[0])
    assert np.array_equal(frames[-1], pair[1])
    seconds = typical({"canim": lambda: morph_frames(*pair, 60)}, repeats=3)["canim"]
    return Row("`morph_frames`, 60 of 512 × 512 RGB, each", seconds / 60, 1 / 20, "limit", 1)


def line_plots(count):
    figure, ax = plt.subplots(figsize=(4.8, 4.8), dpi=100)
    x = np.linspace(0, 6, 300)
    frames = []
    for k in range(count):
        ax.clear()
        ax.plot(x, np.sin(x + k / 10), x, np.cos(1.3 * x + k / 7), [k / 10], [0], "o")
        ax.set(ylim=(-1.2, 1.2), title=f"t = {k / 10}")
        figure.canvas.draw()
        frames.append(np.array(figure.canvas.buffer_rgba())[:, :, :3])
    plt.close(figure)
    return frames


def decibels(frames, file):
    with Image.open(file) as gif:
        errors = []
        for k, frame in enumerate(frames):
            gif.seek(k)
            errors.append(np.mean((np.asarray(gif.convert("RGB")).astype(float) - frame) ** 2))
    return 10 * np.log10(255**2 / np.mean(errors))


def gif() -> Row:
    cat, astronaut = (
        np.array(Image.fromarray(picture).resize((480, 480)))
        for picture in (data.chelsea(), data.astronaut())
    )
    frames = morph_frames(cat, astronaut, [(260, 240)], [(210, 120)], 60)

    def pillow():
        first, *others = map(Image.fromarray, frames)
        file = io.BytesIO()
        first.save(file, "GIF", save_all=True, append_images=others, duration=100, loop=0)
        return file

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.gif"
        save_gif(path, frames)
        loss = decibels(frames, pillow()) - decibels(frames, path)
        assert loss <= 0.5, loss
        row = compare(
            "`save_gif`, 60 photographs of 480 × 480",
            lambda: save_gif(path, frames),
            {"Pillow `save`": pillow},
            25,
            repeats=3,
        )
        drawings = line_plots(10)
        save_gif(path, drawings)
        kept = decibels(drawings, path)
        assert kept >= 40, kept
    return row


def rows() -> list[Row]:
    return [*backward(512), *backward(1024), film(), gif()]
