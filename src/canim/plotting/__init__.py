"""How pages and starters draw what plain matplotlib calls cannot say in one line."""

from canim.plotting.chains import animate_chain, animate_chains, draw_chain, slow_poses
from canim.plotting.curves import label_curves
from canim.plotting.faces import animate_face, draw_face, weight_sliders
from canim.plotting.films import animate_construction, animate_morph, animate_points
from canim.plotting.images import draw_points, draw_triangulation, pick_points, progress

__all__ = [
    "animate_chain",
    "animate_chains",
    "animate_construction",
    "animate_face",
    "animate_morph",
    "animate_points",
    "draw_chain",
    "draw_face",
    "draw_points",
    "draw_triangulation",
    "label_curves",
    "pick_points",
    "progress",
    "slow_poses",
    "weight_sliders",
]
