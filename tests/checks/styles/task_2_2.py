"""Task 2.2 in other styles."""

import numpy as np

HOLE = (255, 0, 255)


def _left(c, size):
    return int(np.clip(np.floor(c), 0, size - 2))


def bilinear__four_weights(image, u, v):
    height, width = image.shape[:2]
    u, v = np.clip(u, 0, width - 1), np.clip(v, 0, height - 1)
    i, j = _left(u, width), _left(v, height)
    f, g = u - i, v - j
    four = {(j, i): (1 - f) * (1 - g), (j, i + 1): f * (1 - g), (j + 1, i): (1 - f) * g}
    four[j + 1, i + 1] = f * g
    return sum(weight * image[place] for place, weight in four.items())


def bilinear__columns_first(image, u, v):
    height, width = image.shape[:2]
    u, v = np.clip(u, 0, width - 1), np.clip(v, 0, height - 1)
    i, j = _left(u, width), _left(v, height)
    f, g = u - i, v - j
    left = image[j, i] * (1 - g) + image[j + 1, i] * g
    right = image[j, i + 1] * (1 - g) + image[j + 1, i + 1] * g
    return list(left * (1 - f) + right * f)


def bilinear__as_a_matrix(image, u, v):
    height, width = image.shape[:2]
    u, v = np.clip(u, 0, width - 1), np.clip(v, 0, height - 1)
    i, j = _left(u, width), _left(v, height)
    f, g = u - i, v - j
    square = image[j : j + 2, i : i + 2].astype(float)
    return [np.array([1 - g, g]) @ square[:, :, k] @ [1 - f, f] for k in range(3)]


def warp_backward__triangle_of_each_pixel(image, source, target, triangles):
    height, width = image.shape[:2]
    warped = np.empty(image.shape, np.uint8)
    inverses = [np.linalg.inv(np.vstack([target[c].T, np.ones(3)])) for c in triangles]
    for y in range(height):
        for x in range(width):
            warped[y, x] = HOLE
            for corners, inverse in zip(triangles, inverses):
                weights = inverse @ [x, y, 1]
                if (weights >= -1e-9).all():
                    u, v = weights @ source[corners]
                    warped[y, x] = np.floor(bilinear__four_weights(image, u, v) + 0.5)
                    break
    return warped
