"""Call a student's functions in another process.

What comes from there is data, never code: JSON, and arrays as their bytes. The verdict is
made here, where the student's program has never run: it can change no function of numpy
or canim that the verdict uses.
"""

from __future__ import annotations

import builtins

# Kept by name: the other side of this module runs beside programs that replace such functions.
from base64 import b64decode, b64encode
from collections.abc import Callable
from dataclasses import asdict
from json import dumps, loads
from os import _exit, getpid
from typing import Any, Protocol

from numpy import frombuffer, generic, ndarray

from canim.checks.crash import Crash
from canim.checks.program import Program, Stopped
from canim.checks.task import Data, Function, Task

# A face of 10 000 points is a quarter of a megabyte; a film of it in one answer still fits.
LARGEST_MESSAGE = 2**28


class Gone(Exception):
    """The other process does not answer any more."""


class Pipe(Protocol):
    """One end of a `multiprocessing` connection, on any system."""

    def send_bytes(self, data: bytes, /) -> None:
        """Send one message."""

    def recv_bytes(self, longest: int, /) -> bytes:
        """Return the next message."""

    def close(self) -> None:
        """Close this end."""


class Peer:
    """One of two processes that ask each other, also while they wait for an answer.

    `answer` turns what the other one asks into a reply; functions handed over are called
    where they come from.
    """

    def __init__(self, pipe: Pipe, answer: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
        self._pipe = pipe
        self._answer = answer
        self._functions: list[Callable[..., Any]] = []
        self._owner = getpid()

    def ask(self, **question: Any) -> dict[str, Any]:
        """Return the other's reply; meanwhile, answer its questions."""
        self._send({"ask": question})
        while True:
            message = self._receive()
            if "reply" in message:
                return dict(message["reply"])
            self._reply(message["ask"])

    def serve(self) -> None:
        """Answer questions until the other one is gone."""
        while True:
            self._reply(self._receive()["ask"])

    def _reply(self, question: dict[str, Any]) -> None:
        answer = self._run if "function" in question else self._answer
        self._send({"reply": answer(question)})

    def _run(self, question: dict[str, Any]) -> dict[str, Any]:
        try:
            return {"value": self._functions[question["function"]](*question["args"])}
        except Stopped as stopped:
            return told(stopped)
        except Exception as error:
            return {"error": [type(error).__name__, str(error)]}

    def _call(self, number: int, *args: Any) -> Any:
        reply = self.ask(function=number, args=list(args))
        if "stopped" in reply:
            raise heard(reply)
        if "error" in reply:
            name, text = reply["error"]
            raise _kind(name)(str(text))
        return reply["value"]

    def _send(self, message: dict[str, Any]) -> None:
        text = dumps(self._encode(message))
        if getpid() != self._owner:
            _exit(0)  # a copy of the process, made by the student's program
        try:
            self._pipe.send_bytes(text.encode())
        except OSError as error:
            raise Gone from error

    def _receive(self) -> dict[str, Any]:
        try:
            message = self._decode(loads(self._pipe.recv_bytes(LARGEST_MESSAGE)))
        except (EOFError, OSError, ValueError, TypeError, LookupError, RecursionError) as error:
            raise Gone from error
        if not isinstance(message, dict) or not {"ask", "reply"} & message.keys():
            raise Gone
        return message

    def _encode(self, value: Any) -> Any:
        if value is None or type(value) in (bool, int, float, str):
            return value
        if isinstance(value, (ndarray, generic)):
            if value.dtype.kind not in "biufc":
                return self._encode(value.tolist())
            data = b64encode(value.tobytes()).decode()
            return {"array": [value.dtype.str, list(value.shape), data]}
        if isinstance(value, (list, tuple)):
            kind = "list" if isinstance(value, list) else "tuple"
            return {kind: [self._encode(entry) for entry in value]}
        if type(value) is dict:
            return {"dict": [[key, self._encode(entry)] for key, entry in value.items()]}
        if callable(value):
            self._functions.append(value)
            return {"function": len(self._functions) - 1}
        return {"other": type(value).__name__}

    def _decode(self, value: Any) -> Any:
        if not isinstance(value, dict):
            return value
        ((kind, content),) = value.items()
        if kind == "array":
            dtype, shape, data = content
            array = frombuffer(b64decode(data), dtype).reshape(shape)
            return array.copy() if shape else array[()]
        if kind == "list":
            return [self._decode(entry) for entry in content]
        if kind == "tuple":
            return tuple(self._decode(entry) for entry in content)
        if kind == "dict":
            return {key: self._decode(entry) for key, entry in content}
        if kind == "function":
            return lambda *args: self._call(content, *args)
        return type(str(content), (), {})()


def _kind(name: Any) -> type[Exception]:
    """Return Python's own error of that name; the name is the other side's, and may be any."""
    kind = getattr(builtins, str(name), None)
    return kind if isinstance(kind, type) and issubclass(kind, Exception) else RuntimeError


def told(stopped: Stopped) -> dict[str, Any]:
    """Return `stopped` as a reply."""
    problem = stopped.problem
    plain = asdict(problem) if isinstance(problem, Crash) else problem
    return {"stopped": stopped.name, "problem": plain}


def heard(reply: dict[str, Any]) -> Stopped:
    """Return what a reply made by `told` says."""
    problem = reply["problem"]
    found = crash(problem) if isinstance(problem, dict) else str(problem)
    return Stopped(str(reply["stopped"]), found)


def crash(fields: dict[str, Any]) -> Crash:
    """Return the crash with these fields, which the other side may have filled with anything."""
    numbers = {name: max(0, int(fields[name])) for name in ("line", "start", "end", "cell")}
    return Crash(code=str(fields["code"]), sentence=str(fields["sentence"]), **numbers)


class Remote(Program):
    """A student's functions and data that are called in another process.

    When that process is gone, `why()` says why, and the function it ended in is the one
    that stops; what is asked after it waits.
    """

    def __init__(self, task: Task, peer: Peer, why: Callable[[], str]) -> None:
        super().__init__(task, {})
        self._peer = peer
        self._why = why
        self._data: dict[str, Any] = {}
        self._last: Stopped | None = None

    @property
    def given(self) -> dict[str, Any]:
        """The student's data, as far as they can be used, and functions without a reference."""
        given: dict[str, Any] = {}
        for data in self._task.data:
            try:
                given[data.name] = self.value(data)
            except Stopped:
                given[data.name] = None
        free = [f.name for f in self._task.functions if f.reference is None]
        return given | {name: getattr(self, name) for name in free}

    def value(self, data: Data) -> Any:
        """Return the student's data of that name."""
        if data.name not in self._data:
            self._data[data.name] = self._ask(data.name, data=data.name)
        if isinstance(self._data[data.name], Stopped):
            raise self._data[data.name]
        return self._data[data.name]

    def call(self, function: Function, *args: Any) -> Any:
        """Return what the function returns, or where it stops."""
        return self._ask(function.name, call=function.name, args=list(args))

    def _ask(self, name: str, **question: Any) -> Any:
        if self._last:
            return self._last
        try:
            reply = self._peer.ask(**question)
            self.uses_canim.update(dict.fromkeys(reply["uses_canim"]))
            self.changes.update(dict.fromkeys(reply["changes"]))
            return heard(reply) if "stopped" in reply else reply["value"]
        except (Gone, LookupError, TypeError, ValueError):
            self._last = Stopped(name, f"{name} {self._why()}")
            return self._last
