"""Errors that novices make are said in plain words, with Python's own words behind."""

import math

import numpy as np
import pytest

from canim.checks.crash import explain, sentence

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
    "def f(a):\n    pass\nf()": "too few, too many or wrong arguments",
    "'a' + 1": "A value here has the wrong type",
    "[].push(1)": "This value has nothing called push.",
    "import not_there": "The module not_there is not installed.",
    "open('not there')": "A file that this line opens is not there.",
    "import math\nmath.sqrt(-1)": "This line stopped the program.",
    "raise KeyError": "This line stopped the program.",
    "if True:\nx = 1": "The spaces at the start of this line",
    "x = (1": "A bracket is opened and never closed.",
    "if True\n    x = 1": "A colon is missing",
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
