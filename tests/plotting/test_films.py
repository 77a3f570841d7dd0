"""Films: what every frame shows."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from canim.plotting import animate_construction, animate_morph, animate_points

T = np.linspace(0, 1, 11)
LINE = np.column_stack([T, 2 * T])


@pytest.fixture
def ax():
    fig, ax = plt.subplots()
    ax.set(xlim=(-1, 2), ylim=(-1, 3))
    yield ax
    plt.close(fig)


def _levels(t):
    """A construction with two levels above its pen."""
    corners = np.array([[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]])
    middle = (1 - t) * corners[:-1] + t * corners[1:]
    return [corners, middle, (1 - t) * middle[:1] + t * middle[1:]]


def _play(film):
    """Return the numbers of the frames, drawing each."""
    film._fig.canvas.draw()  # a film that was never drawn warns when it is deleted
    frames = list(film.new_frame_seq())
    for frame in frames:
        film._draw_frame(frame)
    return frames


def test_a_film_has_25_frames_a_second_and_holds_its_end(ax):
    film = animate_points(ax, {"dot": LINE}, hold=5)
    assert film._interval == 40
    assert _play(film) == [*range(11), *[10] * 5]


def test_a_construction_shows_every_level_and_leaves_the_curve_behind(ax):
    film = animate_construction(ax, [_levels(t) for t in T], hold=2)
    trace, corners, middle, dot = ax.lines
    _play(film)
    assert len(trace.get_xydata()) == 11
    film._draw_frame(5)
    assert np.array_equal(corners.get_xydata(), _levels(0.5)[0])
    assert np.array_equal(middle.get_xydata(), _levels(0.5)[1])
    assert np.array_equal(dot.get_xydata(), _levels(0.5)[2])
    assert np.array_equal(trace.get_xydata(), [_levels(t)[2][0] for t in T[:6]])


def test_each_level_of_a_construction_has_its_own_colour(ax):
    corners = np.arange(12.0).reshape(6, 2)
    frame = [corners[:count] for count in range(6, 0, -1)]
    film = animate_construction(ax, [frame, frame])
    colors = [line.get_color() for line in ax.lines]
    assert len(colors) == 7
    assert len(set(colors)) == 6  # the pen has the colour of its curve
    _play(film)


def test_points_move_with_their_names(ax):
    film = animate_points(ax, {"ahead": LINE, "behind": (0.5 * LINE).tolist()})
    _play(film)
    film._draw_frame(4)
    ahead, behind = ax.lines
    assert np.array_equal(ahead.get_xydata(), LINE[4:5])
    assert np.array_equal(behind.get_xydata(), 0.5 * LINE[4:5])
    names = ax.get_legend().get_texts()
    assert [name.get_text() for name in names] == ["ahead", "behind"]
    assert [name.get_color() for name in names] == [ahead.get_color(), behind.get_color()]


def test_names_stay_where_they_are_while_the_points_move(ax):
    film = animate_points(ax, {"one": LINE, "two": LINE})
    _play(film)
    places = []
    for frame in (0, 10):
        film._draw_frame(frame)
        ax.figure.canvas.draw()
        places.append([name.get_window_extent() for name in ax.get_legend().get_texts()])
    for before, after in zip(*places):
        assert after.bounds == pytest.approx(before.bounds)  # fitting the layout rounds anew
    assert not places[0][0].overlaps(places[0][1])


def test_a_morph_shows_its_images_one_after_the_other_and_moves_its_triangles(ax):
    frames = [np.full((4, 4, 3), 50 * k, dtype=np.uint8) for k in range(3)]
    poses = [np.array([[0, 0], [3, 0], [k, 3]]) for k in range(3)]
    film = animate_morph(ax, frames, poses, [(0, 1, 2)], hold=2)
    assert _play(film) == [0, 1, 2, 2, 2]
    film._draw_frame(1)
    assert np.array_equal(ax.images[0].get_array(), frames[1])
    assert np.array_equal(ax.collections[0].get_segments()[0], [(0, 0), (3, 0), (1, 3), (0, 0)])


def test_a_morph_needs_no_triangles_and_grey_stays_the_same_grey(ax):
    film = animate_morph(ax, [np.full((4, 4), 50), np.full((4, 4), 60)], hold=0)
    _play(film)
    assert ax.images[0].get_clim() == (0, 255)
    assert not ax.collections


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda ax: animate_points(ax, {}), "paths must not be empty"),
        (lambda ax: animate_points(ax, {"a": np.empty((0, 2))}), "paths must not be empty"),
        (
            lambda ax: animate_points(ax, {"a": np.zeros((5, 2)), "b": np.zeros((4, 2))}),
            "paths must all have as many points, but a has 5 and b 4",
        ),
        (lambda ax: animate_construction(ax, []), "frames must not be empty"),
        (
            lambda ax: animate_construction(ax, [[[(0, 0)]], [[(0, 0)], [(1, 1)]]]),
            "frames must all have as many levels, but frame 0 has 1 and frame 1 2",
        ),
        (lambda ax: animate_morph(ax, []), "frames, poses must not be empty"),
        (
            lambda ax: animate_morph(ax, [np.zeros((4, 4))] * 3, [np.zeros((3, 2))], [(0, 1, 2)]),
            "as many entries, but frames has 3 and poses 1",
        ),
    ],
)
def test_a_film_of_nothing_or_of_unequal_parts_is_refused(ax, make, message):
    with pytest.raises(ValueError, match=message):
        make(ax)
    assert not ax.lines
    assert not ax.images


def test_poses_need_triangles(ax):
    with pytest.raises(TypeError, match="triangles"):
        animate_morph(ax, [np.zeros((4, 4))], [np.zeros((3, 2))])
