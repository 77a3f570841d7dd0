"""Write the files of a new task: page, check, model solution and tests, to be filled in.

    python docs/new_task.py 1.10 ease_in_out "Start and stop gently"

The project's tests fail until nothing is left to fill in.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from string import Template

BLOCKS = {"1": "interpolation", "2": "warping", "3": "character"}
LONGEST_TITLE = 45  # a longer one does not fit a phone

PAGE = r'''r"""
.. _task-$label:

$heading
$underline

FILL IN: two sentences. What do you make? Why does an animator need it?
"""

import matplotlib.pyplot as plt
import numpy as np

import canim

plt.style.use("canim.style")

t = np.linspace(0, 1, 101)  # FILL IN: what the program is given

# %%
# Expected result
# ---------------
# FILL IN: what is to be seen in the picture.

from canim.checks.task_$number import $name as right

# Picture: FILL IN: the picture in words, for those who cannot see it.
fig, ax = plt.subplots(num="Expected result")
ax.set(xlim=(0, 1), ylim=(-0.1, 1.1), xlabel="FILL IN", ylabel="FILL IN")
ax.plot(t, right(t), label="FILL IN")
canim.plotting.label_curves(ax)

# %%
# Theory
# ------
# FILL IN: something from everyday life, then the formula, then where to read more.

# %%
# Pseudocode
# ----------
#
# .. code-block:: text
#
#    $name(t):
#        FILL IN: piece by piece, in words

# %%
# Your task
# ---------
# FILL IN: what to write. Which piece is given?


def $name(t):
    """Return FILL IN."""
    curve = np.full(len(t), np.nan)
    # TODO: FILL IN: the pieces, by the names that they have in the pseudocode
    return curve


# %%
# Check and draw
# --------------
# FILL IN: what to look at after each line. Before you start the check says:

canim.check("$id", $name=$name)

# Picture: FILL IN: what is drawn before anything is written.
fig, ax = plt.subplots(num="Yours")
ax.set(xlim=(0, 1), ylim=(-0.1, 1.1), xlabel="FILL IN", ylabel="FILL IN")
ax.plot(t, $name(t), label="FILL IN")
canim.plotting.label_curves(ax)

# %%
# Think about it
# --------------
# 1. FILL IN: a prediction first, then what to try.
# 2. FILL IN: a reason to find.
#
# Read more
# ---------
# FILL IN: functions of canim, and the next task.
'''

CHECK = r'''"""Task $id: what "done" means for FILL IN."""

from __future__ import annotations

import numpy as np

from canim.checks.task import Array, Case, Floats, Function, Part, Task, at

# FILL IN: the values on which the student's function is tried; the last case is a small one.
CASES = (Case((np.linspace(0, 1, 11),)), Case((np.array([0.3]),), "one value of t"))


def $name(t: Floats) -> Floats:
    """Return what is right."""
    return np.full(len(t), np.nan)  # FILL IN


TASK = Task(
    id="$id",
    name="$name",
    title="$title",
    block="$block",
    writes="FILL IN: what, and how many lines",
    minutes=30,  # FILL IN
    figure="",  # of the paper
    questions=2,
    builds_on=(),  # FILL IN: tasks, as in ("1.1",)
    functions=(
        Function(
            "$name",
            "$name(t)",
            Array(lambda t: (len(t),), "one number per value of t"),
            $name,
        ),
    ),
    # FILL IN: a part for each piece of the pseudocode
    parts=(Part("curve", lambda program, t: program.$name(t), CASES, at("t")),),
    # FILL IN: for each part, the line of the pseudocode that it belongs to
    lines={"curve": ""},
    # FILL IN: at least three, each a
    # Mistake("name", "A hint of one sentence.", {...}, source="authors")
    mistakes=(),
)
'''

SOLUTION = r'''import numpy as np


def $name(t):
    """Return FILL IN."""
    curve = np.full(len(t), np.nan)
    # FILL IN: the task, as a good student would write it
    return curve
'''

TEST = r'''"""Task $id: what a student may write, and what half of it is worth."""

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["$id"]


def states(written):
    return [result.state for result in checks.run(TASK, {"$name": written}).results]


def _point_by_point(t):
    return [np.nan for moment in t]  # FILL IN: right, with a loop


def _in_another_way(t):
    return np.full(len(t), np.nan)  # FILL IN: right, but not as in the model solution


@pytest.mark.parametrize("written", [_point_by_point, _in_another_way])
def test_it_may_be_written_in_other_ways(written):
    assert set(states(written)) == {"done"}


def test_what_is_nearly_right_is_not_done():
    assert "differs" in states(lambda t: t)  # FILL IN: wrong by a little
'''

NEXT = """
1. Fill in the check: it says what is right. Then the page, the solution, the tests.
2. Run the tests of this task: python -m nox -s tests -- -k "{id} or {number}"
3. Look at the page: python -m nox -s docs_live
4. Write a line into CHANGELOG.md.
"""


def write(root: Path, number: str, name: str, title: str) -> list[Path]:
    """Write the files of task `number` of the project in `root`; return where they are.

    Raises
    ------
    ValueError
        If number, name or title cannot be those of a new task. Then nothing is written.
    """
    if not re.fullmatch(r"[123]\.[1-9]\d?", number):
        raise ValueError(f"number must be that of a block, a dot and a count, not {number!r}.")
    if not re.fullmatch(r"[a-z][a-z0-9_]{2,39}", name):
        raise ValueError(f"name must be of small letters, digits and _, as in a_b, not {name!r}.")
    if not title or len(title) > LONGEST_TITLE or set(title) & set('"\\\n'):
        raise ValueError(
            f"title must be a line of 1 to {LONGEST_TITLE} letters, without quotes, not {title!r}."
        )
    stem = f"task_{number.replace('.', '_')}"
    block = BLOCKS[number[0]]
    files = {
        f"gallery/{block}/{stem}_{name}.py": PAGE,
        f"src/canim/checks/{stem}.py": CHECK,
        f"tests/gallery/solutions/{stem}_{name}.py": SOLUTION,
        f"tests/checks/test_{stem}.py": TEST,
    }
    taken = [path for path in files if (root / path).exists()]
    if taken:
        raise ValueError(f"number {number} is taken: there is {taken[0]}.")
    heading = f"Task {number}: {title}"
    words = {
        "id": number,
        "number": number.replace(".", "_"),
        "label": number.replace(".", "-"),
        "name": name,
        "title": title,
        "block": block,
        "heading": heading,
        "underline": "=" * len(heading),
    }
    for path, text in files.items():
        (root / path).write_text(Template(text).substitute(words), encoding="utf-8", newline="\n")
    return [root / path for path in files]


def main() -> int:
    parser = argparse.ArgumentParser(prog="nox -s new_task --", description=__doc__.split(":")[0])
    parser.add_argument("number", help="a free one, such as 1.10, the tenth of the first block")
    parser.add_argument("name", help="of the files and of the function to write, as ease_in_out")
    parser.add_argument("title", help="what the student does, in quotes")
    asked = parser.parse_args()
    root = Path(__file__).parents[1]
    try:
        written = write(root, asked.number, asked.name, asked.title)
    except ValueError as error:
        print(f"No new task: {error}", file=sys.stderr)
        return 2
    print("Written, to be filled in:")
    for path in written:
        print(f"  {path.relative_to(root).as_posix()}")
    print(NEXT.format(id=asked.number, number=asked.number.replace(".", "_")), end="")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
