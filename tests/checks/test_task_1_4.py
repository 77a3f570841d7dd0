"""Task 1.4: the check works with the curve and the nodes that the student picked."""

import math

import numpy as np
import pytest

from canim import checks
from canim.interpolation import lagrange_interpolate

TASK = checks.TASKS["1.4"]
NAN = np.nan


def sample(f, nodes):
    values = []
    for node in nodes:
        values.append(f(node))
    return values


def interpolate(f, nodes, x):
    return lagrange_interpolate(nodes, sample(f, nodes), x)


def report(**changes):
    names = {
        "f": lambda x: 1 / x,
        "nodes": np.array([1, 2, 3]),
        "sample": sample,
        "interpolate": interpolate,
    }
    return checks.run(TASK, names | changes, hint=True)


def states(**changes):
    return [result.state for result in report(**changes).results]


def _bump(x):
    if x < 0:
        return 0
    return math.sqrt(x)


CURVES = {
    "an array at once": lambda x: np.sin(x) + 2,
    "one number at a time": _bump,
    "whole numbers": lambda x: x // 1,
    "only arrays": lambda x: np.sort(x),
    "Runge": lambda x: 1 / (1 + 25 * x**2),
}


@pytest.mark.parametrize("f", [v for k, v in CURVES.items() if k != "only arrays"])
@pytest.mark.parametrize(
    "nodes",
    [
        [1, 2, 3],
        (0.5, 4, -1, 2),
        np.linspace(-1, 1, 11),
        np.cos(np.pi * (np.arange(21) + 0.5) / 21),
    ],
)
def test_any_curve_and_any_nodes_are_done(f, nodes):
    assert states(f=f, nodes=nodes) == ["done"] * 4


def test_samples_may_be_taken_all_at_once():
    at_once = report(
        f=CURVES["an array at once"],
        sample=lambda f, nodes: f(nodes),
        interpolate=lambda f, nodes, x: lagrange_interpolate(nodes, f(nodes), x),
    )
    assert at_once.done
    assert not at_once.notes


def test_a_curve_that_takes_arrays_only_is_judged_by_arrays():
    found = states(f=CURVES["only arrays"], sample=lambda f, nodes: f(nodes))
    assert found[:3] == ["done"] * 3


def test_nothing_chosen_yet_is_not_written_yet_and_the_rest_is_judged_already():
    unchosen = {"f": lambda x: NAN * x, "nodes": np.array([1, NAN, NAN])}
    assert states(**unchosen) == ["unwritten", "unwritten", "done", "done"]
    assert states(nodes=np.array([1, 2, NAN])) == ["done", "unwritten", "done", "done"]
    assert states(f=lambda x: NAN * x) == ["unwritten", "done", "done", "done"]


@pytest.mark.parametrize(
    ("nodes", "words"),
    [
        ([1, 2, 2], "nodes holds 2 more than once: no two samples may share a place."),
        ([1, 2], "nodes must hold at least three places, but holds 2."),
        ([1, 2, np.inf], "nodes holds a place that is infinite."),
        ([[1, 2, 3]], "nodes must be one list of numbers, but has shape (1, 3)."),
        ("1, 2, 3", "nodes must be a list of numbers."),
        ([1, [2], 3], "nodes must be a list of numbers."),
    ],
)
def test_a_choice_of_nodes_that_cannot_work_is_said_once(nodes, words):
    found = report(nodes=nodes).results
    assert [result.message for result in found] == ["", words, "", ""]
    assert [result.state for result in found] == ["done", "unusable", "waits", "waits"]


def test_a_node_where_the_curve_has_no_height_is_named():
    found = report(nodes=[1, 0, 2]).results
    assert found[0].message.startswith("f is inf at your node 0: it has no height there.")
    assert [result.state for result in found] == ["unusable", "done", "waits", "waits"]
    root = report(f=np.sqrt, nodes=[-1, -2, -3]).results
    assert root[0].message.startswith("f is nan at your node -1")


@pytest.mark.parametrize(
    ("f", "words"),
    [
        (lambda x: None, "f returns nothing (None)."),
        (lambda x: "1 / x", "f returns a text"),
        (lambda x: np.array([x, x]), "f returns an array of shape (2,), expected"),
        (lambda x: x + unknown, "f stops"),  # noqa: F821
    ],
)
def test_a_curve_that_cannot_be_used_is_said_once(f, words):
    found = report(f=f).results
    assert found[0].message.startswith(words)
    assert [result.state for result in found[2:]] == ["waits", "waits"]


def test_a_curve_that_takes_no_arrays_stops_under_its_own_name():
    found = report(f=_bump, sample=lambda f, nodes: f(nodes)).results
    assert found[0].state == "done"
    assert found[2].message.startswith("f stops")
    assert "One number is needed here, but there is an array." in found[2].message


def test_samples_fixed_to_the_student_s_own_curve_do_not_pass():
    found = report(sample=lambda f, nodes: 1 / np.asarray(nodes)).results
    assert found[2].state == "differs"
    assert found[2].message.startswith("f(x) = 1/(1 + x**2) at 1, 2, 3, at nodes[0]")


def test_a_curve_that_differs_is_told_with_its_place():
    def too_high(f, nodes, x):
        return interpolate(f, nodes, x) + 2 * (x == 2)

    found = report(interpolate=too_high).results[3]
    assert found.message == "your f and nodes, at x = 2: expected 0.5, got 2.5"
    other = report(nodes=[1, 3, 4.5], interpolate=too_high).results[3]
    assert other.message == "f(x) = 1/(1 + x**2) at 1, 2, 3, at x = 2: expected 0.2, got 2.2"


def test_while_the_samples_are_missing_the_curve_is_not_written_rather_than_stopped():
    def missing(f, nodes):
        return np.full(len(nodes), np.nan)

    def curve_of_it(f, nodes, x):
        return lagrange_interpolate(nodes, missing(f, nodes), x)

    assert states(sample=missing, interpolate=curve_of_it)[2:] == ["unwritten"] * 2
    assert states(interpolate=curve_of_it)[2:] == ["done", "crashed"]


def test_mistakes_are_told_with_any_curve_and_nodes():
    chosen = {"f": np.exp, "nodes": [0.0, 0.5, 2.0, 1.0]}

    def counted(f, nodes):
        return [f(k) for k in range(len(nodes))]

    found = report(
        **chosen,
        sample=counted,
        interpolate=lambda f, nodes, x: lagrange_interpolate(nodes, counted(f, nodes), x),
    )
    assert found.results[2].mistake == "sampled at 0, 1, 2"
    exchanged = report(
        **chosen,
        interpolate=lambda f, nodes, x: lagrange_interpolate(sample(f, nodes), nodes, x),
    )
    assert exchanged.results[3].mistake == "nodes and values exchanged"
