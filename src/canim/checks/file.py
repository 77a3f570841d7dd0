"""Check a student's file, a program or a notebook, in a fresh process."""

from __future__ import annotations

import ast
import json
import linecache
import os
import re
import shutil
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from canim import checks
from canim.checks import reading
from canim.checks.crash import explain
from canim.checks.guard import Guard, Limits, make
from canim.checks.picture import png
from canim.checks.reading import SUFFIXES, NoTask, UnusableFile
from canim.checks.remote import Gone, Peer, Remote, crash
from canim.checks.report import Report, Result, stops
from canim.checks.run import judge
from canim.checks.task import Task

# Of what lies beside a program: enough for pictures and a face, not for somebody's home.
MOST_BESIDE = 50_000_000  # in bytes
MOST_FILES_BESIDE = 500


def check_file(
    path: Path,
    *,
    task: str | None = None,
    hint: int = 0,
    limits: Limits | None = None,
    figure: Path | None = None,
    guard: Guard | None = None,
) -> list[Report]:
    """Run the file in a fresh process without windows; return a report on each task in it.

    Parameters
    ----------
    path : Path
        A Python program or a Jupyter notebook.
    task : str, optional
        Number of the task; otherwise those of the file's calls of ``canim.check``, or
        that of its name.
    hint : int
        1 to show the hints of the mistakes that were recognised, 2 to show also the line of
        the pseudocode that each belongs to.
    limits : Limits, optional
        The time and the memory that the program may take.
    figure : Path, optional
        Where to write a PNG picture of expected and got for the parts that differ.
    guard : Guard, optional
        What starts the process: one guard for many files is quicker.

    Raises
    ------
    UnusableFile
        If the file is not there, is not a task or cannot be read as Python, or the figure
        cannot be written.
    """
    if path.is_file() and not reading.kind(path):
        raise UnusableFile(f"{path} {reading.why_not(path)}")
    text, note = reading.read(path)
    sources = _sources(path, text)
    trees = _parsed(sources)
    calls = _calls(trees)
    tasks, notes = _tasks_of(path, list(calls), task)
    notes = [*([note] if note else []), *notes]
    own = guard or make()
    try:
        reports = [
            _run(own, path, _until(sources, trees, calls, task), task, limits or Limits())
            for task in tasks
        ]
    finally:
        if guard is None:
            own.close()
    if figure:
        notes.append(_drawn(reports, figure))
    how_to_hint = (f"Type: {_command(path, task, 1)}", f"Type: {_command(path, task, 2)}")
    return [
        replace(
            report,
            notes=(*report.notes, *notes),
            show_hints=hint,
            how_to_hint=how_to_hint,
        )
        for report in reports
    ]


def _run(
    guard: Guard, path: Path, sources: list[tuple[str, str]], task: Task, limits: Limits
) -> Report:
    """Run the program, and judge its functions from here."""

    def why(otherwise: str) -> str:
        broken = guard.end()
        return limits.sentence(broken) if broken else otherwise

    with tempfile.TemporaryDirectory(prefix="canim-", ignore_cleanup_errors=True) as folder:
        work = Path(folder).resolve() / "work"
        copy_beside(path, sources, work)
        name = reading.python_name(path)
        (work / path.name).replace(work / name)
        order = {"task": task.id, "codes": sources, "file": name, "folder": str(work)}
        peer = Peer(guard.start(limits), _refuse)
        try:
            ran = peer.ask(run=order)
            stopped = crash(ran["stopped"]) if ran["stopped"] else None
            missing = bool(ran["missing"])
            answers = {str(question): str(text) for question, text in ran["answers"].items()}
            remote = Remote(task, peer, lambda: why("ends the program instead of returning."))
            report = judge(task, remote)
        except Gone:
            return _empty(task, why("ended before its functions could be checked."))
        # What a program that has changed numpy itself sends may be anything at all.
        except Exception:
            return _empty(task, "gives results that cannot be compared: it has changed numpy.")
        finally:
            guard.end()
    if stopped and missing:
        # Where functions are broken, the report does not tell the stop that follows from it.
        report = replace(report, notes=(f"The program {stops(stopped)}", *report.notes))
    return replace(report, stopped=stopped, answers=answers)


def _refuse(question: dict[str, Any]) -> dict[str, Any]:
    """Answer a question that no program of ours would ask."""
    raise Gone


def copy_beside(path: Path, sources: list[tuple[str, str]], target: Path) -> None:
    """Copy the file, and what it may use of the files beside it, to a new folder.

    Programs beside it come along where the program has their name in it; other files and
    folders as long as they are few and small.
    """
    target.mkdir()
    shutil.copy(path, target)
    text = "\n".join(code for code, _ in sources)
    room, count = MOST_BESIDE, 0
    for entry in _beside(path, text):
        try:
            size = entry.stat().st_size
            # Copying a pipe or a device may never end.
            if not entry.is_file() or size > room:
                continue
            copied = target / entry.relative_to(path.parent)
            copied.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(entry, copied)
            room -= size
            count += 1
            if count == MOST_FILES_BESIDE:
                return
        except OSError:
            continue  # the program will say that it misses this file, if it does


def _beside(path: Path, text: str) -> Iterator[Path]:
    """Yield the files that a program with this text may use, of every folder in order."""
    for folder, folders, names in os.walk(path.parent):
        folders[:] = sorted(name for name in folders if not name.startswith((".", "__")))
        for name in sorted(names):
            entry = Path(folder, name)
            named = re.search(rf"\b{re.escape(entry.stem)}\b", text)
            if entry.suffix not in SUFFIXES or (named and name != path.name):
                yield entry


def _drawn(reports: Sequence[Report], figure: Path) -> str:
    """Draw what differs, if it can be drawn, into the file `figure`; return a sentence on it."""
    drawings = [drawing for report in reports for drawing in report.drawings]
    if not drawings:
        return "There is no picture: no part that differs is a curve, an image or a chain."
    try:
        figure.write_bytes(png(drawings, titles=True))
    except OSError as error:
        raise UnusableFile(f"{figure} cannot be written: {error.strerror}.") from None
    return f"Expected and yours are drawn in {figure}."


def _command(path: Path, task: str | None, step: int) -> str:
    """Return what to type to see this step of the hints."""
    named = f"--task {task} " if task else ""
    file = f'"{path}"' if " " in str(path) else str(path)
    return f"canim check {'--hint ' * step}{named}{file}"


def _empty(task: Task, reason: str) -> Report:
    results = tuple(Result(part.name, "waits", "not checked") for part in task.parts)
    return Report(task, results, notes=(f"The program {reason}",))


def _parsed(sources: list[tuple[str, str]]) -> list[ast.Module]:
    """Return the program, or each cell of the notebook, as a tree."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Python gives them when the program is run
        return [_parse(code, name) for code, name in sources]


def _parse(code: str, name: str) -> ast.Module:
    linecache.cache[name] = (len(code), None, code.splitlines(keepends=True), name)
    try:
        return ast.parse(code, name)
    except SyntaxError as error:
        found = explain(error, lambda _: False)
        where = f"{name}, line {found.line}:\n{found.marked}"
        raise UnusableFile(f"{where}\n{found.sentence}") from None
    except (RecursionError, MemoryError):
        raise UnusableFile(f"{name} is nested too deep for Python to read.") from None
    except ValueError as error:
        raise UnusableFile(f"{name} is not a Python program: {error}.") from None


def _sources(path: Path, text: str) -> list[tuple[str, str]]:
    if reading.kind(path) == ".py" and not reading.is_notebook(text):
        return [(text, str(path))]
    try:
        cells = [cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code"]
        codes = ["".join(cell["source"]) for cell in cells]
    except (ValueError, KeyError, TypeError, RecursionError, MemoryError):
        raise UnusableFile(f"{path} is not a Jupyter notebook.") from None
    return [(_python_of(code), f"{path}, code cell {i}") for i, code in enumerate(codes, 1)]


def _python_of(code: str) -> str:
    """Return a cell's code without lines for IPython, such as %pip and print?."""
    try:
        ast.parse(code)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return re.sub(r"^([ \t]*)(?:[%!?].*|[^#\n]*\?)$", r"\1pass", code, flags=re.M)
    return code  # in Python, a line may begin with the operator %


def _calls(trees: list[ast.Module]) -> dict[str, tuple[int, int]]:
    """Return the tasks that the program checks, and the cell and line of each one's last call."""
    found = [
        (cell, call.end_lineno or call.lineno, str(task))
        for cell, tree in enumerate(trees)
        for call, task in reading.calls(tree)
    ]
    return {task: (cell, line) for cell, line, task in sorted(found)}


def _tasks_of(path: Path, called: list[str], asked: str | None) -> tuple[list[Task], list[str]]:
    """Return the tasks of a file, and sentences on what else it is of."""
    known = [number for number in called if number in checks.TASKS]
    if asked is not None:
        try:
            task = checks.find(asked)
        except ValueError as error:
            raise UnusableFile(str(error)) from None
        others = [number for number in known if number != task.id]
        words = f"The file is of Task {' and '.join(others)} too"
        if task.id not in known:
            words = f"By its call of canim.check, the file is of Task {' and '.join(others)}"
        return [task], [f"{words}: Task {task.id} was asked for."] if others else []
    unknown = [text for text in called if re.fullmatch(r"\d+\D\d+", text) and text not in known]
    notes = [f"There is no Task {number}, which the file asks for." for number in unknown]
    if known:
        return [checks.TASKS[number] for number in known], notes
    if (number := reading.task_in(path)) in checks.TASKS:
        return [checks.TASKS[number]], notes
    raise NoTask(f"{path} is not a task of the course: say which one with --task, as in 1.1.")


def _until(
    sources: list[tuple[str, str]],
    trees: list[ast.Module],
    calls: dict[str, tuple[int, int]],
    task: Task,
) -> list[tuple[str, str]]:
    """Return the program until it gives the names of this task to functions of another one."""
    others = [number for number in calls if number != task.id and number in checks.TASKS]
    if task.id not in calls or not others:
        return sources
    answered = False
    for cell, tree in enumerate(trees):
        for statement in tree.body:
            if (cell, statement.lineno) <= calls[task.id]:
                continue
            names = set(_given(statement))
            if names & set(task.names) or (answered and "answers" in names):
                code, name = sources[cell]
                before = code.split("\n")[: statement.lineno - 1]
                return [*sources[:cell], ("\n".join(before), name)]
            answered = answered or "answers" in names
    return sources


def _given(statement: ast.stmt) -> Iterator[str]:
    """Yield the names that a statement of the program gives to something."""
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        yield statement.name
        return
    for node in ast.walk(statement):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
