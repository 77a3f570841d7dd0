"""A head with its expressions, and named mixes of them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from canim.character import Face

__all__ = ["MIXES", "face", "save_expressions"]

FILE = Path(__file__).with_name("face") / "face.npz"
# The file holds whole numbers: hundredths of a centimetre, and of a colour.
_PARTS = 100

# How much of each expression makes a mood, or a face that says A, O or M.
MIXES: dict[str, dict[str, float]] = {
    "happy": {"smile_left": 0.9, "smile_right": 0.9, "squint": 0.4, "teeth": 0.25},
    "sad": {"frown": 0.8, "brows_up_inner": 1, "blink_left": 0.2, "blink_right": 0.2},
    "surprised": {
        "mouth_open": 0.4,
        "o": 0.4,
        "eyes_wide": 1,
        "brows_up_inner": 0.8,
        "brow_up_left": 0.8,
        "brow_up_right": 0.8,
    },
    "angry": {
        "brow_down_left": 0.8,
        "brow_down_right": 0.8,
        "nose_wrinkle": 0.4,
        "eyes_wide": 0.4,
        "frown": 0.6,
        "teeth": 0.3,
    },
    "A": {"mouth_open": 0.7, "teeth": 0.2},
    "O": {"o": 1},
    "M": {"lips_pressed": 1},
}


def face() -> Face:
    r"""Load a head with its expressions: the neutral face and the same vertices, moved.

    Returns
    -------
    Face
        Vertices in centimetres, y up, the nose towards z; the box around the neutral face has
        its middle in the origin. Left and right are those of the head itself: its left eye has
        a positive x. With colours.

    See Also
    --------
    save_expressions : the same as OBJ files.

    Notes
    -----
    Head and expressions were given to the public domain (CC0); ``SOURCES.md`` beside the file
    says where they come from. They are the face of Tasks 3.4 and 3.5.

    Examples
    --------
    >>> from canim.data import face
    >>> head = face()
    >>> head.neutral.shape == head.expressions["smile_left"].shape
    True
    >>> sorted(head.expressions)[:3]
    ['blink_left', 'blink_right', 'brow_down_left']
    """
    with np.load(FILE) as stored:
        neutral = stored["neutral"].astype(np.int64)
        moved = (neutral + stored["moves"]) / _PARTS
        names, triangles = stored["names"], stored["faces"]
        colors = stored["colors"] / _PARTS
    return Face(neutral / _PARTS, dict(zip(names.tolist(), moved)), triangles, colors)


def save_expressions(folder: str | os.PathLike[str]) -> None:
    r"""Write the face as OBJ files: ``neutral.obj`` and one file for each expression.

    `canim.character.load_expressions` reads them again, with every number as it was; so does
    any program for 3D models.

    Parameters
    ----------
    folder : str or path-like
        The folder for the files. It is made if it is not there.

    Raises
    ------
    FileExistsError
        If the folder holds a file of that name with another content. Nothing is written then.
    OSError
        If the folder cannot be made, or a file not be written.
    TypeError
        If `folder` is not the name of a folder.

    Notes
    -----
    In each file stand the vertices in centimetres, y up (``v x y z``), and the triangles
    (``f``). ``neutral.obj`` has the colours as well (``v x y z red green blue``).

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from pathlib import Path
    >>> from canim.data import save_expressions
    >>> with TemporaryDirectory() as folder:
    ...     save_expressions(folder)
    ...     print(Path(folder, "neutral.obj").read_text().split("\n")[0])
    v -3.47 2.73 7.63 0.2 0.13 0.11
    """
    if not isinstance(folder, str | os.PathLike):
        raise TypeError(f"folder must be the name of a folder, but is {folder!r}.")
    head = face()
    triangles = _lines("f", (head.faces + 1).tolist())
    colored = np.hstack([head.neutral, head.colors])  # type: ignore[list-item]
    tables = {"neutral": colored} | head.expressions
    files = {
        Path(folder, f"{name}.obj"): (_lines("v", table.tolist()) + triangles).encode()
        for name, table in tables.items()
    }
    for path, content in files.items():
        if path.exists() and path.read_bytes() != content:
            raise FileExistsError(
                f"folder: {path} is there already, with another content. Choose an empty folder."
            )
    Path(folder).mkdir(parents=True, exist_ok=True)
    for path, content in files.items():
        path.write_bytes(content)


def _lines(kind: str, rows: Iterable[list[Any]]) -> str:
    return "".join(f"{kind} {' '.join(f'{number:.6g}' for number in row)}\n" for row in rows)
