"""Read a Jupyter notebook, and write what is IPython's own in its cells as Python.

Lines such as ``%run curves.py`` become calls of ``get_ipython()``, as IPython itself makes
them; `canim.checks.shell` answers them. Nothing is run here.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator
from typing import Any

# Magics whose rest, or whose lines below, are Python that is run as if they were not there.
TIMED = ("time", "timeit", "prun", "memit", "mprun", "lprun", "pyinstrument", "snakeviz")
PYTHON_CELLS = (*TIMED, "capture", "debug")
# In a cell of one line, IPython takes these words for magics.
_AUTOMATIC = re.compile(
    r"(?:pip|conda|ls|cd|pwd|cat|mkdir|run|whos?|matplotlib|pylab|load_ext|clear)"
    r"(?:\s+[\w~./{$-]|\s*$)"
)
# Text in quotes, a comment, a bracket, an end of a line that does or does not count.
_TOKEN = re.compile(
    r"""(?P<text>'{3}(?:\\.|[^\\])*?(?:'{3}|\Z)|"{3}(?:\\.|[^\\])*?(?:"{3}|\Z)
        |'(?:\\.|[^\\'\n])*'?|"(?:\\.|[^\\"\n])*"?)
    |(?P<comment>\#[^\n]*)|(?P<open>[(\[{])|(?P<close>[)\]}])
    |(?P<joined>\\\n)|(?P<end>\n)|(?P<blank>[ \t]+)|(?P<other>.)""",
    re.S | re.X,
)
_ASSIGNED = re.compile(r"([^=#(!\n]*[^=#(!\n<>+*/%&|^@:-])=\s*([%!].*)", re.S)
_MAGIC = re.compile(r"%+([\w!.]+)\s*(.*)", re.S)
# Nodes of a tree that have a place in the text.
_PLACED = (ast.stmt, ast.expr, ast.excepthandler, ast.arg, ast.keyword, ast.alias, ast.pattern)
# Options of %timeit and %prun that may stand before the statement.
_OPTIONS = r"(?:-(?:-\S+|[fnrpsTDl]\s*\S+|[a-z]+)(?:\s+|$))*"
# A line, and the next ones where it ends in a backslash.
_COMMAND = r"(?:\\\n|[^\n])*"


class NoNotebook(Exception):
    """The text is no notebook of Python; the message is the end of a sentence on it."""


def cells(text: str) -> list[str]:
    """Return the code cells of a notebook, of any version of its format."""
    try:
        read = json.loads(text)
        language = _language(read["metadata"]) if "metadata" in read else "python"
        # Up to version 3 of the format, cells lay in worksheets, and their text was "input".
        sheets = [read] if "cells" in read else read["worksheets"]
        found = [cell for sheet in sheets for cell in sheet["cells"]]
        codes = [_source(cell) for cell in found if cell["cell_type"] == "code"]
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError, MemoryError):
        raise NoNotebook("is not a Jupyter notebook.") from None
    if not language.lower().startswith(("python", "ipython")):
        raise NoNotebook(f"is a notebook in {language}, not in Python.")
    return codes


def _language(metadata: Any) -> str:
    kernel, info = (metadata.get(key) or {} for key in ("kernelspec", "language_info"))
    return str(info.get("name") or kernel.get("language") or "python")


def _source(cell: Any) -> str:
    """Return a cell's text, which is one text or a list of lines."""
    text = "".join(cell["source"] if "source" in cell else cell["input"])
    # An editor may say that a cell is in another language.
    other = ((cell.get("metadata") or {}).get("vscode") or {}).get("languageId", "python")
    text = text.replace("\r\n", "\n")
    return text if other == "python" else f"%%{other}\n{text}"


def parsed(code: str, name: str) -> ast.Module:
    """Return a cell as a tree; what is IPython's own in it calls ``get_ipython()``.

    Where a line was written anew, its whole is the place of what stands there: a message
    shows the line as it is in the cell.

    Raises
    ------
    SyntaxError
        If the cell is no Python; the error shows the line as it is in the cell.
    """
    before, after = code.split("\n"), translated(code).split("\n")
    changed = {i for i, lines in enumerate(zip(before, after), 1) if lines[0] != lines[1]}
    try:
        tree: ast.Module = compile(
            "\n".join(after),
            name,
            "exec",
            ast.PyCF_ONLY_AST | ast.PyCF_ALLOW_TOP_LEVEL_AWAIT,
            dont_inherit=True,
        )
    except SyntaxError as error:
        if error.lineno in changed:
            error.text, error.offset, error.end_offset = before[error.lineno - 1], 1, 0
        raise
    except (RecursionError, MemoryError, ValueError) as error:
        words = f"this cell is nested too deep, or is no text: {error}"
        raise SyntaxError(words, (name, 1, 1, before[0])) from None
    placed = [node for node in ast.walk(tree) if isinstance(node, _PLACED)]
    for node in placed:
        if node.lineno in changed:
            line = before[node.lineno - 1].encode()
            node.col_offset = len(line) - len(line.lstrip())
        if node.end_lineno in changed:
            end = len(before[node.end_lineno - 1].encode())
            node.end_col_offset = max(end, node.col_offset)
    return tree


def translated(code: str) -> str:
    """Return a cell as Python, with every line in its place."""
    code = _without_prompts(code)
    head, first, rest = _first_line(code)
    if first.startswith("%%") and (magic := _MAGIC.fullmatch(first.strip())):
        name, line = magic.groups()
        if name not in PYTHON_CELLS:
            lines = "\n" * rest.count("\n")
            return f"{head}{_call('run_cell_magic', name, line, rest[1:])}{lines}"
        if name == "capture":
            variable = _match(r"\w+", line, len(_match(_OPTIONS, line, 0)))
            start = f"{variable} = {_call('captured')}" if variable else "pass"
        else:
            start = _command(first)
        return f"{head}{start}\n{translated(rest[1:])}" if rest else f"{head}{start}"
    if not rest.strip() and _AUTOMATIC.match(first):
        return f"{head}{_command('%' + first)}{rest}"
    return "".join(_statements(code))


def _first_line(code: str) -> tuple[str, str, str]:
    """Return the empty lines, the first that is not empty, and what comes after it."""
    start = len(code) - len(code.lstrip())
    end = code.find("\n", start) % (len(code) + 1)
    return code[:start], code[start:end], code[end:]


def _without_prompts(code: str) -> str:
    """Return the cell without what was copied along, and as far left as its first line."""
    head, first, _ = _first_line(code)
    if re.match(r">>> |In \[\d+\]: ", first):
        code = re.sub(r"^[ \t]*(?:>>>|\.\.\.|In \[\d+\]:|\.{3,}:)(?: |$)", "", code, flags=re.M)
    indent = head.rpartition("\n")[2]
    return re.sub(rf"^{indent}", "", code, flags=re.M) if indent else code


def _statements(code: str) -> Iterator[str]:
    """Yield the logical lines of a cell as Python."""
    place = 0
    while place < len(code):
        indent = _match(r"[ \t]*", code, place)
        start = place + len(indent)
        end, asks = _end_of_statement(code, start)
        assigned = _ASSIGNED.match(code, start)
        if code.startswith(("%", "!", "?"), start):
            line = _match(_COMMAND, code, start)
            new = indent + _command(_joined(line))
        elif assigned:
            line = _match(_COMMAND, code, start)
            command = _match(_COMMAND, code, assigned.start(2))
            new = f"{indent}{assigned[1]}= {_value(_joined(command))}"
        else:
            line = code[start:end]
            new = f"{indent}pass" if asks else indent + line
        place = start + len(line)
        yield new + "\n" * (line.count("\n") - new.count("\n"))


def _match(pattern: str, code: str, place: int) -> str:
    """Return what fits the pattern there, and may be empty."""
    found = re.compile(pattern).match(code, place)
    return found[0] if found else ""


def _joined(command: str) -> str:
    return command.replace("\\\n", " ").strip()


def _end_of_statement(code: str, place: int) -> tuple[int, bool]:
    """Return where a logical line of Python ends, and whether it asks for help with a ?."""
    depth, last = 0, ""
    for token in _TOKEN.finditer(code, place):
        kind = token.lastgroup
        if kind == "end" and not depth:
            return token.end(), last == "?"
        if kind == "open":
            depth += 1
        elif kind == "close":
            depth = max(0, depth - 1)
        if kind not in ("blank", "end"):
            last = token[0]
    return len(code), last == "?"


def _command(text: str) -> str:
    """Return a statement for a line of IPython's."""
    if text.startswith("!"):
        return _call("system", text.lstrip("!"))
    magic = _MAGIC.fullmatch(text)
    if not magic:
        return "pass"  # it asks for help
    name, line = magic.groups()
    if name not in TIMED:
        return _call("run_line_magic", name, line)
    return "".join(_statements(line[len(_match(_OPTIONS, line, 0)) :])) or "pass"


def _value(text: str) -> str:
    """Return an expression for what is assigned: what a command says, or what a magic returns."""
    if text.startswith("!"):
        return _call("getoutput", text.lstrip("!"))
    magic = _MAGIC.fullmatch(text)
    if magic and magic[1] == "time":
        return magic[2]
    return _call("run_line_magic", *magic.groups()) if magic else text


def _call(name: str, *texts: str) -> str:
    return f"get_ipython().{name}({', '.join(map(repr, texts))})"
