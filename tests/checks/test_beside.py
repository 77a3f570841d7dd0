"""A program finds beside it all that Python would find there, within limits."""

import errno
import json
import os
import shutil
import sys
from types import SimpleNamespace

import pytest

from canim.checks import beside
from canim.checks.file import NOT_ALL_BESIDE, check_file
from canim.checks.guard import Fault

DONE = """import canim
from canim.interpolation import hermite_basis
canim.check("1.1", hermite_basis=hermite_basis)
"""


@pytest.fixture
def check(tmp_path, one_guard):
    def checked(text, files):
        for name, content in files.items():
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name).write_text(content, encoding="utf-8")
        path = tmp_path / "task_1_1.py"
        path.write_text(text + "\n" + DONE, encoding="utf-8")
        return check_file(path)[0]

    return checked


USED = {
    "a module that imports another": (
        "from helpers import cube\nassert cube(2) == 8",
        {"helpers.py": "from powers import cube", "powers.py": "def cube(x): return x**3"},
    ),
    "a module that imports by a name in a text": (
        "import helpers\nassert helpers.cube == 8",
        {
            "helpers.py": "import importlib\ncube = importlib.import_module('pow.ers').cube\n"
            "__import__('other')",
            "pow/ers.py": "cube = 8",
            "other.py": "",
        },
    ),
    "a package": (
        "import mypkg\nassert mypkg.cube == 8 and mypkg.text() == 'here'",
        {
            "mypkg/__init__.py": "from .deep import cube\nfrom . import wide\nimport powers\n"
            "import os\ndef text(): return open(os.path.dirname(__file__) + '/data.txt').read()",
            "mypkg/deep/__init__.py": "from ..wide import cube",
            "mypkg/wide.py": "cube = 8",
            "mypkg/data.txt": "here",
            "powers.py": "",
        },
    ),
    "a folder without __init__": (
        "from tools.curves import cube",
        {"tools/curves.py": "from tools.more import cube", "tools/more.py": "cube = 8"},
    ),
    "a folder that is added to the path": (
        "import sys\nsys.path.append('lib')\nfrom mypkg import cube\nimport single",
        {
            "lib/mypkg/__init__.py": "from mypkg.powers import cube",
            "lib/mypkg/powers.py": "cube = 8",
            "lib/single.py": "import base",
            "lib/base.py": "",
        },
    ),
    "a module of a folder that is run": (
        "import runpy\nruns = runpy.run_path('lib/helpers.py')\nassert runs['cube'] == 8",
        {
            "lib/helpers.py": "import runpy\ncube = runpy.run_path('lib/powers.py')['cube']",
            "lib/powers.py": "cube = 8",
        },
    ),
    "a module in another encoding": (
        "from helpers import cube",
        {"helpers.py": "# -*- coding: ascii -*-\nfrom powers import cube", "powers.py": "cube = 8"},
    ),
    "a module in a circle": ("import a1", {"a1.py": "import b1", "b1.py": "import a1"}),
}


@pytest.mark.parametrize("kind", USED)
def test_what_python_imports_from_beside_comes_along(check, kind):
    report = check(*USED[kind])
    assert report.stops == []
    assert report.done


def test_a_notebook_that_is_run_brings_what_it_runs_and_imports(check):
    cells = [
        {"cell_type": "code", "source": s} for s in ("%run base.py", "from powers import cube")
    ]
    text = "get_ipython().run_line_magic('run', 'other.ipynb')\nassert cube == two**3"
    files = {"other.ipynb": json.dumps({"cells": cells}), "powers.py": "cube = 8"}
    assert check(text, files | {"base.py": "two = 2"}).stops == []


def copied(folder, codes=("",), name="x.py"):
    path = folder / "from" / name
    path.parent.mkdir(exist_ok=True)
    path.write_text("\n".join(codes))
    whole = beside.copy_beside(path, list(codes), folder / "to")
    files = {p.relative_to(folder / "to").as_posix() for p in (folder / "to").rglob("*")}
    return whole, {file for file in files if (folder / "to" / file).is_file()} - {name}


def put(folder, *names, text=""):
    for name in names:
        (folder / "from" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "from" / name).write_text(text)


def test_the_programs_of_others_stay_where_they_are(tmp_path):
    students = [f"task_1_1_student{i}.py" for i in range(120)]
    put(tmp_path, *students, *(f"{i}/numbers.py" for i in range(120)), text="import helpers, os")
    put(tmp_path, "task_1_1.ipynb", "notes.txt", ".git/config", "__pycache__/x.txt")
    put(tmp_path, "env/pyvenv.cfg", "env/lib/a.txt", "node_modules/a/b.txt")
    put(tmp_path, "helpers.py", text="import curves")
    put(tmp_path, "curves.py", text="import broken, numbers")
    put(tmp_path, "broken.py", text="x = (\nimport task_1_1_student1")  # imports nothing
    whole, files = copied(tmp_path, ["import helpers\nimport numpy as np"])
    assert whole
    assert files == {"notes.txt", "helpers.py", "curves.py", "broken.py"}


def test_modules_that_cannot_be_read_import_nothing(tmp_path):
    put(tmp_path, "one.ipynb", text="[1]")
    put(tmp_path, "two.py")
    (tmp_path / "from/two.py").write_bytes(b"import three\nx = '\xe9'")
    put(tmp_path, "three.py")
    assert copied(tmp_path, ["one", "two"])[1] == {"one.ipynb", "two.py"}


def test_many_and_large_files_stay_where_they_are(tmp_path, monkeypatch):
    monkeypatch.setattr(beside, "MOST_BESIDE", 10)
    monkeypatch.setattr(beside, "MOST_FILES_BESIDE", 3)
    put(tmp_path, "a/1.txt", "a/2.txt", "b/3.txt", text="1234")
    put(tmp_path, "c/4.txt", "c/5.txt", "z.py", text="1")

    def copy(source, target):
        if source.name == "4.txt":
            raise PermissionError
        shutil.copyfile(source, target / source.name if target.is_dir() else target)

    monkeypatch.setattr(beside, "shutil", SimpleNamespace(copy=copy))
    # What the program imports comes first.
    assert copied(tmp_path, ["import z"]) == (False, {"z.py", "a/1.txt", "a/2.txt"})
    shutil.rmtree(tmp_path / "to")
    assert copied(tmp_path) == (False, {"a/1.txt", "a/2.txt", "c/5.txt"})


@pytest.mark.skipif(sys.platform == "win32", reason="there are no named pipes in folders")
def test_what_is_no_regular_file_stays_where_it_is(tmp_path):
    put(tmp_path, "empty.txt")
    os.mkfifo(tmp_path / "from" / "pipe.py")
    os.mkfifo(tmp_path / "from" / "pipe.txt")
    (tmp_path / "from" / "device.txt").symlink_to("/dev/zero")
    assert copied(tmp_path, ["pipe"]) == (True, {"empty.txt"})


def test_a_program_that_stops_is_told_that_not_all_came_along(check, monkeypatch):
    monkeypatch.setattr(beside, "MOST_FILES_BESIDE", 1)
    files = {"a.txt": "", "b.txt": ""}
    assert NOT_ALL_BESIDE in check("open('b.txt')", files).notes
    assert NOT_ALL_BESIDE not in check("open('a.txt')", files).notes


def test_a_full_disk_is_a_fault_of_the_computer(check, monkeypatch):
    def full(source, target):
        if source.name == "a.txt":
            raise OSError(errno.ENOSPC, "No space left on device", str(target))

    monkeypatch.setattr(beside, "shutil", SimpleNamespace(copy=full))
    with pytest.raises(Fault, match=r"cannot be copied to where it runs: .*No space left"):
        check("", {"a.txt": ""})
