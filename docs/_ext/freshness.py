"""Leave nothing behind that is out of date.

The gallery's scripts run again when canim, which draws their figures, has changed:
sphinx-gallery looks only at the scripts, and Sphinx only at the pages' sources.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

from take_away import PRINTED

import canim

EXT = Path(__file__).parent
BUILD_INFO = ".buildinfo"


def _digest(folder, *files):
    sources = [*files] or [
        path
        for path in folder.rglob("*")
        # Starters come from the scripts, and say nothing of how figures are drawn.
        if path.suffix in {".py", ".mplstyle"} and "starters" not in path.parts
    ]
    texts = [path.name.encode() + path.read_bytes() for path in sorted(sources)]
    return hashlib.sha256(b"\0".join(texts)).hexdigest()


def _forget(app, config):
    package = _digest(Path(canim.__file__).parent)
    figures = package + _digest(EXT, EXT / "pictures.py")
    config.page_sources = package + _digest(EXT)
    generated = Path(app.srcdir, config.sphinx_gallery_conf["gallery_dirs"])
    scripts = Path(app.srcdir, config.sphinx_gallery_conf["examples_dirs"])
    seen = generated / "figures.sha256"
    changed = not seen.exists() or seen.read_text(encoding="utf-8") != figures
    for mark in generated.rglob("*.py.md5"):
        script = mark.relative_to(generated).with_suffix("")
        if not (scripts / script).exists():
            for leftover in mark.parent.glob(f"{script.stem}.*"):
                leftover.unlink()
        elif changed:
            mark.unlink()
    generated.mkdir(exist_ok=True)
    seen.write_text(figures, encoding="utf-8")


def _remove_old_pages(app, exception):
    """Remove what an earlier build made of a page that is gone: Sphinx leaves it there."""
    if exception or app.builder.name != "html":
        return
    kept = {*app.env.found_docs, *PRINTED, "404", "genindex", "search"}
    for page in app.outdir.rglob("*.html"):
        if page.relative_to(app.outdir).with_suffix("").as_posix() not in kept:
            page.unlink()


def _bring_build_info(app):
    """Fetch what Sphinx noted of its settings; they name folders, so the site does not have it."""
    _move(Path(app.doctreedir, BUILD_INFO), Path(app.outdir, BUILD_INFO))


def _take_build_info(app, exception):
    _move(Path(app.outdir, BUILD_INFO), Path(app.doctreedir, BUILD_INFO))
    # Where a setting has changed, Sphinx keeps the note of the build before.
    Path(app.outdir, f"{BUILD_INFO}.bak").unlink(missing_ok=True)


def _move(source, target):
    if source.exists():
        source.replace(target)


def setup(app):
    # Cards and formulas are made while reading and writing: a change there concerns all pages.
    app.add_config_value("page_sources", "", "env", types=str)
    app.connect("config-inited", _forget)
    app.connect("builder-inited", _bring_build_info)
    app.connect("build-finished", _remove_old_pages)
    app.connect("build-finished", _take_build_info)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
