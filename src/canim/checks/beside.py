"""Copy what a program may use of the files beside it."""

from __future__ import annotations

import ast
import errno
import os
import re
import shutil
import warnings
from collections.abc import Iterator
from pathlib import Path

from canim.checks import notebook, reading

# Enough for pictures and a face, not for somebody's home.
MOST_BESIDE = 50_000_000  # in bytes
MOST_FILES_BESIDE = 500
_PROGRAMS = (".py", ".ipynb")
_PASSED_OVER = ("node_modules", "site-packages")
_ENVIRONMENT = (
    *("bin", "Scripts", "lib", "lib64", "Lib", "include", "Include", "share"),
    *("pyvenv.cfg", "CACHEDIR.TAG", ".lock"),
)
# A copy that fails for one of these fails for the disk, not for the file.
_OF_THE_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO, errno.EMFILE, errno.ENFILE)
# Calls whose texts name programs that are run.
_BY_NAME = ("import_module", "__import__", "run_path", "run_module", "run_line_magic")


def copy_beside(path: Path, codes: list[str], target: Path) -> bool:
    """Copy a program, and what it may use of the files beside it, to a new folder.

    Programs beside it come along where the program has their name in it, with all that they
    import; other files and folders as long as they are few and small. Returns whether there
    was room for all of them.

    Raises
    ------
    OSError
        If the new folder cannot be written.
    """
    target.mkdir()
    shutil.copy(path, target)
    programs, others = _files(path)
    room, count, whole = MOST_BESIDE, 0, True
    for entry in [*_used(path, codes, programs), *others]:
        try:
            size = entry.stat().st_size
            # Copying a pipe or a device may never end.
            if not entry.is_file():
                continue
            if size > room or count == MOST_FILES_BESIDE:
                whole = False
                continue
            copied = target / entry.relative_to(path.parent)
            copied.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(entry, copied)
            room -= size
            count += 1
        except OSError as error:
            if error.errno in _OF_THE_DISK:
                raise
            # Otherwise the program will say that it misses this file, if it does.
    return whole


def _files(path: Path) -> tuple[list[Path], list[Path]]:
    """Return the programs and the other files beside this one, of every folder in order."""
    programs: list[Path] = []
    others: list[Path] = []
    for folder, folders, names in os.walk(path.parent):
        folders[:] = sorted(
            n
            for n in folders
            if not n.startswith((".", "__"))
            and n not in _PASSED_OVER
            and not is_of_environment(Path(folder, n))
        )
        for name in sorted(names):
            entry = Path(folder, name)
            if entry != path and not is_of_environment(entry):
                (programs if entry.suffix.lower() in _PROGRAMS else others).append(entry)
    return programs, others


def is_of_environment(path: Path) -> bool:
    """Tell whether this is a part of an environment of Python, not what somebody put there."""
    return path.name in _ENVIRONMENT and os.path.isfile(path.parent / "pyvenv.cfg")


def _used(path: Path, codes: list[str], programs: list[Path]) -> list[Path]:
    """Return the programs that this one names, and all that they import."""
    text = "\n".join(codes)
    named = [p for p in programs if re.search(rf"\b{re.escape(p.stem)}\b", text)]
    return _with_imports(path, codes, named, programs)


def modules_of(path: Path) -> list[Path]:
    """Return the programs beside this one that it imports, and those that they import."""
    return _with_imports(path, _codes(path), [], _files(path)[0])


def _with_imports(
    path: Path, codes: list[str], named: list[Path], programs: list[Path]
) -> list[Path]:
    """Return the named programs, and all that they and the one at `path` import."""
    top, words = path.parent, set(re.findall(r"\w+", "\n".join(codes)))
    # A program may look for modules in folders that it names.
    folders = {f for p in programs for f in p.parents if f.is_relative_to(top) and f.name in words}
    used = list(named)
    waiting = [(path, codes), *((p, _codes(p)) for p in used)]
    while waiting:
        importing, codes = waiting.pop()
        names = set(_imported(codes))
        above = {f for f in importing.parents if f.is_relative_to(top)}
        new = [
            p
            for p in programs
            if p not in used and any(_module(p, place) in names for place in above | folders)
        ]
        used += new
        waiting += [(p, _codes(p)) for p in new]
    return used


def _module(program: Path, place: Path) -> str:
    """Return the name by which this program, or the package it is in, is imported from there."""
    if not program.is_relative_to(place):
        return ""
    return program.relative_to(place).with_suffix("").parts[0]


def _codes(program: Path) -> list[str]:
    """Return the texts of a program, or of a notebook's cells; none where it cannot be read."""
    try:
        if not program.is_file():
            return []
        text, _ = reading.read(program)
        return notebook.cells(text) if reading.kind(program) == ".ipynb" else [text]
    except (reading.UnusableFile, notebook.NoNotebook):
        return []


def _imported(codes: list[str]) -> Iterator[str]:
    """Yield the first names of all modules that are imported, and of programs that are run."""
    for code in codes:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                nodes = list(ast.walk(notebook.parsed(code, "")))
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
        for node in nodes:
            match node:
                case ast.Import(names):
                    yield from (alias.name.partition(".")[0] for alias in names)
                case ast.ImportFrom(module, names):
                    yield (module or "").partition(".")[0]
                    yield from (alias.name for alias in names if not module)
                case ast.Call(ast.Name(name) | ast.Attribute(_, name), args) if name in _BY_NAME:
                    texts = [str(arg.value) for arg in args if isinstance(arg, ast.Constant)]
                    for word in " ".join(texts).split():
                        yield from (word.partition(".")[0], Path(word).stem)
