"""Call a student's functions so that nothing they do disturbs the check."""

from __future__ import annotations

import contextlib
import inspect
import io
import linecache
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

from canim.checks.crash import Crash, cell_of, explain
from canim.checks.task import Data, Function, Task, Unusable

_OURS = str(Path(__file__).parents[1])
MOST_OUTPUT = 10_000_000


class Stopped(Exception):
    """A function could not be used; `problem` is a `Crash` or a sentence."""

    def __init__(self, name: str, problem: Crash | str) -> None:
        super().__init__(name)
        self.name = name
        self.problem = problem


class Program:
    """The functions and data of a student, of the reference or of a known mistake.

    Attributes are the names that the task registers. Every call gets copies of its
    arguments, is silent, and is made once for the same arguments.
    """

    def __init__(self, task: Task, names: Mapping[str, Any]) -> None:
        self._task = task
        self._names = names
        self._results: dict[tuple[Any, ...], tuple[tuple[Any, ...], Any]] = {}
        # What wraps a function, such as errstate, is the same code for all functions.
        self._canim_codes = {
            getattr(inspect.unwrap(f), "__code__", None) for f in task.canim_functions
        }
        # What is said of a function or of data that is not there.
        self.missing = "is missing: keep this name in your program."
        self.uses_canim: dict[str, None] = {}
        self.changes: dict[str, None] = {}

    def __getattr__(self, name: str) -> Any:
        for function in self._task.functions:
            if function.name == name:
                return lambda *args: self._call(function, *args)
        for data in self._task.data:
            if data.name == name:
                return self.value(data)
        raise AttributeError(name)

    @property
    def given(self) -> dict[str, Any]:
        """The student's data, and functions without a reference."""
        free = [f.name for f in self._task.functions if f.reference is None]
        return {name: self._names.get(name) for name in [*(d.name for d in self._task.data), *free]}

    def value(self, data: Data) -> Any:
        """Return the student's data of that name."""
        name = data.name
        if self._names.get(name) is None:
            raise Stopped(name, f"{name} {self.missing}")
        try:
            return data.accept(self._names[name])
        except Unusable as problem:
            raise Stopped(name, f"{name} {problem}") from None

    def _call(self, function: Function, *args: Any) -> Any:
        key = (function.name, *map(id, args))
        if key not in self._results:
            # The arguments are kept with the result: an id is only theirs while they live.
            self._results[key] = (args, self.call(function, *args))
        result = self._results[key][1]
        if isinstance(result, Stopped):
            raise result
        return result

    def call(self, function: Function, *args: Any) -> Any:
        """Return what the function returns, or where it stops."""
        call = self._names.get(function.name)
        if call is None:
            return Stopped(function.name, f"{function.name} {self.missing}")
        if not callable(call):
            return Stopped(function.name, f"{function.name} must be a function.")
        own = [a.copy() if isinstance(a, np.ndarray) else a for a in args]
        if problem := _other_values(call, function, own):
            return Stopped(function.name, problem)
        try:
            with _quiet(), self._watch(function.name):
                result = call(*own)
        except Stopped as stopped:
            # One of the student's functions was an argument: the fault is in that one.
            return stopped
        except Exception as error:
            return Stopped(function.name, crash_of(error, _is_students(call)))
        except SystemExit:
            return Stopped(function.name, f"{function.name} ends the program instead of returning.")
        if any(not _same(a, b) for a, b in zip(args, own, strict=True)):
            self.changes[function.name] = None
        try:
            return function.accept(result, *args)
        except Unusable as problem:
            return Stopped(function.name, f"{function.name} {problem}")

    @contextlib.contextmanager
    def _watch(self, name: str) -> Iterator[None]:
        # A profiler sees every call, however the student came by canim's function.
        before = sys.getprofile()
        if self._canim_codes and before is None:
            sys.setprofile(partial(self._see, name))
        try:
            yield
        finally:
            sys.setprofile(before)

    def _see(self, name: str, frame: FrameType, event: str, arg: Any) -> None:
        if event == "call" and frame.f_code in self._canim_codes:
            self.uses_canim[name] = None


def _other_values(call: Callable[..., Any], function: Function, args: list[Any]) -> Crash | None:
    """Return a crash at the first line of `call` if that takes other values than `args`."""
    try:
        inspect.signature(call).bind(*args)
    except ValueError:
        return None  # written in another language, it has no signature
    except TypeError as error:
        code: Any = getattr(inspect.unwrap(call), "__code__", None)
        number = code.co_firstlineno if code else 0
        line = linecache.getline(code.co_filename, number).strip() if code else ""
        words = f"It is called as {function.signature}: keep these values between its brackets."
        said = f"{words}\n(Python says: TypeError: {error})"
        return Crash(number, line, said, cell=cell_of(code.co_filename) if code else 0)
    return None


def _same(a: Any, b: Any) -> bool:
    # By their bytes: numpy's functions may have been replaced by the program.
    return not isinstance(a, np.ndarray) or (a.shape == b.shape and a.tobytes() == b.tobytes())


class TooMuchOutput(Exception):
    """The program prints more than anybody reads."""


class _Nowhere(io.RawIOBase):
    """Takes what is printed, and stops a program that prints without end."""

    def __init__(self) -> None:
        self._size = 0

    def writable(self) -> bool:
        return True

    def write(self, data: Any) -> int:
        self._size += len(data)
        if self._size > MOST_OUTPUT:
            self._size = 0
            raise TooMuchOutput
        return len(data)


def nowhere() -> io.TextIOWrapper:
    """Return a file for what nobody reads."""
    return io.TextIOWrapper(io.BufferedWriter(_Nowhere()), encoding="utf-8")


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    with warnings.catch_warnings(), contextlib.redirect_stdout(nowhere()):
        warnings.simplefilter("ignore")
        yield


def crash_of(error: BaseException, is_students: Callable[[str], bool]) -> Crash:
    """Return where and why the student's program failed."""
    crash = explain(error, is_students)
    if isinstance(error, TooMuchOutput):
        printed = (
            f"More than {MOST_OUTPUT // 10**6} MB are printed. Is there a loop without an end?"
        )
        return replace(crash, sentence=printed)
    return crash


def _is_students(call: Any) -> Callable[[str], bool]:
    """Return a test for the student's files: that of the function, none of canim's."""
    own = getattr(getattr(call, "__code__", None), "co_filename", "")
    return lambda file_name: file_name == own and not file_name.startswith(_OURS)
