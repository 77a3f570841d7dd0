"""Task 3.3: rotations, Jacobians and steps in space, however they are written."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from canim import checks

TASK = checks.TASKS["3.3"]


def rotation(angles):
    return Rotation.from_euler("XYZ", angles).as_matrix()


def end(angles, offsets):
    place, R = np.zeros(3), np.eye(3)
    for joint, offset in zip(np.asarray(angles), offsets):
        R = R @ rotation(joint)
        place = place + R @ offset
    return place


def jacobian(angles, offsets):
    columns = []
    for index in np.ndindex(angles.shape):
        turned = angles.copy()
        turned[index] += 1e-6
        columns.append((end(turned, offsets) - end(angles, offsets)) / 1e-6)
    return np.transpose(columns)


def reach(angles, offsets, goal, alpha=0.3, of=jacobian):
    poses = [angles]
    for _ in range(200):
        e = goal - end(angles, offsets)
        if np.linalg.norm(e) < 0.01:
            break
        change = alpha * np.linalg.pinv(of(angles, offsets)) @ e
        angles = angles + change.reshape(angles.shape)
        poses.append(angles)
    return poses


def results(**changed):
    functions = {"rotation": rotation, "jacobian": jacobian, "reach": reach} | changed
    return {r.part: r for r in checks.run(TASK, functions, hint=True).results}


def test_the_convention_of_the_course_is_that_of_scipys_inner_rotations():
    assert [r.state for r in results().values()] == ["done"] * 5


def test_tables_may_be_lists():
    def tables(*args):
        return [[list(joint) for joint in pose] for pose in reach(*args)]

    found = results(
        rotation=lambda angles: rotation(angles).tolist(),
        jacobian=lambda *args: jacobian(*args).tolist(),
        reach=tables,
    )
    assert [r.state for r in found.values()] == ["done"] * 5


def test_outer_rotations_are_the_order_turned_round():
    found = results(rotation=lambda angles: Rotation.from_euler("xyz", angles).as_matrix())
    assert found["rotation"].mistake == "order turned round"


def test_a_wrong_number_of_the_rotation_is_named():
    message = results(rotation=lambda angles: rotation(angles) + np.eye(3))["rotation"].message
    assert message.startswith("angles (35, -50, 110)°, row ")


def test_a_wrong_column_is_named():
    def wrong(angles, offsets):
        J = jacobian(angles, offsets)
        J[2, 4] += 3
        return J

    assert "3 links, z of column 4: expected" in results(jacobian=wrong)["Jacobian"].message


def test_a_wrong_step_is_named_with_joint_and_axis():
    def wrong(angles, offsets, goal):
        return [angles, angles + [[0, 0, 1]] + 0 * angles]

    message = results(reach=wrong)["update"].message
    assert message.startswith("share of angles[0, 2] in the first step: expected ")


def test_a_list_in_place_of_a_table_is_told():
    def flat(*args):
        return [pose.ravel() for pose in reach(*args)]

    assert "expected the angles after every step" in results(reach=flat)["update"].message


@pytest.mark.parametrize("alpha", [0.1, 0.5])
def test_the_jacobian_of_the_first_pose_is_told(alpha):
    def once(angles, offsets, goal):
        J = jacobian(angles, offsets)
        return reach(angles, offsets, goal, alpha, of=lambda *_: J)

    assert results(reach=once)["goals reached"].mistake == "Jacobian computed once"


def test_a_wrong_rotation_does_not_make_a_right_stop_wrong():
    def turned_round(angles):
        return rotation(angles).T

    def end(angles, offsets):
        place, R = np.zeros(3), np.eye(3)
        for joint, offset in zip(angles, offsets):
            R = R @ turned_round(joint)
            place = place + R @ offset
        return place

    def reach(angles, offsets, goal):
        poses = [angles]
        while np.linalg.norm(goal - end(angles, offsets)) > 0.01 and len(poses) < 200:
            tiny = 1e-6 * np.eye(angles.size).reshape(-1, *angles.shape)
            p = end(angles, offsets)
            J = np.transpose([(end(angles + turn, offsets) - p) / 1e-6 for turn in tiny])
            change = 0.2 * np.linalg.pinv(J) @ (goal - p)
            angles = angles + change.reshape(angles.shape)
            poses.append(angles)
        return poses

    found = results(rotation=turned_round, reach=reach)
    assert found["rotation"].state == "differs"
    assert found["stop"].state == found["goals reached"].state == "done"
