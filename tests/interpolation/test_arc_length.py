"""Length and equal distances along Bézier curves, against numbers from outside and SciPy."""

from __future__ import annotations

import importlib
import json
import math
import tracemalloc
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.integrate import quad

from canim.interpolation import (
    arc_length,
    bezier_curve,
    de_casteljau,
    equidistant_parameters,
    equidistant_points,
)

CASES = json.loads((Path(__file__).parents[1] / "cases/arc_length.json").read_text("utf-8"))
LENGTHS = CASES["lengths"]
CUBIC = np.array(CASES["chords"]["control_points"], dtype=float)
# Also close to the ends of cells, and where a pair of quadrature rules errs alike.
CUSPS = [0, 1e-9, 1e-4, 0.1, 0.14493083, 1 / 3, 0.44128778, 0.5, 0.50001, 0.7182818, 0.9999, 1]
CALLS = {
    arc_length: {"control_points": CUBIC, "samples": 10},
    equidistant_points: {"control_points": CUBIC, "count": 10},
    equidistant_parameters: {"control_points": CUBIC, "count": 10},
}


def polygon_length(corners):
    return sum(math.dist(*pair) for pair in pairwise(corners))


def cusp_at(place):
    """Return the cubic ((t - place)^2, (t - place)^3) and its exact length up to every t."""
    x = np.polynomial.polynomial.polypow([-place, 1], 2)
    y = np.polynomial.polynomial.polypow([-place, 1], 3)
    powers = np.transpose([[*x, 0], y])
    to_bernstein = [[math.comb(i, j) / math.comb(3, j) for j in range(4)] for i in range(4)]

    def from_cusp(t):
        u = np.abs(t - place)
        return np.sign(t - place) * ((4 + 9 * u**2) ** 1.5 - 8) / 27

    return to_bernstein @ powers, lambda t: from_cusp(t) - from_cusp(0)


def part(corners, start, end):
    """Return the control points of the curve between two parameters, by subdivision."""
    after = [level[-1] for level in de_casteljau(corners, start)[::-1]]
    return [level[0] for level in de_casteljau(after, (end - start) / (1 - start))]


def largest_spacing_error(corners, t):
    """Return how far the arcs between parameters are from equal, as a share of the length."""
    arcs = np.array([arc_length(part(corners, *pair)) for pair in pairwise(t)])
    return np.abs(arcs / arcs.mean() - 1).max() / len(arcs)


# --- What is right


@pytest.mark.parametrize(("samples", "expected"), CASES["chords"]["sums"].items())
def test_chord_sums_of_the_first_material(samples, expected):
    assert arc_length(CUBIC, int(samples)) == pytest.approx(expected, abs=6e-7)


def test_two_samples_are_the_chord_between_the_ends():
    assert arc_length(CUBIC, samples=2) == pytest.approx(math.hypot(40, 25))


@pytest.mark.parametrize("name", LENGTHS)
def test_length(name):
    expected = LENGTHS[name]["length"]
    length = arc_length(LENGTHS[name]["control_points"])
    assert type(length) is float
    assert length == pytest.approx(expected, rel=1e-11, abs=0)


@pytest.mark.parametrize("place", CUSPS)
def test_length_with_a_cusp_anywhere(place):
    corners, exact = cusp_at(place)
    assert arc_length(corners) == pytest.approx(exact(1), rel=3e-11)


@pytest.mark.parametrize("degree", [1, 2, 3, 5, 10, 30, 200])
def test_length_agrees_with_scipy(degree):
    corners = np.random.default_rng(degree).uniform(-1, 1, (degree + 1, 3))
    steps = degree * np.diff(corners, axis=0)

    def speed(t):
        return np.linalg.norm(bezier_curve(steps, t))

    expected = quad(speed, 0, 1, epsrel=1e-11, epsabs=0, limit=300)[0]
    assert arc_length(corners) == pytest.approx(expected, rel=1e-10)


def test_equal_steps_of_the_paper():
    points = equidistant_points(CUBIC, 18)
    assert points.shape == (18, 2)
    assert points[[0, -1]].tolist() == CUBIC[[0, -1]].tolist()
    t = equidistant_parameters(CUBIC, 18)
    assert (points[1:-1] == bezier_curve(CUBIC, t)[1:-1]).all()
    assert largest_spacing_error(CUBIC, t) < 1e-10


@pytest.mark.parametrize("name", [name for name in LENGTHS if LENGTHS[name]["length"] > 0])
@pytest.mark.parametrize("count", [2, 3, 100])
def test_equal_steps(name, count):
    corners = np.array(LENGTHS[name]["control_points"], dtype=float)
    t = equidistant_parameters(corners, count)
    assert (t[0], t[-1], t.shape) == (0, 1, (count,))
    assert (np.diff(t) > 0).all()
    assert largest_spacing_error(corners, t) < 1e-9


@pytest.mark.parametrize("place", CUSPS)
def test_ten_thousand_equal_steps_past_a_cusp(place):
    corners, exact = cusp_at(place)
    t = equidistant_parameters(corners, 10_000)
    assert (np.diff(t) > 0).all()
    spacing = np.diff(exact(t)) / exact(1)
    np.testing.assert_allclose(spacing, 1 / 9999, rtol=0, atol=1e-9)


def test_equal_steps_of_a_parabola():
    # Its length has a closed form: an oracle for very many points.
    t = equidistant_parameters([[0, 0], [1, 0], [2, 2]], 100_001)
    u = 2 * t  # The curve is (2t, 2t²), that is y = x²/2.
    lengths = (u * np.sqrt(1 + u**2) + np.arcsinh(u)) / 2
    np.testing.assert_allclose(np.diff(lengths) / lengths[-1], 1e-5, rtol=0, atol=1e-10)


def chebyshev(degree):
    """Return the curve that goes from -1 to 1 and back, `degree` times in all."""
    return [
        [(-1) ** (degree - k) * math.comb(2 * degree, 2 * k) / math.comb(degree, k)]
        for k in range(degree + 1)
    ]


@pytest.mark.parametrize("degree", [4, 10, 20])
def test_a_line_there_and_back_many_times(degree):
    corners = chebyshev(degree)
    assert arc_length(corners) == pytest.approx(2 * degree, rel=1e-10)
    # Every step is 1 long: from end to end by way of the middle.
    points = equidistant_points(corners, 2 * degree + 1)[:, 0]
    expected = np.cos(np.pi * (degree - np.arange(2 * degree + 1) / 2))
    np.testing.assert_allclose(points, expected, rtol=0, atol=2e-9 * degree)


def test_control_points_that_cancel():
    # Numbers of 1e12 make a curve between -1 and 1: rounding leaves it only a few digits.
    corners = chebyshev(40)
    assert arc_length(corners) == pytest.approx(80, abs=1e-16 * polygon_length(corners))
    t = equidistant_parameters(corners, 100_000)
    assert (t[0], t[-1]) == (0, 1)
    assert (np.diff(t) >= 0).all()
    assert np.abs(bezier_curve(corners, t)).max() < 1.1
    # Here nothing but rounding is left, and no division of the interval can mend it.
    corners = chebyshev(100)
    assert arc_length(corners) <= 1e-15 * polygon_length(corners)


def test_points_of_coincident_control_points():
    # The curve is t^3: Newton's method leaves the cell near its beginning.
    t = equidistant_parameters([[0], [0], [0], [2]], 1001)
    np.testing.assert_allclose(t, np.cbrt(np.linspace(0, 1, 1001)), rtol=0, atol=1e-9)


@pytest.mark.parametrize("degree", [30, 999])
def test_speed_that_is_almost_nothing_for_long(degree):
    # (t^n): all control points but the last coincide, the speed underflows.
    corners = np.zeros((degree + 1, 1))
    corners[-1] = 5
    assert arc_length(corners) == pytest.approx(5, rel=1e-12)
    points = equidistant_points(corners, 11)
    np.testing.assert_allclose(points[:, 0], np.linspace(0, 5, 11), rtol=0, atol=1e-9)


def test_one_point_has_equal_parameters():
    for corners in ([[1, 2]], [[1, 2]] * 4):
        assert equidistant_parameters(corners, 5).tolist() == [0, 0.25, 0.5, 0.75, 1]
        assert equidistant_points(corners, 3).tolist() == [[1, 2]] * 3


# --- What holds for every input

coordinate = st.floats(-1e3, 1e3, allow_subnormal=False)
polygons = arrays(float, st.tuples(st.integers(2, 8), st.integers(1, 3)), elements=coordinate)


@given(polygons, st.integers(2, 300))
@example(CUBIC, 400)
def test_chords_are_not_longer_than_the_curve_nor_the_curve_than_its_polygon(corners, samples):
    polygon = polygon_length(corners)
    rounding = 1e-15 * samples * np.abs(corners).max()
    assert arc_length(corners, samples) <= arc_length(corners) + 1e-10 * polygon + rounding
    assert arc_length(corners) <= polygon * (1 + 1e-10)


@given(polygons, st.integers(2, 12))
def test_steps_are_equal(corners, count):
    polygon = polygon_length(corners)
    assume(polygon > 0)
    t = equidistant_parameters(corners, count)
    assert (t[0], t[-1]) == (0, 1)
    assert (np.diff(t) >= 0).all()
    arcs = [arc_length(part(corners, *pair)) for pair in pairwise(t) if pair[0] < 1]
    slack = 1e-9 * polygon + 1e-13 * np.abs(corners).max()
    np.testing.assert_allclose(arcs, sum(arcs) / (count - 1), rtol=0, atol=slack)


@given(polygons, st.floats(0.01, 0.99))
def test_length_is_the_sum_of_its_parts(corners, t):
    parts = arc_length(part(corners, 0, t)) + arc_length(part(corners, t, 1))
    slack = 2e-10 * polygon_length(corners) + 1e-13 * np.abs(corners).max()
    assert parts == pytest.approx(arc_length(corners), abs=slack)


@given(polygons, st.integers(2, 9))
@example(np.array([[0.1], [0.7], [0.2], [0.3]]), 4)  # The curve misses its end by rounding.
def test_there_and_back_are_the_same(corners, count):
    slack = 2e-9 * polygon_length(corners) + 1e-13 * np.abs(corners).max()
    back = corners[::-1]
    assert arc_length(back) == pytest.approx(arc_length(corners), abs=slack)
    points, returned = equidistant_points(corners, count), equidistant_points(back, count)
    np.testing.assert_allclose(points, returned[::-1], rtol=0, atol=slack)
    assert (points[[0, -1]] == corners[[0, -1]]).all()


@given(arrays(float, st.tuples(st.integers(0, 6), st.integers(0, 3)), elements=st.floats()))
def test_results_are_finite_or_an_error(corners):
    for call in (
        arc_length,
        lambda corners: arc_length(corners, 5),
        lambda corners: equidistant_points(corners, 5),
        lambda corners: equidistant_parameters(corners, 5),
    ):
        try:
            result = call(corners)
        except ValueError as error:
            if not str(error).startswith("control_points"):
                raise
        else:
            assert np.isfinite(result).all()


# --- Bad input


@pytest.mark.parametrize(
    ("corners", "error"),
    [
        ([], ValueError),
        (1, ValueError),
        ([1, 2], ValueError),
        (np.zeros((4, 0)), ValueError),
        (np.zeros((2, 4, 2)), ValueError),
        (np.zeros((1002, 2)), ValueError),
        ([[1, 2], [3]], ValueError),
        ([[0, 0], [1, math.nan]], ValueError),
        ([[0, 0], [1, math.inf]], ValueError),
        ("a curve", TypeError),
        ([["0", "1"]], TypeError),
        (None, TypeError),
        ([[0, None]], TypeError),
        (CUBIC.astype(object), TypeError),
        (CUBIC * 1j, TypeError),
        (CUBIC > 0, TypeError),
    ],
)
@pytest.mark.parametrize("call", CALLS)
def test_control_points_that_are_none(call, corners, error):
    with pytest.raises(error, match=r"^control_points "):
        call(**CALLS[call] | {"control_points": corners})
    if call is arc_length:
        with pytest.raises(error, match=r"^control_points "):
            arc_length(corners)


@pytest.mark.parametrize(
    ("value", "error"),
    [
        (-1, ValueError),
        (0, ValueError),
        (1, ValueError),
        (2.0, TypeError),
        (math.nan, TypeError),
        ("3", TypeError),
        ([3], TypeError),
        (True, TypeError),
    ],
)
@pytest.mark.parametrize(("call", "name"), [(call, list(CALLS[call])[1]) for call in CALLS])
def test_a_wrong_number_is_named(call, name, value, error):
    with pytest.raises(error, match=rf"^{name} must be a whole number"):
        call(CUBIC, value)


def test_no_count_is_named():
    for call in (equidistant_points, equidistant_parameters):
        with pytest.raises(TypeError, match=r"^count must be a whole number"):
            call(CUBIC, None)


def test_a_length_that_fits_no_float():
    for corners in ([[-1e308], [1e308]], [[0, 0], [1.5e308, 1.5e308]]):
        for samples in (None, 5):
            with pytest.raises(ValueError, match=r"^control_points.*too large"):
                arc_length(corners, samples)


@pytest.mark.parametrize("size", [1e300, 1e-300, 1e-320])
def test_very_large_and_very_small_numbers(size):
    # As a share of the size; a denormal number keeps few digits.
    digits = 1e-9 if size > 1e-308 else 2e-3
    expected = arc_length(CUBIC)
    assert arc_length(CUBIC * size) / size == pytest.approx(expected, rel=digits)
    assert arc_length(CUBIC * size, 100) / size == pytest.approx(59.883442, rel=digits + 1e-8)
    points = equidistant_points(CUBIC * size, 7) / size
    np.testing.assert_allclose(points, equidistant_points(CUBIC, 7), rtol=0, atol=100 * digits)


@pytest.mark.parametrize("call", CALLS)
def test_other_forms_of_the_same_numbers(call):
    expected = call(**CALLS[call])
    for form in (
        lambda value: value.astype(np.float32),
        lambda value: value.astype(int),
        lambda value: value.tolist(),
        np.asfortranarray,
        np.array,
    ):
        corners = form(CUBIC)
        before = np.array(corners)
        if isinstance(corners, np.ndarray):
            corners.flags.writeable = False
        result = call(corners, np.int64(10))
        np.testing.assert_array_equal(result, expected)
        np.testing.assert_array_equal(corners, before)


@pytest.mark.parametrize("degree", [3, 100])
def test_peak_memory(degree):
    corners = np.random.default_rng(3).uniform(-1, 1, (degree + 1, 2))
    count = 10**6 if degree == 3 else 10**4
    tracemalloc.start()
    try:
        points = equidistant_points(corners, count)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak <= 8 * points.nbytes + 16 * 2**20


def test_ten_million_points():
    points = equidistant_points(CUBIC, 10**7)
    spacing = np.linalg.norm(np.diff(points[:: 10**6], axis=0), axis=1)
    assert points.shape == (10**7, 2)
    assert (spacing <= 59.88674195838914 / 9.999_999 * (1 + 1e-9)).all()
    chords = np.linalg.norm(points[1:] - points[:-1], axis=1)
    np.testing.assert_allclose(chords, 59.88674195838914 / (10**7 - 1), rtol=0, atol=6e-8)
    assert arc_length(CUBIC, 10**7) == pytest.approx(59.88674195838914, rel=1e-12)


@pytest.mark.parametrize("tolerance", [1e-12, 0.0])
def test_newton_stays_between_its_bounds_and_ends(tolerance):
    # One cell with a stop in it, at 0.3: steps of Newton's method alone go far astray, and a
    # tolerance of zero is never reached.
    solve = importlib.import_module("canim.interpolation.arc_length")._solve
    hodograph = np.array([[0.09], [-0.21], [0.49]])  # (t - 0.3)², of a cubic
    whole = 0.7**3 + 0.3**3
    targets = np.linspace(0, whole, 101)
    zero, one = np.zeros(101), np.ones(101)
    t = solve(hodograph, zero, one, whole * one, targets, tolerance)
    np.testing.assert_allclose((t - 0.3) ** 3 + 0.3**3, targets, rtol=0, atol=1e-11)
