"""What guards read of the machine, and what programs are given of it."""

import json
import multiprocessing
import os
import pickle
import runpy
import socket
import sys
from dataclasses import asdict
from multiprocessing import connection
from types import SimpleNamespace

import pytest

from canim.checks import guard, student
from canim.checks.file import check_file

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


# --- The server, in this process: what it would do to processes is written down instead


@pytest.fixture
def pair():
    """Two ends of a socket."""
    ours, theirs = socket.socketpair()
    with ours, theirs:
        yield ours, theirs


@pytest.fixture
def done(monkeypatch):
    """What was done, in order."""
    done = []
    for name in ("_set_in_kernel", "_end_family", "_limit"):
        write = lambda *args, name=name: done.append((name, *args))  # noqa: E731
        monkeypatch.setattr(posix, name, write)
    return done


@needs_posix
@pytest.mark.parametrize("many", [True, False])
@pytest.mark.parametrize("asked", [True, False])
def test_the_server_tells_of_every_program_how_it_ended(pair, done, monkeypatch, many, asked):
    ours, theirs = pair
    limits = guard.Limits(3, 5)

    def watch(program, groups, control, given):
        done.append((program, set(groups), given))
        if asked:
            ours.sendall(b".")
        ours.shutdown(socket.SHUT_WR)  # no other program comes
        return "time"

    monkeypatch.setattr(posix, "_watch", watch)
    monkeypatch.setattr(posix.os, "fork", lambda: 77)
    with open(os.devnull) as pipe:
        socket.send_fds(ours, [json.dumps(asdict(limits)).encode()], [pipe.fileno()])
    posix.serve(theirs, many)
    adopt = ("_set_in_kernel", posix._ADOPT_ORPHANS, 1)
    assert done == [adopt, (77, {77}, limits), ("_end_family", {77})]
    theirs.close()
    assert ours.recv(20) == posix.READY + (b"time\n" if asked else b"")


@needs_posix
def test_a_copy_of_the_server_becomes_the_program(pair, done, monkeypatch, capsys):
    ours, theirs = pair
    mine, pipe = socket.socketpair()

    def exit_now(code):
        done.append(("exit", code))
        raise SystemExit

    def run(pipe, begins):
        done.append(("serve", pipe.recv_bytes(), begins))
        raise MemoryError

    monkeypatch.setattr(posix.os, "fork", lambda: 0)
    monkeypatch.setattr(posix.os, "setsid", lambda: done.append(("setsid",)))
    monkeypatch.setattr(posix.os, "_exit", exit_now)
    monkeypatch.setattr(student, "serve", run)
    with connection.Connection(mine.detach()) as asks, pipe:
        asks.send_bytes(b"hello")
        socket.send_fds(ours, [json.dumps(asdict(guard.Limits())).encode()], [pipe.fileno()])
        with pytest.raises(SystemExit):
            posix.serve(theirs, False)
    assert theirs.fileno() == -1  # it cannot speak for the server
    assert done[1:] == [
        ("setsid",),
        ("_set_in_kernel", posix._DIE_WITH_PARENT, posix.signal.SIGKILL),
        ("_limit", guard.Limits()),
        ("serve", b"hello", guard.be_silent),
        ("exit", 0),
    ]
    assert "MemoryError" in capsys.readouterr().err


@needs_posix
def test_the_module_serves_what_stands_at_its_input(pair, monkeypatch):
    ours, theirs = pair
    ours.shutdown(socket.SHUT_WR)
    monkeypatch.setattr(sys, "argv", [posix.__file__, "False"])
    before = os.dup(0)
    os.dup2(theirs.fileno(), 0)
    try:
        ran = runpy.run_path(posix.__file__, run_name="__main__")
        assert os.read(0, 1) == b""  # nobody types
    finally:
        os.dup2(before, 0)
        os.close(before)
        posix._set_in_kernel(posix._ADOPT_ORPHANS, 0)
    ran["own_end"].close()


@needs_posix
def test_a_program_may_take_what_its_limits_say(monkeypatch):
    limited = {}
    monkeypatch.setattr(posix.resource, "setrlimit", limited.__setitem__)
    posix._limit(guard.Limits(megabytes=300))
    assert limited.pop(posix.resource.RLIMIT_CORE) == (0, 0)
    assert limited.pop(posix.resource.RLIMIT_FSIZE) == (guard.LARGEST_FILE,) * 2
    if sys.platform == "linux":
        soft, hard = limited.pop(posix.resource.RLIMIT_AS)
        assert soft == hard > 300e6  # above what Python and numpy have taken
    assert limited == {}


@needs_posix
@pytest.mark.parametrize(
    ("broken", "changed"),
    [
        ("", {"ended": [[], [7]]}),
        ("time", {"times": [0, 61]}),
        ("processes", {"family": set(range(guard.MOST_PROCESSES + 1))}),
        ("memory", {"memory": 2001}),
    ],
)
def test_a_program_is_watched_until_it_ends_or_breaks_a_limit(pair, monkeypatch, broken, changed):
    watched = {"ended": [[], []], "times": [0, 60, 60], "family": {7}, "memory": 2000} | changed
    ended, times = iter(watched["ended"]), iter(watched["times"])
    monkeypatch.setattr(posix.time, "monotonic", lambda: next(times))
    monkeypatch.setattr(posix, "_ended", lambda: next(ended))
    monkeypatch.setattr(posix, "_family", lambda groups: watched["family"])
    monkeypatch.setattr(posix, "_memory", lambda family: watched["memory"])
    assert posix._watch(7, {7}, pair[0], guard.Limits()) == broken


@needs_posix
@pytest.mark.parametrize("by_itself", [True, False])
def test_a_program_that_nobody_asks_any_more_may_end_by_itself(pair, monkeypatch, by_itself):
    pair[1].sendall(b".")
    ended = iter([[], [7] if by_itself else []])
    times = iter([0, 0, 0, posix.GRACE])
    monkeypatch.setattr(posix.time, "monotonic", lambda: next(times))
    monkeypatch.setattr(posix.time, "sleep", lambda seconds: None)
    monkeypatch.setattr(posix, "_ended", lambda: next(ended))
    assert posix._watch(7, {7}, pair[0], guard.Limits()) == ""
    assert list(ended) == []


@needs_posix
def test_who_has_ended_is_buried_until_nobody_is_left(monkeypatch):
    buried = iter([(5, 0), (6, 0), (0, 0)])
    monkeypatch.setattr(posix.os, "waitpid", lambda *which: next(buried))
    assert posix._ended() == [5, 6]

    def nobody(*which):
        raise ChildProcessError

    monkeypatch.setattr(posix.os, "waitpid", nobody)
    assert posix._ended() == []


@needs_posix
def test_signals_go_to_those_who_are_there(monkeypatch):
    sent = []

    def kill(process, number):
        if process in (2, 3):
            raise ProcessLookupError if process == 2 else PermissionError
        sent.append((process, number))

    monkeypatch.setattr(posix.os, "kill", kill)
    posix._signal({1, 2, 3, 4}, 9)
    assert sorted(sent) == [(1, 9), (4, 9)]


@needs_posix
def test_this_process_and_its_memory_are_seen():
    me = os.getpid()
    assert posix._processes()[me][0] == os.getppid()
    assert posix._memory({me}) > 1


# --- What the server answers, and a server that is gone


@needs_posix
def test_the_server_that_is_there_takes_the_next_program(pair, monkeypatch):
    ours, theirs = pair
    kept = guard.make()
    monkeypatch.setattr(kept, "_server", "is there")
    monkeypatch.setattr(kept, "_control", ours, raising=False)
    for answer in ("time", ""):
        pipe = kept.start(guard.Limits())
        theirs.sendall(f"{answer}\n".encode())
        assert kept.end() == answer
        assert pipe.closed


@needs_posix
@pytest.mark.parametrize("still_takes", [True, False])
def test_the_next_program_gets_another_server(pair, monkeypatch, still_takes):
    ours, theirs = pair
    kept = guard.make()
    started = []
    monkeypatch.setattr(kept, "_server", None)
    monkeypatch.setattr(kept, "_start_server", lambda: started.append(ours.dup()))
    monkeypatch.setattr(kept, "_control", ours, raising=False)
    pipe = kept.start(guard.Limits())
    (server,) = started
    server.close()
    if still_takes:
        theirs.shutdown(socket.SHUT_WR)
    else:
        theirs.close()
    assert kept.end() == ""
    assert pipe.closed
    assert kept.end() == ""  # of the same program, as often as it is asked


@needs_posix
def test_a_pipe_ends_with_the_server_whoever_holds_its_other_end(pair):
    ours, theirs = pair
    mine, others = connection.Pipe()
    pipe = posix._Pipe(os.dup(mine.fileno()), ours)
    others.send_bytes(b"first")
    assert pipe.recv_bytes() == b"first"
    theirs.close()
    with pytest.raises(EOFError):
        pipe.recv_bytes()
    for end in (pipe, mine, others):
        end.close()


# --- What fails before a program begins


@pytest.fixture
def broken_server(tmp_path, monkeypatch):
    """Let the server of the next guard do something before all else."""

    def made(does):
        (tmp_path / "sitecustomize.py").write_text(does)
        monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
        return guard.make(many=True)

    return made


@needs_posix
def test_a_server_that_does_not_get_ready_is_a_fault_with_what_it_said(broken_server):
    kept = broken_server("import sys\nsys.modules['canim.plotting'] = None\n")
    with pytest.raises(guard.Fault) as caught:
        kept.start(guard.Limits())
    told = str(caught.value)
    assert told.startswith(
        "The check itself failed, no program is to blame: what starts the programs did not get "
        "ready. It stopped in "
    )
    assert "guard_posix.py, line" in told
    assert "import of canim.plotting halted" in told
    assert str(pickle.loads(pickle.dumps(caught.value))) == told  # a worker hands it over
    kept.close()


@needs_posix
def test_a_server_that_says_nothing_is_ended(broken_server, monkeypatch):
    monkeypatch.setattr(posix, "START", 0.0)
    kept = broken_server("import time\ntime.sleep(60)\n")
    with pytest.raises(guard.Fault, match=r"did not get ready\.$"):
        kept.start(guard.Limits())


@needs_posix
def test_a_system_that_starts_no_process_is_told(monkeypatch):
    def refuse(*args, **options):
        raise BlockingIOError(11, "Resource temporarily unavailable")

    monkeypatch.setattr(posix.subprocess, "Popen", refuse)
    with pytest.raises(guard.Fault, match=r"no program can be started: Resource temporarily"):
        guard.make().start(guard.Limits())


NO_FORK = """
import os
def fork():
    raise OSError(12, "Cannot allocate memory")
os.fork = fork
"""
NO_TASK = """
import os, canim.checks
found = canim.checks.find
def find(task):
    raise RuntimeError("no such task")
canim.checks.find = find
"""


@needs_posix
@pytest.mark.parametrize(
    ("does", "words"),
    [(NO_FORK, "Cannot allocate memory"), (NO_TASK, "RuntimeError: no such task")],
)
def test_what_fails_before_the_program_begins_is_a_fault(broken_server, tmp_path, does, words):
    path = tmp_path / "task_1_1.py"
    path.write_text("x = 1")
    kept = broken_server(does)
    with pytest.raises(guard.Fault, match="ended before the program began") as caught:
        check_file(path, guard=kept)
    assert words in str(caught.value)
    kept.close()


@needs_posix
def test_a_server_that_is_gone_is_a_fault(tmp_path):
    kept = guard.make()
    kept.start(guard.Limits())
    kept.end()
    kept._server.kill()
    kept._server.wait()
    with pytest.raises(guard.Fault, match="no program can be started"):
        kept.start(guard.Limits())


def test_a_limit_that_is_too_small_to_begin_is_told_as_one(tmp_path):
    here, there = multiprocessing.Pipe()
    there.close()
    late = SimpleNamespace(start=lambda limits: here, end=lambda: "time")
    path = tmp_path / "task_1_1.py"
    path.write_text("x = 1")
    (report,) = check_file(path, guard=late, limits=guard.Limits(seconds=1e-9))
    assert report.notes[0].startswith("The program did not end within 1e-09 seconds.")
    here.close()


def test_what_is_told_of_a_fault_is_not_endless():
    told = str(guard.Fault("it is broken.", "x" * 10**6))
    assert len(told) < 10**4
    assert str(guard.Fault("it is broken.")).endswith("no program is to blame: it is broken.")


def test_what_a_program_writes_as_an_error_is_seen_by_nobody(capfd):
    before = os.dup(2)
    try:
        guard.be_silent()
        os.write(2, b"loud")
    finally:
        os.dup2(before, 2)
        os.close(before)
    assert capfd.readouterr().err == ""
