"""Pictures and key points for the tasks: drawn here, or taken from where SOURCES.md says."""

from canim.data.images import ImagePair, keypoints, portraits, read_image, toy_triangles

__all__ = ["ImagePair", "keypoints", "portraits", "read_image", "toy_triangles"]
