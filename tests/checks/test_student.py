"""The student's side of a check; here, it shares the process of the test."""

import builtins
import multiprocessing
import os
import sys
import tempfile
import threading
from contextlib import closing, suppress

import matplotlib
import nbformat
import pytest
from matplotlib import pyplot
from matplotlib.backend_bases import FigureCanvasBase

from canim import checks
from canim.checks import student
from canim.checks.file import check_file
from canim.checks.guard import Limits

RIGHT = "from canim.interpolation import hermite_basis\n"


class Ended(BaseException):
    """The program is ended from outside."""


class Beside:
    """A guard whose programs run in a thread; `broken` is the limit that they are told to break."""

    def __init__(self, broken=""):
        self._broken = broken
        self._open = False

    def start(self, limits):
        self._pipe, theirs = multiprocessing.Pipe()
        self._thread = threading.Thread(target=self._run, args=[theirs])
        self._thread.start()
        self._open = True
        return self._pipe

    def _run(self, pipe):
        with suppress(Ended), closing(pipe):
            student.serve(pipe, lambda: None)

    def end(self):
        if self._open:
            self._open = False
            self._pipe.close()
            self._thread.join()
        return self._broken

    def close(self):
        raise AssertionError("the guard is the test's")


@pytest.fixture
def check(tmp_path, monkeypatch):
    """Check a program; what this process changes for it is put back."""
    changed = {
        sys: ("argv", "dont_write_bytecode", "path", "stdout", "stderr"),
        matplotlib: ("use",),
        pyplot: ("switch_backend", "show"),
        FigureCanvasBase: ("start_event_loop",),
        checks: ("check",),
        tempfile: ("tempdir",),
    }
    for place, names in changed.items():
        for name in names:
            monkeypatch.setattr(place, name, getattr(place, name))
    for name in ("display", "get_ipython"):
        monkeypatch.setattr(builtins, name, None, raising=False)
    monkeypatch.setattr(sys, "path", sys.path[:])
    monkeypatch.setitem(sys.modules, "__main__", sys.modules["__main__"])
    for name in ("TMPDIR", "TEMP", "TMP"):
        monkeypatch.setenv(name, "")
    monkeypatch.chdir(tmp_path)

    def checked(text, name="mine.py", task="1.1", broken=""):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        (report,) = check_file(path, task=task, limits=Limits(2), guard=Beside(broken))
        return report

    yield checked
    pyplot.close("all")


def messages(report):
    return [result.message for result in report.results]


def test_a_program_is_run_and_its_functions_are_called(check):
    text = "assert __name__ == '__main__' and __file__.endswith('mine.py')\n" + RIGHT
    report = check(text + "answers = {1: 2.5, 'b': None}\n")
    assert report.done
    assert report.notes == ("hermite_basis uses canim's function.",)
    assert report.answers == {"1": "2.5", "b": "None"}


def test_a_notebook_has_no_file(check):
    notebook = nbformat.v4.new_notebook()
    codes = ["%pip install canim\n" + RIGHT, "assert '__file__' not in globals()", "answers = 3"]
    notebook.cells = [nbformat.v4.new_code_cell(code) for code in codes]
    report = check(nbformat.writes(notebook), "mine.ipynb")
    assert report.done
    assert report.answers == {}


def test_data_are_asked_for(check):
    text = "from canim.interpolation import lagrange_interpolate\n"
    text += "def f(x): return 1 / (1 + x**2)\n"
    text += "def sample(f, nodes): return [f(node) for node in nodes]\n"
    text += "def interpolate(f, nodes, x):\n"
    text += "    return lagrange_interpolate(nodes, sample(f, nodes), x)\n"
    assert check(text + "nodes = [1, 2, 3.5]\n", task="1.4").done
    missing = check(text, task="1.4")
    assert "nodes is missing: keep this name in your program." in messages(missing)


def test_what_a_program_that_stops_has_defined_is_checked(check):
    report = check(RIGHT + "print(undefined)\n")
    assert report.stopped.line == 2
    assert [result.state for result in report.results] == ["done"] * 4


def test_a_name_that_comes_after_the_end_is_told(check):
    report = check("raise SystemExit\n" + RIGHT)
    assert messages(report)[0] == f"hermite_basis {student.EARLY}"


def test_nothing_waits_or_is_printed(check, capfd):
    text = "import matplotlib, sys\nfrom matplotlib import pyplot\nmatplotlib.use('TkAgg')\n"
    text += "pyplot.switch_backend('TkAgg')\npyplot.figure()\npyplot.pause(1000)\npyplot.close()\n"
    assert check(text + "print(1)\nprint(2, file=sys.stderr)\n" + RIGHT).done
    assert capfd.readouterr() == ("", "")


YOURS = "from matplotlib import pyplot as plt\nplt.ioff()\nplt.subplots(num='Yours')\n"


@pytest.mark.parametrize(
    "show", ["plt.show()", "plt.show(block=True)", "plt.ion()\nplt.show(block=True)"]
)
def test_a_window_that_was_shown_is_closed(check, show):
    assert check(f"{YOURS}{show}\n{YOURS}{RIGHT}").stops == []


@pytest.mark.parametrize("show", ["plt.show(block=False)", "plt.ion()\nplt.show()"])
def test_a_window_that_nobody_waits_for_stays_open(check, show):
    text = f"{YOURS}{show}\nassert plt.fignum_exists('Yours')\nplt.ioff()\nplt.show()\n"
    assert check(text + RIGHT).stops == []


def test_a_film_can_be_saved_after_it_was_shown(check):
    text = f"{YOURS}from matplotlib.animation import FuncAnimation\n"
    text += "film = FuncAnimation(plt.gcf(), lambda i: [], frames=2)\nplt.show()\n"
    text += "film.save('film.gif', writer='pillow')\n"
    assert check(text + RIGHT).stops == []


def test_the_pictures_of_a_cell_are_closed_at_its_end(check):
    notebook = nbformat.v4.new_notebook()
    notebook.cells = [nbformat.v4.new_code_cell(code) for code in (YOURS, YOURS + RIGHT)]
    assert check(nbformat.writes(notebook), "mine.ipynb").stops == []


def of(*codes):
    notebook = nbformat.v4.new_notebook()
    notebook.cells = [nbformat.v4.new_code_cell(code) for code in codes]
    return nbformat.writes(notebook)


def test_a_notebook_finds_what_jupyter_keeps_of_its_cells(check):
    report = check(of("assert (_, In[1][:6], Out) == ('', 'assert', {})", RIGHT), "mine.ipynb")
    assert report.stops == []


def test_a_program_that_is_not_there_to_run_is_told_by_the_name_in_the_cell(check):
    (stop,) = check(of("%run", "%run nothere.py", RIGHT), "mine.ipynb").stops
    assert stop.startswith("Code cell 2 stops")
    assert "nothere.py" in stop
    assert "nothere.py.py" not in stop


def test_a_program_is_run_without_its_ending_too(check, tmp_path):
    (tmp_path / "made.py").write_text("four = 4")
    assert check(of("%run made\nassert four == 4", RIGHT), "mine.ipynb").stops == []


def test_temporary_files_have_a_folder_that_goes_with_the_program(check, tmp_path):
    written = tmp_path / "written.txt"
    text = "import pathlib, tempfile\nnumber, name = tempfile.mkstemp()\n"
    text += f"pathlib.Path({str(written)!r}).write_text(name)\n"
    assert check(text + RIGHT).done
    assert not os.path.exists(written.read_text())
    assert sorted(tmp_path.iterdir()) == [tmp_path / "mine.py", written]


@pytest.mark.parametrize(
    ("error", "sentence"), [(MemoryError, student.FULL), (ZeroDivisionError, student.CHANGED)]
)
def test_what_cannot_be_asked_for_is_told(check, monkeypatch, error, sentence):
    def fail(*args):
        raise error

    monkeypatch.setattr(student.Program, "call", fail)
    monkeypatch.setattr(student.Program, "value", fail)
    assert messages(check(RIGHT))[0] == f"hermite_basis {sentence}"
    assert f"nodes {sentence}" in messages(check(RIGHT, task="1.4"))


def test_a_function_in_which_the_program_is_ended_is_named(check, monkeypatch):
    def be_ended(*args):
        raise Ended

    monkeypatch.setattr(student.Program, "call", be_ended)
    report = check(RIGHT, broken="time")
    said = "hermite_basis did not end within 2 seconds. Is there a loop without an end?"
    assert messages(report)[0] == said


@pytest.mark.parametrize("line", ["print(undefined)", "input()", "import not_there", "exit()"])
def test_answers_below_the_line_that_stops_are_kept(check, line):
    text = f"{line}\n" + RIGHT + "answers = {1: 'early'}\nanswers = {1: 'so', 2: ''}\n"
    assert check(text).answers == {"1": "so", "2": ""}


def test_answers_in_a_cell_below_one_without_an_end_are_kept(check, monkeypatch):
    def be_ended(*args):
        raise Ended

    monkeypatch.setattr(student._Student, "_run_one", be_ended)
    notebook = nbformat.v4.new_notebook()
    codes = ["while True: pass\n" + RIGHT, "answers = {1: 'so'}\nanswers = {1: texts}"]
    notebook.cells = [nbformat.v4.new_code_cell(code) for code in codes]
    report = check(nbformat.writes(notebook), "mine.ipynb", broken="time")
    assert report.answers == {"1": "so"}
