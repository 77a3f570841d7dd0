"""Quadratic splines, against SciPy, plain loops, exact numbers and what always holds."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import make_interp_spline

from canim.interpolation import (
    lagrange_interpolate,
    quadratic_spline,
    quadratic_spline_system,
)

CASES = json.loads((Path(__file__).parents[1] / "cases/quadratic_spline.json").read_text("utf-8"))
X, Y = CASES["x"], CASES["y"]

number = st.floats(-100, 100)
starts = st.one_of(st.sampled_from(["straight", "flat"]), number)


def plain_slopes(x, y, start):
    """Return the slopes, one after the other."""
    lines = [(y[i + 1] - y[i]) / (x[i + 1] - x[i]) for i in range(len(x) - 1)]
    slopes = [{"straight": lines[0], "flat": 0.0}.get(start, start)]
    for line in lines:
        slopes.append(2 * line - slopes[-1])
    return slopes


@st.composite
def data(draw, most=12):
    gaps = draw(arrays(float, st.integers(1, most - 1), elements=st.floats(0.1, 10)))
    x = np.concatenate([[0], np.cumsum(gaps)]) + draw(number)
    return x, draw(arrays(float, len(x), elements=number)), draw(starts)


# --- Numbers from outside


@pytest.mark.parametrize("start", ["straight", "flat"])
def test_points_of_the_paper(start):
    expected = CASES["coefficients"][start]
    assert quadratic_spline(X, Y, start).coefficients.tolist() == expected
    A, b = quadratic_spline_system(X, Y, start)
    assert (A @ np.ravel(expected)).tolist() == b.tolist()
    np.testing.assert_allclose(np.linalg.solve(A, b), np.ravel(expected), atol=1e-13)


def test_a_given_slope():
    assert quadratic_spline(X, Y, 0).coefficients.tolist() == CASES["coefficients"]["flat"]
    assert quadratic_spline(X, Y, -5.0).coefficients.tolist() == CASES["coefficients"]["straight"]
    assert quadratic_spline(X, Y, np.float32(2)).slopes[0] == 2
    A, b = quadratic_spline_system(X, Y, 7)
    assert A[-1].tolist() == [-6, 1, 0, 0, 0, 0, 0, 0, 0]
    assert b[-1] == 7


@pytest.mark.parametrize(
    ("function", "ends", "name"),
    [
        (np.sin, (0, 2 * np.pi), "sine"),
        (lambda x: 1 / (1 + 25 * x**2), (-1, 1), "runge"),
    ],
)
def test_largest_errors_for_functions_of_the_course(function, ends, name):
    x, everywhere = np.linspace(*ends, 11), np.linspace(*ends, 20_001)
    for method, largest in CASES["largest_errors"][name].items():
        if method == "lagrange":
            result = lagrange_interpolate(x, function(x), everywhere)
        else:
            result = quadratic_spline(x, function(x), method)(everywhere)
        error = np.abs(result - function(everywhere)).max()
        assert error == pytest.approx(largest, rel=0.025)


@pytest.mark.parametrize("count", [3, 4, 10, 300])
@pytest.mark.parametrize("slope", [-2, 0.5])
def test_agrees_with_scipy(count, slope):
    rng = np.random.default_rng(count)
    x, y = np.cumsum(rng.uniform(0.5, 1.5, count)), rng.normal(size=count)
    knots = np.concatenate([[x[0]] * 3, x[1:-1], [x[-1]] * 3])
    peer = make_interp_spline(x, y, k=2, t=knots, bc_type=([(1, slope)], None))
    spline = quadratic_spline(x, y, slope)
    everywhere = np.linspace(x[0], x[-1], 1001)
    scale = np.abs(spline(everywhere)).max()
    np.testing.assert_allclose(spline(everywhere), peer(everywhere), atol=1e-11 * scale)


# --- The system


@given(data(most=6))
def test_system_has_the_spline_as_its_solution(given_data):
    x, y, start = given_data
    A, b = quadratic_spline_system(x, y, start)
    assert A.shape == (3 * len(x) - 3, 3 * len(x) - 3)
    assert b.shape == (3 * len(x) - 3,)
    solution = quadratic_spline(x, y, start).coefficients.ravel()
    slack = 1e-13 * (np.abs(A) @ np.abs(solution) + np.abs(b)) + 1e-12
    assert (np.abs(A @ solution - b) <= slack).all()
    assert np.linalg.matrix_rank(A[:-1]) == len(A) - 1  # Only the start was left open.


def test_rows_of_the_system():
    A, b = quadratic_spline_system([1, 2, 4], [5, 6, 7])
    assert A.tolist() == [
        [1, 1, 1, 0, 0, 0],
        [4, 2, 1, 0, 0, 0],
        [0, 0, 0, 4, 2, 1],
        [0, 0, 0, 16, 4, 1],
        [4, 1, 0, -4, -1, 0],
        [1, 0, 0, 0, 0, 0],
    ]
    assert b.tolist() == [5, 6, 6, 7, 0, 0]


def test_system_of_too_many_points():
    x = np.arange(3001)
    with pytest.raises(ValueError, match=r"^x must have at most 3000 numbers .* but has 3001"):
        quadratic_spline_system(x, x)
    with pytest.raises(ValueError, match=r"^x: too large"):
        quadratic_spline_system([0, 1e200], [0, 1])


# --- What holds for every input


@given(data())
def test_spline_passes_through_its_points(given_data):
    x, y, start = given_data
    spline = quadratic_spline(x, y, start)
    slack = 1e-13 * (1 + np.abs(spline.slopes).max()) * 10
    np.testing.assert_allclose(spline(x), y, rtol=0, atol=slack)
    assert (spline(x[:-1]) == y[:-1]).all()


@given(data())
def test_pieces_join_with_one_slope(given_data):
    x, y, start = given_data
    spline = quadratic_spline(x, y, start)
    assert spline.coefficients.shape == (len(x) - 1, 3)
    for knots, values, slopes, (a, b, c) in zip(
        np.stack([x[:-1], x[1:]], axis=1),
        np.stack([y[:-1], y[1:]], axis=1),
        np.stack([spline.slopes[:-1], spline.slopes[1:]], axis=1),
        spline.coefficients,
        strict=True,
    ):
        size = abs(a) * knots**2 + abs(b * knots) + abs(c) + 1
        assert (np.abs(np.polyval([a, b, c], knots) - values) <= 1e-13 * size).all()
        size = abs(2 * a * knots) + abs(b) + 1
        assert (np.abs(np.polyval([2 * a, b], knots) - slopes) <= 1e-13 * size).all()


@given(data())
def test_start_is_as_asked(given_data):
    x, y, start = given_data
    spline = quadratic_spline(x, y, start)
    if start == "straight":
        assert spline.coefficients[0, 0] == 0
    else:
        assert spline.slopes[0] == (0 if start == "flat" else start)


@given(data(), st.floats(-10, 10), number)
def test_spline_moves_with_its_points(given_data, factor, shift):
    x, y, start = given_data
    moved = factor * start if isinstance(start, float) else start
    first = quadratic_spline(x, factor * y + shift, moved)(x[:-1] + np.diff(x) / 3)
    last = factor * quadratic_spline(x, y, start)(x[:-1] + np.diff(x) / 3) + shift
    size = 1e4 * (1 + np.abs(quadratic_spline(x, y, start).slopes).max())
    np.testing.assert_allclose(first, last, rtol=0, atol=1e-13 * size)


@pytest.mark.parametrize("start", ["straight", "flat", 0.25])
@pytest.mark.parametrize("count", [2, 3, 4, 1000, 100_000])
def test_running_sum_errs_no_more_than_the_plain_loop(count, start):
    rng = np.random.default_rng(count)
    x, y = np.cumsum(rng.uniform(0.1, 3, count)), rng.normal(size=count)
    slopes = quadratic_spline(x, y, start).slopes
    assert slopes.tolist() == plain_slopes(x.tolist(), y.tolist(), start)


def test_errors_do_not_grow_over_many_points():
    # A parabola is its own spline: the exact slopes are known.
    x = np.linspace(-1, 1, 100_001)
    spline = quadratic_spline(x, x**2, -2.0)
    np.testing.assert_allclose(spline.slopes, 2 * x, rtol=0, atol=1e-8)
    middle = (x[:-1] + x[1:]) / 2
    np.testing.assert_allclose(spline(middle), middle**2, rtol=0, atol=1e-13)


def test_far_from_zero_the_spline_keeps_its_digits():
    x = np.array(X) + 1e9
    np.testing.assert_allclose(
        quadratic_spline(x, Y)(x + 0.5), quadratic_spline(X, Y)(x + 0.5 - 1e9)
    )


# --- Evaluating


@pytest.mark.parametrize("shape", [(), (1,), (0,), (2, 3)])
def test_shapes_follow_x(shape):
    assert quadratic_spline(X, Y)(np.full(shape, 0.5)).shape == shape


@pytest.mark.parametrize("count", [5, 30_000])
def test_any_order(count):
    spline = quadratic_spline(X, Y, "flat")
    x = np.linspace(-4, 4, count)
    mixed = np.random.default_rng(4).permutation(count)
    np.testing.assert_allclose(spline(x[mixed]), spline(x)[mixed], atol=1e-13)
    piece = np.clip(np.searchsorted(X, x, side="right") - 1, 0, 2)
    expected = [np.polyval(spline.coefficients[i], value) for i, value in zip(piece, x)]
    np.testing.assert_allclose(spline(x), expected, rtol=0, atol=1e-12)


def test_outside_the_knots_the_end_pieces_go_on():
    spline = quadratic_spline(X, Y, "flat")
    for x, piece in ((-10, 0), (12, -1)):
        assert spline(x) == pytest.approx(np.polyval(spline.coefficients[piece], x))


def test_later_changes_of_the_points_do_not_reach_the_spline():
    x, y = np.array(X, dtype=float), np.array(Y, dtype=float)
    spline = quadratic_spline(x, y)
    before = spline([-2, 0.5])
    x *= 2
    y += 1
    assert spline([-2, 0.5]).tolist() == before.tolist()
    assert spline.knots.tolist() == X


@pytest.mark.parametrize(
    ("bad", "error"), [("1", TypeError), (None, TypeError), (np.nan, ValueError)]
)
def test_wrong_places(bad, error):
    with pytest.raises(error, match=r"^x must hold"):
        quadratic_spline(X, Y)(bad)
    with pytest.raises(ValueError, match=r"^x: too large"):
        quadratic_spline(X, Y)(1e200)


# --- Bad input


@pytest.mark.parametrize("call", [quadratic_spline, quadratic_spline_system])
@pytest.mark.parametrize(
    ("wrong", "error", "message"),
    [
        ({"x": [1]}, ValueError, "x needs 2 or more numbers, but has 1"),
        ({"x": []}, ValueError, "x needs 2 or more numbers, but has 0"),
        ({"x": 1}, ValueError, "x must be a list"),
        ({"x": [X]}, ValueError, "x must be a list"),
        ({"x": [-3, -1, -1, 3]}, ValueError, r"x must increase, but x\[1\] is -1.0 and x\[2\]"),
        ({"x": [3, 1, -1, -3]}, ValueError, "x must increase"),
        ({"y": [1, 2, 3]}, ValueError, "x and y must have the same number of values.* 4 and 3"),
        ({"y": []}, ValueError, "y needs 1 or more"),
        ({"y": np.zeros((4, 2))}, ValueError, "y must be a list"),
        ({"start": "linear"}, ValueError, "start must be .*but is 'linear'"),
        ({"start": None}, TypeError, "start must hold real numbers, but holds None"),
        ({"start": [0]}, ValueError, r"start must be a single slope, but has shape \(1,\)"),
        ({"start": np.inf}, ValueError, "start must hold finite"),
        ({"start": True}, TypeError, "start must hold real numbers, but holds truth values"),
    ],
)
def test_points_that_do_not_fit(call, wrong, error, message):
    with pytest.raises(error, match=rf"^{message}"):
        call(**{"x": X, "y": Y, "start": "straight"} | wrong)


@pytest.mark.parametrize(
    ("x", "y", "start"),
    [
        ([0, 1, 2], [0, 1.7e308, -1.7e308], "flat"),
        ([0, 5e-324, 1], [0, 1, 2], "straight"),
        ([1e200, 2e200], [0, 1], 1e200),
        ([0, 1, 2], [0, 1, 2], 1.7e308),
    ],
)
def test_splines_that_do_not_fit_a_float(x, y, start):
    with pytest.raises(ValueError, match=r"^x, y, start: too large"):
        quadratic_spline(x, y, start)
    with pytest.raises(ValueError, match=r"^x: too large"):
        quadratic_spline([-1.7e308, 1.7e308], [0, 1])


def test_very_small_and_very_large_points():
    assert quadratic_spline([0, 1e-300], [0, 1e-300]).slopes == pytest.approx([1, 1])
    spline = quadratic_spline([0, 1e300], [1e300, 0])
    assert spline(5e299) == pytest.approx(5e299)
    assert quadratic_spline([0, 5e-324], [0, 5e-324])([0, 5e-324]).tolist() == [0, 5e-324]


def test_far_from_0_the_spline_is_exact_and_its_coefficients_are_not():
    near, far = (quadratic_spline(start + np.arange(4), [0, 1, 0, 2]) for start in (0, 1e8))
    x = np.linspace(0, 3, 25)
    assert np.array_equal(near(x), far(1e8 + x))
    powers = np.polyval(far.coefficients[2], 1e8 + 2.5)
    assert abs(powers - near(2.5)) > 0.2, "then the docstring need not warn"
