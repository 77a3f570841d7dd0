"""Goals in reach are reached and others come closest, by every method; steps against oracles."""

from __future__ import annotations

import importlib
import math
from itertools import product

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from canim.character import (
    forward_kinematics_2d,
    forward_kinematics_3d,
    inverse_kinematics,
    inverse_kinematics_batch,
    jacobian_2d,
    jacobian_3d,
)

METHODS = ["pseudoinverse", "damped", "ccd", "fabrik"]
FORWARD = {2: forward_kinematics_2d, 3: forward_kinematics_3d}
JACOBIAN = {2: jacobian_2d, 3: jacobian_3d}
SIZES = [(2, 3), (2, 10), (2, 100), (3, 3), (3, 20)]

every_method = pytest.mark.parametrize("method", METHODS)
every_dimension = pytest.mark.parametrize("dimension", [2, 3])


def straight(dimension, count):
    return np.tile(np.eye(dimension)[-1], (count, 1))


def random_links(rng, dimension, count):
    """Return links that point anywhere, of lengths from 0.1 to 1; sometimes one outweighs all."""
    offsets = rng.normal(size=(count, dimension))
    offsets *= rng.uniform(0.1, 1, (count, 1)) / np.linalg.norm(offsets, axis=1)[:, None]
    if rng.random() < 0.3:
        offsets[rng.integers(count)] *= 2 * count
    return offsets


def random_angles(rng, dimension, count, *shape):
    return rng.uniform(-math.pi, math.pi, (*shape, count, *[3] * (dimension - 2)))


def reach(offsets):
    """Return the least and the greatest distance of the end effector from the root."""
    lengths = np.linalg.norm(offsets, axis=1)
    return max(0, 2 * lengths.max() - lengths.sum()), lengths.sum()


def random_goals(rng, offsets, count, low=None, high=None):
    """Return goals of any direction whose distances are even over the area or the space."""
    inner, outer = reach(offsets)
    dimension = offsets.shape[1]
    low, high = (inner if low is None else low), (outer if high is None else high)
    radius = rng.uniform(low**dimension, high**dimension, count) ** (1 / dimension)
    goals = rng.normal(size=(count, dimension))
    return goals * (radius / np.linalg.norm(goals, axis=1))[:, None]


def best_error(offsets, goals):
    inner, outer = reach(offsets)
    distance = np.linalg.norm(goals, axis=-1)
    return np.maximum(np.maximum(distance - outer, inner - distance), 0)


def tells_whether_at_most(said, value, limit):
    """Assert that `said` is true where `value` is at most `limit`; on the limit, rounding says."""
    assert said == (value <= limit) or value == pytest.approx(limit, rel=1e-6)


def is_honest(result, start, offsets, goal, root, tolerance=1e-5):
    """Assert what the result of any search says about itself."""
    forward = FORWARD[offsets.shape[1]]
    size = np.linalg.norm(offsets, axis=1).sum()
    np.testing.assert_allclose(
        result.positions, forward(result.angles, offsets, root), rtol=0, atol=1e-12 * size
    )
    assert result.error == pytest.approx(np.linalg.norm(goal - result.positions[-1]), abs=1e-12)
    tells_whether_at_most(result.converged, result.error, tolerance * size)
    assert result.history[0].tolist() == start.tolist()
    assert result.history[-1].tolist() == result.angles.tolist()
    assert np.abs(np.diff(result.history, axis=0)).max(initial=0) <= 0.5
    assert len(result.history) > result.iterations
    assert [type(value) for value in result[2:6]] == [float, int, bool, bool]


# --- Goals in reach and out of it


@pytest.mark.parametrize(("dimension", "count"), SIZES)
@every_method
def test_all_goals_in_reach_are_reached(method, dimension, count):
    rng = np.random.default_rng(count)
    for offsets in (straight(dimension, count), random_links(rng, dimension, count)):
        goals = random_goals(rng, offsets, 100)
        size = reach(offsets)[1]
        # At the edges of the reach every method crawls without help.
        goals[:20] *= (size * (1 - 1e-4) / np.linalg.norm(goals[:20], axis=1))[:, None]
        for start in (
            random_angles(rng, dimension, count, 100),
            np.zeros_like(random_angles(rng, dimension, count)),
        ):
            found = inverse_kinematics_batch(start, offsets, goals, method=method)
            assert found.converged.all()
            assert found.reachable.all()
            error = np.linalg.norm(found.positions[:, -1] - goals, axis=1)
            assert error.max() <= 1e-5 * size
            assert found.iterations.max() <= 200


@pytest.mark.parametrize(("dimension", "count"), SIZES)
@every_method
def test_goals_out_of_reach_end_in_the_closest_pose(method, dimension, count):
    rng = np.random.default_rng(count)
    offsets = straight(dimension, count)
    offsets[count // 2] *= 1.5 * count
    inner, outer = reach(offsets)
    goals = np.concatenate(
        [
            random_goals(rng, offsets, 30, outer * 1.001, outer * 3),
            random_goals(rng, offsets, 30, 0, inner * 0.999),
        ]
    )
    start = random_angles(rng, dimension, count, 60)
    found = inverse_kinematics_batch(start, offsets, goals, method=method)
    np.testing.assert_allclose(found.error, best_error(offsets, goals), rtol=1e-9)
    assert not found.converged.any()
    assert not found.reachable.any()
    assert (found.iterations == 1).all()


@given(
    st.sampled_from([2, 3]),
    st.integers(1, 8),
    st.sampled_from(METHODS),
    st.floats(0, 2),
    st.integers(0, 2**32 - 1),
)
@example(2, 1, "pseudoinverse", 1.0, 0)
@example(3, 1, "fabrik", 0.0, 0)
@example(2, 1, "pseudoinverse", 0.99999, 1)  # The best error is the tolerance itself.
def test_every_search_ends_as_close_as_can_be(dimension, count, method, radius, seed):
    rng = np.random.default_rng(seed)
    offsets = random_links(rng, dimension, count)
    size = reach(offsets)[1]
    start, root = random_angles(rng, dimension, count), rng.normal(size=dimension)
    way = random_goals(rng, offsets, 1, radius * size, radius * size)[0]
    result = inverse_kinematics(start, offsets, root + way, root=root, method=method)
    is_honest(result, start, offsets, root + way, root)
    best = best_error(offsets, way)
    assert result.error <= best * (1 + 1e-9) + 1e-5 * size
    tells_whether_at_most(result.reachable, best, 1e-5 * size)
    assert result.iterations <= 200


@every_method
@every_dimension
def test_forward_of_inverse_is_the_goal(dimension, method):
    rng = np.random.default_rng(7)
    offsets = random_links(rng, dimension, 5)
    for _ in range(5):
        goal = FORWARD[dimension](random_angles(rng, dimension, 5), offsets)[-1]
        start = random_angles(rng, dimension, 5)
        result = inverse_kinematics(start, offsets, goal, method=method, tolerance=1e-10)
        assert result.converged
        reached = FORWARD[dimension](result.angles, offsets)[-1]
        np.testing.assert_allclose(reached, goal, rtol=0, atol=1e-9 * reach(offsets)[1])


@every_method
@every_dimension
def test_one_goal_and_many_are_solved_alike(dimension, method):
    rng = np.random.default_rng(3)
    offsets = random_links(rng, dimension, 4)
    root = rng.normal(size=dimension)
    goals = root + random_goals(rng, offsets, 20, 0, 1.3 * reach(offsets)[1])
    for closest, start in product((True, False), (True, False)):
        starts = random_angles(rng, dimension, 4, *[20] * start)
        given = {"root": root, "method": method, "closest": closest, "max_iterations": 30}
        found = inverse_kinematics_batch(starts, offsets, goals, **given)
        for i, goal in enumerate(goals):
            one = inverse_kinematics(starts[i] if start else starts, offsets, goal, **given)
            for name in found._fields:
                np.testing.assert_allclose(
                    getattr(found, name)[i], getattr(one, name), rtol=1e-6, atol=1e-6
                )


def test_many_chains_are_solved_in_groups(monkeypatch):
    rng = np.random.default_rng(5)
    offsets = straight(3, 4)
    goals = random_goals(rng, offsets, 20)
    whole = inverse_kinematics_batch(np.full((4, 3), 0.2), offsets, goals)
    module = importlib.import_module("canim.character.inverse_kinematics")
    for size in (1, 36, 100):
        monkeypatch.setattr(module, "_GROUP", size)
        parts = inverse_kinematics_batch(np.full((4, 3), 0.2), offsets, goals)
        for some, every in zip(parts, whole):
            np.testing.assert_allclose(some, every, rtol=0, atol=1e-9)


# --- Singular poses and goals at the limits


@every_method
@every_dimension
@pytest.mark.parametrize("share", [-0.999, -0.4, 0, 1e-9, 0.5, 0.999])
def test_straight_chains_leave_the_line(dimension, method, share):
    for links in ([1, 1, 1], [1, 1.5, 0.5, 0.1], [0.3, 0.6, 3, 2.1]):
        offsets = straight(dimension, len(links)) * np.array(links)[:, None]
        start = np.zeros((len(links), 3)[: dimension - 1])
        goal = share * offsets.sum(axis=0)
        result = inverse_kinematics(start, offsets, goal, method=method)
        assert result.converged
        is_honest(result, start, offsets, goal, np.zeros(dimension))


@every_method
@every_dimension
def test_a_chain_that_cannot_move_is_helped_at_once(dimension, method):
    start = np.zeros((3, 3)[: dimension - 1])
    goal = 2.5 * np.eye(dimension)[-1]
    result = inverse_kinematics(start, straight(dimension, 3), goal, method=method)
    assert result.iterations == 2
    # One still picture, then the chain bends.
    assert result.history[1].tolist() == start.tolist()


@every_method
@every_dimension
def test_folded_chains_open(dimension, method):
    start = np.zeros((3, 3)[: dimension - 1])
    start.reshape(3, -1)[1:, 0] = math.pi
    for goal in (2.5, -2.5, 0.1):
        goal = goal * np.eye(dimension)[-1]
        assert inverse_kinematics(start, straight(dimension, 3), goal, method=method).converged


@every_method
@every_dimension
@pytest.mark.parametrize("factor", [1, 1 + 1e-15, 1 - 1e-15, 1 + 9e-6, 1 - 9e-6, 1 - 1e-7])
def test_goals_at_full_reach(dimension, method, factor):
    rng = np.random.default_rng(2)
    offsets = random_links(rng, dimension, 6)
    goal = random_goals(rng, offsets, 1, *[reach(offsets)[1] * factor] * 2)[0]
    start = random_angles(rng, dimension, 6)
    result = inverse_kinematics(start, offsets, goal, method=method)
    assert result.converged
    assert result.reachable


@every_method
@every_dimension
def test_goals_at_the_inner_limit_and_at_the_root(dimension, method):
    offsets = straight(dimension, 3) * [[1], [5], [1]]
    start = np.full((3, 3)[: dimension - 1], 0.3)
    goal = np.eye(dimension)[0] * 3
    assert inverse_kinematics(start, offsets, goal, method=method).converged
    result = inverse_kinematics(start, offsets, goal * 0, method=method)
    assert not result.reachable
    assert result.error == pytest.approx(3, rel=1e-9)
    offsets[1] = offsets[0]
    assert inverse_kinematics(start, offsets, goal * 0, method=method).converged


@every_method
@every_dimension
@pytest.mark.parametrize(
    "lengths",
    [[1, 1, 1, 1], [1e-9, 1, 2, 3], [3, 1e-9, 2, 5 - 1e-9], [1e-6, 1, 1e-3], [2, 1e-9, 2]],
)
def test_triangles_that_are_almost_flat(dimension, method, lengths):
    offsets = straight(dimension, len(lengths)) * np.array(lengths)[:, None]
    start = np.zeros((len(lengths), 3)[: dimension - 1])
    inner, outer = reach(offsets)
    for share in (0, 1e-9, 1e-3, 0.7):
        goal = np.eye(dimension)[-1] * (inner + share * (outer - inner))
        result = inverse_kinematics(start, offsets, goal, method=method, tolerance=1e-8)
        assert result.converged


@every_method
@every_dimension
def test_one_link_points_at_the_goal(dimension, method):
    start = np.full((1, 3)[: dimension - 1], 2.0)
    for goal in (np.arange(dimension) + 1.0, 0.1 * np.eye(dimension)[0]):
        result = inverse_kinematics(start, straight(dimension, 1), goal, method=method)
        np.testing.assert_allclose(
            result.positions[-1], goal / np.linalg.norm(goal), rtol=0, atol=1e-12
        )
    back = -result.positions[-1]
    result = inverse_kinematics(result.angles, straight(dimension, 1), back, method=method)
    assert result.converged


@every_method
@every_dimension
def test_a_thousand_links(dimension, method):
    rng = np.random.default_rng(1)
    offsets = straight(dimension, 1000)
    start = random_angles(rng, dimension, 1000) / 10
    goal = random_goals(rng, offsets, 1)[0]
    result = inverse_kinematics(start, offsets, goal, method=method, max_iterations=30)
    assert result.converged
    is_honest(result, start, offsets, goal, np.zeros(dimension))


@every_dimension
def test_a_goal_that_is_reached_already(dimension):
    rng = np.random.default_rng(4)
    start, offsets = random_angles(rng, dimension, 3), random_links(rng, dimension, 3)
    goal = FORWARD[dimension](start, offsets)[-1]
    result = inverse_kinematics(start, offsets, goal)
    assert result.iterations == 0
    assert result.converged
    assert result.history.tolist() == [start.tolist()]


@every_method
def test_an_arm_that_cannot_come_closer_stays(method):
    result = inverse_kinematics([0, 0, 0], straight(2, 3), (0, 4), method=method)
    assert result.error == 1
    assert np.abs(result.angles).max() <= 1e-15


@pytest.mark.parametrize("scale", [1e-200, 1e-9, 1e9, 1e200])
@every_method
@every_dimension
def test_size_does_not_matter(dimension, method, scale):
    rng = np.random.default_rng(6)
    start, offsets = random_angles(rng, dimension, 4), random_links(rng, dimension, 4)
    for goal in random_goals(rng, offsets, 3, 0, 5 * reach(offsets)[1]):
        here = inverse_kinematics(start, offsets, goal, method=method)
        there = inverse_kinematics(start, offsets * scale, goal * scale, method=method)
        assert there.converged == here.converged
        np.testing.assert_allclose(there.positions[-1] / scale, here.positions[-1], atol=2e-5)


@every_method
@pytest.mark.parametrize("closest", [True, False])
def test_goals_as_far_as_floats_go(method, closest):
    goal = np.array([3e300, 4e300])
    result = inverse_kinematics([1, 2], straight(2, 2), goal, method=method, closest=closest)
    assert result.error == pytest.approx(5e300)
    assert np.isfinite(result.positions).all()


@every_dimension
def test_the_order_in_memory_does_not_matter(dimension):
    rng = np.random.default_rng(13)
    start, offsets = random_angles(rng, dimension, 4), random_links(rng, dimension, 4)
    goal = random_goals(rng, offsets, 1)[0]
    turned = (np.asfortranarray(start), np.asfortranarray(offsets), np.repeat(goal, 2)[::2])
    result = inverse_kinematics(start, offsets, goal)
    assert inverse_kinematics(*turned).angles.tolist() == result.angles.tolist()


@every_method
def test_a_tolerance_that_no_float_meets_ends(method):
    result = inverse_kinematics(
        [1, 2, 3.0], straight(2, 3), (1, 1), method=method, tolerance=1e-300
    )
    assert result.error <= 1e-14
    assert np.isfinite(result.history).all()


# --- The methods by themselves


@every_method
def test_bare_methods_do_not_leave_a_line(method):
    result = inverse_kinematics(
        [0, 0, 0], straight(2, 3), (0, 2.5), method=method, closest=False, max_iterations=25
    )
    assert (result.iterations, result.converged, result.reachable) == (25, False, True)
    np.testing.assert_allclose(result.positions[:, 0], 0, rtol=0, atol=1e-6)


@every_method
@every_dimension
def test_bare_methods_go_on_when_the_goal_is_out_of_reach(dimension, method):
    start = np.full((3, 3)[: dimension - 1], 0.4)
    goal = np.ones(dimension) * 4
    result = inverse_kinematics(
        start, straight(dimension, 3), goal, method=method, closest=False, max_iterations=40
    )
    assert (result.iterations, result.converged, result.reachable) == (40, False, False)
    is_honest(result, start, straight(dimension, 3), goal, np.zeros(dimension))


@pytest.mark.parametrize(("method", "damping"), [("pseudoinverse", 0), ("damped", 0.02)])
@every_dimension
def test_a_step_along_the_jacobian(dimension, method, damping):
    rng = np.random.default_rng(8)
    start, offsets = random_angles(rng, dimension, 5), random_links(rng, dimension, 5)
    size = reach(offsets)[1]
    error = 0.01 * size * np.eye(dimension)[0]
    goal = FORWARD[dimension](start, offsets)[-1] + error
    result = inverse_kinematics(start, offsets, goal, method=method, max_iterations=1)
    jacobian = JACOBIAN[dimension](start, offsets)
    square = jacobian @ jacobian.T + damping * 0.01 * size**2 * np.eye(dimension)
    turns = jacobian.T @ np.linalg.inv(square) @ error
    assert np.abs(turns).max() < 0.4
    np.testing.assert_allclose((result.angles - start).ravel(), turns, rtol=1e-5)


@pytest.mark.parametrize("method", ["pseudoinverse", "damped"])
@every_dimension
def test_steps_along_the_jacobian_are_short(dimension, method):
    rng = np.random.default_rng(9)
    offsets, start = random_links(rng, dimension, 3), random_angles(rng, dimension, 3)
    given = {"method": method, "closest": False, "max_iterations": 1}
    for goal in random_goals(rng, offsets, 10):
        result = inverse_kinematics(start, offsets, goal, **given)
        assert np.abs(result.angles - start).max() <= 0.49 + 1e-15


@every_dimension
def test_ccd_turns_each_angle_to_the_best_place(dimension):
    rng = np.random.default_rng(10)
    start, offsets = random_angles(rng, dimension, 3), random_links(rng, dimension, 3)
    goal = random_goals(rng, offsets, 1)[0]
    result = inverse_kinematics(start, offsets, goal, method="ccd", closest=False, max_iterations=1)

    def error(angles):
        return np.linalg.norm(FORWARD[dimension](angles, offsets)[-1] - goal)

    angles = start.copy()
    for k in reversed(range(angles.size)):
        angles.flat[k] = result.angles.flat[k]
        best = error(angles)
        for turn in (-1e-3, 1e-3, 1, 2, math.pi):
            other = angles.copy()
            other.flat[k] += turn
            assert best < error(other)


@every_dimension
def test_fabrik_pulls_there_and_back(dimension):
    rng = np.random.default_rng(11)
    start, offsets = random_angles(rng, dimension, 4), random_links(rng, dimension, 4)
    goal = random_goals(rng, offsets, 1)[0]
    result = inverse_kinematics(
        start, offsets, goal, method="fabrik", closest=False, max_iterations=1
    )
    lengths = np.linalg.norm(offsets, axis=1)
    joints = FORWARD[dimension](start, offsets)
    joints[-1] = goal
    for k in (3, 2, 1, 0):
        way = joints[k] - joints[k + 1]
        joints[k] = joints[k + 1] + way * lengths[k] / np.linalg.norm(way)
    joints[0] = 0
    for k in (0, 1, 2, 3):
        way = joints[k + 1] - joints[k]
        joints[k + 1] = joints[k] + way * lengths[k] / np.linalg.norm(way)
    np.testing.assert_allclose(result.positions, joints, rtol=0, atol=1e-12)


def test_fabrik_survives_joints_in_one_place():
    # The last link lies on the goal already, so that pulling has no direction.
    result = inverse_kinematics(
        [0, math.pi, 0.5], straight(2, 3), (0, 0), method="fabrik", max_iterations=50
    )
    assert result.converged


def test_space_turns_no_more_than_it_must():
    # A chain that already points where it shall keeps its angles, whatever their size.
    rng = np.random.default_rng(12)
    offsets = straight(3, 4)
    start = np.zeros((4, 3))
    start[:, 2] = rng.uniform(-3, 3, 4)  # Turns about the links themselves.
    # A right angle: x and z turn about one axis.
    start[0, :2] = 0.7, 20 * math.pi + math.pi / 2
    goal = FORWARD[3](start, offsets)[-1] * 1.5
    result = inverse_kinematics(start, offsets, goal)
    np.testing.assert_allclose(result.angles, start, rtol=0, atol=1e-6)


# --- Bad input

ANGLES = {2: np.array([0.1, 0.2]), 3: np.array([(0.1, 0.2, 0.3), (0.4, 0.5, 0.6)])}
OFFSETS = {2: np.array([(0.0, 2), (1, 1)]), 3: np.array([(0.0, 2, 0), (1, 1, 1)])}
GOAL = {2: np.array([1.0, 2]), 3: np.array([1.0, 2, 1])}


def refuses(dimension, error, match, many=(True, False), **changed):
    given = {"angles": ANGLES[dimension], "offsets": OFFSETS[dimension], **changed}
    for batch in many:
        call = inverse_kinematics_batch if batch else inverse_kinematics
        goal = {"goals": GOAL[dimension][None]} if batch else {"goal": GOAL[dimension]}
        with pytest.raises(error, match=match) as caught:
            call(**{**goal, **given})
        assert str(caught.value).endswith(".")


@every_dimension
@pytest.mark.parametrize(
    ("value", "error"),
    [(math.nan, ValueError), (math.inf, ValueError), (1j, TypeError), ("1", TypeError)],
)
def test_numbers_that_are_none(dimension, value, error):
    root = GOAL[dimension] * 0
    given = {"angles": ANGLES[dimension], "offsets": OFFSETS[dimension], "root": root}
    for name, good in given.items():
        bad = good.astype(np.result_type(type(value), float))
        bad.flat[1] = value
        refuses(dimension, error, rf"^{name} must", **{name: bad})
    bad = GOAL[dimension].astype(np.result_type(type(value), float))
    bad.flat[1] = value
    refuses(dimension, error, r"^goal must", many=[False], goal=bad)
    refuses(dimension, error, r"^goals must", many=[True], goals=[bad])


@every_dimension
def test_chains_that_are_none(dimension):
    angles, offsets = ANGLES[dimension], OFFSETS[dimension]
    empty = {"angles": angles[:0], "offsets": offsets[:0]}
    refuses(dimension, ValueError, r"^offsets needs 1 or more links", **empty)
    refuses(dimension, ValueError, r"^offsets\[0\] has the length 0", offsets=offsets * [[0], [1]])
    refuses(dimension, ValueError, r"^offsets must hold one link a row", offsets=offsets[:, :1])
    refuses(dimension, ValueError, r"^angles must hold .* each of the 2 links", angles=angles[:1])
    refuses(dimension, ValueError, r"^root must be one point", root=[0])


@every_dimension
def test_goals_of_the_wrong_dimension(dimension):
    goal = GOAL[dimension]
    for bad in (goal[:1], np.append(goal, 1), goal[None], 1.0):
        refuses(dimension, ValueError, r"^goal must be one point", many=[False], goal=bad)
    for bad in (goal[None, :1], [np.append(goal, 1)]):
        refuses(dimension, ValueError, r"^goals must hold one point a row", many=[True], goals=bad)
    refuses(dimension, ValueError, r"^goals must hold one point", many=[True], goals=goal)
    refuses(
        dimension,
        ValueError,
        r"^goals needs 1 or more",
        many=[True],
        goals=[goal][:0] or goal[None][:0],
    )


@every_dimension
def test_poses_of_another_number_of_goals(dimension):
    angles = np.repeat(ANGLES[dimension][None], 3, axis=0)
    shape = r"\(2,\)" if dimension == 2 else r"\(2, 3\)"
    match = rf"^angles .* shape {shape} or, with a pose for each goal, \(1, 2.* has shape \(3, 2"
    refuses(dimension, ValueError, match, many=[True], angles=angles)


@pytest.mark.parametrize("bad", ["newton", "", "Damped", None, 1, b"ccd", ["ccd"]])
def test_unknown_methods(bad):
    match = r'^method must be "pseudoinverse", "damped", "ccd" or "fabrik", but is '
    refuses(2, ValueError, match, method=bad)


@pytest.mark.parametrize(
    ("bad", "error"),
    [
        (0, ValueError),
        (-1e-5, ValueError),
        (math.nan, ValueError),
        (math.inf, ValueError),
        ([1e-5], ValueError),
        ("small", TypeError),
        (None, TypeError),
        (True, TypeError),
    ],
)
def test_tolerances(bad, error):
    refuses(2, error, r"^tolerance must", tolerance=bad)


@pytest.mark.parametrize(
    ("bad", "error"),
    [(0, ValueError), (-3, ValueError), (2.5, TypeError), (None, TypeError), (True, TypeError)],
)
def test_numbers_of_iterations(bad, error):
    refuses(2, error, r"^max_iterations must be a whole number", max_iterations=bad)


@pytest.mark.parametrize("bad", [1, "no", None])
def test_closest(bad):
    refuses(2, TypeError, r"^closest must be True or False, but is ", closest=bad)


@every_dimension
def test_angles_without_digits_for_small_turns(dimension):
    refuses(
        dimension,
        ValueError,
        r"^angles .* 1e\+06 radians, but one is -1e\+17",
        angles=ANGLES[dimension] * 0 - 1e17,
    )


@every_dimension
def test_sizes_that_fit_no_float(dimension):
    goal = GOAL[dimension]
    refuses(dimension, ValueError, r"^offsets: too large", offsets=OFFSETS[dimension] * 8e307)
    huge = {"root": goal * -8e307, "goal": goal * 8e307}
    refuses(dimension, ValueError, r"^goal and root: too large", many=[False], **huge)
    tiny = {"offsets": OFFSETS[dimension] * 1e-200, "goal": goal * 1e200}
    refuses(dimension, ValueError, r"^goal: too large", many=[False], **tiny)


@every_dimension
@every_method
def test_arguments_stay_as_they_are(dimension, method):
    angles, offsets, goal = (values[dimension].copy() for values in (ANGLES, OFFSETS, GOAL))
    found = inverse_kinematics_batch(angles, offsets, goal[None], method=method)
    result = inverse_kinematics(angles, offsets, goal, method=method)
    result.angles[:] = result.history[:] = found.angles[:] = 7
    for now, values in zip((angles, offsets, goal), (ANGLES, OFFSETS, GOAL)):
        assert now.tolist() == values[dimension].tolist()
