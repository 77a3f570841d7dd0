"""A task's page: sphinx-gallery's additions go, the card comes, some code is folded.

A task may be left out: where a text links to its page, the words stay and the link goes.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path

import starter
from docutils import nodes
from sphinx import addnodes
from sphinx.util import logging

from canim.checks import TASKS

logger = logging.getLogger(__name__)

GALLERY_NOTE = re.compile(r"^\.\. only:: html\n\n    \.\. note::\n(?: .*\n|\n)+", re.M)
GALLERY_FOOTER = re.compile(r"^\.\. _sphx_glr_download_[\s\S]*\Z", re.M)
GALLERY_THUMBNAILS = re.compile(r"^\.\. raw:: html\n\n  <div id='sg-tag-list'[\s\S]*?"
                                r"(?=^\.\. toctree::|\Z)", re.M)  # fmt: skip
FOR_THE_SITE = re.compile(r"^# (?:Picture|Film|GIF): .*\n(?:#.*\n)*|  # noqa.*$", re.M)
PAGES = {task.page: task for task in TASKS.values()}
# A page that shows what a task is needs the task.
SHOWS = {"students/tasks_and_checks": "0.0"}
GONE = [page for page, task in SHOWS.items() if task not in TASKS]


class ByNumber:
    """The order of a block's pages, for sphinx-gallery."""

    def __init__(self, folder):
        pass

    def __call__(self, name):
        return starter.number(Path(name))


class fold(nodes.General, nodes.Element):
    """Content behind a line that opens it."""


def visit_fold(self, node):
    self.body.append(f'<details class="fold"><summary>{node["summary"]}</summary>\n')


def depart_fold(self, node):
    self.body.append("</details>\n")


def _is_task(docname):
    return re.fullmatch(r"gallery/\w+/task_\w+", docname)


def _remove_additions(app, docname, source):
    if docname.startswith("gallery/"):
        for addition in (GALLERY_NOTE, GALLERY_FOOTER, GALLERY_THUMBNAILS):
            source[0] = addition.sub("", source[0])


def _arrange(app, doctree):
    docname = app.env.docname
    if not _is_task(docname):
        return
    page = next(doctree.findall(nodes.section))
    task = PAGES.get(docname)
    if task is None:
        logger.warning("no task of canim.checks has this page", location=docname)
        return
    for code in list(doctree.findall(nodes.literal_block)):
        clean(code)
    _fold_code(page)
    first = next(i for i, node in enumerate(page) if not _is_introduction(node))
    page.insert(first, _card(app, task, docname))
    page += _source_link(docname)


def _is_introduction(node):
    return isinstance(node, nodes.title | nodes.paragraph | nodes.Invisible)


def clean(code):
    """Take comments that are meant for the site out of a code block."""
    text = FOR_THE_SITE.sub("", code.astext() + "\n").strip("\n")
    code.rawsource = text
    code.children = []
    code += nodes.Text(text)


def _fold_code(page):
    """Fold the set-up, and the code of pictures that come before the student's own work."""
    for part in page:
        if isinstance(part, nodes.literal_block):
            _put_behind("Set-up: what the program is given", part)
        elif isinstance(part, nodes.section):
            if part.next_node(nodes.title).astext() == "Your task":
                return
            for code in part.findall(nodes.literal_block):
                if code["language"].lower() == "python":
                    _put_behind(_how_drawn(code), code)


def _how_drawn(code):
    shown = [type(node).__name__ for node in code.parent[code.parent.index(code) + 1 :]]
    kind = {"film": "film", "gif": "GIF", "literal_block": "table"}.get(
        "".join(shown[:1]), "picture"
    )
    return f"How this {kind} is {'made' if kind == 'table' else 'drawn'}"


def _put_behind(summary, code):
    code.replace_self(fold("", code.deepcopy(), summary=summary))


def _card(app, task, docname):
    up = "../" * docname.count("/")
    starter = f"{up}starters/{task.file_name}"
    functions = [
        nodes.inline("", "", nodes.Text(", " if i else " "), nodes.literal("", f.name))
        for i, f in enumerate(task.functions)
    ]
    rows = nodes.definition_list(
        "",
        _row("You write", nodes.Text(f"{task.writes}:"), *functions),
        _row("Builds on", *builds_on(task)),
        _row("Time", nodes.Text(f"about {task.minutes} minutes")),
        _row("In the paper", nodes.Text(_in_the_paper(task))),
    )
    buttons = nodes.raw(
        "",
        '<p class="buttons">'
        + '<a href="#run-here" class="button">Run here</a>' * app.config.run_here
        + f'<a href="{starter}" class="button" download>Download starter <span>(.py)</span></a>'
        f'<a href="{starter.removesuffix(".py")}.ipynb" class="button" download>Notebook'
        " <span>(.ipynb)</span></a></p>\n",
        format="html",
    )
    install = nodes.raw("", app.config.install_line.format(up=up), format="html")
    return nodes.container("", rows, buttons, install, classes=["task-card"])


def _in_the_paper(task):
    return f"{task.figure} (Casas, 2021)" if task.figure else "not there: this task is new"


def _row(term, *content):
    return nodes.definition_list_item(
        "", nodes.term("", term), nodes.definition("", nodes.paragraph("", "", *content))
    )


def builds_on(task):
    """Return what a task builds on, as links to what is there of it."""
    links = [page_link(TASKS[id_], f"Task {id_}") for id_ in task.builds_on if id_ in TASKS]
    if not links:
        return [nodes.Text("nothing: start here" if task.id == "0.0" else "no other task")]
    return [n for link in links for n in (nodes.Text(", "), link)][1:]


def page_link(task, text):
    """Return a link to a task's page."""
    return addnodes.pending_xref(
        "",
        nodes.inline("", text),
        refdomain="std",
        reftype="doc",
        reftarget=f"/{task.page}",
        refexplicit=True,
        refwarn=True,
    )


def _leave_out(app, env, node, contnode):
    """Show the words of a link to a task that the course does without."""
    target = node["reftarget"]
    if node["reftype"] == "doc" and target.rpartition("/")[2] in map(posixpath.basename, GONE):
        return contnode
    label = re.fullmatch(r"task-(\d)-(\d+)", target)
    if node["reftype"] != "ref" or label is None:
        return None
    return (
        contnode if node["refexplicit"] else nodes.inline("", "Task {}.{}".format(*label.groups()))
    )


def _leave_pages_out(app, config):
    config.exclude_patterns += [f"{page}.md" for page in GONE]


def _take_out_of_lists(app, docname, source):
    for page in GONE:
        name = page.removeprefix(f"{posixpath.dirname(docname)}/")
        source[0] = re.sub(rf"^{name}\n", "", source[0], flags=re.M)


def _source_link(docname):
    script = docname.rpartition("/")[2] + ".py"
    link = nodes.reference("", "Source of this page", refuri=script, internal=True)
    return nodes.paragraph("", "", link, nodes.Text(": the whole script, with theory and figures."),
                           classes=["page-source"])  # fmt: skip


def setup(app):
    app.add_node(fold, html=(visit_fold, depart_fold))
    app.connect("source-read", _remove_additions)
    app.connect("source-read", _take_out_of_lists)
    app.connect("doctree-read", _arrange)
    app.connect("config-inited", _leave_pages_out)
    app.connect("missing-reference", _leave_out)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
