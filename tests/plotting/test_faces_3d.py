"""Faces as pyvista renders them. Run where it does: nox -s tests_3d."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import pyvista  # noqa: F401  (to fail here and clearly where it is missing)
import trimesh

from canim.plotting import draw_face, faces

BALL = trimesh.creation.icosphere(subdivisions=2)
COLORS = (BALL.vertices + 1) / 2


class Ball:
    neutral, faces, colors = BALL.vertices, BALL.faces, COLORS


@pytest.fixture
def ax():
    fig = plt.figure(figsize=(2, 2), dpi=100, facecolor="white", layout="none")
    yield fig.add_axes((0, 0, 1, 1), facecolor="white")
    plt.close(fig)


def picture(ax):
    ax.figure.canvas.draw()
    return np.asarray(ax.figure.canvas.buffer_rgba())[..., :3] / 255


def area(ax):
    return (picture(ax) < 0.99).any(axis=2).sum()


def test_pyvista_renders_here():
    assert faces.pyvista_renders()


@pytest.mark.parametrize("turn", [0, 1])
def test_both_ways_of_drawing_look_alike(ax, monkeypatch, turn):
    draw_face(ax, Ball, turn=turn)
    rendered = picture(ax)
    ax.clear()
    monkeypatch.setattr(faces, "pyvista_renders", lambda: False)
    draw_face(ax, Ball, turn=turn)
    assert np.abs(rendered - picture(ax)).mean() < 0.02
    assert np.abs(rendered - picture(ax)).max() > 0


def test_the_picture_follows_the_limits_and_the_size_of_its_axes(ax):
    draw_face(ax, Ball)
    whole = area(ax)
    ax.set(xlim=(-3, 3), ylim=(-3, 3))
    assert area(ax) < 0.3 * whole
    ax.set(xlim=(0, 3), ylim=(0, 3))
    shown = picture(ax)
    assert (shown[-10, 10] < 0.99).any()
    assert (shown[10, 10] == 1).all()
    assert (shown[-10, -10] == 1).all()
    ax.figure.set_size_inches(1, 1)
    assert picture(ax).shape == (100, 100, 3)


def test_other_vertices_are_drawn_larger(ax):
    draw_face(ax, Ball, room=2)
    whole = area(ax)
    ax.clear()
    draw_face(ax, Ball, 2 * BALL.vertices, room=2)
    assert area(ax) == pytest.approx(4 * whole, rel=0.03)


def test_a_face_of_size_zero_is_not_seen(ax):
    draw_face(ax, Ball, 0 * BALL.vertices)
    assert area(ax) == 0


def test_what_is_drawn_twice_is_rendered_once(ax, monkeypatch):
    draw_face(ax, Ball)
    first = picture(ax)
    monkeypatch.setattr("canim.plotting.faces_3d._picture", None)
    assert (picture(ax) == first).all()
