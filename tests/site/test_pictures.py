"""What the gallery's scripts draw reaches the page: in order, with its text, always the same."""

from pathlib import Path
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pictures
import pytest
from matplotlib.animation import FuncAnimation
from PIL import Image, ImageChops

import canim
from canim import checks


@pytest.fixture
def scrape(tmp_path):
    """Show what a block has drawn, as sphinx-gallery asks for it; return the rst."""
    show = checks.show
    pictures.reset({}, None)

    def run(code, **variables):
        names = (tmp_path / f"page_{number:03}.png" for number in range(1, 9))
        block = SimpleNamespace(content=code)
        return pictures.scrape(
            block,
            {"example_globals": variables, "image_path_iterator": names},
            {"src_dir": str(tmp_path)},
        )

    yield run
    checks.show = show
    plt.close("all")


def moving_dot():
    figure, ax = plt.subplots(figsize=(3, 2))
    (dot,) = ax.plot([0], [0], "o")
    return FuncAnimation(figure, lambda i: dot.set_data([i / 9], [0]), frames=9, interval=40)


def test_each_figure_gets_its_own_text(scrape, tmp_path):
    plt.figure(figsize=(4, 3))
    film = moving_dot()
    plt.figure()
    rst = scrape(
        "# Picture: the first,\n# in two lines.\nplt.figure()\n"
        "# Film: a dot moves.\n# Picture: the second.\n",
        film=film,
    )
    assert rst.splitlines() == [
        ".. picture:: /page_001.webp",
        "   :alt: the first, in two lines.",
        "   :width: 400",
        "   :height: 300",
        "",
        "",
        ".. film:: /page_002.webp",
        "   :alt: a dot moves.",
        "   :width: 300",
        "   :height: 200",
        "",
        "",
        ".. picture:: /page_003.webp",
        "   :alt: the second.",
        "   :width: 640",
        "   :height: 480",
    ]
    with Image.open(tmp_path / "page_001.webp") as image:
        assert image.size == (800, 600)
    with Image.open(tmp_path / "thumb/page_001_thumb.webp") as image:
        assert image.size == (480, 360)
    assert (tmp_path / "page_002.mp4").stat().st_size > 1000


def test_film_of_an_earlier_block_is_not_shown_again(scrape):
    film = moving_dot()
    scrape("# Film: a dot moves.\n", film=film)
    plt.figure()
    assert scrape("# Picture: the second.\n", film=film).startswith(".. picture::")


def test_report_stands_above_the_figures_once(scrape):
    checks.check("1.1", hermite_basis=lambda t: np.full((4, len(t)), np.nan))
    plt.figure()
    rst = scrape("# Picture: four curves.\n")
    assert rst.index("canim-report") < rst.index(".. picture::")
    assert "canim-report" not in scrape("")


def test_text_without_figure_is_passed_on(scrape):
    assert scrape("# Picture: nothing.\n") == ".. picture::\n   :alt: nothing.\n"


def test_gif_that_a_block_saves_is_shown(scrape, tmp_path, monkeypatch):
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    canim.warping.save_gif("dark.gif", np.zeros((2, 30, 40, 3), np.uint8))
    plt.figure()
    rst = scrape('# Picture: a square.\n# GIF: all dark.\nsave_gif("dark.gif", frames)\n')
    assert rst.endswith(
        ".. gif:: /page_002.gif\n   :alt: all dark.\n   :width: 40\n   :height: 30\n"
    )
    assert (tmp_path / "page_002.gif").exists()
    assert not list(Path().iterdir())


def test_gif_without_text_is_not_shown(scrape):
    assert scrape('save_gif("mine.gif", frames)\n') == ""


def test_same_film_has_the_same_bytes(scrape, tmp_path):
    files = []
    for _ in range(2):
        film = moving_dot()
        scrape("# Film: a dot moves.\n", film=film)
        files.append([(tmp_path / f"page_001.{end}").read_bytes() for end in ("webp", "mp4")])
    assert files[0] == files[1]


def test_photograph_has_many_colours(scrape, tmp_path):
    face = canim.data.portraits()[0]

    def draw():
        figure, ax = plt.subplots(figsize=(2, 2))
        ax.imshow(face)
        return figure

    figure = draw()
    film = FuncAnimation(figure, lambda i: [], frames=3, interval=40)
    draw()
    code = "# Film: a face that stays.\n# Picture: the same face.\n"
    rst = scrape(code, film=film)
    assert [line for line in rst.splitlines() if line.startswith("..")] == [
        ".. film:: /page_001.webp",
        ".. picture:: /page_002.webp",
    ]
    with Image.open(tmp_path / "page_002.webp") as image:
        assert image.size == (400, 400)
        assert len(image.getcolors(400 * 400)) > 10_000
    with Image.open(tmp_path / "thumb/page_001_thumb.webp") as image:
        assert image.size == (480, 480)
    assert (tmp_path / "page_001.mp4").exists()


def test_nearly_flat_drawing_has_a_palette(tmp_path):
    figure, ax = plt.subplots()
    ax.imshow(canim.data.toy_triangles()[0])
    image = pictures._drawn(figure)
    assert not pictures._is_photograph(image)
    pictures.save(image, tmp_path / "toy.webp")
    with Image.open(tmp_path / "toy.webp") as small:
        assert len(small.getcolors()) <= 256
        difference = ImageChops.difference(image, small.convert("RGB"))
    assert max(high for _, high in difference.getextrema()) <= 8


def test_ground_keeps_its_colour():
    ground = (252, 252, 250)
    image = Image.new("RGB", (80, 60), ground)
    for x in range(40):  # more colours than a palette holds
        for y in range(30):
            image.putpixel((x, y), (5 * x, 8 * y, 3 * x + 3 * y))
    assert pictures._with_palette(image).convert("RGB").getpixel((79, 59)) == ground
