"""What the checks of blendshapes share: small shapes, cases of weights, the weighted sum.

The shapes are small and have nothing in common, so that every mistake shows.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from canim.checks.run import number
from canim.checks.task import Array, Case, Floats

# Four shapes, the neutral face first, of five vertices.
SHAPES = np.round(np.sin(np.arange(60.0) ** 2).reshape(4, 5, 3), 2)
SHAPES[1:] += 0.5 * SHAPES[0]


def in_words(weights: Floats) -> str:
    """Return weights as a student would write them."""
    return f"weights {', '.join(map(number, weights))}"


def cases(shapes: tuple[Any, ...], *rows: tuple[float, ...]) -> tuple[Case, ...]:
    """Return a case for each row of weights."""
    return tuple(Case((*shapes, np.array(row)), in_words(np.array(row))) for row in rows)


VERTICES = Array(lambda *args: args[-2].shape[1:], "one row per vertex, with x, y and z")


def coordinate(index: tuple[int, ...], *args: Any) -> str:
    """Name a number of a vertex."""
    return f"{'xyz'[index[1]]} of vertex {index[0]}"


def terms(shapes: Floats, weights: Floats) -> Floats:
    """Return each shape times its weight."""
    product: Floats = weights[:, None, None] * shapes
    return product


def mixed(shapes: Floats, weights: Floats) -> Floats:
    """Return the weighted sum of the shapes."""
    face: Floats = terms(shapes, weights).sum(axis=0)
    return face
