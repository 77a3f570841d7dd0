"""Fill the starters with the model solutions, and pack them into a zip for teachers.

A model solution is a module with the functions and data of "Your task"; each takes the
place of what has the same name in the starter. What it has beside them (imports, a
function of its own) goes in front of the first.
"""

from __future__ import annotations

import ast
import sys
import zipfile
from pathlib import Path

import starter

FIRST_DAY = (1980, 1, 1, 0, 0, 0)  # zip files hold a time; a fixed one gives the same bytes


def complete(program: str, solution: str) -> str:
    """Return the starter `program` with the definitions of `solution` put in.

    Raises
    ------
    ValueError
        If the solution replaces nothing in the starter.
    """
    given = {name: node for node in ast.parse(program).body for name in _names(node)}
    written = [(node, _names(node)) for node in ast.parse(solution).body]
    new = [node for node, names in written if names and not given.keys() & names]
    lines = program.splitlines()
    spans = []
    for node, names in written:
        old = next((given[name] for name in names if name in given), None)
        if old is not None:
            spans.append((old.lineno - 1, old.end_lineno or old.lineno, _source(solution, node)))
    if not spans:
        raise ValueError("the solution replaces nothing in the starter")
    spans.sort()
    start, end, text = spans[0]
    spans[0] = (start, end, "\n\n\n".join([*(_source(solution, n) for n in new), text]))
    for start, end, text in reversed(spans):
        lines[start:end] = text.splitlines()
    return "\n".join(lines) + "\n"


def _names(node: ast.stmt) -> set[str]:
    """Return the names that a top-level statement defines; imports define none here."""
    if isinstance(node, ast.FunctionDef):
        return {node.name}
    if isinstance(node, ast.Assign):
        return {n.id for t in node.targets for n in ast.walk(t) if isinstance(n, ast.Name)}
    return set()


def _source(text: str, node: ast.stmt) -> str:
    return "\n".join(text.splitlines()[node.lineno - 1 : node.end_lineno])


def completed(root: Path) -> dict[str, str]:
    """Return file name and text of every completed starter of the project in `root`."""
    of = starter.release(root)
    folder = root / "tests/gallery/solutions"
    return {
        f"{page.name}.py": complete(
            starter.script(page, of), (folder / f"{page.name}.py").read_text(encoding="utf-8")
        )
        for page in starter.pages(root)
    }


def pack(files: dict[str, str | bytes], target: Path) -> None:
    """Write `files` (name and content) into the zip `target`, the same bytes each time."""
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, FIRST_DAY)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[name])


if __name__ == "__main__":
    root = Path(__file__).parents[2]
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else root / "build/canim-solutions.zip"
    programs = completed(root)
    answers = (root / "tests/gallery/solutions/answers.md").read_text(encoding="utf-8")
    pack({**programs, "answers.md": answers}, target)
    print(f"{len(programs)} completed starters and the answers: {target}")
