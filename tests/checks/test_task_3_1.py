"""Task 3.1: a chain is right however its matrices are multiplied."""

import cmath

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["3.1"]


def rotation(angle):
    return [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]


def by_sums_of_angles(angles, offsets):
    total = np.cumsum(angles)
    c, s = np.cos(total), np.sin(total)
    x, y = offsets.T
    links = np.column_stack([c * x - s * y, s * x + c * y])
    return np.vstack([[0, 0], np.cumsum(links, axis=0)])


def with_complex_numbers_in_lists(angles, offsets):
    place, turn, rows = 0j, 1 + 0j, [(0, 0)]
    for angle, (x, y) in zip(angles, offsets):
        turn *= cmath.exp(1j * angle)
        place += turn * complex(x, y)
        rows.append((place.real, place.imag))
    return rows


def from_the_end_to_the_root(angles, offsets):
    rows = [(0, 0)]
    for last in range(len(angles)):
        point = np.array([0, 0, 1])
        for i in range(last, -1, -1):
            point = np.array(rotation(angles[i])) @ np.add(point, [*offsets[i], 0])
        rows.append(point[:2])
    return rows


def results(rotation=rotation, forward_kinematics=by_sums_of_angles):
    functions = {"rotation": rotation, "forward_kinematics": forward_kinematics}
    return {r.part: r for r in checks.run(TASK, functions, hint=True).results}


@pytest.mark.parametrize(
    "style", [by_sums_of_angles, with_complex_numbers_in_lists, from_the_end_to_the_root]
)
def test_every_way_to_the_positions_is_right(style):
    assert [r.state for r in results(forward_kinematics=style).values()] == ["done"] * 3


def test_the_poses_of_the_page_end_where_the_course_says():
    ends = [by_sums_of_angles(*case.args)[-1] for case in TASK.parts[1].cases]
    assert ends[0] == pytest.approx([2.452962, 1.503192], abs=1e-6)
    assert ends[1] == pytest.approx([-0.634469, -2.258845], abs=1e-6)


def test_a_wrong_position_is_named():
    def wrong(angles, offsets):
        positions = by_sums_of_angles(angles, offsets)
        positions[2, 1] += 9
        return positions

    message = results(forward_kinematics=wrong)["next joints"].message
    assert message.startswith("angles (-70, 0, 35)°, y of the end of link 2: expected 0.684, got 9")


def test_a_moved_root_is_wrong():
    found = results(forward_kinematics=lambda *args: np.add(by_sums_of_angles(*args), [5, 0]))
    assert "x of the root: expected 0, got 5" in found["next joints"].message


def test_a_wrong_number_of_the_rotation_is_named():
    found = results(rotation=lambda angle: np.array(rotation(angle)) + np.diag([0, 0, 4]))
    assert found["rotation"].message.startswith("35°, row 2, column 2 of R: expected 1, got 5")


def test_a_chain_of_one_link_too_few_is_told():
    found = results(forward_kinematics=lambda *args: by_sums_of_angles(*args)[1:])
    assert "expected (4, 2): the root and the end of each link" in found["next joints"].message


def test_a_small_matrix_is_told():
    found = results(rotation=lambda angle: np.array(rotation(angle))[:2, :2])
    assert "a matrix of three rows and three columns" in found["rotation"].message


def test_what_is_written_first_is_done_first():
    assert [r.state for r in results(rotation=lambda angle: np.eye(3)).values()] == [
        "unwritten",
        "done",
        "done",
    ]


def test_a_star_in_place_of_a_product_of_matrices_is_told():
    def star(angles, offsets):
        positions, T = [(0, 0)], np.eye(3)
        for i, (angle, (x, y)) in enumerate(zip(angles, offsets)):
            R, Z = np.array(rotation(angle)), np.array([[1, 0, x], [0, 1, y], [0, 0, 1]])
            T = T * R * Z if i else R @ Z
            positions.append(T[:2, 2])
        return positions

    assert "@ multiplies matrices" in results(forward_kinematics=star)["next joints"].hint
