"""Task 3.3 in other styles."""

import numpy as np

from canim.character import forward_kinematics_3d, jacobian_3d

# As in the starter.
STEP_SIZE, TOLERANCE = 0.1, 1e-3


def rotation__written_out(angles):
    (ca, cb, cc), (sa, sb, sc) = np.cos(angles), np.sin(angles)
    return [
        [cb * cc, -cb * sc, sb],
        [ca * sc + sa * sb * cc, ca * cc - sa * sb * sc, -sa * cb],
        [sa * sc - ca * sb * cc, sa * cc + ca * sb * sc, ca * cb],
    ]


def rotation__one_axis_after_the_other(angles):
    R = np.eye(3)
    for axis, angle in enumerate(angles):
        one = np.eye(3)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        one[[i, j], [i, j]] = np.cos(angle)
        one[i, j], one[j, i] = -np.sin(angle), np.sin(angle)
        R = R.dot(one)
    return R


def jacobian__all_angles_in_one_row(angles, offsets):
    flat = angles.ravel()
    here = forward_kinematics_3d(angles, offsets)[-1]
    columns = []
    for n in range(flat.size):
        turned = flat.copy()
        turned[n] += 1e-6
        there = forward_kinematics_3d(turned.reshape(angles.shape), offsets)[-1]
        columns.append((there - here) / 1e-6)
    return np.column_stack(columns)


def reach__with_the_analytic_jacobian(angles, offsets, goal):
    poses = [angles]
    for _ in range(200):
        e = goal - forward_kinematics_3d(poses[-1], offsets)[-1]
        if np.sqrt(e @ e) < TOLERANCE:
            break
        J = jacobian_3d(poses[-1], offsets)
        change = STEP_SIZE * J.T @ np.linalg.inv(J @ J.T) @ e
        poses.append(poses[-1] + change.reshape(-1, 3))
    return np.array(poses)
