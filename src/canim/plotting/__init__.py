"""How pages and starters draw what plain matplotlib calls cannot say in one line."""

from canim.plotting.curves import label_curves

__all__ = ["label_curves"]
