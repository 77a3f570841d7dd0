"""Learn 3D computer animation by writing it: 17 small tasks, with checks that help.

The blocks of the course are `canim.interpolation`, `canim.warping` and `canim.character`;
`canim.check` tells a student what is right, what is missing and what to look at.
"""

from __future__ import annotations

import importlib

# To load `typing` would take longer than all the rest; type checkers know the name.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from canim import character, checks, data, interpolation, plotting, warping
    from canim.checks import check

__all__ = ["character", "check", "checks", "data", "interpolation", "plotting", "warping"]
__version__ = "0.1.0"


def __getattr__(name: str) -> Any:
    # Loading on first use keeps `import canim` quick.
    if name == "check":
        return importlib.import_module("canim.checks").check
    if name in __all__:
        return importlib.import_module(f"canim.{name}")
    raise AttributeError(f"module 'canim' has no attribute '{name}'")


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
