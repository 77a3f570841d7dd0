"""Pages, registry and starters say the same."""

import ast

import pytest
import solutions
import starter

from canim import checks

TASKS = list(checks.TASKS.values())
BY_TASK = pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)


def _page(task, root):
    return starter.read(root / "gallery" / task.block / task.file_name)


def test_every_page_is_registered_and_every_task_has_its_page(root):
    pages = sorted(page.path.name for page in starter.pages(root))
    assert pages == sorted(task.file_name for task in TASKS)


@BY_TASK
def test_page_and_registry_agree(task, root):
    page = _page(task, root)
    assert page.address == f"{task.page}.html"
    assert page.title == f"Task {task.id}: {task.title}"
    assert f".. _task-{task.id.replace('.', '-')}:" in page.path.read_text(encoding="utf-8")
    assert len(page.questions) == task.questions
    assert task.block in checks.BLOCKS
    assert all(before in checks.TASKS for before in task.builds_on)


@BY_TASK
def test_nothing_is_left_to_fill_in(task, root):
    check = f"task_{task.id.replace('.', '_')}.py"
    paths = [f"gallery/{task.block}/{task.file_name}", f"src/canim/checks/{check}"]
    paths += [f"tests/gallery/solutions/{task.file_name}", f"tests/checks/test_{check}"]
    texts = {path: root / path for path in paths}
    left = [
        path
        for path in texts
        if texts[path].exists() and "FILL IN" in texts[path].read_text("utf-8")
    ]
    assert left == []


@BY_TASK
def test_a_starter_is_short_and_says_what_to_write(task, root):
    text = starter.script(_page(task, root), starter.release(root))
    assert 30 <= sum(bool(line.strip()) for line in text.splitlines()) <= 60
    assert max(map(len, text.splitlines())) <= 100
    assert "# TODO" in text
    assert not any(mark in text for mark in ("# %%", "Picture:", "Film:", "GIF:", "noqa"))
    assert text.endswith("plt.show()\n")
    defined = {name for node in ast.parse(text).body for name in solutions._names(node)}
    assert set(task.names) <= defined | {"f"}


@BY_TASK
def test_at_most_25_lines_are_to_be_written(task, root, completed):
    before = starter.script(_page(task, root), starter.release(root)).splitlines()
    new = [line for line in completed[task.file_name].splitlines() if line not in before]
    written = [line for line in new if line.strip() and not line.strip().startswith("#")]
    assert 1 <= len(written) <= 25


@BY_TASK
def test_the_names_in_the_signatures_are_those_of_the_starter(task, root):
    text = starter.script(_page(task, root), starter.release(root))
    heads = {
        f"{node.name}({ast.unparse(node.args)})"
        for node in ast.parse(text).body
        if isinstance(node, ast.FunctionDef)
    }
    assert {function.signature for function in task.functions} <= heads
