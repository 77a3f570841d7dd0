import numpy as np


def rotation(angle):
    """Return R: it turns by an angle in radians, counter-clockwise."""
    R = np.eye(3)
    R[0, 0] = np.cos(angle)
    R[0, 1] = -np.sin(angle)
    R[1, 0] = np.sin(angle)
    R[1, 1] = np.cos(angle)
    return R


def forward_kinematics(angles, offsets):
    """Return the root and the end of each link, one a row: shape (N + 1, 2)."""
    positions = np.full((len(angles) + 1, 2), np.nan)
    positions[0] = 0, 0  # root: given
    T = rotation(angles[0]) @ translation(offsets[0])  # first joint: given
    positions[1] = T[:2, 2]  # the last column without its 1
    for i in range(1, len(angles)):
        R = rotation(angles[i])
        Z = translation(offsets[i])
        T = T @ R @ Z
        positions[i + 1] = T[:2, 2]
    return positions
