"""What a student's program may take, and who sees to it: a guard for each system."""

from __future__ import annotations

import importlib
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from canim.checks.remote import Pipe

MOST_PROCESSES = 64
LARGEST_FILE = 100_000_000  # in bytes
# In seconds: to load what every program uses takes a few, on a slow network many.
START = 120.0
LONGEST_TOLD = 5000  # of what is said on standard error, in letters


class Fault(Exception):
    """The check itself failed, whatever the program: the message says what is known."""

    def __init__(self, what: str, said: str = "") -> None:
        """`said` is what the part that failed wrote on standard error."""
        super().__init__(what, said)
        self._what, self._said = what, said[-LONGEST_TOLD:].strip()

    def __str__(self) -> str:
        places = re.findall(r'File "([^"]+)", line (\d+)', self._said)
        ours = [(file, line) for file, line in places if "canim" in Path(file).parts]
        where = "".join(f" It stopped in {file}, line {line}." for file, line in ours[-1:])
        head = f"The check itself failed, no program is to blame: {self._what}{where}"
        return f"{head}\n{self._said}".strip()


@dataclass(frozen=True)
class Limits:
    """Time of a program in seconds, and its memory in megabytes."""

    seconds: float = 60
    megabytes: float = 2000

    def sentence(self, broken: str) -> str:
        """Return what is said of a program that broke the limit of this name."""
        return {
            "time": f"did not end within {self.seconds:g} seconds. Is there a loop without an end?",
            "memory": f"took more than {self.megabytes:g} MB of memory.",
            "processes": f"started more than {MOST_PROCESSES} programs.",
        }[broken]


class Guard(Protocol):
    """Starts one program at a time, in a process of its own, and ends it."""

    def start(self, limits: Limits) -> Pipe:
        """Start a process that waits for a program, and return the pipe to it.

        Raises
        ------
        Fault
            If there is no such process, or it does not come so far.
        """

    def said(self) -> str:
        """Return what was said on standard error, by our own part of the last process."""

    def end(self) -> str:
        """End the process and all that it has started; return the limit it broke, or ""."""

    def close(self) -> None:
        """End what is kept for the next program."""


def make(*, many: bool = False) -> Guard:
    """Return the guard for this system; for many programs it loads what most of them use."""
    guard: Any = importlib.import_module(f"canim.checks.guard_{os.name}")
    made: Guard = guard.Guard(many)
    return made


def environment() -> dict[str, str]:
    """Return the environment of a program: without windows, and the same for all programs."""
    kept = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    # Students' arrays are small: more threads would only take the time of other programs.
    one_thread = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    return kept | one_thread | {"MPLBACKEND": "agg", "PYTHONHASHSEED": "0"}


def be_silent() -> None:
    """Let nobody see what is written as an error from here on: it is the program's."""
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 2)
    os.close(silent)
