"""A new task: its tests fail until it is filled in, as the worked example shows."""

import os
import re
import shutil
import subprocess
import sys

import new_task
import pytest
import starter

TASK = "1.10", "ease_in_out", "Start and stop gently"
# Those of tests/gallery/test_starters.py as well, but each of them starts an interpreter or two.
ITS_TESTS = (
    "tests/checks/test_task_1_10.py",
    "tests/checks/test_mistakes.py",
    "tests/gallery/test_pages.py",
)


@pytest.fixture
def project(root, tmp_path):
    """A copy of what the tests of a task need."""
    made = shutil.ignore_patterns("__pycache__", "starters", "_build", "node_modules")
    for name in ("src", "gallery", "docs/_ext"):
        shutil.copytree(root / name, tmp_path / name, ignore=made)
    for name in ("checks", "gallery"):
        shutil.copytree(root / "tests" / name, tmp_path / "tests" / name, ignore=made)
    for name in ("pyproject.toml", "tests/conftest.py", "docs/new_task.py"):
        shutil.copy(root / name, tmp_path / name)
    return tmp_path


def outcome(project):
    """Run the tests of the new task in the copy; return what failed, and how many passed."""
    # The copy is not what coverage is asked for.
    kept = {name: value for name, value in os.environ.items() if not name.startswith("COV")}
    ran = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"),
            *("-k", "1.10 or 1_10", *ITS_TESTS),
        ],
        cwd=project,
        env=kept | {"PYTHONPATH": str(project / "src"), "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    failed = {
        re.sub(r"\[.*", "", name) for name in re.findall(r"^FAILED .*?::(\S+)", ran.stdout, re.M)
    }
    passed = re.search(r"(\d+) passed", ran.stdout)
    assert failed or ran.returncode == 0, ran.stdout + ran.stderr
    return failed, int(passed[1]) if passed else 0


def test_a_new_task_fails_until_it_is_filled_in_as_the_worked_example_is(project, root):
    written = new_task.write(project, *TASK)
    failed, _ = outcome(project)
    assert failed >= {
        "test_nothing_is_left_to_fill_in",
        "test_a_model_solution_is_done_in_every_part",
        "test_each_task_knows_three_mistakes_at_least",
        "test_at_most_25_lines_are_to_be_written",
        "test_it_may_be_written_in_other_ways",
    }

    example = root / "docs/course/worked_example"
    files = {path.relative_to(example) for path in example.rglob("*.py")}
    assert files == {path.relative_to(project) for path in written}
    shutil.copytree(example, project, dirs_exist_ok=True)
    failed, passed = outcome(project)
    assert failed == set()
    assert passed > 15


def test_the_tenth_task_comes_after_the_ninth(project):
    new_task.write(project, *TASK)
    names = [page.name for page in starter.pages(project)]
    ninth = names.index("task_1_9_plot_bezier_equidistant_points")
    assert names[ninth + 1] == "task_1_10_ease_in_out"


@pytest.mark.parametrize(
    ("number", "name", "title", "words"),
    [
        ("4.1", "ease", "Title", "number must be"),
        ("1.0", "ease", "Title", "number must be"),
        ("1", "ease", "Title", "number must be"),
        ("1.10", "Ease-in", "Title", "name must be"),
        ("1.10", "", "Title", "name must be"),
        ("1.10", "ease", "", "title must be"),
        ("1.10", "ease", 'A "quote"', "title must be"),
        ("1.10", "ease", "long " * 10, "title must be"),
        ("1.9", "ease", "Title", "number 1.9 is taken: there is src/canim/checks/task_1_9.py"),
    ],
)
def test_what_cannot_be_a_new_task_is_refused_and_nothing_is_written(
    project, number, name, title, words
):
    before = sorted(project.rglob("*"))
    with pytest.raises(ValueError, match=words):
        new_task.write(project, number, name, title)
    assert sorted(project.rglob("*")) == before


def test_the_command_says_what_it_has_written_or_why_not(project):
    command = [sys.executable, "docs/new_task.py", *TASK]
    first, second = (
        subprocess.run(command, cwd=project, capture_output=True, encoding="utf-8", check=False)
        for _ in range(2)
    )
    assert first.returncode == 0
    assert "src/canim/checks/task_1_10.py" in first.stdout
    assert '-k "1.10 or 1_10"' in first.stdout
    assert second.returncode == 2
    assert second.stderr.startswith("No new task: number 1.10 is taken")
