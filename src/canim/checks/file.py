"""Check a student's file, a program or a notebook, in a fresh process."""

from __future__ import annotations

import ast
import json
import linecache
import os
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from dataclasses import asdict
from pathlib import Path
from types import ModuleType
from typing import Any

import matplotlib

from canim import checks
from canim.checks.crash import Crash, explain
from canim.checks.picture import png
from canim.checks.report import Report, Result
from canim.checks.task import Task


class UnusableFile(Exception):
    """The file cannot be checked; the message says why."""


def check_file(
    path: Path,
    *,
    task: str | None = None,
    hint: int = 0,
    limit: float = 60,
    figure: Path | None = None,
) -> Report:
    """Run the file in a fresh process without windows and return the report on it.

    Parameters
    ----------
    path : Path
        A Python program or a Jupyter notebook.
    task : str, optional
        Number of the task; otherwise that of the file's call of ``canim.check``, or of
        its name.
    hint : int
        1 to show the hints of the mistakes that were recognised, 2 to show also the line of
        the pseudocode that each belongs to.
    limit : float
        Time in seconds after which the program is ended.
    figure : Path, optional
        Where to write a PNG picture of expected and got for the parts that differ.

    Raises
    ------
    UnusableFile
        If the file is not there, is not a task or cannot be read as Python, or the figure
        cannot be written.
    """
    found = _task_of(path, [tree for tree, _ in _parsed(path)], task)
    how_to_hint = (f"Type: {_command(path, task, 1)}", f"Type: {_command(path, task, 2)}")
    with tempfile.TemporaryDirectory() as folder:
        answer, drawn = Path(folder) / "report.json", Path(folder) / "figure.png"
        try:
            subprocess.run(
                # -P: a json.py of the student's must not take the place of Python's.
                [
                    sys.executable,
                    "-P",
                    "-m",
                    __name__,
                    path.resolve(),
                    found.id,
                    answer,
                    drawn if figure else "",
                ],
                cwd=path.resolve().parent,
                env=os.environ | {"MPLBACKEND": "agg", "PYTHONIOENCODING": "utf-8"},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=limit,
                check=False,
            )
        except subprocess.TimeoutExpired:
            reason = f"did not end within {limit:g} seconds. Is there a loop without an end?"
            return _empty(found, reason)
        if not answer.exists():
            return _empty(found, "ended before its functions could be checked.")
        told = json.loads(answer.read_text(encoding="utf-8"))
        if figure:
            told["notes"].append(_moved(drawn, figure))
    return Report(
        found,
        tuple(Result(**result) for result in told["results"]),
        notes=tuple(told["notes"]),
        changing=tuple(told["changing"]),
        show_hints=hint,
        how_to_hint=how_to_hint,
        stopped=told["stopped"] and Crash(**told["stopped"]),
        answers=told["answers"],
    )


def _moved(drawn: Path, figure: Path) -> str:
    """Put the picture, if there is one, where it is wanted; return a sentence on it."""
    if not drawn.exists():
        return "There is no picture: no part that differs is a curve, an image or a chain."
    try:
        shutil.copyfile(drawn, figure)
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


def _parsed(path: Path) -> list[tuple[ast.Module, str]]:
    """Return the program, or each cell of the notebook, as a tree and its name in messages."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Python gives them when the program is run
        return [_parse(code, name) for code, name in _sources(path)]


def _parse(code: str, name: str) -> tuple[ast.Module, str]:
    linecache.cache[name] = (len(code), None, code.splitlines(keepends=True), name)
    try:
        return ast.parse(code, name), name
    except SyntaxError as error:
        crash = explain(error, lambda _: False)
        where = f"{name}, line {crash.line}:\n{crash.marked}"
        raise UnusableFile(f"{where}\n{crash.sentence}") from None
    except ValueError as error:
        raise UnusableFile(f"{name} is not a Python program: {error}.") from None


def _sources(path: Path) -> list[tuple[str, str]]:
    if path.suffix not in (".py", ".ipynb"):
        raise UnusableFile(f"{path} is neither a .py nor an .ipynb file.")
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise UnusableFile(f"{path} is not there.") from None
    except UnicodeDecodeError:
        raise UnusableFile(f"{path} is not a text in UTF-8: save it as UTF-8.") from None
    except OSError as error:
        raise UnusableFile(f"{path} cannot be read: {error.strerror}.") from None
    if path.suffix == ".py":
        return [(text, str(path))]
    try:
        cells = [cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code"]
        codes = ["".join(cell["source"]) for cell in cells]
    except (ValueError, KeyError, TypeError):
        raise UnusableFile(f"{path} is not a Jupyter notebook.") from None
    return [(_python_of(code), f"{path}, code cell {i}") for i, code in enumerate(codes, 1)]


def _python_of(code: str) -> str:
    """Return a cell's code without lines for IPython, such as %pip and print?."""
    try:
        ast.parse(code)
    except (SyntaxError, ValueError):
        return re.sub(r"^([ \t]*)(?:[%!?].*|[^#\n]*\?)$", r"\1pass", code, flags=re.M)
    return code  # in Python, a line may begin with the operator %


def _task_of(path: Path, trees: list[ast.Module], asked: str | None) -> Task:
    if asked is not None:
        try:
            return checks.find(asked)
        except ValueError as error:
            raise UnusableFile(str(error)) from None
    calls = [
        node.args[0].value
        for tree in trees
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and ast.unparse(node.func) in ("canim.check", "check")
        and node.args
        and isinstance(node.args[0], ast.Constant)
    ]
    named = re.search(r"task[_ -]?(\d)[_. -](\d+)", path.name)
    for number in [*calls, *([f"{named[1]}.{named[2]}"] if named else [])]:
        if number in checks.TASKS:
            return checks.TASKS[str(number)]
    raise UnusableFile(f"{path} is not a task of the course: say which one with --task, as in 1.1.")


def _run_here(path: Path, task: Task, figure: str) -> dict[str, Any]:
    """Run the file in this process and return what the report needs, as JSON can hold it.

    What differs is drawn into the file `figure`, unless that is "".
    """
    # A window would wait until somebody closes it.
    vars(matplotlib)["use"] = lambda *args, **options: None
    # The file's own call would report twice, and end the program where a part crashes.
    checks.check = lambda *args, **functions: None
    parsed = _parsed(path)
    names = {name for _, name in parsed}
    module = ModuleType("__main__")
    if path.suffix == ".py":
        module.__file__ = str(path)
    sys.modules["__main__"] = module
    sys.argv = [str(path)]
    sys.path.insert(0, str(path.parent))
    stopped = None
    try:
        for tree, name in parsed:
            # The program must not inherit the __future__ import of this module.
            exec(compile(tree, name, "exec", dont_inherit=True), module.__dict__)
    except Exception as error:
        stopped = asdict(explain(error, lambda file_name: file_name in names))
    except SystemExit:
        pass
    report = checks.run(task, {name: vars(module).get(name) for name in task.names})
    if figure and report.drawings:
        Path(figure).write_bytes(png(report.drawings, titles=True))
    answers = vars(module).get("answers")
    return {
        "results": [asdict(result) for result in report.results],
        "notes": report.notes,
        "changing": report.changing,
        "stopped": stopped,
        "answers": _as_text(answers) if isinstance(answers, dict) else {},
    }


def _as_text(answers: dict[Any, Any]) -> dict[str, str]:
    return {str(question): str(text) for question, text in answers.items()}


if __name__ == "__main__":
    asked, number, answer, drawn = sys.argv[1:]
    told = _run_here(Path(asked), checks.find(number), drawn)
    Path(answer).write_text(json.dumps(told), encoding="utf-8")
    os._exit(0)  # a thread that the program left behind would go on
