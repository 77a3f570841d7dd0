"""Linear interpolation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from canim.interpolation import lerp

coordinate = st.floats(-1e6, 1e6)


def test_by_hand():
    assert lerp(2, 6, 0.25) == 3
    assert lerp(2, 6, [0, 0.5, 1, 2, -1]).tolist() == [2, 4, 6, 10, -2]
    assert lerp((0, 1), (4, 3), [0.5, 1]).tolist() == [[2, 2], [4, 3]]
    assert lerp([[0, 0], [1, 1]], [[2, 0], [1, 3]], 0.5).tolist() == [[1, 0], [1, 2]]


@pytest.mark.parametrize("of_t", [(), (3,), (0,), (4, 5)])
@pytest.mark.parametrize("of_point", [(), (2,), (3, 2)])
def test_shape_and_place_of_every_point(of_t, of_point):
    rng = np.random.default_rng(1)
    start, end, t = rng.normal(size=of_point), rng.normal(size=of_point), rng.normal(size=of_t)
    result = lerp(start, end, t)
    assert result.shape == of_t + of_point
    for place in np.ndindex(of_t):
        expected = (1 - t[place]) * start + t[place] * end
        np.testing.assert_allclose(result[place], expected, rtol=1e-14)


@given(st.data(), array_shapes(min_dims=0, max_dims=2, max_side=3))
def test_ends_are_exact_and_the_way_is_straight(data, shape):
    start, end = (data.draw(arrays(float, shape, elements=coordinate)) for _ in range(2))
    t = data.draw(st.floats(0, 1))
    assert (lerp(start, end, 0) == start).all()
    assert (lerp(start, end, 1) == end).all()
    np.testing.assert_allclose(lerp(start, end, t), lerp(end, start, 1 - t), rtol=0, atol=1e-9)
    np.testing.assert_allclose(lerp(start + 7, end + 7, t), lerp(start, end, t) + 7, atol=1e-8)


@pytest.mark.parametrize(("start", "end"), [(1, [1, 2]), ([1, 2], [1, 2, 3]), ([[1, 2]], [1, 2])])
def test_ends_of_different_shapes(start, end):
    with pytest.raises(ValueError, match=r"^start and end must have the same shape, but have \("):
        lerp(start, end, 0.5)
