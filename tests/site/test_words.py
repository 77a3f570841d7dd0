"""Words in bold letters lead to the glossary."""

import re

import pytest
import words

TERMS = {"node": 1, "barycentric coordinates": 1, "forward kinematics": 1, "forward warping": 1}
# Steps of a task, and words that are only stressed.
NO_TERMS = {
    "Colour.", "Equal slopes.", "Forward.", "Inside.", "Other ways.",
    "Piece i begins at point i.", "Piece i ends at point i + 1.", "Place.",
    "Points in between.", "Predict", "Start.", "The copy.", "The stop.", "The update",
    "The update.", "Turn", "Two warps.", "When things go wrong.", "colour",
    "corner is a column", "direction", "factor", "move", "next handle", "number of ways",
    "place", "powers", "scale", "speed", "sum to one", "three degrees of freedom", "walked",
    "whatever the weights are",
}  # fmt: skip


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Nodes", "node"),
        ("The node.", "node"),
        ("barycentric", "barycentric coordinates"),
        ("barycentric coordinates", "barycentric coordinates"),
        ("forward", None),
        ("bary", None),
        ("", None),
    ],
)
def test_find(text, found):
    assert words.find(text, TERMS) == found


def test_every_word_of_the_theory_is_explained_or_no_term(site, task_page):
    page = (site / task_page).read_text(encoding="utf-8")
    theory = page[page.index('<section id="theory">') : page.index('<section id="pseudocode">')]
    explained = set(map(plain, re.findall(r'#term-[^"]*"><strong>(.*?)</strong>', page)))
    bold = re.findall(r"<strong>(.*?)</strong>", theory)
    open_ones = [word for word in bold if plain(word) not in explained and word not in NO_TERMS]
    assert open_ones == [], "explain them in docs/students/glossary.md"
    assert "students/glossary.html" in theory


def plain(word):
    return word.lower().strip(" .").removeprefix("the ").removesuffix("s")
