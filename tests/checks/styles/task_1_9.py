"""Task 1.9 in other styles."""

import itertools

import numpy as np

from canim.interpolation import bezier_curve


def compute_arc_length__all_at_once(P, samples):
    points = bezier_curve(P, np.linspace(0, 1, samples))
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


def compute_arc_length__with_hypot(P, samples):
    points = [bezier_curve(P, k / (samples - 1)) for k in range(samples)]
    return sum(np.hypot(*(q - p)) for p, q in itertools.pairwise(points))


def equidistant_points__all_at_once(P, count):
    points = bezier_curve(P, np.linspace(0, 1, 2000))
    walked = np.append(0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    goals = np.linspace(0, walked[-1], count)
    return np.column_stack([np.interp(goals, walked, points[:, k]) for k in (0, 1)])


def equidistant_points__by_walking(P, count):
    points = bezier_curve(P, np.linspace(0, 1, 1000))
    walked = [0.0]
    for p, q in itertools.pairwise(points):
        walked.append(walked[-1] + float(np.sqrt(((q - p) ** 2).sum())))
    places = []
    for k in range(count):
        goal, j = walked[-1] * k / (count - 1), 0
        while j < len(walked) - 2 and walked[j + 1] < goal:
            j += 1
        share = (goal - walked[j]) / (walked[j + 1] - walked[j])
        places.append((1 - share) * points[j] + share * points[j + 1])
    return places
