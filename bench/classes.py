"""Time the check of a whole class against the students' own running time.

340 files, 20 for each task: unedited, half done, done, with one of three known mistakes, and
crashing. The goal is the time on two cores: 1.2 times the half of what the programs take when
each is run alone, and a minute. Only run by its name: it takes minutes.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from timing import Row

from canim import checks
from canim.checks.folder import check_folder, summary
from canim.checks.task import Task

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "docs/_ext"))
CORES = 2
HALF = """
def _half(whole):
    def half(*args):
        result = np.array(whole(*args), float)
        result.reshape(-1)[result.size // 2 :] = np.nan
        return result

    return half


{name} = _half({name})
"""
MISTAKE = """
from canim import checks
{name} = checks.TASKS["{task}"].mistakes[{number}].program.get("{name}", {name})
"""
CRASH = """
def {name}(*args):
    return missing + 1
"""


def programs(task: Task, done: str, unedited: str) -> Iterator[tuple[str, str, int]]:
    """Yield the name of a kind, its program, and how many students hand it in."""
    names = [function.name for function in task.functions]

    def changed(change: str, **known: object) -> str:
        lines = "".join(change.format(name=name, task=task.id, **known) for name in names)
        start, call, end = done.partition("canim.check(")
        return f"{start}import numpy as np\n{lines}\n{call}{end}"

    yield "unedited", unedited, 3
    yield "half", changed(HALF), 3
    yield "done", done, 4
    for number in range(3):
        yield f"mistake_{number}", changed(MISTAKE, number=number), 2
    yield "crashing", changed(CRASH), 4


def alone(program: Path) -> float:
    """Return the seconds that a program takes by itself, in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        subprocess.run(
            [sys.executable, program],
            cwd=folder,
            env=os.environ | {"MPLBACKEND": "agg"},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            check=False,
        )
        return time.perf_counter() - begin


def rows(numbers: tuple[str, ...] = ()) -> list[Row]:
    """Check the class, or that part of it which does the tasks of these numbers."""
    import solutions
    import starter

    completed = solutions.completed(ROOT)
    tasks = [checks.TASKS[n] for n in numbers or checks.TASKS if n != "0.0"]
    own, count = 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        for task in tasks:
            page = starter.read(ROOT / "gallery" / task.block / task.file_name)
            unedited = starter.script(page, starter.release(ROOT))
            for kind, text, times in programs(task, completed[task.file_name], unedited):
                for number in range(times):
                    student = Path(folder, f"{kind}_{number}", task.file_name)
                    student.parent.mkdir(exist_ok=True)
                    student.write_text(text, encoding="utf-8")
                own += times * alone(student)
                count += times
        begin = time.perf_counter()
        found = check_folder(folder, jobs=CORES)
        ours = time.perf_counter() - begin
    print(f"{summary(found)[-1]} The programs alone: {own:.0f} s. Load: {os.getloadavg()}")
    allowed = 1.2 * own / CORES + 60 * count / 340
    return [Row(f"a class of {count} files", ours, allowed, "what the goal allows", 1)]
