"""The validators that every public function shares."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from canim import _arguments as arguments

NOT_NUMBERS = [
    (None, "None"),
    ("1", "text"),
    (["1", "2"], "text"),
    (b"1", "bytes"),
    ([True, False], "truth values"),
    ([1 + 2j], "complex numbers"),
    ([None, 1.0], "other objects"),
    (np.array([1.0, 2.0], dtype=object), "other objects"),
    ({1, 2}, "other objects"),
    (10**400, "other objects"),
    (np.array(["2026-01-01"], dtype="M8[D]"), "other objects"),
]


@pytest.mark.parametrize(
    "value",
    [
        [1, 2, 3],
        (1.0, 2.0, 3.0),
        np.array([1, 2, 3], dtype=np.uint8),
        np.array([1, 2, 3], dtype=np.float32),
        np.array([3, 2, 1])[::-1],
    ],
)
def test_floats_accepts_whatever_holds_real_numbers(value):
    array = arguments.floats(value, "t")
    assert array.dtype == np.float64
    assert array.tolist() == [1, 2, 3]


@pytest.mark.parametrize("value", [2, 2.5, np.float32(2.5), np.array(2.5)])
def test_floats_accepts_scalars(value):
    assert arguments.floats(value, "t").shape == ()
    assert arguments.floats(value, "t") == value


def test_floats_keeps_extreme_but_finite_numbers():
    value = np.array([1e300, -1.7e308, 1.7e308, 5e-324, -0.0])
    assert arguments.floats(value, "t").tolist() == value.tolist()


@pytest.mark.parametrize(("value", "what"), NOT_NUMBERS)
def test_floats_says_what_came_instead_of_numbers(value, what):
    with pytest.raises(TypeError, match=rf"^t must hold real numbers, but holds {what}.$"):
        arguments.floats(value, "t")


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_floats_names_the_place_of_a_number_that_is_not_finite(bad):
    with pytest.raises(ValueError, match=rf"^t must hold finite numbers, but t is {bad}\.$"):
        arguments.floats(bad, "t")
    with pytest.raises(ValueError, match=rf"but t\[1, 2\] is {bad}\.$"):
        arguments.floats([[1, 1e300, 3], [4, 5, bad]], "t")


def test_floats_refuses_numbers_that_only_a_longer_float_holds():
    if np.finfo(np.longdouble).max > np.finfo(float).max:  # Windows has no longer float.
        with pytest.raises(ValueError, match=r"t\[0\] is inf"):
            arguments.floats(np.array([1, 2], dtype=np.longdouble) * 1e308 * 10, "t")


def test_floats_refuses_rows_of_different_lengths():
    with pytest.raises(ValueError, match=r"^points must be a table"):
        arguments.floats([[1, 2], [3]], "points")


def test_floats_takes_no_memory_for_ten_million_numbers():
    value = np.zeros(10**7)
    tracemalloc.start()
    assert arguments.floats(value, "t") is value
    assert arguments.finite(value, "t") is value
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1e5


@given(hnp.arrays(np.float64, hnp.array_shapes(min_dims=0, max_side=4)))
def test_floats_passes_exactly_the_finite_arrays(value):
    if np.isfinite(value).all():
        assert arguments.floats(value, "t") is value
        assert arguments.finite(value, "t") is value
    else:
        with pytest.raises(ValueError, match=r"^t must hold finite numbers"):
            arguments.floats(value, "t")
        with pytest.raises(ValueError, match=r"^t: too large"):
            arguments.finite(value, "t")


def test_vector_refuses_other_shapes_and_too_few_numbers():
    assert arguments.vector([1, 2], "x", 2).tolist() == [1, 2]
    with pytest.raises(ValueError, match=r"^x must be a list of numbers, but has shape \(\)"):
        arguments.vector(1, "x")
    with pytest.raises(ValueError, match=r"^x must be a list of numbers, but has shape \(1, 2\)"):
        arguments.vector([[1, 2]], "x")
    with pytest.raises(ValueError, match=r"^x needs 1 or more numbers, but has 0"):
        arguments.vector([], "x")
    with pytest.raises(ValueError, match=r"^x needs 3 or more numbers, but has 2"):
        arguments.vector([1, 2], "x", 3)


def test_increasing_names_the_first_pair_that_does_not_grow():
    assert arguments.increasing([-1, 0, 5], "knots").tolist() == [-1, 0, 5]
    assert arguments.increasing([7], "knots").tolist() == [7]
    with pytest.raises(ValueError, match=r"knots\[1\] is 1.0 and knots\[2\] is 1.0"):
        arguments.increasing([0, 1, 1, 0], "knots")
    with pytest.raises(ValueError, match=r"knots\[0\] is 3.0 and knots\[1\] is 2.0"):
        arguments.increasing([3, 2, 1], "knots")


def test_points_refuses_other_shapes_and_too_few_points():
    assert arguments.points([(1, 2)], "points").shape == (1, 2)
    for wrong in (1.0, [1, 2], np.zeros((2, 0)), np.zeros((1, 1, 1))):
        with pytest.raises(ValueError, match=r"^points must hold one point a row"):
            arguments.points(wrong, "points")
    with pytest.raises(ValueError, match=r"^points needs 2 or more points, but has 1"):
        arguments.points([(1, 2)], "points", 2)


def test_rows_accepts_numbers_or_points_of_the_right_count():
    assert arguments.rows([1, 2], "values", 2).shape == (2,)
    assert arguments.rows([(1, 2), (3, 4)], "values", 2).shape == (2, 2)
    for wrong in (1.0, [1], [1, 2, 3], np.zeros((2, 0)), np.zeros((2, 1, 1)), []):
        with pytest.raises(ValueError, match=r"^values must hold 2 numbers, or 2 points"):
            arguments.rows(wrong, "values", 2)


@pytest.mark.parametrize("value", [3, np.int8(3), np.array(3), 3 + 0 * np.uint64(1)])
def test_whole_number_accepts_integers_of_any_kind(value):
    number = arguments.whole_number(value, "count", 1)
    assert number == 3
    assert type(number) is int


@pytest.mark.parametrize("value", [3.0, "3", None, True, [3], np.zeros(10**6), np.bool_(True)])
def test_whole_number_refuses_everything_else_in_a_short_sentence(value):
    with pytest.raises(TypeError, match=r"^count must be a whole number, but is ") as caught:
        arguments.whole_number(value, "count", 1)
    assert len(str(caught.value)) < 100


@pytest.mark.parametrize("value", [0, -1, -(10**30)])
def test_whole_number_refuses_numbers_below_the_minimum(value):
    with pytest.raises(ValueError, match=rf"^count must be .* from 1 up, but is {value}"):
        arguments.whole_number(value, "count", 1)


@given(st.integers())
def test_whole_number_keeps_its_value(value):
    assert arguments.whole_number(value, "degree", min(value, 0)) == value
