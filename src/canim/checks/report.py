"""The report of a check: as text for a terminal, as HTML for a notebook or a page."""

from __future__ import annotations

import base64
import importlib
import re
import sys
import textwrap
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from canim.checks.crash import Crash
from canim.checks.picture import SIZE, Drawing, png
from canim.checks.task import Task

WIDTH = 88
MOST_CELLS = 3  # of those that stop, one is often the cause of all
STATES = {
    "done": ("✓", "done"),
    "unwritten": ("○", "not written yet"),
    "differs": ("✗", "differs"),
    "crashed": ("–", "not checked yet"),
    "unusable": ("–", "not checked yet"),
    "waits": ("–", "not checked yet"),
}
BROKEN = ("crashed", "unusable")
CARETS = re.compile(r"  +(\^+)")
IMAGE_STYLE = "display:block;max-width:100%;height:auto;border-radius:6px;margin:0.5em 0"
MARK = "background:none;color:inherit;border-bottom:3px solid"
PLAIN_MARKS = {"✓": "+", "○": "o", "✗": "x", "–": "-"}


@dataclass(frozen=True)
class Result:
    """What the check found for one part.

    `hint` is that of the mistake recognised, `line` the pseudocode's line that it belongs to.
    """

    part: str
    state: str
    message: str = ""
    mistake: str = ""
    hint: str = ""
    line: str = ""


@dataclass(frozen=True, repr=False)
class Report:
    """What a check found: first what stops a function, then part by part.

    Hints come in steps: `show_hints` is 0 for none, 1 for the hint, 2 for the line of the
    pseudocode too; `how_to_hint` says how to ask for each of these steps.

    `notes` are sentences about the program as a whole; `answers` counts the questions
    answered, where the file was seen; `stopped` says where the file itself crashed, and
    `changing` names the functions that change their arguments: what comes after goes wrong.
    `cells` are the crashes of a notebook's cells, below which all others are run. `early` tells
    that the program, or a cell, stopped before all functions were there.
    `drawings` show expected and got of parts that differ; in HTML they are drawn.
    """

    task: Task
    results: tuple[Result, ...]
    notes: tuple[str, ...] = ()
    show_hints: int = 0
    how_to_hint: tuple[str, str] = ("", "")
    stopped: Crash | None = None
    cells: tuple[Crash, ...] = ()
    early: bool = False
    changing: tuple[str, ...] = ()
    drawings: tuple[Drawing, ...] = ()
    answers: dict[str, str] | None = None

    @property
    def done(self) -> bool:
        """Whether every part is done, does no harm, and the program ran to its end."""
        return not (self.stopped or self.changing) and all(r.state == "done" for r in self.results)

    @property
    def broken(self) -> bool:
        """Whether what follows in the program would stop for what is told already."""
        return bool(self.problems)

    @property
    def problems(self) -> list[str]:
        """What stops functions. It belongs to no part: the line may be any of theirs."""
        return [r.message for r in self.results if r.state in BROKEN]

    @property
    def summary(self) -> str:
        """One sentence on the whole."""
        if self.done:
            return f"All checks of Task {self.task.id} pass."
        done = sum(r.state == "done" for r in self.results)
        return f"Task {self.task.id}: {done} of {len(self.results)} parts done."

    @property
    def hints(self) -> list[tuple[str, str]]:
        """Part and hint of every mistake recognised, each once, at its first part."""
        return [(r.part, r.hint) for r in self._recognised]

    @property
    def _recognised(self) -> list[Result]:
        """The first result of every mistake recognised."""
        first = {r.mistake: r for r in reversed(self.results) if r.mistake}
        return [r for r in self.results if r in first.values()]

    @property
    def stops(self) -> list[str]:
        """Sentences on where the program stopped, or cells of the notebook."""
        if self.stopped:
            return [f"The program {stops(self.stopped)}"]
        told = [f"Code cell {c.cell} {stops(replace(c, cell=0))}" for c in self.cells[:MOST_CELLS]]
        if len(self.cells) > len(told):
            told.append(f"In all, {len(self.cells)} cells stop.")
        return told

    @property
    def _endings(self) -> list[str]:
        """Sentences below the parts."""
        # Where a function is broken, what follows stops too: that is not told as well.
        lines = [*(self.stops if self.early or not self.broken else ()), *self.notes]
        if self.answers is not None:
            given = sum(bool(str(text).strip()) for text in self.answers.values())
            lines.append(f"Questions answered: {given} of {self.task.questions}.")
        return lines

    def __repr__(self) -> str:
        return str(self)

    def __str__(self) -> str:
        name_width = max(len(r.part) for r in self.results) + 2
        hinted = self._recognised if self.show_hints else ()
        lines = [f"Task {self.task.id}: {self.task.title}"]
        for problem in self.problems:
            lines += _wrapped(problem, "  ✗ ")
        for r in self.results:
            mark, words = STATES[r.state]
            head = f"  {mark} {r.part:<{name_width}}"
            lines += _wrapped(words if r.state in BROKEN else r.message or words, head)
            if r in hinted:
                lines += _wrapped(f"Hint: {r.hint}", " " * len(head))
                if self.show_hints > 1 and r.line:
                    lines += _wrapped(f"Pseudocode: {r.line}", " " * len(head))
        for line in self._endings:
            lines += _wrapped(line, "  ")
        lines.append(self.summary)
        lines += self._next_step
        return "\n".join(lines)

    @property
    def _next_step(self) -> list[str]:
        """How to see more, where there is more."""
        if self.hints and not self.show_hints:
            return _wrapped(f"There is a hint. {self.how_to_hint[0]}", "")
        if self.show_hints == 1 and any(r.line for r in self._recognised):
            return _wrapped(f"Where in the pseudocode? {self.how_to_hint[1]}", "")
        return []

    def _repr_html_(self) -> str:
        rows = "".join(self._row(r) for r in self.results)
        problems = "".join(
            f'<p><span aria-hidden="true">✗</span> {_lines(text)}</p>' for text in self.problems
        )
        endings = "".join(f"<p>{_lines(line)}</p>" for line in self._endings)
        return (
            f'<div class="canim-report">{problems}<table>'
            f'<caption style="text-align:left;white-space:nowrap">'
            f"{escape(self.summary)}</caption>"
            f'<thead><tr><th scope="col" style="text-align:left">Part</th>'
            f'<th scope="col" style="text-align:left">Result</th></tr></thead>'
            f"<tbody>{rows}</tbody></table>{endings}</div>"
        )

    def _fold(self, title: str, content: str, step: int) -> str:
        opened = " open" if self.show_hints >= step else ""
        return f"<details{opened}><summary>{title}</summary>{content}</details>"

    def _row(self, r: Result) -> str:
        mark, words = STATES[r.state]
        fold = ""
        if r in self._recognised:
            line = self._fold("Line of the pseudocode", f"<code>{escape(r.line)}</code>", 2)
            fold = self._fold("Hint", escape(r.hint) + (line if r.line else ""), 1)
        cell = "text-align:left;vertical-align:top"
        return (
            f'<tr class="canim-{r.state}"><th scope="row" style="{cell}">{escape(r.part)}</th>'
            f'<td style="{cell}"><span aria-hidden="true">{mark}</span> '
            f"{_lines(words if r.state in BROKEN else r.message or words)}"
            f"{self._picture(r.part)}{fold}</td></tr>"
        )

    def _picture(self, part: str) -> str:
        drawings = [drawing for drawing in self.drawings if drawing.part == part]
        if not drawings:
            return ""
        data = base64.b64encode(png(drawings)).decode()
        width, height = (round(100 * inches) for inches in SIZE)
        return (
            f'<img src="data:image/png;base64,{data}" alt="{escape(drawings[0].text)}" '
            f'width="{width}" height="{height}" style="{IMAGE_STYLE}">'
        )


def _lines(text: str) -> str:
    """Return `text` as HTML that keeps its lines; what carets mark in code is underlined."""
    lines = text.split("\n")
    shown = []
    for line, below in zip(lines, [*lines[1:], ""], strict=True):
        if CARETS.fullmatch(line):
            continue
        if not line.startswith("  "):
            shown.append(escape(line))
            continue
        marked = CARETS.fullmatch(below)
        start, end = marked.span(1) if marked else (2, 2)
        code = line.ljust(end, "\N{NO-BREAK SPACE}")
        mark = f'<mark style="{MARK}">{escape(code[start:end])}</mark>' if marked else ""
        shown.append(f"<code>{escape(code[2:start])}{mark}{escape(code[end:])}</code>")
    return "<br>".join(shown)


def _wrapped(text: str, head: str) -> list[str]:
    """Return `text` in lines, the first behind `head`, the others below its start."""
    indent = " " * len(head)
    lines: list[str] = []
    for line in text.split("\n"):
        lines += textwrap.wrap(
            line,
            WIDTH,
            initial_indent=indent if lines else head,
            subsequent_indent=indent,
            break_on_hyphens=False,
        )
    return lines


def stops(crash: Crash) -> str:
    """Return where and why the student's line failed, as the end of a sentence."""
    where = f"stops in {crash.place}" if crash.place else "stops"
    shown = f":\n{crash.marked}" if crash.line else "."
    return f"{where}{shown}\n{crash.sentence}"


def show(report: Report) -> None:
    """Display `report`: HTML in a notebook, text elsewhere."""
    if in_notebook():
        importlib.import_module("IPython.display").display(report)
        return
    print(printable(str(report)))


def printable(text: str) -> str:
    """Return `text` as the terminal can show it."""
    text = harmless(text)
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        for mark, plain in PLAIN_MARKS.items():
            text = text.replace(mark, plain)
        text = text.encode(encoding, "replace").decode(encoding)
    return text


def harmless(text: str) -> str:
    """Return `text` without what would move the cursor or change the colours of a terminal."""
    return re.sub(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", "?", text)


def in_notebook() -> bool:
    """Tell whether the program runs in a notebook, where a cell shows HTML."""
    ipython: Any = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return hasattr(shell, "kernel")
