def affine_map(source, target):
    """Return the 3x3 matrix that takes three source corners to three target corners."""
    T_source, T_target = columns(source), columns(target)
    A = T_target @ np.linalg.inv(T_source)
    return A


def warp_forward(image, source, target, triangles):
    """Return a new image with every pixel sent to its place."""
    warped = np.full(image.shape, hole, dtype=np.uint8)
    height, width = image.shape[:2]
    for corners in progress(triangles):
        A = affine_map(source[corners], target[corners])
        to_weights = np.linalg.inv(columns(source[corners]))  # weights: to_weights @ [u, v, 1]
        for v in range(height):
            for u in range(width):
                weights = to_weights @ [u, v, 1]
                if min(weights) < -1e-9:
                    continue
                place = A @ [u, v, 1]
                x = int(np.floor(place[0] + 0.5))
                y = int(np.floor(place[1] + 0.5))
                if 0 <= x < width and 0 <= y < height:
                    warped[y, x] = image[v, u]
    return warped
