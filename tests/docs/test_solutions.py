"""Completed starters and the teacher's zip."""

import re
import zipfile

import pytest
import solutions

from canim import checks

PROGRAM = """import x

a = 1
b = 2


def f():
    return None


print(f())
"""


def test_definitions_take_the_place_of_their_namesakes():
    done = solutions.complete(PROGRAM, "import y\n\nb = [\n    3,\n]\n\n\ndef f():\n    return b\n")
    assert done == PROGRAM.replace("b = 2", "b = [\n    3,\n]").replace("return None", "return b")


def test_a_new_function_goes_in_front_of_the_first_that_uses_it():
    done = solutions.complete(PROGRAM, "def g():\n    return 4\n\n\ndef f():\n    return g()\n")
    assert done.index("def g") < done.index("def f")
    compile(done, "done.py", "exec")


def test_a_solution_that_replaces_nothing_is_refused():
    with pytest.raises(ValueError, match="replaces nothing"):
        solutions.complete(PROGRAM, "c = 1\n")


def test_the_zip_has_every_completed_starter_and_the_same_bytes_twice(tmp_path, completed):
    first, second = tmp_path / "new" / "a.zip", tmp_path / "b.zip"
    solutions.pack(dict(completed), first)
    solutions.pack(dict(reversed(completed.items())), second)
    assert first.read_bytes() == second.read_bytes()
    with zipfile.ZipFile(first) as archive:
        assert sorted(archive.namelist()) == sorted(completed)
        assert (
            archive.read("task_1_1_plot_hermite_basis.py").decode()
            == (completed["task_1_1_plot_hermite_basis.py"])
        )


def test_every_question_has_its_answer(root):
    text = (root / "tests/gallery/solutions/answers.md").read_text(encoding="utf-8")
    answered = dict(re.findall(r"^## Task (\S+)\n\n((?:\d\. .+\n)+)", text, re.M))
    tasks = [task for task in checks.TASKS.values() if task.figure]  # not those of a teacher
    assert [*answered][: len(tasks)] == [task.id for task in tasks]
    for task in tasks:
        numbers = re.findall(r"^(\d)\. ", answered[task.id], re.M)
        assert numbers == [str(n) for n in range(1, task.questions + 1)], task.id
