"""Every starter as a student meets it: in an empty folder, in a fresh interpreter."""

import os
import subprocess
import sys
from importlib.resources import files

import nbclient
import nbformat
import pytest
import starter

from canim import checks
from canim.cli import main

pytestmark = pytest.mark.usefixtures("one_guard")

TASKS = list(checks.TASKS.values())
BY_TASK = pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
COUNT_FIGURES = """
import runpy, sys
import matplotlib.pyplot as plt
plt.show = lambda: print("figures:", len(plt.get_fignums()))
runpy.run_path(sys.argv[1], run_name="__main__")
"""


def _python(*arguments, folder):
    return subprocess.run(
        [sys.executable, "-W", "error", *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )


@BY_TASK
def test_an_unedited_starter_runs_and_says_what_is_missing(task, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["start", task.id]) == 0
    ran = _python("-c", COUNT_FIGURES, task.file_name, folder=tmp_path)
    assert ran.returncode == 0, ran.stderr
    assert ran.stderr == ""
    assert "not written yet" in ran.stdout
    assert "figures: 0" not in ran.stdout
    assert "figures:" in ran.stdout
    assert main(["check", "--time", "600", task.file_name]) == 1


@BY_TASK
def test_a_completed_starter_is_done(task, tmp_path, completed, capsys):
    path = tmp_path / task.file_name
    path.write_text(completed[task.file_name], encoding="utf-8")
    ran = _python("-c", COUNT_FIGURES, path, folder=tmp_path)
    assert ran.returncode == 0, ran.stderr
    assert f"All checks of Task {task.id} pass." in ran.stdout
    assert main(["check", "--time", "600", str(path)]) == 0, capsys.readouterr().out


@BY_TASK
def test_the_starter_in_the_package_is_that_of_the_page(task, root):
    page = starter.read(root / "gallery" / task.block / task.file_name)
    packed = files("canim") / "starters" / task.file_name
    assert packed.read_text(encoding="utf-8") == starter.script(page, starter.release(root))


@BY_TASK
def test_a_notebook_runs_without_error_or_stray_output(task, tmp_path, root, monkeypatch):
    monkeypatch.delenv("MPLBACKEND")  # the kernel draws into the notebook
    page = starter.read(root / "gallery" / task.block / task.file_name)
    text = starter.notebook(page, starter.release(root))
    notebook = nbformat.reads(text, as_version=4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(
        notebook, timeout=None, resources={"metadata": {"path": str(tmp_path)}}
    ).execute()
    outputs = [out for cell in notebook.cells for out in cell.get("outputs", [])]
    kinds = {kind for out in outputs for kind in out.get("data", {"stream": ""})}
    assert "image/png" in kinds
    assert "stream" not in kinds
    assert sum("text/html" in out.get("data", {}) for out in outputs) == 1
    assert not any(
        "image/png" not in out["data"] and "text/html" not in out["data"] for out in outputs
    )


@BY_TASK
def test_without_canim_a_starter_says_what_to_type(task, tmp_path):
    text = (files("canim") / "starters" / task.file_name).read_text(encoding="utf-8")
    (tmp_path / "starter.py").write_text(text, encoding="utf-8")
    # -S leaves out the folder of installed packages.
    ran = _python("-S", "-I", "starter.py", folder=tmp_path)
    assert ran.returncode == 1
    assert "python -m pip install" in ran.stderr
    assert "Traceback" not in ran.stderr
    assert len(ran.stderr.strip().splitlines()) == 1
