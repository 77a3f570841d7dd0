def points_between(points_a, points_b, t):
    """Return the key points at the moment t."""
    points = np.full(points_a.shape, np.nan)
    for i in range(len(points_a)):
        points[i] = (1 - t) * points_a[i] + t * points_b[i]
    return points


def morph(image_a, image_b, points_a, points_b, triangles, t):
    """Return the image at the moment t: A at t = 0, B at t = 1."""
    a, b = image_a.astype(float), image_b.astype(float)  # with decimals: given
    points = points_between(points_a, points_b, t)
    warped_a = canim.warping.warp_backward(a, points_a, points, triangles)
    warped_b = canim.warping.warp_backward(b, points_b, points, triangles)
    blend = (1 - t) * warped_a + t * warped_b
    return np.round(blend).astype(np.uint8)  # rounded once: given
