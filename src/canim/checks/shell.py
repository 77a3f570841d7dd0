"""What a program finds in Jupyter: ``get_ipython()``, ``display``, IPython where it is missing.

All this runs beside the student's program, in its process. Commands for the terminal are not
carried out, nothing is installed, and nobody sees what is displayed.
"""

from __future__ import annotations

import builtins
import importlib
import importlib.util
import inspect
import os
import re
import shlex
import sys
import timeit
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import CodeType, ModuleType, SimpleNamespace
from typing import Any

from canim.checks import notebook

# What nbconvert writes when it makes a program of a notebook.
_EXPORTED = re.compile(
    r"^# In\[[ \d]*\]:|get_ipython\(\)\.(?:\w+_magic|magic|system|getoutput)\(", re.M
)
# Modules of IPython that programs import from, and what they import with a star.
_MODULES = (
    *("IPython", "IPython.core", "IPython.core.display", "IPython.core.interactiveshell"),
    *("IPython.core.magic", "IPython.display", "IPython.lib", "IPython.lib.display"),
)
_STARRED = ("HTML", "Image", "Latex", "Markdown", "Math", "clear_output", "display")


class _Unseen:
    """Stands for anything that is displayed or set up: takes all, and does nothing."""

    stdout = stderr = ""

    def __init__(self, *args: Any, **options: Any) -> None:
        """Take what is given, and do nothing."""

    def __call__(self, *args: Any, **options: Any) -> _Unseen:
        return self

    def __getattr__(self, name: str) -> _Unseen:
        if name.startswith("_"):
            raise AttributeError(name)
        return self


class _Lines(list[str]):
    """What a command for the terminal has printed: nothing, whatever form is asked for."""

    n = s = nlstr = spstr = ""

    def grep(self, *args: Any, **options: Any) -> _Lines:
        """Return the lines that fit: none."""
        return self

    fields = sort = grep  # type: ignore[assignment]


class Shell(_Unseen):
    """Stands for Jupyter's shell beside a program whose names are `user_ns`."""

    def __init__(self, names: dict[str, Any]) -> None:
        self.user_ns = names
        self.config: dict[str, Any] = {"IPKernelApp": {}}

    def run_line_magic(self, name: str, line: str = "", *_: Any) -> Any:
        """Carry out a magic, if it is one of those that a program may need."""
        line = self._filled(line).strip()
        match name:
            case "run":
                self._run(shlex.split(line.replace("\\", "/")))
            case "cd":
                with suppress(OSError):  # Jupyter prints why, and goes on
                    os.chdir(os.path.expanduser(line.removeprefix("-q").strip(" '\"") or "~"))
            case "pwd":
                return os.getcwd()
            case "env" | "set_env":
                return _environment(line)
            case "pylab":
                exec("from pylab import *\nimport numpy as np\nimport pylab as plt", self.user_ns)
            case "timeit":
                return self._timed(line)
            case _ if name in notebook.TIMED:
                self.run_cell(f"%{name} {line}")
        return None

    def run_cell_magic(self, name: str, line: str, cell: str) -> None:
        """Write a file, or run a cell of Python; cells of other kinds are passed over."""
        if name in ("writefile", "file"):
            line = self._filled(line).strip()
            name = re.sub(r"^(-a|--append)\s+", "", line)
            path = Path(name.strip("'\"")).expanduser()
            with path.open("w" if name == line else "a", encoding="utf-8") as file:
                file.write(cell)
        elif name in notebook.PYTHON_CELLS:
            self.run_cell(f"%%{name} {line}\n{cell}")

    def run_cell(self, code: str, *_: Any, **options: Any) -> None:
        """Run lines as those of a cell."""
        exec(compile(notebook.parsed(code, "<cell>"), "<cell>", "exec"), self.user_ns)

    def magic(self, line: str) -> Any:
        """Carry out a magic, as older versions of nbconvert write it."""
        name, _, rest = line.lstrip("%").partition(" ")
        return self.run_line_magic(name, rest)

    def getoutput(self, *args: Any, **options: Any) -> list[str]:
        """Return no lines: the command is not carried out."""
        return _Lines()

    def captured(self) -> _Unseen:
        """Return what a cell has printed, which nobody keeps."""
        return _Unseen()

    def _filled(self, line: str) -> str:
        """Return a line with the program's own values for names such as {name} and $name."""

        def value(name: re.Match[str]) -> str:
            return str(self.user_ns.get(name[1] or name[2], name[0]))

        return re.sub(r"\{(\w+)\}|\$(\w+)", value, line)

    def _run(self, words: list[str]) -> None:
        """Run a program or a notebook, and take over its names."""
        options = [word for word in words if word.startswith("-")]
        name = next((word for word in words if word not in options), "")
        if not name:
            return
        path = Path(name)
        if not path.is_file() and path.suffix not in (".py", ".ipynb"):
            path = Path(f"{name}.py")
        sys.path.insert(0, str(path.parent.absolute()))
        if path.suffix == ".ipynb":
            for code in notebook.cells(path.read_text(encoding="utf-8")):
                self.run_cell(code)
            return
        own = {"__name__": "__main__", "__file__": str(path)}
        names = self.user_ns if "-i" in options else own
        with suppress(SystemExit):
            exec(compile(path.read_bytes(), str(path), "exec", dont_inherit=True), names)
        self.user_ns.update({k: v for k, v in names.items() if not k.startswith("__")})

    def _timed(self, line: str) -> SimpleNamespace:
        """Return how long a statement takes, in the words of %timeit."""
        seconds = timeit.timeit(
            notebook.translated(f"%timeit {line}"), globals=self.user_ns, number=1
        )
        times = {"average": seconds, "best": seconds, "worst": seconds, "stdev": 0.0}
        return SimpleNamespace(**times, all_runs=[seconds], loops=1, repeat=1)


def _environment(line: str) -> Any:
    name, *value = re.split(r"\s*=\s*|\s+", line, maxsplit=1)
    if value:
        os.environ[name] = value[0]
    return os.environ.get(name) if name else dict(os.environ)


def open_shell(codes: list[tuple[str, str]], names: dict[str, Any], is_notebook: bool) -> None:
    """Let a notebook, or a program that was made from one, find what Jupyter would give it.

    Where IPython is not installed, every program finds what it may import from there.
    """
    text = "\n".join(code for code, _ in codes)
    shell = Shell(names) if is_notebook or _EXPORTED.search(text) else None
    if shell:
        vars(builtins).update({"get_ipython": lambda: shell, "display": _Unseen()})
    if is_notebook:
        names.update({"_": "", "In": ["", *(code for code, _ in codes)], "Out": {}})
    if "IPython" not in text:
        return
    if not importlib.util.find_spec("IPython"):
        _stand_in()
    if shell:
        vars(importlib.import_module("IPython"))["get_ipython"] = lambda: shell


class _StandIn(ModuleType):
    """Stands for a module that is not installed, and has all that a program asks it for."""

    __all__ = _STARRED

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return type(name, (_Unseen,), {}) if name[0].isupper() else _Unseen()


def _stand_in() -> None:
    """Let programs import what they use of IPython, which does nothing."""
    for name in _MODULES:
        sys.modules[name] = _StandIn(name)
        above, _, own = name.rpartition(".")
        if above:
            setattr(sys.modules[above], own, sys.modules[name])
    # matplotlib asks for both.
    vars(sys.modules["IPython"]).update(get_ipython=lambda: None, version_info=(9, 0))


def runner(codes: list[tuple[str, str]]) -> Callable[[CodeType, dict[str, Any]], Any]:
    """Return what runs a cell: where cells may wait for each other, in a loop of events."""
    if not any(word in code for code, _ in codes for word in ("async", "await")):
        return eval
    from asyncio import Runner

    async def run(code: CodeType, names: dict[str, Any]) -> None:
        result = eval(code, names)
        if code.co_flags & inspect.CO_COROUTINE:
            await result

    loop = Runner()
    return lambda code, names: loop.run(run(code, names))
