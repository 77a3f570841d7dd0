"""Faces are read from folders of OBJ files as others read them, or refused by name."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
import trimesh

from canim.character import load_expressions

SQUARE = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n"
RAISED = SQUARE.replace("2 2 0", "2 2 1.5e0")
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)]
TRIANGLES = [(0, 1, 2), (0, 2, 3)]


def folder(path, **files):
    path.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (path / f"{name}.obj").write_bytes(text.encode())
    return path


def test_expressions_by_the_names_of_their_files(tmp_path):
    path = folder(
        tmp_path, smile_left=RAISED, neutral=SQUARE, blink=SQUARE.replace("0 2 0", "0 1 0")
    )
    (path / "notes.txt").write_text("no mesh", encoding="utf-8")
    (path / "._neutral.obj").write_bytes(b"\0\5\x16\7")
    for given in (path, str(path)):
        face = load_expressions(given)
        assert list(face.expressions) == ["blink", "smile_left"]
        assert face.neutral.tolist() == [list(map(float, corner)) for corner in CORNERS]
        assert face.expressions["smile_left"][2].tolist() == [2, 2, 1.5]
        assert face.expressions["blink"][3].tolist() == [0, 1, 0]
        assert [tuple(corners) for corners in face.faces] == TRIANGLES
        assert face.colors is None


def test_alphabetical_order_whatever_the_folder_says(tmp_path):
    names = list("hcxaqbtzmk")
    path = folder(tmp_path, neutral=SQUARE, **dict.fromkeys(names, RAISED))
    (path / "h.obj").rename(path / "h.OBJ")
    assert list(load_expressions(path).expressions) == sorted(names)


@pytest.mark.parametrize("name", ["with space", "é è ü 笑", "a#b"])
def test_names_with_spaces_and_accents(tmp_path, name):
    face = load_expressions(folder(tmp_path / name, neutral=SQUARE, **{name: RAISED}))
    assert list(face.expressions) == [name]


@pytest.mark.parametrize(
    "text",
    [
        SQUARE.replace("\n", "\r\n"),
        SQUARE.replace("\n", "\r"),
        SQUARE.rstrip(),
        "\ufeff" + SQUARE,
        SQUARE.replace("f 1 2 3 4", "f  1\t2 3  4 "),
        SQUARE.replace("f 1 2 3 4", "\tf 1 2 \\\n 3 4"),
        SQUARE.replace("v 2 2 0\n", "v 2 \\\n 2 \\\n 0\n"),
        # Only vertices and faces go on in the next line.
        SQUARE.replace("v 2 2 0", "# made in C:\\faces\\\ng lips\\\nusemtl a \\\nv 2 2 0 # \\"),
        SQUARE.replace("f 1", "vt 0 0\\\n 1\no C:\\\nf 1"),
        SQUARE.replace("f 1 2 3 4", "f -4 -3 -2 -1"),
        SQUARE.replace("f 1 2 3 4", "f 1 2 -2\nf 1 3 4"),
        SQUARE.replace("f 1 2 3 4", "f 1/1 2/2 3/1 4/2"),
        SQUARE.replace("f 1 2 3 4", "vn 0 0 1\nf 1//1 2//1 3//1 4//1"),
        SQUARE.replace("f 1 2 3 4", "vt 0 0\nvt 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/2/1 4/2/1"),
        "# made by é\nmtllib missing.mtl\no head\ng lips\ns 1\nusemtl skin\n" + SQUARE + "l 1 2\n",
        SQUARE.replace("\nf", " # corner\n# all corners\n\nusemtl lips\nf").replace(
            "4\n", "4 # 4\n"
        ),
        SQUARE.replace("v 2 2 0", "v 2 2 0 1"),
        SQUARE.replace("v 2 2 0", "v +2.0 2e0 -0. 1"),
        # A vertex that comes after the first face: what is negative counts from its line.
        "v 0 0 0\nv 2 0 0\nv 2 2 0\nf -3 -2 -1\nv 0 2 0\nf 1 3 4\n",
    ],
)
def test_the_same_mesh_in_other_words(tmp_path, text):
    face = load_expressions(folder(tmp_path, neutral=SQUARE, other=text))
    assert np.array_equal(face.expressions["other"], CORNERS)
    face = load_expressions(folder(tmp_path, neutral=text))
    assert np.array_equal(face.neutral, CORNERS)
    assert [tuple(corners) for corners in face.faces] == TRIANGLES


def test_bytes_that_are_no_text_in_a_comment(tmp_path):
    path = folder(tmp_path, neutral=SQUARE, smile=RAISED)
    (path / "neutral.obj").write_bytes(b"# Fran\xe7ois\n" + SQUARE.encode())
    assert len(load_expressions(path).neutral) == 4


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("1 0.5 0.25", (1, 0.5, 0.25)),
        ("255 51 0", (1, 0.2, 0)),
        ("-0.001 0.5 1", (0, 0.5, 1)),
        ("0 0 0 1", (0, 0, 0)),
        ("1.0000001 0.5 0.25", (1, 0.5, 0.25)),
        ("1.5 0.5 0", (1, 0.5, 0)),
        ("2 0.5 0", (1, 0.5, 0)),
        ("17 0 0", (17 / 255, 0, 0)),
    ],
)
def test_colors(tmp_path, written, read):
    coloured = re.sub(r"(v.*)", rf"\1 {written}", SQUARE)
    face = load_expressions(folder(tmp_path, neutral=coloured, smile=RAISED))
    assert np.array_equal(face.colors, [read] * 4)
    assert np.array_equal(face.neutral, CORNERS)


@pytest.mark.parametrize("wrong", ["nan 0 0", "0 inf 0", "0 0", ""])
def test_a_vertex_without_a_colour_is_told_and_none_is_taken(tmp_path, wrong):
    coloured = re.sub(r"(v.*)", r"\1 0.5 0.5 0.5", SQUARE)
    neutral = coloured.replace("v 2 2 0 0.5 0.5 0.5", f"v 2 2 0 {wrong}")
    with pytest.warns(UserWarning, match=r"^folder: neutral\.obj, vertex 3, has no colour") as told:
        face = load_expressions(folder(tmp_path, neutral=neutral, smile=RAISED))
    assert told[0].filename == __file__
    assert face.colors is None
    assert np.array_equal(face.neutral, CORNERS)
    # Those of an expression are not asked for.
    face = load_expressions(folder(tmp_path, neutral=coloured, smile=neutral))
    assert np.array_equal(face.expressions["smile"], CORNERS)
    assert (face.colors == 0.5).all()


def test_an_expression_may_leave_the_faces_to_the_neutral_one(tmp_path):
    vertices = RAISED.partition("f")[0]
    face = load_expressions(folder(tmp_path, neutral=SQUARE, smile=vertices))
    assert face.expressions["smile"][2].tolist() == [2, 2, 1.5]
    assert [tuple(corners) for corners in face.faces] == TRIANGLES
    refuses(
        folder(tmp_path, smile=vertices + "v 1 1 1\n"),
        r"^folder: smile\.obj has 5 vertices and neutral\.obj 4;",
    )


@pytest.mark.parametrize("name", ["Neutral.obj", "NEUTRAL.OBJ", "neutral.Obj"])
def test_capitals_of_the_neutral_face_do_not_matter(tmp_path, name):
    path = folder(tmp_path, neutral=SQUARE, smile=RAISED)
    (path / "neutral.obj").rename(path / name)
    face = load_expressions(path)
    assert list(face.expressions) == ["smile"]
    assert np.array_equal(face.neutral, CORNERS)
    (path / "smile.obj").unlink()
    refuses(path, rf"holds no OBJ file beside {re.escape(name)};")


def test_as_trimesh_reads(tmp_path):
    """Triangles, quads and pentagons, and vertices that lie on each other."""
    rng = np.random.default_rng(7)
    vertices = np.repeat(rng.normal(size=(40, 3)), 2, axis=0)
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in vertices]
    corner = itertools.cycle(rng.permutation(80) + 1)
    for count in rng.integers(3, 6, 60):
        lines.append("f " + " ".join(str(next(corner)) for _ in range(count)))
    text = "\n".join(lines)
    face = load_expressions(folder(tmp_path, neutral=text, same=text))
    mesh = trimesh.load_mesh(tmp_path / "same.obj", process=False, maintain_order=True)
    assert np.array_equal(face.neutral, mesh.vertices)

    def surface(triangles):
        normals = np.cross(
            *(face.neutral[triangles[:, k]] - face.neutral[triangles[:, 0]] for k in (1, 2))
        )
        return normals.sum(axis=0)

    assert len(face.faces) == len(mesh.faces)
    np.testing.assert_allclose(surface(face.faces), surface(mesh.faces))


def test_a_large_mesh(tmp_path):
    count = 200_000
    rows = [f"v {k / 7:.4f} {k % 447} 0.5" for k in range(count)]
    rows += [f"f {k} {k + 1} {k + 448} {k + 447}" for k in range(1, count - 448, 10)]
    text = "\n".join(rows)
    face = load_expressions(folder(tmp_path, neutral=text, same=text))
    assert face.shapes.shape == (1, count, 3)
    assert face.faces.shape == (2 * len(range(1, count - 448, 10)), 3)
    assert face.neutral[-1].tolist() == [round((count - 1) / 7, 4), (count - 1) % 447, 0.5]


# --- Refused


def refuses(path, match, error=ValueError):
    with pytest.raises(error, match=match) as caught:
        load_expressions(path)
    text = str(caught.value)
    assert text[-1] == "."
    assert "\n" not in text
    assert caught.value.__suppress_context__ or caught.value.__context__ is None


@pytest.mark.parametrize(
    ("line", "by", "expected"),
    [
        ("v 2 0 0", "v 2 0", "v x y z"),
        ("v 2 0 0", "v", "v x y z"),
        ("v 2 0 0", "v 2 O 0", "v x y z"),
        ("v 2 0 0", "v 2,0 0,0 0,0", "v x y z"),
        ("v 2 0 0", "v 2 nan 0", "v x y z"),
        ("v 2 0 0", "v 2 -inf 0", "v x y z"),
        ("v 2 0 0", "v 2 0 1e999", "v x y z"),
        ("f 1 2 3 4", "f 1 2", "f and three"),
        ("f 1 2 3 4", "f", "f and three"),
        ("f 1 2 3 4", "f 1 2 3 x", "f and three"),
        ("f 1 2 3 4", "f 1 2 3.0", "f and three"),
        ("f 1 2 3 4", "f 1 2 /3", "f and three"),
        ("f 1 2 3 4", "f 1 2 5", "f and three or more of the vertices 1 to 4"),
        ("f 1 2 3 4", "f 0 1 2", "f and three"),
        ("f 1 2 3 4", "f 1 2 -5", "f and three"),
    ],
)
def test_broken_lines(tmp_path, line, by, expected):
    number = SQUARE.split("\n").index(line) + 1
    match = (
        rf"^folder: smile\.obj, line {number}, must be {expected}.*, but is '{re.escape(by)}'\.$"
    )
    refuses(folder(tmp_path, neutral=SQUARE, smile=SQUARE.replace(line, by)), match)


def test_vertex_zero_is_none_though_more_vertices_follow(tmp_path):
    text = SQUARE.replace("v 0 2 0\nf 1 2 3 4", "f 0 1 2\nv 0 2 0")
    refuses(folder(tmp_path, neutral=text, smile=text), r"neutral\.obj, line 4, must be f and")


def test_lines_keep_their_numbers_behind_one_that_is_broken(tmp_path):
    broken = SQUARE.replace("v 2 0 0", "v 2 \\\n 0 \\\n 0").replace("v 0 2 0", "v 0 x 0")
    refuses(folder(tmp_path, neutral=SQUARE, smile=broken), r"smile\.obj, line 6, must be v x y z")


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("", "vertices"),
        ("# empty\n", "vertices"),
        ("f 1 2 3\n", "vertices"),
        (SQUARE.partition("f")[0], "faces"),
        ("PK\3\4\0\0", "vertices"),
    ],
)
def test_files_without_a_mesh(tmp_path, text, what):
    refuses(
        folder(tmp_path, neutral=text, smile=RAISED),
        rf"^folder: neutral\.obj holds no {what}",
    )


def test_other_topologies(tmp_path):
    more = SQUARE.replace("f", "v 5 5 5\nf")
    refuses(
        folder(tmp_path / "more", neutral=SQUARE, same=RAISED, smile=more),
        r"^folder: smile\.obj has 5 vertices and neutral\.obj 4;",
    )
    # Fewer vertices, though the face lines are the same.
    refuses(
        folder(tmp_path / "fewer", neutral=more, smile=SQUARE),
        r"^folder: smile\.obj has 4 vertices and neutral\.obj 5;",
    )


@pytest.mark.parametrize(
    ("first", "other"),
    [
        ("f 1 2 3 4", "f 2 3 4 1"),
        ("f 1 2 3 4", "f 4 3 2 1"),
        ("f 1 2 3 4", "f 1 2 3"),
        ("f 1 2 3 4", "f 1 2 4\nf 1 2 3 4"),
        ("f 1 2 3\n\tf 1 3 4", "f 1 2 3"),
        ("\tf 1 2 4\nf 1 2 3", "f 1 2 3"),
        ("f 1 2 3", "\tf 1 2 4\nf 1 2 3"),
        ("f 1 2 3", " f 1 2 4\nf 1 2 3"),
    ],
)
def test_other_faces(tmp_path, first, other):
    files = {
        name: SQUARE.replace("f 1 2 3 4", faces)
        for name, faces in (("neutral", first), ("smile", other))
    }
    refuses(
        folder(tmp_path, **files),
        r"^folder: smile\.obj and neutral\.obj have different faces;",
    )


def test_folders_without_faces(tmp_path):
    refuses(folder(tmp_path), r"^folder: .* holds no neutral\.obj; it needs neutral\.obj and one")
    refuses(folder(tmp_path, smile=RAISED), r"^folder: .* holds no neutral\.obj; .*expression\.$")
    refuses(folder(tmp_path / "b", neutral=SQUARE), r"holds no OBJ file beside neutral\.obj;")


@pytest.mark.parametrize(
    ("first", "second"), [("smile.OBJ", "smile.obj"), ("NEUTRAL.obj", "neutral.obj")]
)
def test_two_files_of_one_name_are_named(tmp_path, monkeypatch, first, second):
    path = folder(tmp_path, neutral=SQUARE, other=RAISED)
    # Not every system keeps two such files apart.
    there = [path / "neutral.obj", path / "other.obj"]
    there += [path / name for name in (first, second) if name != "neutral.obj"]
    monkeypatch.setattr(Path, "iterdir", lambda folder: iter(there))
    refuses(path, rf"^folder: .* holds both {first} and {second}; remove or rename one\.$")


@pytest.mark.parametrize(
    "name",
    [
        "generic_neutral_mesh.obj",
        "Neutral_pose.OBJ",
        "neutral.obj.txt",
        "neutral.ply",
        "netural.obj",
        "natural.obj",
    ],
)
def test_what_looks_like_the_neutral_face_is_named(tmp_path, name):
    path = folder(tmp_path, smile=RAISED)
    (path / name).write_text(SQUARE, encoding="utf-8")
    words = rf"If {re.escape(name)} is the neutral face, save it as neutral\.obj\.$"
    refuses(path, rf"^folder: .* holds no neutral\.obj; .*expression\. {words}")


def test_folders_that_are_none(tmp_path):
    with pytest.raises(FileNotFoundError, match="missing"):
        load_expressions(tmp_path / "missing")
    with pytest.raises(NotADirectoryError, match=r"neutral\.obj"):
        load_expressions(folder(tmp_path, neutral=SQUARE) / "neutral.obj")
    (tmp_path / "smile.obj").mkdir()
    with pytest.raises(OSError, match=r"smile\.obj"):
        load_expressions(tmp_path)
    for bad in (None, 7, b"faces", ["faces"]):
        refuses(bad, r"^folder must be the name of a folder, but is", TypeError)
