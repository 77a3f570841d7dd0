"""Task 1.6: what the check accepts and what it tells apart."""

from math import comb, factorial

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["1.6"]
POWERS, WAYS = "powers", "number of ways"


def report(function):
    return checks.run(TASK, {"bernstein_basis": function}, hint=True)


def states(function):
    return {result.part: result.state for result in report(function).results}


def starter(n, t):
    B = np.full((n + 1, len(t)), np.nan)
    B[0] = (1 - t) ** n
    return B


def in_nested_lists(n, t):
    return [[comb(n, i) * s**i * (1 - s) ** (n - i) for s in t] for i in range(n + 1)]


def with_factorials(n, t):
    B = starter(n, t)
    for i in range(n + 1):
        ways = factorial(n) / (factorial(i) * factorial(n - i))
        B[i] = ways * np.power(t, i) * np.power(1 - t, n - i)
    return B


def by_recursion(n, t):
    if n == 0:
        return np.ones((1, len(t)))
    lower = by_recursion(n - 1, t)
    B = np.zeros((n + 1, len(t)))
    B[:-1] = (1 - t) * lower
    B[1:] += t * lower
    return B


@pytest.mark.parametrize("style", [in_nested_lists, with_factorials, by_recursion])
def test_right_in_any_style(style):
    assert report(style).done


def test_powers_alone_are_a_step_that_is_done():
    def half(n, t):
        B = starter(n, t)
        for i in range(1, n + 1):
            B[i] = t**i * (1 - t) ** (n - i)
        return B

    assert states(half) == {"first curve": "done", POWERS: "done", WAYS: "differs"}


def test_numbers_told_of_the_powers_are_those_of_the_curves():
    def powers_of_t(n, t):
        B = starter(n, t)
        for i in range(1, n + 1):
            B[i] = t**i
        return B

    first, powers, ways = report(powers_of_t).results
    assert (first.state, powers.state, ways.state) == ("done", "differs", "unwritten")
    assert powers.message.startswith("n = 3, b1 at t = 1: expected 0, got 1")
    assert powers.mistake == "no powers of 1 - t"


def test_powers_alone_are_compared_with_powers_alone():
    def one_less(n, t):
        B = starter(n, t)
        for i in range(1, n + 1):
            B[i] = t**i * (1 - t) ** n
        return B

    powers = report(one_less).results[1]
    assert powers.message.startswith("n = 3, b3 at t = 1: expected 1, got 0")
    assert powers.mistake == "power n of 1 - t"


@pytest.mark.parametrize("outside", [True, False])
def test_an_exponent_without_brackets_is_recognised(outside):
    def minus(n, t):
        B = starter(n, t)
        for i in range(1, n + 1):
            B[i] = comb(n, i) * (t**i * (1 - t) ** n) - i * (1 if outside else comb(n, i))
        return B

    assert report(minus).results[1].mistake == "exponent without brackets"


@pytest.mark.parametrize("ways", [lambda n, i: comb(3, i), lambda n, i: comb(i, n)])
def test_a_wrong_number_of_ways_leaves_the_powers_alone(ways):
    def wrong(n, t):
        B = starter(n, t)
        for i in range(1, n + 1):
            B[i] = ways(n, i) * t**i * (1 - t) ** (n - i)
        return B

    assert states(wrong) == {"first curve": "done", POWERS: "done", WAYS: "differs"}
    assert report(wrong).results[2].mistake


def test_powers_that_are_swapped_in_the_loop_only_are_recognised():
    def swapped(n, t):
        B = starter(n, t)
        for i in range(1, n + 1):
            B[i] = comb(n, i) * t ** (n - i) * (1 - t) ** i
        return B

    found = report(swapped)
    assert [result.mistake for result in found.results] == ["", "t and 1 - t swapped", ""]


def test_a_hard_wired_cubic_is_told_for_which_degree_it_stops():
    def cubic(n, t):
        B = starter(n, t)
        B[1] = 3 * t * (1 - t) ** 2
        B[2] = 3 * t**2 * (1 - t)
        B[3] = t**3
        return B

    assert "For n = 1" in " ".join(str(report(cubic)).split())


def test_one_curve_too_few_is_said_once():
    def too_few(n, t):
        return [comb(n, i) * t**i * (1 - t) ** (n - i) for i in range(n)]

    text = " ".join(str(report(too_few)).split())
    assert text.count("expected (4, 11)") == 1
    assert "n + 1 rows" in text


def test_only_zeros_are_not_done():
    found = states(lambda n, t: np.zeros((n + 1, len(t))))
    assert list(found.values()) == ["differs", "unwritten", "unwritten"]


def test_a_fixed_number_of_ways_is_no_solution():
    def always_three(n, t):
        B = starter(n, t)
        for i in range(1, n + 1):
            B[i] = (1 if i in (0, n) else 3) * t**i * (1 - t) ** (n - i)
        return B

    assert states(always_three)[WAYS] == "differs"
    assert "degree 3 only" in {result.mistake for result in report(always_three).results}
