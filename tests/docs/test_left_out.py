"""Any task can be left out: its files are deleted, and what is left still works."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys

import pytest
import solutions
import starter

from canim import checks

TASKS = [*checks.TASKS]

# One process, as a student starts several. Every check is loaded, and one is run.
USE = """
import sys, pathlib
from types import ModuleType
from canim import checks, cli

other = sys.argv[1]
print(cli.main(["tasks"]), cli.main(["start", other]))
program = ModuleType("program")
exec(pathlib.Path("completed.py").read_text(encoding="utf-8"), vars(program))
print([task.id for task in checks.TASKS.values()])
"""


def files(root, task):
    """Return the files of a task, as the page for those who change the course lists them."""
    name = f"task_{task.replace('.', '_')}"
    found = [
        path
        for folder in ("gallery", "src/canim/checks", "tests/gallery/solutions", "tests/checks")
        for path in sorted((root / folder).rglob("*.py"))
        if re.fullmatch(rf"(test_)?{name}(_.*)?\.py", path.name)
    ]
    folders = {path.relative_to(root).parts[0] for path in found}
    assert folders >= {"gallery", "src"}
    return found


@pytest.fixture(scope="module")
def project(root, tmp_path_factory):
    """A copy of what tasks are made of."""
    copy = tmp_path_factory.mktemp("project")
    made = shutil.ignore_patterns("__pycache__", "starters", "hostile")
    for name in ("src/canim", "gallery", "tests/checks", "tests/gallery"):
        shutil.copytree(root / name, copy / name, ignore=made)
    shutil.copy(root / "pyproject.toml", copy)
    return copy


@pytest.mark.parametrize("task", TASKS)
def test_the_others_are_listed_started_and_checked(project, tmp_path, task):
    other = TASKS[TASKS.index(task) - len(TASKS) + 1]  # the next one, which may build on it
    gone = {path: path.read_bytes() for path in files(project, task)}
    starters = project / "src/canim/starters"
    shutil.rmtree(starters, ignore_errors=True)
    starters.mkdir()
    try:
        for path in gone:
            path.unlink()
        completed = solutions.completed(project)
        for page in starter.pages(project):
            text = starter.script(page, starter.release(project))
            (starters / f"{page.name}.py").write_text(text, encoding="utf-8")
        (tmp_path / "completed.py").write_text(
            completed[checks.TASKS[other].file_name], encoding="utf-8"
        )
        # The copy is not what coverage is asked for.
        kept = {name: value for name, value in os.environ.items() if not name.startswith("COV")}
        ran = subprocess.run(
            [sys.executable, "-c", USE, other],
            cwd=tmp_path,
            env=kept | {"PYTHONPATH": str(project / "src"), "PYTHONIOENCODING": "utf-8"},
            capture_output=True,
            encoding="utf-8",
            check=False,
        )
    finally:
        for path, content in gone.items():
            path.write_bytes(content)
    assert ran.stderr == ""
    left = [number for number in TASKS if number != task]
    listed = re.findall(r"^  (\d\.\d+)  ", ran.stdout, re.M)
    assert listed == left
    assert f"{checks.TASKS[other].file_name} is here now." in ran.stdout
    assert f"All checks of Task {other} pass." in ran.stdout
    assert ran.stdout.endswith(f"{left}\n")
    example = re.search(r"for example: canim start (\S+)", ran.stdout)
    assert example[1] in left


def test_texts_link_to_tasks_that_are_there(root):
    """The site shows the words of a link to a task that is gone: it would hide a typing error."""
    texts = [*root.glob("docs/*.md"), *root.glob("gallery/**/*.*")]
    for folder in ("docs/course", "docs/students", "docs/maintainers", "docs/api", "src/canim"):
        texts += [
            path for path in root.glob(f"{folder}/**/*.*") if "worked_example" not in path.parts
        ]
    named = {
        (path.relative_to(root).as_posix(), ".".join(number))
        for path in texts
        if path.suffix in (".md", ".rst", ".py")
        for number in re.findall(r"[<`]task-(\d+)-(\d+)[>`]", path.read_text(encoding="utf-8"))
    }
    assert len(named) > 100
    assert [(name, number) for name, number in sorted(named) if number not in TASKS] == []
