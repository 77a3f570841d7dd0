"""How pages and starters draw what plain matplotlib calls cannot say in one line."""

from canim.plotting.curves import label_curves
from canim.plotting.films import animate_construction, animate_points

__all__ = ["animate_construction", "animate_points", "label_curves"]
