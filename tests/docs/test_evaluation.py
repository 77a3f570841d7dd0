"""The program of the teachers' evaluation page, run on files as teachers have them."""

import os
import runpy
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
from scipy import stats

MADE_UP = "evaluation_made_up.csv"
HEAD = "method_here,method_there,content_here,content_there\n"
FILLED = HEAD + "5,3,4,4\n4,4,2,5\n"


@pytest.fixture(scope="module")
def program(root):
    return runpy.run_path(str(root / "docs/course/evaluation.py"), run_name="evaluation")


@pytest.fixture
def evaluate(program, tmp_path, capsys):
    """Run the program on a file with these bytes; return its exit code, what it says, a figure."""

    def run(data):
        path = tmp_path / "answers.csv"
        path.write_bytes(data.encode() if isinstance(data, str) else data)
        code = program["main"]([str(path)])
        printed = capsys.readouterr()
        return code, printed.out + printed.err, plt.figure(1) if plt.get_fignums() else None

    yield run
    plt.close("all")


@pytest.fixture
def scores(program, tmp_path):
    def read(data):
        path = tmp_path / "answers.csv"
        path.write_bytes(data.encode() if isinstance(data, str) else data)
        return {name: given.tolist() for name, given in program["read_scores"](path).items()}

    return read


def test_histograms_and_means_are_those_of_the_file(evaluate):
    code, said, figure = evaluate(HEAD + "5,3,4,4\n4,4,2,5\n4,,4,\n")
    assert code == 0
    assert [bar.get_height() for bar in figure.axes[0].patches] == [0, 0, 0, 2, 1]
    assert [bar.get_width() for bar in figure.axes[1].patches] == pytest.approx([3.5, 13 / 3])
    assert figure.get_suptitle() == "answers.csv"
    assert "method_there   2 answers, mean 3.5, spread 0.7" in said
    assert "1, the way of working: +1 ± 13, from 2 students (may be chance)" in said


AS_WRITTEN = [
    FILLED,
    FILLED.replace("\n", "\r\n"),
    FILLED.replace("\n", "\r"),
    FILLED.rstrip(),
    FILLED.replace(",", ";"),
    FILLED.replace(",", "\t"),
    "sep=;\n" + FILLED.replace(",", ";"),
    '"sep=;"\r\n' + FILLED.replace(",", ";").replace("\n", "\r\n"),
    "SEP=|\n" + FILLED.replace(",", "|"),
    "Method_Here, METHOD_THERE ,content here,Content - There\n5,3,4,4\n 4 ,4,2, 5\n",
    '"method_here","method_there","content_here","content_there"\n"5","3","4","4"\n"4",4,2,5\n',
    "\n\n" + FILLED.replace("\n4", "\n,,,\n\n4") + ",,,\n",
    FILLED.replace("5,3", "5.0,3.00"),
    FILLED.replace(",", ";").replace("5;3", "5,0;3"),
    "No,content_there,content_here,method_there,method_here\n1,4,4,3,5\n2,5,2,4,4\n",
    HEAD.replace("\n", ",what kept you\n") + '5,3,4,4,"nothing,\nreally"\n4,4,2,5,é\n',
]
ENCODINGS = ["utf-8", "utf-8-sig", "cp1252", "utf-16", "utf-16-le", "utf-16-be"]


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("text", AS_WRITTEN)
def test_a_file_of_any_spreadsheet_is_read(scores, text, encoding):
    found = scores(text.encode(encoding))
    assert found == {
        "method_here": [5, 4],
        "method_there": [3, 4],
        "content_here": [4, 2],
        "content_there": [4, 5],
    }


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (HEAD + "5,3,4,4\n4,6,4,4\n", ", line 3, method_there: 6 is not 1, 2, 3, 4 or 5. Correct"),
        (HEAD + "4.5,3,4,4\n", ", line 2, method_here: 4.5 is not"),
        (HEAD + "five,3,4,4\n", ", line 2, method_here: five is not"),
        ("sep=,\n" + HEAD + "\n0,3,4,4\n", ", line 4, method_here: 0 is not"),
        (HEAD, "holds no form: there is nothing below the names of the columns."),
        (HEAD + ",,,\n", "holds no form"),
        (HEAD + "5,,4,4\n", ": there is no answer in the column method_there."),
        ("a,b\n1,2\n", "has no column method_here. Its first line must name the columns method_"),
        ("a,b\n1,2\n", ", content_here, content_there, but is a, b."),
        ("5,3,4,4\n4,4,4,4\n", "but is 5, 3, 4, 4."),
        (HEAD.replace("content_there", "method here") + "5,3,4,4\n", "more than one column"),
        (HEAD + "5,3,4,4,5\n", ", line 2, has more cells than there are columns."),
        (HEAD + '5,3,4,"4\n4,4,4,4\n', ", line 2: there is no end to a cell in quotes."),
        (
            HEAD.replace("\n", ',remark\n') + '5,3,4,4,"Too "fast" for me"\n',
            ", line 2: a quotation mark inside a cell in quotes must be doubled",
        ),
        ('"method_here', ", line 1: there is no end to a cell in quotes."),
        ("", "is empty."),
        ("\n\n", "is empty."),
        ("sep=;\n", "is empty."),
        (b"PK\x03\x04 and more", "is a spreadsheet. Open it there, and save it as CSV."),
        (b"\xd0\xcf\x11\xe0", "is a spreadsheet."),
        (b"\xff\xfe\x00", "has no column method_here"),
    ],
)  # fmt: skip
def test_a_broken_file_is_told_in_one_sentence(evaluate, data, words):
    code, said, figure = evaluate(data)
    assert code == 2
    assert words in said
    assert "Traceback" not in said
    assert figure is None


def test_a_file_that_is_not_there(program, tmp_path, capsys):
    assert program["main"]([str(tmp_path / "none.csv")]) == 2
    assert capsys.readouterr().err.endswith("none.csv cannot be read: No such file or directory.\n")


def compared(program, *pairs):
    here, there = np.transpose(np.array(pairs, dtype=float))
    return program["compared"]({"method_here": here, "method_there": there}, "method")


def test_the_interval_is_that_of_students_t(program):
    pairs = [(5, 3), (4, 4), (4, 3), (5, 5), (3, 4), (4, 2), (5, 4)]
    lower, upper = stats.ttest_rel(*np.transpose(pairs)).confidence_interval(0.95)
    assert program["half_interval"](np.subtract(*np.transpose(pairs))) == pytest.approx(
        (upper - lower) / 2
    )
    assert compared(program, *pairs) == "+0.7 ± 1.0, from 7 students (may be chance)"


@pytest.mark.parametrize(
    ("pairs", "words"),
    [
        ([(5, np.nan), (np.nan, 3)], "no student gave both numbers, so nothing can be compared"),
        ([(5, 3), (4, np.nan)], "+2, from one student: too few to tell more"),
        ([(5, 4), (4, 3)], "+1 from each of 2 students: where all agree, nothing tells"),
        ([(4, 4)] * 3, "0 from each of 3 students"),
        ([(5, 3), (4, 4)], "+1 ± 13, from 2 students (may be chance)"),
        ([(5, 1), (1, 5)], "0 ± 51, from 2 students (may be chance)"),
        ([(1, 5), (5, 2), (4, 4)], "0 ± 9, from 3 students"),
        ([(5, 3), (5, 4)] * 20, "+1.50 ± 0.16, from 40 students"),
        ([(5, 3), (5, 4), (4, 4)] * 200, "+1.00 ± 0.07, from 600 students"),
    ],
)
def test_as_much_is_said_as_the_numbers_tell(program, pairs, words):
    said = compared(program, *pairs)
    assert said.startswith(words)
    assert "nan" not in said


@pytest.mark.parametrize(
    ("error", "decimals"), [(13, 0), (2.4, 0), (1.2, 1), (0.3, 1), (0.14, 2), (0.05, 2), (0.011, 3)]
)
def test_decimals_are_those_that_mean_something(program, error, decimals):
    assert program["decimals"](error) == decimals


def test_the_file_to_fill_in_has_the_columns_of_the_program(root, program):
    folder = root / "docs/course"
    assert (folder / "evaluation_template.csv").read_text(encoding="utf-8") == HEAD
    scores = program["read_scores"](folder / MADE_UP)
    assert ",".join(scores) + "\n" == HEAD
    assert all(np.nanmin(given) >= 1 for given in scores.values())


def test_the_program_runs_as_the_page_says(root):
    command = next(
        line
        for line in (root / "docs/course/evaluation.md").read_text(encoding="utf-8").splitlines()
        if line.startswith("python ")
    )
    ran = subprocess.run(
        [sys.executable, *command.split()[1:]],
        cwd=root / "docs/course",
        capture_output=True,
        encoding="utf-8",
        env=os.environ | {"PYTHONIOENCODING": "utf-8"},
        check=False,
    )
    assert ran.stderr == ""
    assert "1, the way of working: +0.4 ± 0.3, from 21 students\n" in ran.stdout
