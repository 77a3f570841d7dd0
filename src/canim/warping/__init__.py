"""Image warping and morphing with triangles over key points (Tasks 2.1 to 2.3)."""

from canim.warping.morph import morph, morph_frames, save_gif
from canim.warping.triangulation import add_frame_points, affine_transforms, triangulate
from canim.warping.warp import warp_backward, warp_forward

__all__ = [
    "add_frame_points",
    "affine_transforms",
    "morph",
    "morph_frames",
    "save_gif",
    "triangulate",
    "warp_backward",
    "warp_forward",
]
