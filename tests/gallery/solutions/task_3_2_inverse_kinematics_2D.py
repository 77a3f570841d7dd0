import numpy as np


def jacobian(angles, offsets):
    """Return J, shape (2, N): column i is where the end effector moves with joint i."""
    epsilon = 1e-6
    J = np.zeros((2, len(angles)))
    p = forward_kinematics_2d(angles, offsets)[-1]  # end effector: given
    for i in range(len(angles)):
        turned = angles.copy()
        turned[i] = turned[i] + epsilon
        moved = forward_kinematics_2d(turned, offsets)[-1]
        J[:, i] = (moved - p) / epsilon
    return J


def reach(angles, offsets, goal):
    """Return all poses on the way to the goal, one a row; the first is angles."""
    poses = [angles]
    for _ in range(200):
        e = goal - forward_kinematics_2d(angles, offsets)[-1]
        if np.linalg.norm(e) < tolerance:
            break
        J = jacobian(angles, offsets)
        angles = angles + step_size * np.linalg.pinv(J) @ e
        poses.append(angles)
    return poses
