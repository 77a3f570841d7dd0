"""Check all programs and notebooks of a folder, several at the same time."""

from __future__ import annotations

import csv
import errno
import json
import os
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from canim.checks.file import SUFFIXES, UnusableFile, check_file
from canim.checks.guard import Guard, Limits, make
from canim.checks.report import STATES, Report, stops

# One line of a class report: a part of a file.
Row = dict[str, Any]
ONE_BY_ONE = (
    "The files are checked one after another. To check several at the same time, install "
    'joblib:\npython -m pip install "canim[class]"'
)
_PASSED_OVER = ("node_modules", "site-packages")
# Letters that a spreadsheet would take for the beginning of a formula.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def check_folder(
    folder: Path | str,
    *,
    task: str | None = None,
    limits: Limits | None = None,
    jobs: int = -1,
    progress: Callable[[int, int], None] = lambda done, all_files: None,
) -> list[Row]:
    """Check every ``.py`` and ``.ipynb`` file below a folder.

    The rows are the same for any number of jobs. joblib hands the files out: with its
    ``parallel_config`` they go to another machine, which has to see the folder at the same
    place. Without joblib, one file is checked after another.

    Parameters
    ----------
    folder : Path or str
        The folder; hidden folders in it are passed over.
    task : str, optional
        Number of the task of all files; otherwise each file says its own.
    limits : Limits, optional
        The time and the memory that each program may take.
    jobs : int
        Number of files that are checked at the same time; -1: one for each core.
    progress : callable
        Is called with the number of files that are checked, and of all files.

    Returns
    -------
    list of dict
        One row for each file and part: ``file``, ``task``, ``part``, ``result``,
        ``message``, ``mistake``, ``hint``, ``passed`` (whether the whole file is done),
        ``notes`` on the whole file, and its ``answers``.
    """
    files = list(find(Path(folder)))
    given = [(str(path.absolute()), path.relative_to(folder).as_posix(), task) for path in files]
    limits = limits or Limits()
    rows: list[Row] = []
    progress(0, len(files))
    for done, checked in enumerate(_checked(given, limits, jobs), 1):
        rows += checked
        progress(done, len(files))
    order = {path.relative_to(folder).as_posix(): i for i, path in enumerate(files)}
    return sorted(rows, key=lambda row: order[row["file"]])  # the rows of a file keep theirs


def find(folder: Path) -> Iterator[Path]:
    """Yield the programs and notebooks below `folder`, in order."""
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(
            name
            for name in folders
            if not name.startswith((".", "__")) and name not in _PASSED_OVER
        )
        for name in sorted(names):
            path = Path(place, name)
            # Reading from a pipe or a device may never end.
            if path.suffix in SUFFIXES and not name.startswith(".") and path.is_file():
                yield path


def can_share() -> bool:
    """Tell whether joblib is there to hand out the files."""
    try:
        import joblib  # noqa: F401
    except ImportError:
        return False
    return True


def _checked(
    given: list[tuple[str, str, str | None]], limits: Limits, jobs: int
) -> Iterator[list[Row]]:
    """Yield the rows of each file, in any order."""
    if jobs == 1 or not can_share():
        try:
            for one in given:
                yield check_one(*one, limits)
        finally:
            _close_guard()
        return
    import joblib

    parallel = joblib.Parallel(n_jobs=jobs, return_as="generator_unordered")
    yield from parallel(joblib.delayed(check_one)(*one, limits) for one in given)


_guard: Guard | None = None
_guard_in_use = threading.Lock()


def check_one(path: str, name: str, task: str | None, limits: Limits) -> list[Row]:
    """Return the rows of one file, which are called `name` there, whatever happens."""
    global _guard
    # A worker of joblib's may be a thread; what is printed is a matter of the whole process.
    with _guard_in_use:
        _guard = _guard or make(many=True)
        try:
            return _rows(name, check_file(Path(path), task=task, limits=limits, guard=_guard))
        except UnusableFile as problem:
            message = str(problem).replace(path, "").lstrip(" ,")
        except Exception as error:
            message = f"could not be checked: {type(error).__name__}: {error}"
    return [_row(name, result="not checked", message=_line(message))]


def _close_guard() -> None:
    global _guard
    with _guard_in_use:
        if _guard:
            _guard.close()
        _guard = None


def _rows(name: str, report: Report) -> list[Row]:
    notes = list(report.notes)
    if report.stopped:
        notes.insert(0, f"The program {stops(report.stopped)}")
    return [
        _row(
            name,
            task=report.task.id,
            part=result.part,
            result=STATES[result.state][1],
            message=_line(result.message),
            mistake=result.mistake,
            hint=result.hint,
            passed=report.done,
            notes=" ".join(map(_line, notes)),
            answers=report.answers or {},
        )
        for result in report.results
    ]


def _row(name: str, **known: Any) -> Row:
    texts = ("task", "part", "result", "message", "mistake", "hint")
    empty = {"file": name} | dict.fromkeys(texts, "") | {"passed": False, "notes": ""}
    return empty | {"answers": {}} | known


def _line(text: str) -> str:
    return " ".join(word for word in text.split() if set(word) != {"^"})


def summary(rows: list[Row]) -> list[str]:
    """Return a line for each file, and one for all of them."""
    files: dict[str, list[Row]] = {}
    for row in rows:
        files.setdefault(row["file"], []).append(row)
    lines = []
    for name, parts in files.items():
        if not parts[0]["task"]:
            lines.append(f"{name}: {parts[0]['message']}")
            continue
        done = sum(row["result"] == "done" for row in parts)
        lines.append(f"{name}: Task {parts[0]['task']}, {done} of {len(parts)} parts done")
    passed = sum(parts[0]["passed"] for parts in files.values())
    return [*lines, f"All parts are done in {passed} of {len(files)} files."]


def write(rows: list[Row], path: Path) -> None:
    """Write the rows as CSV, for a spreadsheet, or as JSON."""
    unfinished = _unfinished(path)
    try:
        (_write_json if path.suffix == ".json" else _write_csv)(rows, unfinished)
        unfinished.replace(path)  # what was there before stays until the new table is whole
    finally:
        unfinished.unlink(missing_ok=True)


def make_room(path: Path) -> None:
    """Raise OSError if `write` could not write there, before anything is checked."""
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    _unfinished(path).touch()
    _unfinished(path).unlink()


def _unfinished(path: Path) -> Path:
    return path.with_name(f".{path.name}.part")


# Names of files and answers may hold halves of letters, which UTF-8 cannot write.
_HALVES = "backslashreplace"


def _write_json(rows: list[Row], path: Path) -> None:
    text = json.dumps(rows, ensure_ascii=False, indent=1)
    path.write_text(text + "\n", encoding="utf-8", errors=_HALVES, newline="\n")


def _write_csv(rows: list[Row], path: Path) -> None:
    questions = sorted({question for row in rows for question in row["answers"]}, key=_counted)
    plain = [key for key in _row("") if key != "answers"]
    # With the mark at the beginning, spreadsheets read letters of all languages.
    with path.open("w", encoding="utf-8-sig", errors=_HALVES, newline="") as file:
        table = csv.writer(file)
        table.writerow([*plain, *(f"answer {question}" for question in questions)])
        for row in rows:
            passed = {"passed": "yes" if row["passed"] else "no"}
            cells = [(row | passed)[key] for key in plain]
            cells += [row["answers"].get(question, "") for question in questions]
            table.writerow([f"'{cell}" if cell.startswith(_FORMULA) else cell for cell in cells])


def _counted(question: str) -> tuple[int, str]:
    """Sort 2 before 10."""
    return (len(question), question)
