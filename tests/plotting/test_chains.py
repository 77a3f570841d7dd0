"""Chains: what is drawn, and where."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.backend_bases import MouseEvent
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb

from canim.plotting import animate_chain, animate_chains, draw_chain, slow_poses

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
    space.set_zlim(-1, 3)
    draw_chain(space, SPACE)
    shadow, links, root, end = space.lines
    assert np.array_equal(np.transpose(shadow.get_data_3d()), SPACE * [1, 1, 0] - [0, 0, 1])
    assert np.array_equal(np.transpose(links.get_data_3d()), SPACE)
    assert np.array_equal(np.ravel(root.get_data_3d()), SPACE[0])
    assert np.array_equal(np.ravel(end.get_data_3d()), SPACE[2])


def test_what_is_missing_is_left_out(ax):
    draw_chain(ax, [(0, 0), (0, 1), (np.nan, np.nan)])
    ax.figure.canvas.draw()


def test_little_ink_is_pale_and_still_hides_what_is_behind(ax):
    ax.set_facecolor("white")
    draw_chain(ax, FLAT, ink=0.25)
    assert ax.lines[1].get_color() == pytest.approx((1, 0.75, 0.75))
    assert all(line.get_alpha() is None for line in ax.lines)


def test_poses_in_between_are_not_farther_apart_than_asked_and_keep_the_given_ones():
    poses = np.array([[0.0, 0.0], [0.25, -0.1], [0.25, -0.1], [0.3, 1.0]])
    slow = slow_poses(poses, 0.1)
    assert np.abs(np.diff(slow, axis=0)).max() <= 0.1 + 1e-12
    assert np.array_equal(slow[[0, 3, 4, 15]], poses)
    assert len(slow) == 16


def test_poses_of_three_angles_a_joint_can_be_slowed_down():
    assert slow_poses(np.arange(12.0).reshape(2, 2, 3), 2).shape == (4, 2, 3)


def positions(angles, offsets):
    """Return a chain whose joints are simply where its angles say."""
    return np.vstack([np.zeros(np.shape(offsets)[1]), np.asarray(angles)])


def half_way(angles, offsets, goal):
    """Return three poses: as it is, half way, there; every joint goes to the goal."""
    return [angles, (angles + goal) / 2, np.tile(goal, (len(offsets), 1))]


START = np.array([[0.0, 1.0], [1.0, 1.0]])
GOALS = np.array([[2.0, 0.0], [0.0, 3.0]])


def play(film):
    """Return what was seen: goal and end effector of each axes, frame by frame."""
    seen = []
    for frame in film.new_frame_seq():
        film._draw_frame(frame)
        seen.append([shown(ax) for ax in film._fig.axes])
    return np.array(seen)


def shown(ax):
    goal, _, _, end = ax.lines[-4:]
    if hasattr(goal, "get_data_3d"):
        return [np.ravel(goal.get_data_3d()), np.ravel(end.get_data_3d())]
    return [goal.get_xydata()[0], end.get_xydata()[0]]


def test_a_film_shows_every_step_to_every_goal_and_rests_there(ax):
    film = animate_chain(ax, half_way, positions, START, START, GOALS.tolist())
    seen = play(film)[:, 0]
    first = [(1, 1), (1.5, 0.5), (2, 0), *[(2, 0)] * 8]
    second = [(2, 0), (1, 1.5), (0, 3), *[(0, 3)] * 8]
    assert np.array_equal(seen[:, 1], first + second)
    assert np.array_equal(seen[:, 0], [GOALS[0]] * 11 + [GOALS[1]] * 11)


def test_a_chain_that_does_not_move_rests_shortly_at_every_goal(ax):
    film = animate_chain(ax, lambda angles, *_: [angles] * 200, positions, START, START, GOALS)
    assert len(play(film)) == 2 * (1 + 8)


def test_poses_that_are_not_finite_are_left_out(ax):
    film = animate_chain(
        ax, lambda angles, *_: [angles, angles * np.nan], positions, START, START, GOALS
    )
    assert np.array_equal(play(film)[:, 0, 1], [START[1]] * 18)


def test_a_solver_that_changes_what_it_is_given_does_no_harm(ax):
    def careless(angles, offsets, goal):
        angles += 1
        goal += 9
        return [angles]

    goals = GOALS.copy()
    animate_chain(ax, careless, positions, START, START, goals)
    assert np.array_equal(goals, GOALS)
    assert START[0, 0] == 0


def test_without_a_window_the_moment_is_seen_when_the_first_goal_is_reached(ax):
    animate_chain(ax, half_way, positions, START, START, GOALS)
    assert np.array_equal(shown(ax), [(2, 0), (2, 0)])


def test_a_film_in_space(space):
    start, goal = np.zeros((2, 3)), np.array([[1.0, 2.0, 3.0]])
    space.set_zlim(-1, 3)
    film = animate_chain(space, half_way, positions, start, start, goal)
    assert set(space.lines[0].get_data_3d()[2]) == {-1}
    assert np.array_equal(np.ravel(space.lines[1].get_data_3d()), [1, 2, -1])
    assert np.array_equal(play(film)[1, 0], [(1, 2, 3), (0.5, 1, 1.5)])


def test_of_several_chains_the_first_waits_for_the_last():
    fig, axes = plt.subplots(1, 2)
    quick = [[FLAT, FLAT + 1], [FLAT]]
    slow = [[FLAT, FLAT, FLAT + 1], [FLAT, FLAT + 3]]
    seen = play(animate_chains(axes, [quick, slow], GOALS))
    assert len(seen) == 3 + 8 + 2 + 8
    assert np.array_equal(seen[1, :, 1], [(2, 2), (1, 1)])
    assert np.array_equal(seen[2, :, 1], [(2, 2), (2, 2)])
    assert np.array_equal(seen[-1, :, 1], [(1, 1), (4, 4)])
    plt.close(fig)


@pytest.fixture
def window(monkeypatch):
    monkeypatch.setattr(FigureCanvasAgg, "required_interactive_framework", "test")


def move(ax, x, y, kind="motion_notify_event"):
    """Let the mouse be at a point of the axes."""
    ax.figure.canvas.draw()
    place = ax.transData.transform((x, y))
    MouseEvent(kind, ax.figure.canvas, *place)._process()


def test_in_a_window_the_film_begins_with_its_first_frame(ax, window):
    animate_chain(ax, half_way, positions, START, START, GOALS)
    assert np.array_equal(shown(ax), [(2, 0), (1, 1)])


def test_the_chain_follows_the_mouse(ax, window):
    ax.set(xlim=(-4, 4), ylim=(-4, 4))
    film = animate_chain(ax, half_way, positions, START, START, GOALS, click=True)
    assert np.array_equal(shown(ax)[1], (1, 1))
    for expected in [(1.5, 0.5), (2, 0), (2, 0)]:
        film._draw_frame(0)
        assert np.array_equal(shown(ax), [(2, 0), expected])
    move(ax, -2, 2)  # the first drawing is the first frame
    film._draw_frame(0)
    assert np.array(shown(ax)) == pytest.approx(np.array([(-2, 2), (0, 1)]))
    move(ax, 4, -1, "button_press_event")  # before the chain is there
    film._draw_frame(0)
    film._draw_frame(0)
    assert np.array(shown(ax)) == pytest.approx(np.array([(4, -1), (4, -1)]))
    move(ax, -9, -9)
    film._draw_frame(0)
    assert np.array(shown(ax)) == pytest.approx(np.array([(4, -1), (4, -1)]))


def test_without_a_window_the_given_goals_are_reached_and_it_is_said(ax, capsys):
    film = animate_chain(ax, half_way, positions, START, START, GOALS, click=True)
    assert "no window" in capsys.readouterr().out
    assert len(play(film)) == 22


def test_a_film_without_goals_is_refused(ax):
    with pytest.raises(ValueError, match="goals must not be empty"):
        animate_chain(ax, half_way, positions, START, START, [])


@pytest.mark.parametrize(
    ("histories", "words"),
    [
        ([], "histories must not be empty"),
        ([[[FLAT], [FLAT]]] * 2, "axes has 1 and histories 2"),
        ([[[FLAT]]], r"goals has 2 and histories\[0\] 1"),
    ],
)
def test_chains_that_miss_an_axes_or_a_goal_are_refused(ax, histories, words):
    with pytest.raises(ValueError, match=words):
        animate_chains([ax], histories, GOALS)


@pytest.mark.parametrize("largest", [0, -1, np.nan])
def test_poses_in_between_must_be_apart(largest):
    with pytest.raises(ValueError, match="largest must be more than 0"):
        slow_poses([(0, 0), (1, 1)], largest)
