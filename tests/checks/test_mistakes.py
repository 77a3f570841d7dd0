"""Every known mistake of every task is told apart from right work and from the others."""

import re
from dataclasses import replace

import pytest
import starter

from canim import checks
from canim.checks.task import SOURCES

TASKS = list(checks.TASKS.values())
MISTAKES = [(task, mistake) for task in TASKS for mistake in task.mistakes]


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
def test_a_model_solution_is_done_in_every_part(task, solved):
    report = checks.run(task, solved(task), hint=True)
    assert [r.state for r in report.results] == ["done"] * len(task.parts), str(report)
    assert not report.notes
    assert report.done


@pytest.mark.parametrize(("task", "mistake"), MISTAKES, ids=lambda x: getattr(x, "id", x.name))
def test_a_mistake_gets_its_own_hint_and_no_other_step_by_step(task, mistake, solved):
    report = checks.run(task, solved(task) | dict(mistake.program))
    assert not report.done
    assert [hint for _, hint in report.hints] == [mistake.hint], str(report)
    texts = [str(replace(report, show_hints=step)) for step in range(3)]
    first, hint, whole = (" ".join(text.split()) for text in texts)
    assert "There is a hint" in first
    assert mistake.hint not in first
    assert mistake.hint in hint
    assert "Pseudocode:" not in hint
    assert max(map(len, texts[2].splitlines())) <= 90
    lines = {mistake.line} if mistake.line else set(task.lines.values())
    assert any(f"Pseudocode: {line}" in whole for line in lines)


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
def test_each_task_knows_three_mistakes_at_least(task):
    assert len({mistake.name for mistake in task.mistakes}) >= 3
    assert len({mistake.hint for mistake in task.mistakes}) == len(task.mistakes)


@pytest.mark.parametrize(("task", "mistake"), MISTAKES, ids=lambda x: getattr(x, "id", x.name))
def test_a_hint_is_one_short_calm_sentence(task, mistake):
    assert len(mistake.hint) <= 140
    assert mistake.hint[-1] in ".?"
    assert "!" not in mistake.hint


def _pseudocode(root, task):
    """Return the lines of the page's pseudocode, without spaces at their ends."""
    page = starter.read(root / "gallery" / task.block / task.file_name)
    text = "\n".join(block.text for block in page.sections["Pseudocode"])
    return [" ".join(line.split()) for line in text.split("code-block:: text")[1].splitlines()]


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
def test_lines_of_the_pseudocode_are_those_of_the_page(task, root):
    text = "\n".join(_pseudocode(root, task))
    assert task.lines.keys() == {part.name for part in task.parts}
    for line in [*task.lines.values(), *(m.line for m in task.mistakes if m.line)]:
        words = r"\s".join(map(re.escape, line.split()))
        assert re.search(rf"^{words}$", text, re.M), f"{line!r} is not on the page"


@pytest.mark.parametrize(("task", "mistake"), MISTAKES, ids=lambda x: getattr(x, "id", x.name))
def test_a_mistake_has_a_source(task, mistake):
    assert mistake.source.split(":")[0] in SOURCES


def test_there_are_eighty_mistakes_that_somebody_else_made():
    found = [mistake for _, mistake in MISTAKES if not mistake.source.startswith("authors")]
    assert len(found) >= 80
