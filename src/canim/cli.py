"""The command `canim`: list the tasks, get a starter, check a file."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from canim import checks
from canim.checks.guard import Limits
from canim.checks.report import harmless, printable


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with `arguments` (those of the program by default), return its exit code."""
    parser = argparse.ArgumentParser(prog="canim", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("tasks", help="list the tasks of the course")
    start = commands.add_parser("start", help="write the starter of a task into this folder")
    start.add_argument("task", help="number of the task, as in 1.3")
    check = commands.add_parser("check", help="check a program or notebook")
    check.add_argument("file", type=Path, help="a .py or .ipynb file, or a folder of them")
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
        help="of a folder: write all results as .csv or .json",
    )
    check.add_argument(
        "--jobs", type=jobs, default=-1, metavar="N", help="of a folder: files at the same time"
    )
    check.add_argument(
        "--figure", type=png_file, metavar="FILE.png", help="draw expected and got into this file"
    )
    asked = parser.parse_args(arguments)
    if asked.command == "tasks":
        return _tasks()
    if asked.command == "start":
        return _start(asked.task)
    limits = Limits(asked.time, asked.memory)
    if asked.file.is_dir():
        for option in ("figure", "hint"):
            if getattr(asked, option):
                return _refuse(f"--{option} is for one file, but {asked.file} is a folder.")
        return _check_folder(asked.file, asked.task, limits, asked.jobs, asked.report)
    if asked.report:
        return _refuse(f"--report is for a folder, but {asked.file} is none.")
    return _check(asked.file, asked.task, asked.hint, limits, asked.figure)


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
        task = checks.find(number)
    except ValueError as error:
        return _refuse(str(error))
    starter = (files("canim") / "starters" / task.file_name).read_text(encoding="utf-8")
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


def _check(path: Path, task: str | None, hint: int, limits: Limits, figure: Path | None) -> int:
    from canim.checks.file import UnusableFile, check_file

    try:
        report = check_file(path, task=task, hint=hint, limits=limits, figure=figure)
    except UnusableFile as problem:
        return _refuse(str(problem))
    checks.show(report)
    return 0 if report.done else 1


def _check_folder(
    path: Path, task: str | None, limits: Limits, jobs: int, report: Path | None
) -> int:
    from canim.checks import folder

    if not any(folder.find(path)):
        return _refuse(f"{path} holds no .py and no .ipynb file.")
    if report:
        try:
            folder.make_room(report)
        except OSError as error:
            return _refuse(f"{report} cannot be written: {error.strerror}.")
    if jobs != 1 and not folder.can_share():
        print(folder.ONE_BY_ONE, file=sys.stderr)
    rows = folder.check_folder(path, task=task, limits=limits, jobs=jobs, progress=_progress)
    for line in folder.summary(rows):
        print(printable(line))
    if report:
        try:
            folder.write(rows, report)
        except OSError as error:
            return _refuse(f"{report} cannot be written: {error.strerror}.")
        print(printable(f"All results are in {report} now."))
    return 0 if all(row["passed"] for row in rows) else 1


def _progress(done: int, total: int) -> None:
    """Show how far it is, where somebody looks on: a file or a program gets no bar."""
    if sys.stderr.isatty():
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
