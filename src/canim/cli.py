"""The command `canim`: list the tasks, get a starter, check a file."""

from __future__ import annotations

import argparse
import difflib
import glob
import math
import os
import re
import sys
import traceback
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from canim import __version__, checks
from canim.checks import reading
from canim.checks.guard import Fault, Limits
from canim.checks.report import harmless, printable

_COMMANDS = ("tasks", "start", "check")
_ENDS = """\
It ends with 0 if every part of every file is done, with 1 if not, and with 2 if the command
itself cannot be carried out: a file that is not there or is no program, an unknown task or
option, a table or picture that cannot be written. Ctrl+C ends it with 130."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with `arguments` (those of the program by default), return its exit code."""
    arguments = sys.argv[1:] if arguments is None else arguments
    parser = argparse.ArgumentParser(prog="canim", description=__doc__)
    parser.add_argument("--version", action="version", version=f"canim {__version__}")
    commands = parser.add_subparsers(dest="command")
    commands.add_parser("tasks", help="list the tasks of the course")
    start = commands.add_parser("start", help="write the starter of a task into this folder")
    start.add_argument("task", nargs="+", help="number of the task, as in 1.3")
    check = commands.add_parser(
        "check",
        help="check programs and notebooks, or a whole class",
        epilog=_ENDS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    check.add_argument(
        "file",
        nargs="+",
        help="a .py or .ipynb file, the number of the task whose file is in this folder, "
        "or a folder or zip of a class",
    )
    check.add_argument("--task", help="number of the task, where the file does not say it")
    check.add_argument(
        "--hint",
        action="count",
        default=0,
        help="show hints for known mistakes; given twice, also the lines of the pseudocode",
    )
    check.add_argument(
        "--time",
        type=amount,
        default=Limits.seconds,
        metavar="SECONDS",
        help="limit (default: %(default)s)",
    )
    check.add_argument(
        "--memory",
        type=amount,
        default=Limits.megabytes,
        metavar="MB",
        help="limit (default: %(default)s)",
    )
    check.add_argument(
        "--report",
        type=table,
        metavar="FILE",
        help="of a folder or zip: write all results as .csv or .json",
    )
    check.add_argument(
        "--jobs", type=jobs, default=-1, metavar="N", help="of a folder: files at the same time"
    )
    check.add_argument(
        "--figure", type=png_file, metavar="FILE.png", help="draw expected and got into this file"
    )
    if arguments and (meant := _meant(arguments[0])):
        return _refuse(f"There is no command {arguments[0]}. Do you mean: canim {meant}?")
    asked = parser.parse_args(arguments)
    if asked.command is None:
        parser.print_help()
        return 0
    try:
        code = _carry_out(asked)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        # Who reads what is printed, as `head` does, has enough. At its end Python would write more.
        with open(os.devnull, "w") as nobody:
            os.dup2(nobody.fileno(), sys.stdout.fileno())
        return 1
    except KeyboardInterrupt:
        print("\nThe command was stopped with Ctrl+C.", file=sys.stderr)
        return 130
    except Fault as fault:
        return _refuse(str(fault))
    except Exception:
        return _refuse(str(Fault("it met what nobody foresaw.", traceback.format_exc())))


def _carry_out(asked: argparse.Namespace) -> int:
    """Do what was asked, and return the exit code."""
    if asked.command == "tasks":
        return _tasks()
    if asked.command == "start":
        return _start(" ".join(asked.task))
    try:
        task = None if asked.task is None else _number(asked.task)
        paths = [path for text in asked.file for path in _paths(text)]
    except ValueError as error:
        return _refuse(str(error))
    return _check(paths, task, asked)


def _meant(word: str) -> str:
    """Return the command that was meant by a word that is none, or ""."""
    if word.startswith("-") or word in _COMMANDS:
        return ""
    if _is_there(Path(word)) or reading.kind(Path(word)) or _certain(word):
        return f"check {word}"
    return "".join(difflib.get_close_matches(word, _COMMANDS, 1))


def _number(text: str) -> str:
    """Return the number of the task that a text such as "1,1" means for certain."""
    number = _certain(text) or text
    if number not in checks.TASKS:
        checks.find(number)  # says which there are
    return number


def _certain(text: str) -> str:
    """Return the number of a task that is written with other signs, or ""."""
    written = re.fullmatch(r"[\W_]*(?:task)?[\W_]*\d+[\W_]+\d+[\W_]*", text, re.IGNORECASE)
    return checks.number_in(text) if written else ""


def _paths(text: str) -> list[Path]:
    """Return the files that an argument names: itself, those of a pattern, or that of a task."""
    if not text:
        raise ValueError("The name of the file is empty.")
    path = Path(text)
    if _is_there(path):
        return [path]
    # Windows hands patterns over as they were typed.
    if found := sorted(glob.glob(text)):
        return [Path(name) for name in found]
    if number := _certain(text):
        return [_only_file_of(number)]
    if re.fullmatch(r"\d+(?:\.\d+)?", text):
        checks.find(text)
    meant = _files_of(reading.task_in(path), path.parent)
    there = f" Do you mean {' or '.join(map(str, meant))}?" if meant else ""
    raise ValueError(f"{text} is not there.{there}")


def _is_there(path: Path) -> bool:
    try:
        path.lstat()
    except PermissionError:
        return True  # who reads it says why it cannot be read
    except (OSError, ValueError):
        return False
    return True


def _only_file_of(number: str) -> Path:
    found = _files_of(number, Path())
    if not found:
        raise ValueError(
            f"There is no file of Task {number} in this folder. "
            f"Get its starter with: canim start {number}"
        )
    if len(found) > 1:
        raise ValueError(
            f"There are several files of Task {number} in this folder: "
            f'{", ".join(map(str, found))}.\nSay which one, as in: canim check "{found[0]}"'
        )
    return found[0]


def _files_of(number: str, folder: Path) -> list[Path]:
    """Return the programs and notebooks in the folder that have this task in their names."""
    if not number:
        return []
    try:
        there = sorted(folder.iterdir())
    except OSError:
        return []
    return [p for p in there if reading.task_in(p) == number and reading.kind(p)]


def _tasks() -> int:
    for block, title in checks.BLOCKS.items():
        tasks = [task for task in checks.TASKS.values() if task.block == block]
        print(title)
        for task in tasks:
            print(printable(f"  {task.id}  {task.title} ({task.minutes} minutes)"))
    # A course may do without any of them.
    example = "1.1" if "1.1" in checks.TASKS else [*checks.TASKS][-1]
    print(f"\nGet one into this folder with, for example: canim start {example}")
    return 0


def _start(number: str) -> int:
    try:
        task = checks.find(_number(number))
    except ValueError as error:
        return _refuse(str(error))
    try:
        starter = (files("canim") / "starters" / task.file_name).read_text(encoding="utf-8")
    except OSError as error:
        return _refuse(
            f"canim cannot read its own starter {task.file_name}: {error.strerror}. This is no "
            "fault of yours: install canim anew."
        )
    try:
        # Mode x: a file that is already there may hold somebody's work.
        with open(task.file_name, "x", encoding="utf-8") as file:
            file.write(starter)
    except FileExistsError:
        return _refuse(f"{task.file_name} is already here. It stays as it is.")
    except OSError as error:
        return _refuse(f"{task.file_name} cannot be written here: {error.strerror}.")
    print(f"{task.file_name} is here now. Run it with: python {task.file_name}")
    return 0


def _check(paths: list[Path], task: str | None, asked: argparse.Namespace) -> int:
    """Check one file, folder or zip after another; return the exit code of all."""
    from canim.checks import handins

    classes = [path for path in paths if os.path.isdir(path) or handins.is_zip(path)]
    for option in ("figure", "hint") if classes else ():
        if getattr(asked, option):
            kind = "folder" if classes[0].is_dir() else "zip"
            return _refuse(f"--{option} is for one file, but {classes[0]} is a {kind}.")
    if asked.figure and len(paths) > 1:
        return _refuse(f"--figure is for one file, but there are {len(paths)}.")
    if asked.report and len(paths) > 1:
        return _refuse(f"--report is for one folder or zip, but there are {len(paths)} files.")
    if asked.report and not classes:
        return _refuse(f"--report is for a folder or zip, but {paths[0]} is none.")
    limits = Limits(asked.time, asked.memory)
    codes = []
    for path in paths:
        if len(paths) > 1:
            print(printable(f"{'' if path is paths[0] else chr(10)}{path}"))
        if path in classes:
            codes.append(_check_folder(path, task, limits, asked.jobs, asked.report))
        else:
            codes.append(_check_file(path, task, asked.hint, limits, asked.figure))
    return max(codes)


def _check_file(
    path: Path, task: str | None, hint: int, limits: Limits, figure: Path | None
) -> int:
    from canim.checks.file import check_file

    try:
        reports = check_file(path, task=task, hint=hint, limits=limits, figure=figure)
    except reading.UnusableFile as problem:
        return _refuse(str(problem))
    for number, report in enumerate(reports):
        print("\n" if number else "", end="")
        checks.show(report)
    return 0 if all(report.done for report in reports) else 1


def _check_folder(
    path: Path, task: str | None, limits: Limits, jobs: int, table: Path | None
) -> int:
    from canim.checks import folder

    if table:
        try:
            folder.make_room(table)
        except OSError as error:
            return _refuse(f"{table} cannot be written: {error.strerror}.")
    if jobs != 1 and not folder.can_share():
        print(folder.ONE_BY_ONE, file=sys.stderr)
    rows = folder.check_folder(
        path, task=task, limits=limits, jobs=jobs, progress=_progress, table=table
    )
    if not any(row["file"] for row in rows):
        return _refuse(f"{path} {rows[0]['message']}")
    for line in folder.summary(rows):
        print(printable(line))
    if table:
        try:
            folder.write(rows, table)
        except OSError as error:
            return _refuse(f"{table} cannot be written: {error.strerror}.")
        print(printable(f"All results are in {table} now."))
    if any(row["message"].startswith(folder.OURS) for row in rows):
        return 2
    return 1 if any(row["passed"] is False for row in rows) else 0


def _progress(done: int, total: int) -> None:
    """Show how far it is, where somebody looks on: a file or a program gets no bar."""
    if total and sys.stderr.isatty():
        bar = "#" * (30 * done // total)
        end = "\n" if done == total else ""
        print(f"\r[{bar:.<30}] {done} of {total} files", end=end, file=sys.stderr, flush=True)


def jobs(text: str) -> int:
    """Return a number of files to check at the same time: from 1 on, or -1, as many as cores."""
    jobs = int(text)
    if jobs < 1 and jobs != -1:
        raise ValueError(text)
    return jobs


def png_file(text: str) -> Path:
    """Return the path of a picture: its name ends in .png."""
    path = Path(text)
    if path.suffix.lower() != ".png":
        raise argparse.ArgumentTypeError(f"the name must end in .png, but is {text!r}")
    return path


def table(text: str) -> Path:
    """Return the file for the results, of a kind that can be written."""
    if not text.endswith((".csv", ".json")):
        raise argparse.ArgumentTypeError(f"{text!r} must end in .csv or .json")
    return Path(text)


def amount(text: str) -> float:
    """Return a limit: a number above 0."""
    amount = float(text)
    if not 0 < amount < math.inf:
        raise ValueError(text)
    return amount


def _refuse(sentence: str) -> int:
    print(harmless(sentence), file=sys.stderr)
    return 2
