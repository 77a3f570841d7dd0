"""Checks that tell a student what is right, what is missing and what to look at.

`TASKS` is the registry of the course's tasks; cards, index, command line and tests are
made from it. `show` displays a report: it may be replaced to display it elsewhere.
"""

from __future__ import annotations

import importlib
import pkgutil
import re
from collections.abc import Iterator, Mapping
from typing import Any

from canim.checks import report as _report
from canim.checks.report import Report
from canim.checks.run import run
from canim.checks.task import BLOCKS, Task

__all__ = ["BLOCKS", "TASKS", "Report", "Task", "check", "find", "run", "show"]


class _Tasks(Mapping[str, Task]):
    """The tasks by number; one is loaded when it is asked for, since some need scipy."""

    def __init__(self) -> None:
        found = [module.name for module in pkgutil.iter_modules(__path__)]
        numbers = (name.split("_")[1:] for name in found if name.startswith("task_"))
        self._ids = [".".join(number) for number in sorted(numbers, key=lambda n: [*map(int, n)])]

    def __getitem__(self, task: str) -> Task:
        if task not in self._ids:
            raise KeyError(task)
        module = importlib.import_module(f"{__name__}.task_{task.replace('.', '_')}")
        found: Task = module.TASK
        return found

    def __contains__(self, task: object) -> bool:
        return task in self._ids

    def __iter__(self) -> Iterator[str]:
        return iter(self._ids)

    def __len__(self) -> int:
        return len(self._ids)


TASKS = _Tasks()

show = _report.show


class _End(Exception):
    """Ends a notebook's cell without a traceback: the report has said what is wrong."""

    def _render_traceback_(self) -> list[str]:
        return []


def find(task: str) -> Task:
    """Return the task with this number, such as "1.1".

    Raises
    ------
    TypeError
        If `task` is not a text.
    ValueError
        If there is no such task.
    """
    if not isinstance(task, str):
        raise TypeError(f'task must be a text such as "1.1", but is {task!r}.')
    if task not in TASKS:
        meant = number_in(task)
        words = f"Do you mean {meant!r}?" if meant else f"There are {', '.join(TASKS)}."
        raise ValueError(f"There is no task {task!r}. {words}")
    return TASKS[task]


def number_in(text: str) -> str:
    """Return the number of the task that a text such as "1,1" or "Task 1-1" means, or ""."""
    numbers = re.findall(r"\d+", text)
    if len(numbers) == 1:
        numbers = [numbers[0][:1], numbers[0][1:]]
    number = ".".join(digits.lstrip("0") or "0" for digits in numbers)
    return number if number in TASKS else ""


def check(task: str, *, hint: int = False, **functions: Any) -> None:
    """Show what is right, what is missing and what to look at in a student's program.

    Where a function crashes, or returns what cannot be drawn, the program ends here.

    Parameters
    ----------
    task : str
        Number of the task, such as "1.1".
    hint : bool or int
        Whether to show the hints of the mistakes that were recognised; with 2 also the line
        of the pseudocode that each belongs to.
    **functions
        The functions, and for some tasks the data, that the task asks for, by name.

    Raises
    ------
    ValueError
        If there is no such task, or `hint` is none of the above.
    TypeError
        If `task` is not a text, or the task does not know one of the names.

    Examples
    --------
    >>> import canim
    >>> from canim.interpolation import hermite_basis
    >>> canim.check("1.1", hermite_basis=hermite_basis)
    Task 1.1: Draw the four Hermite curves
      ✓ H0, start value  done
      ✓ H1, end value    done
      ✓ H2, start slope  done
      ✓ H3, end slope    done
      hermite_basis uses canim's function.
    All checks of Task 1.1 pass.
    """
    found = find(task)
    if hint not in (0, 1, 2):
        raise ValueError(f"hint must be False, True or 2, but is {hint!r}.")
    for name in functions:
        if name not in found.names:
            raise TypeError(
                f"Task {task} has nothing called {name}; it checks {', '.join(found.names)}."
            )
    report = run(found, functions, hint=hint)
    show(report)
    if report.broken:
        raise _End if _report.in_notebook() else SystemExit(1)
