"""The head that comes with canim, and its expressions."""

from __future__ import annotations

import numpy as np
import pytest

from canim.character import delta_blendshape
from canim.data import MIXES, expression_paths, face


@pytest.fixture(scope="module")
def head():
    return face()


def test_every_file_is_an_expression(head):
    first, *others = (path.stem for path in expression_paths())
    assert first == "neutral"
    assert others == list(head.expressions)
    assert len(others) >= 16


@pytest.mark.parametrize("mix", MIXES)
def test_mixes_are_of_expressions_that_are_there(head, mix):
    mixed = delta_blendshape(head.neutral, head.shapes, head.weights(MIXES[mix]))
    assert np.linalg.norm(mixed - head.neutral, axis=1).max() > 0.3
