"""Notebooks are read as Jupyter reads them: of any version, with what is IPython's own."""

import ast
import asyncio
import builtins
import json
import os
import sys

import IPython
import pytest
from matplotlib import pyplot

from canim.checks import notebook, shell
from canim.checks.file import check_file

DONE = """import canim
from canim.interpolation import hermite_basis
canim.check("1.1", hermite_basis=hermite_basis)
"""
CALL = "get_ipython()."


def of(*codes, **more):
    cells = [{"cell_type": "code", "source": code} for code in codes]
    return json.dumps({"cells": cells} | more)


@pytest.fixture
def check(tmp_path, one_guard):
    def checked(*codes, name="task_1_1.ipynb", **files):
        for beside, text in files.items():
            (tmp_path / beside.replace("__", ".")).write_text(text, encoding="utf-8")
        path = tmp_path / name
        path.write_text(of(*codes) if name.endswith(".ipynb") else codes[0], encoding="utf-8")
        return check_file(path)[0]

    return checked


@pytest.fixture
def passes(check):
    """A check of cells with one below that is right: nothing stops, and all is done."""

    def passed(*codes, **files):
        report = check(*codes, DONE, **files)
        assert report.stops == []
        assert report.done

    return passed


def test_cells_are_read_from_every_version_of_the_format():
    code = {"cell_type": "code", "source": ["x = 1\n", "y = 2"]}
    others = [
        {"cell_type": kind, "source": "1/0", "attachments": {}} for kind in ("markdown", "raw")
    ]
    assert notebook.cells(json.dumps({"cells": [code, *others], "nbformat": 4})) == ["x = 1\ny = 2"]
    old = {"cell_type": "code", "input": "x = 1\r\ny = 2", "language": "python"}
    sheets = {"worksheets": [{"cells": [old]}, {"cells": [old]}], "nbformat": 3}
    assert notebook.cells(json.dumps(sheets | {"metadata": {"name": ""}})) == ["x = 1\ny = 2"] * 2
    assert notebook.cells(of()) == []
    assert notebook.cells(json.dumps({"worksheets": [], "nbformat": 2})) == []


@pytest.mark.parametrize(
    "metadata",
    [
        {},
        {"kernelspec": {"name": "python3", "language": "python"}},
        {
            "colab": {"provenance": []},
            "kernelspec": {"name": "python3", "display_name": "Python 3"},
        },
        {"language_info": {"name": "python"}, "kernelspec": None},
        {"deepnote_notebook_id": "x", "language_info": {"name": "ipython"}},
    ],
)
def test_cells_are_read_whatever_saved_the_notebook(metadata):
    assert notebook.cells(of("x", metadata=metadata)) == ["x"]


def test_a_cell_in_another_language_is_one_that_says_so_itself():
    cell = {"cell_type": "code", "source": "<b>", "metadata": {"vscode": {"languageId": "html"}}}
    assert notebook.cells(json.dumps({"cells": [cell]})) == ["%%html\n<b>"]


def test_a_notebook_of_another_language_is_refused():
    with pytest.raises(notebook.NoNotebook, match="is a notebook in R, not in Python"):
        notebook.cells(of("x <- 1", metadata={"kernelspec": {"language": "R"}}))
    for text in ("[1]", "{", '{"cells": [1]}', '{"metadata": 1}', "[" * 100_000):
        with pytest.raises(notebook.NoNotebook, match="is not a Jupyter notebook"):
            notebook.cells(text)


PYTHON = [
    "",
    "\n\n",
    "x = (7\n    % 4)",
    "x = '''\n%time\n!ls\n'''\ny = \"\"\"\n?\n\"\"\"",
    "x = 7 \\\n  % 4",
    "print('a = !b', \"isn't it?\")  # is it?",
    "if a != 3:\n    f(a=3)",
    "# %%bash\nx = 1",
    "# %%\nx = {\n 'a': [1, 2]}[\n 'a']",
    "x = '\\''  # a \" here\ny = 1",
    "x = 1)\ny = 2",
    "run = 3",
    "ls(3)",
    "x == 1",
]


@pytest.mark.parametrize("code", PYTHON)
def test_what_is_python_stays(code):
    assert notebook.translated(code) == code


TRANSLATED = {
    "%matplotlib inline": f"{CALL}run_line_magic('matplotlib', 'inline')",
    "if 1:\n  %cd a\n  !b": f"if 1:\n  {CALL}run_line_magic('cd', 'a')\n  {CALL}system('b')",
    "!echo \"don't (\nz = 1": f"{CALL}system('echo \"don\\'t (')\nz = 1",
    "!!ls": f"{CALL}system('ls')",
    "!pip install \\\n  numpy\nx = 1": f"{CALL}system('pip install    numpy')\n\nx = 1",
    "out = !ls": f"out = {CALL}getoutput('ls')",
    "d['a'] = %pwd": f"d['a'] = {CALL}run_line_magic('pwd', '')",
    "a, b = %pwd \\\n -x\nc": f"a, b = {CALL}run_line_magic('pwd', '-x')\n\nc".replace(
        "'-x'", "'-x'"
    ),
    "x = %": "x = %",
    "x = %time f(x)": "x = f(x)",
    "t = %timeit -o f(x)": f"t = {CALL}run_line_magic('timeit', '-o f(x)')",
    "%time f(x)": "f(x)",
    "def f():\n    %timeit -n 10 -r3 g(3)": "def f():\n    g(3)",
    "%prun -s cumulative f(3)": "f(3)",
    "%time": "pass",
    "%time !ls": f"{CALL}system('ls')",
    "%": "pass",
    "?f\nnp.sin?\nnp.sin??\n%time?\nx = 1": "pass\npass\npass\npass\nx = 1",
    "f(1)?\n": "pass\n",
    ">>> a = 1\n>>> if a:\n...     b\n": "a = 1\nif a:\n    b\n",
    "In [1]: a = 1\n   ...: b = 2": "a = 1\nb = 2",
    "\n   x = 1\n   if x:\n       y": "\nx = 1\nif x:\n    y",
    "pip install numpy": f"{CALL}run_line_magic('pip', 'install numpy')",
    "\nls\n": f"\n{CALL}run_line_magic('ls', '')\n",
    "%%html\n<b>\n": f"{CALL}run_cell_magic('html', '', '<b>\\n')\n\n",
    "%%bash": f"{CALL}run_cell_magic('bash', '', '')",
    "%%!\nls": f"{CALL}run_cell_magic('!', '', 'ls')\n",
    "%%time\nx = 1\n!ls": f"pass\nx = 1\n{CALL}system('ls')",
    "%%timeit -n 3 y = 2\nx = y": "y = 2\nx = y",
    "%%time\n%%capture cap\nx = 1": f"pass\ncap = {CALL}captured()\nx = 1",
    "%%capture --no-stderr\nx = 1": "pass\nx = 1",
    "%%debug": f"{CALL}run_line_magic('debug', '')",
}


@pytest.mark.parametrize(("code", "python"), TRANSLATED.items())
def test_what_is_ipythons_own_becomes_python_with_every_line_in_its_place(code, python):
    assert notebook.translated(code) == python
    assert python.count("\n") == code.count("\n")


PASSED_OVER = ["html", "latex", "bash", "javascript", "markdown", "script perl", "sql", "cython"]


@pytest.mark.parametrize("magic", PASSED_OVER)
def test_cells_that_are_not_python_are_passed_over(passes, magic):
    passes(f"%%{magic}\n<b>no $Python</b>\n")


CELLS = {
    "lines": ["%matplotlib inline\n%load_ext autoreload\n%config A.b = 'c'\n!pip install x\nf?"],
    "no output": [
        "out = !ls\nassert out == [] and out.n == out.s == ''",
        "for line in out.grep('x').fields(0):\n    1 / 0",
    ],
    "times": ["%%time\nx = 5", "y = %time x + 1\nassert y == 6", "t = %timeit -o x\nt.average"],
    "captured": [
        "%%capture cap\nprint(1)",
        "cap.show()\nassert not hasattr(cap, '_x')",
    ],
    "written": [
        "%%writefile curves.py\ndef cube(x):\n    return x**3",
        "%%writefile -a curves.py\n\nnine = 9",
        "%%file 'data 1.txt'\nhere",
        "import curves\nassert curves.cube(2) == 8 and curves.nine == 9",
        "import pathlib\nassert pathlib.Path('data 1.txt').read_text() == 'here'",
        "%run curves.py\nassert cube(3) == 27",
        "name = 'curves'\nnine = 1\n%run -i {name}\nassert nine == 9\n%run $name.py",
    ],
    "places": [
        "import os\nhere = %pwd\n%cd nowhere\nassert here == os.getcwd()\nos.mkdir('a b')",
        "%cd -q 'a b'\nassert os.getcwd() == os.path.join(here, 'a b')\n%cd ..",
        "%env A = 3\n%env B 4\nb = %env B\nassert (os.environ['A'], b) == ('3', '4')",
        "every = %env\nassert every['A'] == '3'",
    ],
    "waiting": [
        "import asyncio\nawait asyncio.sleep(0)\nasync def count():\n    yield 1",
        "async for x in count():\n    y = x\nassert y == 1",
        "later = asyncio.create_task(asyncio.sleep(0, 7))",
        "assert await later == 7",
        "asyncio.get_running_loop()",
    ],
    "shown": [
        "display(1, 2)\nshown = display('x', display_id=True)\nshown.update(3)",
        "from IPython.display import HTML, Image, clear_output\nHTML('x')\nclear_output()",
        "get_ipython().run_line_magic('matplotlib', 'inline')\nget_ipython().any_setting",
        "from IPython import get_ipython as ask\nassert ask() is get_ipython()",
        "assert 'IPKernelApp' in get_ipython().config",
        "from matplotlib import pyplot\npyplot.ion()\npyplot.plot([1])",
    ],
    "pylab": ["%pylab inline\nplot([1])\nnp.sin(plt.pi)"],
    "future": ["from __future__ import annotations", "def f(x: unknown): pass"],
    "magic": ["get_ipython().magic('cd nowhere')\nget_ipython().system('ls')"],
}


@pytest.mark.parametrize("kind", CELLS)
def test_what_jupyter_runs_the_check_runs(passes, kind):
    passes(*CELLS[kind])


def test_another_notebook_is_run_with_what_lies_in_its_folder(passes, tmp_path):
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "more.py").write_text("four = 4")
    (tmp_path / "lib" / "other.ipynb").write_text(of("import more\n%time x = more.four"))
    (tmp_path / "ends.py").write_text("five = 5\nraise SystemExit")
    passes("%run lib/other.ipynb\nassert x == 4", "%run ends.py\nassert five == 5")


IMPORTS = """
from IPython.display import *
from IPython.display import Audio, set_matplotlib_formats
from IPython.core.display import HTML, display as show
from IPython.core.interactiveshell import InteractiveShell
import IPython, matplotlib.pyplot as plt
InteractiveShell.ast_node_interactivity = "all"
show(HTML("x"), Audio(), IPython.display.Math("y"))
set_matplotlib_formats("svg")
clear_output(wait=True)
assert not hasattr(IPython, "__no__")
plt.ion()
"""


@pytest.fixture
def without_ipython(tmp_path, monkeypatch):
    """A computer where IPython is not installed."""
    place = tmp_path / "site"
    place.mkdir()
    (place / "sitecustomize.py").write_text("import sys\nsys.modules['IPython'] = None\n")
    monkeypatch.setenv("PYTHONPATH", str(place), prepend=os.pathsep)


@pytest.mark.usefixtures("without_ipython")
def test_ipython_need_not_be_installed(tmp_path):
    path = tmp_path / "task_1_1.ipynb"
    path.write_text(of(IMPORTS, "IPython.get_ipython().magic('pwd')\ndisplay(1)", DONE))
    assert check_file(path)[0].stops == []
    program = tmp_path / "task_1_1.py"
    program.write_text(f"{IMPORTS}assert IPython.get_ipython() is None\n{DONE}")
    assert check_file(program)[0].done


EXPORTED = """#!/usr/bin/env python
# coding: utf-8

# In[1]:


get_ipython().run_line_magic('matplotlib', 'inline')
get_ipython().run_line_magic('time', 'x = 1')
get_ipython().run_cell_magic('time', '', 'y = x + 1\\n')
get_ipython().run_cell_magic('bash', '', 'ls')
get_ipython().run_cell_magic('capture', 'cap', 'z = 1')
get_ipython().run_cell_magic('writefile', 'made.py', 'w = 4')
get_ipython().magic(u'matplotlib inline')
get_ipython().system('ls')
out = get_ipython().getoutput('ls')


# In[ ]:


from made import w
display(x, y, z, cap, out)
"""


def test_a_program_that_was_made_from_a_notebook_is_run(check):
    report = check(EXPORTED + DONE, name="task_1_1.py")
    assert report.stops == []
    assert report.done


def test_other_programs_find_what_python_gives_them(check):
    text = "try:\n    get_ipython()\nexcept NameError:\n    x = 1\nx\n"
    assert check(text + DONE, name="task_1_1.py").stops == []
    assert "The name display is not known" in check("display(1)", name="task_1_1.py").stops[0]
    refused = check("await x", DONE).stops
    assert refused[0].startswith("Code cell 1 stops in line 1:\n  await x")


def test_a_cell_that_fails_is_told_and_the_others_are_run(check):
    report = check(
        "1/0", "x = (", "y = 1\n%time y / 0", DONE, "raise SystemExit", "-" * 100_000 + "1"
    )
    assert report.done
    first, second, third, more = report.stops
    assert first.startswith("Code cell 1 stops in line 1:\n  1/0\n  ^^^\nSomething is divided by")
    assert second.startswith("Code cell 2 stops in line 1:\n  x = (\n      ^\nA bracket is opened")
    assert third.startswith("Code cell 3 stops in line 2:\n  %time y / 0\n  ^^^^^^^^^^^\nSomething")
    assert more == "In all, 4 cells stop."
    assert "Code cell 1 stops" in str(report)


def test_a_function_that_no_cell_makes_is_told_with_the_cell_that_stopped(check):
    report = check("1/0\ndef hermite_basis(t): return t", "")
    assert "hermite_basis is not there: a cell stops before it comes to this name." in str(report)
    assert str(report).count("Code cell 1 stops in line 1") == 1
    assert not report.done


def test_where_a_function_stops_the_cell_is_named(check):
    text = "import numpy as np\n\ndef hermite_basis(t):\n    return t + unknown"
    report = check("", text, "hermite_basis(1)")
    assert report.results[0].message.startswith("hermite_basis stops in code cell 2, line 4:\n")
    assert "Code cell 3" not in str(report)  # it follows from the one before
    report = check("def hermite_basis(): pass")
    assert report.results[0].message.startswith("hermite_basis stops in code cell 1, line 1:\n")


def test_where_a_line_for_ipython_cannot_be_read_it_is_shown_as_it_is(check):
    (told,) = check("x = 1\n%time x = (", DONE).stops
    assert told.startswith("Code cell 1 stops in line 2:\n  %time x = (\n  ^\nA bracket is opened")


def test_a_stop_that_is_in_no_line_of_the_notebook_names_the_cell(check):
    stop = "import asyncio\nasyncio.get_running_loop().stop()\nawait asyncio.sleep(9)"
    (told,) = check(DONE, stop, "await asyncio.sleep(0)").stops
    assert told.startswith("Code cell 2 stops.\nThis line stopped the program.")


# --- The shell, in the process of the test


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Run cells, or a program, as the student's process does; what that changes is put back."""
    for name in ("display", "get_ipython"):
        monkeypatch.setattr(builtins, name, None, raising=False)
    monkeypatch.setattr(IPython, "get_ipython", IPython.get_ipython)
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    monkeypatch.chdir(tmp_path)
    for name in ("A", "B"):
        monkeypatch.setenv(name, "")
    loops = []
    made = asyncio.Runner
    monkeypatch.setattr(asyncio, "Runner", lambda: loops.append(made()) or loops[-1])

    def ran(*codes, is_notebook=True):
        names = {}
        named = [(code, "cell") for code in codes]
        shell.open_shell(named, names, is_notebook)
        run_code = shell.runner(named)
        for code in codes:
            tree = notebook.parsed(code, "cell")
            flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
            run_code(compile(tree, "cell", "exec", flags, dont_inherit=True), names)
        return names

    yield ran
    for loop in loops:
        loop.close()
    for module in ("curves", "made", "more"):
        sys.modules.pop(module, None)
    pyplot.close("all")
    pyplot.ioff()


@pytest.mark.parametrize("kind", sorted(CELLS.keys() - {"future"}))
def test_the_shell_does_what_cells_ask_for(run, kind):
    assert run(*CELLS[kind])


def test_the_shell_serves_programs_that_were_made_from_notebooks(run):
    names = run(EXPORTED, is_notebook=False)
    assert (names["x"], names["y"], names["z"], names["w"], names["out"]) == (1, 2, 1, 4, [])


def test_the_shell_runs_other_notebooks(run, tmp_path):
    (tmp_path / "other.ipynb").write_text(of("%time four = 4"))
    assert run("%run other.ipynb")["four"] == 4


@pytest.mark.parametrize("is_notebook", [True, False])
def test_the_shell_stands_in_for_ipython(run, monkeypatch, is_notebook):
    for name in shell._MODULES:
        monkeypatch.setitem(sys.modules, name, None)
    asked = run(IMPORTS, is_notebook=is_notebook)["IPython"].get_ipython()
    assert (asked is not None) == is_notebook
