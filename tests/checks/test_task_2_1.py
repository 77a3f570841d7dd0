"""Task 2.1: however the pixels are sent, each must arrive, and none elsewhere."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from canim import checks, warping

TASK = checks.TASKS["2.1"]
HOLE = (255, 0, 255)


def by_solving(source, target):
    ones = np.ones((3, 1))
    return np.linalg.solve(np.hstack([source, ones]), np.hstack([target, ones])).T


def with_canim(image, source, target, triangles):
    """Leave what is outside of the image alone; canim refuses such points."""
    big = np.pad(image, ((30, 30), (30, 30), (0, 0)))
    warped, filled = warping.warp_forward(big, source + 30, target + 30, triangles)
    warped[~filled] = HOLE
    return warped[30:-30, 30:-30]


def results(affine_map=by_solving, warp_forward=with_canim):
    report = checks.run(TASK, {"affine_map": affine_map, "warp_forward": warp_forward}, hint=True)
    return {result.part: result for result in report.results}


def states(**functions):
    return [result.state for result in results(**functions).values()]


def pixel_by_pixel(round_to):
    """Return a program that looks for the triangle of each pixel, and goes to the next then."""

    def warp_forward(image, source, target, triangles):
        height, width = image.shape[:2]
        warped = [[list(HOLE) for _ in range(width)] for _ in range(height)]
        for u in range(width):
            for v in range(height):
                for corners in triangles[::-1]:
                    ones = np.ones((3, 1))
                    T = np.hstack([source[corners], ones])
                    weights = np.linalg.solve(T.T, [u, v, 1])
                    if np.all(weights > -1e-9):
                        x, y = (round_to(c) for c in weights @ target[corners])
                        if 0 <= x < width and 0 <= y < height:
                            warped[y][x] = image[v][u].tolist()
                        break
        return warped

    return warp_forward


@pytest.mark.parametrize("round_to", [round, lambda c: int(np.floor(c + 0.5))])
def test_loops_over_pixels_in_any_order_and_lists_are_accepted(round_to):
    assert states(warp_forward=pixel_by_pixel(round_to)) == ["done"] * 5


def test_canims_own_function_is_right_and_is_told(monkeypatch):
    assert states() == ["done"] * 5
    report = checks.run(TASK, {"affine_map": by_solving, "warp_forward": with_canim})
    assert report.notes == ("warp_forward uses canim's function.",)


def test_bounds_may_be_left_to_an_error_that_is_caught():
    """Only places beyond the last row or column are errors; those below 0 need a question."""

    def warp_forward(image, source, target, triangles):
        warped = np.full(image.shape, HOLE)
        v, u = np.mgrid[: image.shape[0], : image.shape[1]]
        for corners in triangles:
            A = by_solving(source[corners], target[corners])
            to_weights = np.linalg.inv(np.vstack([source[corners].T, np.ones(3)]))
            for a, b in zip(u.ravel(), v.ravel()):
                if min(to_weights @ [a, b, 1]) >= -1e-9:
                    x, y = np.rint(A @ [a, b, 1]).astype(int)[:2]
                    try:
                        if min(x, y) >= 0:
                            warped[y, x] = image[b, a]
                    except IndexError:
                        pass
        return warped

    assert states(warp_forward=warp_forward) == ["done"] * 5


def test_a_wrong_number_of_the_map_is_named():
    def affine_map(source, target):
        return by_solving(source, target) + np.array([[0, 0, 0], [0, 0, 3], [0, 0, 0]])

    message = results(affine_map=affine_map)["affine map"].message
    assert "to B, row 1, column 2 of A: expected " in message


def test_a_forgotten_bound_is_told_with_the_students_line():
    def warp_forward(image, source, target, triangles):
        warped = np.full(image.shape, HOLE)
        warped[20, 3] = image[0, 0]
        return warped

    found = results(warp_forward=warp_forward)
    assert found["inside"].state == "crashed"
    assert "warped[20, 3]" in found["inside"].message


def test_an_image_that_is_not_changed_is_not_done():
    found = results(warp_forward=lambda image, *_: image)
    assert found["inside"].message.startswith(
        "20 × 20 image, at (0, 0): expected a hole, got a colour ("
    )
    assert found["colour"].state == "differs"


def test_one_lost_pixel_is_found_and_named():
    def warp_forward(*args):
        warped = with_canim(*args)
        warped[5, 4] = HOLE
        return warped

    found = results(warp_forward=warp_forward)
    assert found["inside"].message == "20 × 20 image, at (4, 5): expected a colour, got a hole"


def test_colours_are_told_by_the_pixel_they_come_from():
    def warp_forward(*args):
        warped = with_canim(*args)
        filled = (warped != HOLE).any(axis=2)
        warped[filled] = np.where(warped[filled] == 0, 8, warped[filled])
        return warped

    message = results(warp_forward=warp_forward)["colour"].message
    assert "expected the colour of pixel (0, 0), got the colour of pixel (1, 1)" in message


def test_a_colour_of_no_pixel_is_told_by_its_numbers():
    def warp_forward(*args):
        warped = with_canim(*args)
        warped[(warped != HOLE).any(axis=2)] //= 3
        return warped

    message = results(warp_forward=warp_forward)["colour"].message
    assert "got the colour (0, 0, 2)" in message


def test_where_a_pixel_could_come_from_another_one_nothing_is_wrong():
    """Of pixels that arrive at the same place, the first may stay as well as the last."""

    def keep_the_first(image, source, target, triangles):
        return with_canim(image[::-1, ::-1], *_turned(image, source, target), triangles)[::-1, ::-1]

    def _turned(image, *points):
        return (np.array(image.shape[1::-1]) - 1 - p for p in points)

    assert not np.array_equal(
        keep_the_first(*TASK.parts[3].cases[0].args), with_canim(*TASK.parts[3].cases[0].args)
    )
    assert states(warp_forward=keep_the_first) == ["done"] * 5


def test_a_pixel_that_belongs_elsewhere_is_wrong_even_if_the_place_is_filled():
    def warp_forward(*args):
        warped = with_canim(*args)
        y, x = np.argwhere((warped != HOLE).any(axis=2))[[0, -1]].T
        warped[y, x] = warped[y[::-1], x[::-1]]
        return warped

    assert states(warp_forward=warp_forward)[1:] == ["done", "done", "differs", "differs"]


def test_a_lost_edge_is_recognised_also_where_only_rounding_loses_it():
    def warp_forward(image, source, target, triangles):
        warped = np.full(image.shape, HOLE)
        v, u = np.mgrid[: image.shape[0], : image.shape[1]]
        for corners in triangles:
            A = by_solving(source[corners], target[corners])
            T = np.vstack([source[corners].T, np.ones(3)])
            for a, b in zip(u.ravel(), v.ravel()):
                # A weight of 0 comes out above or below it.
                weights = np.linalg.inv(T) @ [a, b, 1] + 1e-12 * np.sin(7 * a + b)
                x, y = np.rint(A @ [a, b, 1]).astype(int)[:2]
                if min(weights) >= 0 and 0 <= x < len(image[0]) and 0 <= y < len(image):
                    warped[y, x] = image[b, a]
        return warped

    found = results(warp_forward=warp_forward)["inside"]
    assert found.mistake == "edges left out"


def test_the_triangles_of_the_check_fold_if_they_are_made_from_the_source_alone():
    _, source, target, triangles = TASK.parts[2].cases[0].args

    def sides(points, triangles):
        return np.sign(np.linalg.det(np.diff(points[triangles], axis=1)))

    assert np.array_equal(sides(source, triangles), sides(target, triangles))
    of_source = Delaunay(source).simplices
    assert not np.array_equal(sides(source, of_source), sides(target, of_source))


@pytest.mark.parametrize("part", TASK.parts[1:], ids=lambda part: part.name)
def test_no_place_in_the_check_is_so_near_to_a_half_that_rounding_decides(part):
    for case in part.cases:
        image, source, target, triangles = case.args
        v, u = np.mgrid[: image.shape[0], : image.shape[1]]
        for corners in triangles:
            A = by_solving(source[corners], target[corners])
            x, y, _ = A @ [u.ravel(), v.ravel(), np.ones(u.size)]
            for places in (x, y):
                assert np.abs(places % 1 - 0.5).min() > 1e-7
