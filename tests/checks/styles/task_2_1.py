"""Task 2.1 in other styles."""

import numpy as np

HOLE = (255, 0, 255)


def affine_map__by_least_squares(source, target):
    rows = np.column_stack([source, np.ones(3)])
    A = np.eye(3)
    A[:2] = np.linalg.lstsq(rows, target, rcond=None)[0].T
    return A


def affine_map__six_equations(source, target):
    system, right = [], []
    for (u, v), (x, y) in zip(source, target):
        system += [[u, v, 1, 0, 0, 0], [0, 0, 0, u, v, 1]]
        right += [x, y]
    a = np.linalg.solve(system, right)
    return [list(a[:3]), list(a[3:]), [0, 0, 1]]


def warp_forward__all_pixels_of_a_triangle_at_once(image, source, target, triangles):
    height, width = image.shape[:2]
    v, u = np.mgrid[:height, :width]
    pixels = np.array([u.ravel(), v.ravel(), np.ones(u.size)])
    warped = np.full(image.shape, HOLE, np.uint8)
    for corners in triangles:
        weights = np.linalg.solve(np.vstack([source[corners].T, np.ones(3)]), pixels)
        inside = (weights >= -1e-9).all(axis=0)
        x, y = np.floor(target[corners].T @ weights[:, inside] + 0.5).astype(int)
        there = (x >= 0) & (x < width) & (y >= 0) & (y < height)
        colours = image.reshape(-1, 3)[inside][there]
        warped[y[there], x[there]] = colours
    return warped


def warp_forward__corners_by_hand_and_lists(image, source, target, triangles):
    height, width = len(image), len(image[0])
    warped = [[HOLE] * width for _ in range(height)]
    for i, j, k in triangles:
        (x0, y0), (x1, y1), (x2, y2) = source[i], source[j], source[k]
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        for v in range(height):
            for u in range(width):
                one = ((u - x0) * (y2 - y0) - (x2 - x0) * (v - y0)) / area
                two = ((x1 - x0) * (v - y0) - (u - x0) * (y1 - y0)) / area
                if one >= -1e-9 and two >= -1e-9 and one + two <= 1 + 1e-9:
                    place = (
                        target[i] + one * (target[j] - target[i]) + two * (target[k] - target[i])
                    )
                    x, y = (int(np.floor(c + 0.5)) for c in place)
                    if 0 <= x < width and 0 <= y < height:
                        warped[y][x] = tuple(image[v][u])
    return warped
