"""Chains of links that turn in joints, and faces mixed from shapes (Tasks 3.1 to 3.5)."""

from canim.character.blendshapes import (
    Face,
    delta_blendshape,
    global_blendshape,
    load_expressions,
)
from canim.character.forward_kinematics import (
    forward_kinematics_2d,
    forward_kinematics_3d,
    jacobian_2d,
    jacobian_3d,
    joint_transforms,
    numeric_jacobian,
)
from canim.character.inverse_kinematics import (
    IKBatchResult,
    IKResult,
    inverse_kinematics,
    inverse_kinematics_batch,
)

__all__ = [
    "Face",
    "IKBatchResult",
    "IKResult",
    "delta_blendshape",
    "forward_kinematics_2d",
    "forward_kinematics_3d",
    "global_blendshape",
    "inverse_kinematics",
    "inverse_kinematics_batch",
    "jacobian_2d",
    "jacobian_3d",
    "joint_transforms",
    "load_expressions",
    "numeric_jacobian",
]
