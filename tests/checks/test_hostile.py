"""Programs that would hang, fill the machine or change their own verdict: each is told plainly.

Every file in the folder `hostile` says in its first line what the report must hold; where
systems differ, one of several texts.
"""

import os
import shutil
import sys
import tempfile
import uuid
from pathlib import Path

import pytest

from canim.checks import guard
from canim.checks.file import check_file
from canim.checks.guard import Limits

FILES = sorted(Path(__file__).with_name("hostile").glob("*.py"))
MARK = "CANIM_TEST_OF_HOSTILE"


@pytest.fixture(scope="module")
def mark():
    """A word in the environment of all processes that the programs start."""
    return uuid.uuid4().hex


@pytest.fixture(scope="module")
def keeper(mark):
    with pytest.MonkeyPatch.context() as change:
        change.setenv(MARK, mark)
        kept = guard.make()
        yield kept
        kept.close()


def marked(mark):
    """Return the processes with that word in their environment, where Linux tells it."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if mark in (entry / "environ").read_text(errors="replace"):
                found.append((entry / "cmdline").read_text(errors="replace"))
        except OSError:
            continue
    return found


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_hostile_program_ends_within_the_limit_with_a_plain_report(
    path, keeper, mark, tmp_path, monkeypatch
):
    expected = path.read_text(encoding="utf-8").splitlines()[0].removeprefix("# Report: ")
    texts = expected.split(" | ")
    hangs = any("did not end" in text for text in texts)
    limits = Limits(2 if hangs else 30, 400)
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    (tmp_path / "handed_in").mkdir()
    own = Path(shutil.copy(path, tmp_path / "handed_in"))
    (report,) = check_file(own, task="1.1", limits=limits, guard=keeper)
    assert not report.done
    said = " ".join(str(report).split())
    if os.name == "posix":
        assert any(text in said for text in texts), said
    assert "Traceback" not in said
    assert [p.name for p in tmp_path.rglob("*") if p.is_file()] == [path.name]
    if sys.platform == "linux":
        assert len(marked(mark)) <= 1  # the server, which waits for the next


def test_nothing_is_left_at_the_end(keeper, mark, tmp_path):
    keeper.close()
    assert marked(mark) == []
