"""The program of the teachers' evaluation page, run on files as teachers have them."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pytest

FILE = "evaluation_made_up.csv"
HEAD = "method_here,method_there,content_here,content_there\n"


@pytest.fixture
def run(root, tmp_path, monkeypatch):
    """Run the program as it stands on the page on a file with the text given."""
    page = (root / "docs/course/evaluation.md").read_text(encoding="utf-8")
    program = "".join(re.findall(r"^```\{code-cell\} python\n(.*?)^```", page, re.M | re.S))
    monkeypatch.chdir(tmp_path)

    def run(text):
        (tmp_path / FILE).write_bytes(text.encode("utf-8"))
        variables = {}
        exec(program, variables)
        return variables

    yield run
    plt.close("all")


def test_histograms_and_means_are_those_of_the_file(run, capsys):
    variables = run(HEAD + "5,3,4,4\n4,4,2,5\n4,,4,\n")
    assert list(variables["scores"]["method_here"]) == [5, 4, 4]
    figure = variables["fig"]
    assert [bar.get_height() for bar in figure.axes[0].patches] == [0, 0, 0, 2, 1]
    assert [bar.get_width() for bar in figure.axes[1].patches] == pytest.approx([3.5, 13 / 3])
    shown = capsys.readouterr().out
    assert "method_there     2 answers, mean 3.5, spread 0.5" in shown
    assert "1, the way of working: +1.00 ± 1.00, from 2 students" in shown


def test_a_file_of_a_spreadsheet_is_read(run):
    lines = (HEAD + "5,3,4,4\n4,4,2,5\n").replace(",", ";").replace("\n", "\r\n")
    scores = run("\ufeff" + lines)["scores"]
    assert list(scores["content_there"]) == [4, 5]


def test_one_form_has_no_error_but_a_mean(run, capsys):
    run(HEAD + "5,3,4,4\n")
    assert "+2.00 ± nan, from 1 students" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (HEAD + "5,3,4,4\n4,6,4,4\n", "form 2, method_there: 6 is not 1, 2, 3, 4 or 5"),
        (HEAD + "4.5,3,4,4\n", "form 1, method_here: 4.5 is not"),
        (HEAD + "five,3,4,4\n", "form 1, method_here: five is not"),
        (HEAD, "no answer in the column method_here"),
        (HEAD + "5,,4,4\n", "no answer in the column method_there"),
        ("a,b\n1,2\n", "no answer in the column method_here"),
        ("", "no answer in the column method_here"),
    ],
)
def test_what_is_no_score_is_named_by_form_and_column(run, text, words):
    with pytest.raises(ValueError, match=words):
        run(text)


def test_the_file_to_fill_in_has_the_columns_of_the_program(root, run):
    folder = root / "docs/course"
    assert (folder / "evaluation_template.csv").read_text(encoding="utf-8") == HEAD
    made_up = (folder / FILE).read_text(encoding="utf-8")
    scores = run(made_up)["scores"]
    assert ",".join(scores) + "\n" == HEAD
    assert all(np.nanmin(given) >= 1 for given in scores.values())
