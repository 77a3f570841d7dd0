"""Check all programs and notebooks of a class, several at the same time."""

from __future__ import annotations

import csv
import errno
import functools
import json
import os
import re
import tempfile
import threading
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from canim.checks import beside, handins, reading
from canim.checks.file import check_file
from canim.checks.guard import Fault, Guard, Limits, make
from canim.checks.handins import Found
from canim.checks.reading import NoTask, UnusableFile
from canim.checks.report import STATES, Report

# One line of a class report: a part of a file, or a file or folder that was not checked.
Row = dict[str, Any]
ONE_BY_ONE = (
    "The files are checked one after another. To check several at the same time, install "
    'joblib:\npython -m pip install "canim[class]"'
)
# A failure of the check itself, at this file only.
OURS = "could not be checked, and canim is to blame, not the file"
NOT_CHECKED, CAME_ALONG, PASSED_OVER = "not checked", "came along", "passed over"
_NO_TASK = "no task"  # until it is known whether another program imports it
_DOCUMENTS = (
    *(".docx", ".doc", ".odt", ".rtf", ".pages", ".pdf"),
    *(".ppt", ".pptx", ".key", ".odp"),
)
_SCANS = (".png", ".jpg", ".jpeg", ".gif", ".bmp", ".webp", ".tif", ".tiff", ".heic")
# Letters that a spreadsheet would take for the beginning of a formula.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def check_folder(
    folder: Path | str,
    *,
    task: str | None = None,
    limits: Limits | None = None,
    jobs: int = -1,
    progress: Callable[[int, int], None] = lambda done, all_files: None,
    table: Path | None = None,
) -> list[Row]:
    """Check every program below a folder or in a zip, and account for all that is there.

    The rows are the same for any number of jobs. joblib hands the files out: with its
    ``parallel_config`` they go to another machine, which has to see the folder at the same
    place. Without joblib, one file is checked after another. Zips are unpacked into a
    temporary folder of this machine.

    Parameters
    ----------
    folder : Path or str
        The folder, or a zip, which is read like a folder.
    task : str, optional
        Number of the task of all files; otherwise each file says its own.
    limits : Limits, optional
        The time and the memory that each program may take.
    jobs : int
        Number of files that are checked at the same time; -1: one for each core.
    progress : callable
        Is called with the number of files that are checked, and of all files.
    table : Path, optional
        The table that is written from the rows: it was not handed in.

    Returns
    -------
    list of dict
        One row for each file and part, or for a file or folder that is not checked:
        ``file``, ``task``, ``part``, ``result``, ``message``, ``mistake``, ``hint``,
        ``passed`` (whether the whole task is done in this file; None for what came along
        with a program), ``notes`` on the whole file, and its ``answers``.
    """
    rows: list[list[Row]] = []
    with tempfile.TemporaryDirectory(prefix="canim-", ignore_cleanup_errors=True) as unpacked:
        everything = list(handins.find(Path(folder), Path(unpacked).resolve()))
        own = table and os.path.abspath(table)
        found = [one for one in everything if not one.litter and os.path.abspath(one.path) != own]
        programs = [i for i, one in enumerate(found) if not one.reason]
        rows = [[_row(one.name, result=NOT_CHECKED, message=one.reason)] for one in found]
        given = [(i, str(found[i].path.absolute()), found[i].name, task) for i in programs]
        progress(0, len(given))
        for done, (i, checked) in enumerate(_checked(given, limits or Limits(), jobs), 1):
            rows[i] = checked
            progress(done, len(given))
        _excuse(found, rows)
    litter = Counter(one.name for one in everything if one.litter)
    if litter:
        names = ", ".join(f"{name} ({count})" for name, count in sorted(litter.items()))
        files = handins.numbered(litter.total())
        message = f"{files} that systems and programs write for themselves: {names}."
        rows.append([_row("", result=PASSED_OVER, message=message, passed=None)])
    return [row for of_one in rows for row in of_one]


def _excuse(found: list[Found], rows: list[list[Row]]) -> None:
    """Say of the files that belong to a checked program that they came along with it."""
    modules = functools.cache(beside.modules_of)
    checked: dict[str, dict[Found, str]] = {}
    for one, (row, *_) in zip(found, rows, strict=True):
        if row["task"]:
            checked.setdefault(_above(one.name)[0], {})[one] = row["task"]
    # Programs of a folder with others further below are no one's there, such as a solution.
    shared = {above for folder in checked if folder for above in _above(folder)}
    for one, (row, *_) in zip(found, rows, strict=True):
        own, *others = _above(one.name)
        near = [folder for folder in [own, *(set(others) - shared)] if folder in checked]
        harmless = one.harmless and any(_is_owned(one, folder, checked[folder]) for folder in near)
        if row["result"] == _NO_TASK:
            harmless = any(one.path in modules(p.path) for f in near for p in checked[f])
            row["result"] = NOT_CHECKED
        if harmless:
            row |= {"result": CAME_ALONG, "passed": None}


def _above(name: str) -> list[str]:
    """Return the folders that a file or folder lies in, the nearest first; the last is ""."""
    *folders, _ = name.split("/")
    return ["/".join(folders[:count]) for count in range(len(folders), -1, -1)]


def _is_owned(one: Found, folder: str, programs: dict[Found, str]) -> bool:
    """Tell whether a file belongs to the programs of a folder, or to one of them.

    Where several are of one task, it is the folder of many students. There a file is
    somebody's by the beginning of its name, as in those that Moodle makes.
    """
    # Such a document is what somebody handed in instead of a program.
    instead = one.path.suffix.lower() in _DOCUMENTS and reading.task_in(one.path)
    suffix = one.path.suffix.lower()
    if not instead and suffix in _SCANS and any(one.path.name in _text(p.path) for p in programs):
        return True
    flat = "/" not in one.name.removeprefix(f"{folder}/" if folder else "")
    if flat and suffix in (*_DOCUMENTS, *_SCANS):
        named = {_whose(p.path) for p in programs if _AFTER_NAME.search(p.path.name)}
        own = _whose(one.path)
        if named and not any(own[: len(whose)] == whose for whose in named):
            return False
    if instead or len(set(programs.values())) == len(programs):
        return not instead
    owners = {tuple(p.name.removeprefix(f"{folder}/").split("_")[:2]) for p in programs}
    return tuple(one.name.removeprefix(f"{folder}/").split("_")[:2]) in owners


_AFTER_NAME = re.compile(r"task[_ -]?\d|assign", re.IGNORECASE)


def _whose(path: Path) -> tuple[str, ...]:
    """Return how the name of a file begins, before what it says of a task."""
    before = _AFTER_NAME.split(reading.plain_name(path.stem))[0].strip("_ -")
    return tuple(before.split("_")[:2]) if before else ()


def _text(program: Path) -> str:
    text = ""
    with suppress(UnusableFile):
        text, _ = reading.read(program)
    return text


def can_share() -> bool:
    """Tell whether joblib is there to hand out the files."""
    try:
        import joblib  # noqa: F401
    except ImportError:
        return False
    return True


def _checked(
    given: list[tuple[int, str, str, str | None]], limits: Limits, jobs: int
) -> Iterator[tuple[int, list[Row]]]:
    """Yield the number and the rows of each file, in any order."""
    if jobs == 1 or not can_share():
        try:
            for one in given:
                yield check_one(*one, limits)
        finally:
            _close_guard()
        return
    import joblib

    before = os.environ.get(_SAFE_PATH)
    # Python's workers would look into this folder first: a random.py of the class would run.
    os.environ[_SAFE_PATH] = "1"
    try:
        parallel = joblib.Parallel(n_jobs=jobs, return_as="generator_unordered")
        yield from parallel(joblib.delayed(_check_safely)(before, *one, limits) for one in given)
    finally:
        _restore_safe_path(before)


def _check_safely(
    before: str | None, number: int, path: str, name: str, task: str | None, limits: Limits
) -> tuple[int, list[Row]]:
    # What the program itself starts finds its modules as always.
    _restore_safe_path(before)
    return check_one(number, path, name, task, limits)


def _restore_safe_path(before: str | None) -> None:
    os.environ.pop(_SAFE_PATH, None)
    if before is not None:
        os.environ[_SAFE_PATH] = before


_SAFE_PATH = "PYTHONSAFEPATH"
_guard: Guard | None = None
_guard_in_use = threading.Lock()


def check_one(
    number: int, path: str, name: str, task: str | None, limits: Limits
) -> tuple[int, list[Row]]:
    """Return the number and the rows of one file, called `name` there, whatever happens."""
    global _guard
    result = NOT_CHECKED
    # A worker of joblib's may be a thread; what is printed is a matter of the whole process.
    with _guard_in_use:
        _guard = _guard or make(many=True)
        try:
            reports = check_file(Path(path), task=task, limits=limits, guard=_guard)
            return number, [row for report in reports for row in _rows(name, report)]
        except UnusableFile as problem:
            message = str(problem).replace(path, "").lstrip(" ,")
            result = _NO_TASK if isinstance(problem, NoTask) else NOT_CHECKED
        except Fault:
            raise  # it would come again for every file
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            where = f"{Path(place.filename).name}, line {place.lineno}"
            message = f"{OURS}: {type(error).__name__}: {error} ({where})"
    return number, [_row(name, result=result, message=_line(message))]


def _close_guard() -> None:
    global _guard
    with _guard_in_use:
        if _guard:
            _guard.close()
        _guard = None


def _rows(name: str, report: Report) -> list[Row]:
    notes = [*report.stops, *report.notes]
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
    """Return a line for each file and task, and some for all of them."""
    tasks: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        tasks.setdefault((_shown(row["file"]), row["task"]), []).append(row)
    lines, along, over = [], [], []
    passed: dict[str, bool] = {}
    for (name, task), parts in tasks.items():
        row = parts[0]
        if row["result"] == PASSED_OVER:
            over.append(f"Passed over: {row['message']}")
            continue
        if row["result"] == CAME_ALONG:
            along.append(name)
            continue
        done = sum(part["result"] == "done" for part in parts)
        words = f"Task {task}, {done} of {len(parts)} parts done" if task else row["message"]
        lines.append(f"{name}: {words}")
        if row["notes"]:
            lines.append(f"    {row['notes']}")
        passed[name] = passed.get(name, True) and row["passed"]
    if along:
        lines.append(f"Came along with programs: {', '.join(along)}")
    lines += over
    checked = {place for name, task in tasks if task for place in (name, *_above(name))}
    places = {place: None for name in passed for place in (*_above(name)[::-1], name)}
    nothing = [place for place in places if place and place not in checked]
    outermost = [place for place in nothing if _above(place)[0] not in nothing]
    students = {_student(place) for place in checked} - {""}
    if outermost := [place for place in outermost if _student(place) not in students]:
        # Names have commas in them: each has a line of its own.
        lines += ["Nothing was checked of:", *(f"    {place}" for place in outermost)]
    return [*lines, f"All parts are done in {sum(passed.values())} of {len(passed)} files."]


def _student(place: str) -> str:
    """Return whose file or folder this is where Moodle has named it, or ""."""
    whose, mark, rest = place.rpartition("_assignsubmission_")
    return whose if mark and "/" not in rest else ""


def _shown(name: str) -> str:
    """Return a name in one line."""
    return re.sub(r"[\r\n]", "?", name)


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
            passed = {"passed": {True: "yes", False: "no", None: ""}[row["passed"]]}
            cells = [(row | passed)[key] for key in plain]
            cells += [row["answers"].get(question, "") for question in questions]
            table.writerow([f"'{cell}" if cell.startswith(_FORMULA) else cell for cell in cells])


def _counted(question: str) -> tuple[int, str]:
    """Sort 2 before 10."""
    return (len(question), question)
