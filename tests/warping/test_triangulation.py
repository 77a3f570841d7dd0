"""Triangles, their maps and the pixels inside them, against SciPy, exact numbers and loops."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial import Delaunay

from canim.warping import add_frame_points, affine_transforms, triangulate
from canim.warping.triangulation import triangle_spans

CASES = json.loads((Path(__file__).parents[1] / "cases/warping.json").read_text("utf-8"))

grid = st.floats(0, 30).map(lambda x: round(x * 8) / 8)
triangle = arrays(float, (3, 2), elements=st.floats(-50, 50))


def pixel_triangles(points, triangles, shape):
    """Return the triangle of every pixel, -1 where there is none."""
    found = np.full(shape, -1)
    spans = triangle_spans(np.asarray(points, dtype=float), np.asarray(triangles), shape)
    for i, start, length in zip(*spans):
        assert length > 0
        assert start % shape[1] + length <= shape[1], "a span goes over the end of its row"
        run = found.reshape(-1)[start : start + length]
        assert (run == -1).all(), "two spans have the same pixel"
        run[:] = i
    return found


def double_area(corners):
    (ax, ay), (bx, by) = corners[1:] - corners[0]
    return ax * by - ay * bx


def edge_distances(points, triangles, shape):
    """Return the distance of every pixel to the nearest edge of a triangle."""
    y, x = np.mgrid[: shape[0], : shape[1]]
    pixels = np.stack([x, y], axis=-1).astype(float)
    nearest = np.full(shape, np.inf)
    for i, j in {tuple(sorted(e)) for t in triangles for e in (t[:2], t[1:], t[::2])}:
        a, edge = points[i], points[j] - points[i]
        t = np.clip((pixels - a) @ edge / (edge @ edge), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(pixels - a - t[..., None] * edge, axis=-1))
    return nearest


# --- Frame points and triangulation


def test_frame_points_follow_the_points():
    framed = add_frame_points([[3, 2], [4, 4]], (6, 8, 3))
    assert framed.tolist() == [[3, 2], [4, 4], [0, 0], [7, 0], [0, 5], [7, 5]]
    assert add_frame_points([], (2, 2)).tolist() == [[0, 0], [1, 0], [0, 1], [1, 1]]
    assert add_frame_points(np.zeros((0, 2)), np.zeros((3, 4)).shape).shape == (4, 2)


@pytest.mark.parametrize("case", CASES["delaunay"], ids=lambda case: case["about"])
def test_triangulation_by_hand(case):
    triangles = triangulate(case["points"], case["points"])
    assert sorted(map(sorted, triangles.tolist())) == case["triangles"]


def test_triangulation_is_that_of_the_mean_points():
    rng = np.random.default_rng(0)
    a, b = rng.uniform(0, 100, (2, 30, 2))
    triangles = triangulate(a, b)
    assert {*map(frozenset, triangles)} == {*map(frozenset, Delaunay((a + b) / 2).simplices)}
    assert {*map(frozenset, triangles)} == {*map(frozenset, triangulate(b, a))}
    assert {*map(frozenset, triangles)} != {*map(frozenset, triangulate(a, a))}


@given(arrays(float, st.tuples(st.integers(3, 12), st.just(2)), elements=grid))
def test_no_circle_of_a_triangle_has_a_point_inside(points):
    assume(len(np.unique(points, axis=0)) == len(points))
    assume(np.linalg.matrix_rank(points - points[0]) == 2)
    triangles = triangulate(points, points)
    for corners in points[triangles]:
        # The centre is as far from all three: 2 (q - p) · c = |q|² - |p|².
        edges = corners[1:] - corners[0]
        squares = (corners[1:] ** 2).sum(axis=1) - (corners[0] ** 2).sum()
        centre = np.linalg.solve(2 * edges, squares)
        radius = np.linalg.norm(corners[0] - centre)
        assert (np.linalg.norm(points - centre, axis=1) >= radius * (1 - 1e-9) - 1e-9).all()


# --- Affine maps


@pytest.mark.parametrize("case", CASES["affine"], ids=lambda case: case["about"])
def test_affine_by_hand(case):
    (found,) = affine_transforms(case["source"], case["target"], [(0, 1, 2)])
    np.testing.assert_allclose(found, case["map"], rtol=0, atol=1e-14)
    (again,) = affine_transforms(case["source"], case["target"], [(2, 0, 1)])
    np.testing.assert_allclose(again, case["map"], rtol=0, atol=1e-14)


@given(triangle, triangle)
def test_affine_takes_corners_to_corners(source, target):
    assume(abs(double_area(source)) > 10)
    (found,) = affine_transforms(source, target, [(0, 1, 2)])
    columns = found @ np.vstack([source.T, [1, 1, 1]])
    np.testing.assert_allclose(columns, np.vstack([target.T, [1, 1, 1]]), rtol=0, atol=1e-8)


@given(triangle, triangle)
def test_affine_there_and_back_is_nothing(source, target):
    for points in (source, target):
        assume(abs(double_area(points)) > 10)
    (there,) = affine_transforms(source, target, [(0, 1, 2)])
    (back,) = affine_transforms(target, source, [(0, 1, 2)])
    np.testing.assert_allclose(back @ there, np.eye(3), rtol=0, atol=1e-6)


# --- The pixels of triangles


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("shape", [(64, 64), (33, 120), (120, 33)])
def test_pixels_are_those_of_scipy(seed, shape):
    rng = np.random.default_rng(seed)
    inner = rng.uniform(0, np.array(shape[::-1]) - 1, (40, 2))
    for points in (add_frame_points(inner, shape), inner):
        delaunay = Delaunay(points)
        found = pixel_triangles(points, delaunay.simplices, shape)
        y, x = np.mgrid[: shape[0], : shape[1]]
        expected = delaunay.find_simplex(np.stack([x, y], axis=-1).astype(float))
        same = (found == expected) | (edge_distances(points, delaunay.simplices, shape) <= 1e-9)
        assert same.all()


@given(st.integers(0, 2**32), st.integers(2, 40), st.integers(2, 40), st.integers(0, 20))
def test_no_pixel_of_a_framed_image_is_left_out(seed, height, width, count):
    inner = np.random.default_rng(seed).uniform(0, (width - 1, height - 1), (count, 2))
    points = add_frame_points(inner, (height, width))
    assert (pixel_triangles(points, triangulate(points, points), (height, width)) >= 0).all()


def in_triangle(corners, x, y):
    """Tell whether a pixel lies in a triangle or on its edge, exactly (corners on 1/8 pixels)."""
    signs = [
        (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0))
    ]
    return min(signs) >= 0 or max(signs) <= 0


@given(arrays(float, st.tuples(st.integers(3, 9), st.just(2)), elements=grid), st.data())
def test_pixels_of_any_triangles(points, data):
    corners = data.draw(
        st.lists(st.permutations(range(len(points))).map(lambda p: p[:3]), min_size=1, max_size=6)
    )
    shape = data.draw(st.tuples(st.integers(1, 31), st.integers(1, 31)))
    found = pixel_triangles(points, corners, shape)
    areas = [double_area(points[list(c)]) for c in corners]
    for y, x in np.ndindex(shape):
        inside = {
            i
            for i, c in enumerate(corners)
            if abs(areas[i]) > 1e-6 and in_triangle(points[list(c)], x, y)
        }
        if inside:
            assert found[y, x] in inside
        else:
            assert found[y, x] == -1


def test_flat_triangles_have_no_pixels():
    points = np.array([(0, 0), (4, 4), (8, 8), (8, 0)], dtype=float)
    assert (pixel_triangles(points, [(0, 1, 2), (0, 0, 3)], (9, 9)) == -1).all()
    assert set(np.unique(pixel_triangles(points, [(0, 1, 2), (0, 2, 3)], (9, 9)))) == {-1, 1}
