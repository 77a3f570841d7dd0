"""Task 1.8: any smooth closed shape is right, and each joint is judged on its own."""

import numpy as np
import pytest

from canim import checks, interpolation

TASK = checks.TASKS["1.8"]
JOINTS = ["joint 1 to 2", "joint 2 to 3", "joint 3 to 4", "joint 4 to 1"]
RIGHT = {
    "next_handle": interpolation.next_control_point,
    "transform": interpolation.transform_points,
}


def results(**functions):
    report = checks.run(TASK, functions, hint=True)
    return {result.part: result for result in report.results}


def joints(shape):
    found = results(**RIGHT, closed_shape=lambda: shape)
    return [found[joint].state for joint in JOINTS]


def smooth(points, handles):
    """Return a closed C1 shape through four points, with these handles leaving them."""
    following = np.roll(points, -1, axis=0), np.roll(handles, -1, axis=0)
    return np.stack([points, handles, 2 * following[0] - following[1], following[0]], axis=1)


def ellipse():
    corners = np.array([[3.0, 0], [0, 2], [-3, 0], [0, -2]])
    return smooth(corners, corners + 0.5523 * np.array([[0, 2], [-3, 0], [0, -2], [3, 0]]))


def eight():
    points = np.array([[0.0, 0], [8, 0], [0, 0], [-8, 0]])
    return smooth(points, points + np.array([[3, 4], [0, -5], [-3, 4], [0, -5]]))


@pytest.mark.parametrize(
    "shape",
    [
        ellipse(),
        eight(),
        (1e-2 * ellipse()).tolist(),
        1000 * eight() + 50,
        ellipse() + 1e4,
        np.round(ellipse(), 4).tolist(),
        [[tuple(point) for point in segment] for segment in eight()],
    ],
    ids=["ellipse", "eight", "small", "large and away", "far away", "rounded", "tuples"],
)
def test_any_smooth_closed_shape_is_right(shape):
    assert joints(shape) == ["done"] * 4


@pytest.mark.parametrize("seed", range(5))
def test_random_smooth_shapes_are_right_and_random_points_are_not(seed):
    random = np.random.default_rng(seed)
    points, handles = random.uniform(-20, 20, (2, 4, 2))
    assert joints(smooth(points, handles)) == ["done"] * 4
    assert joints(random.uniform(-20, 20, (4, 4, 2))) == ["differs"] * 4


@pytest.mark.parametrize("joint", range(4))
@pytest.mark.parametrize(("size", "away"), [(1, 0), (100, 0), (1e-3, 0), (1, 1000)])
def test_a_small_kink_is_found_at_its_joint_and_nowhere_else(joint, size, away):
    shape = size * ellipse() + away
    shape[(joint + 1) % 4, 1] += 0.02 * size
    assert joints(shape) == ["differs" if k == joint else "done" for k in range(4)]


def test_a_kink_at_the_last_joint_is_told_of_the_handle_that_is_to_be_changed():
    shape = ellipse()
    shape[3, 2] += 1
    message = results(**RIGHT, closed_shape=lambda: shape)["joint 4 to 1"].message
    assert message.startswith("last handle of segment 4, ")


def test_the_kink_of_the_old_material_is_found():
    shape = np.array(
        [
            [(5, -10), (13, -2), (5, 20), (25, 20)],
            [(25, 20), (45, 20), (35, -2), (43, -10)],
            [(43, -10), (51, -18), (20, -18), (13, -10)],
            [(13, -10), (6, 0), (-3, -18), (5, -10)],
        ]
    )
    found = results(**RIGHT, closed_shape=lambda: shape)["joint 3 to 4"]
    assert found.message.startswith("first handle of segment 4, y: expected -2, got 0")
    assert joints(shape) == ["done", "done", "differs", "done"]


def test_segments_that_are_not_written_yet_leave_the_others_alone():
    shape = ellipse()
    shape[2:] = np.nan
    assert joints(shape) == ["done", "unwritten", "unwritten", "unwritten"]


def test_segment_4_may_be_written_before_segment_3():
    shape = ellipse()
    shape[2] = np.nan
    assert joints(shape) == ["done", "unwritten", "unwritten", "done"]


def test_a_handle_without_length_gives_no_direction():
    shape = ellipse()
    shape[1, 3] = shape[2, 0] = shape[1, 2] = shape[2, 1]
    text = results(**RIGHT, closed_shape=lambda: shape)["joint 1 to 2"].message
    assert "handle of segment 2" in text


def test_four_times_the_same_point_is_no_shape():
    assert joints(np.ones((4, 4, 2))) == ["unusable", "waits", "waits", "waits"]


def test_a_wrong_next_handle_is_blamed_first():
    def copied(second_last, last):
        return second_last

    found = results(**RIGHT | {"next_handle": copied}, closed_shape=ellipse)
    assert found["next handle"].mistake == "handle copied"
    assert found["next handle"].message.startswith(
        "after (5, 20) and (25, 20), x: expected 45, got 5"
    )


def test_joints_that_follow_a_wrong_next_handle_are_not_blamed():
    def turned_back(second_last, last):
        return last - 0.5 * (second_last - last)

    shape = ellipse()
    for k in range(3):
        shape[k + 1, 1] = turned_back(shape[k, 2], shape[k, 3])
    found = results(**RIGHT | {"next_handle": turned_back}, closed_shape=lambda: shape)
    assert found["next handle"].state == "differs"
    assert [found[joint].state for joint in JOINTS] == ["done"] * 4
    assert joints(shape) == ["differs"] * 3 + ["done"]


def test_a_wrong_move_is_told_once():
    def scaled_last(points, scale, angle, move):
        return interpolation.transform_points(points + move, scale, angle)

    found = results(**RIGHT | {"transform": scaled_last}, closed_shape=ellipse)
    assert found["move"].mistake == "moved before scaling"
    assert found["scale, turn, move"].state == "unwritten"


def test_next_handle_may_be_written_point_by_point_and_return_a_tuple():
    def by_numbers(second_last, last):
        return (2 * last[0] - second_last[0], 2 * last[1] - second_last[1])

    assert (
        results(**RIGHT | {"next_handle": by_numbers}, closed_shape=ellipse)["next handle"].state
        == "done"
    )


def test_scale_alone_is_a_step_that_is_done():
    def not_moved(points, scale, angle, move):
        return interpolation.transform_points(points, scale, angle)

    found = results(**RIGHT | {"transform": not_moved}, closed_shape=ellipse)
    assert [found[part].state for part in ("scale", "move", "scale, turn, move")] == [
        "done",
        "unwritten",
        "unwritten",
    ]


def test_a_transformation_may_loop_over_the_points():
    def in_a_loop(points, scale, angle, move):
        new = []
        for x, y in points:
            turned = np.exp(1j * angle) * (x + 1j * y) * scale
            new.append([turned.real + move[0], turned.imag + move[1]])
        return new

    found = results(**RIGHT | {"transform": in_a_loop}, closed_shape=ellipse)
    assert {result.state for result in found.values()} == {"done"}


def test_degrees_taken_for_radians_are_not_done():
    def degrees(points, scale, angle, move):
        return interpolation.transform_points(points, scale, np.radians(angle), move)

    found = results(**RIGHT | {"transform": degrees}, closed_shape=ellipse)
    assert found["scale, turn, move"].state == "differs"
    assert found["move"].state == "done"
