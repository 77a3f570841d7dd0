"""Task 2.3 in other styles."""

import numpy as np

from canim.warping import warp_backward


def points_between__all_at_once(points_a, points_b, t):
    return points_a + t * (points_b - points_a)


def points_between__as_lists(points_a, points_b, t):
    return [[a + t * (b - a) for a, b in zip(p, q)] for p, q in zip(points_a, points_b)]


def morph__from_a_to_b(image_a, image_b, points_a, points_b, triangles, t):
    points = points_between__all_at_once(points_a, points_b, t)
    a = warp_backward(image_a.astype(float), points_a, points, triangles)
    b = warp_backward(image_b.astype(float), points_b, points, triangles)
    return np.rint(a + t * (b - a))


def morph__rounded_by_adding_a_half(image_a, image_b, points_a, points_b, triangles, t):
    points = np.array(points_between__as_lists(points_a, points_b, t))
    a, b = (
        warp_backward(image / 255, own, points, triangles)
        for image, own in ((image_a, points_a), (image_b, points_b))
    )
    return (255 * ((1 - t) * a + t * b) + 0.5).astype(np.uint8)
