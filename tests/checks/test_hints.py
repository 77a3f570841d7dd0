"""What every task says of itself, against a copy: nothing is exchanged or lost unseen.

No program can tell which hint belongs to which mistake, nor which input a check once had.
"""

import difflib
from pathlib import Path

import pytest

from canim import checks

COPY = Path(__file__).with_name("hints.txt")
RENEW = "nox -s tests -- tests/checks/test_hints.py --renew"


def told(task):
    """Return the lines about a task: its parts with how many cases each has, and its hints."""
    yield f"Task {task.id}"
    for part in task.parts:
        yield f"  part {part.name}: {len(part.cases)} cases"
    for mistake in task.mistakes:
        yield f"  {mistake.name}: {mistake.hint}"


def test_hints_and_cases_are_those_that_somebody_has_read(pytestconfig):
    now = [line for task in checks.TASKS.values() for line in told(task)]
    if pytestconfig.getoption("--renew"):
        COPY.write_text("\n".join(now) + "\n", encoding="utf-8", newline="\n")
    before = COPY.read_text(encoding="utf-8").splitlines()
    changed = "\n".join(difflib.unified_diff(before, now, "was", "is", lineterm="", n=0))
    if changed:
        pytest.fail(
            f"Parts, cases or hints have changed:\n{changed}\n\n"
            f"Is each of these lines meant? Then write the copy anew: {RENEW}",
            pytrace=False,
        )
