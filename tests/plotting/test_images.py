"""Key points and triangles on images, clicking, and the bar of a loop."""

import json
import sys
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.backend_bases import CloseEvent, KeyEvent, MouseEvent
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from canim.plotting import draw_points, draw_triangulation, images, pick_points, progress

IMAGE = np.zeros((20, 30), dtype=np.uint8)
A, B = np.array([[1.0, 2.0], [5.0, 6.0]]), np.array([[3.0, 4.0], [7.0, 8.0]])


@pytest.fixture
def ax():
    fig, ax = plt.subplots()
    yield ax
    plt.close(fig)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Let the running program be tmp_path/own.py."""
    program = SimpleNamespace(__file__=str(tmp_path / "own.py"))
    monkeypatch.setitem(sys.modules, "__main__", program)
    return tmp_path


def test_key_points_are_red_dots_with_their_numbers(ax):
    draw_points(ax, [(10, 20), (np.nan, np.nan), (30, 5)], numbers=True)
    (dots,) = ax.lines
    assert dots.get_color() == "red"
    assert np.array_equal(dots.get_xydata()[[0, 2]], [(10, 20), (30, 5)])
    assert [(text.get_text(), text.xy) for text in ax.texts] == [("0", (10, 20)), ("2", (30, 5))]


def test_no_points_are_no_dots(ax):
    draw_points(ax, [])
    assert len(ax.lines[0].get_xydata()) == 0


def test_triangles_are_closed_lines_over_the_image(ax):
    draw_triangulation(ax, IMAGE, [(0, 0), (29, 0), (0, 19), (29, 19)], [(0, 1, 2), (1, 3, 2)])
    (mesh,) = ax.collections
    first, second = mesh.get_segments()
    assert np.array_equal(first, [(0, 0), (29, 0), (0, 19), (0, 0)])
    assert np.array_equal(second, [(29, 0), (29, 19), (0, 19), (29, 0)])
    assert mesh.get_zorder() > ax.images[0].get_zorder()
    assert len(ax.lines[0].get_xydata()) == 4
    assert not ax.axison


def test_triangles_at_points_that_are_nan_are_left_out(ax):
    points = [(0, 0), (29, 0), (0, 19), (np.nan, np.nan)]
    draw_triangulation(ax, IMAGE, points, [(0, 1, 2), (1, 3, 2)])
    assert len(ax.collections[0].get_segments()) == 1


def test_without_clicking_the_given_points_are_used(folder, capsys):
    a, b = pick_points(IMAGE, IMAGE, A.tolist(), B.tolist())
    assert np.array_equal(a, A)
    assert np.array_equal(b, B)
    assert capsys.readouterr().out == ""
    assert not list(folder.iterdir())


def test_without_a_window_the_given_points_are_used_and_it_is_said(folder, capsys):
    a, b = pick_points(IMAGE, IMAGE, A, B, click=True)
    assert np.array_equal(a, A)
    assert np.array_equal(b, B)
    assert "no window" in capsys.readouterr().out
    assert not plt.get_fignums()


@pytest.fixture
def person(monkeypatch):
    """Return a function that sets what a person does when the window is open."""
    monkeypatch.setattr(FigureCanvasAgg, "required_interactive_framework", "test")
    monkeypatch.setattr(Figure, "show", lambda self: None)

    def does(*actions):
        def act(canvas, timeout):
            canvas.draw()
            for action in actions:
                if isinstance(action, str):
                    KeyEvent("key_press_event", canvas, action)._process()
                elif action is None:
                    CloseEvent("close_event", canvas)._process()
                else:
                    side, point, button = action
                    ax = canvas.figure.axes[side]
                    x, y = ax.transData.transform(point)
                    MouseEvent("button_press_event", canvas, x, y, button)._process()

        monkeypatch.setattr(FigureCanvasAgg, "start_event_loop", act)

    return does


def left(x, y, button=1):
    return 0, (x, y), button


def right(x, y, button=1):
    return 1, (x, y), button


@pytest.mark.parametrize("style", ["default", "canim.style"])
def test_clicked_points_are_returned_and_saved_for_the_next_time(folder, person, capsys, style):
    person(left(4, 5), right(6, 7), left(10, 11), right(12, 13), "enter")
    with plt.style.context(style):
        a, b = pick_points(IMAGE, IMAGE, A, B, click=True)
    assert a == pytest.approx(np.array([[4, 5], [10, 11]]))
    assert b == pytest.approx(np.array([[6, 7], [12, 13]]))
    assert "2 key points are saved in own_points.json" in capsys.readouterr().out
    assert not plt.get_fignums()

    again = pick_points(IMAGE, IMAGE, A, B)
    assert np.array_equal(again, [a, b])
    assert "Delete this file" in capsys.readouterr().out


def test_the_images_take_turns_and_other_buttons_and_keys_do_nothing(folder, person):
    person(right(6, 7), left(4, 5), left(1, 1), right(9, 9, button=3), "x", right(6, 7), "enter")
    a, b = pick_points(IMAGE, IMAGE, A, B, click=True)
    assert a == pytest.approx(np.array([[4, 5]]))
    assert b == pytest.approx(np.array([[6, 7]]))


def test_backspace_takes_the_last_click_back(folder, person):
    person("backspace", left(4, 5), "backspace", left(8, 9), right(6, 7), left(1, 1), None)
    a, b = pick_points(IMAGE, IMAGE, A, B, click=True)
    assert a == pytest.approx(np.array([[8, 9]]))
    assert b == pytest.approx(np.array([[6, 7]]))


def test_a_click_on_the_rim_is_within_the_image(folder, person):
    person(left(-0.4, 19.4), right(29.4, -0.4), "enter")
    a, b = pick_points(IMAGE, IMAGE, A, B, click=True)
    assert np.array_equal(a, [[0, 19]])
    assert np.array_equal(b, [[29, 0]])


def test_a_window_closed_at_once_leaves_the_given_points(folder, person, capsys):
    person(left(4, 5), None)
    assert np.array_equal(pick_points(IMAGE, IMAGE, A, B, click=True), [A, B])
    assert "No pair" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("{", "cannot be read"),
        ("[]", "cannot be read"),
        ('{"sizes": [[20, 30], [20, 30]]}', "cannot be read"),
        ('{"sizes": [[9, 9], [20, 30]], "points_a": [[1, 2]], "points_b": [[1, 2]]}', "size"),
    ],
)
def test_a_file_that_does_not_fit_is_told_and_not_used(folder, capsys, content, words):
    (folder / "own_points.json").write_text(content, encoding="utf-8")
    assert np.array_equal(pick_points(IMAGE, IMAGE, A, B), [A, B])
    assert words in capsys.readouterr().out


def test_in_a_notebook_the_file_is_in_its_folder(tmp_path, monkeypatch, person):
    monkeypatch.setitem(sys.modules, "__main__", SimpleNamespace())
    monkeypatch.chdir(tmp_path)
    person(left(4, 5), right(6, 7), "enter")
    pick_points(IMAGE, IMAGE, A, B, click=True)
    saved = json.loads((tmp_path / "key_points.json").read_text(encoding="utf-8"))
    assert saved["sizes"] == [[20, 30], [20, 30]]


@pytest.fixture
def slow(monkeypatch):
    """Let every look at the clock be a second later."""
    ticks = iter(range(1000))
    monkeypatch.setattr(images, "time", SimpleNamespace(monotonic=lambda: next(ticks)))


def test_a_loop_in_a_terminal_shows_how_far_it_has_come(slow, monkeypatch, capsys):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    assert list(progress("abc")) == ["a", "b", "c"]
    bars = capsys.readouterr().out.split("\r")
    assert bars[1] == "[..............................] 0 of 3"
    assert bars[2] == "[##########....................] 1 of 3"
    assert bars[-1] == "[##############################] 3 of 3\n"


def test_a_quick_loop_shows_nothing(monkeypatch, capsys):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    assert list(progress([])) == []
    assert list(progress([1, 2])) == [1, 2]
    assert capsys.readouterr().out == ""


def test_outside_of_a_terminal_nothing_is_shown(slow, monkeypatch, capsys):
    assert list(progress("abc")) == ["a", "b", "c"]
    monkeypatch.setattr(sys, "stdout", None)
    assert list(progress("abc")) == ["a", "b", "c"]
    monkeypatch.undo()
    assert capsys.readouterr().out == ""


def test_images_of_two_sizes_are_refused_before_anything_is_done_with_them():
    told = (
        r"^image_a is 3000 × 4000 pixels and image_b 800 × 600; they must have one size\. "
        r'Read both with canim\.data\.read_image\("\.\.\.", size=\(480, 640\)\)\.$'
    )
    with pytest.raises(ValueError, match=told):
        pick_points(np.zeros((4000, 3000)), np.zeros((600, 800, 3)), A, B)
    with pytest.raises(ValueError, match=r"size=\(9, 8\)"):
        pick_points(np.zeros((8, 9)), np.zeros((9, 8)), A, B, click=True)


def test_images_that_are_very_large_are_told(capsys):
    small, large = np.zeros((640, 640)), np.zeros((641, 640))
    pick_points(small, small, A, B)
    assert capsys.readouterr().out == ""
    pick_points(large, large, A, B)
    assert capsys.readouterr().out == (
        "The images have 640 × 641 pixels, so this program takes minutes or hours. "
        'It is quick if you read both with canim.data.read_image("...", size=(639, 640)).\n'
    )
