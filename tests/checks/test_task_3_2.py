"""Task 3.2: any Jacobian that is measured well and any steps that reach the goal are right."""

import numpy as np
import pytest

from canim import checks
from canim.character import forward_kinematics_2d

TASK = checks.TASKS["3.2"]


def end(angles, offsets):
    return forward_kinematics_2d(angles, offsets)[-1]


def jacobian(angles, offsets):
    J = np.zeros((2, len(angles)))
    for i in range(len(angles)):
        turned = angles.copy()
        turned[i] += 1e-6
        J[:, i] = (end(turned, offsets) - end(angles, offsets)) / 1e-6
    return J


def reach(angles, offsets, goal, alpha=0.2, tolerance=0.01, count=200, of=jacobian):
    poses = [angles]
    for _ in range(count):
        e = goal - end(angles, offsets)
        if np.linalg.norm(e) < tolerance:
            break
        angles = angles + alpha * np.linalg.pinv(of(angles, offsets)) @ e
        poses.append(angles)
    return poses


def results(jacobian=jacobian, reach=reach):
    report = checks.run(TASK, {"jacobian": jacobian, "reach": reach}, hint=True)
    return {result.part: result for result in report.results}


def states(**functions):
    return [result.state for result in results(**functions).values()]


def central_with_a_large_angle(angles, offsets):
    columns = []
    for turn in np.eye(len(angles)) * 1e-3:
        columns.append((end(angles + turn, offsets) - end(angles - turn, offsets)) / 2e-3)
    return np.transpose(columns)


def a_little_large_in_lists(angles, offsets):
    turned = [end(angles + turn, offsets) for turn in np.eye(len(angles)) * 1e-4]
    x, y = end(angles, offsets)
    return [[(p[0] - x) / 1e-4 for p in turned], [(p[1] - y) / 1e-4 for p in turned]]


def by_geometry(angles, offsets):
    """The way of the end effector is at a right angle to the way from the joint to it."""
    positions = forward_kinematics_2d(angles, offsets)
    x, y = (positions[-1] - positions[:-1]).T
    return np.array([-y, x])


def turned_there_and_back(angles, offsets):
    J, p = [], end(angles, offsets)
    angles = list(angles)
    for i in range(len(angles)):
        angles[i] += 1e-6
        J.append((end(angles, offsets) - p) / 1e-6)
        angles[i] -= 1e-6
    return np.array(J).T


@pytest.mark.parametrize(
    "style",
    [central_with_a_large_angle, a_little_large_in_lists, by_geometry, turned_there_and_back],
)
def test_every_way_to_the_jacobian_is_right(style):
    assert states(jacobian=style) == ["done"] * 4


@pytest.mark.parametrize(
    "options",
    [{"alpha": 1}, {"alpha": 0.1}, {"alpha": 0.5, "tolerance": 1e-9}, {"tolerance": 0.03}],
)
def test_any_step_size_and_tolerance_that_reach_the_goal_are_right(options):
    assert states(reach=lambda *args: reach(*args, **options)) == ["done"] * 4


def test_the_stop_may_come_after_the_update_and_poses_may_be_lists():
    def other(angles, offsets, goal):
        poses, far = [list(angles)], True
        while far and len(poses) < 150:
            e = goal - end(poses[-1], offsets)
            change = np.linalg.lstsq(by_geometry(poses[-1], offsets), 0.3 * e, rcond=None)[0]
            poses.append([a + c for a, c in zip(poses[-1], change)])
            far = np.hypot(*(end(poses[-1], offsets) - goal)) > 0.01
        return poses

    assert states(reach=other) == ["done"] * 4


def test_the_first_pose_may_be_left_out():
    assert states(reach=lambda *args: reach(*args)[1:] or [args[0]]) == ["done"] * 4


def test_a_loop_without_a_stop_is_not_written_yet():
    found = results(reach=lambda *args: reach(*args, tolerance=0))
    assert [r.state for r in found.values()] == ["done", "done", "unwritten", "done"]


def test_a_stop_without_an_update_is_done():
    def stops(angles, offsets, goal):
        near = np.linalg.norm(goal - end(angles, offsets)) < 0.01
        return [angles] * (1 if near else 201)

    assert states(reach=stops) == ["done", "unwritten", "done", "unwritten"]


def test_steps_that_are_too_few_do_not_reach_the_goal():
    found = results(reach=lambda *args: reach(*args, count=5))
    assert found["stop"].message == "the last pose is still far from the goal"
    assert "but the goal is (1.2, 0.7)" in found["goals reached"].message


def test_steps_that_go_on_at_the_goal_are_told():
    def late(angles, offsets, goal):
        poses = reach(angles, offsets, goal)
        return poses + poses[-1:] * (5 if len(poses) == 1 else 0)

    assert results(reach=late)["stop"].message == "the steps go on although the goal is reached"


def test_steps_that_end_in_no_number_are_told():
    found = results(reach=lambda *args: [*reach(*args), args[0] * np.nan])
    assert found["goals reached"].message == "some angles are not finite numbers"
    assert found["stop"].message == "the last pose is still far from the goal"


def test_a_wrong_column_is_named():
    def wrong(angles, offsets):
        return jacobian(angles, offsets) + np.eye(2, len(angles))

    message = results(jacobian=wrong)["Jacobian"].message
    assert message.startswith("3 links, x of column 0: expected -2.148, got -1.148")


def test_a_wrong_step_is_named():
    def wrong(angles, offsets, goal):
        poses = reach(angles, offsets, goal)
        return [pose * [1, *[1.1] * (len(angles) - 1)] for pose in poses]

    assert "share of angles[" in results(reach=wrong)["update"].message


def test_another_array_that_is_the_same_is_told_with_the_jacobian():
    def alias(angles, offsets):
        J = np.zeros((2, len(angles)))
        for i in range(len(angles)):
            turned = angles
            turned[i] = turned[i] + 1e-6
            J[:, i] = (end(turned, offsets) - end(angles, offsets)) / 1e-6
        return J

    assert results(jacobian=alias)["Jacobian"].mistake == "second name for the angles"


def test_angles_that_are_not_turned_back_are_told():
    def forgetful(angles, offsets):
        J, p = np.zeros((2, len(angles))), end(angles, offsets)
        for i in range(len(angles)):
            angles[i] += 1e-6
            J[:, i] = (end(angles, offsets) - p) / 1e-6
        return J

    report = checks.run(TASK, {"jacobian": forgetful, "reach": reach}, hint=True)
    assert report.results[0].mistake == "not turned back"
    assert "jacobian changes what it is given" in report.notes[0]


def test_another_epsilon_that_is_not_divided_by_is_told():
    found = results(jacobian=lambda *args: 1e-3 * jacobian(*args))["Jacobian"]
    assert found.mistake == "not divided by epsilon"


def test_changing_the_angles_in_place_is_told_whatever_the_step_size():
    def in_place(angles, offsets, goal):
        poses = [angles]
        for _ in range(200):
            e = goal - end(angles, offsets)
            if np.linalg.norm(e) < 0.01:
                break
            angles += 0.35 * np.linalg.pinv(jacobian(angles, offsets)) @ e
            poses.append(angles)
        return poses

    found = results(reach=in_place)["update"]
    assert found.message == "all poses in the list are the same"
    assert found.mistake == "poses changed in place"


@pytest.mark.parametrize("alpha", [0.1, 0.5])
def test_the_jacobian_of_the_first_pose_is_told_whatever_the_step_size(alpha):
    def once(angles, offsets, goal):
        J = jacobian(angles, offsets)
        return reach(angles, offsets, goal, alpha, of=lambda *_: J)

    assert results(reach=once)["goals reached"].mistake == "Jacobian computed once"


@pytest.mark.parametrize("alpha", [0.05, 0.2])
def test_the_error_of_the_first_pose_is_told_whatever_the_step_size(alpha):
    def once(angles, offsets, goal):
        poses, e = [angles], goal - end(angles, offsets)
        for _ in range(200):
            angles = angles + alpha * np.linalg.pinv(jacobian(angles, offsets)) @ e
            poses.append(angles)
        return poses

    assert results(reach=once)["goals reached"].mistake == "error computed once"


def test_an_inverse_of_what_is_not_square_is_told_in_plain_words():
    def inverse(angles, offsets, goal):
        return [angles + np.linalg.inv(jacobian(angles, offsets)) @ goal]

    found = results(reach=inverse)
    assert "Only a square matrix has an inverse." in found["update"].message


def test_only_the_last_pose_is_not_all_of_them():
    found = results(reach=lambda *args: reach(*args)[-1])
    assert "returns an array of shape (3,), expected the angles after" in found["update"].message


def test_no_pose_at_all_is_told():
    assert "expected the angles after every step" in results(reach=lambda *_: [])["update"].message


@pytest.mark.parametrize("left_out", [0, -1])
def test_a_column_left_out_is_not_taken_for_a_jacobian_computed_once(left_out):
    def some(angles, offsets):
        J = jacobian(angles, offsets)
        J[:, left_out] = 0
        return J

    found = results(jacobian=some, reach=lambda *args: reach(*args, of=some))
    assert found["Jacobian"].state == "differs"
    assert found["goals reached"].mistake == ""


def test_an_arm_that_hardly_moves_has_no_habit():
    found = results(reach=lambda *args: reach(*args, of=lambda *a: 1e6 * jacobian(*a)))
    assert found["goals reached"].message.startswith("the end effector comes to")
    assert found["goals reached"].mistake == ""


def test_a_jump_is_told_with_the_jacobian():
    def jumps(angles, offsets):
        J, p = np.zeros((2, len(angles))), end(angles, offsets)
        for i in range(len(angles)):
            turned = angles.copy()
            turned[i] = 1e-6
            J[:, i] = (end(turned, offsets) - p) / 1e-6
        return J

    assert results(jacobian=jumps)["Jacobian"].mistake == "jump in place of movement"


def test_a_wrong_jacobian_that_takes_long_does_not_make_a_right_stop_wrong():
    def much_too_long(angles, offsets):
        return 8 * jacobian(angles, offsets)

    found = results(jacobian=much_too_long, reach=lambda *args: reach(*args, of=much_too_long))
    assert found["stop"].state == "done"


def test_an_arm_that_leaves_its_goal_is_told_without_an_untrue_hint():
    found = results(reach=lambda angles, offsets, _: reach(angles, offsets, np.array([1.0, 1.0])))
    assert found["stop"].message == "the arm is at the goal when it starts, and leaves it"
    assert found["stop"].mistake == ""
