"""What README and the documentation promise in code blocks is run, and is the same everywhere."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
TEXTS = [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("docs/[cms]*/**/*.md")]
# A cluster's program needs a file of its own: tests/checks/test_folder.py runs it.
RUN_AS_A_FILE = ("class.md",)
BLOCK = re.compile(r"^```(?:\{code-block\} )?(python|pycon)\n(.*?)^```", re.M | re.S)


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
def test_every_python_block_is_a_doctest(path):
    if path.name in RUN_AS_A_FILE:
        return
    for language, code in BLOCK.findall(path.read_text(encoding="utf-8")):
        assert language == "pycon", f"{path.name}: write this block with >>>, so that it is run"
        assert code.startswith(">>> ")


def test_pins_name_no_address():
    pins = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    assert "://" not in pins
    assert all("==" in line for line in pins.splitlines() if not line.startswith((" ", "#")))


@pytest.mark.parametrize("folder", ["audit", "docs"])
def test_npm_lock_names_no_address(folder):
    assert '"resolved"' not in (ROOT / folder / "package-lock.json").read_text(encoding="utf-8")


def test_words_are_sorted_and_none_is_there_twice():
    words = (ROOT / "docs/words.txt").read_text(encoding="utf-8").splitlines()
    assert words == sorted({word.lower(): word for word in words}.values(), key=str.lower)


def test_citation_has_the_version_of_the_package():
    from canim import __version__

    assert f"\nversion: {__version__}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
