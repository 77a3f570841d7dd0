"""A class loses nobody: every file and folder is accounted for, also in zips."""

import csv
import io
import json
import os
import re
import stat
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZIP_LZMA, ZipFile, ZipInfo

import hypothesis.strategies as st
import pytest
from hypothesis import given

from canim.checks import folder, handins
from canim.cli import main

NAME = "task_1_1_plot_hermite_basis.py"
RIGHT = """
import canim
from canim.interpolation import hermite_basis
canim.check("1.1", hermite_basis=hermite_basis)
answers = {1: "größer"}
"""
NOTEBOOK = json.dumps({"cells": [{"cell_type": "code", "source": RIGHT}]})
# Of each student: the file, what is in it, and what is said of it.
DONE = "Task 1.1, 4 of 4 parts done"
CLASS = {
    "right": (NAME, RIGHT, DONE),
    "notebook": ("task_1_1.ipynb", NOTEBOOK, DONE),
    "capitals": (NAME.upper(), RIGHT, DONE),
    "capital notebook": ("TASK_1_1.IPYNB", NOTEBOOK, DONE),
    "hidden suffix": (f"{NAME}.txt", RIGHT, DONE),
    "twice fetched": ("task_1_1.py (1).txt", RIGHT, DONE),
    "fetched again": ("task_1_1 (1).py", RIGHT, DONE),
    "notebook as text": ("task_1_1.ipynb.txt", NOTEBOOK, DONE),
    "notebook as json": ("task_1_1.ipynb.json", NOTEBOOK, DONE),
    "notebook as program": (NAME, NOTEBOOK, DONE),
    "text": ("task_1_1.txt", RIGHT, DONE),
    "no suffix": ("task_1_1", RIGHT, DONE),
    "json": ("task_1_1.json", NOTEBOOK, DONE),
    "window": ("task_1_1.pyw", RIGHT, DONE),
    "number": ("task 1.1", RIGHT, DONE),
    "western": (NAME, RIGHT.encode("cp1252"), DONE),
    "wide": (NAME, RIGHT.encode("utf-16"), DONE),
    "says it": (NAME, f"# coding: cp1252\n{RIGHT}".encode("cp1252"), DONE),
    "russian": (NAME, f"# решение\n{RIGHT}".encode("cp1251", "ignore"), "is not a text in UTF-8"),
    "word": ("report.docx", b"PK\3\4", "is a text document: only .py and .ipynb"),
    "word program": (f"{NAME}.docx", b"PK\3\4", "is a text document"),
    "word renamed": (NAME, b"PK\3\4", "is a zip or a text document with the name of a program"),
    "pdf": ("task_1_1.pdf", b"%PDF", "is a PDF document"),
    "rich": (NAME, b"{\\rtf1 import canim}", "is a text with fonts (RTF) with the name"),
    "page": (NAME, "<!DOCTYPE html>", "is a web page with the name of a program"),
    "rar": ("handin.rar", b"Rar!", "is an archive that is not a zip: unpack it"),
    "seven": ("handin.7z", b"7z", "is an archive that is not a zip"),
    "matlab": ("task_1_1.m", "f = @(t) t", "is a file of MATLAB: hand in a program of Python"),
    "shortcut": ("task_1_1.lnk", b"L", "is only a link: hand in the file itself"),
    "picture": ("screen.PNG", b"\x89PNG", "is a picture: only .py and .ipynb files"),
    "notes": ("notes.txt", "canim did not check", "is neither a .py nor an .ipynb file"),
    "broken text": ("notes.txt", "canim.check( broken", "is neither a .py nor an .ipynb file"),
    "list": ("notes.json", '{"a": "canim check"', "is neither a .py nor an .ipynb file"),
    "nothing": (NAME, "", "is empty."),
    "blank": (NAME, " \n", "is empty."),
    "hidden": (f".{NAME}", RIGHT, "is a hidden file: its name begins with a dot"),
    "unfinished": (f"{NAME}.crdownload", "x", "is a download that did not end"),
    "broken": ("handin.zip", b"PK\3\4", "cannot be read as a zip: ask for it again"),
    "not a zip": ("handin.ZIP", b"Rar!", "cannot be read as a zip"),
    "none": ("other.py", "x = 1", "is not a task of the course"),
}


def packed(*entries, method=ZIP_DEFLATED):
    """Return a zip with these names and contents."""
    data = io.BytesIO()
    with ZipFile(data, "w", method) as file, pytest.MonkeyPatch.context() as patch:
        patch.setattr("warnings.warn", lambda *args, **options: None)  # of names that are twice
        for name, content in entries:
            entry = name if isinstance(name, ZipInfo) else ZipInfo(name)
            entry.filename = entry.filename or "x"
            file.writestr(entry, content, method)
    return data.getvalue()


def write(place, files):
    for name, content in files.items():
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        data = content if isinstance(content, bytes) else content.encode()
        (place / name).write_bytes(data)
    return place


def find(root):
    with tempfile.TemporaryDirectory() as unpacked:
        return list(handins.find(root, Path(unpacked)))


def told(root):
    return {found.name: found.reason for found in find(root) if not found.litter}


@pytest.fixture
def everybody(tmp_path):
    """The class of which ten in fifty were in no output."""
    place = tmp_path / "class"
    write(place, {f"{who}/{name}": content for who, (name, content, _) in CLASS.items()})
    (place / "empty").mkdir()
    write(place, {"only system/.DS_Store": "x", "hidden folder/.own/a.py": RIGHT})
    inner = packed((NAME, RIGHT), ("face.png", b"x"))
    write(place, {"zip/handin.zip": packed((f"Ann Müller/{NAME}", RIGHT), ("Ann Müller/b/", ""))})
    write(place, {"zip in zip/handin.zip": packed(("inner.zip", inner), ("__MACOSX/._x", "x"))})
    return place


WORDS = {f"{who}/{name}": words for who, (name, _, words) in CLASS.items()} | {
    "empty": "holds no file.",
    "only system": "holds nothing but files of the system.",
    "hidden folder/.own": "is a hidden folder of 1 file: its name",
    f"zip/handin.zip/Ann Müller/{NAME}": DONE,
    "zip/handin.zip/Ann Müller/b": "holds no file.",
    f"zip in zip/handin.zip/inner.zip/{NAME}": DONE,
    "zip in zip/handin.zip/inner.zip/face.png": "is a picture",
}


@pytest.fixture
def quick(kept_guard, monkeypatch):
    """Check one file after another, with the guard that is kept."""
    lent = SimpleNamespace(start=kept_guard.start, end=kept_guard.end, close=lambda: None)
    monkeypatch.setattr(folder, "make", lambda many: lent)


def test_everybody_of_a_class_is_in_the_terminal_and_in_both_tables(
    everybody, tmp_path, monkeypatch, capsys, quick
):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.chdir(everybody)
    Path("results.csv").write_text("of the last time")  # it was not handed in
    written = []
    write_one = folder.write
    monkeypatch.setattr(folder, "write", lambda *of: (written.append(of), write_one(*of)))
    assert main(["check", ".", "--jobs", "1", "--report", "results.csv"]) == 1
    out = capsys.readouterr().out
    with Path("results.csv").open(encoding="utf-8-sig", newline="") as file:
        cells = list(csv.DictReader(file))
    write_one(written[0][0], Path("results.json"))
    rows = json.loads(Path("results.json").read_text(encoding="utf-8"))
    assert {row["file"] for row in rows} == {row["file"] for row in cells} == {*WORDS, ""}
    for name, words in WORDS.items():
        (row, *_) = [row for row in rows if row["file"] == name]
        if row["result"] == "came along":
            assert name in out.partition("Came along with programs: ")[2].partition("\n")[0]
        else:
            assert f"{name}: {words}" in out
        assert row["task"] or words in row["message"]
    assert "Passed over: 2 files that systems and programs write for themselves" in out
    assert ".DS_Store (1), __MACOSX (1)." in rows[-1]["message"]
    without = re.findall("^    (.*)$", out.partition("Nothing was checked of:\n")[2], re.MULTILINE)
    everyone, checked = (
        {name.partition("/")[0] for name, words in WORDS.items() if words.startswith(done)}
        for done in ("", DONE)
    )
    assert set(without) == {*(everyone - checked), "zip/handin.zip/Ann Müller/b"}
    assert "The file was read as Windows-1252. Save it as UTF-8" in out
    assert "The file was read as UTF-16. Save it as UTF-8" in out
    assert f"All parts are done in 20 of {len(WORDS) - 1} files." in out
    assert [path.name for path in tmp_path.iterdir() if path.is_dir()] == ["class"]


def test_a_zip_of_a_class_is_read_as_its_folder(everybody, tmp_path, capsys):
    flat = [
        (path.relative_to(everybody).as_posix(), path.read_bytes())
        for path in sorted(everybody.rglob("*"))
        if path.is_file()
    ]
    handed_in = write(tmp_path, {"handins.ZIP": packed(*flat, ("empty/", ""))}) / "handins.ZIP"
    in_zip, in_folder = (
        {(found.name, found.reason, found.harmless) for found in find(root)}
        for root in (handed_in, everybody)
    )
    assert in_zip == in_folder


# Names as people and systems make them; a name is a file here and a folder there.
PARTS = st.sampled_from(
    [
        *("ann", "Ann", "é", "e\u0301", "a b", "a.py", "A.PY", "b.docx", ".c", "d.zip", "__e__"),
        *("f.txt", "__MACOSX", ".DS_Store", "node_modules", "g'h.py", "i;j.ipynb", "-k", "=l.py"),
    ]
)
LITTER = ("__MACOSX", ".DS_Store", "node_modules")
TREES = st.dictionaries(
    st.lists(PARTS, min_size=1, max_size=4).map("/".join),
    st.sampled_from([b"", b"x", b"x = 1"]),
    max_size=8,
)


@given(TREES, st.booleans())
def test_of_any_tree_every_name_is_accounted_for_once(tree, as_zip):
    with tempfile.TemporaryDirectory() as place:
        root = Path(place, "class")
        root.mkdir()
        for name, content in tree.items():
            try:
                write(root, {name: content})
            except OSError:
                continue  # the name is that of a folder already, or of a file
        files = {p.relative_to(root).as_posix() for p in root.rglob("*") if p.is_file()}
        if as_zip:
            names = sorted(files)
            data = packed(*((name, (root / name).read_bytes()) for name in names))
            root = write(Path(place), {"class.zip": data}) / "class.zip"
        found = find(root)
        named = [one.name for one in found if not one.litter]
        assert len(named) == len(set(named))
        for name in files:
            if not _is_litter(name):
                above = [name, *map(str, Path(name).parents)]
                assert {_plain(one) for one in above} & {_plain(one) for one in named}, name
        assert sum(one.litter for one in found) == sum(map(_is_litter, files))


def _is_litter(name):
    """Tell whether a file is counted only; of a hidden folder, the folder is told."""
    odd = [part for part in name.split("/") if part.startswith(".") or part in LITTER]
    return odd != [] and odd[0] in LITTER


def _plain(name):
    return handins.reading.plain_name(name.replace(" (2)", "").replace(" (3)", ""))


def test_no_name_in_a_zip_leads_out_of_it(tmp_path):
    names = ["../up.py", "a/../../up.py", "/abs.py", "C:\\drive.py", "c:/drive.py", "b\\..\\up.py"]
    handed_in = tmp_path / "a" / "b" / "in.zip"
    write(tmp_path, {"a/b/in.zip": packed(*((name, RIGHT) for name in names), ("ok.py", RIGHT))})
    found = told(handed_in)
    assert found.pop("ok.py") == ""
    assert len(found) == len(names)
    assert set(found.values()) == {"has a name that leads out of the zip."}
    assert [p.name for p in tmp_path.rglob("*") if p.is_file()] == ["in.zip"]


def test_links_and_locked_files_in_a_zip_are_told(tmp_path):
    link = ZipInfo("link.py")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    data = bytearray(packed((link, "/etc/passwd"), ("ann/task.py", RIGHT)))
    last = data.rindex(b"PK\1\2")
    data[last + 8] |= 1  # says that a password is needed
    root = write(tmp_path, {"in.zip": bytes(data)}) / "in.zip"
    assert told(root) == {
        "link.py": "is a link: hand in the file itself.",
        "ann/task.py": "is locked with a password.",
    }


def test_a_folder_of_a_zip_is_empty_only_if_nothing_was_in_it(tmp_path):
    data = bytearray(packed(("ann/", ""), ("ben/", ""), ("ann/task.py", RIGHT)))
    data[data.rindex(b"PK\1\2") + 8] |= 1
    root = write(tmp_path, {"in.zip": bytes(data)}) / "in.zip"
    assert told(root) == {"ann/task.py": "is locked with a password.", "ben": "holds no file."}
    assert told(write(tmp_path, {"no.zip": packed()}) / "no.zip") == {"": "holds no file."}


def test_names_of_a_zip_are_read_as_they_were_written(tmp_path):
    said = packed(("größe.py", RIGHT))
    dos = packed(("gr_se.py", RIGHT)).replace(b"gr_se", "gröse".encode("cp437"))
    for name, data in (("größe.py", said), ("größe.py", _without_flag(said)), ("gröse.py", dos)):
        assert told(write(tmp_path, {"in.zip": data}) / "in.zip") == {name: ""}


def _without_flag(data):
    """Return a zip that does not say that its names are in UTF-8."""
    changed = bytearray(data)
    for mark, offset in ((b"PK\3\4", 7), (b"PK\1\2", 9)):
        place = changed.find(mark)
        while place >= 0:
            changed[place + offset] &= ~0x08 & 0xFF
            place = changed.find(mark, place + 1)
    return bytes(changed)


def test_names_that_are_there_twice_or_differ_in_case_are_all_kept(tmp_path):
    names = ["a.py", "a.py", "A.py", "é.py", "e\u0301.py"]
    root = write(tmp_path, {"in.zip": packed(*((n, str(i)) for i, n in enumerate(names)))})
    found = find(root / "in.zip")
    assert {one.name for one in found} == {
        *("a.py", "a (2).py", "A (3).py", "é.py", "e\u0301 (2).py"),
    }


def test_a_file_where_a_folder_is_cannot_be_unpacked(tmp_path):
    root = write(tmp_path, {"in.zip": packed(("a", "x"), ("a/b.py", RIGHT))}) / "in.zip"
    assert told(root)["a/b.py"].startswith("cannot be unpacked: ")
    assert "a" in told(root)


@pytest.mark.parametrize("method", [ZIP_DEFLATED, ZIP_BZIP2, ZIP_LZMA])
def test_damage_in_a_zip_costs_only_the_damaged_file(method, tmp_path):
    text = os.urandom(3000)
    data = bytearray(packed(("a.py", text), ("b.py", RIGHT), method=method))
    data[200:300] = bytes(100)
    root = write(tmp_path, {"in.zip": bytes(data)}) / "in.zip"
    assert told(root) == {"a.py": "is damaged: ask for it again.", "b.py": ""}


def test_a_full_disk_is_told(tmp_path, monkeypatch):
    def refuse(file, entry):
        raise OSError(28, "No space left on device")

    root = write(tmp_path, {"in.zip": packed(("a.py", RIGHT))}) / "in.zip"
    monkeypatch.setattr(ZipFile, "open", refuse)
    assert told(root) == {"a.py": "cannot be unpacked: No space left on device."}


def test_what_python_cannot_unpack_is_told(tmp_path):
    data = bytearray(packed(("a.py", RIGHT), ("b.py", RIGHT)))
    data[data.index(b"PK\1\2") + 10] = 9  # a method of Windows
    root = write(tmp_path, {"in.zip": bytes(data)}) / "in.zip"
    assert told(root) == {"a.py": "is damaged: ask for it again.", "b.py": ""}


def test_what_is_too_large_or_too_many_stays_packed(tmp_path, monkeypatch):
    monkeypatch.setattr(handins, "LARGEST", 1000)
    monkeypatch.setattr(handins, "MOST", 1500)
    monkeypatch.setattr(handins, "MOST_FILES", 5)
    large, many = bytes(1001), [(f"{i}.py", "x") for i in range(6)]
    write(
        tmp_path,
        {
            "large.zip": packed(("a.py", large), ("b.py", "x = 1")),
            "all.zip": packed(("a.py", bytes(999)), ("b.py", bytes(999)), ("c.py", "x")),
            "many.zip": packed(*many),
            "inner.zip": packed(("x", "x"), ("y.zip", packed(*many[:4]))),
        },
    )
    assert told(tmp_path) == {
        "large.zip/a.py": "is too large: unpack the zip yourself.",
        "large.zip/b.py": "",
        "all.zip/a.py": "",
        "all.zip/b.py": "is too large: unpack the zip yourself.",
        "all.zip/c.py": "is too large: unpack the zip yourself.",
        "many.zip": "holds more than 5 files: unpack it yourself.",
        "inner.zip/x": "is neither a .py nor an .ipynb file.",
        "inner.zip/y.zip": "holds more than 3 files: unpack it yourself.",
    }


def test_sizes_that_lie_do_not_fill_the_disk(tmp_path, monkeypatch):
    monkeypatch.setattr(handins, "LARGEST", 1000)
    data = bytearray(packed(("a.py", bytes(5000))))
    place = data.index(b"PK\1\2")
    data[place + 24 : place + 28] = (10).to_bytes(4, "little")
    root = write(tmp_path, {"in.zip": bytes(data)}) / "in.zip"
    assert told(root) == {"a.py": "is damaged: ask for it again."}


def test_zips_in_zips_and_folders_in_folders_have_an_end(tmp_path, monkeypatch):
    monkeypatch.setattr(handins, "DEEPEST_FOLDER", 5)
    data = packed(("a.py", RIGHT))
    for _ in range(4):
        data = packed(("in.zip", data))
    root = write(tmp_path, {"class/in.zip": data}) / "class"
    assert told(root) == {
        "in.zip/in.zip/in.zip/in.zip": "lies in 3 zips, one in another: unpack them."
    }
    deep = "a/" * 7 + "b.py"
    root = write(tmp_path, {"deep.zip": packed((deep, RIGHT))}) / "deep.zip"
    assert told(root) == {deep: "lies in more than 5 folders."}
    root = write(tmp_path, {f"deep/{deep}": RIGHT}) / "deep"
    assert set(told(root).values()) == {"lies in more than 5 folders."}


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
def test_links_are_told_and_not_followed_out(tmp_path):
    root = write(tmp_path, {"class/ann/a.py": RIGHT, "secret.py": RIGHT}) / "class"
    (root / "ann/out.py").symlink_to(tmp_path / "secret.py")
    (root / "ann/loop").symlink_to(root)
    (root / "ann/nowhere.py").symlink_to("nowhere.py")
    (root / "ann/same.py").symlink_to("a.py")
    (tmp_path / "link").symlink_to(root)
    for place in (root, tmp_path / "link"):
        assert told(place) == {
            "ann/a.py": "",
            "ann/same.py": "",
            "ann/out.py": "is a link that leads out of the folder: hand in the file itself.",
            "ann/loop": "is a link to a folder: what is there is checked there.",
            "ann/nowhere.py": "is a link that leads nowhere.",
        }


def test_a_folder_that_may_not_be_opened_is_told(tmp_path, monkeypatch):
    def refuse(place):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(handins.os, "listdir", refuse)
    assert told(tmp_path) == {"": "cannot be opened: Permission denied."}


def test_a_file_that_may_not_be_read_is_told(tmp_path, monkeypatch):
    def refuse(path):
        raise PermissionError(13, "Permission denied")

    write(tmp_path, {"notes.txt": RIGHT})
    monkeypatch.setattr(Path, "read_bytes", refuse)
    assert told(tmp_path) == {"notes.txt": "is neither a .py nor an .ipynb file."}


def test_all_zips_together_get_the_room_of_one_of_a_class(tmp_path, monkeypatch):
    monkeypatch.setattr(handins, "MOST", 1500)
    write(tmp_path, {f"{i}.zip": packed(("a.py", bytes(1400))) for i in range(5)})
    told_all = told(tmp_path)
    assert [told_all[f"{i}.zip/a.py"] for i in range(4)] == [""] * 4
    assert told_all["4.zip/a.py"] == "is too large: unpack the zip yourself."
    monkeypatch.setattr(handins, "MOST_FILES", 1)
    monkeypatch.setattr(handins, "MOST", 10**6)
    write(tmp_path, {"5.zip": packed(("a.py", "x = 1"))})
    assert told(tmp_path)["5.zip"].startswith("holds more than 0 files")


def test_a_virtual_environment_is_litter(tmp_path):
    write(tmp_path, {"env/pyvenv.cfg": "x", "env/lib/a.py": "x", "a.py": "x", "venv/a.py": "x"})
    (tmp_path / "__pycache__").mkdir()
    found = find(tmp_path)
    assert [one.name for one in found if not one.litter] == ["a.py", "venv/a.py"]
    assert [one.name for one in found if one.litter] == ["__pycache__", "lib", "pyvenv.cfg"]


def test_a_program_in_a_virtual_environment_is_handed_in(tmp_path):
    write(tmp_path, {"ann/pyvenv.cfg": "x", "ann/Lib/a.py": "x", "ann/task_1_1.py": RIGHT})
    (tmp_path / "ann/lib64").symlink_to("Lib")
    write(tmp_path, {"ben/pyvenv.cfg": "x"})
    assert told(tmp_path) == {"ann/task_1_1.py": "", "ben": handins.ONLY_LITTER}


def test_what_lies_beside_a_checked_program_came_along(tmp_path, quick):
    right = f"import own\nfrom tools.second import x\n{RIGHT}"
    write(
        tmp_path,
        {
            "solution_1_1.py": RIGHT,
            f"ann/{NAME}": right,
            "ann/own.py": "x = 1",
            "ann/other.py": "x = 1",
            "ann/tools/__init__.py": "",
            "ann/tools/second.py": "x = 1",
            "ann/pictures/a.png": b"x",
            "ann/more.rar": b"x",
            "ben/a.png": b"x",
            "ben/own.py": "x = 1",
            "notes.png": b"x",
        },
    )
    results = {
        row["file"]: (row["result"], row["passed"]) for row in folder.check_folder(tmp_path, jobs=1)
    }
    along, not_checked = ("came along", None), ("not checked", False)
    assert results == {
        "solution_1_1.py": ("done", True),
        f"ann/{NAME}": ("done", True),
        "ann/own.py": along,
        "ann/other.py": not_checked,
        "ann/tools/__init__.py": along,
        "ann/tools/second.py": along,
        "ann/pictures/a.png": along,
        "ann/more.rar": not_checked,
        "ben/a.png": not_checked,
        "ben/own.py": not_checked,
        "notes.png": along,
    }
    (tmp_path / "mine").mkdir()
    write(tmp_path, {"mine/task_1_1.py": RIGHT, "mine/pictures/a.png": b"x"})
    assert main(["check", str(tmp_path / "mine"), "--jobs", "1"]) == 0


def nothing_of(rows):
    lines = folder.summary(rows)
    return [line.strip() for line in lines[lines.index("Nothing was checked of:") + 1 : -1]]


def test_in_a_folder_of_many_students_a_file_is_somebodys_by_its_name(tmp_path, quick):
    ann, ben, eva = (f"{name}_assignsubmission_file_" for name in ("A B_1", "B C_2", "E F_3"))
    write(
        tmp_path,
        {
            **{f"{ann}{NAME}": RIGHT, f"{ann}face.png": b"x", f"{ben}{NAME}": RIGHT},
            **{f"{eva}report.docx": b"x", "face.png": b"x"},
            **{"lab/1.py": RIGHT, "lab/2.py": RIGHT, "lab/eva/a.docx": b"x"},
            **{"more/solution.py": RIGHT, "more/ann/1.py": RIGHT, "more/eva/a.docx": b"x"},
        },
    )
    rows = folder.check_folder(tmp_path, jobs=1)
    assert [row["file"] for row in rows if row["result"] == "came along"] == [f"{ann}face.png"]
    assert nothing_of(rows) == [f"{eva}report.docx", "face.png", "lab/eva", "more/eva"]


def test_what_moodle_keeps_of_one_student_in_several_places_is_of_one(tmp_path, quick):
    ada, hal, eva = (f"{name}_assignsubmission_" for name in ("Ada L_1", "Hal_2", "Eva_3"))
    texts = [f"{who}onlinetext_/onlinetext.html" for who in (ada, eva)]
    write(tmp_path, {f"{ada}file_/{NAME}": RIGHT, f"{ada}file_/more.rar": b"x"})
    write(tmp_path, {f"{hal}file_{NAME}": RIGHT, f"{hal}file_mymath.py": "x = 1"})
    write(tmp_path, dict.fromkeys(texts, b"x"))
    rows = folder.check_folder(tmp_path, jobs=1)
    assert nothing_of(rows) == [f"{ada}file_/more.rar", f"{eva}onlinetext_"]
    lines = "\n".join(folder.summary(rows))
    assert f"{texts[0]}: is a web page" in lines
    assert f"{hal}file_mymath.py: is not a task" in lines


def test_a_document_in_place_of_a_program_does_not_come_along(tmp_path, quick):
    others = ["Ben_13_report.docx", "Ben_13_task_0_0.docx", "Cem_14_scan.pdf"]
    others += ["Cem_14_task_0_0.PDF", "Dora_15_scan.jpg", "Eva_16_talk.pptx", "sheet.pdf"]
    own = ["Ann_12_report.docx", "ann_12.jpg", "face.png", "notes.txt", "pictures/Ben_13.png"]
    (tmp_path / "pictures").mkdir()
    write(tmp_path, {"Ann_12_task_0_0.py": f"# face.png{RIGHT}"})
    write(tmp_path, dict.fromkeys([*others, *own], b"x"))
    rows = folder.check_folder(tmp_path, jobs=1)
    along = [row["file"] for row in rows if row["result"] == "came along"]
    assert (sorted(along), nothing_of(rows)) == (sorted(own), others)


def test_beside_programs_without_a_name_in_front_documents_come_along(tmp_path, quick):
    (tmp_path / "ben").mkdir()
    own = ["Ann_report.docx", "ben/scan.jpg"]
    write(tmp_path, {NAME: RIGHT, "ben/hermite.py": RIGHT} | dict.fromkeys(own, b"x"))
    rows = folder.check_folder(tmp_path / "ben", jobs=1)
    assert [row["result"] for row in rows[-1:]] == ["came along"]
    (tmp_path / "ben" / "hermite.py").unlink()
    rows = folder.check_folder(tmp_path, jobs=1)
    assert [row["file"] for row in rows if row["result"] == "came along"] == own


def test_a_zip_that_cannot_be_read_is_refused(tmp_path, capsys):
    write(tmp_path, {"handins.zip": b"Rar!"})
    assert main(["check", str(tmp_path / "handins.zip")]) == 2
    assert "handins.zip cannot be read as a zip: ask for it again." in capsys.readouterr().err
