"""Pictures of expected and got: for every part that has one, small, in words too."""

import io

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from canim import checks
from canim.checks import picture
from canim.checks.picture import Drawing, png, values_over
from canim.checks.program import Program

PARTS = [
    (task, part)
    for task in checks.TASKS.values()
    for part in task.parts
    if part.picture is not None
]
TASK = checks.TASKS["1.1"]
T = np.linspace(0, 1, 5)


@pytest.mark.parametrize(("task", "part"), PARTS, ids=lambda x: getattr(x, "id", x.name))
def test_every_case_of_a_part_can_be_drawn_small_and_is_told_in_words(task, part, solved):
    program = Program(task, solved(task))
    for case in part.cases:
        expected = np.asarray(part.measure(program, *case.args), dtype=float)
        drawing = Drawing(part.name, part.picture, 0.7 * expected + 0.1, expected, case.args)
        file = png([drawing])
        assert len(file) <= 30_000
        image = Image.open(io.BytesIO(file))
        assert image.format == "PNG"
        assert image.size == tuple(round(inches * picture.DPI) for inches in picture.SIZE)
        assert len(image.convert("RGB").getcolors(1000)) > 3
        assert drawing.text.startswith(f"{part.name}: the expected ")
        assert file == png([drawing])


def painted(picture, got, expected, *args):
    figure = Figure()
    picture.paint(figure, np.asarray(got, float), np.asarray(expected, float), *args)
    return figure


def test_of_several_rows_the_one_most_wrong_is_drawn():
    got = np.array([T, 2 * T, 5 * T])
    ax = painted(values_over("t"), got, np.array([T, T, T]), T).axes[0]
    assert [line.get_label() for line in ax.lines] == ["expected", "yours"]
    assert ax.lines[1].get_ydata().tolist() == (5 * T).tolist()
    assert ax.get_xlabel() == "t"
    got[1, 2] = np.nan
    ax = painted(values_over("t"), got, np.array([T, T, T]), T).axes[0]
    assert np.isnan(ax.lines[1].get_ydata()[2])
    assert ax.lines[0].get_linestyle() != ax.lines[1].get_linestyle()


def test_chains_keep_their_angles_and_are_named_where_they_run():
    ax = painted(picture.CHAIN, [(0, 0), (1, 1)], [(0, 0), (1, 0)]).axes[0]
    assert ax.get_aspect() == 1
    assert {text.get_text() for text in ax.texts} == {"expected", "yours"}


@pytest.mark.parametrize("shape", [(2, 3), (2, 3, 3)])
def test_images_are_shown_beside_each_other_with_where_they_differ(shape):
    expected = np.ones(shape)
    got = expected.copy()
    got[1, 2] = 0
    figure = painted(picture.IMAGES, got, expected)
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["expected", "yours", "differ here"]
    assert figure.axes[2].images[0].get_array().tolist() == [[0, 0, 0], [0, 0, 1]]


def test_the_students_figures_and_their_style_stay_as_they_are():
    before = dict(mpl.rcParams)
    fig = plt.figure()
    png([Drawing("a", picture.PATH, np.eye(2), np.ones((2, 2)), ())])
    assert plt.get_fignums() == [fig.number]
    assert dict(mpl.rcParams) == before
    plt.close(fig)


def hermite(**rows):
    def hermite_basis(t):
        H = np.array(
            [2 * t**3 - 3 * t**2 + 1, -2 * t**3 + 3 * t**2, t**3 - 2 * t**2 + t, t**3 - t**2]
        )
        for k, row in rows.items():
            H[int(k[1])] = row(t)
        return H

    return {"hermite_basis": hermite_basis}


def drawn(**rows):
    return checks.run(TASK, hermite(**rows)).drawings


def test_what_differs_is_drawn_and_nothing_else():
    drawings = drawn(H1=lambda t: t, H2=lambda t: t * np.nan)
    assert [drawing.part for drawing in drawings] == ["H1, end value"]
    assert drawings[0].got.tolist() == drawings[0].args[0].tolist()
    assert drawn() == ()


def test_two_mistakes_in_two_parts_give_two_pictures_and_two_hints():
    wrong = hermite(H1=lambda t: -3 * t**3 + 3 * t**2, H3=lambda t: t**3 + t**2)
    report = checks.run(TASK, wrong, hint=True)
    assert [r.state for r in report.results] == ["done", "differs", "done", "differs"]
    assert [part for part, _ in report.hints] == ["H1, end value", "H3, end slope"]
    assert [drawing.part for drawing in report.drawings] == ["H1, end value", "H3, end slope"]
    assert str(report).count("Hint: ") == 2


@pytest.mark.parametrize("large", [1e6, np.inf])
def test_numbers_much_too_large_are_not_drawn(large):
    assert drawn(H1=lambda t: t + large) == ()


def test_what_has_another_shape_is_not_drawn(solved):
    task = checks.TASKS["1.9"]
    names = solved(task) | {"equidistant_points": lambda P, count: np.zeros((count + 1, 2))}
    assert checks.run(task, names).drawings == ()


def test_html_shows_the_picture_with_its_words_and_text_does_without():
    report = checks.run(TASK, hermite(H1=lambda t: t))
    page = report._repr_html_()
    assert page.count('<img src="data:image/png;base64,') == 1
    assert 'alt="H1, end value: the expected curve is broad and pale' in page
    assert len(page) < 40_000
    assert "<img" not in checks.run(TASK, hermite())._repr_html_()
