"""Chains: what is drawn, and where."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from canim.plotting import draw_chain

FLAT = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
SPACE = np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 2.0], [1.0, 1.0, 1.0]])


@pytest.fixture
def ax():
    fig, ax = plt.subplots()
    yield ax
    plt.close(fig)


@pytest.fixture
def space():
    fig, ax = plt.subplots(subplot_kw={"projection": "3d"})
    yield ax
    plt.close(fig)


def test_a_chain_has_links_a_red_root_and_an_end_effector(ax):
    draw_chain(ax, FLAT.tolist())
    links, root, end = ax.lines
    assert np.array_equal(links.get_xydata(), FLAT)
    assert np.array_equal(root.get_xydata(), FLAT[:1])
    assert root.get_color() == to_rgb("red")
    assert np.array_equal(end.get_xydata(), FLAT[2:])
    assert len({line.get_color() for line in ax.lines}) == 3


def test_a_chain_in_space_is_drawn_in_space(space):
    draw_chain(space, SPACE)
    links, root, end = space.lines
    assert np.array_equal(np.transpose(links.get_data_3d()), SPACE)
    assert np.array_equal(np.ravel(root.get_data_3d()), SPACE[0])
    assert np.array_equal(np.ravel(end.get_data_3d()), SPACE[2])


def test_what_is_missing_is_left_out(ax):
    draw_chain(ax, [(0, 0), (0, 1), (np.nan, np.nan)])
    ax.figure.canvas.draw()


def test_little_ink_is_pale_and_still_hides_what_is_behind(ax):
    draw_chain(ax, FLAT, ink=0.25)
    assert ax.lines[1].get_color() == pytest.approx((1, 0.75, 0.75))
    assert all(line.get_alpha() is None for line in ax.lines)
