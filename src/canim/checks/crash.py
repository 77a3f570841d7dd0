"""Say in one plain sentence where and why a student's line failed."""

from __future__ import annotations

import linecache
import re
import traceback
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Crash:
    """Line number and text of the student's line (0 and "" where unknown), and the reason."""

    line: int
    code: str
    sentence: str


def explain(error: BaseException, is_students: Callable[[str], bool]) -> Crash:
    """Return where `error` left the student's own files, and why in plain words.

    `is_students(file_name)` tells the student's files from those of libraries.
    """
    if isinstance(error, SyntaxError):
        line, name = error.lineno or 0, error.filename or ""
        return Crash(line, linecache.getline(name, line).strip(), sentence(error))
    frames = [f for f in traceback.extract_tb(error.__traceback__) if is_students(f.filename)]
    if not frames:
        return Crash(0, "", sentence(error))
    return Crash(frames[-1].lineno or 0, (frames[-1].line or "").strip(), sentence(error))


def sentence(error: BaseException) -> str:
    """Return what went wrong in plain words, with Python's own message behind it."""
    text = re.sub(r"\s+", " ", str(error)).strip()
    own = f"{type(error).__name__}: {text}" if text else type(error).__name__
    plain = next(
        words
        for kind, pattern, words in _PLAIN
        if isinstance(error, kind) and re.search(pattern, text)
    )
    quoted = re.search(r"'([^']+)'", text)
    name = getattr(error, "name", None) or (quoted and quoted[1])
    return f"{plain.format(name=name)}\n(Python says: {own})"


_PLAIN: list[tuple[type[BaseException], str, str]] = [
    (IndentationError, "", "The spaces at the start of this line do not fit the lines around it."),
    (SyntaxError, "never closed", "A bracket is opened and never closed."),
    (SyntaxError, "expected ':'", "A colon is missing at the end of this line."),
    (SyntaxError, "decimal literal", "Is a star missing? Twice t is written 2 * t."),
    (SyntaxError, "assign to function call", "A place in a list or array takes square brackets."),
    (SyntaxError, "'=='", "A comparison takes two equal signs: ==."),
    (SyntaxError, "", "Python cannot read this line."),
    (UnboundLocalError, "", "The name {name} is used before it gets a value."),
    (NameError, "", "The name {name} is not known here. Look at its spelling."),
    (IndexError, "only integers|as indices", "An index is a whole number: use range(len(...))."),
    (IndexError, "too many indices", "There are too many numbers between these square brackets."),
    (IndexError, "index -", "An index lies before the first one: it is too far below 0."),
    (IndexError, "", "An index is too large: counting starts at 0 and ends one before the length."),
    (ZeroDivisionError, "", "Something is divided by zero."),
    (RecursionError, "", "A function calls itself without end."),
    (ValueError, "must be square", "Only a square matrix has an inverse."),
    (ValueError, r"into shape \(0", "There is nothing to write into: these places are outside."),
    (ValueError, "float NaN", "A number here is nan: it is not written yet, or was divided by 0."),
    (ValueError, "enough dimensions", "One side of @ is a single number, not an array."),
    (ValueError, "broadcast|shape|dimension|aligned|matmul", "The sizes of two arrays differ."),
    (ValueError, "truth value of an array", "One number is needed here, but there is an array."),
    (TypeError, "to Python scalar", "One number is needed here, but there is an array."),
    (TypeError, r"bitwise_xor|for \^", "A power is written with two stars, as in t**3."),
    (TypeError, "list indices", "A list takes one whole number as index: make it an array first."),
    (TypeError, r"operand.*'(tuple|list)'", "Lists and tuples do not calculate: use np.array."),
    (TypeError, "function.*subscriptable", "A function is called with round brackets."),
    (TypeError, "not callable", "Round brackets call a function; an entry takes square ones."),
    (TypeError, "NoneType", "A value here is None: is a return missing?"),
    (TypeError, "argument", "The function is called with too few, too many or wrong arguments."),
    (TypeError, "", "A value here has the wrong type for what is done with it."),
    (AttributeError, "", "This value has nothing called {name}."),
    (ModuleNotFoundError, "", "The module {name} is not installed."),
    (FileNotFoundError, "", "A file that this line opens is not there."),
    (BaseException, "", "This line stopped the program."),
]  # fmt: skip
