def deltas(neutral, shapes):
    """Return what each expression changes: for each shape, one row per vertex."""
    changes = np.zeros(shapes.shape)
    for k in range(len(shapes)):
        changes[k] = shapes[k] - neutral
    return changes


def delta_blendshape(neutral, shapes, weights):
    """Return the vertices of the neutral face with all the weighted changes."""
    vertices = neutral.copy()
    changes = deltas(neutral, shapes)
    for k in range(len(shapes)):
        vertices += weights[k] * changes[k]
    return vertices
