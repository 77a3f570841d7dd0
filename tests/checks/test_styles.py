"""Right programs in many styles are accepted: loops, matrices, lists, other orders, other rounding.

They are written from the pages, as readers would. In `styles/task_N_M.py` a name such as
`blend__with_lists` is one of the task's functions or data, then the style. Those of one style
go together; what a style does not have is taken from the model solution.
"""

import runpy
from collections import defaultdict
from pathlib import Path

import pytest

from canim import checks

FOLDER = Path(__file__).parent / "styles"


def styles(task):
    """Return, for each style, the names that are written in it."""
    path = FOLDER / f"task_{task.id.replace('.', '_')}.py"
    found = defaultdict(dict)
    for name, value in runpy.run_path(str(path)).items() if path.exists() else ():
        written, two, style = name.partition("__")
        if two and written:
            assert written in task.names
            found[style][written] = value
    return found


ALL = [
    (task, style, names) for task in checks.TASKS.values() for style, names in styles(task).items()
]


@pytest.mark.parametrize(
    ("task", "style", "names"), ALL, ids=[f"{task.id} {style}" for task, style, _ in ALL]
)
def test_a_right_program_in_another_style_is_accepted(task, style, names, solved):
    report = checks.run(task, solved(task) | names)
    assert report.done, str(report)
    assert not report.hints


@pytest.mark.parametrize(
    "task", [task for task in checks.TASKS.values() if task.figure], ids=lambda task: task.id
)
def test_every_task_has_three_styles_at_least(task):
    assert len(styles(task)) >= 3
