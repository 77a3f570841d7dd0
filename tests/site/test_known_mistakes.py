"""The teachers' table of parts and mistakes is true."""

import known_mistakes
import pytest

from canim import checks

EASY = [task for task in checks.TASKS.values() if task.block in ("warm_up", "interpolation")]


@pytest.mark.parametrize("task", EASY, ids=lambda task: task.id)
def test_right_programs_are_made_of_references_and_model_solutions(task):
    right = known_mistakes._right(task)
    assert right.keys() == set(task.names)
    assert checks.run(task, right).done


def test_a_mistake_is_listed_where_the_check_recognises_it():
    task = checks.TASKS["1.1"]
    right = known_mistakes._right(task)
    found = {m.name: known_mistakes.shows_in(task, m, right) for m in task.mistakes}
    assert found["misprint"] == ["H1, end value"]
    assert found["slopes swapped"] == ["H2, start slope", "H3, end slope"]
    assert all(found.values())


def test_every_task_has_a_section_of_its_own_name(monkeypatch):
    monkeypatch.setattr(known_mistakes, "shows_in", lambda *args: ["part"])
    directive = object.__new__(known_mistakes.KnownMistakes)
    sections = directive.run()[2:]
    assert len({section["ids"][0] for section in sections}) == len(sections) == len(checks.TASKS)
    assert sections[0].astext().startswith("Task 0.0: Blend two points")


def test_a_table_has_a_head_and_takes_texts_numbers_and_nodes():
    literal = known_mistakes.nodes.literal("", "x = 1")
    table = known_mistakes._table(["a", "b"], [["name", 3], [literal, "text"]])
    assert table.astext().split() == ["a", "b", "name", "3", "x", "=", "1", "text"]
