"""Task 0.0: what a student may write, and what half of it is worth."""

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["0.0"]


def results(blend):
    return checks.run(TASK, {"blend": blend}).results


def _moment_by_moment(a, b, t):
    xs, ys = [], []
    for moment in t:
        xs.append(a[0] + moment * (b[0] - a[0]))
        ys.append(a[1] + moment * (b[1] - a[1]))
    return xs, ys


def _point_by_point(a, b, t):
    return np.array([(1 - moment) * a + moment * b for moment in t]).T


def _as_a_matrix(a, b, t):
    return np.column_stack([a, b]) @ [1 - t, t]


@pytest.mark.parametrize("written", [_moment_by_moment, _point_by_point, _as_a_matrix])
def test_it_may_be_written_in_other_ways(written):
    assert [result.state for result in results(written)] == ["done", "done"]


def test_each_line_is_judged_by_itself():
    found = results(lambda a, b, t: ((1 - t) * a[0] + t * b[0], t * np.nan))
    assert [result.state for result in found] == ["done", "unwritten"]
    found = results(lambda a, b, t: (t * a[0] + (1 - t) * b[0], (1 - t) * a[1] + t * b[1]))
    assert [result.state for result in found] == ["differs", "done"]
    assert found[0].message == "at t = 0: expected 1, got 7 (largest error 6)"
    assert found[0].mistake == "shares exchanged"


def test_a_larger_error_in_another_test_is_said_to_be_one():
    def blend(a, b, t):
        return (1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[0]

    report = checks.run(checks.find("0.0"), {"blend": blend})
    assert report.results[1].message == (
        "at t = 1: expected 4, got 7 (largest error of all tests 4)"
    )


def test_points_as_rows_are_a_wrong_shape():
    message = results(lambda a, b, t: _point_by_point(a, b, t).T)[0].message
    assert "returns an array of shape (11, 2), expected (2, 11)" in message


def test_the_warm_up_is_not_one_of_the_seventeen():
    assert next(iter(checks.TASKS)) == "0.0"
    assert next(iter(checks.BLOCKS)) == TASK.block
    # A figure of the paper has none but the seventeen: tasks of a teacher's own have none.
    assert not TASK.figure
    assert sum(bool(task.figure) for task in checks.TASKS.values()) == 17
