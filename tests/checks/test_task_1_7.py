"""Task 1.7: what the check accepts and what it tells apart."""

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["1.7"]
PULLS = [f"pull of P{k}" for k in range(4)]


def report(function):
    return checks.run(TASK, {"cubic_bezier": function}, hint=True)


def states(function):
    return [result.state for result in report(function).results]


def by_coordinates(P, t):
    x, y = (
        (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t**2 * p[2] + t**3 * p[3]
        for p in (P[:, 0], P[:, 1])
    )
    return np.column_stack([x, y])


def in_a_list(P, t):
    points = []
    for s in t:
        a = (1 - s) * P[:-1] + s * P[1:]
        b = (1 - s) * a[:-1] + s * a[1:]
        points.append(tuple((1 - s) * b[0] + s * b[1]))
    return points


def by_powers(P, t):
    weights = np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 3, 0, 0], [1, 0, 0, 0]])
    return np.vander(t, 4) @ weights @ P


@pytest.mark.parametrize("style", [by_coordinates, in_a_list, by_powers])
def test_right_in_any_style(style):
    assert report(style).done


def test_pulls_are_done_one_after_the_other():
    def first_two(P, t):
        s = t[:, None]
        return (1 - s) ** 3 * P[0] + 3 * (1 - s) ** 2 * s * P[1]

    assert states(first_two) == ["done", "done", "unwritten", "unwritten", "unwritten"]


def test_a_return_in_the_loop_is_told_once():
    def only_the_first_moment(P, t):
        points = np.full((len(t), 2), np.nan)
        points[0] = by_coordinates(P, t)[0]
        return points

    assert states(only_the_first_moment) == ["differs"] + ["unwritten"] * 4
    assert report(only_the_first_moment).results[0].mistake == "return in the loop"


def test_a_single_wrong_weight_is_named():
    def three_missing(P, t):
        s = t[:, None]
        return (
            (1 - s) ** 3 * P[0] + 3 * (1 - s) ** 2 * s * P[1] + (1 - s) * s**2 * P[2] + s**3 * P[3]
        )

    results = report(three_missing).results
    assert [r.state for r in results] == ["done", "done", "differs", "done", "differs"]
    assert "weight at t = 0.7: expected 0.441, got 0.147" in results[2].message
    assert results[2].mistake == "no factors 3"


def test_a_curve_that_runs_backwards_differs_though_it_looks_the_same():
    text = " ".join(str(report(lambda P, t: by_coordinates(P, 1 - t))).split())
    assert "Your curve runs backwards" in text


def test_a_curve_that_only_the_ends_of_t_are_right_of_is_not_done():
    def straight(P, t):
        return P[0] + t[:, None] * (P[3] - P[0])

    assert "done" not in states(straight)


def test_x_and_y_as_two_rows_are_said_to_have_the_wrong_shape():
    text = " ".join(str(report(lambda P, t: by_coordinates(P, t).T)).split())
    assert "shape (2, 11), expected (11, 2): one row per value of t" in text
