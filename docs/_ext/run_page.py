"""Put the program of a task's page into an element where it can be edited and run."""

from __future__ import annotations

from html import escape
from pathlib import Path

import starter
from docutils import nodes
from downloads import RELEASE, ROOT
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer
from task_page import PAGES

MISSING = (
    "Programs do not run here: that needs JavaScript, and the course's web site, not a folder."
)
# The tasks that work on pictures, and how long the sides of the reader's own may be, in pixels.
# Where a program visits each pixel by itself, more would take minutes.
PICTURES = {"2.1": 320, "2.2": 320, "2.3": 640}
CLOSING = f'<p class="run-missing">{MISSING}</p></canim-run>\n'


def opening(task, program):
    """Return the start of the element; what comes in it is shown where nothing can run."""
    coloured = highlight(program, PythonLexer(), HtmlFormatter(wrapcode=False))
    pictures = f' data-pictures="{PICTURES[task.id]}"' if task.id in PICTURES else ""
    return (
        f'<canim-run id="run-here" data-file="{escape(task.file_name)}"{pictures}>'
        f"<template>{coloured.strip()}</template>\n"
    )


def _put(app, doctree):
    task = PAGES.get(app.env.docname)
    if task is None or not app.config.run_here:
        return
    section = next(
        part for part in doctree.findall(nodes.section) if part[0].astext() == "Your task"
    )
    code = next(section.findall(nodes.literal_block))
    page = starter.read(Path(ROOT, "gallery", task.block, task.file_name))
    before = nodes.raw("", opening(task, starter.script(page, RELEASE)), format="html")
    code.replace_self([before, code.deepcopy(), nodes.raw("", CLOSING, format="html")])


def setup(app):
    app.connect("doctree-read", _put, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
