"""Task 3.5: differences may be added in any order, and the neutral face once."""

import numpy as np
import pytest

from canim import character, checks

TASK = checks.TASKS["3.5"]


def deltas(neutral, shapes):
    return [shape - neutral for shape in shapes]


def added(neutral, shapes, weights):
    vertices = neutral.copy()
    for weight, delta in zip(weights, deltas(neutral, shapes)):
        vertices += weight * delta
    return vertices


def results(**changed):
    functions = {"deltas": deltas, "delta_blendshape": added} | changed
    return {r.part: r for r in checks.run(TASK, functions, hint=True).results}


def states(**changed):
    return [result.state for result in results(**changed).values()]


@pytest.mark.parametrize(
    "way",
    [
        added,
        lambda b, shapes, w: b + np.tensordot(w, shapes - b, axes=1),
        lambda b, shapes, w: (1 - w.sum()) * b + np.einsum("k,kvd->vd", w, shapes),
        lambda b, shapes, w: sum((wk * (s - b) for wk, s in zip(w, shapes)), b).tolist(),
    ],
)
def test_every_way_to_add_is_right(way):
    assert states(delta_blendshape=way) == ["done"] * 2


def test_canims_function_is_right_and_is_told():
    functions = {"deltas": deltas, "delta_blendshape": character.delta_blendshape}
    report = checks.run(TASK, functions)
    assert report.done
    assert report.notes == ("delta_blendshape uses canim's function.",)


def test_the_sum_may_be_written_first():
    assert states(deltas=lambda neutral, shapes: 0 * shapes) == ["unwritten", "done"]
    assert states(delta_blendshape=lambda neutral, *_: neutral.copy()) == ["done", "unwritten"]


def test_a_neutral_face_that_is_changed_is_told():
    def in_place(neutral, shapes, weights):
        vertices = neutral
        for weight, shape in zip(weights, shapes):
            vertices += weight * (shape - neutral)
        return vertices

    report = checks.run(TASK, {"deltas": deltas, "delta_blendshape": in_place}, hint=True)
    assert any("changes what it is given" in note for note in report.notes)
    assert [r.mistake for r in report.results] == ["", "neutral face changed in place"]


def test_a_wrong_delta_is_named():
    def wrong(neutral, shapes):
        changes = shapes - neutral
        changes[1, 3, 0] += 1
        return changes

    message = results(deltas=wrong)["deltas"].message
    assert message.startswith("x of vertex 3 in delta 1: expected ")


def test_a_mistake_in_the_deltas_explains_the_sum_as_well():
    def turned(neutral, shapes):
        return neutral - shapes

    def blended(neutral, shapes, weights):
        return neutral + np.tensordot(weights, turned(neutral, shapes), axes=1)

    found = results(deltas=turned, delta_blendshape=blended)
    assert {r.mistake for r in found.values()} == {"difference the wrong way round"}


@pytest.mark.parametrize(
    ("kept", "mistake"),
    [
        (slice(1, None), "first weight taken for the neutral face"),
        (slice(-1), "last shape left out"),
        (slice(1), "only the first shape"),
    ],
)
def test_a_loop_that_misses_expressions_is_told_in_the_deltas(kept, mistake):
    def some(neutral, shapes):
        changes = np.zeros(shapes.shape)
        changes[kept] = shapes[kept] - neutral
        return changes

    assert results(deltas=some)["deltas"].mistake == mistake


@pytest.mark.parametrize("instead", [1, np.nan])
def test_weights_divided_by_their_sum_are_told_whatever_is_done_at_zero(instead):
    def normalised(neutral, shapes, weights):
        return added(neutral, shapes, weights / (weights.sum() or instead))

    found = results(delta_blendshape=normalised)["weighted sum"]
    assert found.mistake == "weights divided by their sum"


def test_weights_below_zero_and_above_one_are_tried():
    def clipped(neutral, shapes, weights):
        return added(neutral, shapes, np.clip(weights, 0, 1))

    assert states(delta_blendshape=clipped) == ["done", "differs"]
