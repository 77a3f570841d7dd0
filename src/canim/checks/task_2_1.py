"""Task 2.1: what "done" means for the affine map and for warping forward.

Where several pixels arrive at one place, each of them is right, whatever the order in which
they came.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial import Delaunay

from canim import warping
from canim.checks.picture import IMAGES
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task
from canim.checks.warps import (
    EDGE,
    SQUARE,
    STEP,
    WIDE,
    affine_map,
    columns,
    cut,
    describe,
    inside,
    is_filled,
    not_all,
    nothing,
    sent,
    shifted,
    toy,
    up,
)


def _down(numbers: Floats) -> Any:
    return np.floor(numbers).astype(int)


def _next(numbers: Floats) -> Any:
    return np.ceil(numbers).astype(int)


def _warped(program: Any, *args: Any) -> Floats:
    """Return the student's image; a pixel that may be where it is counts as the expected one."""
    image, source, target, triangles = args
    got: Floats = program.warp_forward(*args)
    expected = sent(*args)
    height, width = image.shape[:2]
    u, v = got[..., 0] / STEP, got[..., 1] / STEP
    may = (got[..., 2] == 7) & (u < width) & (v < height) & (u % 1 == 0) & (v % 1 == 0)
    y, x = np.nonzero(may)
    a, b = u[may].astype(int), v[may].astype(int)
    right = np.zeros(len(x), dtype=bool)
    for corners in triangles:
        place = up((affine_map(source[corners], target[corners]) @ [a, b, 0 * a + 1])[:2])
        right |= inside(source[corners], a, b) & (place == [x, y]).all(axis=0)
    result: Floats = got.copy()
    result[y[right], x[right]] = expected[y[right], x[right]]
    return result


def _filled(program: Any, *args: Any) -> Floats:
    return is_filled(program.warp_forward(*args))


def _entry(index: tuple[int, ...], *args: Any) -> str:
    return f"row {index[0]}, column {index[1]} of A"


def _outwards() -> tuple[Floats, Floats, Any]:
    """Return triangles that reach beyond the image."""
    a = np.array([[0.0, 0.0], [19.0, 0.0], [0.0, 19.0], [19.0, 19.0]])
    b = np.array([[-4.31, -3.77], [23.63, 0.41], [1.37, 24.13], [21.81, 22.97]])
    return a, b, np.array([[0, 1, 2], [1, 3, 2]])


_CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
_TURNED = np.array([[5.0, 7.0], [5.0, 9.0], [2.0, 7.0]])
_TRIANGLE = np.array([[78.0, 73.0], [78.0, 186.0], [147.0, 186.0]])
_OTHER = np.array([[120.0, 25.0], [157.0, 139.0], [218.0, 47.0]])


def _forward(**change: Any) -> dict[str, Any]:
    return {"warp_forward": lambda *args: sent(*args, **change)}


def _first_triangle(image: Floats, source: Floats, target: Floats, triangles: Any) -> Floats:
    return sent(image, source, target, triangles[:1])


def _triangles_of_the_source(image: Floats, source: Floats, target: Floats, _: Any) -> Floats:
    return sent(image, source, target, Delaunay(source).simplices)


def only_edges(got: Floats, expected: Floats, *args: Any) -> bool:
    """Tell whether pixels are missing on the edges of triangles, and nothing else is wrong."""
    _, source, _, triangles = args
    y, x = np.nonzero(got != expected)
    lost = np.ones(len(x), dtype=bool)
    for corners in triangles:
        lost &= ~inside(source[corners], x, y, EDGE)
    return bool(lost.all() and (got[y, x] == 0).all())


MAP, INSIDE, PLACE, COLOUR, WIDE_IMAGE = "affine map", "inside", "place", "colour", "wide image"
WARPS = (INSIDE, PLACE, COLOUR, WIDE_IMAGE)

TASK = Task(
    id="2.1",
    name="warp_forward",
    title="Send every pixel to its new place",
    block="warping",
    writes="an affine map and a loop over pixels, about 12 lines",
    minutes=45,
    figure="Fig. 9, without the steps in between",
    questions=3,
    functions=(
        Function(
            "affine_map",
            "affine_map(source, target)",
            Array(lambda source, target: (3, 3), "a matrix of three rows and three columns"),
            affine_map,
        ),
        Function(
            "warp_forward",
            "warp_forward(image, source, target, triangles)",
            Array(lambda image, *_: image.shape, "an image as large as the one it is given"),
            sent,
        ),
    ),
    parts=(
        Part(
            MAP,
            lambda program, source, target: program.affine_map(source, target),
            (
                Case((_TRIANGLE, _OTHER), "(78, 73), (78, 186), (147, 186) to B"),
                Case((_CORNERS, _TURNED), "(0, 0), (1, 0), (0, 1) to (5, 7), (5, 9), (2, 7)"),
            ),
            _entry,
        ),
        Part(
            INSIDE,
            _filled,
            (Case((SQUARE, *shifted())),),
            unwritten=nothing,
            describe=describe,
            picture=IMAGES,
        ),
        Part(
            PLACE,
            _filled,
            (Case((SQUARE, *toy(20, 20))), Case((SQUARE, *_outwards()))),
            unwritten=nothing,
            describe=describe,
            picture=IMAGES,
        ),
        Part(
            COLOUR,
            _warped,
            (Case((SQUARE, *toy(20, 20))), Case((SQUARE, *shifted()))),
            unwritten=nothing,
            describe=describe,
            picture=IMAGES,
        ),
        Part(
            WIDE_IMAGE,
            _warped,
            (Case((WIDE, *toy(24, 15))),),
            unwritten=nothing,
            describe=describe,
            picture=IMAGES,
        ),
    ),
    lines={
        "affine map": "affine map: A with A T_source = T_target",
        "inside": "inside: if no weight is below -1e-9",
        "place": "place: A times (u, v, 1), rounded",
        "colour": "colour: if the place is in the image, copy the pixel to it",
        "wide image": "for each row v and each column u:",
    },
    mistakes=(
        Mistake(
            "points as rows",
            "This matrix fits points that are rows. Here each point is a column, to its right.",
            {"affine_map": lambda source, target: affine_map(source, target).T},
            parts=(MAP,),
            source="paper: Section 5 multiplies points as rows",
            line="corners as columns: T_source and T_target",
        ),
        Mistake(
            "wrong order of the product",
            "A stands to the left of T_source. On which side must the inverse stand?",
            {"affine_map": lambda s, t: np.linalg.inv(columns(s)) @ columns(t)},
            parts=(MAP,),
            source="paper: Section 5 multiplies points as rows",
        ),
        Mistake(
            "map inverted",
            "This is the way back: it takes the target corners to the source corners.",
            {"affine_map": lambda source, target: affine_map(target, source)},
            parts=(MAP,),
            source="study: concept",
        ),
        Mistake(
            "number by number",
            "The star multiplies number by number. Which sign multiplies matrices?",
            {"affine_map": lambda s, t: columns(t) * np.linalg.inv(columns(s))},
            parts=(MAP,),
            source="trial",
        ),
        Mistake(
            "point to the left of the map",
            "A column stands to the right of its matrix. Where does [u, v, 1] stand?",
            _forward(make_map=lambda source, target: affine_map(source, target).T),
            source="trial",
            line="place: A times (u, v, 1), rounded",
        ),
        Mistake(
            "pixels sent back",
            "The pixels move the wrong way. From where to where does A go?",
            _forward(make_map=lambda source, target: affine_map(target, source)),
            source="study: concept",
            line="place: A times (u, v, 1), rounded",
        ),
        Mistake(
            "decimals cut off",
            "Every place is moved up and to the left: int alone cuts the decimals off.",
            _forward(round_to=cut),
            source="thread: astype(int) truncates and doesn't round, numpy-discussion, 2011",
            line="place: A times (u, v, 1), rounded",
        ),
        Mistake(
            "rounded down",
            "Every place is moved up and to the left: floor alone rounds down.",
            _forward(round_to=_down),
            source="trial",
            line="place: A times (u, v, 1), rounded",
        ),
        Mistake(
            "rounded up",
            "Every place is moved down and to the right: ceil rounds up.",
            _forward(round_to=_next),
            source="trial",
            line="place: A times (u, v, 1), rounded",
        ),
        Mistake(
            "one weight is enough",
            "Pixels outside are sent as well. Look at the weights, and at how many you compare.",
            _forward(enough=np.any),
            source="trial",
            line="inside: if no weight is below -1e-9",
        ),
        Mistake(
            "outside instead of inside",
            "The pixels outside are sent, and those inside are not.",
            _forward(enough=not_all),
            source="trial",
            line="inside: if no weight is below -1e-9",
        ),
        Mistake(
            "weights of another pixel",
            "u is the column and v the row: which comes first where the weights are calculated?",
            _forward(weigh="vu"),
            parts=WARPS[1:],
            source="trial",
            line="weights of (u, v) in the source triangle",
        ),
        Mistake(
            "place of another pixel",
            "u is the column and v the row: which comes first where the place is calculated?",
            _forward(move="vu"),
            parts=WARPS[1:],
            source="trial",
            line="place: A times (u, v, 1), rounded",
        ),
        Mistake(
            "weights and place of another pixel",
            "u is the column and v the row: which comes first in [u, v, 1]?",
            _forward(weigh="vu", move="vu"),
            parts=WARPS[1:],
            source="trial",
            line="weights of (u, v) in the source triangle",
        ),
        Mistake(
            "looked up in the target",
            "In which of the two sets of points does the pixel (u, v) lie?",
            _forward(find_in="target"),
            source="matlab: looks triangles up among the source points",
            line="weights of (u, v) in the source triangle",
        ),
        Mistake(
            "triangles of the source points",
            "Use the triangles that are given. Others turn over on the way.",
            {"warp_forward": _triangles_of_the_source},
            source="matlab: triangles of the source points turn over",
            line="for each triangle:",
        ),
        Mistake(
            "edges left out",
            "Pixels on the edges of triangles are lost. Which weights has a pixel on an edge?",
            _forward(least=EDGE),
            only_edges,
            (INSIDE,),
            source="study: condition",
            line="inside: if no weight is below -1e-9",
        ),
        Mistake(
            "written with x first",
            "Where you write a pixel: does the row or the column come first?",
            _forward(write="xy"),
            parts=(PLACE, COLOUR),
            source="paper: the loops of Figs. 7 and 8 mix x and y",
            line="colour: if the place is in the image, copy the pixel to it",
        ),
        Mistake(
            "read with u first",
            "Where you read a pixel: does the row or the column come first?",
            _forward(read="uv"),
            parts=(COLOUR,),
            source="paper: the loops of Figs. 7 and 8 mix x and y",
            line="colour: if the place is in the image, copy the pixel to it",
        ),
        Mistake(
            "x and y exchanged",
            "Rows and columns are exchanged where you read and where you write.",
            _forward(read="uv", write="xy"),
            parts=(PLACE, COLOUR),
            source="paper: the loops of Figs. 7 and 8 mix x and y",
            line="colour: if the place is in the image, copy the pixel to it",
        ),
        Mistake(
            "fetched instead of sent",
            "The pixel (u, v) is read at (u, v) and written at its place, not the other way round.",
            _forward(write="vu"),
            source="trial",
            line="colour: if the place is in the image, copy the pixel to it",
        ),
        Mistake(
            "height and width exchanged where it ends",
            "Is x below the width, and y below the height? A square image does not tell.",
            _forward(bounds="yx"),
            source="trial",
            line="colour: if the place is in the image, copy the pixel to it",
        ),
        Mistake(
            "only the first triangle",
            "Only the first triangle is done. Does return stand inside of the loop?",
            {"warp_forward": _first_triangle},
            source="trial",
            line="for each triangle:",
        ),
        Mistake(
            "first row and column left out",
            "The first row and the first column are left out: counting starts at 0.",
            _forward(first=1),
            parts=(PLACE, COLOUR),
            source="trial",
            line="for each row v and each column u:",
        ),
        Mistake(
            "rim left out",
            "The rim of the image is left out: loops over pixels go from 0 to the last.",
            _forward(first=1, rows=1, cols=1),
            parts=(PLACE, COLOUR),
            source="trial",
            line="for each row v and each column u:",
        ),
        Mistake(
            "height and width exchanged",
            "How far does v go, and how far u? A square image does not tell.",
            _forward(swap_sizes=True),
            source="matlab: loop bounds right for square images only",
            line="for each row v and each column u:",
        ),
        Mistake(
            "last row left out",
            "The last row of the image is left out.",
            _forward(rows=1),
            source="study: loop",
            line="for each row v and each column u:",
        ),
        Mistake(
            "last column left out",
            "The last column of the image is left out.",
            _forward(cols=1),
            source="study: loop",
            line="for each row v and each column u:",
        ),
        Mistake(
            "last row and column left out",
            "The last row and the last column are left out: range ends before its end.",
            _forward(rows=1, cols=1),
            source="study: loop",
            line="for each row v and each column u:",
        ),
        Mistake(
            "negative places",
            "A place below 0 is outside as well; Python counts it from the other end.",
            _forward(wrap=True),
            source="paper: Figs. 7 and 8 do not ask whether a place is in the image",
            line="colour: if the place is in the image, copy the pixel to it",
        ),
    ),
    canim_functions=(warping.affine_transforms, warping.warp_forward),
)
