"""A head with its expressions, and named mixes of them."""

from __future__ import annotations

from pathlib import Path

from canim.character import Face, load_expressions

__all__ = ["MIXES", "expression_paths", "face"]

_FOLDER = Path(__file__).with_name("face")

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
    expression_paths : the OBJ files that are loaded.

    Notes
    -----
    Head and expressions were given to the public domain (CC0); ``SOURCES.md`` beside the files
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
    return load_expressions(_FOLDER)


def expression_paths() -> list[Path]:
    """Return where the OBJ files of `face` are: the neutral face first, then by name.

    Returns
    -------
    list of Path
        The files.

    Examples
    --------
    >>> from canim.data import expression_paths
    >>> [path.name for path in expression_paths()[:2]]
    ['neutral.obj', 'blink_left.obj']
    """
    neutral = _FOLDER / "neutral.obj"
    return [neutral, *sorted(path for path in _FOLDER.glob("*.obj") if path != neutral)]
