"""What the gallery's scripts draw reaches the page: in order, with its text, always the same."""

from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pictures
import pytest
from matplotlib.animation import FuncAnimation
from PIL import Image

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
        ".. picture:: /page_001.png",
        "   :alt: the first, in two lines.",
        "   :width: 400",
        "   :height: 300",
        "",
        "",
        ".. film:: /page_002.png",
        "   :alt: a dot moves.",
        "   :width: 300",
        "   :height: 200",
        "",
        "",
        ".. picture:: /page_003.png",
        "   :alt: the second.",
        "   :width: 640",
        "   :height: 480",
    ]
    with Image.open(tmp_path / "page_001.png") as image:
        assert image.size == (800, 600)
    with Image.open(tmp_path / "thumb/page_001_thumb.png") as image:
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


def test_same_film_has_the_same_bytes(scrape, tmp_path):
    files = []
    for _ in range(2):
        film = moving_dot()
        scrape("# Film: a dot moves.\n", film=film)
        files.append([(tmp_path / f"page_001.{end}").read_bytes() for end in ("png", "mp4")])
    assert files[0] == files[1]


def test_photograph_keeps_its_colours(tmp_path):
    noise = np.random.default_rng(1).integers(0, 256, (60, 80, 3), dtype=np.uint8)
    Image.fromarray(noise).save(tmp_path / "noise.png")
    pictures._save_small(tmp_path / "noise.png", tmp_path / "small.png")
    with Image.open(tmp_path / "small.png") as image:
        assert np.array_equal(np.asarray(image), noise)


def test_ground_keeps_its_colour(tmp_path):
    ground = (252, 252, 250)
    image = Image.new("RGB", (80, 60), ground)
    for x in range(40):  # more colours than a palette holds
        for y in range(30):
            image.putpixel((x, y), (5 * x, 8 * y, 3 * x + 3 * y))
    image.save(tmp_path / "figure.png")
    pictures._save_small(tmp_path / "figure.png", tmp_path / "small.png")
    with Image.open(tmp_path / "small.png") as small:
        assert small.convert("RGB").getpixel((79, 59)) == ground
