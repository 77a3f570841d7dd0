"""What guards read of the machine, and what programs are given of it."""

import os
import sys
from multiprocessing import connection

import pytest

from canim.checks import guard

posix = pytest.importorskip("canim.checks.guard_posix") if os.name == "posix" else None
needs_posix = pytest.mark.skipif(os.name != "posix", reason="a guard for Linux and macOS")


def test_programs_get_no_display_and_one_thread(monkeypatch):
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "8")
    given = guard.environment()
    assert "DISPLAY" not in given
    assert given["OPENBLAS_NUM_THREADS"] == "1"


@needs_posix
def test_processes_are_read_from_proc(tmp_path):
    for number, stat in [(7, "7 (a) b) S 1 7 9"), (8, "8 (z) Z 7 7 9"), (9, None)]:
        (tmp_path / str(number)).mkdir()
        if stat:
            (tmp_path / str(number) / "stat").write_text(stat)
    (tmp_path / "cpuinfo").mkdir()
    (tmp_path / "7" / "smaps_rollup").write_text("Rss: 9000 kB\nPss:    1500 kB\n")
    assert posix.from_proc(tmp_path) == {7: (1, 7)}
    assert posix.proc_memory({7, 9}, tmp_path) == 1.5


@needs_posix
def test_processes_are_read_from_ps(tmp_path, monkeypatch):
    ps = tmp_path / "ps"
    ps.write_text(
        f"#!{sys.executable}\nimport os, sys\n"
        "if 'rss=' in sys.argv[-1]:\n"
        f"    print(' {os.getpid()} 2000\\n 7 3500\\n 8 100')\n"
        "else:\n"
        "    print(f' 7 1 7 S\\n 8 7 7 Z+\\n{os.getpid()} 1 1 R')\n"
    )
    ps.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    assert posix.from_ps() == {7: (1, 7)}
    assert posix.ps_memory({7, 8, 9}) == 1.5


@needs_posix
def test_the_family_is_found_by_parents_and_by_groups(monkeypatch):
    me = os.getpid()
    every = {me: (1, 5), 20: (me, 20), 21: (20, 5), 22: (1, 20), 23: (1, 5), 24: (22, 24)}
    monkeypatch.setattr(posix, "_processes", lambda: every)
    groups = {20}
    assert posix._family(groups) == {20, 21, 22, 24}
    assert groups == {20, 24}
    every[25] = (1, 24)  # an orphan, in a group that was seen before
    assert posix._family(groups) == {20, 21, 22, 24, 25}


@needs_posix
def test_a_child_born_while_its_parent_is_stopped_is_ended_too(monkeypatch):
    found = iter([{1}, {1}, {1, 2}, {1, 2}, set()])
    sent = []
    monkeypatch.setattr(posix, "_family", lambda groups: set(next(found)))
    monkeypatch.setattr(
        posix, "_signal", lambda processes, number: sent.append((processes, number))
    )
    posix._end_family(set())
    stop, kill = posix.signal.SIGSTOP, posix.signal.SIGKILL
    assert sent == [({1}, stop), ({1}, kill), ({1, 2}, stop), ({1, 2}, kill)]


@needs_posix
def test_a_guard_that_is_closed_ends_its_program():
    kept = guard.make()
    pipe = kept.start(guard.Limits())
    kept.close()
    with pytest.raises(EOFError):
        connection.Connection.recv_bytes(pipe)
    pipe.close()
