"""Make the starter of a task, as a program and as a notebook, from its page in gallery/.

A page is a script in sphinx-gallery's form: a docstring, then blocks that begin with
``# %%``, each a comment (the text) followed by code. The starter keeps the set-up (the
code below the docstring), "Your task", "Check and draw" and the questions. Everything
that hands a starter to somebody gets it from here: the build of the package, the site
and the tests. Standard library only, since the build of the package needs no more.
"""

from __future__ import annotations

import ast
import json
import re
import textwrap
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

SECTIONS = (
    "Expected result",
    "Theory",
    "Pseudocode",
    "Your task",
    "Check and draw",
    "Think about it",
    "Read more",
)
GIVEN = ("Your task", "Check and draw")
LINE = 88


@dataclass
class Block:
    """A text and the code below it."""

    text: str
    code: str


@dataclass
class Page:
    """A page of the gallery: its title, introduction and sections of blocks."""

    path: Path
    title: str
    intro: str
    setup: str
    sections: dict[str, list[Block]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        return self.path.stem

    @property
    def address(self) -> str:
        return f"gallery/{self.path.parent.name}/{self.name}.html"

    @property
    def questions(self) -> list[str]:
        """Texts of the numbered questions of "Think about it"."""
        text = "\n".join(block.text for block in self.sections["Think about it"])
        items = re.split(r"^\s*(?:\d+|#)\.\s+", text, flags=re.M)[1:]
        return [" ".join(item.split("\n\n")[0].split()) for item in items]


@dataclass(frozen=True)
class Release:
    """What a release names: its addresses ("" while there are none) and the wheel."""

    site: str
    version: str
    repository: str = ""

    @property
    def wheel(self) -> str:
        return f"canim-{self.version}-py3-none-any.whl"

    @property
    def install(self) -> str:
        """One sentence that says what to type where canim is missing."""
        if self.site:
            return (
                "canim is not installed. Type: "
                f"python -m pip install {self.site.rstrip('/')}/wheels/{self.wheel}"
            )
        return (
            f"canim is not installed. Download {self.wheel} from the page you came from, "
            f"then type: python -m pip install {self.wheel}"
        )


def release(root: Path) -> Release:
    """Return the addresses and the version that the project in `root` declares."""
    settings = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
    source = (root / "src/canim/__init__.py").read_text(encoding="utf-8")
    version = re.search(r'^__version__ = "(.+)"$', source, re.M)
    if not version:
        raise ValueError('src/canim/__init__.py: no line __version__ = "…"')
    addresses = settings["tool"]["canim"]
    for name in ("site", "repository"):
        if addresses[name] and not re.fullmatch(r"https?://[^\s/]\S*", addresses[name]):
            raise ValueError(f"pyproject.toml: {name} must be an address, not {addresses[name]!r}")
    return Release(addresses["site"], version[1], addresses["repository"])


def pages(root: Path) -> list[Page]:
    """Return all pages of the project in `root`, in the order of their tasks."""
    return [read(path) for path in sorted((root / "gallery").glob("*/task_*.py"), key=number)]


def number(path: Path) -> list[int]:
    """Return the numbers in the name of a page: Task 1.10 comes after Task 1.9."""
    return [int(digits) for digits in re.findall(r"\d+", path.name)]


def read(path: Path) -> Page:
    """Return the page in the script `path`; a part that is missing is a ValueError."""
    head, *blocks = re.split(r"^# %%.*\n", path.read_text(encoding="utf-8"), flags=re.M)
    tree = ast.parse(head)
    doc = ast.get_docstring(tree)
    if not doc:
        raise ValueError(f"{path}: a page begins with a docstring")
    title = re.search(r"^(.+)\n=+$", doc, re.M)
    if not title:
        raise ValueError(f"{path}: the docstring has no title underlined with =")
    setup = "\n".join(head.splitlines()[tree.body[0].end_lineno :]).strip("\n")
    page = Page(path, title[1], doc[title.end() :].strip(), setup)
    section: list[Block] = []
    for block in blocks:
        comment, code = re.match(r"((?:#.*\n)*)([\s\S]*)", block).groups()
        text = re.sub(r"^# ?", "", comment, flags=re.M)
        # A block may hold more than one section ("Think about it" and "Read more").
        parts = re.split(r"^(.+)\n-{3,}\n", text, flags=re.M)
        if parts[0].strip() or len(parts) == 1:
            section.append(Block(parts[0].strip(), ""))
        for name, body in zip(parts[1::2], parts[2::2], strict=True):
            section = page.sections.setdefault(name, [])
            section.append(Block(body.strip(), ""))
        section[-1].code = code.strip("\n")
    if tuple(page.sections) != SECTIONS:
        raise ValueError(
            f"{path}: the sections are {', '.join(page.sections)}; "
            f"expected, in this order, {', '.join(SECTIONS)}"
        )
    return page


def script(page: Page, of: Release) -> str:
    """Return the starter of `page` as the text of a program."""
    head = [page.title, "Write what is marked TODO, run this file, read the report, go on."]
    if of.site:
        head.append(f"Page: {of.site.rstrip('/')}/{page.address}")
    questions = [
        textwrap.fill(
            f"{number}. {plain(text)}", LINE, initial_indent="# ", subsequent_indent="#    "
        )
        for number, text in enumerate(page.questions, 1)
    ]
    parts = [
        "\n".join(f"# {line}" for line in head),
        f"import sys\nfrom importlib.util import find_spec\n\n{_guard(of, 'sys.exit')}",
        clean(page.setup),
        *(
            f"\n{clean(block.code)}"
            for name in GIVEN
            for block in page.sections[name]
            if block.code
        ),
        "\n".join(["# Write your answers between the quotes.", *questions, _answers(page)]),
        "plt.show()",
    ]
    return re.sub(r"\n{4,}", "\n\n\n", "\n\n".join(parts)) + "\n"


def notebook(page: Page, of: Release) -> str:
    """Return the starter of `page` as the text of a Jupyter notebook."""
    page_line = f"\n\n{of.site.rstrip('/')}/{page.address}" if of.site else ""
    cells = [
        ("markdown", f"# {page.title}\n\n{markdown(page.intro)}{page_line}"),
        ("code", _install(of)),
        ("code", clean(page.setup)),
    ]
    for name in GIVEN:
        heading = f"## {name}\n\n"
        for block in page.sections[name]:
            cells.append(("markdown", heading + markdown(block.text)))
            heading = ""
            code = clean(block.code)
            if code:
                # The last line of a cell would be echoed below it.
                cells.append(("code", f"{code}\nplt.show()" if name == "Check and draw" else code))
    numbered = "\n".join(f"{i}. {markdown(q)}" for i, q in enumerate(page.questions, 1))
    cells.append(("markdown", f"## Think about it\n\nWrite your answers below.\n\n{numbered}"))
    cells.append(("code", _answers(page)))
    content = {
        "cells": [_cell(kind, text.strip(), i) for i, (kind, text) in enumerate(cells)],
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def clean(code: str) -> str:
    """Return `code` without what is meant for the site: picture texts and linter marks."""
    code = re.sub(r"^# (?:Picture|Film|GIF): .*\n(?:#.*\n)*", "", code, flags=re.M)
    return re.sub(r"  # noqa.*$", "", code, flags=re.M).strip("\n")


def markdown(text: str) -> str:
    """Return the reStructuredText of a page as Markdown; an unknown role is a ValueError."""
    text = re.sub(r":math:`([^`]+)`", r"$\1$", text)
    text = re.sub(r":func:`~?(?:[\w.]*\.)?(\w+)`", r"`\1`", text)
    text = re.sub(r":(?:ref|doc|term):`([^`<]+?)\s*(?:<[^>]+>)?`", r"\1", text)
    text = re.sub(r"``([^`]+)``", r"`\1`", text)
    if role := re.search(r":[\w:]+:`[^`]*`|^\.\. .*", text, re.M):
        raise ValueError(f"a starter cannot show {role[0]!r}")
    return text


def plain(text: str) -> str:
    """Return the reStructuredText of a question as plain text."""
    text = re.sub(r"\$([^$]+)\$", lambda m: m[1].replace("\\,", " "), markdown(text))
    if "\\" in text:
        raise ValueError(f"a question must be readable without formulas: {text!r}")
    # Stars are emphasis, but a product or a power within code.
    return "".join(
        span if i % 2 else span.replace("*", "") for i, span in enumerate(text.split("`"))
    )


def _guard(of: Release, leave: str) -> str:
    lines = textwrap.wrap(of.install, LINE - 8, drop_whitespace=False, break_long_words=False)
    sentence = "\n".join(f'        "{line}"' for line in lines)
    return f'if find_spec("canim") is None:\n    {leave}(\n{sentence}\n    )'


def _install(of: Release) -> str:
    wheel = f"{of.site.rstrip('/')}/wheels/{of.wheel}" if of.site else of.wheel
    first = "# Installs canim where it is missing."
    if not of.site:
        first += f"\n# Before: download {of.wheel} from the page into this folder."
    return (
        f"{first}\nfrom importlib.util import find_spec\n\n"
        f'if find_spec("canim") is None:\n    %pip install --quiet {wheel}'
    )


def _answers(page: Page) -> str:
    return "answers = {" + ", ".join(f'{i}: ""' for i in range(1, len(page.questions) + 1)) + "}"


def _cell(kind: str, text: str, number: int) -> dict[str, object]:
    cell: dict[str, object] = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}}
    if kind == "code":
        cell |= {"execution_count": None, "outputs": []}
    return cell | {"source": text.splitlines(keepends=True)}
