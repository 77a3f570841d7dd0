"""Account for everything that was handed in: each file below a folder, also in zips."""

from __future__ import annotations

import lzma
import os
import re
import stat
import struct
import zlib
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO
from zipfile import BadZipFile, ZipFile, ZipInfo

from canim.checks import beside, reading

# Of one zip and all zips in it, unpacked. What was handed in as one zip holds a whole class.
MOST = 1_000_000_000  # in bytes
MOST_FILES = 20_000
LARGEST = 200_000_000
DEEPEST_ZIP = 3
DEEPEST_FOLDER = 50
EMPTY = "holds no file."
ONLY_LITTER = "holds nothing but files of the system."
# What systems and programs write for themselves, wherever somebody works.
_LITTER = re.compile(
    r"\.DS_Store|\._.*|\.localized|Icon\r|Thumbs\.db|desktop\.ini|\.directory|"
    r"\.git(?:|ignore|attributes|keep)|__MACOSX|__pycache__|\.ipynb_checkpoints|node_modules|"
    r"site-packages|\.idea|\.vscode|\.venv|\.(?:pytest|mypy|ruff)_cache|"
    r"\$RECYCLE\.BIN|System Volume Information|@eaDir",
    re.IGNORECASE,
)
_BROKEN = (
    # What zipfile raises where the bytes of a zip are not as they must be.
    *(BadZipFile, EOFError, ValueError, NotImplementedError, OverflowError),
    *(RuntimeError, struct.error, zlib.error, lzma.LZMAError),
)
_NOT_IN_NAMES = dict.fromkeys(map(ord, '<>:"|?*' if os.name == "nt" else ""), "_")


@dataclass(frozen=True)
class Found:
    """A file or folder that was handed in; `name` is seen from the whole, which is "" itself.

    Without a `reason` it is a program to be checked. `harmless` are files such as pictures,
    which belong to a program that lies beside them; `litter` is nobody's work.
    """

    name: str
    path: Path
    reason: str = ""
    harmless: bool = False
    litter: bool = False


@dataclass
class Room:
    """What may still be unpacked."""

    bytes: int
    files: int


class _Refused(Exception):
    """Something in a zip is not unpacked; the message says why."""


def is_zip(path: Path) -> bool:
    """Tell whether this is a zip by its name."""
    return path.suffix.lower() == ".zip" and os.path.isfile(path)


def find(root: Path, unpacked: Path) -> Iterator[Found]:
    """Yield everything below a folder or in a zip, in order; zips are unpacked into `unpacked`."""
    search = _Search(root.resolve(), unpacked)
    if is_zip(root):
        yield from search.zip(root, "", 0, search.left)
    else:
        yield from search.folder(root, "", 0, None)


class _Search:
    def __init__(self, root: Path, unpacked: Path) -> None:
        self._root = root
        self._unpacked = unpacked
        self._zips = 0
        self.left = Room(4 * MOST, 5 * MOST_FILES)

    def folder(self, place: Path, name: str, zips: int, room: Room | None) -> Iterator[Found]:
        """Yield what is in a folder, which lies in so many zips, or that it is empty."""
        try:
            names = sorted(os.listdir(place))
        except OSError as error:
            yield Found(name, place, f"cannot be opened: {error.strerror}.")
            return
        if name.count("/") > DEEPEST_FOLDER:
            yield Found(name, place, f"lies in more than {DEEPEST_FOLDER} folders.")
            return
        nothing = True
        for entry in names:
            for found in self._entry(place / entry, _join(name, entry), zips, room):
                nothing = nothing and found.litter
                yield found
        # Whoever handed in nothing but an environment is named, unless it is called one.
        if nothing and not ("pyvenv.cfg" in names and place.name in ("env", "venv")):
            yield Found(name, place, ONLY_LITTER if names else EMPTY)

    def _entry(self, path: Path, name: str, zips: int, room: Room | None) -> Iterator[Found]:
        own = beside.is_of_environment(path)
        if not own and path.is_symlink() and (reason := self._of_link(path)):
            yield Found(name, path, reason)
        elif own or _LITTER.fullmatch(path.name):
            yield from [Found(path.name, path, litter=True)] * max(1, _count(path))
        elif path.name.startswith("."):
            what = f"folder of {numbered(_count(path))}" if os.path.isdir(path) else "file"
            reason = f"is a hidden {what}: its name begins with a dot."
            yield Found(name, path, reason, harmless=os.path.isfile(path))
        elif os.path.isdir(path):
            yield from self.folder(path, name, zips, room)
        elif not os.path.isfile(path):
            # Reading from a pipe or a device may never end.
            yield Found(name, path, "is a pipe or a device, or may not be read.")
        elif is_zip(path):
            yield from self.zip(path, name, zips, room) if room else self._outermost(path, name)
        else:
            yield _file(path, name)

    def _of_link(self, path: Path) -> str:
        """Return why a link is not followed, or ""."""
        try:
            target = path.resolve(strict=True)
        except (OSError, RuntimeError):
            return "is a link that leads nowhere."
        if not target.is_relative_to(self._root):
            return "is a link that leads out of the folder: hand in the file itself."
        return "is a link to a folder: what is there is checked there." if target.is_dir() else ""

    def _outermost(self, path: Path, name: str) -> Iterator[Found]:
        """Yield what is in a zip; all such zips together get the room of one of a class."""
        files, size = min(MOST_FILES, self.left.files), min(MOST, self.left.bytes)
        room = Room(size, files)
        yield from self.zip(path, name, 0, room)
        self.left.files -= files - room.files
        self.left.bytes -= size - room.bytes

    def zip(self, path: Path, name: str, zips: int, room: Room) -> Iterator[Found]:
        """Yield what is in a zip, which itself lies in so many zips."""
        if zips == DEEPEST_ZIP:
            yield Found(name, path, f"lies in {DEEPEST_ZIP} zips, one in another: unpack them.")
            return
        self._zips += 1
        target = self._unpacked / str(self._zips)
        target.mkdir()
        refused = []
        try:
            for inner, reason in _unpack(path, target, room):
                refused.append(inner)
                yield Found(_join(name, inner), path, reason)
        except _Refused as problem:
            yield Found(name, path, str(problem))
            return
        # A folder of which nothing could be unpacked is not empty.
        known = {path for inner in refused for path in (target / inner).parents}
        for found in self.folder(target, name, zips + 1, room):
            if found.reason != EMPTY or found.path not in known:
                yield found


def _join(folder: str, name: str) -> str:
    return f"{folder}/{name}" if folder else name


def numbered(files: int) -> str:
    """Return a number of files in words."""
    return f"{files} file{'s' * (files != 1)}"


def _count(path: Path) -> int:
    """Return the number of files in a folder, or 1 for a file."""
    if path.is_symlink() or not os.path.isdir(path):
        return 1
    return sum(len(names) for _, _, names in os.walk(path))


def _file(path: Path, name: str) -> Found:
    if path.stat().st_size == 0:
        package = path.name == "__init__.py"
        return Found(name, path, "is empty.", harmless=package)
    if reading.kind(path):
        return Found(name, path)
    return Found(name, path, reading.why_not(path), harmless=not reading.hides_programs(path))


def _unpack(path: Path, target: Path, room: Room) -> Iterator[tuple[str, str]]:
    """Unpack a zip; yield the names of what is not unpacked, and why."""
    try:
        packed = ZipFile(path)
    except (OSError, *_BROKEN):
        raise _Refused("cannot be read as a zip: ask for it again.") from None
    with packed:
        entries = packed.infolist()
        if len(entries) > room.files:
            raise _Refused(f"holds more than {room.files} files: unpack it yourself.")
        room.files -= len(entries)
        taken: set[str] = set()
        for entry in entries:
            name = _name_of(entry)
            try:
                _unpack_one(packed, entry, _place(target, name, taken), room)
            except _Refused as problem:
                yield name, str(problem)


def _unpack_one(packed: ZipFile, entry: ZipInfo, place: Path, room: Room) -> None:
    if stat.S_ISLNK(entry.external_attr >> 16):
        raise _Refused("is a link: hand in the file itself.")
    if entry.flag_bits & 1:
        raise _Refused("is locked with a password.")
    try:
        (place if entry.is_dir() else place.parent).mkdir(parents=True, exist_ok=True)
        if entry.is_dir():
            return
        unpacked = place.open("xb")
    except OSError as error:
        raise _Refused(f"cannot be unpacked: {error.strerror}.") from None
    with unpacked:
        problem = _problem_of_copy(packed, entry, unpacked, room)
    if problem:
        place.unlink()  # half a file would be checked as if it were whole
        raise _Refused(problem)


def _problem_of_copy(packed: ZipFile, entry: ZipInfo, target: IO[bytes], room: Room) -> str:
    """Copy an entry as far as there is room for it; return why not all of it came, or ""."""
    most = min(LARGEST, room.bytes)
    size = 0  # counted, since what a zip says of its sizes may be a lie
    try:
        with packed.open(entry) as source:
            while size <= most and (part := source.read(2**16)):
                size += len(part)
                target.write(part)
    except (OSError, *_BROKEN) as error:
        full = getattr(error, "strerror", None)
        return f"cannot be unpacked: {full}." if full else "is damaged: ask for it again."
    room.bytes -= min(size, most)
    return "" if size <= most else "is too large: unpack the zip yourself."


def _name_of(entry: ZipInfo) -> str:
    """Return the name of an entry; many programs write UTF-8 without saying so."""
    name = entry.filename
    if not entry.flag_bits & 0x800:
        with suppress(UnicodeError):
            name = name.encode("cp437").decode("utf-8")
    return name.replace("\\", "/")


def _place(target: Path, name: str, taken: set[str]) -> Path:
    """Return where to unpack an entry: below `target`, and where nothing is yet."""
    if name.startswith("/") or re.match(r"[A-Za-z]:/", name) or ".." in name.split("/"):
        raise _Refused("has a name that leads out of the zip.")
    parts = [part.translate(_NOT_IN_NAMES) for part in name.split("/") if part not in ("", ".")]
    if len(parts) > DEEPEST_FOLDER:
        raise _Refused(f"lies in more than {DEEPEST_FOLDER} folders.")
    place = target.joinpath(*parts)
    if name.endswith("/"):
        return place
    # Two names of one file, or names that differ in case: both are kept, on any system.
    stem, number = place.stem, 1
    while reading.plain_name(str(place)) in taken:
        number += 1
        place = place.with_name(f"{stem} ({number}){place.suffix}")
    taken.add(reading.plain_name(str(place)))
    return place
