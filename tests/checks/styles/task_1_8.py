"""Task 1.8 in other styles."""

import numpy as np


def next_handle__twice_the_last(second_last, last):
    return 2 * last - second_last


def next_handle__number_by_number(second_last, last):
    return [last[0] + last[0] - second_last[0], last[1] + last[1] - second_last[1]]


def closed_shape__as_lists():
    return [
        [(0, 0), (1, 0), (2, 1), (2, 2)],
        [(2, 2), (2, 3), (1, 4), (0, 4)],
        [(0, 4), (-1, 4), (-2, 3), (-2, 2)],
        [(-2, 2), (-2, 1), (-1, 0), (0, 0)],
    ]


def transform__as_a_matrix(points, scale, angle, move):
    c, s = np.cos(angle), np.sin(angle)
    return scale * points @ np.array([[c, s], [-s, c]]) + move


def transform__point_by_point(points, scale, angle, move):
    moved = []
    for x, y in points:
        turned = complex(x, y) * scale * np.exp(1j * angle)
        moved.append((turned.real + move[0], turned.imag + move[1]))
    return moved
