"""Parts of tasks and the mistakes that checks know, from the registry: `.. known-mistakes::`."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
from docutils import nodes
from sphinx.util.docutils import SphinxDirective
from task_page import page_link

from canim import checks
from canim.checks.task import SOURCES

SOLUTIONS = Path(__file__).parents[2] / "tests/gallery/solutions"


class KnownMistakes(SphinxDirective):
    """A table of all tasks, what the sources mean, and a table of mistakes for each task."""

    def run(self):
        tasks = list(checks.TASKS.values())
        counts = [
            [page_link(task, f"{task.id} {task.title}"), len(task.parts), len(task.mistakes)]
            for task in tasks
        ]
        sums = [sum(row[k] for row in counts) for k in (1, 2)]
        kinds = Counter(_kind(mistake) for task in tasks for mistake in task.mistakes)
        meanings = [[kind, meaning, kinds[kind]] for kind, meaning in SOURCES.items()]
        return [
            _table(["Task", "Parts", "Known mistakes"], [*counts, ["All tasks", *sums]]),
            _table(["Source", "What it means", "Known mistakes"], meanings),
            *(self.section(task) for task in tasks),
        ]

    def section(self, task):
        title = f"Task {task.id}: {task.title}"
        section = nodes.section(ids=[f"mistakes-{task.id.replace('.', '-')}"], names=[])
        section += nodes.title("", title)
        section += _table(
            ["Part", "Its line of the pseudocode"],
            [[part.name, nodes.literal("", task.lines[part.name])] for part in task.parts],
        )
        right = _right(task)
        section += _table(
            ["Known mistake", "Shows in", "Source"],
            [
                [mistake.name, ", ".join(shows_in(task, mistake, right)), mistake.source]
                for mistake in task.mistakes
            ],
        )
        return section


def shows_in(task, mistake, right):
    """Return the parts in which the check recognises `mistake` in an otherwise right program."""
    report = checks.run(task, right | dict(mistake.program))
    return [result.part for result in report.results if result.mistake == mistake.name]


def _right(task):
    """Return the references; where the student is free, what the model solution has."""
    names = {function.name: function.reference for function in task.functions}
    if task.data or None in names.values():
        solution = {"np": np}
        exec((SOLUTIONS / task.file_name).read_text(encoding="utf-8"), solution)
        names |= {name: solution[name] for name in task.names if names.get(name) is None}
    return names


def _kind(mistake):
    return mistake.source.split(":")[0]


def _table(head, rows):
    group = nodes.tgroup(cols=len(head))
    group += [nodes.colspec(colwidth=1) for _ in head]
    group += nodes.thead("", _row(head))
    group += nodes.tbody("", *map(_row, rows))
    return nodes.table("", group)


def _row(cells):
    row = nodes.row()
    for cell in cells:
        text = cell if isinstance(cell, nodes.Node) else nodes.Text(str(cell))
        row += nodes.entry("", nodes.paragraph("", "", text))
    return row


def setup(app):
    app.add_directive("known-mistakes", KnownMistakes)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
