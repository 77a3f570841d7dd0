"""Poses and Jacobians against exact numbers, ikpy, plain loops, and what holds for every chain."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from ikpy.chain import Chain
from ikpy.link import OriginLink, URDFLink

from canim.character import (
    forward_kinematics_2d,
    forward_kinematics_3d,
    jacobian_2d,
    jacobian_3d,
    joint_transforms,
    numeric_jacobian,
)

CASES = json.loads((Path(__file__).parents[1] / "cases/kinematics.json").read_text("utf-8"))
FORWARD = {2: forward_kinematics_2d, 3: forward_kinematics_3d}
JACOBIAN = {2: jacobian_2d, 3: jacobian_3d}

dimensions = st.sampled_from([2, 3])
counts = st.integers(1, 12)
seeds = st.integers(0, 2**32 - 1)


def random_chain(dimension, count, seed):
    """Return angles, offsets of lengths from 0.1 to 10, and a root."""
    rng = np.random.default_rng(seed)
    angles = rng.uniform(-9, 9, (count,) if dimension == 2 else (count, 3))
    offsets = rng.normal(size=(count, dimension))
    offsets *= 10 ** rng.uniform(-1, 1, (count, 1)) / np.linalg.norm(offsets, axis=1)[:, None]
    return angles, offsets, rng.normal(size=dimension)


def turn_x(a):
    return np.array([(1, 0, 0), (0, math.cos(a), -math.sin(a)), (0, math.sin(a), math.cos(a))])


def turn_y(b):
    return np.array([(math.cos(b), 0, math.sin(b)), (0, 1, 0), (-math.sin(b), 0, math.cos(b))])


def turn_z(c):
    return np.array([(math.cos(c), -math.sin(c), 0), (math.sin(c), math.cos(c), 0), (0, 0, 1)])


def loop_transforms(angles, offsets, root):
    """Multiply T = R·Z link by link, as the task says."""
    size = len(root) + 1
    total = np.eye(size)
    total[:-1, -1] = root
    found = [total]
    for turn, offset in zip(angles, offsets):
        rotate, translate = np.eye(size), np.eye(size)
        if size == 3:
            rotate[:2, :2] = turn_z(turn)[:2, :2]
        else:
            rotate[:3, :3] = turn_x(turn[0]) @ turn_y(turn[1]) @ turn_z(turn[2])
        translate[:-1, -1] = offset
        total = total @ rotate @ translate
        found.append(total)
    return np.array(found)


# --- Exact numbers


@pytest.mark.parametrize("case", CASES["effectors"])
def test_effectors_of_the_paper(case):
    joints = forward_kinematics_2d(np.radians(case["degrees"]), [(0, 1)] * 3)
    np.testing.assert_allclose(joints[-1], case["effector"], rtol=0, atol=5e-7)


@pytest.mark.parametrize("case", CASES["flat"] + CASES["space"])
def test_right_angles(case):
    forward = FORWARD[len(case["root"])]
    joints = forward(np.radians(case["degrees"]), case["offsets"], case["root"])
    np.testing.assert_allclose(joints, case["joints"], rtol=0, atol=1e-14)


def test_rest_pose_is_the_sum_of_the_offsets():
    assert forward_kinematics_2d([0, 0], [(0, 1), (2, 0)]).tolist() == [[0, 0], [0, 1], [2, 1]]
    joints = forward_kinematics_3d(np.zeros((2, 3)), [(0, 0, 1), (2, 0, 0)])
    assert joints.tolist() == [[0, 0, 0], [0, 0, 1], [2, 0, 1]]


def test_transforms_begin_at_the_origin():
    assert joint_transforms([0], [(1, 0)])[0].tolist() == np.eye(3).tolist()
    assert joint_transforms([[0, 0, 0]], [(1, 0, 0)])[0].tolist() == np.eye(4).tolist()


# --- Oracles


@given(dimensions, counts, seeds)
def test_transforms_are_the_product_along_the_chain(dimension, count, seed):
    chain = random_chain(dimension, count, seed)
    transforms = joint_transforms(*chain)
    np.testing.assert_allclose(transforms, loop_transforms(*chain), rtol=0, atol=1e-12)
    assert (transforms[:, :-1, -1] == FORWARD[dimension](*chain)).all()


@pytest.mark.parametrize(("dimension", "count"), [(2, 1), (2, 10), (3, 1), (3, 3), (3, 20)])
def test_ikpy_comes_to_the_same_place(dimension, count):
    angles, offsets, root = random_chain(dimension, count, seed=count)
    axes = np.eye(3) if dimension == 3 else np.eye(3)[2:]
    links, moved = [OriginLink()], np.zeros(3)
    moved[:dimension] = root
    for offset in offsets:
        for axis in axes:
            links.append(URDFLink("joint", moved, [0, 0, 0], rotation=axis))
            moved = np.zeros(3)
        moved[:dimension] = offset
    links.append(URDFLink("end", moved, [0, 0, 0], joint_type="fixed"))
    chain = Chain(links, active_links_mask=[False, *[True] * angles.size, False])
    place = chain.forward_kinematics([0, *angles.ravel(), 0])
    transform = joint_transforms(angles, offsets, root)[-1]
    np.testing.assert_allclose(transform[:-1, -1], place[:dimension, 3], rtol=0, atol=1e-12)
    turned = place[:dimension, :dimension]
    np.testing.assert_allclose(transform[:-1, :-1], turned, rtol=0, atol=1e-12)


# --- What holds for every chain


@given(dimensions, counts, seeds)
@example(2, 1000, 0)
@example(3, 1000, 0)
def test_links_keep_their_lengths(dimension, count, seed):
    angles, offsets, _ = random_chain(dimension, count, seed)
    links = np.diff(FORWARD[dimension](angles, offsets), axis=0)
    lengths = np.linalg.norm(offsets, axis=1)
    scale = max(1, lengths.sum())
    np.testing.assert_allclose(np.linalg.norm(links, axis=1), lengths, rtol=0, atol=1e-12 * scale)


@given(counts, seeds, st.floats(-7, 7))
def test_a_turned_root_turns_the_flat_chain(count, seed, turn):
    angles, offsets, root = random_chain(2, count, seed)
    still = forward_kinematics_2d(angles, offsets, root) - root
    angles[0] += turn
    turned = forward_kinematics_2d(angles, offsets, root) - root
    np.testing.assert_allclose(turned, still @ turn_z(turn)[:2, :2].T, rtol=0, atol=1e-12)


@given(counts, seeds, st.floats(-7, 7))
def test_a_turned_root_turns_the_chain_in_space(count, seed, turn):
    angles, offsets, root = random_chain(3, count, seed)
    still = forward_kinematics_3d(angles, offsets, root) - root
    # Rx is the outermost rotation of the first joint, so one more turn about x is a sum.
    angles[0, 0] += turn
    turned = forward_kinematics_3d(angles, offsets, root) - root
    np.testing.assert_allclose(turned, still @ turn_x(turn).T, rtol=0, atol=1e-12)


@given(counts, seeds)
def test_a_flat_chain_turns_about_z(count, seed):
    angles, offsets, root = random_chain(2, count, seed)
    turns = np.column_stack([np.zeros((count, 2)), angles])
    joints = forward_kinematics_3d(turns, np.pad(offsets, ((0, 0), (0, 1))), [*root, 4])
    flat = forward_kinematics_2d(angles, offsets, root)
    np.testing.assert_allclose(joints[:, :2], flat, rtol=0, atol=1e-12)
    np.testing.assert_allclose(joints[:, 2], 4, rtol=0, atol=1e-12)


@given(dimensions, counts, seeds)
def test_a_moved_root_moves_the_chain(dimension, count, seed):
    angles, offsets, root = random_chain(dimension, count, seed)
    forward = FORWARD[dimension]
    moved = forward(angles, offsets) + root
    np.testing.assert_allclose(forward(angles, offsets, root), moved, rtol=0, atol=1e-12)


# --- Jacobians


@given(dimensions, counts, seeds)
def test_jacobians_agree(dimension, count, seed):
    angles, offsets, _ = random_chain(dimension, count, seed)
    exact = JACOBIAN[dimension](angles, offsets)
    numeric = numeric_jacobian(lambda a: FORWARD[dimension](a, offsets)[-1], angles)
    assert exact.shape == numeric.shape == (dimension, angles.size)
    scale = np.linalg.norm(offsets, axis=1).sum()
    np.testing.assert_allclose(exact, numeric, rtol=0, atol=1e-7 * scale)


def test_numeric_jacobian_keeps_the_shape_and_the_values_of_angles():
    angles = np.arange(6.0).reshape(2, 3)

    def function(turned):
        assert turned.shape == (2, 3)
        assert np.count_nonzero(turned != np.arange(6.0).reshape(2, 3)) <= 1
        value = [(turned**2).sum(), turned[1, 0]]
        turned[:] = 0
        return value

    jacobian = numeric_jacobian(function, angles)
    np.testing.assert_allclose(jacobian, [2 * np.arange(6), [0, 0, 0, 1, 0, 0]], atol=1e-8)
    assert (angles.ravel() == np.arange(6)).all()


def test_the_step_is_a_central_one():
    assert numeric_jacobian(lambda a: a**3, [0], step=0.1)[0, 0] == pytest.approx(0.01)
    # A one-sided difference of t² would be 0.1.
    assert numeric_jacobian(lambda a: a**2, [0], step=0.1)[0, 0] == 0


# --- Bad input

ANGLES = {2: np.array([0.1, 0.2]), 3: np.array([(0.1, 0.2, 0.3), (0.4, 0.5, 0.6)])}
OFFSETS = {2: np.array([(0.0, 2), (1, 1)]), 3: np.array([(0.0, 2, 0), (1, 1, 1)])}
ROOT = {2: np.array([3.0, 4]), 3: np.array([3.0, 4, 5])}
WITH_ROOT = [(forward_kinematics_2d, 2), (forward_kinematics_3d, 3)]
WITH_ROOT += [(joint_transforms, 2), (joint_transforms, 3)]
CALLS = [*WITH_ROOT, (jacobian_2d, 2), (jacobian_3d, 3)]


def refuses(call, dimension, error, match, **changed):
    given = {"angles": ANGLES[dimension], "offsets": OFFSETS[dimension], **changed}
    before = {name: np.copy(value) for name, value in given.items()}
    with pytest.raises(error, match=match) as caught:
        call(**given)
    assert str(caught.value).endswith(".")
    for name, value in before.items():
        if value.dtype.kind in "iuf":
            assert np.array_equal(given[name], value, equal_nan=True)


@pytest.mark.parametrize(
    ("value", "error"),
    [(math.nan, ValueError), (math.inf, ValueError), (1j, TypeError), ("1", TypeError)],
)
@pytest.mark.parametrize(("call", "dimension"), CALLS)
def test_numbers_that_are_none(call, dimension, value, error):
    for name, good in (("angles", ANGLES), ("offsets", OFFSETS), ("root", ROOT)):
        if name != "root" or (call, dimension) in WITH_ROOT:
            bad = good[dimension].astype(np.result_type(type(value), float))
            bad.flat[1] = value
            refuses(call, dimension, error, rf"^{name} must", **{name: bad})
            refuses(call, dimension, TypeError, rf"^{name} must", **{name: "three"})


@pytest.mark.parametrize(("call", "dimension"), CALLS)
def test_angles_that_do_not_fit_the_links(call, dimension):
    good = ANGLES[dimension]
    for bad in (good[:1], np.concatenate([good, good]), good[None], 0.5, []):
        match = rf"^angles must hold .* 2 links .*, but has shape {re.escape(str(np.shape(bad)))}\."
        refuses(call, dimension, ValueError, match, angles=bad)
    refuses(call, dimension, ValueError, "^angles must hold", angles=np.array([good.T] * 2).T)


@pytest.mark.parametrize(("call", "dimension"), CALLS)
def test_links_that_are_none(call, dimension):
    good = OFFSETS[dimension]
    empty = {"angles": ANGLES[dimension][:0], "offsets": good[:0]}
    refuses(call, dimension, ValueError, r"^offsets needs 1 or more links, but has 0\.", **empty)
    for bad in (good[0], good[None], np.hstack([good, good]), np.ones((2, 1)), []):
        refuses(call, dimension, ValueError, r"^offsets must hold", offsets=bad)
    bad = good * [[1], [0]]
    refuses(call, dimension, ValueError, r"^offsets\[1\] has the length 0", offsets=bad)


@pytest.mark.parametrize(("call", "dimension"), WITH_ROOT)
def test_roots_that_are_no_point(call, dimension):
    for bad in (1.0, [1.0], [1.0] * 4, [ROOT[dimension]]):
        match = rf"^root must be one point of {dimension} numbers"
        refuses(call, dimension, ValueError, match, root=bad)


@pytest.mark.parametrize(("call", "dimension"), CALLS)
def test_results_that_fit_no_float(call, dimension):
    bad = OFFSETS[dimension] + 1.5e308
    refuses(call, dimension, ValueError, "too large, the result does not fit a float", offsets=bad)


def test_a_sum_of_angles_that_fits_no_float():
    with pytest.raises(ValueError, match=r"^angles.*does not fit a float"):
        forward_kinematics_2d([1.5e308, 1.5e308], [(0, 1)] * 2)


def test_no_function():
    with pytest.raises(TypeError, match=r"^function must be a function of the angles, but is 3\."):
        numeric_jacobian(3, [0.0])


@pytest.mark.parametrize(
    ("result", "error", "match"),
    [
        (1.0, ValueError, r"^function must return one point, shape \(d,\), but .* \(\) and \(\)\."),
        ([[1.0]], ValueError, r"^function must return one point"),
        ([], ValueError, r"^function must return one point"),
        ([math.nan], ValueError, "^the result of function must hold finite numbers"),
        (None, TypeError, "^the result of function must hold real numbers, but holds None"),
        ("p", TypeError, "^the result of function must hold real numbers"),
    ],
)
def test_functions_that_give_no_point(result, error, match):
    with pytest.raises(error, match=match):
        numeric_jacobian(lambda angles: result, [0.0])


def test_points_of_changing_shapes():
    shapes = iter([(2,), (3,)])
    with pytest.raises(ValueError, match=r"returns the shapes \(2,\) and \(3,\)"):
        numeric_jacobian(lambda angles: np.zeros(next(shapes)), [0.0])


def test_points_that_differ_by_more_than_a_float():
    with pytest.raises(ValueError, match=r"^function.*does not fit a float"):
        numeric_jacobian(lambda angles: 1.5e308 * np.sign(angles), [0.0])


@pytest.mark.parametrize(
    ("step", "error"),
    [
        (0, ValueError),
        (-1e-6, ValueError),
        (math.nan, ValueError),
        ([1e-6], ValueError),
        (1e-300, ValueError),
        ("small", TypeError),
        (None, TypeError),
    ],
)
def test_steps_that_lead_nowhere(step, error):
    with pytest.raises(error, match=r"^step "):
        numeric_jacobian(lambda angles: angles, [1.0], step)


@pytest.mark.parametrize(
    ("angles", "error"), [([], ValueError), ([math.nan], ValueError), (None, TypeError)]
)
def test_angles_of_no_function(angles, error):
    with pytest.raises(error, match=r"^angles "):
        numeric_jacobian(lambda angles: angles, angles)


@given(arrays(float, 2, elements=st.floats()), arrays(float, (2, 2), elements=st.floats()))
def test_results_are_finite_or_an_error(angles, offsets):
    for call in (forward_kinematics_2d, jacobian_2d, joint_transforms):
        try:
            result = call(angles, offsets)
        except ValueError as error:
            if not str(error).startswith(("angles", "offsets")):
                raise
        else:
            assert np.isfinite(result).all()
