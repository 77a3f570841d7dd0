"""What the tasks work on: drawn here, or taken from where the files SOURCES.md say."""

from canim.data.expressions import MIXES, face, save_expressions
from canim.data.images import ImagePair, keypoints, portraits, read_image, toy_triangles

__all__ = [
    "MIXES",
    "ImagePair",
    "face",
    "keypoints",
    "portraits",
    "read_image",
    "save_expressions",
    "toy_triangles",
]
