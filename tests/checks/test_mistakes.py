"""Every known mistake of every task is told apart from right work and from the others."""

import pytest

from canim import checks

TASKS = list(checks.TASKS.values())
MISTAKES = [(task, mistake) for task in TASKS for mistake in task.mistakes]


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
def test_a_model_solution_is_done_in_every_part(task, solved):
    report = checks.run(task, solved(task), hint=True)
    assert [r.state for r in report.results] == ["done"] * len(task.parts), str(report)
    assert not report.notes
    assert report.done


@pytest.mark.parametrize(("task", "mistake"), MISTAKES, ids=lambda x: getattr(x, "id", x.name))
def test_a_mistake_gets_its_own_hint_and_no_other(task, mistake, solved):
    report = checks.run(task, solved(task) | dict(mistake.program), hint=True)
    assert not report.done
    assert [hint for _, hint in report.hints] == [mistake.hint], str(report)
    assert mistake.hint in " ".join(str(report).split())


@pytest.mark.parametrize(("task", "mistake"), MISTAKES, ids=lambda x: getattr(x, "id", x.name))
def test_hints_are_asked_for(task, mistake, solved):
    report = checks.run(task, solved(task) | dict(mistake.program))
    assert mistake.hint not in " ".join(str(report).split())
    assert "There is a hint" in str(report)


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
def test_each_task_knows_three_mistakes_at_least(task):
    assert len({mistake.name for mistake in task.mistakes}) >= 3
    assert len({mistake.hint for mistake in task.mistakes}) == len(task.mistakes)


@pytest.mark.parametrize(("task", "mistake"), MISTAKES, ids=lambda x: getattr(x, "id", x.name))
def test_a_hint_is_one_short_calm_sentence(task, mistake):
    assert len(mistake.hint) <= 140
    assert mistake.hint[-1] in ".?"
    assert "!" not in mistake.hint
