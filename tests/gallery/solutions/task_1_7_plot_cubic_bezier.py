def cubic_bezier(P, t):
    """Return one point per moment, as rows: the curve of P[0], P[1], P[2] and P[3]."""
    points = np.full((len(t), 2), np.nan)
    for k, s in enumerate(t):
        pull_0 = (1 - s) ** 3 * P[0]
        pull_1 = 3 * (1 - s) ** 2 * s * P[1]
        pull_2 = 3 * (1 - s) * s**2 * P[2]
        pull_3 = s**3 * P[3]
        points[k] = pull_0 + pull_1 + pull_2 + pull_3
    return points
