"""Names beside curves."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.transforms import Bbox

from canim.plotting import label_curves

X = np.linspace(0, 1, 101)
NOTHING = np.full(101, np.nan)


@pytest.fixture
def ax():
    fig, ax = plt.subplots()
    ax.set(xlim=(0, 1), ylim=(0, 1))
    yield ax
    plt.close(fig)


def _names(ax):
    return [text.get_text() for text in ax.texts]


def _distance(ax, box, x, y):
    """Pixels from a box to the nearest of many points of a curve."""
    curve = ax.transData.transform(np.column_stack([x, y]))
    apart = np.maximum(np.maximum(box.min - curve, curve - box.max), 0)
    return np.hypot(*apart.T).min()


def test_only_curves_with_a_label_are_named(ax):
    ax.plot(X, X, label="up")
    ax.plot(X, 1 - X)
    label_curves(ax)
    assert _names(ax) == ["up"]


def test_a_name_has_the_colour_of_its_curve_and_is_nearer_to_it_than_to_any_other(ax):
    curves = {"low": X**6, "middle": X, "high": 1 - (1 - X) ** 6}
    lines = {name: ax.plot(X, y, label=name)[0] for name, y in curves.items()}
    label_curves(ax)
    for text in ax.texts:
        name, box = text.get_text(), text.get_window_extent()
        distances = {other: _distance(ax, box, X, y) for other, y in curves.items()}
        own = distances.pop(name)
        assert 0 < own < min(distances.values()) / 2
        assert text.get_color() == lines[name].get_color()


def test_names_stay_inside_and_apart_from_each_other_and_from_older_texts(ax):
    ax.text(0.5, 0.5, "an older text in the middle", ha="center")
    for k in range(4):
        ax.plot(X, X ** (k + 1), label=f"curve {k}")
    label_curves(ax)
    boxes = [text.get_window_extent() for text in ax.texts]
    inside = ax.get_window_extent()
    assert all(inside.fully_containsx(b.x0) and inside.fully_containsx(b.x1) for b in boxes)
    assert all(inside.fully_containsy(b.y0) and inside.fully_containsy(b.y1) for b in boxes)
    pairs = [(a, b) for i, a in enumerate(boxes) for b in boxes[:i]]
    assert not any(a.overlaps(b) for a, b in pairs)


def test_no_name_on_a_long_straight_line(ax):
    ax.plot([0, 1], [0.5, 0.5], color="gray")
    ax.plot(X, 0.5 + 0.2 * np.sin(2 * np.pi * X), label="wave")
    label_curves(ax)
    box = ax.texts[0].get_window_extent()
    assert _distance(ax, box, X, np.full(101, 0.5)) > 10


def test_markers_without_a_line_leave_the_space_between_them_free(ax):
    ax.plot([0, 0.5, 1], [0.06, 0.94, 0.06], "o")
    ax.plot(X, 0.5 + 0 * X, label="level")
    label_curves(ax)
    box = ax.texts[0].get_window_extent()
    assert _distance(ax, box, [0, 0.5, 1], [0.06, 0.94, 0.06]) > 60
    centre = ax.transData.inverted().transform((box.min + box.max) / 2)
    assert abs(centre[0] - 0.5) < 0.3


def test_names_keep_clear_of_every_single_point(ax):
    ax.set(xlim=(-3.5, 3.5), ylim=(0, 16))
    x, y = np.array([-3, -1, 1, 3]), np.array([15, 5, 8, 9])
    for i in range(3):
        ax.plot(np.linspace(x[i], x[i + 1], 51), np.full(51, y[i]), label=f"f{i}")
    ax.plot(x, y, "o")
    label_curves(ax)
    assert all(_distance(ax, text.get_window_extent(), x, y) > 10 for text in ax.texts)


def test_a_line_across_the_axes_is_where_it_is_seen(ax):
    ax.set(xlim=(100, 200), ylim=(100, 200))
    ax.plot(100 + 100 * X, 150 + 10 * X, label="curve")
    ax.axhline(160)
    label_curves(ax)
    box = ax.texts[0].get_window_extent()
    assert _distance(ax, box, 100 + 100 * X, np.full(101, 160.0)) > 10


def test_curves_that_are_all_nan_are_said_to_be_missing_one_below_the_other(ax):
    ax.plot(X, X, label="up")
    ax.plot(X, NOTHING, label="A")
    ax.plot(X, NOTHING, label="B")
    ax.plot(X, NOTHING)
    label_curves(ax)
    assert _names(ax) == ["up", "A is missing", "B is missing"]
    a, b = (text.get_window_extent() for text in ax.texts[1:])
    assert a.y0 > b.y1
    assert a.x1 == pytest.approx(b.x1)


@pytest.mark.parametrize(
    ("busy", "right", "top"),
    [
        ([], True, True),
        ([(0.9, 0.9)], False, True),
        ([(0.9, 0.9), (0.1, 0.9)], True, False),
        ([(0.9, 0.9), (0.1, 0.9), (0.9, 0.1)], False, False),
    ],
)
def test_what_is_missing_is_said_in_a_free_corner(ax, busy, right, top):
    for x, y in busy:
        ax.plot([x], [y], "o")
    for name in "AB":
        ax.plot(X, NOTHING, label=name)
    label_curves(ax)
    inside = ax.get_window_extent()
    for text in ax.texts:
        box = text.get_window_extent()
        assert (box.x0 > (inside.x0 + inside.x1) / 2) == right
        assert (box.y0 > (inside.y0 + inside.y1) / 2) == top
        assert np.all(box.min >= inside.min)
        assert np.all(box.max <= inside.max)


def test_of_a_curve_that_is_nan_in_part_the_rest_is_named(ax):
    ax.plot(X, np.where(X < 0.7, np.nan, 0.5), label="late")
    label_curves(ax)
    box = ax.texts[0].get_window_extent()
    assert _distance(ax, box, X[X >= 0.7], np.full((X >= 0.7).sum(), 0.5)) < 6


def test_a_single_point_is_named(ax):
    ax.plot([0.5], [0.5], "o", label="goal")
    label_curves(ax)
    assert _distance(ax, ax.texts[0].get_window_extent(), [0.5], [0.5]) < 15


def test_a_curve_outside_of_the_limits_still_gets_its_name(ax):
    ax.plot(X, X + 5, label="far up")
    label_curves(ax)
    assert _names(ax) == ["far up"]


def test_axes_in_a_subfigure(ax):
    parent = plt.figure()
    inner = parent.subfigures(1, 2)[0].subplots()
    inner.plot(X, X, label="up")
    label_curves(inner)
    assert _names(inner) == ["up"]
    assert isinstance(inner.texts[0].get_window_extent(), Bbox)
    plt.close(parent)
