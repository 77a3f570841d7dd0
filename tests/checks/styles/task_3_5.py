"""Task 3.5 in other styles."""

import numpy as np


def deltas__all_at_once(neutral, shapes):
    return shapes - neutral


def deltas__as_lists(neutral, shapes):
    return [(shape - neutral).tolist() for shape in shapes]


def delta_blendshape__as_a_product(neutral, shapes, weights):
    return neutral + np.einsum("k,kvd->vd", weights, shapes - neutral)


def delta_blendshape__with_what_is_left_of_the_neutral_face(neutral, shapes, weights):
    return (1 - sum(weights)) * neutral + sum(w * shape for w, shape in zip(weights, shapes))


def delta_blendshape__vertex_by_vertex(neutral, shapes, weights):
    moved = []
    for v, place in enumerate(neutral):
        moved.append(place + sum(w * (shape[v] - place) for w, shape in zip(weights, shapes)))
    return moved
