"""Task 3.2 in other styles."""

import numpy as np

from canim.character import forward_kinematics_2d, jacobian_2d

# As in the starter.
STEP_SIZE, TOLERANCE = 0.1, 1e-3


def jacobian__central_differences(angles, offsets):
    columns = []
    for step in 1e-5 * np.eye(len(angles)):
        ahead, behind = (forward_kinematics_2d(angles + d, offsets)[-1] for d in (step, -step))
        columns.append((ahead - behind) / 2e-5)
    return np.transpose(columns)


def jacobian__from_the_geometry(angles, offsets):
    *joints, end = forward_kinematics_2d(angles, offsets)
    ways = end - np.array(joints)
    return [[-y for _, y in ways], [x for x, _ in ways]]


def reach__with_a_while_loop(angles, offsets, goal):
    poses = [angles.tolist()]
    e = goal - forward_kinematics_2d(angles, offsets)[-1]
    while np.hypot(*e) >= TOLERANCE and len(poses) <= 200:
        J = jacobian_2d(angles, offsets)
        angles = angles + STEP_SIZE * np.linalg.lstsq(J, e, rcond=None)[0]
        poses.append(angles.tolist())
        e = goal - forward_kinematics_2d(angles, offsets)[-1]
    return poses
