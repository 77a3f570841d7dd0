"""Task 1.10: what a student may write, and what half of it is worth."""

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["1.10"]


def states(written):
    return [result.state for result in checks.run(TASK, {"ease_in_out": written}).results]


def _point_by_point(t):
    done = []
    for moment in t:
        if moment <= 0.5:
            done.append(2 * moment**2)
        else:
            done.append(1 - 2 * (1 - moment) ** 2)
    return done


def _multiplied_out(t):
    return np.where(t < 0.5, 2 * t**2, -2 * t**2 + 4 * t - 1)


@pytest.mark.parametrize("written", [_point_by_point, _multiplied_out])
def test_it_may_be_written_in_other_ways(written):
    assert set(states(written)) == {"done"}


def test_what_is_nearly_right_is_not_done():
    assert states(lambda t: 3 * t**2 - 2 * t**3) == ["differs", "differs"]
