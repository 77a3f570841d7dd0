"""Pictures of faces: what is seen where, how bright, and what happens without pyvista."""

import importlib.util
import os
import subprocess
import sys
from types import ModuleType, SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
import trimesh
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg

from canim.plotting import animate_face, draw_face, faces, weight_sliders

BALL = trimesh.creation.icosphere(subdivisions=2)
RED, GREEN = (1, 0, 0), (0, 1, 0)


def mesh(neutral=BALL.vertices, triangles=BALL.faces, colors=None):
    return SimpleNamespace(neutral=np.asarray(neutral, float), faces=triangles, colors=colors)


@pytest.fixture(autouse=True)
def _without_pyvista(monkeypatch):
    monkeypatch.setattr(faces, "pyvista_renders", lambda: False)


@pytest.fixture
def ax():
    fig = plt.figure(figsize=(2, 2), dpi=100, facecolor="white", layout="none")
    yield fig.add_axes((0, 0, 1, 1))
    plt.close(fig)


def picture(ax):
    """Return what is drawn in the axes, as (200, 200, 3) numbers from 0 to 1."""
    ax.figure.canvas.draw()
    return np.asarray(ax.figure.canvas.buffer_rgba())[..., :3] / 255


def area(ax):
    return (picture(ax) < 1).any(axis=2).sum()


def test_the_picture_does_not_follow_the_vertices_so_that_scaling_is_seen(ax):
    draw_face(ax, mesh(), BALL.vertices)
    limits, whole = ax.axis(), area(ax)
    ax.clear()
    draw_face(ax, mesh(), BALL.vertices / 2)
    assert ax.axis() == limits
    assert area(ax) == pytest.approx(whole / 4, rel=0.03)
    ax.clear()
    draw_face(ax, mesh(), room=2)
    assert area(ax) == pytest.approx(whole / 4, rel=0.03)


def test_a_picture_that_is_too_small_cuts_the_neck_and_not_the_crown(ax):
    draw_face(ax, mesh())
    *_, bottom, top = ax.axis()
    ax.clear()
    draw_face(ax, mesh(), room=0.9)
    assert ax.axis()[3] == pytest.approx(top)
    assert ax.axis()[2] == pytest.approx(top - 0.9 * (top - bottom))


def test_without_vertices_the_neutral_face_is_drawn(ax):
    draw_face(ax, mesh())
    neutral = picture(ax)
    ax.clear()
    draw_face(ax, mesh(), BALL.vertices.tolist())
    assert np.array_equal(picture(ax), neutral)


def test_what_is_near_hides_what_is_far(ax):
    front = np.array([(-1, -1, 0.5), (1, -1, 0.5), (0, 1, 0.5)])
    vertices = np.concatenate([front, front - [0, 0, 1]])
    for order in ([(0, 1, 2), (3, 4, 5)], [(3, 4, 5), (0, 1, 2)]):
        ax.clear()
        draw_face(ax, mesh(vertices, order, [RED] * 3 + [GREEN] * 3), turn=0)
        red, green, _ = picture(ax)[110, 100]
        assert red > 2 * green


def test_the_back_of_a_triangle_is_not_seen(ax):
    corners = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    draw_face(ax, mesh(corners, [(2, 1, 0)]), turn=0)
    assert area(ax) == 0
    ax.clear()
    draw_face(ax, mesh(corners, [(0, 1, 2)]), turn=0)
    assert area(ax) > 5000


def test_the_light_comes_from_the_front_and_the_side(ax):
    draw_face(ax, mesh())
    brightness = picture(ax).sum(axis=2)
    middle, left, right = brightness[100, 100], brightness[100, 40], brightness[80, 125]
    assert right > middle > left > 0


def test_the_head_turns_to_its_own_left(ax):
    nose = np.array([(-0.1, -0.1, 1), (0.1, -0.1, 1), (0, 0.1, 1)])
    vertices = np.concatenate([BALL.vertices, nose])
    triangles = np.concatenate([BALL.faces, [np.arange(3) + len(BALL.vertices)]])
    colors = np.array([GREEN] * len(BALL.vertices) + [RED] * 3)
    draw_face(ax, mesh(vertices, triangles, colors), turn=0.5)
    shown = picture(ax)
    assert np.nonzero(shown[..., 0] > 0.8 * shown[..., 1] + 0.2)[1].mean() > 110


def test_the_surface_is_rounder_than_the_mesh():
    points, normals, _ = faces._Surface(mesh()).fine(np.asarray(BALL.vertices))
    start, end = faces._Surface(mesh())._ends
    flat = (BALL.vertices[start] + BALL.vertices[end]) / 2
    away = np.abs(np.linalg.norm(points, axis=1) - 1).max()
    assert away < 0.2 * np.abs(np.linalg.norm(flat, axis=1) - 1).max()
    assert np.einsum("ij,ij->i", points, normals).min() > 0.99


@pytest.mark.parametrize(("height", "darker"), [(-0.6, True), (0, False), (0.6, False)])
def test_a_hollow_is_darker(height, darker):
    corners = [(1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 0), (0, 0, height)]
    cone = mesh(corners, [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)], np.ones((5, 3)))
    colors = faces._Surface(cone).fine(cone.neutral)[2]
    assert (colors[4].max() < 0.8) == darker
    assert (colors[4].min() == 1) != darker


@pytest.mark.parametrize("vertices", [np.full(BALL.vertices.shape, np.nan), [[0, 0, 0]], 1.0])
def test_what_is_not_written_yet_is_said_to_be_missing(ax, vertices):
    draw_face(ax, mesh(), vertices)
    assert [text.get_text() for text in ax.texts] == ["the face is missing"]


def test_a_face_of_size_zero_is_not_seen(ax):
    draw_face(ax, mesh(), 0 * BALL.vertices)
    assert area(ax) == 0


def test_colours_may_be_missing(ax):
    draw_face(ax, mesh(colors=None))
    red, green, blue = picture(ax)[100, 100]
    assert red > green > blue


def play(film):
    film._fig.canvas.draw()  # a film that was never drawn warns when it is deleted
    frames = list(film.new_frame_seq())
    for frame in frames:
        film._draw_frame(frame)
    return frames


def test_a_film_shows_its_poses_in_a_picture_that_stays(ax):
    film = animate_face(ax, mesh(), [BALL.vertices, BALL.vertices / 2], hold=2)
    assert play(film) == [0, 1, 1, 1]
    small = area(ax)
    film._draw_frame(0)
    assert area(ax) == pytest.approx(4 * small, rel=0.03)


def test_films_run_beside_each_other_with_a_clock():
    fig, axes = plt.subplots(1, 3)
    poses = np.stack([BALL.vertices, np.full(BALL.vertices.shape, np.nan)])
    film = animate_face(
        axes[:2], mesh(), [poses, poses[::-1]], clock=axes[2], times=np.array([3, 4]), hold=0
    )
    play(film)
    for frame, missing in enumerate([(0, 1), (1, 0)]):
        film._draw_frame(frame)
        assert tuple(len(one.texts) for one in axes[:2]) == missing
        assert axes[2].lines[0].get_xdata() == [3 + frame] * 2
    plt.close(fig)


@pytest.mark.parametrize(
    ("poses", "options", "error", "message"),
    [
        ([], {}, ValueError, "poses, times must not be empty"),
        ([BALL.vertices], {"clock": "here"}, TypeError, "times must be given"),
        (
            [BALL.vertices],
            {"clock": "here", "times": [1, 2]},
            ValueError,
            r"entries, but poses\[0\] has 1 and times 2",
        ),
    ],
)
def test_a_film_of_nothing_or_of_unequal_parts_is_refused(ax, poses, options, error, message):
    with pytest.raises(error, match=message):
        animate_face(ax, mesh(), poses, **options)
    with pytest.raises(ValueError, match="ax has 1 and poses 2"):
        animate_face([ax], mesh(), [[BALL.vertices], [BALL.vertices]])


def test_without_a_window_there_are_no_sliders():
    assert weight_sliders(mesh(), ["size"], lambda weights: BALL.vertices, [1]) == []
    assert not plt.get_fignums()


def test_sliders_change_the_face(monkeypatch):
    monkeypatch.setattr(FigureCanvasAgg, "required_interactive_framework", "a window")
    asked = []

    def blend(weights):
        asked.append(weights.tolist())
        return weights.sum() * BALL.vertices

    sliders = weight_sliders(mesh(), ["smile_left", "o"], blend, [1, 0.5])
    assert [slider.label.get_text() for slider in sliders] == ["smile left", "o"]
    sliders[1].set_val(2)
    assert asked == [[1, 0.5], [1, 2]]
    figure = sliders[0].ax.figure
    assert len(figure.axes[0].collections) == 1
    figure.canvas.draw()
    plt.close(figure)


def test_pyvista_draws_where_it_renders(ax, monkeypatch):
    class Rendered(Artist):
        def __init__(self, points, normals, colors, triangles):
            super().__init__()
            assert len(points) == len(normals) == len(colors) == triangles.max() + 1

    module = ModuleType("faces_3d")
    module.Rendered = Rendered
    monkeypatch.setitem(sys.modules, "canim.plotting.faces_3d", module)
    monkeypatch.setattr(faces, "pyvista_renders", lambda: True)
    draw_face(ax, mesh())
    assert [type(artist) for artist in ax.artists] == [Rendered]


@pytest.fixture
def asked(monkeypatch):
    """The commands that were asked whether pyvista renders; it is installed, and does not."""
    commands = []

    def run(command, **options):
        commands.append(command)
        return SimpleNamespace(returncode=-11)

    monkeypatch.setattr(faces, "pyvista_renders", _ASK)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: name)
    monkeypatch.setattr(subprocess, "run", run)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setenv("VTK_DEFAULT_OPENGL_WINDOW", "")
    monkeypatch.delenv("VTK_DEFAULT_OPENGL_WINDOW")
    _ASK.cache_clear()
    yield commands
    _ASK.cache_clear()


_ASK = faces.pyvista_renders


def test_where_pyvista_is_missing_nothing_is_asked(asked, monkeypatch, caplog):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    assert not faces.pyvista_renders()
    assert asked == []
    assert not caplog.records


def test_where_pyvista_cannot_render_that_is_asked_and_said_once(asked, ax, caplog):
    draw_face(ax, mesh())
    draw_face(ax, mesh())
    assert len(asked) == 1
    assert area(ax) > 5000
    (record,) = caplog.records
    assert "drawn with matplotlib" in record.message


@pytest.mark.parametrize(
    ("platform", "display", "before", "window"),
    [
        ("linux", "", None, "vtkEGLRenderWindow"),
        ("linux", "", "vtkOSOpenGLRenderWindow", "vtkOSOpenGLRenderWindow"),
        ("linux", ":0", None, None),
        ("darwin", "", None, None),
    ],
)
def test_linux_without_a_screen_renders_with_egl(
    asked, monkeypatch, platform, display, before, window
):
    monkeypatch.setattr(subprocess, "run", lambda *args, **options: SimpleNamespace(returncode=0))
    monkeypatch.setattr(sys, "platform", platform)
    monkeypatch.setenv("DISPLAY", display)
    if before:
        monkeypatch.setenv("VTK_DEFAULT_OPENGL_WINDOW", before)
    assert faces.pyvista_renders()
    assert os.environ.get("VTK_DEFAULT_OPENGL_WINDOW") == window
