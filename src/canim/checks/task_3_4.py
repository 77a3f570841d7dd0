"""Task 3.4: what "done" means for shapes that are mixed whole."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from canim import character
from canim.checks.blends import SHAPES, VERTICES, cases, coordinate, mixed, terms
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task


def _vertices(result: Any, *args: Any) -> Floats:
    """Accept vertices, and what comes of a sum over the vertices or over x, y and z."""
    count, points, dim = args[0].shape
    if isinstance(result, np.ndarray) and result.shape in ((count, dim), (count, points)):
        other: Floats = result.astype(float)
        return other
    return VERTICES(result, *args)


def _weights_at(t: float, count: int, first: int, second: int) -> Floats:
    weights = np.zeros(count)
    weights[first] = 1 - t
    weights[second] = t
    return weights


def _number_of_a_shape(index: tuple[int, ...], *args: Any) -> str:
    return f"weight of shape {index[0]}"


def _moment(t: float, count: int, first: int, second: int) -> Case:
    return Case((t, count, first, second), f"t = {t:g}, from shape {first} to shape {second}")


def _not_begun(got: Floats) -> bool:
    return bool(np.array_equal(got, SHAPES[0]))


def _none(got: Floats) -> bool:
    return not got.any()


def _backward(t: float, count: int, first: int, second: int) -> Floats:
    return _weights_at(1 - t, count, first, second)


def _only(which: int) -> Callable[[float, int, int, int], Floats]:
    def weights_at(t: float, count: int, first: int, second: int) -> Floats:
        weights = _weights_at(t, count, first, second)
        weights[(first, second)[which]] = 0
        return weights

    return weights_at


def _same(t: float, count: int, first: int, second: int) -> Floats:
    weights = _weights_at(t, count, first, second)
    weights[first] = t
    return weights


def _whole(t: float, count: int, first: int, second: int) -> Floats:
    weights = _weights_at(t, count, first, second)
    weights[first] = 1
    return weights


def _first_two(t: float, count: int, first: int, second: int) -> Floats:
    return _weights_at(t, count, 0, 1)


def _normalised(shapes: Floats, weights: Floats) -> Floats:
    face: Floats = mixed(shapes, weights) / weights.sum()
    return face


def _sum(result: Callable[[Floats, Floats], Floats]) -> dict[str, Any]:
    return {"global_blendshape": result}


START, SUM, WEIGHTS = "start", "weighted sum", "weights of a moment"

TASK = Task(
    id="3.4",
    name="compute_global_blendshape",
    title="Mix a face from other faces",
    block="character",
    writes="a weighted sum and the weights of a film, about 6 lines",
    minutes=30,
    figure="Eq. 14",
    questions=3,
    functions=(
        Function(
            "global_blendshape",
            "global_blendshape(shapes, weights)",
            _vertices,
            mixed,
        ),
        Function(
            "weights_at",
            "weights_at(t, count, first, second)",
            Array(lambda t, count, *_: (count,), "one weight for each shape"),
            _weights_at,
        ),
    ),
    parts=(
        Part(
            START,
            lambda program, *args: program.global_blendshape(*args),
            cases((SHAPES,), (0, 0, 0, 0)),
            coordinate,
            unwritten=_not_begun,
        ),
        Part(
            SUM,
            lambda program, *args: program.global_blendshape(*args),
            cases(
                (SHAPES,),
                (0, 0, 1, 0),
                (0, 0.5, 0, 0.5),
                (0.75, 0.25, 0, 0),
                (0, 1, 1, 0),
                (0.2, 0.1, -0.4, 0.6),
            ),
            coordinate,
            unwritten=lambda got: _not_begun(got) or _none(got),
        ),
        Part(
            WEIGHTS,
            lambda program, *args: program.weights_at(*args),
            (
                _moment(0.25, 4, 1, 3),
                _moment(0, 5, 4, 2),
                _moment(1, 3, 0, 1),
                _moment(0.6, 5, 3, 1),
            ),
            _number_of_a_shape,
            unwritten=_none,
        ),
    ),
    lines={
        "start": "start: every vertex at zero",
        "weighted sum": "weighted sum: for each shape, add its weight times the shape",
        "weights of a moment": (
            "weights of a moment: all 0, but 1 - t for the first and t for the second shape"
        ),
    },
    mistakes=(
        Mistake(
            "neutral added twice",
            "The neutral face is counted once too often. Where does the sum start?",
            _sum(lambda shapes, weights: shapes[0] + mixed(shapes, weights)),
            source="neighbour: Task 3.5 starts with the neutral face",
            line="start: every vertex at zero",
        ),
        Mistake(
            "neutral left out",
            "Shape 0, the neutral face, is left out. From which number does the loop start?",
            _sum(lambda shapes, weights: mixed(shapes[1:], weights[1:])),
            source="paper: Eq. 15 begins with k = 0",
            line="weighted sum: for each shape, add its weight times the shape",
        ),
        Mistake(
            "neutral in place of its share",
            "The neutral face is there as a whole. Does it have a weight, too?",
            _sum(lambda shapes, weights: shapes[0] + mixed(shapes[1:], weights[1:])),
            source="neighbour: Task 3.5 starts with the neutral face",
            line="start: every vertex at zero",
        ),
        Mistake(
            "last shape left out",
            "The last shape is left out. Where does the loop end?",
            _sum(lambda shapes, weights: mixed(shapes[:-1], weights[:-1])),
            source="study: loop",
        ),
        Mistake(
            "weights not applied",
            "The shapes are added whole. Where does the weight of each come in?",
            _sum(lambda shapes, weights: shapes.sum(axis=0)),
            source="study: computation",
        ),
        Mistake(
            "weights divided by their sum",
            "The weights were divided by their sum. Take them as they are.",
            _sum(_normalised),
            source="study: concept",
        ),
        Mistake(
            "average of the shapes",
            "This is an average: it was divided by the number of shapes. Eq. 14 only adds.",
            _sum(lambda shapes, weights: mixed(shapes, weights) / len(shapes)),
            source="study: concept",
        ),
        Mistake(
            "average without weights",
            "This is the average of all shapes, whatever the weights are.",
            _sum(lambda shapes, weights: shapes.mean(axis=0)),
            source="study: concept",
        ),
        Mistake(
            "sum over the vertices",
            "The sum runs over the vertices. It has to run over the shapes.",
            _sum(lambda shapes, weights: terms(shapes, weights).sum(axis=1)),
            source="study: array",
        ),
        Mistake(
            "sum over x, y and z",
            "The sum runs over x, y and z. It has to run over the shapes.",
            _sum(lambda shapes, weights: terms(shapes, weights).sum(axis=2)),
            source="study: array",
        ),
        Mistake(
            "only the last shape",
            "Only the last shape is left: each one replaces the one before. Add to it.",
            _sum(lambda shapes, weights: weights[-1] * shapes[-1]),
            source="study: loop",
        ),
        Mistake(
            "only the first shape",
            "Only the first shape is there. Is the return inside the loop?",
            _sum(lambda shapes, weights: weights[0] * shapes[0]),
            source="study: function",
            line="return the vertices",
        ),
        Mistake(
            "deltas",
            "These are the deltas of Task 3.5. Here the shapes themselves are added.",
            _sum(lambda shapes, weights: shapes[0] + mixed(shapes - shapes[0], weights)),
            source="neighbour: Task 3.5",
        ),
        Mistake(
            "film backward",
            "At t = 0 the first shape must have all the weight. Which one has it here?",
            {"weights_at": _backward},
            source="study: variable",
        ),
        Mistake(
            "first shape without weight",
            "The first shape has no weight. How large is its share at t = 0?",
            {"weights_at": _only(0)},
            source="study: computation",
        ),
        Mistake(
            "second shape without weight",
            "The second shape has no weight. How large is its share at t = 1?",
            {"weights_at": _only(1)},
            source="study: computation",
        ),
        Mistake(
            "first shape always whole",
            "The first shape keeps the weight 1, so the sum is not 1. Which share is left for it?",
            {"weights_at": _whole},
            source="study: computation",
        ),
        Mistake(
            "both shapes with the same weight",
            "Both shapes have the weight t. Which share is left for the first one?",
            {"weights_at": _same},
            source="trial",
        ),
        Mistake(
            "always shapes 0 and 1",
            "The film does not always run between shapes 0 and 1. Use first and second.",
            {"weights_at": _first_two},
            source="study: variable",
        ),
    ),
    canim_functions=(character.global_blendshape, character.delta_blendshape),
)
