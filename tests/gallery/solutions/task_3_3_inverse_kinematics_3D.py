import numpy as np


def rotation(angles):
    """Return R of one joint: Rx Ry Rz, of its angles about x, y and z."""
    a, b, c = angles
    Rx = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])  # given
    Ry = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    Rz = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    R = Rx @ Ry @ Rz
    return R


def jacobian(angles, offsets):
    """Return J, shape (3, 3 N): three columns for each joint, one joint after the other."""
    epsilon = 1e-6
    J = np.zeros((3, angles.size))
    p = forward_kinematics(angles, offsets)[-1]  # end effector: given
    for i in range(len(angles)):
        for k in range(3):
            turned = angles.copy()
            turned[i, k] = turned[i, k] + epsilon
            moved = forward_kinematics(turned, offsets)[-1]
            J[:, 3 * i + k] = (moved - p) / epsilon
    return J


def reach(angles, offsets, goal):
    """Return all poses on the way to the goal, one a row; the first is angles."""
    poses = [angles]
    for _ in range(200):
        e = goal - forward_kinematics(angles, offsets)[-1]
        if np.linalg.norm(e) < tolerance:
            break
        J = jacobian(angles, offsets)
        change = step_size * np.linalg.pinv(J) @ e
        angles = angles + change.reshape(angles.shape)
        poses.append(angles)
    return poses
