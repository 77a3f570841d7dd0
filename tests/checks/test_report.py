"""How a report reads: text in a terminal, HTML in a notebook, never both."""

import io
import sys
import types
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

from canim import checks
from canim.checks import report as reports
from canim.checks.crash import Crash
from canim.checks.report import Report, Result

TASK = checks.TASKS["1.1"]
LINE = "H1, <line>"
RESULTS = (
    Result("H0, start value", "done"),
    Result(
        "H1, end value", "differs", "at t = 1: expected 1, got <0>", "misprint", "Look & see.", LINE
    ),
    Result("H2, start slope", "differs", "expected 1, got 2", "misprint", "Look & see.", LINE),
    Result("H3, end slope", "unwritten"),
)


def test_text_has_one_line_a_part_and_no_long_lines():
    long = Result("H3, end slope", "differs", "expected 3, got 4 " + "long " * 40)
    text = str(Report(TASK, (*RESULTS, long), notes=("A note.",)))
    assert max(map(len, text.splitlines())) <= 90
    assert [line.strip()[0] for line in text.splitlines()[1:5]] == ["✓", "✗", "✗", "○"]
    assert "A note." in text


def test_a_hint_is_shown_once_though_it_explains_two_parts():
    assert str(Report(TASK, RESULTS, show_hints=True)).count("Look & see.") == 1
    assert Report(TASK, RESULTS)._repr_html_().count("Look &amp; see.") == 1


@pytest.mark.parametrize("state", ["crashed", "unusable"])
def test_what_stops_a_function_is_told_first_and_blames_no_part(state):
    broken = Result("H0, start value", state, "hermite_basis stops in line 3:\n  x = <y>")
    report = Report(TASK, (broken, Result("H1, end value", "waits")))
    lines = str(report).splitlines()
    assert lines[1:3] == ["  ✗ hermite_basis stops in line 3:", "      x = <y>"]
    assert lines[3:5] == [
        "  – H0, start value  not checked yet",
        "  – H1, end value    not checked yet",
    ]
    page = _Balanced()
    page.feed(report._repr_html_())
    assert page.open == []
    assert page.text.count("x = <y>") == 1
    assert page.text.index("x = <y>") < page.text.index("Part")


def test_a_crash_is_marked_by_carets_in_text_and_underlined_in_html():
    crash = Crash(3, "x = <yy> + 1", "Why.", 4, 8)
    broken = Result("H0, start value", "crashed", f"f {reports.stops(crash)}")
    report = Report(TASK, (broken,))
    assert str(report).splitlines()[2:4] == ["      x = <yy> + 1", "          ^^^^"]
    page = _Balanced()
    page.feed(report._repr_html_())
    assert page.open == []
    assert "^" not in page.text
    assert f'<code>x = <mark style="{reports.MARK}">&lt;yy&gt;</mark> + 1</code>' in (
        report._repr_html_()
    )
    missing = Crash(3, "for i in x", "Why.", 10, 11)
    broken = Result("H0, start value", "crashed", f"f {reports.stops(missing)}")
    assert ">\N{NO-BREAK SPACE}</mark></code>" in Report(TASK, (broken,))._repr_html_()


def test_where_the_program_stopped_is_told_unless_a_function_is_broken():
    crash = Crash(7, "x = y", "The name y is not known here.")
    told = Result("H0, start value", "crashed", "hermite_basis stops in line 3")
    assert "line 7" not in str(Report(TASK, (told,), stopped=crash))
    other = str(Report(TASK, RESULTS[:1], stopped=crash))
    assert "The program stops in line 7:\n    x = y" in other
    assert not Report(TASK, RESULTS[:1], stopped=crash).done


def test_a_crash_without_a_line_is_told_without_one():
    assert reports.stops(Crash(0, "", "Why.")) == "stops.\nWhy."


def test_a_report_reads_the_same_wherever_it_is_printed():
    assert repr(Report(TASK, RESULTS)) == str(Report(TASK, RESULTS))


def test_answers_are_counted():
    answers = {1: "yes", 2: " ", 3: ""}
    assert "Questions answered: 1 of 3." in str(Report(TASK, RESULTS, answers=answers))


class _Balanced(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.text, self.seen = [], "", []

    def handle_starttag(self, tag, attributes):
        self.seen.append((tag, dict(attributes)))
        if tag != "br":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


@pytest.mark.parametrize("show", [0, 1, 2])
def test_html_is_balanced_escaped_and_folds_the_hint_and_in_it_the_line(show):
    page = _Balanced()
    page.feed(Report(TASK, RESULTS, notes=("a\nb",), show_hints=show)._repr_html_())
    assert page.open == []
    assert "got <0>" in page.text
    folds = [attributes for tag, attributes in page.seen if tag == "details"]
    assert folds == [{"open": None} if show >= step else {} for step in (1, 2)]
    assert page.text.index("Hint") < page.text.index("Line of the pseudocode")
    assert "script" not in [tag for tag, _ in page.seen]


def test_hints_come_in_three_steps():
    how = ("Say hint.", "Say line.")
    texts = [str(Report(TASK, RESULTS, show_hints=n, how_to_hint=how)) for n in (0, 1, 2)]
    for text, hint, line, asks in zip(
        texts, (False, True, True), (False, False, True), (how[0], how[1], ""), strict=True
    ):
        assert ("Look & see." in text) == hint
        assert ("Pseudocode: H1, <line>" in text) == line
        assert [words for words in how if words in text] == ([asks] if asks else [])


def test_without_a_line_there_is_no_third_step():
    plain = [replace(result, line="") for result in RESULTS]
    text = str(Report(TASK, tuple(plain), show_hints=1, how_to_hint=("", "Say line.")))
    assert "Say line." not in text
    assert "Pseudocode" not in str(Report(TASK, tuple(plain), show_hints=2))
    assert Report(TASK, tuple(plain), show_hints=2)._repr_html_().count("<details") == 1


def test_two_mistakes_in_two_parts_give_two_hints_in_their_order():
    other = replace(RESULTS[2], mistake="another", hint="Think.")
    report = Report(TASK, (*RESULTS[:2], other, RESULTS[3]), show_hints=1)
    assert report.hints == [("H1, end value", "Look & see."), ("H2, start slope", "Think.")]
    assert str(report).index("Look & see.") < str(report).index("Think.")


@pytest.mark.parametrize("hint", [3, -1, "yes", None])
def test_a_step_of_hints_that_there_is_not_is_refused(hint):
    with pytest.raises(ValueError, match="hint must be False, True or 2"):
        checks.check("1.1", hint=hint, hermite_basis=lambda t: None)


def test_a_terminal_without_the_marks_gets_plain_ones(monkeypatch):
    out = io.TextIOWrapper(io.BytesIO(), encoding="cp1252")
    monkeypatch.setattr(sys, "stdout", out)
    checks.show(Report(TASK, RESULTS))
    out.flush()
    text = out.buffer.getvalue().decode("cp1252")
    assert "+ H0" in text
    assert "x H1" in text
    assert "?" not in text


def test_a_stream_without_encoding_gets_text(monkeypatch):
    out = io.StringIO()
    monkeypatch.setattr(sys, "stdout", out)
    checks.show(Report(TASK, RESULTS))
    assert "✓ H0" in out.getvalue()


def _notebook(monkeypatch, shown):
    ipython = types.ModuleType("IPython")
    ipython.get_ipython = lambda: types.SimpleNamespace(kernel=True)
    display = types.ModuleType("IPython.display")
    display.display = shown.append
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "IPython.display", display)


def test_a_notebook_gets_the_report_itself_and_no_text(monkeypatch, capsys):
    shown = []
    _notebook(monkeypatch, shown)
    checks.check("1.1", hermite_basis=lambda t: [t * np.nan] * 4)
    assert [type(report) for report in shown] == [Report]
    assert capsys.readouterr().out == ""


def test_a_crash_ends_a_cell_without_a_traceback(monkeypatch):
    _notebook(monkeypatch, [])
    with pytest.raises(checks._End) as ended:
        checks.check("1.1", hermite_basis=lambda t: t / "a")
    assert ended.value._render_traceback_() == []


def test_ipython_in_a_terminal_is_no_notebook(monkeypatch):
    ipython = types.ModuleType("IPython")
    ipython.get_ipython = lambda: types.SimpleNamespace()
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    assert not reports.in_notebook()
    monkeypatch.delitem(sys.modules, "IPython")
    assert not reports.in_notebook()
