"""What a program in the page loads: whole, small, and left out where there is no source of it."""

import hashlib
import json
import re
from pathlib import Path
from types import SimpleNamespace

import pyodide
import pytest
import run_files
import run_here
import starter
from sphinx.errors import ExtensionError

from canim.checks import TASKS

ROOT = Path(__file__).parents[2]


@pytest.fixture
def served(site):
    (folder,) = (site / "_run").iterdir()
    return folder


@pytest.fixture
def packages(served):
    return json.loads((served / run_files.LIST).read_bytes())["packages"]


def test_every_listed_file_is_there_with_its_hash(served, packages):
    for package in packages.values():
        content = (served / package["file_name"]).read_bytes()
        assert hashlib.sha256(content).hexdigest() == package["sha256"], package["name"]
    core = {"pyodide.asm.js", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json"}
    files = {path.name for path in served.iterdir()}
    listed = {package["file_name"] for package in packages.values()}
    assert files == core | listed | {"run.json", "worker.js"}


def test_what_a_package_needs_is_listed(packages):
    for package in packages.values():
        assert packages.keys() >= {*package["depends"]}, package["name"]
    assert packages.keys() >= {*run_files.FIRST, *run_files.NEEDS, *run_files.PARTS}


def test_the_first_plot_loads_no_more_than_15_mb(served):
    known = json.loads((served / "run.json").read_bytes())
    assert 5e6 < known["bytes"]["first"] <= 15e6


@pytest.mark.parametrize("task", list(TASKS))
def test_a_starter_asks_for_what_it_needs(task):
    task = TASKS[task]
    page = starter.read(ROOT / "gallery" / task.block / task.file_name)
    program = starter.script(page, starter.release(ROOT))
    asked = {part for part, asks in run_files.NEEDS.items() if re.search(asks, program)}
    wanted = {"scipy"} if task.block == "warping" else set()
    if task.id in ("3.4", "3.5"):
        wanted = {"canim-face"}
    assert asked == wanted


def test_without_python_there_is_a_warning_and_no_run(monkeypatch):
    def nothing(wheel):
        raise pyodide.NotFound("no numpy.whl")

    said = []
    monkeypatch.setattr(run_files, "make", nothing)
    monkeypatch.setattr(run_here, "served_wheel", lambda: None)
    monkeypatch.setattr(
        run_here.logger, "warning", lambda text, **_: said.append(("warning", text))
    )
    monkeypatch.setattr(run_here.logger, "info", lambda text: said.append(("info", text)))
    config = SimpleNamespace(run_here=False)
    for setting, kind in (("", "info"), ("true", "warning")):
        monkeypatch.setenv("CI", setting)
        run_here._prepare(None, config)
        assert said[-1][0] == kind
        assert (
            "pages will have no Run, for its Python is not to be had: no numpy.whl" in said[-1][1]
        )
    assert not config.run_here


def test_a_wrong_file_stops_the_build(monkeypatch):
    def wrong(wheel):
        raise pyodide.Mismatch("numpy.whl has the sha256 00")

    monkeypatch.setattr(run_files, "make", wrong)
    monkeypatch.setattr(run_here, "served_wheel", lambda: None)
    with pytest.raises(ExtensionError, match=r"numpy\.whl has the sha256 00"):
        run_here._prepare(None, SimpleNamespace(run_here=False))
