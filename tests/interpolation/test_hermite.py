"""Cubic Hermite curves and splines, against SciPy, exact numbers and what always holds."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import CubicHermiteSpline

from canim.interpolation import (
    HERMITE_MATRIX,
    hermite_basis,
    hermite_coefficients,
    hermite_curve,
    hermite_spline,
)

CASES = json.loads((Path(__file__).parents[1] / "cases/hermite.json").read_text("utf-8"))
T = np.linspace(-0.5, 1.5, 41)

number = st.floats(-1e3, 1e3)
ends = st.integers(0, 3).flatmap(lambda dim: arrays(float, (4, dim) if dim else 4, elements=number))


# --- One curve


def test_matrix_solves_the_four_conditions():
    # Rows: f(0), f(1), f'(0), f'(1) of a t³ + b t² + c t + d.
    conditions = [[0, 0, 0, 1], [1, 1, 1, 1], [0, 0, 1, 0], [3, 2, 1, 0]]
    assert (conditions @ HERMITE_MATRIX).tolist() == np.eye(4).tolist()


def test_matrix_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        HERMITE_MATRIX[0, 0] = 1


@pytest.mark.parametrize("case", CASES["basis"])
def test_basis_by_hand(case):
    assert hermite_basis(case["t"]).tolist() == case["values"]


@pytest.mark.parametrize("case", CASES["curve"])
def test_curve_by_hand(case):
    assert hermite_coefficients(*case["ends"]).tolist() == case["coefficients"]
    assert hermite_curve(case["t"], *case["ends"]).tolist() == case["values"]


def test_basis_is_the_polynomials_of_the_matrix():
    for h, column in zip(hermite_basis(T), HERMITE_MATRIX.T, strict=True):
        np.testing.assert_allclose(h, np.polyval(column, T), rtol=0, atol=1e-14)


@pytest.mark.parametrize("shape", [(), (1,), (0,), (2, 3)])
def test_shapes_follow_t(shape):
    t = np.full(shape, 0.5)
    assert hermite_basis(t).shape == (4, *shape)
    assert hermite_curve(t, 0, 1, 0, 0).shape == shape
    assert hermite_curve(t, [0, 0, 0], [1, 1, 1], [0, 0, 0], [1, 2, 3]).shape == (*shape, 3)
    assert hermite_spline(t, [0, 1, 2], [0, 1, 0], [0, 0, 0]).shape == shape
    assert hermite_spline(t, [0, 1], [[0, 0], [1, 1]], [[0, 0], [1, 1]]).shape == (*shape, 2)


def test_basis_keeps_its_digits_near_the_ends():
    tiny = 1e-9
    np.testing.assert_allclose(hermite_basis(tiny)[1:], [3e-18, 1e-9, -1e-18], rtol=1e-8)
    t = 1 - tiny  # As a float this is 1 - 1e-9 to 17 digits only.
    np.testing.assert_allclose(hermite_basis(t)[[0, 2, 3]], [3e-18, 1e-18, -1e-9], rtol=1e-6)


@given(arrays(float, st.integers(0, 9), elements=st.floats(-10, 10)))
def test_the_weights_of_the_ends_add_up_to_one(t):
    h0, h1, h2, h3 = hermite_basis(t)
    np.testing.assert_allclose(h0 + h1, 1, atol=1e-11)
    # A straight line with its own slope stays the straight line.
    np.testing.assert_allclose(h1 + h2 + h3, t, atol=1e-11)


@given(ends)
def test_curve_has_the_given_ends_and_slopes(given_ends):
    f0, f1, d0, d1 = given_ends
    assert (hermite_curve(0, *given_ends) == f0).all()
    assert (hermite_curve(1, *given_ends) == f1).all()
    a, b, c, d = hermite_coefficients(*given_ends)
    np.testing.assert_allclose(d, f0)
    np.testing.assert_allclose(a + b + c + d, f1, atol=1e-11)
    np.testing.assert_allclose(c, d0)
    np.testing.assert_allclose(3 * a + 2 * b + c, d1, atol=1e-11)


@given(ends, arrays(float, st.integers(0, 5), elements=st.floats(-2, 2)))
def test_curve_and_coefficients_agree(given_ends, t):
    coefficients = hermite_coefficients(*given_ends)
    curve = hermite_curve(t, *given_ends)
    for place, parameter in enumerate(t):
        expected = np.polynomial.polynomial.polyval(parameter, coefficients[::-1])
        np.testing.assert_allclose(curve[place], expected, rtol=0, atol=1e-9)


@given(
    arrays(float, (4, 2), elements=number),
    arrays(float, (2, 2), elements=number),
    arrays(float, 2, elements=number),
    st.floats(0, 1),
)
def test_curve_moves_with_its_ends(given_ends, matrix, shift, t):
    moved = given_ends @ matrix
    moved[:2] += shift  # Tangents are directions: they do not move.
    expected = hermite_curve(t, *given_ends) @ matrix + shift
    np.testing.assert_allclose(hermite_curve(t, *moved), expected, rtol=0, atol=1e-7)


@pytest.mark.parametrize(
    "wrong",
    [
        (1, 1, 0, [1]),
        ([1, 2], [1, 2], [1, 2], [1, 2, 3]),
        ([[1]], [[1]], [[1]], [[1]]),
        ([], [], [], []),
    ],
)
def test_ends_that_do_not_fit(wrong):
    for call in (lambda: hermite_coefficients(*wrong), lambda: hermite_curve(0.5, *wrong)):
        with pytest.raises(ValueError, match=r"^f0, f1, d0, d1 must be four numbers or four"):
            call()


# --- Splines


@pytest.mark.parametrize("pieces", [1, 2, 9, 3000])
@pytest.mark.parametrize("dim", [None, 1, 3])
@pytest.mark.parametrize("count", [7, 50_000])
def test_spline_agrees_with_scipy(pieces, dim, count):
    rng = np.random.default_rng(pieces)
    knots = np.cumsum(rng.uniform(0.1, 2, pieces + 1)) - 5
    values, slopes = rng.normal(size=(2, pieces + 1, *([dim] if dim else [])))
    t = np.sort(rng.uniform(knots[0] - 0.1, knots[-1] + 0.1, count))
    expected = CubicHermiteSpline(knots, values, slopes)(t)
    shuffled = rng.permutation(count)
    for order in (slice(None), slice(None, None, -1), shuffled):
        result = hermite_spline(t[order], knots, values, slopes)
        np.testing.assert_allclose(result, expected[order], rtol=0, atol=1e-11)


def test_spline_of_one_piece_is_the_curve():
    given_ends = (1, -2, 0.5, 3)
    expected = hermite_curve(T, *given_ends)
    result = hermite_spline(T, [0, 1], given_ends[:2], given_ends[2:])
    np.testing.assert_allclose(result, expected, atol=1e-14)


def test_outside_the_knots_the_end_pieces_go_on():
    # Both pieces of this spline are t³.
    knots, values, slopes = [-1, 0, 2], [-1, 0, 8], [3, 0, 12]
    t = np.array([-5, -2, 3, 10])
    np.testing.assert_allclose(hermite_spline(t, knots, values, slopes), t**3, rtol=1e-14)


@st.composite
def splines(draw):
    gaps = draw(arrays(float, st.integers(1, 9), elements=st.floats(0.01, 10)))
    knots = np.concatenate([[0], np.cumsum(gaps)]) + draw(number)
    values, slopes = draw(arrays(float, (2, len(knots)), elements=number))
    return knots, values, slopes


@given(splines())
def test_spline_has_the_given_values_and_slopes(spline):
    knots, values, slopes = spline
    np.testing.assert_allclose(hermite_spline(knots, *spline), values, rtol=0, atol=1e-9)
    for order in (slice(None, -1), slice(-2, None, -1)):  # A knot belongs to the piece it begins.
        assert (hermite_spline(knots[order], *spline) == values[order]).all()
    step, h = 1e-6, np.diff(knots).min()
    slack = 10 * step * (np.abs(values).max() / h**2 + np.abs(slopes).max() / h) + 1e-3
    for side in (-1, 1):
        near = hermite_spline(knots + side * step, *spline)
        np.testing.assert_allclose(side * (near - values) / step, slopes, rtol=0, atol=slack)


@given(splines(), st.integers(0, 8), st.floats(0, 1))
def test_every_piece_is_the_curve_of_its_ends(spline, piece, w):
    knots, values, slopes = spline
    i = min(piece, len(knots) - 2)
    h = knots[i + 1] - knots[i]
    t = knots[i] + w * h
    if t < knots[i + 1]:
        expected = hermite_curve((t - knots[i]) / h, *values[i : i + 2], *h * slopes[i : i + 2])
        assert hermite_spline(t, *spline) == pytest.approx(expected, rel=1e-12, abs=1e-9)


def test_knots_that_lie_as_close_or_as_far_as_floats_can():
    for h in (5e-324, 1e-310, 1e300):
        result = hermite_spline([0, h, 2 * h], [0, h], [1, 3], [0, 0])
        np.testing.assert_allclose(result, [1, 3, -7], rtol=1e-14)
    with pytest.raises(ValueError, match=r"^knots: too large"):
        hermite_spline(0, [-1.7e308, 1.7e308], [1, 3], [0, 0])


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"knots": [0]}, "knots needs 2 or more"),
        ({"knots": []}, "knots needs 2 or more"),
        ({"knots": 0}, "knots must be a list"),
        ({"knots": [[0, 1, 2]]}, "knots must be a list"),
        ({"knots": [0, 1, 1]}, r"knots must increase, but knots\[1\] is 1.0 and knots\[2\]"),
        ({"knots": [0, 2, 1]}, "knots must increase"),
        ({"values": [1, 2]}, "values must hold 3 numbers"),
        ({"values": 1}, "values must hold 3 numbers"),
        ({"slopes": [1, 2, 3, 4]}, "slopes must hold 3 numbers"),
        ({"slopes": np.zeros((3, 0))}, "slopes must hold 3 numbers"),
        ({"slopes": np.zeros((3, 2))}, r"values and slopes must .* \(3,\) and \(3, 2\)"),
    ],
)
def test_splines_that_do_not_fit(wrong, message):
    good = {"t": 0.5, "knots": [0, 1, 2], "values": [1, 0, 1], "slopes": [0, 0, 0]}
    with pytest.raises(ValueError, match=rf"^{message}"):
        hermite_spline(**good | wrong)
