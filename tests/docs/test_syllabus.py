"""The teachers' plan: 13 sessions of two hours, and every task in one of them."""

import re

import pytest

from canim import checks

PAPERS = [task for task in checks.TASKS.values() if task.figure]  # not those of a teacher
PARTS = ["Theory", "Show", "Ask", "Lab", "Read", "Collect", "Close with"]


@pytest.fixture(scope="module")
def sessions(root):
    text = (root / "docs/course/syllabus.md").read_text(encoding="utf-8")
    return re.split(r"^## ", text, flags=re.M)[1:]


def parts(session):
    found = re.findall(r"^(\S.*)\n: ((?:.+\n?|\n(?=  ))*)", session, re.M)
    return dict(found)


def test_there_are_13_sessions_with_all_their_parts(sessions):
    assert [session.partition(".")[0] for session in sessions] == [str(n) for n in range(1, 14)]
    for session in sessions:
        assert list(parts(session)) == PARTS


def test_theory_and_lab_take_an_hour_each(sessions):
    for session in sessions:
        for name in ("Theory", "Lab"):
            minutes = re.findall(r"^(?:  )?\* (\d+) min: ", parts(session)[name], re.M)
            assert sum(map(int, minutes)) == 60, (session.splitlines()[0], name)


def test_every_task_is_in_one_lab_for_as_long_as_it_takes(sessions):
    labs = [parts(session)["Lab"] for session in sessions]
    for task in PAPERS:
        given = [
            int(minutes)
            for lab in labs
            for minutes, name in re.findall(r"\* (\d+) min: .*?Task (\d\.\d+)\b", lab)
            if name == task.id
        ]
        assert sum(given) >= 0.6 * task.minutes, task.id  # the rest is done at home


def test_every_task_has_its_marks_and_its_place_among_the_principles(root):
    marking = (root / "docs/course/marking.md").read_text(encoding="utf-8")
    principles = (root / "docs/course/principles.md").read_text(encoding="utf-8")
    for task in PAPERS:
        assert re.search(rf"^(?:{{ref}}`)?Task {task.id}\b.*\n: \* \*Full\*:", marking, re.M), (
            task.id
        )
        assert re.search(rf"^\| (?:{{ref}}`)?{task.id}\b", principles, re.M), task.id
