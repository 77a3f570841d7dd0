"""Mix facial expressions: global and delta blendshapes, and faces read from OBJ files."""

from __future__ import annotations

import difflib
import math
import os
import re
import warnings
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from canim._arguments import Floats, floats, points, real

__all__ = ["Face", "delta_blendshape", "global_blendshape", "load_expressions"]

Integers = NDArray[np.int64]
Mixed = NDArray[np.float32 | np.float64]

# So many coordinates of a frame, fewer of many frames, are mixed at once: they stay near the
# processor while they are worked on.
_BLOCK = 65536

_FIRST_FACE = re.compile(r"\n[ \t]*f\b")
# A vertex or a face that goes on in the next line. Names and comments may end in a backslash.
_CONTINUED = re.compile(r"\n[ \t]*[vf][ \t][^\n#\\]*(?:\\\n[^\n#\\]*)+")

# Colours that some programs count up to 255; what is a little above 1 was rounded.
_COUNTED = 16


def global_blendshape(shapes: ArrayLike, weights: ArrayLike) -> Mixed:
    r"""Mix whole shapes: each vertex is the weighted sum of where the shapes have it.

    .. math:: \mathbf{f} = \sum_k w_k\, \mathbf{b}_k

    Parameters
    ----------
    shapes : array_like, shape (K, V, 3)
        The shapes :math:`\mathbf{b}_k`, the neutral face among them: V vertices each, in any
        unit. An array whose numbers lie in this order is not copied.
    weights : array_like, shape (K,) or (frames, K)
        The weights :math:`w_k`, one for each shape; a table has one row for each frame.

    Returns
    -------
    ndarray, shape (V, 3) or (frames, V, 3)
        The mixed vertices: float32 where `shapes` are float32, otherwise float64.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If the shapes differ in their number of vertices, the weights do not match them, a
        number is not finite, or the result is too large for a float.

    See Also
    --------
    delta_blendshape : keeps the size of the face, whatever the weights are.

    Notes
    -----
    Where the weights sum to s, what all shapes share appears s times as large, seen from the
    origin. Theory: :ref:`Task 3.4 <task-3-4>`.

    References
    ----------
    J. P. Lewis, K. Anjyo, T. Rhee, M. Zhang, F. Pighin, Z. Deng, *Practice and Theory of
    Blendshape Facial Models*, Eurographics State of the Art Reports, 2014.

    Examples
    --------
    One vertex in two shapes, mixed half and half:

    >>> from canim.character import global_blendshape
    >>> shapes = [[(0, 0, 0)], [(2, 4, 6)]]
    >>> global_blendshape(shapes, [0.5, 0.5])
    array([[1., 2., 3.]])
    """
    table = _shapes(shapes)
    return _mix(table, _weights(weights, table))


def delta_blendshape(neutral: ArrayLike, shapes: ArrayLike, weights: ArrayLike) -> Mixed:
    r"""Add to the neutral face the weighted differences of the shapes from it.

    .. math::

        \mathbf{f} = \mathbf{b}_0 + \sum_{k=1}^{K} w_k (\mathbf{b}_k - \mathbf{b}_0)

    Parameters
    ----------
    neutral : array_like, shape (V, 3)
        The neutral face :math:`\mathbf{b}_0`.
    shapes : array_like, shape (K, V, 3)
        The expressions :math:`\mathbf{b}_1` to :math:`\mathbf{b}_K`, in the unit of
        `neutral`. An array whose numbers lie in this order is not copied.
    weights : array_like, shape (K,) or (frames, K)
        The weights :math:`w_k`, one for each shape; a table has one row for each frame. They
        need not sum to one, and may be above one or below zero.

    Returns
    -------
    ndarray, shape (V, 3) or (frames, V, 3)
        The mixed vertices: float32 where `shapes` are float32, otherwise float64.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If the shapes differ in their number of vertices, `neutral` or the weights do not
        match them, a number is not finite, or the result is too large for a float.

    See Also
    --------
    global_blendshape : gives the same where the weights, with that of the neutral face, sum
        to one.

    Notes
    -----
    A vertex that no expression moves stays where it is, whatever the weights are. Theory:
    :ref:`Task 3.5 <task-3-5>`.

    References
    ----------
    J. P. Lewis, K. Anjyo, T. Rhee, M. Zhang, F. Pighin, Z. Deng, *Practice and Theory of
    Blendshape Facial Models*, Eurographics State of the Art Reports, 2014.

    Examples
    --------
    Two vertices; the expression moves the second one up by 1:

    >>> from canim.character import delta_blendshape
    >>> neutral, shapes = [(3, 0, 0), (4, 0, 0)], [[(3, 0, 0), (4, 1, 0)]]
    >>> delta_blendshape(neutral, shapes, [2])
    array([[3., 0., 0.],
           [4., 2., 0.]])
    """
    table, start = _shapes(shapes), _real(neutral, "neutral")
    if start.shape != table.shape[1:]:
        raise ValueError(
            f"neutral must have the shape of each of the shapes, {table.shape[1:]}, "
            f"but has {start.shape}."
        )
    return _mix(table, _weights(weights, table), start.astype(table.dtype, copy=False))


class Face:
    r"""A neutral face and its expressions: the same vertices, moved.

    Parameters
    ----------
    neutral : array_like, shape (V, 3)
        The vertices of the neutral face, in any unit.
    expressions : mapping of str to array_like, shape (V, 3)
        The vertices of each expression by its name, in the unit of `neutral`.
    faces : array_like of int, shape (F, 3)
        The numbers of the three corners of each triangle.
    colors : array_like, shape (V, 3), optional
        Red, green and blue of each vertex, from 0 to 1.

    Attributes
    ----------
    neutral : ndarray, shape (V, 3)
        The neutral face.
    shapes : ndarray, shape (K, V, 3)
        All expressions, in the order of `expressions`; the neutral face is not among them.
    expressions : dict of str to ndarray, shape (V, 3)
        Each expression by its name: a view into `shapes`.
    faces : ndarray of int, shape (F, 3)
        The corners of the triangles.
    colors : ndarray, shape (V, 3), or None
        The colours of the vertices.

    Raises
    ------
    TypeError
        If an argument does not hold numbers of the right kind.
    ValueError
        If there is no expression, its vertices are not as many as those of `neutral`, a
        number is not finite, or a triangle names a vertex that is not there.

    Notes
    -----
    Vertex i is the same spot of the skin in every shape: the shapes have one topology.
    Theory: :ref:`Task 3.4 <task-3-4>`.

    References
    ----------
    J. P. Lewis, K. Anjyo, T. Rhee, M. Zhang, F. Pighin, Z. Deng, *Practice and Theory of
    Blendshape Facial Models*, Eurographics State of the Art Reports, 2014.

    Examples
    --------
    >>> from canim.character import Face, delta_blendshape
    >>> flat, tip = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 0), (1, 0, 0), (0, 1, 2)]
    >>> face = Face(flat, {"tip": tip}, [(0, 1, 2)])
    >>> face
    Face(3 vertices, 1 triangles, 1 expressions)
    >>> delta_blendshape(face.neutral, face.shapes, face.weights({"tip": 0.5}))[2]
    array([0., 1., 1.])
    """

    def __init__(
        self,
        neutral: ArrayLike,
        expressions: Mapping[str, ArrayLike],
        faces: ArrayLike,
        colors: ArrayLike | None = None,
    ) -> None:
        self.neutral = _vertices(neutral, "neutral")
        if not isinstance(expressions, Mapping):
            raise TypeError(
                f"expressions must map names to vertices, "
                f"but is of type {type(expressions).__name__}."
            )
        if not expressions:
            raise ValueError("expressions must hold one expression or more, but is empty.")
        names = list(expressions)
        self.shapes = np.empty((len(names), *self.neutral.shape))
        for row, name in zip(self.shapes, names):
            vertices = _vertices(expressions[name], f"expressions[{name!r}]")
            if len(vertices) != len(row):
                raise ValueError(
                    f"expressions[{name!r}] has {len(vertices)} vertices and neutral {len(row)}; "
                    f"every expression needs the same topology."
                )
            row[:] = vertices
        self.expressions: dict[str, Floats] = dict(zip(names, self.shapes))
        self.faces = _triangles(faces, len(self.neutral))
        self.colors = None if colors is None else _colors(colors, len(self.neutral))

    def __repr__(self) -> str:
        counts = {
            "vertices": len(self.neutral),
            "triangles": len(self.faces),
            "expressions": len(self.shapes),
        }
        return f"Face({', '.join(f'{count} {what}' for what, count in counts.items())})"

    def weights(self, chosen: Mapping[str, float]) -> Floats:
        """Return one weight for each of the shapes: those that are named, 0 for the others.

        Parameters
        ----------
        chosen : mapping of str to float
            Weights by the name of the expression, as ``{"smile_left": 1}``.

        Returns
        -------
        ndarray, shape (K,)
            The weights, in the order of `shapes`.

        Raises
        ------
        TypeError
            If `chosen` is no mapping or a weight is not a number.
        ValueError
            If there is no expression of a name, or a weight is not finite.
        """
        if not isinstance(chosen, Mapping):
            raise TypeError(
                f"chosen must map names to weights, but is of type {type(chosen).__name__}."
            )
        names = list(self.expressions)
        numbers = np.zeros(len(names))
        for name, weight in chosen.items():
            if name not in self.expressions:
                near = difflib.get_close_matches(str(name), names, n=1, cutoff=0)[0]
                raise ValueError(
                    f'chosen: there is no expression {name!r}; the nearest is "{near}".'
                )
            number = floats(weight, f"chosen[{name!r}]")
            if number.ndim:
                raise ValueError(
                    f"chosen[{name!r}] must be one number, but has shape {number.shape}."
                )
            numbers[names.index(name)] = number
        return numbers


def load_expressions(folder: str | os.PathLike[str]) -> Face:
    r"""Read a neutral face and its expressions from the OBJ files of a folder.

    Parameters
    ----------
    folder : str or path
        A folder with ``neutral.obj`` and one more OBJ file for each expression, all of one
        topology: the same vertices in the same order, moved, and the same faces. An expression
        may come without faces. Capitals in ``neutral.obj`` and ``.obj`` do not matter.

    Returns
    -------
    Face
        The expressions by the names of their files, in alphabetical order. Faces with four
        and more corners are split into triangles. The colours are those of ``neutral.obj``.
        Unit and axes are those of the files.

    Raises
    ------
    OSError
        If there is no such folder, or a file may not be read.
    TypeError
        If `folder` is not the name of a folder.
    ValueError
        If ``neutral.obj`` or every other OBJ file is missing, a file is damaged, or two files
        have one name or differ in topology; the message names them.

    Warns
    -----
    UserWarning
        If only some vertices of ``neutral.obj`` have a colour; then the face has none.

    Notes
    -----
    Vertices stay as they are in the file: none is merged or reordered. Of each file the
    vertices (``v x y z``, with colours ``v x y z r g b``) and faces (``f``) are read; texture
    coordinates, normals, materials and groups are passed over. Colours go up to 1, or up to
    255 where one is above 16.

    OBJ files do not say which way is up. `canim.plotting` draws faces with y up and seen from
    z. Where z is up, ``vertices[:, [0, 2, 1]] * (1, 1, -1)`` turns a shape.

    Theory: :ref:`Task 3.4 <task-3-4>`.

    References
    ----------
    J. P. Lewis, K. Anjyo, T. Rhee, M. Zhang, F. Pighin, Z. Deng, *Practice and Theory of
    Blendshape Facial Models*, Eurographics State of the Art Reports, 2014.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from pathlib import Path
    >>> from canim.character import load_expressions
    >>> with TemporaryDirectory() as folder:
    ...     for name, height in ("neutral", 0), ("tip", 2):
    ...         text = f"v 0 0 0\nv 1 0 0\nv 0 1 {height}\nf 1 2 3\n"
    ...         _ = Path(folder, f"{name}.obj").write_text(text)
    ...     face = load_expressions(folder)
    >>> list(face.expressions), face.faces.tolist()
    (['tip'], [[0, 1, 2]])
    """
    if not isinstance(folder, str | os.PathLike):
        raise TypeError(f"folder must be the name of a folder, but is {folder!r}.")
    first, files = _obj_files(Path(folder))
    neutral = _read_obj(first)
    expressions = {}
    for name, path in files.items():
        mesh = _read_obj(path, neutral)
        if len(mesh.vertices) != len(neutral.vertices):
            raise ValueError(
                f"folder: {path.name} has {len(mesh.vertices)} vertices and {first.name} "
                f"{len(neutral.vertices)}; every expression needs the same topology."
            )
        if not np.array_equal(mesh.triangles, neutral.triangles):
            raise ValueError(
                f"folder: {path.name} and {first.name} have different faces; "
                f"every expression needs the same topology."
            )
        expressions[name] = mesh.vertices
    return Face(neutral.vertices, expressions, neutral.triangles, neutral.colors)


def _obj_files(folder: Path) -> tuple[Path, dict[str, Path]]:
    """Return the file of the neutral face, and those of the expressions by name."""
    # A dot begins the names of files that a system keeps for itself.
    there = sorted(path for path in folder.iterdir() if not path.name.startswith("."))
    files: dict[str, Path] = {}
    for path in there:
        if path.suffix.lower() == ".obj":
            name = "neutral" if path.stem.lower() == "neutral" else path.stem
            if name in files:
                raise ValueError(
                    f"folder: {folder} holds both {files[name].name} and {path.name}; "
                    f"remove or rename one."
                )
            files[name] = path
    first = files.pop("neutral", None)
    needs = "it needs neutral.obj and one more OBJ file for each expression"
    if first is None:
        similar = [path.name for path in there if _looks_neutral(path.name)]
        names = " or ".join(similar[:3])
        rename = f" If {names} is the neutral face, save it as neutral.obj." if similar else ""
        raise ValueError(f"folder: {folder} holds no neutral.obj; {needs}.{rename}")
    if not files:
        raise ValueError(f"folder: {folder} holds no OBJ file beside {first.name}; {needs}.")
    return first, files


def _looks_neutral(name: str) -> bool:
    lower = name.lower()
    return "neutral" in lower or bool(difflib.get_close_matches("neutral.obj", [lower], cutoff=0.8))


class _Mesh(NamedTuple):
    """What an OBJ file holds; `tail` is its text from the first face on, if only faces follow."""

    vertices: Floats
    colors: Floats | None
    triangles: Integers
    tail: str | None


def _read_obj(path: Path, known: _Mesh | None = None) -> _Mesh:
    """Read an OBJ file; faces written as those of `known` are not read again."""
    text = "\n" + path.read_text(encoding="utf-8-sig", errors="replace")
    if "\\\n" in text:
        text = _CONTINUED.sub(_in_one_line, text)
    first = _FIRST_FACE.search(text)
    tail = text[first.start() :] if first else ""
    same = known is not None and tail == known.tail
    rows: list[list[float]] = []
    polygons: list[tuple[int, int, list[str]]] = []
    for number, line in enumerate((text.removesuffix(tail) if same else text).split("\n")):
        kind, *values = line.partition("#")[0].split() or [""]
        if kind == "v":
            try:
                rows.append([*map(float, values)])
            except ValueError:
                raise _broken(path, number, line, "v x y z") from None
            if len(values) < 3 or not math.isfinite(sum(rows[-1][:3])):
                raise _broken(path, number, line, "v x y z")
        elif kind == "f":
            polygons.append((number, len(rows), values))
    if not rows or (known is None and not polygons):
        missing = "faces" if rows else "vertices"
        raise ValueError(f"folder: {path.name} holds no {missing}, it is no mesh.")
    vertices = np.array([row[:3] for row in rows])
    if known is not None:
        triangles = _split(path, polygons, len(rows)) if polygons else known.triangles
        return _Mesh(vertices, None, triangles, None)
    only_faces_follow = polygons[0][1] == len(rows)
    return _Mesh(
        vertices,
        _read_colors(path, rows),
        _split(path, polygons, len(rows)),
        tail if only_faces_follow else None,
    )


def _in_one_line(found: re.Match[str]) -> str:
    """Join the lines; empty ones take their place, so that lines keep their numbers."""
    return found[0].replace("\\\n", " ") + "\n" * found[0].count("\\\n")


def _read_colors(path: Path, rows: list[list[float]]) -> Floats | None:
    """Return what stands behind x, y and z as colours from 0 to 1, if every vertex has one."""
    has_color = [len(row) >= 6 and math.isfinite(sum(row[3:6])) for row in rows]
    if not all(has_color):
        if max(map(len, rows)) >= 6:
            warnings.warn(
                f"folder: {path.name}, vertex {has_color.index(False) + 1}, has no colour red, "
                f"green, blue, so the face is read without colours.",
                UserWarning,
                stacklevel=4,
            )
        return None
    colors = np.array([row[3:6] for row in rows])
    return np.clip(colors / (255 if colors.max() > _COUNTED else 1), 0, 1)


def _split(path: Path, polygons: list[tuple[int, int, list[str]]], count: int) -> Integers:
    """Return the triangles of polygons: their lines, the vertices before them, their corners."""
    triangles: list[tuple[int, int, int]] = []
    for number, before, values in polygons:
        try:
            given = [int(value.partition("/")[0]) for value in values]
        except ValueError:
            given = []
        # Vertices are counted from one; from minus one backwards from where the line stands.
        corners = [corner - 1 if corner >= 0 else before + corner for corner in given]
        if len(corners) < 3 or not all(0 <= corner < count for corner in corners):
            line = " ".join(["f", *values])
            raise _broken(path, number, line, f"f and three or more of the vertices 1 to {count}")
        triangles += [(corners[0], *edge) for edge in pairwise(corners[1:])]
    return np.array(triangles)


def _broken(path: Path, number: int, line: str, expected: str) -> ValueError:
    return ValueError(
        f"folder: {path.name}, line {number}, must be {expected}, but is {line.strip()!r:.80}."
    )


def _real(value: ArrayLike, name: str) -> NDArray[Any]:
    """Return `value` as float32 if it is that, otherwise as float64, whatever its numbers are."""
    array = real(value, name)
    return array if array.dtype == np.float32 else array.astype(np.float64, copy=False)


def _shapes(value: ArrayLike) -> NDArray[Any]:
    """Return a float array of shape (K, V, 3); an array is not copied."""
    if isinstance(value, list | tuple):
        counts = [len(shape) if hasattr(shape, "__len__") else 0 for shape in value]
        for k, count in enumerate(counts):
            if count != counts[0]:
                raise ValueError(
                    f"shapes[{k}] has {count} vertices and shapes[0] {counts[0]}; "
                    f"all shapes need the same topology."
                )
    array = _real(value, "shapes")
    if array.ndim != 3 or array.shape[2] != 3 or array.size == 0:
        raise ValueError(
            f"shapes must hold one or more shapes of (x, y, z) vertices, shape (K, V, 3), "
            f"but has shape {array.shape}."
        )
    return array


def _weights(value: ArrayLike, shapes: NDArray[Any]) -> NDArray[Any]:
    """Return finite weights of the type of `shapes`, one for each, or a row of them a frame."""
    weights = floats(value, "weights")
    if weights.ndim not in (1, 2) or weights.shape[-1] != len(shapes):
        raise ValueError(
            f"weights must hold one number for each of the {len(shapes)} shapes, or a row of "
            f"them for each frame, but has shape {weights.shape}."
        )
    with np.errstate(over="ignore"):
        return weights.astype(shapes.dtype, copy=False)


@np.errstate(over="ignore", invalid="ignore")
def _mix(
    shapes: NDArray[Any], weights: NDArray[Any], neutral: NDArray[Any] | None = None
) -> NDArray[Any]:
    """Return the weighted sums of the shapes, of their differences from `neutral` if given.

    The shapes are read once, and no difference is stored: the neutral face is added as often
    as all differences take it away.
    """
    rows, table = shapes.reshape(len(shapes), -1), np.atleast_2d(weights)
    mixed = np.empty((len(table), rows.shape[1]), dtype=shapes.dtype)
    rest = (1 - table.sum(axis=1, keepdims=True, dtype=np.float64)).astype(shapes.dtype)
    fits, step = True, _BLOCK // max(1, min(8, len(table)))
    for begin in range(0, rows.shape[1], step):
        block = slice(begin, begin + step)
        part = np.matmul(table, rows[:, block], out=mixed[:, block])
        if neutral is not None:
            part += rest * neutral.ravel()[block]
        # A sum of squares that is finite tells quickly that all numbers are.
        fits = fits and bool(np.isfinite(np.vecdot(part, part)).all())
    result = mixed.reshape(*weights.shape[:-1], *shapes.shape[1:])
    if not fits and not np.isfinite(result).all():
        for name, value in (("neutral", neutral), ("shapes", shapes)):
            if value is not None:
                floats(value, name)
        raise ValueError("shapes, weights: too large, the result does not fit a float.")
    return result


def _vertices(value: ArrayLike, name: str) -> Floats:
    array = points(value, name)
    if array.shape[1] != 3:
        raise ValueError(
            f"{name} must hold one vertex (x, y, z) a row, shape (V, 3), "
            f"but has shape {array.shape}."
        )
    return array.copy()


def _triangles(value: ArrayLike, count: int) -> Integers:
    array = real(value, "faces")
    if array.ndim != 2 or array.shape[1] != 3 or len(array) == 0:
        raise ValueError(
            f"faces must hold the three corners of a triangle a row, shape (F, 3), "
            f"but has shape {array.shape}."
        )
    if array.dtype.kind not in "iu":
        raise TypeError(f"faces must hold whole numbers, but is of type {array.dtype}.")
    if array.min() < 0 or array.max() >= count:
        wrong = array.min() if array.min() < 0 else array.max()
        raise ValueError(f"faces must hold numbers from 0 to {count - 1}, but holds {wrong}.")
    return array.astype(np.int64)


def _colors(value: ArrayLike, count: int) -> Floats:
    array = points(value, "colors")
    if array.shape != (count, 3):
        raise ValueError(
            f"colors must hold red, green, blue for each of the {count} vertices, "
            f"but has shape {array.shape}."
        )
    if array.min() < 0 or array.max() > 1:
        wrong = array.min() if array.min() < 0 else array.max()
        raise ValueError(f"colors must hold numbers from 0 to 1, but holds {wrong:g}.")
    return array.copy()
