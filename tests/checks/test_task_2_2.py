"""Task 2.2: however the pixels are asked, each must get the mix of the right four."""

import numpy as np
import pytest

from canim import checks, warping

TASK = checks.TASKS["2.2"]
HOLE = (255, 0, 255)


def mix(image, u, v):
    """Weigh the four pixels by areas, each looked at on its own."""
    total = np.zeros(3)
    for row in range(image.shape[0]):
        for column in range(image.shape[1]):
            share = max(0, 1 - abs(u - column)) * max(0, 1 - abs(v - row))
            if share:
                total += share * image[row, column]
    return total


def with_canim(image, source, target, triangles):
    """Leave what is outside of the image alone; canim refuses such points."""
    big = np.pad(image, ((9, 9), (9, 9), (0, 0)), mode="edge").astype(float)
    warped = warping.warp_backward(big, source + 9, target + 9, triangles, fill=HOLE)
    return np.round(warped[9:-9, 9:-9]).astype(np.uint8)


def results(bilinear=mix, warp_backward=with_canim):
    report = checks.run(TASK, {"bilinear": bilinear, "warp_backward": warp_backward}, hint=True)
    return {result.part: result for result in report.results}


def states(**functions):
    return [result.state for result in results(**functions).values()]


def pixel_by_pixel(finish):
    """Return a program that looks for the triangle of each pixel, and goes to the next then."""

    def warp_backward(image, source, target, triangles):
        height, width = image.shape[:2]
        warped = [[list(HOLE) for _ in range(width)] for _ in range(height)]
        for x in range(width):
            for y in range(height):
                for corners in triangles[::-1]:
                    T = np.hstack([target[corners], np.ones((3, 1))])
                    weights = np.linalg.solve(T.T, [x, y, 1])
                    if np.all(weights > -1e-9):
                        u, v = weights @ source[corners]
                        warped[y][x] = finish(mix(image, u, v))
                        break
        return warped

    return warp_backward


def half_up(colour):
    return np.floor(colour + 0.5).astype(int).tolist()


@pytest.mark.parametrize("finish", [np.rint, half_up, list], ids=["even", "up", "decimals"])
def test_loops_in_any_order_and_any_rounding_are_accepted(finish):
    assert states(warp_backward=pixel_by_pixel(finish)) == ["done"] * 5


def test_canims_own_function_is_right_and_is_told():
    assert states() == ["done"] * 5
    report = checks.run(TASK, {"bilinear": mix, "warp_backward": with_canim})
    assert report.notes == ("warp_backward uses canim's function.",)


def test_an_image_that_is_not_changed_is_told_by_the_place_of_its_colours():
    message = results(warp_backward=lambda image, *_: image)["place"].message
    assert "expected the colour at (" in message
    assert "got the colour at (" in message


def test_a_hole_is_told():
    def warp_backward(*args):
        warped = with_canim(*args)
        warped[7, 3] = HOLE
        return warped

    found = results(warp_backward=warp_backward)
    assert found["inside"].message == "20 × 20 image, at (3, 7): expected a colour, got a hole"
    assert found["place"].message.endswith("got a hole")
    assert found["colour"].message.endswith("got a hole")


def test_other_colours_are_told_by_their_numbers():
    def warp_backward(*args):
        return with_canim(*args) // 3

    found = results(warp_backward=warp_backward)
    assert "got the colour (" in found["place"].message
    assert "got (" in found["colour"].message
    assert "got the colour" not in found["colour"].message


def test_a_colour_that_is_two_levels_off_is_wrong():
    def warp_backward(*args):
        warped = with_canim(*args)
        warped[5, 5, 0] += 2
        return warped

    assert states(warp_backward=warp_backward)[2:] == ["differs"] * 3


def test_a_wrong_mix_does_not_stop_a_warp_that_does_without_it():
    found = results(bilinear=lambda image, u, v: image[0, 0])
    assert [result.state for result in found.values()] == ["differs", *["done"] * 4]
    assert found["bilinear"].message.startswith("red at (3.25, 7): expected ")


def test_a_place_is_tried_in_the_last_row_and_column():
    def forgets_the_rim(image, u, v):
        column, row = int(u), int(v)
        f, g = u - column, v - row
        upper = (1 - f) * image[row, column] + f * image[row, column + 1]
        lower = (1 - f) * image[row + 1, column] + f * image[row + 1, column + 1]
        return (1 - g) * upper + g * lower

    found = results(bilinear=forgets_the_rim)["bilinear"]
    assert found.state == "crashed"


def test_a_lost_edge_is_recognised_also_where_only_rounding_loses_it():
    def warp_backward(image, source, target, triangles):
        warped = with_canim(image, source, target, triangles)
        filled = np.argwhere((warped != HOLE).any(axis=2))
        for y, x in filled:
            # Of the pixels on an edge, every second one is lost.
            if (x == 2 or y == 2) and (x + y) % 2:
                warped[y, x] = HOLE
        return warped

    assert results(warp_backward=warp_backward)["inside"].mistake == "edges left out"
