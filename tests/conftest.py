"""What more than one folder of tests uses."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import hypothesis
import pytest

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "docs/_ext"), str(ROOT / "docs")]
os.environ["MPLBACKEND"] = "agg"
# The same examples in every run; what new ones bring to light becomes an @example. A busy
# machine makes any single one slow.
hypothesis.settings.register_profile("same", derandomize=True, database=None, deadline=None)
slow = [hypothesis.HealthCheck.too_slow]
hypothesis.settings.register_profile(
    "search", deadline=None, max_examples=2000, suppress_health_check=slow
)
hypothesis.settings.load_profile("same")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--renew", action="store_true", help="write tests/checks/hints.txt anew")


@pytest.fixture(scope="session")
def kept_guard() -> Iterator[Any]:
    """One guard for all tests: what programs import is loaded once."""
    from canim.checks import guard

    kept = guard.make(many=True)
    yield kept
    kept.close()


@pytest.fixture
def one_guard(kept_guard: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `canim check FILE` use the guard that is kept."""
    from canim.checks import file

    lent = SimpleNamespace(start=kept_guard.start, end=kept_guard.end, close=lambda: None)
    monkeypatch.setattr(file, "make", lambda: lent)


@pytest.fixture(scope="session")
def root() -> Path:
    """The folder of the project."""
    return ROOT


@cache
def _completed() -> dict[str, str]:
    import solutions

    return solutions.completed(ROOT)


@pytest.fixture(scope="session")
def completed() -> dict[str, str]:
    """File name and text of every starter with its model solution in it."""
    return _completed()


@cache
def _solved(file_name: str) -> dict[str, Any]:
    import matplotlib.pyplot as plt

    from canim import checks

    program = ModuleType("solved")
    show, checks.show = checks.show, lambda report: None
    try:
        # A program may write files into the folder it runs in.
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            exec(compile(_completed()[file_name], file_name, "exec"), vars(program))
    finally:
        checks.show = show
        plt.close("all")
    return vars(program)


@pytest.fixture(scope="session")
def solved():
    """Return, for a task, the names that its model solution defines."""

    def names(task) -> dict[str, Any]:
        program = _solved(task.file_name)
        return {name: program[name] for name in task.names}

    return names
