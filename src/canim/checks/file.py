"""Check a student's file, a program or a notebook, in a fresh process."""

from __future__ import annotations

import ast
import contextlib
import linecache
import os
import re
import tempfile
import traceback
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from canim import checks
from canim.checks import notebook, reading
from canim.checks.beside import MOST_BESIDE, MOST_FILES_BESIDE, copy_beside
from canim.checks.crash import explain
from canim.checks.guard import Fault, Guard, Limits, make
from canim.checks.picture import png
from canim.checks.program import Program
from canim.checks.reading import NoTask, UnusableFile
from canim.checks.remote import Gone, Peer, Remote, crash
from canim.checks.report import Report, Result
from canim.checks.run import judge
from canim.checks.task import Task

NOT_ALL_BESIDE = (
    f"Not all files beside it came along: at most {MOST_FILES_BESIDE} files, and "
    f"{MOST_BESIDE // 10**6} MB."
)
_RAW = "it was read like a cell. Remove these lines, or Python will not run it."


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
    Fault
        If the check itself fails, whatever the file.
    """
    if os.path.isfile(path) and not reading.kind(path):
        raise UnusableFile(f"{path} {reading.why_not(path)}")
    text, note = reading.read(path)
    is_notebook = reading.kind(path) == ".ipynb" or reading.is_notebook(text)
    raw = "" if is_notebook else _line_of_notebook(text)
    sources = _sources(path, notebook.translated(text) if raw else text, is_notebook)
    trees, refused = _parsed(sources, is_notebook)
    calls = _calls(trees)
    try:
        tasks, notes = _tasks_of(path, list(calls), task)
    except UnusableFile as problem:
        raise [*refused, problem][0] from None
    except Exception as error:
        raise Fault("the check of this task cannot be loaded.", traceback.format_exc()) from error
    if raw:
        notes = [f"The file has lines of a notebook, such as {raw}: {_RAW}", *notes]
    notes = [*([note] if note else []), *notes]
    own = guard or make()
    limits = limits or Limits()
    try:
        reports = []
        for one in tasks:
            own_part = _until(sources, trees, calls, one)
            report = _run(own, path, own_part, is_notebook, one, limits)
            # A program that stops early has not come to the answers in its last lines.
            answers = report.answers or _written_answers(own_part, trees)
            reports.append(replace(report, answers=answers))
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
    guard: Guard,
    path: Path,
    sources: list[tuple[str, str]],
    is_notebook: bool,
    task: Task,
    limits: Limits,
) -> Report:
    """Run the program, and judge its functions from here."""

    def why(otherwise: str) -> str:
        broken = guard.end()
        return limits.sentence(broken) if broken else otherwise

    with contextlib.ExitStack() as used:
        try:
            folder = used.enter_context(
                tempfile.TemporaryDirectory(prefix="canim-", ignore_cleanup_errors=True)
            )
            work = Path(folder).resolve() / "work"
            whole = copy_beside(path, [code for code, _ in sources], work)
            name = reading.python_name(path)
            (work / path.name).replace(work / name)
        except OSError as error:
            raise Fault(f"the program cannot be copied to where it runs: {error}.") from error
        order = {"task": task.id, "codes": sources, "file": name, "folder": str(work)}
        peer = Peer(guard.start(limits), _refuse)
        used.callback(guard.end)
        try:
            peer.ask(prepare=order | {"is_notebook": is_notebook})
        except Gone:
            if broken := guard.end():
                return _empty(task, limits.sentence(broken))
            what = "the process of the program ended before the program began."
            raise Fault(what, guard.said()) from None
        try:
            ran = peer.ask(run=True)
            crashes = tuple(crash(fields) for fields in ran["stopped"])
            missing = bool(ran["missing"])
            answers = {str(question): str(text) for question, text in ran["answers"].items()}
            remote = Remote(task, peer, lambda: why("ends the program instead of returning."))
            report = judge(task, remote)
        except Gone:
            return _empty(task, why("ended before its functions could be checked."))
        except Exception as error:
            return _empty(task, _not_compared(task, error))
    if crashes and not whole:
        report = replace(report, notes=(*report.notes, NOT_ALL_BESIDE))
    report = replace(report, early=missing, answers=answers)
    if is_notebook:
        return replace(report, cells=crashes)
    return replace(report, stopped=next(iter(crashes), None))


def _not_compared(task: Task, error: Exception) -> str:
    """Return what is said of results that our own code stops at.

    Raises
    ------
    Fault
        If it stops at right results too: then it is wrong, whatever the program sends.
    """
    right = {f.name: f.reference for f in task.functions if f.reference is not None}
    try:
        judge(task, Program(task, right))
    except Exception as own:
        what = f"the check of Task {task.id} stops at right results."
        raise Fault(what, "".join(traceback.format_exception(own))) from error
    # What a program that has changed numpy itself sends may be anything at all.
    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{type(error).__name__} in {Path(place.filename).name}, line {place.lineno}"
    return (
        "gives results that cannot be compared: it has changed Python or numpy, or the check "
        f"is wrong here ({where})."
    )


def _refuse(question: dict[str, Any]) -> dict[str, Any]:
    """Answer a question that no program of ours would ask."""
    raise Gone


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


def _parsed(
    sources: list[tuple[str, str]], is_notebook: bool
) -> tuple[list[ast.Module], list[UnusableFile]]:
    """Return the program as a tree, or each cell of the notebook that is Python, and why not."""
    trees, refused = [], []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Python gives them when the program is run
        for code, name in sources:
            try:
                trees.append(_parse(code, name, is_notebook))
            except UnusableFile as problem:
                # A cell that Python cannot read is told when the others are run.
                if not is_notebook:
                    raise
                refused.append(problem)
                trees.append(ast.Module([], []))
    return trees, refused


def _parse(code: str, name: str, is_notebook: bool) -> ast.Module:
    linecache.cache[name] = (len(code), None, code.splitlines(keepends=True), name)
    try:
        return notebook.parsed(code, name) if is_notebook else ast.parse(code, name)
    except SyntaxError as error:
        found = explain(error, lambda _: False)
        where = f"{name}, line {found.line}:\n{found.marked}"
        raise UnusableFile(f"{where}\n{found.sentence}") from None
    except (RecursionError, MemoryError):
        raise UnusableFile(f"{name} is nested too deep for Python to read.") from None
    except ValueError as error:
        raise UnusableFile(f"{name} is not a Python program: {error}.") from None


def _line_of_notebook(text: str) -> str:
    """Return the first line for IPython in a program that Python cannot read, or ""."""
    raw = re.search(r"^[ \t]*((?:!|%%?)[A-Za-z].*)$", text, re.MULTILINE)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python gives them when the program is run
            ast.parse(text)
    except SyntaxError:
        return raw[1] if raw else ""
    except (RecursionError, MemoryError, ValueError):
        pass  # `_parse` says it
    return ""


def _sources(path: Path, text: str, is_notebook: bool) -> list[tuple[str, str]]:
    if not is_notebook:
        return [(text, str(path))]
    try:
        cells = notebook.cells(text)
    except notebook.NoNotebook as problem:
        raise UnusableFile(f"{path} {problem}") from None
    return [(code, f"{path}, code cell {i}") for i, code in enumerate(cells, 1)]


def _calls(trees: list[ast.Module]) -> dict[str, tuple[int, int]]:
    """Return the tasks that the program checks, and the cell and line of each one's last call."""
    found = [
        (cell, call.end_lineno or call.lineno, _number(str(task)))
        for cell, call, task in reading.calls(*trees)
    ]
    return {task: (cell, line) for cell, line, task in sorted(found)}


def _number(text: str) -> str:
    """Return the number that a text such as "Task 1-1" means, or else the text."""
    meant = re.fullmatch(r"\s*(?:task)?\W*\d+\D\d+\s*", text, re.IGNORECASE)
    return (checks.number_in(text) if meant else "") or text


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


def _written_answers(sources: list[tuple[str, str]], trees: list[ast.Module]) -> dict[str, str]:
    """Return the answers as they stand in this part of the program, without running it."""
    return reading.answers(
        statement
        for (code, _), tree in zip(sources, trees, strict=False)
        for statement in tree.body
        if statement.lineno <= code.count("\n") + 1
    )


def _given(statement: ast.stmt) -> Iterator[str]:
    """Yield the names that a statement of the program gives to something."""
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        yield statement.name
        return
    for node in ast.walk(statement):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
