"""Run here: bundles the page's scripts and puts Python, for programs in the page, into the site.

Without a source of Python the site is built all the same, and no page has Run.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
from pathlib import Path

import pyodide
import run_files
from docutils import nodes
from downloads import served_wheel
from formulas import NODE
from sphinx.errors import ExtensionError
from sphinx.util import logging
from sphinx.util.console import red
from sphinx.util.docutils import SphinxDirective
from take_away import LEFT_OUT

logger = logging.getLogger(__name__)

WEB = pyodide.DOCS / "_web"
PACKAGES = pyodide.DOCS / "node_modules"
TEXTS = "licences.txt"
# Where a page has one of these, a script waits for it.
NEEDS_SCRIPT = ("<canim-run", "task-cards")


def _prepare(app, config):
    try:
        files = run_files.make(served_wheel())
    except pyodide.Mismatch as error:
        raise ExtensionError(f"run here: {error}") from None
    except pyodide.NotFound as error:
        _warn(f"run here: pages will have no Run, for its Python is not to be had: {error}")
        return
    known = json.loads((files / run_files.KNOWN).read_bytes())
    worker, scripts = Path(app.doctreedir, "worker"), Path(app.doctreedir, "scripts")
    bundled = _bundle(["worker.js"], worker, "esm", known)
    bundled += _bundle(["editor.js"], scripts, "esm", known)
    del known["files"]  # the page need not know them
    known["folder"] = f"_run/{_digest(files, worker, scripts / 'editor.js')}/"
    bundled += _bundle(["run.js"], scripts, "iife", known)
    bundled = sorted({*bundled} - {"pyodide"})
    (scripts / TEXTS).write_text(_licence_texts(bundled), encoding="utf-8")
    config.run_here = True
    config.run_scripts = _digest(scripts)
    config.html_static_path.append(str(scripts))
    app.run_folder, app.run_parts = known["folder"], (files, worker)
    config.run_licences = [*run_files.licences(files), *_licences(bundled)]


def _warn(message):
    """Warn; on a machine for CI, a warning stops the build."""
    if os.environ.get("CI"):
        logger.warning(message, type="run_here")
    else:
        logger.info(red(f"WARNING: {message}"))


def _bundle(entries, folder, form, known):
    """Write a script that needs no other; return the names of what it takes from npm."""
    job = {
        "entries": [str(WEB / entry) for entry in entries],
        "folder": str(folder),
        "format": form,
        "run": known,
    }
    command = [NODE, pyodide.DOCS / "_ext/bundle.mjs", json.dumps(job)]
    built = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    if built.returncode:
        raise ExtensionError(f"run here: {built.stderr}")
    return json.loads(built.stdout)


def _digest(*paths):
    digest = hashlib.sha256()
    for path in paths:
        for file in sorted(path.iterdir()) if path.is_dir() else [path]:
            digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()[:12]


def _licences(packages):
    for name in packages:
        about = json.loads((PACKAGES / name / "package.json").read_bytes())
        yield name, about["version"], about["license"]


def _licence_texts(packages):
    """Return what the authors ask to be handed on with their scripts."""
    files = [path for name in packages for path in (PACKAGES / name).glob("LICENSE*")]
    texts = [f"{path.parent.name}\n\n{path.read_text(encoding='utf-8')}" for path in files]
    return ("\n" + "-" * 72 + "\n").join(texts)


def _add_script(app, pagename, templatename, context, doctree):
    if app.config.run_here and any(part in context.get("body", "") for part in NEEDS_SCRIPT):
        app.add_js_file("run.js", loading_method="defer")


def _hand_out(app, exception):
    if exception or app.builder.format != "html":
        return
    if not app.config.run_here:
        shutil.rmtree(app.outdir / "_run", ignore_errors=True)
        (app.outdir / "service_worker.js").unlink(missing_ok=True)
        return
    target = app.outdir / app.run_folder
    if not target.exists():
        shutil.rmtree(target.parent, ignore_errors=True)
        part = target.with_suffix(".part")
        for files in app.run_parts:
            shutil.copytree(files, part, dirs_exist_ok=True)
        part.rename(target)
    _bundle(["service_worker.js"], app.outdir, "iife", _contents(app.outdir))


def _contents(site):
    """Return the hashes of what has a version in its address, and the paths of all else."""
    hashes, others = {}, []
    for path in sorted(path for path in site.rglob("*") if path.is_file()):
        name = path.relative_to(site)
        if name.parts[0] in ("_run", "_static"):
            hashes[name.as_posix()] = hashlib.sha256(path.read_bytes()).hexdigest()
        elif name.parts[0] not in LEFT_OUT:
            others.append(name.as_posix())
    return {"hashes": hashes, "others": others}


class Licences(SphinxDirective):
    """`.. licences-of-run::` lists what the site serves of others, from their metadata."""

    def run(self):
        if not self.config.run_here:
            return [nodes.paragraph("", "This copy of the site was built without Python.")]
        table = nodes.tgroup("", *[nodes.colspec(colwidth=1) for _ in range(3)], cols=3)
        rows = [("what", "version", "licence"), *self.config.run_licences]
        head, *body = [
            nodes.row("", *[nodes.entry("", nodes.paragraph("", cell)) for cell in row])
            for row in rows
        ]
        table += [nodes.thead("", head), nodes.tbody("", *body)]
        text = "The licences of the npm packages, in full"
        link = nodes.reference("", text, refuri=f"_static/{TEXTS}")
        return [nodes.table("", table), nodes.paragraph("", "", link)]


def setup(app):
    app.add_config_value("run_here", False, "env", types=bool)
    app.add_config_value("run_licences", [], "env", types=list)
    app.add_config_value("run_scripts", "", "html", types=str)
    app.add_directive("licences-of-run", Licences)
    app.connect("config-inited", _prepare)
    app.connect("html-page-context", _add_script)
    app.connect(
        "build-finished", _hand_out, priority=950
    )  # when style sheets and scripts are whole
    return {"parallel_read_safe": True, "parallel_write_safe": True}
