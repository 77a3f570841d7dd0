"""Task 3.1 in other styles."""

import numpy as np


def rotation__as_lists(angle):
    c, s = np.cos(angle), np.sin(angle)
    return [[c, -s, 0], [s, c, 0], [0, 0, 1]]


def rotation__in_a_block(angle):
    R = np.eye(3)
    R[:2, :2] = np.array([[1, 0], [0, 1]]) * np.cos(angle) + np.array([[0, -1], [1, 0]]) * np.sin(
        angle
    )
    return R


def forward_kinematics__with_sums_of_angles(angles, offsets):
    positions, heading = [np.zeros(2)], 0.0
    for angle, (x, y) in zip(angles, offsets):
        heading += angle
        c, s = np.cos(heading), np.sin(heading)
        positions.append(positions[-1] + [c * x - s * y, s * x + c * y])
    return positions


def forward_kinematics__with_complex_numbers(angles, offsets):
    links = (offsets[:, 0] + 1j * offsets[:, 1]) * np.exp(1j * np.cumsum(angles))
    ends = np.append(0, np.cumsum(links))
    return np.column_stack([ends.real, ends.imag])


def forward_kinematics__from_the_last_joint(angles, offsets):
    points = np.zeros((1, 2))
    for angle, offset in zip(angles[::-1], offsets[::-1]):
        c, s = np.cos(angle), np.sin(angle)
        points = np.vstack([[0, 0], (points + offset) @ np.array([[c, s], [-s, c]])])
    return points
