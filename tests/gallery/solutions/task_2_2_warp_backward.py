def bilinear(image, u, v):
    """Return the colour of the image at (u, v), between the centres of its pixels."""
    height, width = image.shape[:2]
    u, v = np.clip(u, 0, width - 1), np.clip(v, 0, height - 1)  # not outside: given
    column, row = min(int(u), width - 2), min(int(v), height - 2)  # above, to the left: given
    f, g = u - column, v - row
    upper = (1 - f) * image[row, column] + f * image[row, column + 1]
    lower = (1 - f) * image[row + 1, column] + f * image[row + 1, column + 1]
    colour = (1 - g) * upper + g * lower
    return colour


def warp_backward(image, source, target, triangles):
    """Return a new image; each of its pixels asks where it comes from."""
    warped = np.full(image.shape, hole, dtype=float)
    height, width = image.shape[:2]
    for corners in progress(triangles):
        A = affine_transforms(source, target, [corners])[0]  # the map of Task 2.1: given
        T = np.vstack([target[corners].T, np.ones(3)])
        to_weights = np.linalg.inv(T)
        back = np.linalg.inv(A)
        for y in range(height):
            for x in range(width):
                weights = to_weights @ [x, y, 1]
                if min(weights) >= -1e-9:
                    place = back @ [x, y, 1]
                    warped[y, x] = bilinear(image, place[0], place[1])
    return np.round(warped).astype(np.uint8)
