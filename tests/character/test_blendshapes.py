"""Global and delta blendshapes, against plain loops and what holds for every face."""

from __future__ import annotations

import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from canim.character import Face, delta_blendshape, global_blendshape

NEUTRAL = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], dtype=float)
UP = np.array([0, 0, 1])
SHAPES = np.array([NEUTRAL + UP, NEUTRAL * (1, 2, 1), NEUTRAL - (1, 0, 0)])
FACES = np.array([(0, 1, 2), (0, 2, 3)])
EXPRESSIONS = dict(zip(("pop", "tall", "left"), SHAPES, strict=True))
WEIGHTS = np.array([0.2, 0.3, 0.5])


def loop(shapes, weights):
    """Sum coordinate by coordinate, as Eq. 14 is read aloud."""
    mixed = [[0.0] * 3 for _ in shapes[0]]
    for shape, weight in zip(shapes, weights, strict=True):
        for v, vertex in enumerate(shape):
            for c in range(3):
                mixed[v][c] += weight * vertex[c]
    return np.array(mixed)


def loop_delta(neutral, shapes, weights):
    return neutral + loop([shape - neutral for shape in shapes], weights)


# --- What comes out


def test_as_the_formulas_say():
    np.testing.assert_allclose(global_blendshape(SHAPES, WEIGHTS), loop(SHAPES, WEIGHTS))
    for weights in (WEIGHTS, 2 * WEIGHTS, [0, 0, 0], [1.5, -1, 0]):
        np.testing.assert_allclose(
            delta_blendshape(NEUTRAL, SHAPES, weights),
            loop_delta(NEUTRAL, SHAPES, weights),
            atol=1e-15,
        )


meshes = st.tuples(st.integers(1, 5), st.integers(1, 6)).flatmap(
    lambda size: st.tuples(
        arrays(np.float64, (*size, 3), elements=st.floats(-10, 10)),
        arrays(np.float64, size[0], elements=st.floats(-2, 2)),
        arrays(np.float64, (size[1], 3), elements=st.floats(-10, 10)),
    )
)


@given(meshes)
def test_every_mesh_and_every_weight(mesh):
    shapes, weights, neutral = mesh
    np.testing.assert_allclose(
        global_blendshape(shapes, weights), loop(shapes, weights), atol=1e-12
    )
    np.testing.assert_allclose(
        delta_blendshape(neutral, shapes, weights),
        loop_delta(neutral, shapes, weights),
        atol=1e-12,
    )


@given(meshes)
def test_delta_is_global_where_the_weights_sum_to_one(mesh):
    shapes, weights, neutral = mesh
    np.testing.assert_allclose(
        delta_blendshape(neutral, shapes, weights),
        global_blendshape([neutral, *shapes], [1 - weights.sum(), *weights]),
        atol=1e-12 * 10,
    )


def test_one_weight_of_one_gives_the_shape_itself():
    rng = np.random.default_rng(3)
    neutral, shapes = rng.normal(size=(40, 3)), rng.normal(size=(6, 40, 3))
    for k, weights in enumerate(np.eye(6)):
        assert np.array_equal(global_blendshape(shapes, weights), shapes[k])
        assert np.array_equal(delta_blendshape(neutral, shapes, weights), shapes[k])
    assert np.array_equal(delta_blendshape(neutral, shapes, np.zeros(6)), neutral)


def test_a_sum_of_two_doubles_the_face_unless_deltas_are_used():
    moved = np.concatenate([NEUTRAL, NEUTRAL + UP])
    neutral = np.concatenate([NEUTRAL, NEUTRAL])
    shapes = np.array([moved, np.concatenate([NEUTRAL, NEUTRAL - (0, 0, 3)])])
    grown = global_blendshape(shapes, [1, 1])
    still = delta_blendshape(neutral, shapes, [1, 1])
    np.testing.assert_allclose(grown[:4], 2 * NEUTRAL, atol=1e-15)
    np.testing.assert_allclose(still[:4], NEUTRAL, atol=1e-15)
    np.testing.assert_allclose(still[4:], NEUTRAL - (0, 0, 2), atol=1e-15)


@pytest.mark.parametrize("frames", [1, 3])
def test_meshes_of_many_vertices(frames):
    """They are mixed part by part; the parts meet."""
    rng = np.random.default_rng(6)
    neutral, shapes = rng.normal(size=(30_011, 3)), rng.normal(size=(3, 30_011, 3))
    weights = rng.normal(size=(frames, 3))
    np.testing.assert_allclose(
        global_blendshape(shapes, weights), np.einsum("fk,kvc->fvc", weights, shapes), atol=1e-13
    )
    np.testing.assert_allclose(
        delta_blendshape(neutral, shapes, weights),
        neutral + np.einsum("fk,kvc->fvc", weights, shapes - neutral),
        atol=1e-13,
    )


@pytest.mark.parametrize("frames", [0, 1, 7])
def test_a_row_of_weights_for_each_frame(frames):
    table = np.random.default_rng(4).normal(size=(frames, 3))
    mixed, moved = global_blendshape(SHAPES, table), delta_blendshape(NEUTRAL, SHAPES, table)
    assert mixed.shape == moved.shape == (frames, 4, 3)
    for k, weights in enumerate(table):
        np.testing.assert_allclose(mixed[k], global_blendshape(SHAPES, weights), atol=1e-14)
        np.testing.assert_allclose(moved[k], delta_blendshape(NEUTRAL, SHAPES, weights), atol=1e-14)


@pytest.mark.parametrize(
    ("given_type", "expected"),
    [(np.float32, np.float32), (np.float64, np.float64), (np.int16, np.float64)],
)
def test_single_precision_stays(given_type, expected):
    shapes, neutral = SHAPES.astype(given_type), NEUTRAL.astype(given_type)
    mixed = global_blendshape(shapes, WEIGHTS), delta_blendshape(NEUTRAL, shapes, [WEIGHTS])
    for result in (*mixed, delta_blendshape(neutral, shapes, WEIGHTS)):
        assert result.dtype == expected
    np.testing.assert_allclose(mixed[0], loop(SHAPES, WEIGHTS), atol=1e-6)
    np.testing.assert_allclose(mixed[1][0], loop_delta(NEUTRAL, SHAPES, WEIGHTS), atol=1e-6)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("step", [1, 2])
def test_the_shapes_are_not_copied(dtype, step):
    shapes = np.random.default_rng(5).normal(size=(40, 3000, 3)).astype(dtype)[::step]
    weights = np.full(len(shapes), 1 / len(shapes))
    global_blendshape(shapes, weights)
    for call in (
        lambda: global_blendshape(shapes, weights),
        lambda: delta_blendshape(shapes[0], shapes, weights),
    ):
        tracemalloc.start()
        call()
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 4 * shapes[0].nbytes


def test_shapes_in_another_order_of_memory():
    turned = np.asfortranarray(SHAPES)
    assert np.array_equal(global_blendshape(turned, WEIGHTS), global_blendshape(SHAPES, WEIGHTS))
    assert np.array_equal(
        delta_blendshape(NEUTRAL[::-1], SHAPES[:, ::-1], WEIGHTS)[::-1],
        delta_blendshape(NEUTRAL, SHAPES, WEIGHTS),
    )


# --- Bad input

GIVEN = {
    global_blendshape: {"shapes": SHAPES, "weights": WEIGHTS},
    delta_blendshape: {"neutral": NEUTRAL, "shapes": SHAPES, "weights": WEIGHTS},
    Face: {"neutral": NEUTRAL, "expressions": EXPRESSIONS, "faces": FACES, "colors": NEUTRAL / 2},
}
BOTH = [global_blendshape, delta_blendshape]


def refuses(call, error, match, **changed):
    before = {name: np.copy(value) for name, value in GIVEN[call].items()}
    with pytest.raises(error, match=match) as caught:
        call(**{**GIVEN[call], **changed})
    text = str(caught.value)
    assert text[-1] == "."
    assert "\n" not in text
    assert caught.value.__context__ is None or isinstance(caught.value.__cause__, ValueError)
    for name, value in GIVEN[call].items():
        assert np.array_equal(value, before[name])


def spoiled(array, value):
    changed = array.copy()
    changed[(1,) * array.ndim] = value
    return changed


@pytest.mark.parametrize("call", BOTH)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_shapes_with_a_number_that_is_none(call, dtype, bad):
    shapes = spoiled(SHAPES, bad).astype(dtype)
    refuses(call, ValueError, rf"^shapes must .* but shapes\[1, 1, 1\] is {bad}", shapes=shapes)
    table = [WEIGHTS, 2 * WEIGHTS]
    refuses(call, ValueError, r"^shapes must hold finite", shapes=shapes, weights=table)


@pytest.mark.parametrize("call", BOTH)
@pytest.mark.parametrize(
    ("bad", "error", "match"),
    [
        ([], ValueError, r"but has shape \(0,\)"),
        (SHAPES[:0], ValueError, r"but has shape \(0, 4, 3\)"),
        (SHAPES[:, :0], ValueError, r"but has shape \(3, 0, 3\)"),
        (NEUTRAL, ValueError, r"but has shape \(4, 3\)"),
        (SHAPES[:, :, :2], ValueError, r"but has shape \(3, 4, 2\)"),
        ([NEUTRAL, NEUTRAL, NEUTRAL[:3]], ValueError, r"\[2\] has 3 vertices and shapes\[0\] 4"),
        ([NEUTRAL, 7, NEUTRAL], ValueError, r"\[1\] has 0 vertices"),
        ([[(1, 2, 3), (4, 5)]], ValueError, "rows have different lengths"),
        (SHAPES + 1j, TypeError, "complex"),
        (SHAPES > 1, TypeError, "truth values"),
        (SHAPES.astype(object), TypeError, "other objects"),
        (SHAPES.astype(str), TypeError, "text"),
        ("shapes", TypeError, "text"),
        (None, TypeError, "None"),
    ],
)
def test_shapes(call, bad, error, match):
    refuses(call, error, rf"^shapes.*{match}", shapes=bad)


@pytest.mark.parametrize("call", BOTH)
@pytest.mark.parametrize(
    ("bad", "error", "match"),
    [
        (WEIGHTS[:2], ValueError, r"one number for each of the 3 shapes.*\(2,\)"),
        ([*WEIGHTS, 0], ValueError, r"each of the 3 shapes.*\(4,\)"),
        (WEIGHTS[:, None], ValueError, r"\(3, 1\)"),
        (np.zeros((2, 2, 3)), ValueError, r"\(2, 2, 3\)"),
        (0.5, ValueError, r"has shape \(\)"),
        ([0.5, math.nan, 0], ValueError, r"but weights\[1\] is nan"),
        ([0.5, 0, math.inf], ValueError, r"but weights\[2\] is inf"),
        ([0.5, 1j, 0], TypeError, "complex"),
        ({"smile": 1}, TypeError, "other objects"),
        (None, TypeError, "None"),
    ],
)
def test_weights(call, bad, error, match):
    refuses(call, error, rf"^weights must.*{match}", weights=bad)


@pytest.mark.parametrize(
    ("bad", "error", "match"),
    [
        (NEUTRAL[:3], ValueError, r"\(4, 3\), but has \(3, 3\)"),
        (NEUTRAL.T, ValueError, r"but has \(3, 4\)"),
        (SHAPES, ValueError, r"but has \(3, 4, 3\)"),
        (spoiled(NEUTRAL, math.nan), ValueError, r"but neutral\[1, 1\] is nan"),
        (spoiled(NEUTRAL, math.inf), ValueError, r"but neutral\[1, 1\] is inf"),
        (NEUTRAL > 1, TypeError, "truth values"),
        (None, TypeError, "None"),
    ],
)
def test_neutral(bad, error, match):
    refuses(delta_blendshape, error, rf"^neutral must.*{match}", neutral=bad)


@pytest.mark.parametrize("call", BOTH)
@pytest.mark.parametrize(
    ("dtype", "weight"), [(np.float64, 1.7e308), (np.float32, 3e38), (np.float32, 1e300)]
)
def test_results_too_large(call, dtype, weight):
    shapes, weights = SHAPES.astype(dtype), [weight, weight, 0]
    refuses(call, ValueError, r"shapes, weights: too large", shapes=shapes, weights=weights)


def test_large_numbers_that_fit():
    """Their squares do not fit a float, they do."""
    for dtype, scale in ((np.float32, 1e30), (np.float64, 1e200)):
        shapes = (scale * SHAPES).astype(dtype)
        np.testing.assert_allclose(
            global_blendshape(shapes, WEIGHTS), scale * loop(SHAPES, WEIGHTS), rtol=1e-6
        )


# --- Face


def test_face():
    face = Face(NEUTRAL, EXPRESSIONS, FACES, NEUTRAL / 2)
    assert repr(face) == "Face(4 vertices, 2 triangles, 3 expressions)"
    assert np.array_equal(face.shapes, SHAPES)
    assert list(face.expressions) == ["pop", "tall", "left"]
    assert np.array_equal(face.colors, NEUTRAL / 2)
    assert face.faces.dtype == np.int64
    for row, vertices in zip(face.shapes, face.expressions.values(), strict=True):
        assert np.shares_memory(row, vertices)
    for array in (face.neutral, face.faces, face.colors, face.shapes):
        array[:] = 0
    assert NEUTRAL.any()
    assert FACES.any()
    assert SHAPES.any()
    assert Face(NEUTRAL.astype(int), EXPRESSIONS, FACES).colors is None


def test_weights_by_name():
    face = Face(NEUTRAL, EXPRESSIONS, FACES)
    assert face.weights({}).tolist() == [0, 0, 0]
    assert face.weights({"left": 2, "pop": -0.5}).tolist() == [-0.5, 0, 2]
    mixed = delta_blendshape(face.neutral, face.shapes, face.weights({"tall": 1}))
    assert np.array_equal(mixed, EXPRESSIONS["tall"])


@pytest.mark.parametrize(
    ("bad", "error", "match"),
    [
        ({"lef": 1}, ValueError, "no expression 'lef'; the nearest is \"left\""),
        ({"Tall": 1}, ValueError, "no expression 'Tall'; the nearest is \"tall\""),
        ({"neutral": 1}, ValueError, "no expression 'neutral'"),
        ({7: 1}, ValueError, "no expression 7"),
        ({"tall": math.nan}, ValueError, r"\['tall'\] must hold finite numbers"),
        ({"tall": [1]}, ValueError, r"\['tall'\] must be one number, but has shape \(1,\)"),
        ({"tall": "1"}, TypeError, r"\['tall'\] must hold real numbers, but holds text"),
        ({"tall": None}, TypeError, r"\['tall'\] must hold real numbers, but holds None"),
        ([0.5, 0, 0], TypeError, "must map names to weights, but is of type list"),
        ("tall", TypeError, "must map names to weights"),
    ],
)
def test_weights_of_no_name(bad, error, match):
    with pytest.raises(error, match=rf"^chosen.*{match}.*\.$"):
        Face(NEUTRAL, EXPRESSIONS, FACES).weights(bad)


@pytest.mark.parametrize(
    ("name", "bad", "error", "match"),
    [
        ("neutral", NEUTRAL[:, :2], ValueError, r"shape \(V, 3\), but has shape \(4, 2\)"),
        ("neutral", spoiled(NEUTRAL, math.nan), ValueError, "finite"),
        ("neutral", "neutral", TypeError, "text"),
        ("expressions", {}, ValueError, "is empty"),
        ("expressions", SHAPES, TypeError, "must map names to vertices"),
        ("expressions", {"a": NEUTRAL[:3]}, ValueError, r"\['a'\] has 3 vertices and neutral 4"),
        ("expressions", {"a": SHAPES}, ValueError, r"\['a'\] must hold one point a row"),
        ("expressions", {"a": spoiled(NEUTRAL, math.inf)}, ValueError, r"\['a'\] must .*finite"),
        ("faces", FACES[0], ValueError, r"but has shape \(3,\)"),
        ("faces", FACES[:, :2], ValueError, r"but has shape \(2, 2\)"),
        ("faces", FACES[:0], ValueError, r"but has shape \(0, 3\)"),
        ("faces", FACES.astype(float), TypeError, "type float64"),
        ("faces", FACES > 1, TypeError, "truth values"),
        ("faces", [(0, 1, 2), (0, 1)], ValueError, "rows have different lengths"),
        ("faces", FACES + 1, ValueError, "from 0 to 3, but holds 4"),
        ("faces", FACES - 1, ValueError, "from 0 to 3, but holds -1"),
        ("colors", NEUTRAL[:3] / 2, ValueError, r"but has shape \(3, 3\)"),
        ("colors", NEUTRAL, ValueError, "from 0 to 1, but holds 2"),
        ("colors", -NEUTRAL, ValueError, "from 0 to 1, but holds -2"),
    ],
)
def test_faces_that_are_none(name, bad, error, match):
    refuses(Face, error, rf"^{name}.*{match}", **{name: bad})
