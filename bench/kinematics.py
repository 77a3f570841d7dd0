"""Time inverse kinematics against ikpy and pinocchio; see that every method reaches its goals."""

from __future__ import annotations

import math

import numpy as np
import pinocchio as pin
from ikpy.chain import Chain
from ikpy.link import OriginLink, URDFLink
from timing import Row, compare

from canim.character import (
    forward_kinematics_2d,
    forward_kinematics_3d,
    inverse_kinematics,
    inverse_kinematics_batch,
    jacobian_2d,
    jacobian_3d,
    numeric_jacobian,
)

TOLERANCE = 1e-5
ITERATIONS = 200
SIZES = [(2, 3), (2, 10), (2, 100), (3, 3), (3, 20)]
LEAST = {"pseudoinverse": 0.995, "damped": 1.0, "ccd": 0.99, "fabrik": 1.0}
LIMITS = {"tolerance": TOLERANCE, "max_iterations": ITERATIONS}


def task(dimension, count, nearest=0.0, farthest=1.0, goals=1000):
    """Return starting angles, links that point up, and goals evenly over a part of the reach."""
    rng = np.random.default_rng(dimension * 1000 + count)
    offsets = np.tile(np.eye(dimension)[-1], (count, 1))
    start = rng.uniform(-math.pi, math.pi, (goals, count, *[3] * (dimension - 2)))
    low, high = (count * share for share in (nearest, farthest))
    radius = rng.uniform(low**dimension, high**dimension, (goals, 1)) ** (1 / dimension)
    way = rng.normal(size=(goals, dimension))
    return start, offsets, way * radius / np.linalg.norm(way, axis=1, keepdims=True)


def title(dimension, count) -> str:
    return f"{dimension}D, {count} {'links' if dimension == 2 else 'joints of three angles'}"


def see_that_goals_are_reached(dimension, count) -> None:
    """Solve 1000 goals in reach and 1000 too far away by each method."""
    for method, least in LEAST.items():
        start, offsets, goals = task(dimension, count)
        found = inverse_kinematics_batch(start, offsets, goals, method=method, **LIMITS)
        share = (np.linalg.norm(found.positions[:, -1] - goals, axis=1) <= TOLERANCE * count).mean()
        start, offsets, goals = task(dimension, count, 1.001, 2)
        beyond = inverse_kinematics_batch(start, offsets, goals, method=method, **LIMITS)
        distance = np.linalg.norm(beyond.positions[:, -1] - goals, axis=1)
        closest = (distance <= (np.linalg.norm(goals, axis=1) - count) * (1 + 1e-3)).mean()
        print(
            f"{title(dimension, count)}, {method}: {share:.1%} of goals in reach are reached, "
            f"in {found.iterations.mean():.1f} iterations; {closest:.1%} of the others come closest"
        )
        assert share >= least
        assert closest == 1


def see_that_jacobians_agree(dimension, count) -> None:
    """Compare the analytic Jacobian with central differences."""
    start, offsets, _ = task(dimension, count, goals=1)
    forward = forward_kinematics_2d if dimension == 2 else forward_kinematics_3d
    exact = (jacobian_2d if dimension == 2 else jacobian_3d)(start[0], offsets)
    numeric = numeric_jacobian(lambda angles: forward(angles, offsets)[-1], start[0])
    difference = np.abs(exact - numeric).max() / np.abs(exact).max()
    assert difference <= 1e-7, difference


def placed(points):
    """Return points of the plane, or of space, as points of space."""
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def ikpy_chain(offsets):
    axes = np.eye(3)[[2]] if offsets.shape[1] == 2 else np.eye(3)
    links, place = [OriginLink()], np.zeros(3)
    for offset in placed(offsets):
        for axis in axes:
            links.append(URDFLink("joint", place, [0, 0, 0], rotation=axis))
            place = np.zeros(3)
        place = offset
    links.append(URDFLink("end", place, [0, 0, 0], joint_type="fixed"))
    return Chain(links, active_links_mask=[False, *[True] * (len(links) - 2), False])


def against_ikpy(dimension, count, goal) -> Row:
    start, offsets, goals = task(dimension, count, goals=20)
    chain = ikpy_chain(offsets)
    targets, poses = placed(goals), np.pad(start.reshape(len(start), -1), ((0, 0), (1, 1)))

    def ours():
        return [inverse_kinematics(pose, offsets, g, **LIMITS) for pose, g in zip(start, goals)]

    def ikpy():
        return [
            chain.inverse_kinematics(target, initial_position=pose)
            for target, pose in zip(targets, poses)
        ]

    assert all(result.converged for result in ours())
    for angles, target in zip(ikpy(), targets):
        place = chain.forward_kinematics(angles)[:3, 3]
        assert np.linalg.norm(place - target) <= TOLERANCE * count
    name = f"`inverse_kinematics`, {title(dimension, count)}, 20 goals"
    return compare(name, ours, {"ikpy": ikpy}, goal)


def against_pinocchio(dimension, count, goal) -> Row:
    start, offsets, goals = task(dimension, count)
    joints = [pin.JointModelRX(), pin.JointModelRY(), pin.JointModelRZ()]
    model, parent, place = pin.Model(), 0, np.zeros(3)
    for offset in placed(offsets):
        for joint in joints[-1:] if dimension == 2 else joints:
            placement = pin.SE3(np.eye(3), place)
            parent = model.addJoint(parent, joint, placement, f"joint {model.njoints}")
            place = np.zeros(3)
        place = offset
    placement = pin.SE3(np.eye(3), place)
    end = model.addFrame(pin.Frame("end", parent, 0, placement, pin.FrameType.OP_FRAME))
    data = model.createData()
    frame = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def reach(q, target):
        """Damped least squares as in pinocchio's examples; long steps are cut, which is faster."""
        q = q.copy()
        for _ in range(ITERATIONS):
            pin.framesForwardKinematics(model, data, q)
            error = (target - data.oMf[end].translation)[:dimension]
            distance = math.sqrt(error @ error)
            if distance <= TOLERANCE * count:
                return True
            if distance > 0.2 * count:
                error *= 0.2 * count / distance
            jacobian = pin.computeFrameJacobian(model, data, q, end, frame)[:dimension]
            square = jacobian @ jacobian.T
            square.flat[:: dimension + 1] += 1e-3
            q += jacobian.T @ np.linalg.solve(square, error)
        return False

    poses, targets = start.reshape(len(start), -1), placed(goals)

    def pinocchio():
        return [reach(q, target) for q, target in zip(poses, targets)]

    def ours():
        return inverse_kinematics_batch(start, offsets, goals, **LIMITS)

    assert ours().converged.all()
    assert np.mean(pinocchio()) >= 0.99
    name = f"`inverse_kinematics_batch`, {title(dimension, count)}, 1000 goals"
    return compare(name, ours, {"pinocchio, goal by goal": pinocchio}, goal, repeats=5)


def rows() -> list[Row]:
    for size in SIZES:
        see_that_goals_are_reached(*size)
        see_that_jacobians_agree(*size)
    return [
        against_ikpy(2, 10, 40),
        against_ikpy(3, 3, 10),
        against_pinocchio(2, 10, 10),
        against_pinocchio(3, 20, 1.5),
    ]
