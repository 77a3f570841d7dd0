"""The head that comes with canim, and its expressions."""

from __future__ import annotations

import runpy
from importlib.resources import files

import numpy as np
import pytest
import trimesh

from canim.character import delta_blendshape, global_blendshape, load_expressions
from canim.data import MIXES, face, save_expressions

FILE = files("canim.data") / "face/face.npz"
ONE_SIDE = [
    *("blink_left", "brow_down_left", "brow_up_left", "smile_left"),
    *("blink_right", "brow_down_right", "brow_up_right", "smile_right"),
]


@pytest.fixture(scope="module")
def head():
    return face()


@pytest.fixture(scope="module")
def script(root):
    return runpy.run_path(str(root / "docs/face.py"))


def moves(head, name):
    return head.expressions[name] - head.neutral


def place(head, name):
    """Return where an expression moves the face: the mean of its vertices, by their moves."""
    sizes = np.linalg.norm(moves(head, name), axis=1)
    return sizes @ head.neutral / sizes.sum()


def test_the_expressions_are_those_that_are_made(head, script):
    assert list(head.expressions) == sorted(script["EXPRESSIONS"])
    assert len(head.expressions) >= 16


def test_saved_as_obj_files_the_face_is_the_same(head, tmp_path):
    save_expressions(tmp_path / "new" / "head")
    again = load_expressions(tmp_path / "new" / "head")
    assert list(again.expressions) == list(head.expressions)
    for name in ("neutral", "shapes", "faces", "colors"):
        np.testing.assert_array_equal(getattr(again, name), getattr(head, name))


def test_others_read_the_files_as_well(head, tmp_path):
    save_expressions(tmp_path)
    mesh = trimesh.load_mesh(tmp_path / "o.obj", process=False, maintain_order=True)
    np.testing.assert_array_equal(mesh.vertices, head.expressions["o"])
    np.testing.assert_array_equal(mesh.faces, head.faces)


def test_a_file_that_somebody_changed_is_not_written_over(tmp_path):
    save_expressions(tmp_path)
    (tmp_path / "o.obj").write_text("mine")
    (tmp_path / "frown.obj").unlink()
    with pytest.raises(FileExistsError, match=r"^folder: .*o\.obj is there already"):
        save_expressions(tmp_path)
    assert (tmp_path / "o.obj").read_text() == "mine"
    assert not (tmp_path / "frown.obj").exists()
    (tmp_path / "o.obj").unlink()
    save_expressions(str(tmp_path))
    assert (tmp_path / "frown.obj").exists()


def test_no_folder_is_refused(tmp_path):
    with pytest.raises(TypeError, match=r"^folder must be the name of a folder, but is 3"):
        save_expressions(3)
    (tmp_path / "file").touch()
    with pytest.raises(FileExistsError):
        save_expressions(tmp_path / "file")


def test_the_head_is_in_the_middle_and_of_the_size_of_a_head(head):
    low, high = head.neutral.min(axis=0), head.neutral.max(axis=0)
    np.testing.assert_allclose(low + high, 0, atol=0.011)
    # Width, height with the neck, depth, in centimetres.
    assert (high - low > (15, 25, 18)).all()
    assert (high - low < (20, 32, 24)).all()


def test_the_head_looks_towards_z_with_its_eyes_open(head):
    """What is dark and lies in front are pupils: one on each side, on the front of the face."""
    dark = head.neutral[head.colors.max(axis=1) < 0.05]
    assert (dark[:, 2] > 3).all()
    left, right = dark[dark[:, 0] > 0].mean(axis=0), dark[dark[:, 0] < 0].mean(axis=0)
    np.testing.assert_allclose(left, right * (-1, 1, 1), atol=0.02)
    assert 5 < left[0] - right[0] < 8
    nose = head.neutral[head.neutral[:, 2].argmax()]
    assert abs(nose[0]) < 0.3
    assert nose[1] < left[1]


@pytest.mark.parametrize("name", ONE_SIDE)
def test_left_and_right_are_those_of_the_head(head, name):
    side = 1 if name.endswith("left") else -1
    sizes = np.linalg.norm(moves(head, name), axis=1)
    there = side * head.neutral[:, 0] > 0
    assert sizes[there].sum() > 5 * sizes[~there].sum()


@pytest.mark.parametrize("name", ["jaw", "look"])
def test_the_way_that_jaw_and_eyes_move(head, name):
    for side, sign in (("left", 1), ("right", -1)):
        move = moves(head, f"{name}_{side}")
        largest = np.linalg.norm(move, axis=1) > 0.2
        assert (sign * move[largest, 0]).mean() > 0.1


@pytest.mark.parametrize(
    ("name", "up"),
    [
        ("mouth_open", -1),
        ("frown", -1),
        ("smile_left", 1),
        ("brow_down_right", -1),
        ("brow_up_right", 1),
        ("brows_up_inner", 1),
        ("blink_left", -1),
        ("eyes_wide", 1),
    ],
)
def test_what_goes_up_and_down(head, name, up):
    move = moves(head, name)
    largest = move[np.abs(move[:, 1]).argsort()[-20:], 1]
    assert (np.sign(largest) == up).mean() > 0.7


def test_mouth_and_brows_and_eyes_are_one_above_the_other(head):
    mouth, eyes, brows = (
        place(head, name)[1] for name in ("pucker", "eyes_wide", "brows_up_inner")
    )
    assert mouth < eyes < brows


def test_each_expression_is_seen_and_unlike_the_others(head):
    """At weight 1 something moves by 4 mm or more; no two files hold the same face."""
    for name in head.expressions:
        assert np.linalg.norm(moves(head, name), axis=1).max() > 0.4, name
    flat = head.shapes.reshape(len(head.shapes), -1) - head.neutral.ravel()
    flat /= np.linalg.norm(flat, axis=1)[:, None]
    assert (flat @ flat.T - np.eye(len(flat))).max() < 0.95


def test_the_back_of_the_head_and_the_neck_stay(head):
    back = head.neutral[:, 2] < -3
    assert back.sum() > 200
    assert (head.shapes[:, back] == head.neutral[back]).all()
    everything = delta_blendshape(head.neutral, head.shapes, np.full(len(head.shapes), 2.0))
    np.testing.assert_allclose(everything[back], head.neutral[back], rtol=0, atol=1e-12 * 28)


def test_weights_of_two_in_sum_double_the_head_but_not_with_deltas(head):
    pair = np.stack([head.neutral, head.expressions["mouth_open"]])
    box = np.ptp(head.neutral, axis=0)
    grown = np.ptp(global_blendshape(pair, [1, 1]), axis=0)
    np.testing.assert_allclose(grown, 2 * box, rtol=0.03)
    same = np.ptp(delta_blendshape(head.neutral, pair, [1, 1]), axis=0)
    np.testing.assert_allclose(same, box, rtol=0.03)


def test_colors(head):
    assert head.colors.shape == head.neutral.shape
    assert len(np.unique(head.colors.round(1), axis=0)) > 20


@pytest.mark.parametrize("mix", MIXES)
def test_mixes_are_of_expressions_that_are_there(head, mix):
    mixed = delta_blendshape(head.neutral, head.shapes, head.weights(MIXES[mix]))
    assert np.linalg.norm(mixed - head.neutral, axis=1).max() > 0.3


def test_each_call_gives_its_own_arrays(head):
    other = face()
    for array in (other.neutral, other.shapes, other.faces, other.colors):
        array[:] = 0
    assert head.neutral.any()
    assert face().shapes.any()


def test_the_face_is_a_small_file():
    assert FILE.stat().st_size < 165_000


def test_the_sources_are_told(script):
    text = FILE.with_name("SOURCES.md").read_text("utf-8")
    assert script["DIGEST"] in text
    for name, units in script["EXPRESSIONS"].items():
        told = ", ".join(f"{unit} {amount:g}" for unit, amount in units.items())
        assert f"\n| `{name}` | {told} |\n" in text
    licence = FILE.with_name("LICENSE.md").read_text("utf-8")
    assert licence.startswith("# Creative Commons CC0 1.0 Universal")
