"""Task 3.4: a weighted sum is right however it is added, and its mistakes are told apart."""

import numpy as np
import pytest

from canim import character, checks

TASK = checks.TASKS["3.4"]


def added(shapes, weights):
    vertices = np.zeros(shapes[0].shape)
    for weight, shape in zip(weights, shapes):
        vertices += weight * shape
    return vertices


def weights_at(t, count, first, second):
    weights = np.zeros(count)
    weights[first], weights[second] = 1 - t, t
    return weights


def results(**changed):
    functions = {"global_blendshape": added, "weights_at": weights_at} | changed
    return {r.part: r for r in checks.run(TASK, functions, hint=True).results}


def states(**changed):
    return [result.state for result in results(**changed).values()]


def first_apart(shapes, weights):
    vertices = weights[0] * shapes[0]
    for k in range(1, len(shapes)):
        vertices = vertices + weights[k] * shapes[k]
    return vertices


def by_number(shapes, weights):
    return [
        [sum(w * shape[i][j] for w, shape in zip(weights, shapes)) for j in range(3)]
        for i in range(len(shapes[0]))
    ]


@pytest.mark.parametrize(
    "way",
    [
        added,
        first_apart,
        by_number,
        lambda shapes, weights: np.tensordot(weights, shapes, axes=1),
        lambda shapes, weights: np.einsum("k,kvd->vd", weights, shapes),
        lambda shapes, weights: (weights[:, None, None] * shapes).sum(axis=0),
        lambda shapes, weights: np.sum([w * s for w, s in zip(weights, shapes)], axis=0),
    ],
)
def test_every_way_to_add_is_right(way):
    assert states(global_blendshape=way) == ["done"] * 3


def test_canims_function_is_right_and_is_told():
    functions = {"global_blendshape": character.global_blendshape, "weights_at": weights_at}
    report = checks.run(TASK, functions)
    assert report.done
    assert report.notes == ("global_blendshape uses canim's function.",)


def test_weights_may_be_a_list():
    assert states(weights_at=lambda *args: weights_at(*args).tolist()) == ["done"] * 3


def test_a_start_alone_is_a_start():
    alone = results(global_blendshape=lambda shapes, weights: np.zeros(shapes[0].shape))
    assert [r.state for r in alone.values()] == ["done", "unwritten", "done"]


def test_a_shape_that_is_changed_is_told():
    def in_place(shapes, weights):
        vertices = shapes[0]
        for weight, shape in zip(weights, shapes):
            vertices += weight * shape
        return vertices

    report = checks.run(TASK, {"global_blendshape": in_place, "weights_at": weights_at}, hint=True)
    assert any("changes what it is given" in note for note in report.notes)
    assert [r.mistake for r in report.results] == ["", "neutral added twice", ""]


def test_a_wrong_number_is_named():
    def wrong(shapes, weights):
        vertices = added(shapes, weights)
        vertices[1, 2] += weights[2]
        return vertices

    message = results(global_blendshape=wrong)["weighted sum"].message
    assert message.startswith("weights 0, 0, 1, 0, z of vertex 1: expected ")


def test_a_wrong_weight_is_named():
    def squared(t, *args):
        return weights_at(t * t, *args)

    message = results(weights_at=squared)["weights of a moment"].message
    assert message.startswith("t = 0.25, from shape 1 to shape 3, weight of shape 1: expected 0.75")


@pytest.mark.parametrize("axis", [1, 2])
def test_a_sum_over_something_else_is_shown_with_its_shape(axis):
    def other(shapes, weights):
        return (weights[:, None, None] * shapes).sum(axis=axis)

    found = results(global_blendshape=other)["weighted sum"]
    assert found.state == "differs"
    assert found.message.startswith("has shape (4, ")
    assert "runs over" in found.hint


@pytest.mark.parametrize("wrong", [None, 1.0, np.zeros(15), "face"])
def test_what_is_no_face_is_said_once(wrong):
    assert states(global_blendshape=lambda shapes, weights: wrong) == ["unusable", "waits", "done"]
