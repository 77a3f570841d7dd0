"""What checks say is short and calm, blames nobody, and needs neither colour nor eyes."""

import ast
import re
from pathlib import Path

import pytest

from canim import checks
from canim.checks import crash, report
from canim.checks.report import Report, Result

MODULES = sorted(Path(checks.__file__).parent.glob("*.py"))
BLAME = re.compile(
    r"\byou (?:failed|forgot|made|did not|should)\b|\byour (?:fault|error|mistake)\b"
    r"|\b(?:careless|stupid|silly|simply|obviously|of course|illegal|fatal|abort)",
    re.I,
)


def texts(path):
    """Return the texts of a module that are more than a word, without its docstrings."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    told = [node.value for node in ast.walk(tree) if isinstance(node, ast.Expr)]
    return [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and node not in told
        if isinstance(node.value, str) and " " in node.value
    ]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.stem)
def test_no_text_shouts_or_blames(path):
    for text in texts(path):
        assert "!" not in re.sub(r"%!|\(\?(?:<?|:)!", "", text), text  # of IPython, of patterns
        assert not BLAME.search(text), text


def test_blame_is_found():
    assert BLAME.search("Here you forgot a bracket.")
    assert BLAME.search("Obviously this is 2.")
    assert not BLAME.search("Which node must the product leave out?")


@pytest.mark.parametrize("words", [words for _, _, words in crash._PLAIN])
def test_sentences_on_crashes_fit_a_line(words):
    assert len(words) <= report.WIDTH
    assert words.endswith((".", "?"))


@pytest.mark.parametrize("state", report.STATES)
def test_a_state_is_told_in_words_too(state):
    mark, words = report.STATES[state]
    whole = Report(checks.TASKS["1.1"], (Result("H0, start value", state),))
    assert words in str(whole)
    # A screen reader passes over the mark.
    assert f'<span aria-hidden="true">{mark}</span> {words}' in whole._repr_html_()
    assert '<th scope="row"' in whole._repr_html_()
