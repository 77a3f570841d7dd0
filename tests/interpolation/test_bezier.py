"""Bézier curves, against SciPy, plain loops, exact numbers and what holds for every input."""

from __future__ import annotations

import json
import math
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import BPoly

from canim.interpolation import (
    bernstein_basis,
    bezier_curve,
    bezier_path,
    de_casteljau,
    joint_kinks,
    next_control_point,
    transform_points,
)

CASES = json.loads((Path(__file__).parents[1] / "cases/bezier.json").read_text("utf-8"))
CUBIC = np.array(CASES["curve"][0]["control_points"], dtype=float)
PATH = np.stack([CUBIC, CUBIC[::-1] + np.array([40, 5]), CUBIC * 2])
OUTLINE = np.array(CASES["outline"]["control_points"], dtype=float)
T = np.linspace(-0.5, 1.5, 41)

CALLS = {
    bernstein_basis: {"degree": 3, "t": T},
    bezier_curve: {"control_points": CUBIC, "t": T},
    de_casteljau: {"control_points": CUBIC, "t": 0.3},
    bezier_path: {"segments": PATH, "t": np.linspace(0, 3, 16)},
    next_control_point: {"second_last": [38, -5], "last": [45, 15]},
    joint_kinks: {"segments": PATH},
    transform_points: {"points": CUBIC, "scale": 0.5, "angle": 1, "translate": [10, 0]},
}
NUMBERS = [(call, name) for call, given in CALLS.items() for name in given if name != "degree"]


def cubics(segments):
    """Cut a run of control points, each joint once, into segments of four."""
    return np.stack([segments[i : i + 4] for i in range(0, len(segments) - 1, 3)])


def plain_basis(degree, t):
    return [math.comb(degree, k) * t**k * (1 - t) ** (degree - k) for k in range(degree + 1)]


# --- What is right


@pytest.mark.parametrize("case", CASES["basis"])
def test_basis_by_hand(case):
    assert bernstein_basis(case["degree"], case["t"]).tolist() == case["values"]


@pytest.mark.parametrize("case", CASES["curve"])
def test_curve_by_hand(case):
    assert bezier_curve(case["control_points"], case["t"]).tolist() == case["point"]


@pytest.mark.parametrize("degree", [0, 1, 2, 3, 4, 7, 20])
def test_basis_is_the_formula(degree):
    expected = np.transpose([plain_basis(degree, t) for t in T.tolist()])
    np.testing.assert_allclose(bernstein_basis(degree, T), expected, rtol=1e-13)


@pytest.mark.parametrize("dim", [1, 2, 3, 5])
@pytest.mark.parametrize("degree", [0, 1, 2, 3, 4, 9, 20])
def test_curve_agrees_with_scipy(degree, dim):
    corners = np.random.default_rng(degree).uniform(-1, 1, (degree + 1, dim))
    t = np.linspace(0, 1, 1001)
    expected = BPoly(corners[:, None], [0, 1])(t)
    np.testing.assert_allclose(bezier_curve(corners, t), expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize("degree", [1, 3, 20])
def test_curve_over_several_blocks(degree):
    # More parameters than are worked on at once.
    corners = np.random.default_rng(1).uniform(-1, 1, (degree + 1, 2))
    t = np.linspace(0, 1, 200_001)
    curve = bezier_curve(corners, t)
    np.testing.assert_allclose(curve, (corners.T @ bernstein_basis(degree, t)).T, atol=1e-14)
    np.testing.assert_allclose(curve[::4000], bezier_curve(corners, t[::4000]), atol=1e-15)


@pytest.mark.parametrize("degree", [100, 1000])
def test_high_degree(degree):
    basis = bernstein_basis(degree, [0, 0.2, 0.5, 1])
    np.testing.assert_allclose(basis.sum(axis=0), 1, rtol=degree * 1e-15)
    assert basis[:, 0].tolist() == [1] + [0] * degree
    assert basis[:, 3].tolist() == [0] * degree + [1]
    middle = degree // 2
    exact = math.comb(degree, middle) / 2**degree
    assert basis[middle, 2] == pytest.approx(exact, rel=degree * 1e-15)


@pytest.mark.parametrize("shape", [(), (1,), (4,), (2, 3), (0,), (2, 0)])
def test_shapes_follow_t(shape):
    t = np.full(shape, 0.5)
    assert bernstein_basis(3, t).shape == (4, *shape)
    for degree in range(5):
        corners = np.zeros((degree + 1, 3))
        assert bezier_curve(corners, t).shape == (*shape, 3)
    assert bezier_path(PATH, t).shape == (*shape, 2)


def test_de_casteljau_shows_every_level():
    levels = de_casteljau(CUBIC, 0.25)
    assert [level.shape for level in levels] == [(4, 2), (3, 2), (2, 2), (1, 2)]
    assert levels[1].tolist() == [[6, 2], [16.25, 27.25], [39.75, 0]]
    assert levels[3].tolist() == [[11.953125, 11.34375]]
    assert [level.tolist() for level in de_casteljau([[1, 2]], 0.3)] == [[[1, 2]]]


def test_de_casteljau_divides_the_curve():
    levels = de_casteljau(CUBIC, 0.25)
    before, after = [level[0] for level in levels], [level[-1] for level in levels[::-1]]
    t = np.linspace(0, 1, 9)
    np.testing.assert_allclose(bezier_curve(before, t), bezier_curve(CUBIC, t / 4), atol=1e-13)
    expected = bezier_curve(CUBIC, (1 + 3 * t) / 4)
    np.testing.assert_allclose(bezier_curve(after, t), expected, atol=1e-13)


def test_first_level_is_a_copy():
    corners = CUBIC.copy()
    de_casteljau(corners, 0.5)[0][:] = 7
    assert (corners == CUBIC).all()


def test_path_takes_the_segment_from_the_whole_part():
    for i, segment in enumerate(PATH):
        t = np.array([0, 0.1, 0.5, 0.9])
        np.testing.assert_allclose(bezier_path(PATH, i + t), bezier_curve(segment, t), atol=1e-13)
    # A joint belongs to the segment that begins there, the last end to the last one.
    assert bezier_path(PATH, [1, 2]).tolist() == PATH[1:, 0].tolist()
    assert bezier_path(PATH, 3).tolist() == PATH[2, 3].tolist()


def test_path_in_any_order_over_several_blocks():
    t = np.random.default_rng(2).uniform(0, 3, 100_000)
    path = bezier_path(PATH, t)
    for i in (0, 1, 2):
        here = t.astype(int) == i
        np.testing.assert_allclose(path[here], bezier_curve(PATH[i], t[here] - i), atol=1e-12)


def test_path_ends_with_its_last_segment():
    with pytest.raises(ValueError, match=r"^t must be from 0 to 3.*but holds 3\.5"):
        bezier_path(PATH, [1, 3.5, 4])
    with pytest.raises(ValueError, match=r"^t must be from 0 to 3.*but holds -0\.1"):
        bezier_path(PATH, -0.1)


def test_next_control_point_mirrors_the_handle():
    assert next_control_point((38, -5), (45, 15)).tolist() == [52, 35]
    many = next_control_point(PATH[:, 2], PATH[:, 3])
    assert many.tolist() == [next_control_point(*pair).tolist() for pair in PATH[:, 2:]]


def test_kink_of_the_old_outline():
    outline = CASES["outline"]
    angles, mismatches = joint_kinks(cubics(OUTLINE), closed=True)
    joint = outline["kinked_joint"]
    assert math.degrees(angles[joint]) == pytest.approx(outline["angle_degrees"], abs=0.005)
    assert mismatches[joint] == outline["mismatch"]
    others = [0, 1, 3]
    assert angles[others].tolist() == [0, 0, 0]
    assert mismatches[others].tolist() == [0, 0, 0]
    mended = OUTLINE.copy()
    mended[outline["smooth_handle"]["index"]] = outline["smooth_handle"]["point"]
    for kinks in joint_kinks(cubics(mended), closed=True):
        assert kinks.tolist() == [0, 0, 0, 0]


@pytest.mark.parametrize("closed", ["no", None, 1, [True]])
def test_a_path_is_closed_or_not(closed):
    with pytest.raises(TypeError, match=r"^closed must be True or False, but is "):
        joint_kinks(PATH, closed)


def test_joints_of_open_and_closed_paths():
    assert [kinks.shape for kinks in joint_kinks(PATH)] == [(2,), (2,)]
    assert [kinks.shape for kinks in joint_kinks(PATH, closed=True)] == [(3,), (3,)]
    assert [kinks.shape for kinks in joint_kinks(PATH[:1])] == [(0,), (0,)]


def joint(arriving, leaving):
    """Return angle and mismatch where a segment from (-3, 0) meets one to (3, 3)."""
    segments = [[[-3, 0], *arriving], [*leaving, [3, 3]]]
    angles, mismatches = joint_kinks(segments)
    return angles[0], mismatches[0]


def test_angles_and_mismatches():
    straight = [[-2, 0], [-1, 0], [0, 0]]
    assert joint(straight, [[0, 0], [1, 0], [2, 2]]) == (0, 0)
    assert joint(straight, [[0, 0], [2, 0], [2, 2]]) == (0, 1)  # Smooth to see, but not C1.
    assert joint(straight, [[0, 0], [0, 1], [2, 2]]) == pytest.approx((math.pi / 2, math.sqrt(2)))
    assert joint(straight, [[0, 0], [-1, 0], [2, 2]]) == pytest.approx((math.pi, 2))
    assert joint(straight, [[0, 3], [1, 3], [2, 2]]) == (0, 3)  # A gap.
    assert joint(straight, [[0, 0], [1, 1e-12], [2, 2]])[0] == pytest.approx(1e-12, rel=1e-9)


def test_coincident_handles_take_their_direction_from_the_next_point():
    ahead = [[0, 0], [1, 0], [2, 2]]
    assert joint([[-2, 0], [0, 0], [0, 0]], ahead) == (0, 1)
    assert joint([[0, 0], [0, 0], [0, 0]], ahead) == (0, 1)
    assert joint([[-2, 0], [-1, 0], [0, 0]], [[0, 0], [0, 0], [0, 2]])[0] == math.pi / 2
    assert joint([[-2, 0], [-1, 0], [0, 0]], [[0, 0]] * 3)[0] == pytest.approx(math.pi / 4)
    # A segment that is one point has no direction.
    angles, mismatches = joint_kinks([CUBIC, [CUBIC[3]] * 4, CUBIC])
    assert angles.tolist() == [0, 0]
    assert np.isfinite(mismatches).all()


def test_transform_in_its_order():
    square = [(1, 0), (0, 1)]
    assert transform_points(square, scale=0.5, translate=(10, 0)).tolist() == [[10.5, 0], [10, 0.5]]
    turned = transform_points(square, 2, math.pi / 2, (10, 1))
    np.testing.assert_allclose(turned, [(10, 3), (8, 1)], atol=1e-15)
    assert transform_points(PATH).tolist() == PATH.tolist()
    assert transform_points((1, 2), translate=(1, 1)).tolist() == [2, 3]


# --- What holds for every input

coordinate = st.floats(-1e6, 1e6, allow_subnormal=True)
parameter = st.floats(0, 1)
parameters = arrays(float, st.integers(0, 9), elements=parameter)


def size(corners):
    """Return the largest coordinate, never less than what leaves denormals room to be rounded."""
    return np.abs(corners).max() + 1e-300


@st.composite
def polygons(draw, dim=None, least=1, most=12):
    shape = draw(st.integers(least, most)), dim or draw(st.integers(1, 4))
    return draw(arrays(float, shape, elements=coordinate))


@given(st.integers(0, 60), parameters)
def test_basis_is_a_partition_of_unity(degree, t):
    basis = bernstein_basis(degree, t)
    assert (basis >= 0).all()
    np.testing.assert_allclose(basis.sum(axis=0), 1, rtol=1e-14 * (degree + 1))
    np.testing.assert_allclose(basis, bernstein_basis(degree, 1 - t)[::-1], atol=1e-13)


@given(polygons())
def test_curve_begins_and_ends_at_the_control_points(corners):
    ends = bezier_curve(corners, [0, 1])
    np.testing.assert_allclose(ends, corners[[0, -1]], atol=1e-14 * size(corners))


@given(polygons(), parameter)
def test_de_casteljau_is_the_curve(corners, t):
    expected = de_casteljau(corners, t)[-1][0]
    np.testing.assert_allclose(
        bezier_curve(corners, t), expected, rtol=0, atol=2e-14 * size(corners)
    )


@given(polygons(), parameters)
def test_curve_stays_within_its_control_points(corners, t):
    curve = bezier_curve(corners, t)
    slack = 1e-14 * size(corners)
    assert (curve >= corners.min(axis=0) - slack).all()
    assert (curve <= corners.max(axis=0) + slack).all()


@given(
    polygons(dim=2),
    parameters,
    st.floats(-10, 10),
    st.floats(-10, 10),
    arrays(float, 2, elements=coordinate),
)
def test_curve_moves_with_its_control_points(corners, t, scale, angle, translate):
    first = bezier_curve(transform_points(corners, scale, angle, translate), t)
    last = transform_points(np.append(bezier_curve(corners, t), [[0, 0]], axis=0), scale, angle)
    slack = 1e-13 * (10 * size(corners) + np.abs(translate).max())
    np.testing.assert_allclose(first, last[:-1] + translate, rtol=0, atol=slack)


@given(polygons(dim=3, least=7, most=7))
def test_the_next_control_point_makes_the_joint_smooth(corners):
    corners[4] = next_control_point(corners[2], corners[3])
    _, (mismatch,) = joint_kinks(cubics(corners))
    assert mismatch <= 1e-15 * size(corners)
    # The derivative from the left and from the right, by the formula of the derivative.
    left, right = (3 * np.diff(corners, axis=0))[[2, 3]]
    np.testing.assert_allclose(left, right, rtol=0, atol=1e-14 * size(corners))


any_number = st.floats()


def result_or_error(call, names):
    """Return what `call` returns, or None where it raised a ValueError that begins as it should."""
    try:
        return call()
    except ValueError as error:
        if not str(error).startswith(names):
            raise
        return None


@given(
    arrays(float, st.tuples(st.integers(1, 4), st.just(4), st.integers(1, 3)), elements=any_number),
    st.booleans(),
)
def test_kinks_are_numbers_or_an_error(segments, closed):
    kinks = result_or_error(lambda: joint_kinks(segments, closed), "segments")
    if kinks:
        angles, mismatches = kinks
        assert ((angles >= 0) & (angles <= math.pi)).all()
        assert (mismatches >= 0).all()


@given(
    arrays(float, st.tuples(st.integers(0, 9), st.integers(0, 3)), elements=any_number),
    any_number,
)
def test_curves_are_finite_or_an_error(corners, t):
    for call in (lambda: bezier_curve(corners, t), lambda: de_casteljau(corners, t)[-1]):
        result = result_or_error(call, ("control_points", "t must"))
        assert result is None or np.isfinite(result).all()


# --- Bad input

BAD = {
    "nan": (math.nan, ValueError),
    "infinity": (-math.inf, ValueError),
    "a text": ("1", TypeError),
    "None": (None, TypeError),
    "a complex number": (1j, TypeError),
    "an object": (object(), TypeError),
}


def spoiled(good, bad):
    """Return `good` as nested lists with its last number replaced."""
    if np.ndim(good) == 0:
        return bad
    table = np.array(good).astype(object)
    table[(-1,) * table.ndim] = bad
    return table.tolist()


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize(("call", "name"), NUMBERS)
def test_what_is_no_number_is_named(call, name, bad):
    value, error = BAD[bad]
    arguments = CALLS[call] | {name: spoiled(CALLS[call][name], value)}
    with pytest.raises(error, match=rf"^{name} "):
        call(**arguments)


@pytest.mark.parametrize(("call", "name"), NUMBERS)
def test_object_arrays_and_rows_of_different_lengths(call, name):
    with pytest.raises(TypeError, match=rf"^{name} "):
        call(**CALLS[call] | {name: np.array(CALLS[call][name], dtype=object)})
    with pytest.raises(ValueError, match=rf"^{name} "):
        call(**CALLS[call] | {name: [[1, 2], [3]]})


@pytest.mark.parametrize(
    ("call", "name", "value"),
    [
        (bezier_curve, "control_points", []),
        (bezier_curve, "control_points", 1),
        (bezier_curve, "control_points", [1, 2]),
        (bezier_curve, "control_points", np.zeros((4, 0))),
        (bezier_curve, "control_points", np.zeros((0, 2))),
        (bezier_curve, "control_points", np.zeros((2, 4, 2))),
        (bezier_curve, "control_points", np.zeros((1002, 2))),
        (de_casteljau, "control_points", []),
        (de_casteljau, "control_points", np.zeros((1002, 2))),
        (de_casteljau, "t", [0.5]),
        (de_casteljau, "t", []),
        (bezier_path, "segments", []),
        (bezier_path, "segments", CUBIC),
        (bezier_path, "segments", PATH[:, :3]),
        (bezier_path, "segments", PATH[:0]),
        (bezier_path, "segments", PATH[..., :0]),
        (joint_kinks, "segments", CUBIC),
        (joint_kinks, "segments", PATH[:, :3]),
        (joint_kinks, "segments", []),
        (next_control_point, "second_last", 1),
        (next_control_point, "second_last", [1, 2, 3]),
        (next_control_point, "second_last", [[1, 2]]),
        (next_control_point, "last", 1),
        (next_control_point, "last", []),
        (transform_points, "points", []),
        (transform_points, "points", 1),
        (transform_points, "points", [[1, 2, 3]]),
        (transform_points, "points", np.zeros((0, 2))),
        (transform_points, "scale", [1, 2]),
        (transform_points, "angle", [1]),
        (transform_points, "translate", 1),
        (transform_points, "translate", [1, 2, 3]),
        (transform_points, "translate", []),
    ],
)
def test_a_wrong_shape_is_named(call, name, value):
    with pytest.raises(ValueError, match=rf"^{name} "):
        call(**CALLS[call] | {name: value})


@pytest.mark.parametrize("degree", [-1, 1001, 10**30])
def test_degree_out_of_range(degree):
    with pytest.raises(ValueError, match=r"^degree must"):
        bernstein_basis(degree, 0.5)


@pytest.mark.parametrize("degree", [1.5, 3.0, "3", None, [3], True, math.nan])
def test_degree_that_is_not_whole(degree):
    with pytest.raises(TypeError, match=r"^degree must"):
        bernstein_basis(degree, 0.5)


@pytest.mark.parametrize(
    ("call", "names"),
    [
        (lambda: bernstein_basis(3, 1e300), "t"),
        (lambda: bernstein_basis(1000, 1.9), "t"),
        (lambda: bezier_curve(CUBIC, -1e200), "control_points and t"),
        (lambda: bezier_curve(np.ones((21, 1)), [0.5, 1e300]), "control_points and t"),
        (lambda: de_casteljau([[1], [2], [3]], 1e300), "control_points and t"),
        (lambda: next_control_point([-1e308], [1e308]), "second_last and last"),
        (lambda: joint_kinks([[[-1e308]] * 4, [[1e308]] * 4]), "segments"),
        (lambda: transform_points([[1e300, 0]], 1e300), "points, scale and translate"),
    ],
)
def test_a_result_that_fits_no_float(call, names):
    with pytest.raises(ValueError, match=f"^{names}: too large"):
        call()


@pytest.mark.parametrize("size", [1e300, 1e-300, 5e-324])
def test_very_large_and_very_small_numbers(size):
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * size
    for points in (corners, np.repeat(corners, 6, axis=0)):
        curve = bezier_curve(points, [0, 0.5, 1])
        expected = [de_casteljau(points, t)[-1][0] for t in (0, 0.5, 1)]
        np.testing.assert_allclose(curve, expected, rtol=1e-14, atol=5e-324 * 20)
    np.testing.assert_allclose(bezier_path([corners], [0, 1]), corners[[0, 3]])
    assert next_control_point(corners[1], corners[2]).tolist() == [size, 2 * size]
    angles, mismatches = joint_kinks([corners, corners], closed=True)
    # From (-1, 0) to (1, 0), with a gap from (0, 1) to (0, 0).
    np.testing.assert_allclose(angles, math.pi)
    np.testing.assert_allclose(mismatches, 2 * size)
    assert transform_points(corners, 1, 0, (size, 0))[0].tolist() == [size, 0]
    assert bernstein_basis(2, 5e-324).tolist() == [1, 1e-323, 0]


@pytest.mark.parametrize("call", CALLS)
def test_other_forms_of_the_same_numbers(call):
    def whole(value):
        return np.round(value).astype(int) if np.ndim(value) else round(value)

    exact = {name: whole(value) for name, value in CALLS[call].items()}
    expected = call(**exact)
    for form in (
        lambda value: np.asarray(value, dtype=np.float32),
        lambda value: np.asarray(value, dtype=np.int8),
        lambda value: np.asarray(value).tolist(),
        lambda value: np.asarray(value, order="F"),
        np.array,
    ):
        arguments = {
            name: value if name == "degree" else form(value) for name, value in exact.items()
        }
        before = {name: np.array(value) for name, value in arguments.items()}
        for value in arguments.values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
        for got, wanted in zip(call(**arguments), expected, strict=True):
            assert got.dtype == np.float64
            np.testing.assert_array_equal(got, wanted)
        for name, value in arguments.items():
            np.testing.assert_array_equal(value, before[name])


@pytest.mark.parametrize(
    "call",
    [
        lambda t: bernstein_basis(1, t),
        lambda t: bernstein_basis(20, t[: t.size // 10]),
        lambda t: bezier_curve([[0], [1]], t),
        lambda t: bezier_curve(CUBIC, t),
        lambda t: bezier_curve(np.ones((21, 2)), t),
        lambda t: bezier_curve(np.ones((1001, 1)), t[:1000]),
        lambda t: bezier_path(PATH, t),
    ],
)
def test_peak_memory(call):
    t = np.linspace(0, 1, 10**6)
    call(t)
    tracemalloc.start()
    try:
        result = call(t)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak <= 8 * result.nbytes + 16 * 2**20


def test_ten_million_points():
    t = np.linspace(0, 1, 10**7)
    curve = bezier_curve(CUBIC, t)
    assert curve.shape == (10**7, 2)
    np.testing.assert_allclose(curve[::999_999], bezier_curve(CUBIC, t[::999_999]), atol=1e-13)
    basis = bernstein_basis(1, t)
    assert (basis[1] == t).all()
