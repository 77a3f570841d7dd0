def compute_arc_length(P, samples):
    """Return the length of the curve: the sum of the chords between its samples."""
    points = bezier_curve(P, np.linspace(0, 1, samples))
    length = 0
    for k in range(samples - 1):
        length = length + np.linalg.norm(points[k + 1] - points[k])
    return length


def equidistant_points(P, count):
    """Return points at equal distances along the curve, one a row, with both ends."""
    points = bezier_curve(P, np.linspace(0, 1, 1000))
    walked = np.full(1000, np.nan)
    walked[0] = 0  # walked: at the first point nothing
    for k in range(1, 1000):
        walked[k] = walked[k - 1] + np.linalg.norm(points[k] - points[k - 1])
    goals = np.linspace(0, walked[999], count)
    places = np.full((count, 2), np.nan)
    places[:, 0] = np.interp(goals, walked, points[:, 0])
    places[:, 1] = np.interp(goals, walked, points[:, 1])
    return places
