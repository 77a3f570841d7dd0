"""What a task is: its card, the student's functions, the parts that are judged, known mistakes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from canim.checks.picture import Picture

Floats = NDArray[np.float64]

BLOCKS = {
    "warm_up": "Warm-up",
    "interpolation": "Interpolation",
    "warping": "Image warping",
    "character": "Character animation",
}


# Where known mistakes come from: the first word of a mistake's source, and what it means.
SOURCES = {
    "paper": "An error of the paper, or a place that it leaves open.",
    "matlab": "An error of the course's first form, in MATLAB.",
    "study": "A kind of error that Alzahrani and Vahid found in 47 studies of beginners.",
    "thread": "A question that somebody asked in public about a program with this error.",
    "trial": "A wrong program that a reader of the page wrote when the pages were tried.",
    "neighbour": "What is right in another task, or for a similar formula.",
    "notation": "Other books or libraries write it in this way.",
    "authors": "A slip that nobody was seen to make yet: the authors of the task expect it.",
}


class Unusable(Exception):
    """What the student's function returned cannot be compared; the message says why."""


@dataclass(frozen=True)
class Array:
    """Accepts an array, or nested lists or tuples, of the shape that the arguments ask for.

    `shape` gets the arguments of the call; `words` says the shape to a student. Of data,
    which is not returned, `verb` is "is".
    """

    shape: Callable[..., tuple[int, ...]]
    words: str
    verb: str = "returns"

    def __call__(self, result: Any, *args: Any) -> Floats:
        """Return `result` as an array, or raise `Unusable`."""
        if result is None:
            raise Unusable("returns nothing (None). Is the line with return missing?")
        try:
            array = np.asarray(result)
            if array.dtype.kind not in "biufO":
                raise TypeError
            array = array.astype(float)
        except (TypeError, ValueError):
            raise Unusable(f"{self.verb} {_kind(result)}, expected {self.words}.") from None
        expected = self.shape(*args)
        if array.shape != expected:
            what = f"an array of shape {array.shape}" if array.ndim else "one number"
            raise Unusable(f"{self.verb} {what}, expected {expected}: {self.words}.")
        return array


def _kind(value: Any) -> str:
    name = type(value).__name__
    return {
        "str": "a text",
        "list": "a list that is not a table of numbers",
        "tuple": "a tuple that is not a table of numbers",
        "ndarray": "an array that does not hold numbers",
        "function": "a function",
    }.get(name, f"a value of type {name}")


@dataclass(frozen=True)
class Function:
    """A function that the student completes.

    `accept(result, *args)` turns what it returns into something to compare, or raises
    `Unusable`. `reference` has the same signature; it is None where the student is free.
    """

    name: str
    signature: str
    accept: Callable[..., Any]
    reference: Callable[..., Any] | None = None


@dataclass(frozen=True)
class Data:
    """A value that the student chooses, such as nodes or control points."""

    name: str
    accept: Callable[[Any], Any]


@dataclass(frozen=True)
class Case:
    """One set of arguments on which a part is judged; `label` names it to the student."""

    args: tuple[Any, ...]
    label: str = ""


def _all_nan(got: Floats) -> bool:
    return got.size > 0 and bool(np.isnan(got).all())


def _no_place(index: tuple[int, ...], *args: Any) -> str:
    return f"at index {', '.join(map(str, index))}" if index else ""


def at(name: str, argument: int = 0) -> Callable[..., str]:
    """Return a `place` for curves: the last index counts in that argument, called `name`."""
    return lambda index, *args: f"at {name} = {args[argument][index[-1]]:.3g}"


@dataclass(frozen=True)
class Part:
    """One line of the report.

    `measure(program, *case.args)` is what this part compares: `program` gives the
    student's functions and data, then the reference's, by attribute. `place(index, *args)`
    says where the entry `index` of the measured array is ("at t = 0.5").
    `expected(program, *args)` replaces the reference's measure where there is no single
    right answer, or what is right follows from the student's own data. `picture` draws what
    is measured, where it is a curve, an image or a chain.
    """

    name: str
    measure: Callable[..., Any]
    cases: tuple[Case, ...] = (Case(()),)
    place: Callable[..., str] = _no_place
    expected: Callable[..., Any] | None = None
    unwritten: Callable[[Floats], bool] = _all_nan
    tolerance: float = 1e-6
    describe: Callable[..., str] | None = None
    picture: Picture | None = None


@dataclass(frozen=True)
class Mistake:
    """A wrong way that is known: a hint, and functions or data that go wrong in that way.

    It is recognised in a part where it gives what the student got, or, where that
    cannot be compared, by `applies(got, expected, *args)`, in the parts named in `parts`.
    `source` says who went wrong so, beginning with a word of `SOURCES`. `line` is the line
    of the page's pseudocode to look at, where it is another one than that of the part.
    """

    name: str
    hint: str
    program: Mapping[str, Any]
    applies: Callable[..., bool] | None = None
    parts: tuple[str, ...] = ()
    source: str = ""
    line: str = ""


@dataclass(frozen=True)
class Task:
    """A task of the course: all that cards, index, command line and checks know of it.

    `lines` gives, for each part, its line of the page's pseudocode.
    """

    id: str
    name: str
    title: str
    block: str
    writes: str
    minutes: int
    figure: str
    questions: int
    functions: tuple[Function, ...]
    parts: tuple[Part, ...]
    mistakes: tuple[Mistake, ...]
    lines: Mapping[str, str] = field(default_factory=dict)
    data: tuple[Data, ...] = ()
    builds_on: tuple[str, ...] = ()
    canim_functions: tuple[Callable[..., Any], ...] = field(default=())

    @property
    def file_name(self) -> str:
        """Name of the page's script and of the starter."""
        return f"task_{self.id.replace('.', '_')}_{self.name}.py"

    @property
    def page(self) -> str:
        """Address of the page within the site, without its ending."""
        return f"gallery/{self.block}/{self.file_name.removesuffix('.py')}"

    @property
    def names(self) -> tuple[str, ...]:
        """Names under which the student's functions and data are looked up."""
        return tuple(f.name for f in self.functions) + tuple(d.name for d in self.data)
