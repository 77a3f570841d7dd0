"""The student's process: runs the program and calls its functions when asked."""

from __future__ import annotations
import __future__

import ast
import linecache
import os
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, replace
from types import CodeType, ModuleType
from typing import Any

import matplotlib
from matplotlib import pyplot
from matplotlib.backend_bases import FigureCanvasBase

from canim import checks
from canim.checks.crash import Crash, cell_of
from canim.checks.notebook import parsed
from canim.checks.program import Program, Stopped, crash_of, nowhere
from canim.checks.remote import Gone, Peer, Pipe, told
from canim.checks.shell import open_shell, runner
from canim.checks.task import Task

CHANGED = "cannot be checked: the program has changed Python or numpy themselves."
FULL = "returns more than the memory can hold."
EARLY = "is not there: the program ends before it comes to this name."
EARLY_CELL = "is not there: a cell stops before it comes to this name."


def serve(pipe: Pipe, begins: Callable[[], None]) -> None:
    """Run the program that is sent, then call its functions, until nobody asks any more.

    `begins` is called when all is done that is ours, before the program's first line.
    """
    with suppress(Gone):
        Peer(pipe, _Student(begins).answer).serve()


class _Student:
    """A program that has run: its functions and data."""

    def __init__(self, begins: Callable[[], None]) -> None:
        self._begins = begins
        self._task: Task
        self._program: Program
        self._codes: list[tuple[str, str]]
        self._names: dict[str, Any]
        self._is_notebook: bool
        self._flags: int
        self._run_code: Callable[[CodeType, dict[str, Any]], Any]

    def answer(self, question: dict[str, Any]) -> dict[str, Any]:
        if "prepare" in question:
            return self._prepare(**question["prepare"])
        if "run" in question:
            return self._run()
        program = self._program
        task = self._task
        try:
            if "data" in question:
                (data,) = (d for d in task.data if d.name == question["data"])
                found = program.value(data)
            else:
                (function,) = (f for f in task.functions if f.name == question["call"])
                found = program.call(function, *question["args"])
        except Stopped as stopped:
            found = stopped
        except Exception as error:
            name = question.get("data") or question["call"]
            found = Stopped(name, f"{name} {FULL if isinstance(error, MemoryError) else CHANGED}")
        reply = told(found) if isinstance(found, Stopped) else {"value": found}
        seen = {"uses_canim": list(program.uses_canim), "changes": list(program.changes)}
        return reply | seen

    def _prepare(
        self, task: str, codes: list[tuple[str, str]], file: str, folder: str, is_notebook: bool
    ) -> dict[str, Any]:
        """Do all that is ours before the program begins: what fails here is our failure."""
        _let_nothing_wait()
        _work_in(folder)
        self._task = checks.find(task)
        self._codes = codes
        self._is_notebook = is_notebook
        self._flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
        module = ModuleType("__main__")
        if not is_notebook:
            module.__file__ = os.path.abspath(file)
        sys.modules["__main__"] = module
        self._names = vars(module)
        sys.argv = [file]
        for code, name in codes:
            linecache.cache[name] = (len(code), None, code.splitlines(keepends=True), name)
        open_shell(codes, self._names, is_notebook)
        self._run_code = runner(codes) if is_notebook else eval
        # From here on, a file of the student's may take the place of one of ours.
        sys.path.insert(0, os.getcwd())
        sys.stderr = nowhere()
        self._begins()
        return {}

    def _run(self) -> dict[str, Any]:
        """Run the program; return where it stopped, and its answers."""
        names = self._names
        stopped: list[Crash] = []
        # As in Jupyter, the cells below one that fails can be run.
        ended = [self._run_one(*cell, stopped) for cell in self._codes]
        self._program = Program(self._task, {name: names.get(name) for name in self._task.names})
        if not all(ended):
            self._program.missing = EARLY_CELL if self._is_notebook else EARLY
        answers = names.get("answers")
        return {
            "stopped": [asdict(crash) for crash in stopped],
            "missing": [name for name in self._task.names if name not in names],
            "answers": _as_text(answers) if isinstance(answers, dict) else {},
        }

    def _run_one(self, code: str, name: str, stopped: list[Crash]) -> bool:
        """Run the program or a cell, and tell whether it came to its end."""
        own = {name for _, name in self._codes}
        try:
            self._run_code(self._compiled(code, name), self._names)
        except SystemExit:
            return False
        except BaseException as error:
            crash = crash_of(error, own.__contains__)
            stopped.append(replace(crash, cell=crash.cell or cell_of(name)))
            return False
        finally:
            if self._is_notebook:
                _close_windows()  # as Jupyter does
        return True

    def _compiled(self, code: str, name: str) -> CodeType:
        # The program must not inherit the __future__ import of this module.
        if not self._is_notebook:
            return compile(code, name, "exec", dont_inherit=True)
        made: CodeType = compile(parsed(code, name), name, "exec", self._flags, dont_inherit=True)
        # As in Jupyter, what a cell imports from __future__ holds for those below.
        self._flags |= made.co_flags & __future__.annotations.compiler_flag
        return made


def _work_in(folder: str) -> None:
    """Let the program run in `folder`, with a folder for temporary files beside it."""
    temporary = os.path.join(os.path.dirname(folder), "temporary")
    os.mkdir(temporary)
    os.environ.update(TMPDIR=temporary, TEMP=temporary, TMP=temporary)
    tempfile.tempdir = None
    os.chdir(folder)
    sys.dont_write_bytecode = True


def _as_text(answers: dict[Any, Any]) -> dict[str, str]:
    return {str(question): str(text) for question, text in answers.items()}


def _nothing(*args: Any, **options: Any) -> None:
    """Do nothing, whatever is asked."""


def _shown(*, block: bool | None = None) -> None:
    """Go on where somebody would have closed the windows: the next may have their names."""
    if block or (block is None and not pyplot.isinteractive()):
        _close_windows()


def _close_windows() -> None:
    with suppress(Exception):  # the program may have changed what draws
        pyplot.close("all")


def _let_nothing_wait() -> None:
    """Nobody is there to close a window, to press a key or to read what is printed."""
    pyplot.switch_backend("agg")
    vars(matplotlib)["use"] = _nothing
    vars(pyplot)["switch_backend"] = _nothing
    vars(pyplot)["show"] = _shown
    FigureCanvasBase.start_event_loop = _nothing  # type: ignore[method-assign]
    sys.stdout = nowhere()
    # The file's own call would report twice, and end the program where a part crashes.
    checks.check = _nothing
