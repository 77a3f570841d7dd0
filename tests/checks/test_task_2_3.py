"""Task 2.3: a morph is right however its images are warped, and rounded once at most."""

import numpy as np
import pytest

from canim import checks, warping

TASK = checks.TASKS["2.3"]


def between(points_a, points_b, t):
    return points_a + t * (points_b - points_a)


def morph(image_a, image_b, points_a, points_b, triangles, t):
    points = between(points_a, points_b, t)
    a = warping.warp_backward(image_a.astype(float), points_a, points, triangles)
    b = warping.warp_backward(image_b.astype(float), points_b, points, triangles)
    return np.floor(a + t * (b - a) + 0.5).astype(np.uint8)


def results(**changed):
    functions = {"points_between": between, "morph": morph} | changed
    return {r.part: r for r in checks.run(TASK, functions, hint=True).results}


def states(**changed):
    return [result.state for result in results(**changed).values()]


def test_a_morph_that_is_calculated_in_another_way_is_right():
    assert states() == ["done"] * 4


def test_canims_morph_is_right_up_to_its_bytes_and_is_told():
    def exact(image_a, image_b, points_a, points_b, triangles, t):
        a, b = image_a.astype(float), image_b.astype(float)
        return warping.morph(a, b, points_a, points_b, t, triangles)

    assert states(morph=exact) == ["done"] * 4
    report = checks.run(TASK, {"points_between": between, "morph": exact})
    assert report.notes == ("morph uses canim's function.",)


def test_points_may_be_lists():
    def lists(points_a, points_b, t):
        return [
            [(1 - t) * xa + t * xb, (1 - t) * ya + t * yb]
            for (xa, ya), (xb, yb) in zip(points_a, points_b)
        ]

    assert states(points_between=lists) == ["done"] * 4


def test_a_wrong_point_is_named():
    def wrong(points_a, points_b, t):
        points = between(points_a, points_b, t)
        points[1, 1] += 1
        return points

    message = results(points_between=wrong)["points in between"].message
    assert message.startswith("t = 0.25, y of point 1: expected ")


def test_one_warp_may_be_written_first():
    def only_a(image_a, image_b, points_a, points_b, triangles, t):
        return morph(image_a, 0 * image_b, points_a, points_b, triangles, t)

    assert states(morph=only_a) == ["done", "done", "differs", "differs"]


def test_a_wrong_colour_is_told_with_its_moment():
    def brighter(*args):
        return np.minimum(morph(*args) + 3.0, 255)

    message = results(morph=brighter)["blend"].message
    assert message.startswith("t = 0.3, 20 × 20 image, at (0, 0): expected the colour (131.3, ")
    assert "got the colour (134, 134, 134)" in message


@pytest.mark.parametrize("t", [0, 1])
def test_the_ends_are_tried(t):
    def wrong_at_an_end(*args):
        image = morph(*args).astype(float)
        return image[:, ::-1] if args[-1] == t else image

    assert "differs" in states(morph=wrong_at_an_end)
