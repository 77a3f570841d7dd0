"""What uses what, read from the code: `.. architecture::` and `.. modules:: folder`."""

from __future__ import annotations

import ast
import itertools
from html import escape
from pathlib import Path

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src/canim"
OUTSIDE = "gallery"  # the pages, and with them the starters
LETTER, HEIGHT, GAP, ROW = 8, 30, 16, 74


def uses(path: Path, parts: set[str]) -> set[str]:
    """Return the parts of canim that the file imports, or names behind `canim.`."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.Import(names):
                found |= {name.name for name in names}
            case ast.ImportFrom(module="canim", names=names):
                found |= {f"canim.{name.name}" for name in names}
            case ast.ImportFrom(module=str(module)):
                found.add(module)
            case ast.Attribute(value=ast.Name("canim"), attr=name):
                found.add(f"canim.{name}")
    found = {"checks" if name == "canim.check" else name.partition(".")[2] for name in found
             if name.startswith("canim.")}  # fmt: skip
    return {name.partition(".")[0] for name in found} & parts


def graph(package: Path = PACKAGE, gallery: Path = ROOT / "gallery") -> dict[str, set[str]]:
    """Return, for each part of the package and for the pages, the parts that it uses."""
    files: dict[str, list[Path]] = {}
    for path in sorted(package.rglob("*.py")):
        part = path.relative_to(package).parts[0].removesuffix(".py")
        if part not in ("__init__", "__main__", "starters"):
            files.setdefault(part, []).append(path)
    parts = set(files)
    files[OUTSIDE] = sorted(gallery.rglob("*.py"))
    return {
        part: set().union(*(uses(path, parts) for path in paths)) - {part}
        for part, paths in sorted(files.items())
    }


def without_detours(graph: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return the graph without the arrows that follow from others."""

    def reached(part: str) -> set[str]:
        return graph[part].union(*map(reached, graph[part]))

    return {
        part: used - set().union(*(reached(other) for other in used))
        for part, used in graph.items()
    }


def rows(graph: dict[str, set[str]]) -> list[list[str]]:
    """Return the parts in rows, so that every arrow points down."""
    level = dict.fromkeys(graph, 0)
    for _ in graph:
        for part, used in graph.items():
            for other in used:
                level[other] = max(level[other], level[part] + 1)
    ordered: list[list[str]] = []
    for depth, members in itertools.groupby(sorted(graph, key=level.__getitem__), level.get):
        above = ordered[depth - 1] if depth else []

        def place(part: str, above: list[str] = above) -> tuple[float, str]:
            users = [above.index(user) for user in above if part in graph[user]]
            return sum(users) / len(users) if users else 0, part

        ordered.append(sorted(members, key=place))
    return ordered


def drawing(graph: dict[str, set[str]]) -> str:
    """Return an SVG of the graph; its colours are those of the text around it."""
    graph = without_detours(graph)
    levels = rows(graph)
    width = {part: LETTER * len(part) + 16 for part in graph}
    lengths = [sum(width[p] for p in row) + GAP * (len(row) - 1) for row in levels]
    whole = max(lengths) + 4
    boxes, middle = [], {}
    for depth, (row, length) in enumerate(zip(levels, lengths, strict=True)):
        x, y = (whole - length) / 2, 2 + depth * ROW
        for part in row:
            middle[part] = x + width[part] / 2, y
            boxes.append(
                f'<rect x="{x:g}" y="{y}" width="{width[part]}" height="{HEIGHT}" rx="6"/>'
                f'<text x="{x + width[part] / 2:g}" y="{y + 20}">{escape(part)}</text>'
            )
            x += width[part] + GAP
    arrows = [
        f'<path d="M{middle[part][0]:g} {middle[part][1] + HEIGHT}'
        f'L{middle[other][0]:g} {middle[other][1] - 3}" marker-end="url(#arrow)"/>'
        for part in graph
        for other in sorted(graph[part])
    ]
    height = 2 * 2 + (len(levels) - 1) * ROW + HEIGHT
    said = "; ".join(f"{part} uses {_listed(used)}" for part, used in graph.items() if used)
    return (
        f'<figure class="architecture"><svg viewBox="0 0 {whole:g} {height}" role="img" '
        f'aria-label="The parts of canim and what they use: {escape(said)}.">'
        '<defs><marker id="arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" '
        'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z"/></marker></defs>'
        f"{''.join(arrows)}{''.join(boxes)}</svg></figure>"
    )


def _listed(parts: set[str]) -> str:
    *most, last = sorted(parts)
    return f"{', '.join(most)} and {last}" if most else last


def _first_sentence(path: Path) -> str:
    said = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return " ".join(said.partition("\n\n")[0].split())


class Architecture(SphinxDirective):
    """The drawing of canim's parts."""

    def run(self):
        for path in [*PACKAGE.rglob("*.py"), *(ROOT / "gallery").rglob("*.py")]:
            self.env.note_dependency(str(path))
        return [nodes.raw("", drawing(graph()), format="html")]


class Modules(SphinxDirective):
    """A list of the modules in a folder, each with the first sentence of its docstring."""

    required_arguments = 1

    def run(self):
        listed = nodes.definition_list()
        folder = ROOT / self.arguments[0]
        for file in sorted([*folder.glob("*.py"), *folder.glob("*/__init__.py")]):
            name = file.parent.name if file.stem == "__init__" else file.stem
            if name.startswith("__") or name == folder.name:
                continue
            self.env.note_dependency(str(file))
            said, _ = self.parse_inline(_first_sentence(file), lineno=self.lineno)
            term = nodes.term("", "", nodes.literal("", name))
            listed += nodes.definition_list_item(
                "", term, nodes.definition("", nodes.paragraph("", "", *said))
            )
        return [listed]


def setup(app):
    app.add_directive("architecture", Architecture)
    app.add_directive("modules", Modules)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
