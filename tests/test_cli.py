"""The command line: tasks, start, check."""

import io
import json
import os
import runpy
import subprocess
import sys
import tempfile

import pytest
from PIL import Image

import canim
from canim import checks, cli
from canim.checks import file as files
from canim.cli import main

pytestmark = pytest.mark.usefixtures("one_guard")

TASK = checks.TASKS["1.1"]
FILE = TASK.file_name
DONE = """
import canim
from canim.interpolation import hermite_basis
canim.check("1.1", hermite_basis=hermite_basis)
answers = {1: "because", 2: "", 3: ""}
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)
    return name


def test_tasks_lists_every_task(capsys):
    assert main(["tasks"]) == 0
    out = capsys.readouterr().out
    assert all(f"{task.id}  {task.title}" in out for task in checks.TASKS.values())
    assert "Interpolation" in out
    assert ("Image warping" in out) == any(t.block == "warping" for t in checks.TASKS.values())


def test_tasks_are_listed_where_the_terminal_lacks_letters(monkeypatch):
    out = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stdout", out)
    assert main(["tasks"]) == 0
    out.flush()
    assert b"1.7  Draw a cubic B?zier curve" in out.buffer.getvalue()


def test_start_writes_the_starter_and_says_how_to_run_it(folder, capsys):
    assert main(["start", "1.1"]) == 0
    assert f"python {FILE}" in capsys.readouterr().out
    assert "def hermite_basis(t):" in (folder / FILE).read_text(encoding="utf-8")


def test_start_never_overwrites(folder, capsys):
    write(FILE, "my work")
    assert main(["start", "1.1"]) == 2
    assert (folder / FILE).read_text(encoding="utf-8") == "my work"
    assert "already here" in capsys.readouterr().err


def test_start_names_the_tasks_there_are(capsys):
    assert main(["start", "7.7"]) == 2
    assert "There is no task '7.7'. There are 0.0, 1.1" in capsys.readouterr().err


def test_a_starter_that_is_missing_is_no_fault_of_who_asks_for_it(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(cli, "files", lambda package: tmp_path)
    assert main(["start", "1.1"]) == 2
    err = capsys.readouterr().err
    assert f"canim cannot read its own starter {FILE}: No such file or directory." in err
    assert "install canim anew" in err


def test_start_says_why_it_cannot_write(monkeypatch, capsys):
    def refuse(*args, **kwargs):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(cli, "open", refuse, raising=False)
    assert main(["start", "1.1"]) == 2
    assert "cannot be written here: Permission denied" in capsys.readouterr().err


def test_check_of_an_unedited_starter_exits_1(capsys):
    main(["start", "1.1"])
    assert main(["check", FILE]) == 1
    out = capsys.readouterr().out
    assert "1 of 4 parts done" in out
    assert "Questions answered: 0 of 3." in out


def test_check_of_a_finished_file_exits_0_and_marks_canims_function(capsys):
    assert main(["check", write("my.py", DONE)]) == 0
    out = capsys.readouterr().out
    assert "uses canim's function" in out
    assert "Questions answered: 1 of 3." in out


def test_the_installed_command_gives_the_exit_code():
    write("my.py", DONE.replace("hermite_basis(t", "x"))
    code = "import sys; from canim.cli import main; sys.exit(main())"
    ran = subprocess.run([sys.executable, "-c", code, "check", "my.py"], check=False)
    assert ran.returncode == 0


def test_the_package_is_the_command_where_the_terminal_does_not_find_it():
    write("my.py", DONE.replace("hermite_basis(t", "x"))
    command = [sys.executable, "-m", "canim", "check", "my.py"]
    ran = subprocess.run(command, capture_output=True, check=False)
    assert ran.returncode == 0
    assert b"All checks of Task 1.1 pass." in ran.stdout


def test_the_package_runs_as_the_command(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["canim", "tasks"])
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("canim", run_name="__main__")
    assert ended.value.code == 0
    assert "1.1" in capsys.readouterr().out


def test_check_hint_shows_the_hint_and_how_to_get_it(capsys):
    write(
        "task_1_1.py",
        "import numpy as np\ndef hermite_basis(t):\n"
        "    return np.array([2*t**3-3*t**2+1, -3*t**3+3*t**2, t**3-2*t**2+t, t**3-t**2])\n",
    )
    assert main(["check", "task_1_1.py"]) == 1
    assert "There is a hint. Type: canim check --hint task_1_1.py" in capsys.readouterr().out
    assert main(["check", "--hint", "task_1_1.py"]) == 1
    assert "Hint: Some texts misprint" in capsys.readouterr().out


WRONG = """import numpy as np
def hermite_basis(t):
    return np.array([2 * t**3 - 3 * t**2 + 1, -3 * t**3 + 3 * t**2, t, t**3 - t**2])
"""


def test_expected_and_got_are_drawn_into_a_file(folder, capsys):
    assert main(["check", "--task", "1.1", "--figure", "seen.png", write("my.py", WRONG)]) == 1
    assert "Expected and yours are drawn in seen.png." in capsys.readouterr().out
    with Image.open(folder / "seen.png") as image:
        assert image.height > image.width  # two parts, one below the other


def test_where_there_is_nothing_to_draw_it_says_so(folder, capsys):
    assert main(["check", "--figure", "seen.png", write("my.py", DONE)]) == 0
    assert "There is no picture: no part that differs" in capsys.readouterr().out
    assert not (folder / "seen.png").exists()


def test_a_picture_that_cannot_be_written_is_refused(capsys):
    name = write("my.py", WRONG)
    assert main(["check", "--task", "1.1", "--figure", "absent/seen.png", name]) == 2
    assert "seen.png cannot be written: No such file" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["check", "--figure", "seen.jpg", name])
    assert "the name must end in .png, but is 'seen.jpg'" in capsys.readouterr().err


def test_the_way_to_the_hint_names_task_and_file_as_they_were_given(capsys):
    wrong = "def hermite_basis(t):\n    return [t, -3 * t**3 + 3 * t**2, t, t]\n"
    main(["check", write("my file.py", wrong), "--task", "1.1"])
    assert 'canim check --hint --task 1.1 "my file.py"' in capsys.readouterr().out


def test_check_looks_functions_up_whatever_the_file_itself_calls_or_prints(capfd):
    noise = "import sys\nprint('noise')\nprint('noise', file=sys.stderr)\n"
    write("mine.py", DONE.replace("hermite_basis=hermite_basis", "hermite_basis=None") + noise)
    assert main(["check", "mine.py"]) == 0
    said = capfd.readouterr()
    assert said.out.count("Task 1.1") == 2
    assert "noise" not in said.out + said.err


def test_a_file_beside_the_program_does_not_hide_a_module_of_ours():
    write("json.py", "hidden = 1 / 0")
    assert main(["check", write("mine.py", DONE)]) == 0


def test_the_task_is_that_of_the_option_then_of_the_call_then_of_the_name(capsys):
    write("task_1_2_x.py", DONE)
    assert main(["check", "task_1_2_x.py"]) == 0
    assert main(["check", "--task", "1.1", write("a.py", DONE.replace("1.1", "9.9"))]) == 0
    assert main(["check", "--task", "7.7", "a.py"]) == 2
    assert (
        main(["check", write("my task 1.1.py", DONE.replace("canim.check", "(lambda *a, **k: 0)"))])
        == 0
    )
    capsys.readouterr()
    assert main(["check", write("b.py", "x = 1")]) == 2
    assert "not a task of the course: say which one with --task" in capsys.readouterr().err
    assert main(["check", write("task_9_9.py", "check(1)")]) == 2


def test_a_file_that_stops_halfway_is_checked_as_far_as_it_came(capsys):
    write("mine.py", DONE + "\nprint(undefined)\nanswers = 3\n")
    assert main(["check", "mine.py"]) == 1
    out = capsys.readouterr().out
    assert "The program stops in line 7:" in out
    assert "The name undefined is not known here." in out
    assert out.count("✓") + out.count("+ H") == 4


def test_a_file_that_ends_itself_is_checked():
    assert main(["check", write("mine.py", DONE + "\nraise SystemExit(3)\n")]) == 0


def test_answers_that_are_no_dictionary_count_as_none(capsys):
    main(["check", write("mine.py", DONE + "\nanswers = 3\n")])
    assert "Questions answered: 0 of 3." in capsys.readouterr().out


def test_answers_may_have_any_keys_and_values(capsys):
    main(["check", write("mine.py", DONE + "\nanswers = {(1, 2): print, 2: ''}\n")])
    assert "Questions answered: 1 of 3." in capsys.readouterr().out


def test_a_loop_without_end_is_ended(capsys):
    assert main(["check", "--time", "3", write("mine.py", DONE + "\nwhile True: pass\n")]) == 1
    assert "did not end within 3 seconds" in " ".join(capsys.readouterr().out.split())


def test_a_function_that_changes_what_it_is_given_does_not_pass(capsys):
    changing = "\nright = hermite_basis\ndef hermite_basis(t):\n"
    changing += "    basis = right(t)\n    t[:] = 0\n    return basis\n"
    assert main(["check", write("mine.py", DONE + changing)]) == 1
    assert "Task 1.1: 4 of 4 parts done." in capsys.readouterr().out


def test_a_thread_that_goes_on_is_not_waited_for(capsys):
    thread = "\nimport threading, time\nthreading.Thread(target=time.sleep, args=[60]).start()\n"
    assert main(["check", "--time", "30", write("mine.py", DONE + thread)]) == 0
    assert "All checks of Task 1.1 pass" in capsys.readouterr().out


@pytest.mark.parametrize("limit", ["0", "-1", "nan", "inf", "x"])
def test_a_limit_is_a_number_above_0(limit, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["check", "mine.py", "--time", limit])
    assert ended.value.code == 2
    assert "--time" in capsys.readouterr().err


def test_a_program_is_checked_as_python_would_run_it(capsys):
    text = DONE + '\nfrom pathlib import Path\nassert Path(__file__).name == "mine.py"\nx = "\\d"\n'
    text += "import pickle\ndef f(): pass\npickle.loads(pickle.dumps(f))\n"
    assert main(["check", write("mine.py", text)]) == 0
    assert main(["check", write("mine.py", DONE + "\ndef f(x: flot): pass\n")]) == 1
    assert "The name flot is not known here." in capsys.readouterr().out


def test_letters_of_all_kinds_do_no_harm(monkeypatch):
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")
    mark = "\ufeff"  # some editors put it in front of a text
    assert main(["check", write("mine.py", mark + DONE + "\nprint('ℓ', flush=True)\n")]) == 0


def test_a_program_that_dies_is_told(capsys):
    assert main(["check", write("mine.py", DONE + "\nimport os; os._exit(0)\n")]) == 1
    assert "ended before its functions could be checked" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("absent.py", None, "absent.py is not there."),
        (
            "broken.py",
            b"x = 1\ny = (1\n",
            "broken.py, line 2:\n  y = (1\n      ^\nA bracket is opened",
        ),
        ("latin.py", "x = 'é'".encode("latin-1"), "is not a text in UTF-8"),
        ("nul.py", b"x = 1\0", "nul.py"),
        ("text.txt", b"x = 1", "neither a .py nor an .ipynb file"),
        ("list.ipynb", b"[1]", "is not a Jupyter notebook"),
        ("no.ipynb", b"{", "is not a Jupyter notebook"),
        ("deep.ipynb", b"[" * 100_000, "is not a Jupyter notebook"),
        ("deep.py", b"x = " + b"-" * 100_000 + b"1", "deep.py is nested too deep for Python"),
        ("calls.py", b"x" + b"()" * 1500, "calls.py is"),
    ],
)
def test_a_file_that_cannot_be_used_exits_2_with_a_sentence(folder, name, content, words, capsys):
    if content is not None:
        (folder / name).write_bytes(content)
    assert main(["check", name]) == 2
    err = capsys.readouterr().err
    assert words in err
    assert "Traceback" not in err


def test_a_file_that_the_system_does_not_give_is_refused(monkeypatch, capsys):
    def refuse(*args, **kwargs):
        raise PermissionError(13, "Permission denied")

    write("mine.py", DONE)
    monkeypatch.setattr(files.Path, "read_bytes", refuse)
    assert main(["check", "mine.py"]) == 2
    assert "mine.py cannot be read: Permission denied." in capsys.readouterr().err


@pytest.mark.parametrize("command", [["check"], []])
def test_a_file_in_a_folder_without_permission_is_refused(command, monkeypatch, capsys):
    stat = os.stat

    def refuse(path, *args, **kwargs):
        if "secret" in str(path):
            raise PermissionError(13, "Permission denied")
        return stat(path, *args, **kwargs)

    monkeypatch.setattr(os, "stat", refuse)
    monkeypatch.setattr(os, "lstat", refuse)
    assert main([*command, "secret/x.py"]) == 2
    err = capsys.readouterr().err
    assert ("secret/x.py cannot be read: Permission denied." if command else "check") in err
    assert "nobody foresaw" not in err


def test_a_name_that_no_file_can_have_is_of_none(capsys):
    assert main(["check", "x" * 5000]) == 2
    assert "is not there." in capsys.readouterr().err


def test_a_folder_that_may_not_be_read_is_not_looked_through(monkeypatch, capsys):
    def refuse(folder):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(cli.Path, "iterdir", refuse)
    assert main(["check", "task_1_1.py"]) == 2
    assert "task_1_1.py is not there." in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="there are no named pipes in folders")
def test_a_pipe_is_refused_and_not_waited_for(capsys):
    os.mkfifo("mine.py")
    os.mkfifo("mine")
    for name in ("mine.py", "mine"):
        assert main(["check", name]) == 2
        assert f"{name} is a pipe or a device: " in capsys.readouterr().err


def test_a_program_cannot_steer_the_terminal(capsys):
    steer = "\\x1b[2J\\x9b1m\\x07"
    assert main(["check", write("mine.py", DONE + f"\nraise ValueError('a{steer}b')\n")]) == 1
    assert "ValueError: a?[2J?1m?b" in capsys.readouterr().out
    assert main(["check", write("mine.py", "x = '\x1b[2J' y")]) == 2
    assert "x = '?[2J' y" in capsys.readouterr().err


def test_what_stops_the_check_itself_is_told_with_exit_code_2(monkeypatch, capsys):
    def fail(*args, **options):
        raise RuntimeError("no reason")

    def full(*args, **options):
        raise OSError(28, "No space left on device")

    write("mine.py", DONE)
    with monkeypatch.context() as change:
        change.setattr(files, "_run", fail)
        assert main(["check", "mine.py"]) == 2
    err = capsys.readouterr().err
    assert err.startswith("The check itself failed, no program is to blame: it met what nobody")
    assert "file.py, line" in err
    assert "RuntimeError: no reason" in err
    with monkeypatch.context() as change:
        change.setattr(tempfile, "mkdtemp", full)
        assert main(["check", "mine.py"]) == 2
    assert "cannot be copied to where it runs: [Errno 28] No space left" in capsys.readouterr().err


def test_a_task_that_cannot_be_loaded_is_told_with_its_line(tmp_path, monkeypatch, capsys):
    (tmp_path / "canim").mkdir()
    (tmp_path / "canim" / "task_9_9.py").write_text("x = 1\nfrom numpy import no_such_name\n")
    monkeypatch.setattr(checks, "__path__", [*checks.__path__, str(tmp_path / "canim")])
    monkeypatch.setattr(checks.TASKS, "_ids", [*checks.TASKS, "9.9"])
    write("mine.py", DONE)
    write("theirs.py", "canim.check('9.9')")
    for command in (["check", "mine.py", "--task", "9.9"], ["check", "theirs.py"], ["tasks"]):
        assert main(command) == 2
        err = capsys.readouterr().err
        assert "The check itself failed, no program is to blame: " in err
        assert "task_9_9.py, line 2." in err
        assert "no_such_name" in err
    assert main(["check", "mine.py"]) == 0  # the other tasks are checked


def test_a_value_error_of_the_parser_is_told(monkeypatch, capsys):
    def refuse(*args):
        raise ValueError("source code string cannot contain null bytes")

    write("mine.py", "x = 1")
    monkeypatch.setattr(files.ast, "parse", refuse)
    assert main(["check", "mine.py"]) == 2
    assert "is not a Python program" in capsys.readouterr().err


def notebook(*cells):
    return json.dumps(
        {
            "cells": [
                {"cell_type": "markdown", "source": ["# Title"]},
                *({"cell_type": "code", "source": cell.splitlines(True)} for cell in cells),
            ]
        }
    )


def test_notebooks_are_checked_and_lines_for_ipython_passed_over():
    write("n.ipynb", notebook("%pip install canim\nif 1:\n    !ls\nprint?\n# why?", DONE))
    assert main(["check", "n.ipynb"]) == 0
    write("n.ipynb", notebook("x = (7\n    % 4)\nassert x == 3", DONE))
    assert main(["check", "n.ipynb"]) == 0


def test_the_cells_that_python_cannot_read_are_told(capsys):
    write("n.ipynb", notebook("x = " + "-" * 100_000 + "1", DONE))
    assert main(["check", "n.ipynb"]) == 0
    assert "Code cell 1 stops in line 1:" in capsys.readouterr().out
    write("n.ipynb", notebook("x = 1", DONE + "x = ("))
    assert main(["check", "n.ipynb"]) == 2  # nothing else says which task it is
    assert "n.ipynb, code cell 2, line 6" in capsys.readouterr().err


def test_a_crash_in_a_notebook_names_the_cell_and_its_line(capsys):
    write("n.ipynb", notebook(DONE, "x = 1\nprint(undefined)"))
    assert main(["check", "n.ipynb"]) == 0
    assert "Code cell 2 stops in line 2:\n    print(undefined)" in capsys.readouterr().out


def test_no_window_is_opened_and_the_file_runs_in_its_folder(folder):
    (folder / "sub").mkdir()
    (folder / "sub" / "data.txt").write_text("1", encoding="utf-8")
    (folder / "sub" / "own_module.py").write_text("y = 1", encoding="utf-8")
    text = DONE + (
        "\nimport matplotlib\nmatplotlib.use('TkAgg')"
        "\nassert matplotlib.get_backend().lower() == 'agg'"
        "\nopen('data.txt').close()\nimport own_module, sys\nassert __name__ == '__main__'"
        "\nassert len(sys.argv) == 1\nimport matplotlib.pyplot as plt\nplt.show()\n"
    )
    (folder / "sub" / "mine.py").write_text(text, encoding="utf-8")
    assert main(["check", "sub/mine.py"]) == 0


def test_the_version_is_told(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0
    assert capsys.readouterr().out == f"canim {canim.__version__}\n"


def test_the_bare_command_shows_what_it_can_do(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["canim"])
    assert main() == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert all(f"\n    {command} " in said.out for command in ("tasks", "start", "check"))


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("chek", "Do you mean: canim check?"),
        ("star", "Do you mean: canim start?"),
        ("task", "Do you mean: canim tasks?"),
        ("mine.py", "Do you mean: canim check mine.py?"),
        ("1.1", "Do you mean: canim check 1.1?"),
    ],
)
def test_a_command_that_is_nearly_right_is_told(word, meant, capsys):
    assert main([word]) == 2
    assert f"There is no command {word}. {meant}" in capsys.readouterr().err


def test_another_word_is_no_command(capsys):
    with pytest.raises(SystemExit):
        main(["xyz"])
    assert "invalid choice: 'xyz'" in capsys.readouterr().err


@pytest.mark.parametrize(
    "number",
    ["1,1", "1_1", "1-1", "1 1", "task 1.1", "Task1.1", "1.1.", "task_1_1", "(1.1)", "01.01"],
)
def test_a_number_in_other_signs_is_taken_where_it_is_certain(number, folder, capsys):
    assert main(["start", *number.split()]) == 0
    assert (folder / FILE).exists()
    assert main(["check", "--task", number, write("my.py", DONE)]) == 0
    assert main(["check", number]) == 1


@pytest.mark.parametrize(
    ("number", "words"),
    [("11", "Do you mean '1.1'?"), ("9,9", "There are 0.0, 1.1"), ("x", "There are 0.0, 1.1")],
)
def test_a_number_that_is_not_certain_is_asked_for(number, words, folder, capsys):
    assert main(["start", number]) == 2
    assert f"There is no task '{number}'. {words}" in capsys.readouterr().err
    assert main(["check", "--task", number, write("my.py", DONE)]) == 2
    assert words in capsys.readouterr().err
    assert [path.name for path in folder.iterdir()] == ["my.py"]


def test_the_check_of_a_program_asks_which_task_was_meant():
    with pytest.raises(ValueError, match=r"There is no task '1,1'\. Do you mean '1\.1'\?"):
        canim.check("1,1")


def test_the_file_of_a_task_is_found_in_this_folder(folder, capsys):
    assert main(["check", "1.1"]) == 2
    said = capsys.readouterr().err
    assert "There is no file of Task 1.1 in this folder." in said
    assert "Get its starter with: canim start 1.1" in said
    write("task_1_10.py", DONE)
    write("task_1_1.txt", "notes")
    write("task_1_1_mine.ipynb", notebook(DONE))
    assert main(["check", "1.1"]) == 0
    write(FILE, DONE)
    capsys.readouterr()
    assert main(["check", "1.1"]) == 2
    said = capsys.readouterr().err
    assert f"several files of Task 1.1 in this folder: task_1_1_mine.ipynb, {FILE}." in said
    assert 'Say which one, as in: canim check "task_1_1_mine.ipynb"' in said
    (folder / "1.1").mkdir()
    write("1.1/a.py", DONE)
    assert main(["check", "1.1", "--jobs", "1"]) == 0  # a folder of that name is that folder


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("11", "There is no task '11'. Do you mean '1.1'?"),
        ("9.9", "There is no task '9.9'. There are"),
        ("task_1_1.py", f"task_1_1.py is not there. Do you mean {FILE}?"),
        ("sub/task_1_1.py", "sub/task_1_1.py is not there."),
        ("*.ipynb", "*.ipynb is not there."),
    ],
)
def test_a_file_that_is_not_there_is_looked_for(text, words, capsys):
    write(FILE, DONE)
    assert main(["check", text]) == 2
    assert words in capsys.readouterr().err


def test_several_files_are_checked_one_after_another(folder, capsys):
    write("a.py", DONE)
    write("b.py", DONE + "1 / 0\n")
    (folder / "class").mkdir()
    write("class/c.py", DONE)
    assert main(["check", "a.py", "class", "--jobs", "1"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("a.py\nTask 1.1: ")
    assert "\n\nclass\nc.py: Task 1.1, 4 of 4 parts done\n" in out
    assert main(["check", "*.py"]) == 1  # as it comes where the terminal knows no patterns
    assert "\n\nb.py\nTask 1.1: " in capsys.readouterr().out
    write("c.py", "x = (")
    assert main(["check", "c.py", "a.py"]) == 2
    assert "All checks of Task 1.1 pass." in capsys.readouterr().out


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ("--figure=x.png", "--figure is for one file, but there are 2."),
        ("--report=x.csv", "--report is for one folder or zip, but there are 2 files."),
    ],
)
def test_options_for_one_are_not_taken_for_two(option, words, capsys):
    assert main(["check", write("a.py", DONE), write("b.py", DONE), option]) == 2
    assert words in capsys.readouterr().err


def test_a_program_of_this_folder_takes_no_module_s_place(folder, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(folder), *sys.path])
    monkeypatch.setattr(sys, "argv", ["canim", "tasks"])
    with pytest.raises(SystemExit):
        runpy.run_module("canim", run_name="__main__")
    assert str(folder) not in sys.path


def test_a_name_that_is_empty_is_refused(capsys):
    assert main(["check", ""]) == 2
    assert capsys.readouterr().err == "The name of the file is empty.\n"


def test_a_command_that_is_stopped_says_so(monkeypatch, capsys):
    def stop():
        raise KeyboardInterrupt

    monkeypatch.setattr(cli, "_tasks", stop)
    assert main(["tasks"]) == 130
    assert capsys.readouterr().err == "\nThe command was stopped with Ctrl+C.\n"


def test_who_has_read_enough_is_told_of_no_failure(monkeypatch, tmp_path, capsys):
    def print_more(asked):
        raise BrokenPipeError

    monkeypatch.setattr(cli, "_carry_out", print_more)
    with (tmp_path / "read").open("w", encoding="utf-8") as read:
        monkeypatch.setattr(sys, "stdout", read)
        assert cli.main(["tasks"]) == 1
        read.write("this comes late")
    assert (tmp_path / "read").read_text(encoding="utf-8") == ""
    assert capsys.readouterr().err == ""
