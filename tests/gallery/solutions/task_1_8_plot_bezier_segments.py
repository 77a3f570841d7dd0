def next_handle(second_last, last):
    """Return the handle that goes on smoothly from these two points, arrays of x and y."""
    handle = last + (last - second_last)
    return handle


def closed_shape():
    """Return four segments, each with four points."""
    S = np.full((4, 4, 2), np.nan)
    S[0] = [(5, -10), (13, -2), (5, 20), (25, 20)]
    S[1] = [S[0, 3], next_handle(S[0, 2], S[0, 3]), (35, -2), (43, -10)]  # joint 1 to 2
    S[2] = [S[1, 3], next_handle(S[1, 2], S[1, 3]), (20, -18), (13, -10)]
    last_handle = next_handle(S[0, 1], S[0, 0])
    S[3] = [S[2, 3], next_handle(S[2, 2], S[2, 3]), last_handle, S[0, 0]]
    return S


def transform(points, scale, angle, move):
    """Return the points, an (x, y) in each row, scaled, turned and moved."""
    x, y = scale * points[:, 0], scale * points[:, 1]
    c, s = np.cos(angle), np.sin(angle)
    x, y = x * c - y * s, x * s + y * c  # turn: given
    x = x + move[0]
    y = y + move[1]
    return np.column_stack([x, y])
