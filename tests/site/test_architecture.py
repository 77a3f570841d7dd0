"""What may use what, and the drawing of it."""

import xml.etree.ElementTree as ET

import architecture
import pytest

BLOCKS = {"interpolation", "warping", "character"}
MAY_USE = {
    "_arguments": set(),
    **{part: {"_arguments"} for part in [*BLOCKS, "plotting"]},
    "data": {"_arguments", "character"},
    "checks": {"_arguments", "data", "plotting", *BLOCKS},
    "cli": {"_arguments", "checks", "data", "plotting", *BLOCKS},
    "gallery": {"checks", "data", "plotting", *BLOCKS},
}


def test_imports_go_one_way():
    found = architecture.graph()
    assert set(found) == set(MAY_USE)
    assert {
        part: used - MAY_USE[part] for part, used in found.items() if used - MAY_USE[part]
    } == {}


def test_what_this_page_shows_is_used():
    used = architecture.without_detours(architecture.graph())
    assert used["cli"] == {"checks"}
    assert used["data"] == {"character"}
    assert used["checks"] >= BLOCKS


@pytest.mark.parametrize(
    "text",
    [
        "import canim.data",
        "import canim.data.face as face",
        "from canim import plotting as p, data",
        "from canim.data import face",
        "def f():\n    from canim.data.images import portraits",
        "import canim\n\ncanim.data.face()",
    ],
)
def test_every_form_of_an_import_is_seen(text, tmp_path):
    (tmp_path / "program.py").write_text(text, encoding="utf-8")
    found = architecture.uses(tmp_path / "program.py", {"data", "checks"})
    assert found == {"data"}


def test_the_short_name_of_the_checks_and_other_packages(tmp_path):
    text = "import canim, other.data\nfrom data import x\ncanim.check('1.1')\ncanim.style\n"
    (tmp_path / "program.py").write_text(text, encoding="utf-8")
    assert architecture.uses(tmp_path / "program.py", {"data", "checks"}) == {"checks"}


GRAPH = {"top": {"left", "right", "base"}, "left": {"base"}, "right": {"base"}, "base": set()}


def test_arrows_point_down_and_none_that_follows_is_drawn():
    short = architecture.without_detours(GRAPH)
    assert short["top"] == {"left", "right"}
    assert architecture.rows(short) == [["top"], ["left", "right"], ["base"]]


def test_the_drawing_says_in_words_what_it_shows():
    figure = ET.fromstring(architecture.drawing(GRAPH))
    (svg,) = figure
    assert svg.get("aria-label") == (
        "The parts of canim and what they use: top uses left and right; left uses base; "
        "right uses base."
    )
    assert [text.text for text in svg.iter("text")] == ["top", "left", "right", "base"]
    assert len(svg.findall("path")) == 4
    *_, width, height = map(float, svg.get("viewBox").split())
    for box in svg.iter("rect"):
        assert 0 < float(box.get("x")) < width - float(box.get("width"))
        assert 0 < float(box.get("y")) < height - float(box.get("height"))
