"""The student's process: runs the program and calls its functions when asked."""

from __future__ import annotations

import linecache
import os
import sys
import tempfile
from contextlib import suppress
from dataclasses import asdict
from types import ModuleType
from typing import Any

import matplotlib
from matplotlib import pyplot
from matplotlib.backend_bases import FigureCanvasBase

from canim import checks
from canim.checks.crash import Crash
from canim.checks.program import Program, Stopped, crash_of, nowhere
from canim.checks.remote import Gone, Peer, Pipe, told
from canim.checks.task import Task

CHANGED = "cannot be checked: the program has changed Python or numpy themselves."
FULL = "returns more than the memory can hold."
EARLY = "is not there: the program ends before it comes to this name."


def serve(pipe: Pipe) -> None:
    """Run the program that is sent, then call its functions, until nobody asks any more."""
    with suppress(Gone):
        Peer(pipe, _Student().answer).serve()


class _Student:
    """A program that has run: its functions and data."""

    def __init__(self) -> None:
        self._task: Task
        self._program: Program

    def answer(self, question: dict[str, Any]) -> dict[str, Any]:
        if "run" in question:
            return self._run(**question["run"])
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

    def _run(
        self, task: str, codes: list[tuple[str, str]], file: str, folder: str
    ) -> dict[str, Any]:
        """Run the program; return where it stopped, and its answers."""
        _let_nothing_wait()
        _work_in(folder)
        found = checks.find(task)
        module = ModuleType("__main__")
        if file.endswith(".py"):
            module.__file__ = os.path.abspath(file)
        sys.modules["__main__"] = module
        sys.argv = [file]
        sys.path.insert(0, os.getcwd())
        for code, name in codes:
            linecache.cache[name] = (len(code), None, code.splitlines(keepends=True), name)
        stopped: Crash | None = None
        early = True
        names = {name for _, name in codes}
        try:
            for code, name in codes:
                # The program must not inherit the __future__ import of this module.
                exec(compile(code, name, "exec", dont_inherit=True), vars(module))
            early = False
        except SystemExit:
            pass
        except BaseException as error:
            stopped = crash_of(error, names.__contains__)
        self._task = found
        self._program = Program(found, {name: vars(module).get(name) for name in found.names})
        if early:
            self._program.missing = EARLY
        answers = vars(module).get("answers")
        return {
            "stopped": stopped and asdict(stopped),
            "missing": [name for name in found.names if name not in vars(module)],
            "answers": _as_text(answers) if isinstance(answers, dict) else {},
        }


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


def _let_nothing_wait() -> None:
    """Nobody is there to close a window, to press a key or to read what is printed."""
    pyplot.switch_backend("agg")
    vars(matplotlib)["use"] = _nothing
    vars(pyplot)["switch_backend"] = _nothing
    FigureCanvasBase.start_event_loop = _nothing  # type: ignore[method-assign]
    sys.stdout, sys.stderr = nowhere(), nowhere()
    # The file's own call would report twice, and end the program where a part crashes.
    checks.check = _nothing
