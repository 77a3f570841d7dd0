"""Errors that novices make are said in plain words, with Python's own words behind."""

import math

import numpy as np
import pytest

from canim.checks.crash import Crash, explain, sentence

PROGRAMS = {
    "x = unknown": "The name unknown is not known here.",
    "def f():\n    print(x)\n    x = 1\nf()": "The name x is used before it gets a value.",
    "[1, 2][2]": "An index is too large",
    "import numpy as np\nnp.zeros(3)[-4]": "An index lies before the first one",
    "import numpy as np\nint(np.nan)": "A number here is nan",
    "x = [1, 2]\nx[0.5]": "A list takes one whole number as index",
    "import numpy as np\nnp.zeros(3)[0.5]": "An index is a whole number",
    "import numpy as np\nnp.zeros(3)[np.zeros(2)]": "An index is a whole number",
    "def f(x):\n    pass\nf[0]": "A function is called with round brackets.",
    "import numpy as np\nnp.zeros(3)[0, 1]": "too many numbers between these square brackets",
    "import numpy as np\nnp.zeros(3)[5:8] = [1, 2, 3]": "There is nothing to write into",
    "import numpy as np\nnp.linalg.inv(np.ones((2, 3)))": "Only a square matrix has an inverse.",
    "import numpy as np\nnp.eye(4) @ 2.0": "One side of @ is a single number",
    "(1, 2) - (3, 4)": "Lists and tuples do not calculate",
    "x = 2t": "Is a star missing?",
    "x = (1 - t)a[1]": "Is a star or bracket missing?",
    "H(1) = 2": "A place in a list or array takes square brackets.",
    "if x = 1:\n    pass": "A comparison takes two equal signs",
    "1 / 0": "Something is divided by zero.",
    "def f():\n    f()\nf()": "A function calls itself without end.",
    "import numpy as np\nnp.zeros(2) + np.zeros(3)": "The sizes of two arrays differ.",
    "import numpy as np\nif np.zeros(2) > 1:\n    pass": "One number is needed here",
    "import math\nimport numpy as np\nmath.sin(np.zeros(2))": "One number is needed here",
    "import numpy as np\nnp.zeros(2)^3": "A power is written with two stars",
    "0.5^3": "A power is written with two stars",
    "x = [1]\nx(0)": "Round brackets call a function",
    "None + 1": "A value here is None",
    "def f(a):\n    pass\nf()": "The function gets too few values between its brackets.",
    "'a' + 1": "A value here has the wrong type",
    "[].push(1)": "This value has nothing called push.",
    "import not_there": "The module not_there is not installed. Look at its spelling, too.",
    "import numpy as np\nnp.ones((10**6, 10**6, 100))": "An array here is larger than the memory.",
    "import numpy as np\nnp.ones((2**40, 2**40))": "An array here is larger than the memory.",
    "open('not there')": "A file that this line opens is not there.",
    "import math\nmath.sqrt(-1)": "This line stopped the program.",
    "raise KeyError": "This line stopped the program.",
    "if True:\nx = 1": "What belongs to the line above starts further right.",
    "x = 1\n  y = 2": "This line starts further right than the one above it.",
    "if True:\n    x = 1\n  y = 2": "The spaces at the start of this line",
    "if True:\n\tx = 1\n        y = 2": "Tabs and spaces are mixed",
    "x = 1)": "A bracket is closed that was never opened.",
    "x = (1]": "A bracket is closed by one of another kind.",
    "x = [1 2]": "a comma, a star or a bracket?",
    "x + 1 = 2": "On the left of = stands the name",
    "f(x+1=2)": "A comparison takes two equal signs",
    "x = 'a": "a quote is missing",
    "x = 2 \N{MULTIPLICATION SIGN} 3": "Python does not know this sign.",
    "x = 2\N{NO-BREAK SPACE}* 3": "Python does not know this sign.",
    "return 1": "This line belongs to the lines above",
    "import numpy as np\nnp.zeros(3)[3]": "Index 3: there are 3, counted from 0.",
    "import numpy as np\nnp.zeros((2, 3)) @ np.zeros((2, 3))": "The sizes of two arrays differ.",
    "import numpy as np\nnp.dot(np.eye(2), np.eye(3))": "The sizes of two arrays differ.",
    "import numpy as np\nx = np.zeros(3)\nx[:] = np.ones(4)": "The sizes of two arrays differ.",
    "import numpy as np\nnp.array([[1, 2], [3]])": "do not all have the same length",
    "a, b = [1, 2, 3]": "The number of names on the left",
    "import numpy as np\nnp.zeros(3)(0)": "Round brackets call a function",
    "x = 2\nx(3 + 1)": "Is a star missing before this bracket?",
    "import numpy as np\nnp.float64(2)(3)": "Is a star missing before this bracket?",
    "None.shape": "A value here is None: is a return missing?",
    "def f():\n    pass\na, b = f()": "A value here is None",
    "range(4 / 2)": "A whole number is needed here",
    "[1, 2] * 0.5": "A whole number is needed here",
    "import numpy as np\nx = np.arange(3)\nx += 0.5": "This array holds whole numbers only.",
    "def f(a):\n    pass\nf(1, 2)": "Between the brackets are 2 values, not 1.",
    "def f(a):\n    pass\nf(b=2)": "too few, too many or wrong arguments",
    "import numpy as np\nnp.sinn(1)": "This value has nothing called sinn. Do you mean sin?",
    "from math import sinn": "There is nothing called sinn to import there.",
    "raise AttributeError('odd')": "This value does not have what is asked of it.",
    "1 % 0": "Something is divided by zero.",
    "1.0 / 0": "Something is divided by zero.",
    "x = (1": "A bracket is opened and never closed.",
    "if True\n    x = 1": "A colon is missing at the end",
    "for i in range(3)\n    x = 1": "A colon is missing at the end",
    "def f(x)\n    return 1": "A colon is missing at the end",
    "x = = 1": "Python cannot read this line",
}


@pytest.mark.parametrize(("program", "words"), PROGRAMS.items())
def test_the_message_is_plain_and_keeps_pythons_own(program, words):
    with pytest.raises(BaseException) as caught:
        exec(compile(program, "program.py", "exec"), {})
    text = sentence(caught.value)
    assert words in text
    assert f"(Python says: {type(caught.value).__name__}" in text
    assert "{name}" not in text


def test_the_line_is_the_last_one_of_the_students_file():
    with pytest.raises(np.linalg.LinAlgError) as caught:
        np.linalg.inv(math.pi)
    crash = explain(caught.value, lambda name: name == __file__)
    assert crash.code == "np.linalg.inv(math.pi)"
    assert explain(caught.value, lambda name: False).line == 0


def test_the_line_is_that_of_the_function_that_is_called():
    def own(x):
        return 1 / x

    with pytest.raises(ZeroDivisionError) as caught:
        own(0)
    assert explain(caught.value, lambda name: name == __file__).code == "return 1 / x"


def test_a_syntax_error_has_its_own_line():
    error = SyntaxError("bad", ("nowhere.py", 3, 1, "x ="))
    assert explain(error, lambda name: True).line == 3
    assert explain(SyntaxError("bad"), lambda name: True).line == 0


# What Python 3.12 to 3.14 and other versions of numpy say in place of 3.11's words.
WORDINGS = [
    (TypeError("f() got an unexpected keyword argument 'x'. Did you mean 'y'?"), "wrong arguments"),
    (ZeroDivisionError("division by zero"), "divided by zero"),
    (ZeroDivisionError("float division by zero"), "divided by zero"),
    (RecursionError("Stack overflow (used 8144 kB) in comparison"), "calls itself without end"),
    (ValueError("too many values to unpack (expected 2, got 3)"), "The number of names"),
    (SyntaxError("invalid syntax. Did you mean 'for'?"), "Python cannot read this line."),
    (SyntaxError("invalid syntax. Is this intended to be part of the string?"), "cannot read"),
    (TypeError("only 0-dimensional arrays can be converted to Python scalars"), "One number is"),
    (TypeError("only length-1 arrays can be converted to Python scalars"), "One number is"),
    (TypeError("'numpy.float64' object cannot be interpreted as an integer"), "A whole number"),
    (ModuleNotFoundError("No module named 'numpi'", name="numpi"), "The module numpi is not"),
    (NameError("name 'np' is not defined. Did you mean: 'n'?", name="np"), "The name np is not"),
    (NameError("name 'math' is not defined. Did you forget to import 'math'?"), "The name math is"),
    (
        ImportError("cannot import name 'a' from 'b' (unknown location)"),
        "nothing called a to import",
    ),
    (IndentationError("unindent does not match any outer indentation level"), "do not fit"),
]


@pytest.mark.parametrize(("error", "words"), WORDINGS, ids=lambda x: str(x)[:40])
def test_other_versions_of_python_say_it_in_other_words(error, words):
    assert words in sentence(error)


# A program, the line that is told, and what carets mark in it.
MARKED = {
    "t = 1\nx = 2 * tt": (2, "x = 2 * tt", "tt"),
    "if 1:\n    x = 1 / 0\n": (2, "x = 1 / 0", "1 / 0"),
    "if 1:\n    x = [1,\n         1 / 0,\n    ]": (3, "1 / 0,", "1 / 0"),
    "x = max(\n    1,\n    None)": (1, "x = max(", "max("),
    "\u00e4\u00f6 = 1\nz = '\u00e4\u00f6' + 1": (2, "z = '\u00e4\u00f6' + 1", "'\u00e4\u00f6' + 1"),
    "z = ['\u00e4\u00f6', 1 / 0, 3]": (1, "z = ['\u00e4\u00f6', 1 / 0, 3]", "1 / 0"),
    "for i in range(3)\n    x = 1": (1, "for i in range(3)", ""),
    "if 1:\n\tx = (1": (2, "x = (1", "("),
    "if x = 1:\n    pass": (1, "if x = 1:", "x = 1"),
    "def f():\n    return 1\n\ndef g():\n    return f() + ff()\n\ng()": (
        5,
        "return f() + ff()",
        "ff",
    ),
}


def _crash(program, tmp_path):
    path = tmp_path / "program.py"
    path.write_text(program, encoding="utf-8")
    try:
        exec(compile(program, str(path), "exec"), {})
    except Exception as error:
        return explain(error, lambda name: name == str(path))
    raise AssertionError("nothing crashed")


@pytest.mark.parametrize(("program", "told"), MARKED.items())
def test_the_students_line_is_shown_with_carets_below_what_failed(program, told, tmp_path):
    crash = _crash(program, tmp_path)
    assert (crash.line, crash.code, crash.code[crash.start : crash.end]) == told
    code, carets = crash.marked.splitlines()
    assert code == f"  {crash.code}"
    assert carets.strip("^ ") == ""
    assert carets.index("^") == crash.start + 2
    assert carets.count("^") == max(1, len(told[2]))


def test_a_missing_colon_is_marked_behind_the_last_letter(tmp_path):
    assert _crash("for i in range(3)\n    x = 1", tmp_path).marked.splitlines()[1] == " " * 19 + "^"


@pytest.mark.parametrize("before", [0, 30, 200])
def test_of_a_long_line_the_part_that_failed_is_shown(before, tmp_path):
    crash = _crash(f"x = [{'1, ' * before}zz, {'1, ' * 60}]", tmp_path)
    code, carets = crash.marked.splitlines()
    assert len(code) <= 80
    assert code[carets.index("^") : carets.rindex("^") + 1] == "zz"


def test_a_name_that_is_nearly_known_is_asked_for(tmp_path):
    renamed = "def hermite_bases(t):\n    return t\n\nhermite_basis(1)"
    assert "Do you mean hermite_bases?" in _crash(renamed, tmp_path).sentence
    assert "Do you mean" not in _crash("x = qqqqq", tmp_path).sentence
    # A name that has no value yet is spelled well.
    late = "def f():\n    print(value)\n    value = 1\n\nf()"
    assert "Do you mean" not in _crash(late, tmp_path).sentence


def test_a_line_that_is_not_there_has_no_carets():
    assert Crash(3, "x = y", "Why.").marked == "  x = y"
