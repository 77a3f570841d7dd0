"""What the tasks work on: drawn here, or taken from where the files SOURCES.md say."""

from canim.data.expressions import MIXES, expression_paths, face
from canim.data.images import ImagePair, keypoints, portraits, read_image, toy_triangles

__all__ = [
    "MIXES",
    "ImagePair",
    "expression_paths",
    "face",
    "keypoints",
    "portraits",
    "read_image",
    "toy_triangles",
]
