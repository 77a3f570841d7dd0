def global_blendshape(shapes, weights):
    """Return the vertices of the mix. shapes[0] is the neutral face."""
    vertices = np.zeros(shapes[0].shape)
    for k in range(len(shapes)):
        vertices += weights[k] * shapes[k]
    return vertices


def weights_at(t, count, first, second):
    """Return count weights: at t = 0 shape first has all, at t = 1 shape second."""
    weights = np.zeros(count)
    weights[first] = 1 - t
    weights[second] = t
    return weights
