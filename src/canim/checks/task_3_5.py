"""Task 3.5: what "done" means for differences from the neutral face."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import character
from canim.checks.blends import SHAPES, VERTICES, cases, coordinate, mixed
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task

NEUTRAL, EXPRESSIONS = SHAPES[0].copy(), SHAPES[1:].copy()
OTHER = EXPRESSIONS[:2, ::-1].copy()


def differences(neutral: Floats, shapes: Floats) -> Floats:
    """Return how far each shape moves each vertex."""
    moved: Floats = shapes - neutral
    return moved


def blended(neutral: Floats, shapes: Floats, weights: Floats) -> Floats:
    """Return the neutral face plus the weighted differences."""
    face: Floats = neutral + mixed(shapes - neutral, weights)
    return face


def _delta(index: tuple[int, ...], *args: Any) -> str:
    return f"{'xyz'[index[2]]} of vertex {index[1]} in delta {index[0]}"


def _not_begun(got: Floats) -> bool:
    return bool(np.array_equal(got, NEUTRAL))


def _none(got: Floats) -> bool:
    return not got.any()


def _turned(neutral: Floats, shapes: Floats) -> Floats:
    return neutral - shapes


def _in_place(neutral: Floats, shapes: Floats, weights: Floats) -> Floats:
    """Return what comes when the neutral face itself is changed while it is subtracted."""
    face = neutral.copy()
    for shape, weight in zip(shapes, weights):
        face += weight * (shape - face)
    return face


def _normalised(neutral: Floats, shapes: Floats, weights: Floats) -> Floats:
    with np.errstate(invalid="ignore"):
        face: Floats = neutral + mixed(shapes - neutral, weights) / weights.sum()
    return face


def _sum(result: Callable[[Floats, Floats, Floats], Floats], **others: Any) -> dict[str, Any]:
    return {"delta_blendshape": result, **others}


def _only(kept: slice) -> dict[str, Any]:
    """Return what comes when a loop takes some of the expressions only."""

    def deltas(neutral: Floats, shapes: Floats) -> Floats:
        changes = np.zeros(shapes.shape)
        changes[kept] = shapes[kept] - neutral
        return changes

    return _sum(lambda b, shapes, weights: blended(b, shapes[kept], weights[kept]), deltas=deltas)


DELTAS, SUM = "deltas", "weighted sum"

TASK = Task(
    id="3.5",
    name="compute_delta_blendshape",
    title="Mix what changes in a face",
    block="character",
    writes="the deltas and their weighted sum, about 5 lines",
    minutes=30,
    figure="Eq. 15",
    questions=3,
    builds_on=("3.4",),
    functions=(
        Function(
            "deltas",
            "deltas(neutral, shapes)",
            Array(
                lambda neutral, shapes: shapes.shape, "as many vertices for each shape as it has"
            ),
            differences,
        ),
        Function(
            "delta_blendshape",
            "delta_blendshape(neutral, shapes, weights)",
            VERTICES,
            blended,
        ),
    ),
    parts=(
        Part(
            DELTAS,
            lambda program, *args: program.deltas(*args),
            (Case((NEUTRAL, EXPRESSIONS)), Case((NEUTRAL, OTHER))),
            _delta,
            unwritten=_none,
        ),
        Part(
            SUM,
            lambda program, *args: program.delta_blendshape(*args),
            cases(
                (NEUTRAL, EXPRESSIONS),
                (0, 1, 0),
                (0.5, 0, 0.25),
                (1, 0, 1),
                (0, 0, 0),
                (1.5, -0.3, 2),
            ),
            coordinate,
            unwritten=_not_begun,
        ),
    ),
    lines={
        "deltas": "deltas: each shape minus the neutral face",
        "weighted sum": "weighted sum: for each shape, add its weight times its delta",
    },
    mistakes=(
        Mistake(
            "difference the wrong way round",
            "Everything moves the opposite way. Look at each minus, in the deltas and in the sum.",
            _sum(
                lambda neutral, shapes, weights: neutral - mixed(shapes - neutral, weights),
                deltas=_turned,
            ),
            source="study: computation",
            line="deltas: each shape minus the neutral face",
        ),
        Mistake(
            "neutral not subtracted",
            "Whole shapes are added, as in Task 3.4. What has to be subtracted from each?",
            _sum(
                lambda neutral, shapes, weights: neutral + mixed(shapes, weights),
                deltas=lambda neutral, shapes: shapes.copy(),
            ),
            source="neighbour: Task 3.4",
            line="deltas: each shape minus the neutral face",
        ),
        Mistake(
            "neutral added",
            "In each delta the neutral face is added. It has to be subtracted.",
            _sum(
                lambda neutral, shapes, weights: neutral + mixed(shapes + neutral, weights),
                deltas=lambda neutral, shapes: shapes + neutral,
            ),
            source="study: computation",
            line="deltas: each shape minus the neutral face",
        ),
        Mistake(
            "first shape subtracted",
            "Shape 0 is subtracted. The neutral face is not among the shapes here.",
            _sum(
                lambda neutral, shapes, weights: neutral + mixed(shapes - shapes[0], weights),
                deltas=lambda neutral, shapes: shapes - shapes[0],
            ),
            source="neighbour: in Task 3.4 shape 0 is the neutral face",
            line="deltas: each shape minus the neutral face",
        ),
        Mistake(
            "neutral left out",
            "These are only the deltas. To what are they added?",
            _sum(lambda neutral, shapes, weights: mixed(shapes - neutral, weights)),
            source="study: computation",
            line="start: the neutral face",
        ),
        Mistake(
            "neutral added for each shape",
            "The neutral face is added once for each shape. It belongs outside the loop.",
            _sum(
                lambda neutral, shapes, weights: (
                    len(shapes) * neutral + mixed(shapes - neutral, weights)
                )
            ),
            source="study: loop",
        ),
        Mistake(
            "neutral added again for each shape",
            "The neutral face is added again with each shape. It is there from the start.",
            _sum(
                lambda neutral, shapes, weights: (
                    len(shapes) * neutral + blended(neutral, shapes, weights)
                )
            ),
            source="trial",
        ),
        Mistake(
            "neutral added twice",
            "The neutral face is counted twice. Where does the sum start?",
            _sum(
                lambda neutral, shapes, weights: 2 * neutral + mixed(shapes - neutral, weights),
            ),
            source="study: loop",
            line="start: the neutral face",
        ),
        Mistake(
            "global formula",
            "This is the sum of Task 3.4, without any neutral face.",
            _sum(lambda neutral, shapes, weights: mixed(shapes, weights)),
            source="neighbour: Task 3.4",
        ),
        Mistake(
            "first weight taken for the neutral face",
            "The first expression is left out. The neutral face is not in shapes, nor in weights.",
            _only(slice(1, None)),
            source="paper: Eq. 15 begins with k = 0",
        ),
        Mistake(
            "neutral face with the first weight",
            "The neutral face is multiplied by the first weight. It has no weight here.",
            _sum(
                lambda neutral, shapes, weights: (
                    weights[0] * neutral + mixed(shapes - neutral, weights)
                )
            ),
            source="paper: Eq. 15 begins with k = 0",
        ),
        Mistake(
            "first weight given to the neutral face",
            "The first weight went to the neutral face. It belongs to the first expression.",
            _sum(
                lambda neutral, shapes, weights: (
                    weights[0] * neutral + mixed(shapes[1:] - neutral, weights[1:])
                )
            ),
            source="trial",
        ),
        Mistake(
            "neutral face with what is left",
            "The neutral face gets the share that is left. Here it is added whole.",
            _sum(
                lambda neutral, shapes, weights: (
                    (1 - weights.sum()) * neutral + mixed(shapes - neutral, weights)
                )
            ),
            source="study: concept",
        ),
        Mistake(
            "last shape left out",
            "The last expression is left out. Where does the loop end?",
            _only(slice(-1)),
            source="study: loop",
        ),
        Mistake(
            "weights not applied",
            "The deltas are added whole. Where does the weight of each come in?",
            _sum(lambda neutral, shapes, weights: neutral + (shapes - neutral).sum(axis=0)),
            source="study: computation",
        ),
        Mistake(
            "weight on the shape alone",
            "The weight has to multiply the whole difference. Look at the brackets.",
            _sum(
                lambda neutral, shapes, weights: (
                    neutral + mixed(shapes, weights) - len(shapes) * neutral
                )
            ),
            source="study: computation",
        ),
        Mistake(
            "weights divided by their sum",
            "The weights were divided by their sum. Take them as they are.",
            _sum(_normalised),
            parts=(SUM,),
            # Where the sum is 0, some divide and some do not: compare what differs only.
            applies=lambda got, _, *args: np.allclose(got, _normalised(*args), equal_nan=True),
            source="study: concept",
        ),
        Mistake(
            "average of the deltas",
            "This is an average: it was divided by the number of shapes. Eq. 15 only adds.",
            _sum(
                lambda neutral, shapes, weights: (
                    neutral + mixed(shapes - neutral, weights) / len(shapes)
                )
            ),
            source="study: concept",
        ),
        Mistake(
            "neutral face changed in place",
            "The neutral face changes while it is still needed. Work on a copy.",
            _sum(_in_place),
            source="thread: strange behaviour with numpy arrays, numpy-discussion, September 2013",
            line="start: the neutral face",
        ),
        Mistake(
            "only the last shape",
            "Only the last delta is left: each one replaces the one before. Add to it.",
            _only(slice(-1, None)),
            source="study: loop",
        ),
        Mistake(
            "only the first shape",
            "Only the first delta is there. Is the return inside the loop?",
            _only(slice(1)),
            source="study: function",
            line="return the vertices",
        ),
    ),
    canim_functions=(character.delta_blendshape, character.global_blendshape),
)
