"""Start students' programs on Linux and macOS, and end them with all that they have started.

A server, started once, has imported what nearly every program imports. Each program runs in
a copy of it (a fork): what a program changes in numpy is gone with its copy, and no program
waits for imports. The server watches the time, the memory and the processes of the copy.
"""

from __future__ import annotations

import contextlib
import ctypes
import importlib
import json
import os
import re
import resource
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time
import traceback
from dataclasses import asdict
from multiprocessing import connection
from pathlib import Path
from typing import IO

from canim import checks
from canim.checks.guard import (
    LARGEST_FILE,
    MOST_PROCESSES,
    START,
    Fault,
    Limits,
    be_silent,
    environment,
)

# What programs of the course import, beside the tasks themselves.
IMPORTED = ("canim.plotting", "canim.data", "PIL.Image", "scipy.spatial")
READY = b"+"
LONGEST_PAUSE = 0.2
# Names of Linux's <sys/prctl.h>.
_DIE_WITH_PARENT, _ADOPT_ORPHANS = 1, 36
# A program that nobody asks any more ends by itself, at once.
GRACE = 2.0
# For each process: its parent and its group.
Processes = dict[int, tuple[int, int]]


class Guard:
    """The checking process's side: one server, and one program at a time."""

    def __init__(self, many: bool) -> None:
        self._many = many
        self._server: subprocess.Popen[bytes] | None = None
        self._control: socket.socket
        self._errors: IO[bytes]
        self._said = ""
        self._pipe: _Pipe | None = None
        self._broken = ""

    def start(self, limits: Limits) -> _Pipe:
        """Start a process that waits for a program, and return the pipe to it."""
        try:
            if self._server is None:
                self._start_server()
            order = json.dumps(asdict(limits)).encode()
            ours, theirs = socket.socketpair()
            with ours, theirs:
                socket.send_fds(self._control, [order], [theirs.fileno()])
                self._pipe = _Pipe(ours.detach(), self._control)
        except OSError as error:
            self.close()
            raise Fault(f"no program can be started: {error.strerror}.", self._said) from error
        return self._pipe

    def said(self) -> str:
        """Return what was said on standard error, by our own part of the last process."""
        if self._server:
            self._errors.seek(0)
            self._said = self._errors.read().decode(errors="replace")
        return self._said

    def end(self) -> str:
        """End the process and all that it has started; return the limit it broke, or ""."""
        if self._pipe:
            self._pipe.close()
            self._pipe = None
            self._broken = self._wait_for_end()
        return self._broken

    def _wait_for_end(self) -> str:
        try:
            self._control.sendall(b".")
            answer = self._control.recv(20)
        except OSError:
            answer = b""
        if not answer:
            self.close()  # the program has ended the server: the next one gets another
        return answer.decode().strip()

    def close(self) -> None:
        """End the server."""
        if self._server:
            self._control.close()
            self._server.wait()
            self.said()
            self._errors.close()
            self._server = None

    def _start_server(self) -> None:
        with contextlib.ExitStack() as unused:
            # In a file: a pipe that nobody reads would fill up.
            self._errors = unused.enter_context(tempfile.TemporaryFile())
            self._control, theirs = socket.socketpair()
            unused.push(self._control)
            with theirs:
                self._server = subprocess.Popen(
                    # -P: a json.py of the student's must not take the place of Python's.
                    [sys.executable, "-P", "-m", __name__, str(self._many)],
                    env=environment(),
                    stdin=theirs.fileno(),
                    stdout=subprocess.DEVNULL,
                    stderr=self._errors,
                    start_new_session=True,
                )
            unused.pop_all()
        if not select.select([self._control], [], [], START)[0] or not self._control.recv(1):
            self._server.kill()
            self.close()
            raise Fault("what starts the programs did not get ready.", self._said)


class _Pipe(connection.Connection):
    """A pipe to a program; it ends when the server does, whoever else holds its other end."""

    def __init__(self, number: int, control: socket.socket) -> None:
        super().__init__(number)
        self._control = control

    def recv_bytes(self, maxlength: int | None = None) -> bytes:
        # The server is silent while a program runs: there is something only at its end.
        if self not in connection.wait([self, self._control]):
            raise EOFError
        return super().recv_bytes(maxlength)


def serve(control: socket.socket, many: bool) -> None:
    """Start a program for every order that comes, until nobody is there to send more."""
    importlib.import_module("canim.checks.student")
    if many:
        list(checks.TASKS.values())
        for name in IMPORTED:
            importlib.import_module(name)
    _set_in_kernel(_ADOPT_ORPHANS, 1)
    control.sendall(READY)
    while True:
        order, pipes, *_ = socket.recv_fds(control, 1000, 1)
        if not order:
            return
        limits = Limits(**json.loads(order))
        program = os.fork()
        if program == 0:
            _run(control, pipes[0], limits)
        os.close(pipes[0])
        groups = {program}
        broken = _watch(program, groups, control, limits)
        _end_family(groups)
        if not control.recv(1):
            return
        control.sendall(f"{broken}\n".encode())


def _run(control: socket.socket, pipe: int, limits: Limits) -> None:
    """Become the process of one program."""
    try:
        control.close()
        os.setsid()
        _set_in_kernel(_DIE_WITH_PARENT, signal.SIGKILL)
        _limit(limits)
        student = importlib.import_module("canim.checks.student")
        student.serve(connection.Connection(pipe), be_silent)
    except BaseException:
        traceback.print_exc()  # seen where the program has not begun
    finally:
        os._exit(0)  # a thread that the program left behind would go on


def _limit(limits: Limits) -> None:
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (LARGEST_FILE, LARGEST_FILE))
    if sys.platform == "linux":  # elsewhere the server measures what is taken
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        most = int(pages * resource.getpagesize() + limits.megabytes * 1e6)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def _set_in_kernel(what: int, value: int) -> None:
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(what, value, 0, 0, 0)


def _watch(program: int, groups: set[int], control: socket.socket, limits: Limits) -> str:
    """Wait until the program ends or nobody needs it; return the limit that it broke, or ""."""
    end, pause = time.monotonic() + limits.seconds, 0.01
    while not select.select([control], [], [], pause)[0]:
        if program in _ended():
            return ""
        family = _family(groups)
        if time.monotonic() > end:
            return "time"
        if len(family) > MOST_PROCESSES:
            return "processes"
        if _memory(family) > limits.megabytes:
            return "memory"
        pause = min(2 * pause, LONGEST_PAUSE)
    grace = time.monotonic() + GRACE
    while program not in _ended() and time.monotonic() < grace:
        time.sleep(0.002)
    return ""


def _ended() -> list[int]:
    """Return the children and adopted orphans that have ended since the last call."""
    ended = []
    with contextlib.suppress(ChildProcessError):
        while child := os.waitpid(-1, os.WNOHANG)[0]:
            ended.append(child)
    return ended


def _family(groups: set[int]) -> set[int]:
    """Return the processes that came from this one.

    `groups` grows by theirs: where orphans are not adopted, the group still tells them.
    """
    every = _processes()
    me = os.getpid()
    family: set[int] = set()
    grown = True
    while grown:
        new = {
            number
            for number, (parent, group) in every.items()
            if parent == me or parent in family or group in groups
        } - family
        groups |= {every[number][1] for number in new} - {every[me][1]}
        family |= new
        grown = bool(new)
    return family


def _end_family(groups: set[int]) -> None:
    """End every process that came from this one; stopped first, none can start another."""
    # Again, until nobody is left: a child may be born while its parent is being stopped.
    while family := _family(groups):
        stopped: set[int] = set()
        while new := family - stopped:
            _signal(new, signal.SIGSTOP)
            stopped |= new
            family = _family(groups)
        _signal(stopped, signal.SIGKILL)
        time.sleep(0.002)
        _ended()


def _signal(processes: set[int], number: int) -> None:
    for process in processes:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.kill(process, number)


def _processes() -> Processes:
    """Return all processes of this machine that still run."""
    return from_proc() if sys.platform == "linux" else from_ps()


def _memory(family: set[int]) -> float:
    """Return the memory that these processes take together, in megabytes."""
    return proc_memory(family) if sys.platform == "linux" else ps_memory(family)


def from_proc(folder: Path = Path("/proc")) -> Processes:
    """Return what Linux tells of all processes."""
    found = {}
    for entry in os.scandir(folder):
        if entry.name.isdigit():
            # Between number and state stands the name in brackets: it may hold anything.
            told = _read(Path(entry, "stat")).rpartition(")")[2].split()
            if told and told[0] != "Z":
                found[int(entry.name)] = (int(told[1]), int(told[2]))
    return found


def proc_memory(family: set[int], folder: Path = Path("/proc")) -> float:
    """Return the memory of these processes; what they share, as copies do, counts once."""
    texts = (_read(folder / str(number) / "smaps_rollup") for number in family)
    shares = (re.search(r"^Pss:\s+(\d+) kB", text, re.M) for text in texts)
    return sum(int(share[1]) for share in shares if share) / 1e3


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""  # the process has ended meanwhile


def from_ps() -> Processes:
    """Return what `ps` tells of all processes, on any system."""
    rows = (row for row in _ps("pid=,ppid=,pgid=,stat=") if not row[3].startswith("Z"))
    return {int(number): (int(parent), int(group)) for number, parent, group, _ in rows}


def ps_memory(family: set[int]) -> float:
    """Return the memory of these processes, less what every copy shares with this one."""
    every = {int(number): float(kilobytes) for number, kilobytes in _ps("pid=,rss=")}
    own = every[os.getpid()]
    return sum(max(0, every.get(number, 0) - own) for number in family) / 1e3


def _ps(columns: str) -> list[list[str]]:
    command = ["ps", "-axo", columns]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as asked:
        rows = [line.split() for line in asked.communicate()[0].splitlines()]
    return [row for row in rows if int(row[0]) != asked.pid]


if __name__ == "__main__":
    own_end = socket.socket(fileno=os.dup(0))
    with open(os.devnull) as nobody_types:
        os.dup2(nobody_types.fileno(), 0)
    serve(own_end, sys.argv[1] == str(True))
