"""Lagrange interpolation, against exact fractions, SciPy and what always holds."""

from __future__ import annotations

import json
from fractions import Fraction
from math import factorial, prod
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import BarycentricInterpolator

from canim.interpolation import lagrange_basis, lagrange_interpolate

CASES = json.loads((Path(__file__).parents[1] / "cases/lagrange.json").read_text("utf-8"))


def chebyshev(count):
    return np.cos(np.pi * (np.arange(count) + 0.5) / count)


def exact_basis(nodes, x):
    """Return the product formula, worked with fractions: no rounding, no overflow."""
    z, x = [Fraction(node) for node in nodes], Fraction(x)
    return [prod(((x - b) / (a - b) for b in z if b != a), start=Fraction(1)) for a in z]


def check_exactly(nodes, values, x, tolerance=1e-14):
    """Compare with fractions: errors are rounding errors of the terms that are added."""
    basis, interpolant = lagrange_basis(nodes, x), lagrange_interpolate(nodes, values, x)
    tolerance = Fraction(tolerance) * len(nodes)
    for place, where in enumerate(x):
        exact = exact_basis(nodes, where)
        least = sum(map(abs, exact)) / 10**90
        for got, term in zip(basis[:, place], exact, strict=True):
            assert abs(Fraction(got) - term) <= tolerance * abs(term) + least
        terms = [term * Fraction(value) for term, value in zip(exact, values, strict=True)]
        slack = tolerance * sum(map(abs, terms)) + least * max(map(abs, map(Fraction, values)))
        assert abs(Fraction(interpolant[place]) - sum(terms)) <= slack + Fraction(1e-320)


# --- Numbers from outside


@pytest.mark.parametrize("case", CASES["curves"])
def test_polynomial_of_the_paper(case):
    coefficients = [numerator / denominator for numerator, denominator in case["coefficients"]]
    x = np.linspace(min(case["nodes"]) - 2, max(case["nodes"]) + 2, 101)
    result = lagrange_interpolate(case["nodes"], case["values"], x)
    np.testing.assert_allclose(result, np.polyval(coefficients, x), rtol=0, atol=1e-12)


def test_largest_error_for_the_reciprocal():
    case = CASES["reciprocal"]
    x = np.linspace(1, 3, 20_001)
    error = np.abs(lagrange_interpolate(case["nodes"], 1 / np.array(case["nodes"]), x) - 1 / x)
    assert error.max() == pytest.approx(case["largest_error"], abs=1e-5)
    assert x[error.argmax()] == pytest.approx(case["at"], abs=0.005)


@pytest.mark.parametrize("count", [2, 5, 20, 150])
def test_agrees_with_scipy(count):
    values = np.random.default_rng(count).normal(size=(count, 2))
    x = np.linspace(-1, 1, 1001)
    expected = BarycentricInterpolator(chebyshev(count), values)(x)
    result = lagrange_interpolate(chebyshev(count), values, x)
    np.testing.assert_allclose(result, expected, rtol=0, atol=1e-12)


# --- Exact fractions


@pytest.mark.parametrize("count", [1, 2, 3, 8, 30])
@pytest.mark.parametrize("spacing", ["equal", "chebyshev", "random"])
def test_agrees_with_fractions_inside_and_far_outside(count, spacing):
    rng = np.random.default_rng(count)
    nodes = {
        "equal": np.arange(count) / 4,
        "chebyshev": 3 * chebyshev(count) + 1,
        "random": rng.uniform(-2, 2, count),
    }[spacing]
    x = np.concatenate([rng.uniform(nodes.min(), nodes.max(), 8), [-7, 5.5, 1000, -1e5]])
    check_exactly(nodes, rng.normal(size=count), x)


@given(st.data())
def test_agrees_with_fractions_wherever_the_nodes_lie(data):
    number = st.floats(-1e3, 1e3, allow_subnormal=False).map(lambda v: round(v, 6))
    nodes = np.array(data.draw(st.lists(number, min_size=1, max_size=8, unique=True)))
    values = data.draw(arrays(float, len(nodes), elements=number))
    check_exactly(nodes, values, data.draw(st.lists(number, max_size=4)), tolerance=1e-13)


def test_close_to_a_node():
    nodes = np.array([0, 1, 1.5, 4])
    near = [nodes, np.nextafter(nodes, 9), np.nextafter(nodes, -9), nodes + 1e-12, nodes - 1e-12]
    check_exactly(nodes, [1, -2, 3, 5], np.concatenate(near))
    # Near 0 floats lie so close that 1 / (x - node) does not fit one.
    result = lagrange_interpolate(nodes, [1, -2, 3, 5], [5e-324, -1e-310, 1e-300, 1e-200])
    np.testing.assert_allclose(result, 1, rtol=1e-14)
    basis = lagrange_basis(nodes, [5e-324, -1e-310, 1e-300])
    np.testing.assert_allclose(basis, np.outer([1, 0, 0, 0], [1, 1, 1]), atol=1e-14)


def test_close_to_a_node_with_values_near_the_largest_float():
    x = [0, 1e-17, 1e-30, 0.5, 1]
    result = lagrange_interpolate([0, 1, 2], [1.7e308, 1.7e308, 1.7e308], x)
    np.testing.assert_allclose(result, 1.7e308, rtol=1e-14)
    result = lagrange_interpolate([0, 1, 2], [1.7e308, 5e-324, 0], [0, 1, 2])
    assert result.tolist() == [1.7e308, 5e-324, 0]


@pytest.mark.parametrize("scale", [5e-324, 1e-310, 1e-200, 1e200, 1e307])
def test_nodes_of_any_size(scale):
    nodes = scale * np.arange(5.0)
    result = lagrange_interpolate(nodes, [0, 1, 4, 9, 16], nodes * 2)
    np.testing.assert_allclose(result, [0, 4, 16, 36, 64], atol=1e-12)


# --- Many nodes


@pytest.mark.parametrize("count", [20, 100, 1000])
def test_many_chebyshev_nodes_lose_no_digits(count):
    nodes = chebyshev(count)
    x = np.concatenate([np.linspace(-1, 1, 10_001), nodes, np.nextafter(nodes, 0)])
    for degree in (0, 1, 12):
        values = np.cos(degree * np.arccos(nodes))
        expected = np.cos(degree * np.arccos(x))
        result = lagrange_interpolate(nodes, values, x)
        np.testing.assert_allclose(result, expected, rtol=0, atol=1e-13)


@pytest.mark.parametrize("count", [1000, 5000])
def test_order_of_many_nodes_does_not_matter(count):
    # Taken in increasing order, products of this many would overflow.
    nodes = np.sort(chebyshev(count))
    x = np.linspace(-1, 1, 51)
    mixed = np.random.default_rng(3).permutation(count)
    for order in (slice(None), slice(None, None, -1), mixed):
        result = lagrange_interpolate(nodes[order], nodes[order] ** 3, x)
        np.testing.assert_allclose(result, x**3, rtol=0, atol=1e-12)


def test_a_thousand_equal_distances():
    nodes = np.arange(1000.0)
    basis = lagrange_basis(nodes, nodes[::111])
    assert basis.tolist() == np.eye(1000)[:, ::111].tolist()
    # In the middle such polynomials are harmless, near the ends they are huge.
    for twice in (1, 3, 961, 1001, 1997):
        product = prod(twice - 2 * node for node in range(1000))
        exact = [
            Fraction(product, (twice - 2 * j) * (-1) ** (999 - j) * 2**999)
            / (factorial(j) * factorial(999 - j))
            for j in range(1000)
        ]
        basis = lagrange_basis(nodes, twice / 2)
        np.testing.assert_allclose(basis, [float(term) for term in exact], rtol=1e-12)
        result = lagrange_interpolate(nodes, nodes % 2, twice / 2)
        slack = 1e-12 * float(sum(map(abs, exact)))
        assert abs(result - float(sum(exact[1::2]))) <= slack
    assert np.abs(lagrange_basis(nodes, 0.5)).max() > 1e290


@pytest.mark.parametrize("nodes", [np.arange(3000.0), [-1.7e308, 1.7e308], [0, 1e-320, 1e300]])
def test_weights_that_do_not_fit_a_float(nodes):
    for call in (
        lambda: lagrange_basis(nodes, 1),
        lambda: lagrange_interpolate(nodes, nodes, 1),
    ):
        with pytest.raises(ValueError, match=r"^nodes: too many, too far apart or too uneven"):
            call()


def test_points_that_are_out_of_reach():
    nodes = chebyshev(200)
    for x in (1e10, 1e300, [0, -1e10], -1.7e308):
        with pytest.raises(ValueError, match=r"^nodes, x: too large"):
            lagrange_interpolate(nodes, nodes, x)
        with pytest.raises(ValueError, match=r"^nodes, x: too large"):
            lagrange_basis(nodes, x)


# --- What holds for every input


@st.composite
def distinct_nodes(draw):
    gaps = draw(arrays(float, st.integers(0, 11), elements=st.floats(0.1, 2)))
    nodes = np.concatenate([[0], np.cumsum(gaps)]) + draw(st.floats(-10, 10))
    return nodes[draw(st.permutations(range(len(nodes))))]


@given(distinct_nodes(), st.data())
def test_interpolant_passes_through_its_points(nodes, data):
    values = data.draw(arrays(float, len(nodes), elements=st.floats(allow_nan=False, width=32)))
    assume(np.isfinite(values).all())
    assert lagrange_interpolate(nodes, values, nodes).tolist() == values.tolist()
    assert lagrange_basis(nodes, nodes).tolist() == np.eye(len(nodes)).tolist()


@given(distinct_nodes(), arrays(float, st.integers(0, 5), elements=st.floats(-40, 40)))
def test_basis_is_a_partition_of_unity(nodes, x):
    basis = lagrange_basis(nodes, x)
    slack = 1e-13 * np.abs(basis).sum(axis=0)
    assert (np.abs(basis.sum(axis=0) - 1) <= slack).all()
    interpolant = lagrange_interpolate(nodes, np.eye(len(nodes)), x)
    np.testing.assert_allclose(interpolant.T, basis, rtol=1e-12, atol=1e-300)


@given(distinct_nodes(), st.data())
def test_interpolant_moves_with_its_points(nodes, data):
    number = st.floats(-10, 10)
    values = data.draw(arrays(float, (len(nodes), 2), elements=number))
    matrix, shift = data.draw(arrays(float, (2, 2), elements=number)), data.draw(number)
    x = data.draw(st.floats(nodes.min(), nodes.max()))
    moved = lagrange_interpolate(nodes, values @ matrix + shift, x)
    slack = 1e-10 * (1 + np.abs(lagrange_basis(nodes, x)).sum())
    expected = lagrange_interpolate(nodes, values, x) @ matrix + shift
    np.testing.assert_allclose(moved, expected, rtol=0, atol=slack)


any_float = st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(any_float, min_size=1, max_size=6, unique=True), st.data())
def test_right_or_an_error_for_any_floats(nodes, data):
    close = st.sampled_from(nodes).map(lambda node: float(np.nextafter(node, 1)))
    x = data.draw(any_float | st.sampled_from(nodes) | close)
    values = data.draw(arrays(float, len(nodes), elements=any_float))
    try:
        check_exactly(nodes, values, [x], tolerance=1e-13)
    except ValueError as error:
        assert "fit a float" in str(error)  # noqa: PT017


# --- Shapes and bad input


@pytest.mark.parametrize("shape", [(), (1,), (0,), (2, 3)])
def test_shapes_follow_x(shape):
    x = np.full(shape, 0.5)
    assert lagrange_basis([0, 1, 2], x).shape == (3, *shape)
    assert lagrange_interpolate([0, 1, 2], [1, 2, 3], x).shape == shape
    assert lagrange_interpolate([0, 1, 2], np.ones((3, 2)), x).shape == (*shape, 2)


def test_blocks_fit_together():
    # More points and more nodes than are worked on at once.
    nodes, x = chebyshev(150), np.linspace(-1, 1, 10_000).reshape(2, 50, 100)
    points = np.stack([nodes, nodes**2, np.ones_like(nodes)], axis=1)
    result = lagrange_interpolate(nodes, points, x)
    np.testing.assert_allclose(result, np.stack([x, x**2, x**0], axis=-1), atol=1e-13)
    basis = lagrange_basis(nodes, x)
    np.testing.assert_allclose(np.einsum("nijk,nd->ijkd", basis, points), result, atol=1e-13)


@pytest.mark.parametrize(
    ("nodes", "message"),
    [
        ([], "nodes needs 1 or more numbers"),
        (1, "nodes must be a list of numbers"),
        ([[1, 2]], "nodes must be a list of numbers"),
        ([1, 2, 1], r"nodes must differ, but nodes\[0\] and nodes\[2\] are 1\.0"),
        ([0.0, -0.0], r"nodes must differ, but nodes\[0\] and nodes\[1\] are "),
        (np.arange(10_001), "nodes must be at most 10000 for one polynomial, but are 10001"),
    ],
)
def test_nodes_that_do_not_fit(nodes, message):
    with pytest.raises(ValueError, match=rf"^{message}"):
        lagrange_basis(nodes, 0.5)
    with pytest.raises(ValueError, match=rf"^{message}"):
        lagrange_interpolate(nodes, nodes, 0.5)


@pytest.mark.parametrize("values", [[], 1, [1, 2], [1, 2, 3, 4], np.zeros((3, 0)), np.ones((1, 3))])
def test_values_that_do_not_fit(values):
    with pytest.raises(ValueError, match=r"^values must hold 3 numbers, or 3 points"):
        lagrange_interpolate([0, 1, 2], values, 0.5)
