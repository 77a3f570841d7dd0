"""Which files are programs, and how their letters are written."""

import pytest

from canim.checks import reading
from canim.checks.file import check_file
from canim.checks.reading import UnusableFile, decode, read
from canim.cli import main

pytestmark = pytest.mark.usefixtures("one_guard")

WESTERN = [
    "# Lösung für die größte Aufgabe\nx = 'Ärger'",
    "# voilà l’été à Paris – «déjà»",
    "# el niño comió",
    "# coração, não é",
    "# perché è così",
    "# å gå på en ø",
    "# 30° and 5 m²: µs, 2×3 → no".replace("→", "–"),
    "# don’t “do” ‘this’, pages 3–4, §5, 3€ and 2½",
    "größe_2 = 1",
    "# („Länge“) und “so”.",
    "# L'HAŸ",
]
OTHERS = [
    ("cp1251", "# решение задачи"),
    ("cp1251", "# это в и"),
    ("cp1253", "# λύση να"),
    ("cp1250", "# řešení příkladu"),
    ("cp1250", "# był żółty"),
    ("cp1250", "# őrült űr"),
    ("cp1254", "# şöyle ığdır"),
    ("cp850", "# größe läuft"),
    ("cp850", "# Länge der Körper"),
    ("cp850", "# länge und körper"),
    ("mac_roman", "# über uns"),
    ("cp437", "# voilà été"),
    ("mac_roman", "# größe läuft"),
    ("shift_jis", "# 日本語"),
    ("gbk", "# 你好世界"),
    ("cp1252", "x = 'é'"),  # one letter in quotes may be any letter
]


@pytest.mark.parametrize("text", WESTERN)
def test_western_texts_are_read_as_windows_1252(text):
    assert decode(text.encode("cp1252")) == (text, "Windows-1252")


@pytest.mark.parametrize(("encoding", "text"), OTHERS)
def test_what_is_not_certain_is_not_read(encoding, text):
    assert decode(text.encode(encoding)) == ("", "")


@pytest.mark.parametrize(
    ("encoding", "name"),
    [
        *(("utf-8", "UTF-8"), ("utf-8-sig", "UTF-8"), ("utf-16", "UTF-16"), ("utf-32", "UTF-32")),
        *(("utf-16-le", "UTF-16"), ("utf-16-be", "UTF-16")),
    ],
)
def test_texts_in_unicode_are_read(encoding, name):
    text = "x = 'é' # größe\n"
    assert decode(text.encode(encoding)) == (text, name)


@pytest.mark.parametrize(
    ("data", "text", "name"),
    [
        (b"# coding: cp1252\nx = '\xe9'", "# coding: cp1252\nx = 'é'", "UTF-8"),
        (b"\n# vim: fileencoding=koi8-r\n#\xc1", "\n# vim: fileencoding=koi8-r\n#а", "UTF-8"),
        (b"# coding: nope\nx", "# coding: nope\nx", "UTF-8, and not as its first lines say"),
        (b"# coding: rot13\nx", "# coding: rot13\nx", "UTF-8, and not as its first lines say"),
        (b"# coding: utf-8\n# gr\xf6\xdfe", "# coding: utf-8\n# größe", "Windows-1252"),
        (b"\xff\xfex", "", ""),
        (b"x = 1\0", "x = 1\0", "UTF-8"),
        (b"x\x81", "", ""),
    ],
)
def test_what_the_first_lines_say_is_believed_as_python_does(data, text, name):
    assert decode(data) == (text, name)


def test_lines_end_as_they_do_for_python(tmp_path):
    (tmp_path / "a.py").write_bytes(b"x\r\ny\rz\n")
    assert read(tmp_path / "a.py") == ("x\ny\nz\n", "")


DONE = """import canim
from canim.interpolation import hermite_basis
canim.check("1.1", hermite_basis=hermite_basis)
assert __file__.endswith(".py")
"""


@pytest.mark.parametrize("name", ["TASK.PY", "task.py.txt", "task.py (1).txt", "task.txt", "t.pyw"])
def test_programs_of_any_name_are_run_as_programs(name, tmp_path, capsys):
    (tmp_path / name).write_text(DONE)
    assert main(["check", str(tmp_path / name)]) == 0


def test_how_a_file_was_read_is_told(tmp_path, capsys):
    (tmp_path / "mine.py").write_text(DONE + "# größer\n", encoding="cp1252")
    assert main(["check", str(tmp_path / "mine.py")]) == 0
    assert "read as Windows-1252. Save it as UTF-8, or Python will not run it." in " ".join(
        capsys.readouterr().out.split()
    )


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        *(
            ("a.py", ".py"),
            ("a.PY", ".py"),
            ("a.py.", ".py"),
            ("a.py .txt", ".py"),
            ("a.pyw", ".py"),
        ),
        *(("a.py (12).txt", ".py"), ("a.IPYNB.json", ".ipynb"), ("a.ipynb (1).json", ".ipynb")),
        *(("a.pyc", ""), ("a.py.docx", ""), ("a.py.bak", ""), ("a.txt", ""), ("py", ""), ("a", "")),
    ],
)
def test_what_a_file_is_by_its_name(name, kind, tmp_path):
    assert reading.kind(tmp_path / name) == kind


def test_a_long_text_is_not_looked_into(tmp_path, monkeypatch):
    path = tmp_path / "task.txt"
    path.write_text(DONE)
    assert reading.kind(path) == ".py"
    monkeypatch.setattr(reading, "_LONGEST", 10)
    assert reading.kind(path) == ""


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("task_1_1.docx", "task_1_1.docx is a text document: only .py and .ipynb files"),
        ("handin.rar", "handin.rar is an archive that is not a zip: unpack it"),
        ("task_1_1.m", "task_1_1.m is a file of MATLAB"),
        ("data.csv", "data.csv is neither a .py nor an .ipynb file."),
    ],
)
def test_why_a_file_is_not_checked(name, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / name).write_bytes(b"x")
    assert main(["check", name]) == 2
    assert words in capsys.readouterr().err


TWO = """
import canim
from canim.interpolation import hermite_basis
canim.check("1.1", hermite_basis=hermite_basis)
answers = {1: "first"}
def hermite_basis(t):
    return None
canim.check("1.2")
answers = {1: "second"}
"""


def test_every_task_of_a_file_is_checked_as_it_was_when_it_was_called(tmp_path, capsys):
    (tmp_path / "both.py").write_text(TWO)
    first, second = check_file(tmp_path / "both.py")
    assert (first.task.id, second.task.id) == ("1.1", "1.2")
    assert first.done
    assert first.answers == {"1": "first"}
    assert not second.done
    assert second.answers == {"1": "second"}
    assert main(["check", str(tmp_path / "both.py")]) == 1
    out = capsys.readouterr().out
    assert "All checks of Task 1.1 pass.\n\nTask 1.2: " in out


def test_what_is_written_once_counts_for_every_task_of_the_file(tmp_path):
    text = TWO.partition("answers")[0] + 'import canim as ca\nca.check("1.2")\nanswers = {1: "x"}\n'
    (tmp_path / "both.py").write_text(text + "class A: pass\n")
    first, second = check_file(tmp_path / "both.py")
    assert first.done
    assert first.answers == second.answers == {"1": "x"}


def test_a_task_that_was_not_asked_for_is_told(tmp_path, capsys):
    path = tmp_path / "both.py"
    path.write_text(TWO)
    assert main(["check", "--task", "1.1", str(path)]) == 0
    assert "The file is of Task 1.2 too: Task 1.1 was asked for." in capsys.readouterr().out
    assert main(["check", "--task", "1.3", str(path)]) == 1
    said = " ".join(capsys.readouterr().out.split())
    assert "By its call of canim.check, the file is of Task 1.1 and 1.2: Task 1.3 was asked" in said
    path.write_text(DONE + 'canim.check("1.99")\ncanim.check("x")\n')
    assert main(["check", str(path)]) == 0
    assert "There is no Task 1.99, which the file asks for." in capsys.readouterr().out


def test_a_file_that_is_not_there_is_told():
    with pytest.raises(UnusableFile, match=r"absent\.txt is not there"):
        read(reading.Path("absent.txt"))


@pytest.mark.parametrize(
    "call",
    [
        'import canim\ncanim.check(hint=True, task="1.1")',
        'import canim as c\nc.check("1.1")',
        'from canim import data, check as c\nc("1.1")',
        'from canim import check\ncheck("Task 1-1")',
    ],
)
def test_a_call_is_found_however_it_is_written(call, tmp_path):
    (tmp_path / "mine.py").write_text(call)
    assert [report.task.id for report in check_file(tmp_path / "mine.py")] == ["1.1"]


def test_what_is_not_a_task_is_not_taken_for_one(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text('def check(*texts, **more): pass\ncheck()\ncheck("step 11")\ncheck(text="1.1")')
    with pytest.raises(reading.NoTask):
        check_file(path)


RAW = """!pip install canim
%matplotlib inline
import canim
from canim.interpolation import hermite_basis
"""


def test_lines_of_a_notebook_in_a_program_are_read_as_in_a_cell(tmp_path):
    path = tmp_path / "task_1_1.py"
    path.write_text(f'{RAW}canim.check("1.1", hermite_basis=hermite_basis)\n')
    (report,) = check_file(path)
    assert report.done
    assert report.stops == []
    words = "The file has lines of a notebook, such as !pip install canim: it was read like a cell."
    assert words in " ".join(report.notes)


def test_what_else_is_wrong_in_a_program_with_lines_of_a_notebook_is_told(tmp_path):
    path = tmp_path / "task_1_1.py"
    path.write_text(f"{RAW}x = = 1\n")
    with pytest.raises(UnusableFile, match=r"task_1_1\.py, line 5:\n.*x = = 1"):
        check_file(path)
    path.write_text("x = = 1\n% 2\n")
    with pytest.raises(UnusableFile, match=r"task_1_1\.py, line 1:"):
        check_file(path)
