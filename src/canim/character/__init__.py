"""Chains of links that turn in joints (Tasks 3.1 to 3.3)."""

from canim.character.forward_kinematics import (
    forward_kinematics_2d,
    forward_kinematics_3d,
    jacobian_2d,
    jacobian_3d,
    joint_transforms,
    numeric_jacobian,
)

__all__ = [
    "forward_kinematics_2d",
    "forward_kinematics_3d",
    "jacobian_2d",
    "jacobian_3d",
    "joint_transforms",
    "numeric_jacobian",
]
