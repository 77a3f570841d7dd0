"""The list of a block's tasks, made from the registry: `.. task-cards:: interpolation`.

With `:toctree:` these tasks are the page's children in the navigation.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from pictures import picture
from sphinx import addnodes
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective
from task_page import builds_on, page_link

from canim.checks import BLOCKS, TASKS

logger = logging.getLogger(__name__)

FIRST_PICTURE = re.compile(
    r"^\.\. (?:picture|film):: (\S+)/(\S+)(\.\w+)\n"
    r" +:alt: (.*)\n +:width: (\d+)\n +:height: (\d+)",
    re.M,
)
THUMB_SHOWN = 240


class TaskCards(SphinxDirective):
    """A card for each task of a block, or a sentence where there is none yet."""

    required_arguments = 1
    option_spec: ClassVar = {"toctree": directives.flag}

    def run(self):
        block = self.arguments[0]
        if block not in BLOCKS:
            self.warn(f"no block {block!r}, only {', '.join(BLOCKS)}")
        tasks = [task for task in TASKS.values() if task.block == block]
        if not tasks:
            return [nodes.paragraph("", "This block has no task.")]
        cards = nodes.bullet_list("", *map(self.card, tasks), classes=["task-cards"])
        return [cards, self.toctree(tasks)] if "toctree" in self.options else [cards]

    def toctree(self, tasks):
        pages = [task.page for task in tasks]
        children = addnodes.toctree(
            "",
            parent=self.env.docname,
            entries=[(None, page) for page in pages],
            includefiles=pages,
            maxdepth=-1,
            caption=None,
            glob=False,
            hidden=True,
            includehidden=False,
            numbered=0,
            titlesonly=True,
        )
        return nodes.compound("", children, classes=["toctree-wrapper"])

    def card(self, task):
        title = nodes.paragraph("", "", classes=["task-cards-title"])
        title += page_link(task, f"Task {task.id}: {task.title}")
        facts = nodes.paragraph("", f"{task.minutes} minutes. Builds on ")
        facts += [*builds_on(task), nodes.Text(".")]
        return nodes.list_item("", *self.thumb(task), title, facts)

    def thumb(self, task):
        source = Path(self.env.srcdir, f"{task.page}.rst")
        if not source.exists():
            self.warn(f"task {task.id} has no page {task.page}")
            return []
        self.env.note_dependency(str(source))
        found = FIRST_PICTURE.search(source.read_text(encoding="utf-8"))
        if not found:
            self.warn(f"the page of task {task.id} has no picture")
            return []
        folder, name, suffix, alt, width, height = found.groups()
        size = {"width": THUMB_SHOWN, "height": round(int(height) * THUMB_SHOWN / int(width))}
        thumb = f"{folder}/thumb/{name}_thumb{suffix}"
        return [picture(uri=thumb, alt=f"Expected result: {alt}", **size)]

    def warn(self, message):
        logger.warning(message, location=self.get_location(), type="tasks")


def setup(app):
    app.add_directive("task-cards", TaskCards)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
