"""Say in one plain sentence where and why a student's line failed."""

from __future__ import annotations

import builtins
import difflib
import linecache
import re
import traceback
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from types import FrameType

LONGEST = 76


@dataclass(frozen=True)
class Crash:
    """Line number and text of the student's line (0 and "" where unknown), and the reason.

    `start` and `end` are the columns of the text that failed; they are equal where unknown.
    `cell` is the number of the notebook's code cell; 0 in a program.
    """

    line: int
    code: str
    sentence: str
    start: int = 0
    end: int = 0
    cell: int = 0

    @property
    def place(self) -> str:
        """Where the line is, in words; "" where unknown."""
        cell = f"code cell {self.cell}" if self.cell else ""
        line = f"line {self.line}" if self.line else ""
        return ", ".join(place for place in (cell, line) if place)

    @property
    def marked(self) -> str:
        """The student's line and, where known, carets below what failed, both indented."""
        left = max(0, min(self.start - LONGEST // 4, len(self.code) - LONGEST))
        code = self.code[left : left + LONGEST]
        start, end = self.start - left, min(self.end - left, len(code) + 1)
        carets = f"\n  {' ' * start}{'^' * (end - start)}" if end > start else ""
        return f"  {code}{carets}"


def explain(error: BaseException, is_students: Callable[[str], bool]) -> Crash:
    """Return where `error` left the student's own files, and why in plain words.

    `is_students(file_name)` tells the student's files from those of libraries.
    """
    if isinstance(error, SyntaxError):
        return _of_syntax(error)
    tb = error.__traceback__
    steps = zip(traceback.walk_tb(tb), traceback.extract_tb(tb), strict=True)
    own = [(frame, step) for (frame, _), step in steps if is_students(step.filename)]
    if not own:
        return Crash(0, "", sentence(error))
    frame, step = own[-1]
    line = linecache.getline(step.filename, step.lineno or 0)
    start, end = (_characters(line, place) for place in (step.colno, step.end_colno))
    if step.end_lineno != step.lineno:
        end = len(line)
    crash = _marked(step.lineno or 0, line, sentence(error, frame), start, end)
    return replace(crash, cell=cell_of(step.filename))


def cell_of(file_name: str) -> int:
    """Return the number of the cell whose code has this file name, or 0."""
    cell = re.search(r", code cell (\d+)$", file_name)
    return int(cell[1]) if cell else 0


def _of_syntax(error: SyntaxError) -> Crash:
    line = error.text or linecache.getline(error.filename or "", error.lineno or 0)
    start = max(0, (error.offset or 1) - 1)
    end = (error.end_offset or 0) - 1 if error.end_lineno == error.lineno else 0
    crash = _marked(error.lineno or 0, line, sentence(error), start, max(end, start + 1))
    return replace(crash, cell=cell_of(error.filename or ""))


def _characters(line: str, place: int | None) -> int:
    """Return how many characters stand before `place`, which Python counts in bytes."""
    return len(line.encode()[: place or 0].decode(errors="replace"))


def _marked(number: int, line: str, words: str, start: int, end: int) -> Crash:
    code = line.strip().replace("\t", " ")
    indent = len(line) - len(line.lstrip())
    # What is missing is missing behind the last letter.
    first = min(max(start - indent, 0), len(code))
    last = min(max(end - indent, 0), len(code) + (first == len(code)))
    return Crash(number, code, words, first, max(first, last)) if code else Crash(number, "", words)


def sentence(error: BaseException, frame: FrameType | None = None) -> str:
    """Return what went wrong in plain words, with Python's own message below it.

    Where the `frame` is known, a name that is not known is compared with those that are.
    """
    text = re.sub(r"\s+", " ", str(error)).strip()
    own = f"{type(error).__name__}: {text}" if text else type(error).__name__
    found, plain = next(
        (match, words)
        for kind, pattern, words in _PLAIN
        if isinstance(error, kind) and (match := re.search(pattern, text))
    )
    quoted = re.search(r"'([^']+)'", text)
    name = getattr(error, "name", None) or (quoted and quoted[1])
    words = plain.format(**{"name": name} | found.groupdict())
    return f"{words}{_meant(error, name, frame)}\n(Python says: {own})"


def _meant(error: BaseException, name: str | None, frame: FrameType | None) -> str:
    """Return a question for the known name that is most like `name`."""
    known: Iterable[str] = ()
    if isinstance(error, NameError) and not isinstance(error, UnboundLocalError) and frame:
        known = [*frame.f_locals, *frame.f_globals, *dir(builtins)]
    elif isinstance(error, AttributeError):
        known = dir(error.obj)
    like = difflib.get_close_matches(name or "", [n for n in known if n[0] != "_"], 1)
    return f" Do you mean {like[0]}?" if like else ""


# The first that fits is taken. Python's wording differs from version to version: patterns
# keep to the words that 3.11 to 3.14 have in common.
_PLAIN: list[tuple[type[BaseException], str, str]] = [
    (TabError, "", "Tabs and spaces are mixed at the start of this line. Use spaces only."),
    (IndentationError, "expected an", "What belongs to the line above starts further right."),
    (IndentationError, "unexpected", "This line starts further right than the one above it."),
    (IndentationError, "", "The spaces at the start of this line do not fit the lines around it."),
    (SyntaxError, "never closed", "A bracket is opened and never closed."),
    (SyntaxError, "unmatched", "A bracket is closed that was never opened."),
    (SyntaxError, "does not match", "A bracket is closed by one of another kind."),
    (SyntaxError, "expected ':'", "A colon is missing at the end of this line."),
    (SyntaxError, "decimal literal", "Is a star missing? Twice t is written 2 * t."),
    (SyntaxError, "assign to function call", "A place in a list or array takes square brackets."),
    (SyntaxError, "to (expr|literal)", "On the left of = stands the name that gets the value."),
    (SyntaxError, "['\"]==['\"]", "A comparison takes two equal signs: ==."),
    (SyntaxError, "forgot a comma", "Something is missing here: a comma, a star or a bracket?"),
    (SyntaxError, "unterminated", "A text is opened and never closed: a quote is missing."),
    (SyntaxError, "character", "Python does not know this sign. Type it anew on the keyboard."),
    (SyntaxError, "outside", "This line belongs to the lines above: it starts further right."),
    (SyntaxError, r"syntax( \(|$)", "Python cannot read this line. Is a star or bracket missing?"),
    (SyntaxError, "", "Python cannot read this line."),
    (UnboundLocalError, "", "The name {name} is used before it gets a value."),
    (NameError, "", "The name {name} is not known here. Look at its spelling."),
    (IndexError, "only integers|as indices", "An index is a whole number: use range(len(...))."),
    (IndexError, "too many indices", "There are too many numbers between these square brackets."),
    (IndexError, "index -", "An index lies before the first one: it is too far below 0."),
    (IndexError, r"x (?P<i>\d+).*size (?P<n>\d+)", "Index {i}: there are {n}, counted from 0."),
    (IndexError, "", "An index is too large: counting starts at 0 and ends one before the length."),
    (ZeroDivisionError, "", "Something is divided by zero."),
    (RecursionError, "", "A function calls itself without end."),
    (ValueError, "too big|Maximum allowed", "An array here is larger than the memory."),
    (ValueError, "must be square", "Only a square matrix has an inverse."),
    (ValueError, r"into shape \(0", "There is nothing to write into: these places are outside."),
    (ValueError, "float NaN", "A number here is nan: it is not written yet, or was divided by 0."),
    (ValueError, "enough dimensions", "One side of @ is a single number, not an array."),
    (ValueError, "to unpack", "The number of names on the left of = is not that of the values."),
    (ValueError, "inhomogeneous", "The rows of this table do not all have the same length."),
    (ValueError, "broadcast|shape|dimension|aligned|matmul", "The sizes of two arrays differ."),
    (ValueError, "truth value of an array", "One number is needed here, but there is an array."),
    (TypeError, "to Python scalar", "One number is needed here, but there is an array."),
    (TypeError, r"bitwise_xor|for \^", "A power is written with two stars, as in t**3."),
    (TypeError, "NoneType", "A value here is None: is a return missing?"),
    (TypeError, "list indices", "A list takes one whole number as index: make it an array first."),
    (TypeError, "integer|non-int", "A whole number is needed here, without decimals."),
    (TypeError, "Cannot cast", "This array holds whole numbers only. Make one that has decimals."),
    (TypeError, r"operand.*'(tuple|list)'", "Lists and tuples do not calculate: use np.array."),
    (TypeError, "function.*subscriptable", "A function is called with round brackets."),
    (TypeError, r"'(int|\S*float\d*)'.*not call", "Is a star missing before this bracket?"),
    (TypeError, "not callable", "Round brackets call a function; an entry takes square ones."),
    (TypeError, r"s (?P<n>.+) pos.*t (?P<m>\d+)", "Between the brackets are {m} values, not {n}."),
    (TypeError, r"missing .*argument", "The function gets too few values between its brackets."),
    (TypeError, "argument", "The function is called with too few, too many or wrong arguments."),
    (TypeError, "", "A value here has the wrong type for what is done with it."),
    (AttributeError, "NoneType", "A value here is None: is a return missing?"),
    (AttributeError, r"no attribute '(?P<name>[^']+)'", "This value has nothing called {name}."),
    (AttributeError, "", "This value does not have what is asked of it."),
    (ModuleNotFoundError, "", "The module {name} is not installed. Look at its spelling, too."),
    (ImportError, "name '(?P<name>[^']+)' from", "There is nothing called {name} to import there."),
    (MemoryError, "", "An array here is larger than the memory."),
    (EOFError, "when reading a line", "The check types nothing: write the value into the program."),
    (OSError, "No space left", "The disk of this computer is full. The program is not to blame."),
    (FileNotFoundError, "", "A file that this line opens is not there."),
    (BaseException, "", "This line stopped the program."),
]  # fmt: skip
