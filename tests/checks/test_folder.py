"""A whole class: every file below a folder, in any order and by any number of workers."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys

import joblib
import pytest
from joblib.externals.loky import get_reusable_executor

from canim import checks
from canim.checks import folder, handins
from canim.checks.folder import check_folder
from canim.checks.guard import Limits
from canim.cli import main

RIGHT = """
import canim
from canim.interpolation import hermite_basis
answers = {1: "because", 2: "=1+1", 10: "é"}
canim.check("1.1", hermite_basis=hermite_basis)
"""
WRONG = """
import numpy as np
def hermite_basis(t):
    return np.array([2*t**3-3*t**2+1, -3*t**3+3*t**2, t**3-2*t**2+t, t**3-t**2])
"""
# Programs of one folder must not see what others write beside them.
WRITES = (
    WRONG
    + """
import pathlib
seen = pathlib.Path("seen.txt")
answers = {1: str(seen.exists()), 2: pathlib.Path("given.txt").read_text()}
seen.write_text("here")
"""
)
FILES = {
    "ann/task_1_1.py": RIGHT,
    "ann/notes.txt": "no program",
    "ann/.hidden.py": "1/0",
    "ben/broken.py": "x = (",
    "ben/task_1_1 crashes.py": WRONG + "print(undefined)\n",
    "ben/__pycache__/task_1_1.py": "1/0",
    "cem/given.txt": "x",
    "cem/helper.py": "factor = 2",
    "cem/task_1_1.py": WRITES,
    "cem/task_1_1_again.py": WRITES,
    "cem/task_1_1_with_helper.py": "import helper\n" + WRONG,
    "dora/task_1_1.ipynb": json.dumps({"cells": [{"cell_type": "code", "source": [RIGHT]}]}),
    "exits/task_1_1.py": "import os; os._exit(0)",
    "latin/task_1_1.py": "\ufffd",
}
LIMITS = Limits(30, 500)


@pytest.fixture
def handed_in(tmp_path):
    place = tmp_path / "class"
    for name, text in FILES.items():
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        encoding = "utf-16" if text == "\ufffd" else "utf-8"
        (place / name).write_text(text, encoding=encoding)
    return place


@pytest.fixture
def alone(monkeypatch):
    """A computer without joblib."""
    monkeypatch.setitem(sys.modules, "joblib", None)


def by_file(rows):
    found = {}
    for row in rows:
        found.setdefault(row["file"], []).append(row)
    return found


def test_every_file_is_checked_whatever_the_others_do(handed_in, alone):
    seen = []
    before = sorted(handed_in.rglob("*"))
    rows = check_folder(handed_in, limits=LIMITS, progress=lambda *both: seen.append(both))
    assert sorted(handed_in.rglob("*")) == before  # nothing is written beside the programs
    files = by_file(rows)
    programs = [name for name, parts in files.items() if parts[0]["result"] != "passed over"]
    assert seen == [(done, 10) for done in range(11)]
    assert programs == sorted(programs)
    told = {
        name: (parts[0]["passed"], parts[0]["message"] or parts[0]["notes"])
        for name, parts in files.items()
    }
    assert told["ann/notes.txt"] == (None, "is neither a .py nor an .ipynb file.")
    assert told["ann/.hidden.py"] == (None, "is a hidden file: its name begins with a dot.")
    assert told[""][1].endswith("for themselves: __pycache__ (1).")
    assert told["ann/task_1_1.py"] == (True, "hermite_basis uses canim's function.")
    assert told["dora/task_1_1.ipynb"][0]
    assert told["ben/broken.py"][1].startswith("line 1: x = ( A bracket is opened")
    assert told["cem/helper.py"][0] is None  # another program imports it
    assert told["cem/helper.py"][1].startswith("is not a task of the course")
    assert told["latin/task_1_1.py"][1].startswith("line 1: ")
    assert told["exits/task_1_1.py"][1] == "not checked"
    assert "The name undefined is not known here" in told["ben/task_1_1 crashes.py"][1]
    assert len(told) == 14
    hints = [row["hint"] for row in files["cem/task_1_1_with_helper.py"]]
    assert [bool(hint) for hint in hints] == [False, True, False, False]
    for name in ("cem/task_1_1.py", "cem/task_1_1_again.py"):
        assert files[name][0]["answers"] == {"1": "False", "2": "x"}


def test_the_result_is_the_same_in_any_order_and_for_any_number_of_workers(
    handed_in, alone, monkeypatch
):
    one_by_one = check_folder(handed_in, limits=LIMITS)
    monkeypatch.setattr(folder, "_checked", _backwards(folder._checked))
    assert check_folder(handed_in, limits=LIMITS) == one_by_one
    monkeypatch.undo()
    try:
        for jobs in (1, 3):
            assert check_folder(handed_in, limits=LIMITS, jobs=jobs) == one_by_one
    finally:
        get_reusable_executor().shutdown(wait=True)


def _backwards(checked):
    return lambda given, *others: checked(given[::-1], *others)


def test_a_folder_without_a_file_is_told(tmp_path, alone):
    assert check_folder(tmp_path) == [
        folder._row("", result="not checked", message="holds no file.")
    ]


def test_a_fault_of_ours_at_one_file_is_a_row_that_says_so(handed_in, monkeypatch, capsys):
    def fail(*args, **options):
        raise RuntimeError("no room")

    monkeypatch.setattr(folder, "check_file", fail)
    row = by_file(check_folder(handed_in / "ann", jobs=1))["task_1_1.py"][0]
    assert row["message"].startswith(f"{folder.OURS}: RuntimeError: no room (test_folder.py, line")
    assert not row["passed"]
    assert main(["check", str(handed_in / "ann"), "--jobs", "1"]) == 2
    assert "canim is to blame" in capsys.readouterr().out


def test_a_task_that_there_is_not_is_told_of_each_file(handed_in, alone):
    rows = by_file(check_folder(handed_in / "ann", task="7.7"))
    assert "There is no task '7.7'." in rows["task_1_1.py"][0]["message"]


def test_where_a_program_or_a_cell_stops_is_told_once(tmp_path, alone):
    (tmp_path / "task_1_1.py").write_text("x = 1 / 0\ndef hermite_basis(t): pass\n")
    cells = [{"cell_type": "code", "source": source} for source in ("x = 1", "x = 1 / 0")]
    (tmp_path / "task_1_1.ipynb").write_text(json.dumps({"cells": cells}))
    notes = {row["file"]: row["notes"] for row in check_folder(tmp_path)}
    assert notes["task_1_1.py"].startswith("The program stops in line 1: x = 1 / 0 Something is")
    assert notes["task_1_1.ipynb"].startswith("Code cell 2 stops in line 1: x = 1 / 0 Something")
    assert [text.count("stops in line") for text in notes.values()] == [1, 1]


@pytest.fixture
def half_written(tmp_path, monkeypatch):
    """A canim in which one more task is there that cannot be imported."""
    place = tmp_path / "half" / "canim" / "checks"
    place.mkdir(parents=True)
    (place / "task_9_9.py").write_text("import numpy\nimport no_such_module\n")
    (place.parents[1] / "sitecustomize.py").write_text(
        f"import canim.checks\ncanim.checks.__path__.append({str(place)!r})\n"
        "canim.checks.TASKS._ids.append('9.9')\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(place.parents[1]), prepend=os.pathsep)


@pytest.mark.skipif(os.name != "posix", reason="other systems load no task for others")
@pytest.mark.usefixtures("half_written")
def test_a_task_that_cannot_be_loaded_ends_the_check_of_a_class_with_one_message(
    handed_in, tmp_path, capfd
):
    report = tmp_path / "results.csv"
    try:
        for jobs in ("1", "2"):
            command = ["check", str(handed_in), "--jobs", jobs, "--report", str(report)]
            assert main(command) == 2
            said = capfd.readouterr()
            assert said.out == ""
            assert said.err.count("The check itself failed, no program is to blame") == 1
            assert "task_9_9.py, line 2." in said.err
            assert "No module named 'no_such_module'" in said.err
            assert not report.exists()
    finally:
        get_reusable_executor().shutdown(wait=True)


def test_threads_of_a_worker_take_turns(handed_in):
    with joblib.parallel_config(backend="threading", n_jobs=2):
        rows = check_folder(handed_in / "cem", limits=LIMITS)
    folder._close_guard()
    assert len(rows) == 14


def test_the_table_is_for_spreadsheets(handed_in, tmp_path, monkeypatch, capsys, alone):
    report = tmp_path / "results.csv"
    assert main(["check", str(handed_in / "ann"), "--report", str(report)]) == 0
    said = capsys.readouterr()
    assert "The files are checked one after another." in said.err
    assert "task_1_1.py: Task 1.1, 4 of 4 parts done" in said.out
    assert "All parts are done in 1 of 1 files." in said.out
    assert report.read_bytes().startswith(b"\xef\xbb\xbffile,task,part,result")
    with report.open(encoding="utf-8-sig", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["passed"]]
    assert [row["part"] for row in rows] == [part.name for part in checks.TASKS["1.1"].parts]
    assert rows[0]["passed"] == "yes"
    assert rows[0]["answer 1"] == "because"
    assert rows[0]["answer 2"] == "'=1+1"  # a formula would be carried out
    assert list(rows[0])[-1] == "answer 10"
    assert rows[0]["answer 10"] == "é"


@pytest.mark.parametrize("first", ["=", "+", "-", "@", "\t", "\r"])
@pytest.mark.parametrize("column", ["file", "message", "answers"])
def test_no_cell_is_a_formula(first, column, tmp_path):
    formula = f"{first}1+1"
    row = folder._row("x.py") | {column: {"1": formula} if column == "answers" else formula}
    folder.write([row], tmp_path / "results.csv")
    with (tmp_path / "results.csv").open(encoding="utf-8-sig", newline="") as file:
        (cells,) = csv.DictReader(file)
    assert f"'{formula}" in cells.values()


def test_results_are_written_as_json(handed_in, tmp_path, capsys):
    report = tmp_path / "results.json"
    command = ["check", str(handed_in / "ben"), "--report", str(report), "--jobs", "1"]
    assert main(command) == 1
    said = capsys.readouterr()
    assert said.err == ""
    assert "broken.py: line 1: x = (" in said.out
    assert "All parts are done in 0 of 2 files." in said.out
    rows = json.loads(report.read_text(encoding="utf-8"))
    assert rows[0]["file"] == "broken.py"
    assert rows[1]["passed"] is False


@pytest.mark.parametrize("suffix", [".csv", ".json"])
def test_halves_of_letters_do_not_cost_the_table(suffix, tmp_path):
    row = folder._row("\udc80.py", answers={"1": "\ud83d", "2": "\N{GRINNING FACE}"})
    table = tmp_path / f"results{suffix}"
    folder.write([row], table)
    text = table.read_text(encoding="utf-8-sig")
    assert all(part in text for part in ("\\udc80.py", "\\ud83d", "\N{GRINNING FACE}"))
    if suffix == ".json":
        assert json.loads(text) == [row]
    assert list(tmp_path.iterdir()) == [table]


@pytest.mark.parametrize("suffix", [".csv", ".json"])
def test_a_table_stays_where_the_next_one_fails(suffix, tmp_path):
    table = tmp_path / f"results{suffix}"
    table.write_text("before")
    with pytest.raises(TypeError):
        folder.write([folder._row("x", answers=3 if suffix == ".csv" else {"1": print})], table)
    assert table.read_text() == "before"
    assert list(tmp_path.iterdir()) == [table]


def test_somebody_who_looks_on_sees_how_far_it_is(handed_in, alone, monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    main(["check", str(handed_in / "ann")])
    bars = re.findall(r"\r\[([#.]{30})\] (\d) of 1 files", capsys.readouterr().err)
    assert bars == [("." * 30, "0"), ("#" * 30, "1")]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["empty"], "empty holds no file."),
        (["ann", "--report", "no/where.csv"], "cannot be written: No such file"),
        (["ann", "--report", "folder.csv"], "folder.csv cannot be written: Is a directory."),
        (["ann", "--figure", "x.png"], "--figure is for one file, but ann is a folder."),
        (["ann", "--hint"], "--hint is for one file, but ann is a folder."),
        (["ann/task_1_1.py", "--report", "x.csv"], "--report is for a folder or zip, but"),
    ],
)
def test_what_cannot_be_done_is_told(handed_in, arguments, words, monkeypatch, capsys):
    monkeypatch.chdir(handed_in)
    (handed_in / "empty").mkdir()
    (handed_in / "folder.csv").mkdir()
    monkeypatch.setattr(folder, "check_file", None)  # nothing is checked before
    assert main(["check", *arguments]) == 2
    assert words in capsys.readouterr().err


def test_a_table_that_can_no_longer_be_written_is_told(handed_in, monkeypatch, capsys):
    def fail(rows, path):
        raise OSError(28, "No space left on device")

    monkeypatch.chdir(handed_in)
    monkeypatch.setattr(folder, "check_folder", lambda *args, **options: [folder._row("x.py")])
    monkeypatch.setattr(folder, "write", fail)
    assert main(["check", "ann", "--jobs", "1", "--report", "x.csv"]) == 2
    assert "x.csv cannot be written: No space left on device." in capsys.readouterr().err
    assert not list(handed_in.glob("*x.csv*"))


@pytest.mark.skipif(sys.platform == "win32", reason="there are no named pipes in folders")
def test_what_is_no_regular_file_is_passed_over(tmp_path):
    (tmp_path / "from").mkdir()
    program = tmp_path / "from" / "task_1_1.py"
    program.write_text("x")
    os.mkfifo(tmp_path / "from" / "pipe.py")
    os.mkfifo(tmp_path / "from" / "pipe.txt")
    (tmp_path / "from" / "device.txt").symlink_to("/dev/zero")
    told = {found.path.name: found.reason for found in handins.find(tmp_path, tmp_path)}
    assert told["task_1_1.py"] == ""
    assert told["pipe.py"] == told["pipe.txt"] == "is a pipe or a device, or may not be read."
    assert told["device.txt"].startswith("is a link that leads out of the folder")


@pytest.mark.parametrize(
    ("option", "value"),
    [("--report", "x.txt"), ("--report", "csv"), ("--jobs", "0"), ("--jobs", "-2")],
)
def test_options_of_a_folder_are_looked_at_before_anything_runs(option, value, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["check", ".", option, value])
    assert ended.value.code == 2
    assert option in capsys.readouterr().err


def test_the_page_for_teachers_shows_how_to_use_a_cluster(root, handed_in, tmp_path):
    text = (root / "docs/course/class.md").read_text(encoding="utf-8")
    (example,) = (code for code in re.findall(r"```python\n(.*?)```", text, re.S) if "dask" in code)
    assert "LocalCluster(n_workers=2" in example
    shutil.copytree(handed_in, tmp_path / "task_1_2")
    program = tmp_path / "example.py"
    program.write_text(example, encoding="utf-8")
    ran = subprocess.run([sys.executable, program], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    rows = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    assert rows == check_folder(handed_in, jobs=1)


@pytest.mark.parametrize("before", [None, "1"])
def test_files_of_the_class_take_no_module_s_place(tmp_path, monkeypatch, before):
    (tmp_path / "task_1_1.py").write_text(WRONG)
    (tmp_path / "task_1_1_again.py").write_text(WRONG)
    taken = "import os\nopen(os.path.join(os.path.dirname(__file__), 'ran'), 'w').close()\n1 / 0\n"
    for name in ("random.py", "json.py", "queue.py"):
        (tmp_path / name).write_text(taken)
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    if before:
        monkeypatch.setenv("PYTHONSAFEPATH", before)
    get_reusable_executor().shutdown(wait=True)
    monkeypatch.chdir(tmp_path)
    rows = check_folder(tmp_path, limits=LIMITS, jobs=2)
    get_reusable_executor().shutdown(wait=True)
    assert {row["task"] for row in rows if row["file"].startswith("task")} == {"1.1"}
    assert not (tmp_path / "ran").exists()
    assert os.environ.get("PYTHONSAFEPATH") == before
