"""Read what a student handed in: which files are programs, and the texts in them."""

from __future__ import annotations

import ast
import codecs
import io
import json
import re
import stat
import tokenize
import unicodedata
import warnings
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

# What browsers, mail programs and Windows make of such names: task_1_1.py (1).txt.
_PROGRAM = re.compile(r"\.(pyw?|ipynb) ?(?:\(\d+\))? ?(?:\.(?:txt|text|json))?[. ]*", re.IGNORECASE)
# A text may be a program: task_1_1.txt, or "task 1.1", which has no suffix.
_ANY = re.compile(r"(?:\.(?:txt|text|json|python|\d[\d ()]*))?", re.IGNORECASE)
# A longer text under another name is not looked into.
_LONGEST = 1_000_000  # in bytes
_KINDS = {
    ".docx .doc .odt .rtf .pages": "is a text document",
    ".pdf": "is a PDF document",
    ".ppt .pptx .key .odp": "is a slide show",
    ".xls .xlsx .ods .numbers": "is a spreadsheet",
    ".html .htm .mht .mhtml .webarchive": "is a web page",
    ".png .jpg .jpeg .gif .bmp .webp .tif .tiff .heic .svg": "is a picture",
    ".mp4 .mov .avi .webm .mkv": "is a film",
}
# Any of these may hold a program that is lost if nobody looks.
_ARCHIVES = {
    ".rar .7z .tar .gz .tgz .bz2 .tbz2 .xz .txz .zst .z01 .001": (
        "is an archive that is not a zip: unpack it, or pack it as a zip."
    ),
    ".m .mlx .mat": "is a file of MATLAB: hand in a program of Python.",
    ".url .webloc .lnk .gdoc .gslides": "is only a link: hand in the file itself.",
    ".crdownload .part .download": "is a download that did not end: fetch it again.",
}
_OTHERWISE = "is neither a .py nor an .ipynb file."
# How files begin that were given the name of a program but are something else.
_DISGUISES = {
    b"PK\x03\x04": "a zip or a text document",
    b"Rar!": "an archive",
    b"7z\xbc\xaf": "an archive",
    b"%PDF": "a PDF document",
    b"{\\rtf": "a text with fonts (RTF)",
    b"\xd0\xcf\x11\xe0": "a text document",
    b"\x89PNG": "a picture",
    b"<!doctype html": "a web page",
    b"<html": "a web page",
}
_MARKS = {
    codecs.BOM_UTF32_LE: "UTF-32",  # begins with the mark of UTF-16, and so comes before it
    codecs.BOM_UTF32_BE: "UTF-32",
    codecs.BOM_UTF16_LE: "UTF-16",
    codecs.BOM_UTF16_BE: "UTF-16",
}
# The letters beyond a to z of the languages that Windows-1252 was made for.
_ALPHABETS = (
    "äöüß",
    "àâæçéèêëîïôœùûüÿ",
    "áéíñóúü",
    "áâãàçéêíóôõú",
    "àèéìíîòóù",
    "àçèéíïòóúü",
    "åäöæøéü",
    "áéëèêïóöü",
)
_ALONE = set("àâáéèêóôíúåäöæøy")  # words of one letter, as in French "à"
# Where these stand, no other encoding has a letter that would make sense there.
_SIGNS = re.compile(
    r"(?<!\w)(?:„[^„“”]*[“”]|“[^“”]*”|‘[^‘’]*’|«[^«»]*»)(?!\w)"  # quotes in pairs, around words
    r"|(?<=[A-Za-z])’(?=[A-Za-zéêàâèhô ])|(?<= )[–—](?= )|(?<=\d)–(?=\d)"
    r"|(?<=[\w)\] ])[°²³](?![a-z])|[±×·](?=[ \d])|µ(?=[ms]\b)|§(?= ?\d)|(?<=\d)[½€]"
)


class UnusableFile(Exception):
    """The file cannot be checked; the message says why."""


class NoTask(UnusableFile):
    """A program that says nowhere which task it is of."""


def kind(path: Path) -> str:
    """Return ".py" or ".ipynb" where the file is one for certain, or ""."""
    name = path.name.rstrip(". ")
    if (found := _PROGRAM.search(name)) and found.end() == len(name):
        return ".ipynb" if found[1].lower() == "ipynb" else ".py"
    if _ANY.fullmatch(path.suffix):
        return _kind_by_content(path)
    return ""


def task_in(path: Path) -> str:
    """Return the number of the task that the name of a file has in it, or ""."""
    named = re.search(r"task[_ -]?(\d)[_. -](\d+)", path.name, re.IGNORECASE)
    return f"{named[1]}.{named[2]}" if named else ""


def python_name(path: Path) -> str:
    """Return the name of a program or notebook as Python knows such names."""
    suffix = kind(path)
    stem = _PROGRAM.sub("", path.name) if _PROGRAM.search(path.name) else path.stem
    return path.name if path.suffix == suffix else stem + suffix


def _kind_by_content(path: Path) -> str:
    """Tell whether a text of any name calls `canim.check`, as a program or in a notebook."""
    try:
        if not path.is_file() or path.stat().st_size > _LONGEST:
            return ""
        text, _ = read(path)
    except (OSError, UnusableFile):
        return ""
    if not re.search(r"canim\b[\s\S]*\bcheck\b", text):
        return ""
    if is_notebook(text):
        return ".ipynb"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Python gives them when the program is run
        try:
            return ".py" if any(calls(ast.parse(text))) else ""
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return ""


def is_notebook(text: str) -> bool:
    """Tell whether a text is that of a Jupyter notebook, whatever its name is."""
    if not text.lstrip().startswith("{"):
        return False
    try:
        return bool({"cells", "worksheets"} & json.loads(text).keys())
    except (ValueError, RecursionError):
        return False


def calls(*trees: ast.Module) -> Iterator[tuple[int, ast.Call, object]]:
    """Yield which tree has a call of ``canim.check``, the call, and what it has as its task."""
    nodes = [(place, node) for place, tree in enumerate(trees) for node in ast.walk(tree)]
    imported = [
        alias.asname or alias.name
        for _, node in nodes
        if isinstance(node, ast.ImportFrom) and node.module == "canim"
        for alias in node.names
        if alias.name == "check"
    ]
    names = {"check", *imported}
    for place, node in nodes:
        match node:
            case ast.Call(ast.Attribute(ast.Name(), "check")):
                pass
            case ast.Call(ast.Name(name)) if name in names:
                pass
            case _:
                continue
        named = [keyword.value for keyword in node.keywords if keyword.arg == "task"]
        match [*node.args[:1], *named]:
            case [ast.Constant(task), *_]:
                yield place, node, task


def answers(statements: Iterable[ast.stmt]) -> dict[str, str]:
    """Return the last ``answers = {…}`` among these that can be read without running them."""
    found: dict[str, str] = {}
    for statement in statements:
        match statement:
            case ast.Assign([ast.Name("answers")], written):
                with suppress(ValueError, TypeError, MemoryError, RecursionError):
                    read = ast.literal_eval(written)
                    pairs = read.items() if isinstance(read, dict) else ()
                    found = {str(question): str(text) for question, text in pairs}
    return found


def why_not(path: Path) -> str:
    """Return why this file is not checked, as the end of a sentence."""
    suffix = path.suffix.lower()
    for suffixes, words in _ARCHIVES.items():
        if suffix in suffixes.split():
            return words
    for suffixes, words in _KINDS.items():
        if suffix in suffixes.split():
            return f"{words}: only .py and .ipynb files are checked."
    return _OTHERWISE


def hides_programs(path: Path) -> bool:
    """Tell whether a file that is not checked may hold somebody's program."""
    return any(path.suffix.lower() in suffixes.split() for suffixes in _ARCHIVES)


def read(path: Path) -> tuple[str, str]:
    """Return the text of a program or notebook, and a sentence where it is not in UTF-8.

    Raises
    ------
    UnusableFile
        If the file cannot be read, or it is not certain how its letters are written.
    """
    try:
        mode = path.stat().st_mode
        if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
            # Reading from it may never end.
            raise UnusableFile(f"{path} is a pipe or a device: save it as a file first.")
        data = path.read_bytes()
    except FileNotFoundError:
        raise UnusableFile(f"{path} is not there.") from None
    except OSError as error:
        raise UnusableFile(f"{path} cannot be read: {error.strerror}.") from None
    if not data.strip():
        raise UnusableFile(f"{path} is empty.")
    for begins, words in _DISGUISES.items():
        if data[: len(begins)].lower() == begins.lower():
            raise UnusableFile(
                f"{path} is {words} with the name of a program: save the program as plain text."
            )
    text, encoding = decode(data)
    if not encoding:
        raise UnusableFile(
            f"{path} is not a text in UTF-8, and how its letters are written is not certain: "
            "save it as UTF-8."
        )
    # As Python does: whatever ends a line is "\n".
    text = io.StringIO(text, newline=None).read()
    note = f"The file was read as {encoding}. Save it as UTF-8, or Python will not run it."
    return text, "" if encoding == "UTF-8" else note


def decode(data: bytes) -> tuple[str, str]:
    """Return a text and how it is written: "UTF-8", or "" where that is not certain.

    What a program says of itself in its first two lines is believed, as Python does, and
    called UTF-8 too: there is nothing to tell.
    """
    for mark, encoding in _MARKS.items():
        if data.startswith(mark):
            try:
                return data.decode(encoding), encoding
            except UnicodeDecodeError:
                return "", ""
    text, encoding = "", "UTF-8"
    with suppress(SyntaxError, UnicodeError, LookupError):
        text = data.decode(tokenize.detect_encoding(io.BytesIO(data).readline)[0])
    if not text:
        encoding = "UTF-8, and not as its first lines say"
        with suppress(UnicodeError):
            text = data.decode("utf-8")
    if text and "\0" not in text:
        return text, encoding
    for order in ("utf-16-le", "utf-16-be"):
        try:
            wide = data.decode(order)
        except UnicodeDecodeError:
            continue
        if "\0" not in wide and sum(map(str.isascii, wide)) > len(wide) / 2:
            return wide, "UTF-16"
    if text:
        return text, encoding  # with zeros in it: Python says what it thinks of them
    try:
        western = data.decode("cp1252")
    except UnicodeDecodeError:
        return "", ""
    return (western, "Windows-1252") if _is_western(western) else ("", "")


def _is_western(text: str) -> bool:
    """Tell whether text read as Windows-1252 is one language that is written so."""
    rest = _SIGNS.sub(lambda found: re.sub(r"[„“”‘’«»–—°²³±×·µ§½€]", " ", found[0]), text)
    foreign = {c.lower() for c in rest if not c.isascii()}
    if not foreign:
        return True
    if re.search("Ÿ[a-z]", rest):
        return False  # it is "ü" on an old Macintosh
    if not any(foreign <= set(alphabet) for alphabet in _ALPHABETS):
        return False
    words = [w.lower() for w in re.findall(r"[^\W\d_]+", rest) if not w.isascii()]
    mixed = [word for word in words if re.search("[a-z]", word)]
    # Greek or Russian, read as Windows-1252, has words without any such letter.
    return bool(mixed) and all(word in mixed or word in _ALONE for word in words)


def plain_name(name: str) -> str:
    """Return a name as a file system that knows no case compares it."""
    return unicodedata.normalize("NFC", name).casefold()
