"""Task 1.9: good approximations are right, rough ones and wrong ones are not."""

import numpy as np
import pytest

from canim import checks, interpolation
from canim.interpolation import bezier_curve

TASK = checks.TASKS["1.9"]
RIGHT = {
    "compute_arc_length": interpolation.arc_length,
    "equidistant_points": interpolation.equidistant_points,
}


def results(**functions):
    return {r.part: r for r in checks.run(TASK, RIGHT | functions, hint=True).results}


def length(function):
    return results(compute_arc_length=function)["length"]


def places(function):
    found = results(equidistant_points=function)
    return [found[part] for part in ("places: both ends", "places: equal spacing")]


def chords(P, samples):
    points = bezier_curve(P, np.linspace(0, 1, samples))
    return np.linalg.norm(np.diff(points, axis=0), axis=1)


def samples_are_chords(P, samples):
    return chords(P, samples + 1).sum()


def in_steps_of_time(P, samples):
    step = 1 / (samples - 1)
    total = 0.0
    for k in range(samples - 1):
        a, b = bezier_curve(P, [k * step, (k + 1) * step])
        total += ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5
    return total


def by_the_speed(P, samples):
    t = (np.arange(samples) + 0.5) / samples
    speed = 3 * bezier_curve(np.diff(P, axis=0), t)
    return np.linalg.norm(speed, axis=1).mean()


def in_an_array(P, samples):
    return np.array([chords(P, samples).sum()])


@pytest.mark.parametrize("style", [samples_are_chords, in_steps_of_time, by_the_speed, in_an_array])
def test_any_good_approximation_of_the_length_is_right(style):
    assert length(style).state == "done"


def test_a_length_that_ignores_the_samples_is_right_if_it_is_good():
    assert length(lambda P, samples: chords(P, 5000).sum()).state == "done"


@pytest.mark.parametrize("missing", [slice(1, None), slice(None, -1), slice(1, -1)])
def test_a_chord_too_few_is_found_at_either_end(missing):
    assert length(lambda P, samples: chords(P, samples)[missing].sum()).state == "differs"


@pytest.mark.parametrize("nothing", [None, "59.9", []])
def test_no_number_at_all(nothing):
    assert length(lambda P, samples: nothing).state == "unusable"


def test_the_last_chord_missing_of_n_chords_is_found_too():
    assert length(lambda P, samples: chords(P, samples + 1)[:-1].sum()).state == "differs"


def test_all_chords_in_place_of_their_sum():
    found = length(chords)
    assert found.state == "unusable"
    assert "returns 9 numbers, expected one" in found.message


def walk(P, count, samples=1000):
    """As the paper has it: go along the samples and stop at each goal."""
    points = bezier_curve(P, np.linspace(0, 1, samples))
    pieces = chords(P, samples)
    step = pieces.sum() / (count - 1)
    found, walked, k = [points[0]], 0.0, 0
    for goal in step * np.arange(1, count - 1):
        while walked + pieces[k] < goal:
            walked += pieces[k]
            k += 1
        share = (goal - walked) / pieces[k]
        found.append((1 - share) * points[k] + share * points[k + 1])
    return [*found, points[-1]]


def by_their_t(P, count):
    t = np.linspace(0, 1, 300)
    walked = np.append(0, np.cumsum(chords(P, 300)))
    return bezier_curve(P, np.interp(np.linspace(0, walked[-1], count), walked, t))


def by_fine_samples(P, count):
    points = bezier_curve(P, np.linspace(0, 1, 20_001))
    walked = np.append(0, np.cumsum(chords(P, 20_001)))
    goals = np.linspace(0, walked[-1], count)
    return points[[np.argmin(abs(walked - goal)) for goal in goals]]


@pytest.mark.parametrize("style", [walk, by_their_t, by_fine_samples])
def test_points_that_are_good_to_a_few_per_mille_are_right(style):
    assert [found.state for found in places(style)] == ["done", "done"]


def test_walking_over_too_few_samples_is_not_done():
    rough = places(lambda P, count: walk(P, count, samples=12))
    assert rough[1].state == "differs"


@pytest.mark.parametrize("samples", [400, 1000])
@pytest.mark.parametrize("side", ["behind", "ahead", "nearest"])
def test_snapping_to_a_sample_is_recognised(samples, side):
    def snapped(P, count):
        points = bezier_curve(P, np.linspace(0, 1, samples))
        walked = np.append(0, np.cumsum(chords(P, samples)))
        goals = np.linspace(0, walked[-1], count)
        index = {
            "behind": np.searchsorted(walked, goals, side="right") - 1,
            "ahead": np.searchsorted(walked, goals),
            "nearest": abs(walked - goals[:, None]).argmin(axis=1),
        }[side]
        return points[index]

    ends, spacing = places(snapped)
    assert ends.state == "done"
    assert (spacing.state, spacing.mistake) == ("differs", "nearest sample")


def test_equal_time_steps_have_right_ends_and_wrong_spacing():
    ends, spacing = places(lambda P, count: bezier_curve(P, np.linspace(0, 1, count)))
    assert ends.state == "done"
    assert spacing.mistake == "equal time steps"
    assert spacing.message.startswith("18 points, ")


def test_one_row_too_few_is_said_to_be_missing():
    ends, spacing = places(lambda P, count: interpolation.equidistant_points(P, count)[:-1])
    assert "expected (18, 2): one row per point, both ends included" in ends.message
    assert spacing.state == "waits"


def test_only_x_written():
    def only_x(P, count):
        points = interpolation.equidistant_points(P, count)
        points[:, 1] = np.nan
        return points

    assert [found.state for found in places(only_x)] == ["unwritten", "unwritten"]
