"""What every function of Hermite, Lagrange, linear and spline interpolation does alike."""

from __future__ import annotations

import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from canim.interpolation import (
    hermite_basis,
    hermite_coefficients,
    hermite_curve,
    hermite_spline,
    lagrange_basis,
    lagrange_interpolate,
    lerp,
    quadratic_spline,
    quadratic_spline_system,
)

T = np.array([0.0, 1.0, 2.0, 3.0])
ENDS = {"f0": [0, 1], "f1": [2, 0], "d0": [0, 4], "d1": [1, -4]}
NODES = [-3, -1, 1, 3]
VALUES = [15, 5, 8, 9]


def spline_values(x, y, start="straight"):
    return quadratic_spline(x, y, start)(T)


CALLS = {
    lerp: {"start": [0, 1], "end": [4, 3], "t": T},
    hermite_basis: {"t": T},
    hermite_coefficients: ENDS,
    hermite_curve: {"t": T, **ENDS},
    hermite_spline: {"t": T, "knots": NODES, "values": VALUES, "slopes": [1, 0, 0, 2]},
    lagrange_basis: {"nodes": NODES, "x": T},
    lagrange_interpolate: {"nodes": NODES, "values": VALUES, "x": T},
    spline_values: {"x": NODES, "y": VALUES, "start": 2},
    quadratic_spline_system: {"x": NODES, "y": VALUES, "start": 2},
}
ARGUMENTS = [(call, name) for call, given in CALLS.items() for name in given]

BAD = {
    "nan": (math.nan, ValueError),
    "infinity": (-math.inf, ValueError),
    "text": ("1", TypeError),
    "None": (None, TypeError),
    "complex": (1j, TypeError),
    "object": (object(), TypeError),
}


def spoiled(good, bad):
    """Return `good` as nested lists with its last number replaced."""
    if np.ndim(good) == 0:
        return bad
    table = np.array(good).astype(object)
    table[(-1,) * table.ndim] = bad
    return table.tolist()


def flat(result):
    """Return the numbers of one array, or of a tuple of arrays."""
    parts = result if isinstance(result, tuple) else (result,)
    return np.concatenate([np.ravel(part) for part in parts])


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize(("call", "name"), ARGUMENTS)
def test_what_is_no_number_is_named(call, name, bad):
    value, error = BAD[bad]
    if name == "start" and bad == "text" and call is not lerp:
        error = ValueError  # Other texts are a start of a spline.
    with pytest.raises(error, match=rf"^{name} must "):
        call(**CALLS[call] | {name: spoiled(CALLS[call][name], value)})


@pytest.mark.parametrize(("call", "name"), ARGUMENTS)
def test_object_arrays_and_rows_of_different_lengths(call, name):
    with pytest.raises(TypeError, match=rf"^{name} must hold real numbers"):
        call(**CALLS[call] | {name: np.array(CALLS[call][name], dtype=object)})
    with pytest.raises(ValueError, match=rf"^{name} must be a table"):
        call(**CALLS[call] | {name: [[1, 2], [3]]})


@pytest.mark.parametrize("kind", [np.int8, np.uint8, np.int64, np.float16, np.float32, "0-d"])
@pytest.mark.parametrize(("call", "name"), ARGUMENTS)
def test_every_kind_of_number_gives_the_same_result(call, name, kind):
    good = {key: np.abs(np.asarray(value)) for key, value in CALLS[call].items()}
    for key in good.keys() & {"nodes", "knots", "x"}:
        good[key] = np.arange(len(good[key]))
    if kind == "0-d":
        changed = good | {name: np.array(good[name].tolist(), dtype=float)}
    else:
        changed = good | {name: good[name].astype(kind)}
    assert flat(call(**changed)).tolist() == flat(call(**good)).tolist()
    assert flat(call(**good | {name: good[name].tolist()})).tolist() == flat(call(**good)).tolist()


@pytest.mark.parametrize("call", CALLS)
def test_inputs_are_not_changed(call):
    good = {name: np.array(value, dtype=float) for name, value in CALLS[call].items()}
    before = {name: value.copy() for name, value in good.items()}
    for value in good.values():
        value.flags.writeable = False
    result = call(**good)
    for part in result if isinstance(result, tuple) else (result,):
        assert not any(np.shares_memory(part, value) for value in good.values())
    for name, value in good.items():
        assert value.tolist() == before[name].tolist()


@pytest.mark.parametrize(
    ("call", "name", "value"),
    [
        (lerp, "t", 1e300),
        (hermite_basis, "t", 1e300),
        (hermite_curve, "t", 1e200),
        (hermite_spline, "t", 1e200),
        (lagrange_basis, "x", 1e200),
        (lagrange_interpolate, "x", 1e200),
    ],
)
def test_results_beyond_the_largest_float(call, name, value):
    big = {
        key: np.asarray(old) * (1e200 if key in ENDS or key == "end" else 1)
        for key, old in CALLS[call].items()
    }
    with pytest.raises(ValueError, match="too large, the result does not fit a float"):
        call(**big | {name: value})


@pytest.mark.parametrize("size", [1e300, 1e-300, 5e-324])
@pytest.mark.parametrize(
    ("call", "names"),
    [
        (lerp, ["start", "end"]),
        (hermite_coefficients, list(ENDS)),
        (hermite_curve, list(ENDS)),
        (hermite_spline, ["values", "slopes"]),
        (lagrange_interpolate, ["values"]),
        (spline_values, ["y", "start"]),
    ],
)
def test_results_grow_and_shrink_with_the_values(call, names, size):
    scaled = CALLS[call] | {name: np.multiply(CALLS[call][name], size) for name in names}
    expected = np.asarray(call(**CALLS[call])) * size
    np.testing.assert_allclose(call(**scaled), expected, rtol=1e-13, atol=2e-322)


@pytest.mark.parametrize("call", [hermite_basis, lerp, hermite_curve, hermite_spline])
def test_parameters_near_zero(call):
    name = "t"
    result = call(**CALLS[call] | {name: [5e-324, -1e-310]})
    expected = call(**CALLS[call] | {name: [0, 0]})
    np.testing.assert_allclose(result, expected, atol=1e-300)


any_number = st.floats()


@pytest.mark.parametrize("call", CALLS)
@given(data=st.data())
def test_a_finite_result_or_an_error(call, data):
    numbers = {
        name: data.draw(arrays(float, np.shape(value), elements=any_number), label=name)
        for name, value in CALLS[call].items()
    }
    try:
        assert np.isfinite(flat(call(**numbers))).all()
    except ValueError as error:
        assert str(error).startswith(tuple(numbers))  # noqa: PT017


# --- Ten million points

MANY = np.linspace(-1, 2, 10**7)
KNOTS = np.linspace(-1, 2, 50)
SPLINE = quadratic_spline(KNOTS, np.sin(KNOTS))


@pytest.mark.parametrize(
    "call",
    [
        lambda t: lerp(1, 2, t),
        lambda t: lerp((1, 2), (3, 4), t),
        hermite_basis,
        lambda t: hermite_curve(t, 0, 1, 0, 1),
        lambda t: hermite_curve(t, (0, 0), (1, 1), (0, 1), (1, 0)),
        lambda t: hermite_spline(t, KNOTS, KNOTS, KNOTS),
        lambda t: hermite_spline(t[::-1], KNOTS, KNOTS, KNOTS),
        lambda t: hermite_spline(t, *[np.arange(-1, 2, 1e-4)] * 3),
        lambda t: lagrange_basis([0, 1, 3], t),
        lambda t: lagrange_interpolate([0, 1, 3], [1, 2, 3], t),
        SPLINE,
    ],
)
def test_memory_for_ten_million_points(call):
    tracemalloc.start()
    try:
        result = call(MANY)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert result.size >= MANY.size
    assert peak <= 8 * result.nbytes + 16e6


def test_memory_with_many_nodes():
    nodes = np.cos(np.pi * (np.arange(3000) + 0.5) / 3000)
    for call in (
        lambda: lagrange_interpolate(nodes, nodes, nodes),
        lambda: lagrange_basis(nodes, nodes[:100]),
    ):
        tracemalloc.start()
        try:
            result = call()
            peak = tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()
        assert peak <= 8 * result.nbytes + 16e6
