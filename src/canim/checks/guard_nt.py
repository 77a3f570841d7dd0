"""Start students' programs on Windows, and end them with all that they have started.

Each program has a process of its own, which puts itself into a job object before the program
runs: Windows ends all processes of a job with the one that holds it, and limits their number
and memory.
"""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import subprocess
import sys
import tempfile
import threading
import traceback
from multiprocessing import connection
from typing import IO

from canim.checks.guard import MOST_PROCESSES, START, Fault, Limits, be_silent, environment
from canim.checks.remote import Pipe

assert sys.platform == "win32"

READY = b"+"
GRACE = 2.0
# Names of Windows's JOBOBJECT_EXTENDED_LIMIT_INFORMATION and its flags.
_EXTENDED_LIMITS, _MOST_PROCESSES, _JOB_MEMORY, _END_WITH_HOLDER = 9, 0x8, 0x200, 0x2000


class Guard:
    """The checking process's side: one program at a time, each in a Python of its own."""

    def __init__(self, many: bool) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._pipe: connection.PipeConnection
        self._errors: IO[bytes]
        self._timer: threading.Timer
        self._broken = ""
        self._said = ""

    def start(self, limits: Limits) -> Pipe:
        """Start a process that waits for a program, and return the pipe to it."""
        self._pipe, theirs = multiprocessing.Pipe()
        handle = theirs.fileno()
        os.set_handle_inheritable(handle, True)
        self._broken = ""
        try:
            # In a file: a pipe that nobody reads would fill up.
            self._errors = tempfile.TemporaryFile()  # noqa: SIM115
            self._process = subprocess.Popen(
                # -P: a json.py of the student's must not take the place of Python's.
                [sys.executable, "-P", "-m", __name__, str(handle), str(limits.megabytes)],
                env=environment(),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=self._errors,
                startupinfo=subprocess.STARTUPINFO(lpAttributeList={"handle_list": [handle]}),
            )
        except OSError as error:
            raise Fault(f"no program can be started: {error.strerror}.") from error
        finally:
            theirs.close()
        self._timer = threading.Timer(limits.seconds, self._end_late)
        if not self._is_ready():
            self._process.kill()
            self.end()
            raise Fault("the process of the program did not get ready.", self._said)
        self._timer.start()
        return self._pipe

    def _is_ready(self) -> bool:
        try:
            return self._pipe.poll(START) and self._pipe.recv_bytes(1) == READY
        except (OSError, EOFError):
            return False

    def said(self) -> str:
        """Return what was said on standard error, by our own part of the last process."""
        return self._said

    def _end_late(self) -> None:
        self._broken = "time"
        if self._process:
            self._process.kill()

    def end(self) -> str:
        """End the process and all that it has started; return the limit it broke, or ""."""
        if self._process:
            self._timer.cancel()
            self._pipe.close()
            try:
                self._process.wait(GRACE)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
            self._errors.seek(0)
            self._said = self._errors.read().decode(errors="replace")
            self._errors.close()
            self._process = None
        return self._broken

    def close(self) -> None:
        """Nothing is kept for the next program."""


class _Basic(ctypes.Structure):
    _fields_ = (
        ("process_time", ctypes.c_int64),
        ("job_time", ctypes.c_int64),
        ("flags", ctypes.c_uint32),
        ("smallest_working_set", ctypes.c_size_t),
        ("largest_working_set", ctypes.c_size_t),
        ("processes", ctypes.c_uint32),
        ("affinity", ctypes.c_size_t),
        ("priority", ctypes.c_uint32),
        ("scheduling", ctypes.c_uint32),
    )


class _Extended(ctypes.Structure):
    _fields_ = (
        ("basic", _Basic),
        ("counters", ctypes.c_uint64 * 6),
        ("process_memory", ctypes.c_size_t),
        ("job_memory", ctypes.c_size_t),
        ("peak_process_memory", ctypes.c_size_t),
        ("peak_job_memory", ctypes.c_size_t),
    )


def limit(megabytes: float) -> None:
    """Put this process into a job that ends with it."""
    kernel = ctypes.WinDLL("kernel32", use_last_error=True)
    kernel.CreateJobObjectW.restype = ctypes.c_void_p
    kernel.GetCurrentProcess.restype = ctypes.c_void_p
    kernel.CreateJobObjectW.argtypes = (ctypes.c_void_p, ctypes.c_wchar_p)
    kernel.SetInformationJobObject.argtypes = (
        ctypes.c_void_p,
        ctypes.c_int,
        ctypes.c_void_p,
        ctypes.c_uint32,
    )
    kernel.AssignProcessToJobObject.argtypes = (ctypes.c_void_p, ctypes.c_void_p)
    limits = _Extended(
        basic=_Basic(
            flags=_MOST_PROCESSES | _JOB_MEMORY | _END_WITH_HOLDER, processes=MOST_PROCESSES
        ),
        job_memory=int(megabytes * 1e6),
    )
    # The job is held by this process alone: it is never closed before the end.
    job = kernel.CreateJobObjectW(None, None)
    size = ctypes.sizeof(limits)
    kernel.SetInformationJobObject(job, _EXTENDED_LIMITS, ctypes.byref(limits), size)
    kernel.AssignProcessToJobObject(job, kernel.GetCurrentProcess())


def main(handle: int, megabytes: float) -> None:
    """Become the process of one program."""
    from canim.checks import student

    try:
        os.set_handle_inheritable(handle, False)
        limit(megabytes)
        pipe = connection.PipeConnection(handle)
        pipe.send_bytes(READY)
        student.serve(pipe, be_silent)
    except BaseException:
        traceback.print_exc()  # seen where the program has not begun
    finally:
        os._exit(0)  # a thread that the program left behind would go on


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
