"""Task 2.2: what "done" means for bilinear interpolation and for warping backward.

The images are numbered, so that a colour tells where it comes from; mixed colours then are
places between pixels. One more image has colours without such an order.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.spatial import Delaunay

from canim import warping
from canim.checks.picture import IMAGES
from canim.checks.run import number
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task
from canim.checks.warps import (
    EDGE,
    HOLE,
    SQUARE,
    STEP,
    WIDE,
    affine_map,
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

HALF = 0.5 + 1e-6  # the most that rounding changes a colour


def mixed(image: Any, u: Any, v: Any, shares: Callable[..., Any] | None = None) -> Any:
    """Return the bilinear mix at each (u, v), or one with other shares of the four pixels."""
    height, width = image.shape[:2]
    u, v = np.clip(u, 0, width - 1), np.clip(v, 0, height - 1)
    column = np.minimum(u.astype(int), width - 2)
    row = np.minimum(v.astype(int), height - 2)
    f, g = (u - column)[..., None], (v - row)[..., None]
    four = [image[row + j, column + i].astype(float) for j in (0, 1) for i in (0, 1)]
    if shares is None:
        shares = _shares
    return sum(share * colour for share, colour in zip(shares(f, g), four))


def _shares(f: Any, g: Any) -> tuple[Any, ...]:
    """Return the shares of the pixels: upper left, upper right, lower left, lower right."""
    return (1 - f) * (1 - g), f * (1 - g), (1 - f) * g, f * g


def _bilinear(image: Any, u: float, v: float) -> Floats:
    colour: Floats = mixed(image, np.asarray(u), np.asarray(v))
    return colour


def _nearest(image: Any, u: Any, v: Any) -> Any:
    height, width = image.shape[:2]
    return image[up(v).clip(0, height - 1), up(u).clip(0, width - 1)].astype(float)


def _cut_off(image: Any, u: Any, v: Any) -> Any:
    height, width = image.shape[:2]
    return image[cut(v).clip(0, height - 1), cut(u).clip(0, width - 1)].astype(float)


def asked(
    image: Any,
    source: Floats,
    target: Floats,
    triangles: Any,
    *,
    read: Callable[[Any, Any, Any], Any] = mixed,
    find_in: str = "target",
    back: Callable[[Floats, Floats], Floats] = lambda source, target: affine_map(target, source),
    exchanged: bool = False,
    least: float = -EDGE,
    enough: Callable[..., Any] = np.all,
    weigh: str = "xy",
    move: str = "xy",
    first: int = 0,
    rows: int = 0,
    cols: int = 0,
    swap_sizes: bool = False,
    finish: Callable[[Floats], Floats] = np.asarray,
) -> Floats:
    """Return the image warped backward, right or in one of the ways in which it goes wrong."""
    height, width = image.shape[:2]
    last = (width, height) if swap_sizes else (height, width)
    y, x = np.mgrid[first : min(last[0], height) - rows, first : min(last[1], width) - cols]
    warped = np.full(image.shape, HOLE)
    for corners in triangles:
        corners_found = (source if find_in == "source" else target)[corners]
        found = inside(corners_found, *((x, y) if weigh == "xy" else (y, x)), least, enough)
        a, b = x[found], y[found]
        point = [a, b, 0 * a + 1] if move == "xy" else [b, a, 0 * a + 1]
        u, v = (back(source[corners], target[corners]) @ point)[:2]
        warped[(a, b) if exchanged else (b, a)] = read(image, u, v)
    return finish(warped)


def _warped(program: Any, *args: Any) -> Floats:
    """Return the student's image; colours that only rounding makes different are the same."""
    got: Floats = program.warp_backward(*args)
    expected = asked(*args)
    near: Any = np.abs(got - expected) <= HALF
    result: Floats = np.where(near.all(axis=2, keepdims=True), expected, got)
    return result


def _filled(program: Any, *args: Any) -> Floats:
    return is_filled(program.warp_backward(*args))


def _in_words(colour: Floats) -> str:
    if (colour == HOLE).all():
        return "a hole"
    if not 6 <= colour[2] <= 8:
        return f"the colour ({', '.join(map(number, colour))})"
    u, v = colour[:2] / STEP
    return f"the colour at ({u:.1f}, {v:.1f})"


def _describe(got: Floats, expected: Floats, *args: Any) -> str:
    return describe(got, expected, *args, in_words=_in_words)


def _describe_colour(got: Floats, expected: Floats, *args: Any) -> str:
    """Say it with plain numbers: this image has no order."""

    def in_words(colour: Floats) -> str:
        if (colour == HOLE).all():
            return "a hole"
        return f"({', '.join(f'{part:.0f}' for part in colour)})"

    return describe(got, expected, *args, in_words=in_words)


def _channel(index: tuple[int, ...], image: Any, u: float, v: float) -> str:
    return f"{('red', 'green', 'blue')[index[0]]} at ({u:g}, {v:g})"


def _byte_mix(image: Any, u: float, v: float) -> Floats:
    """Return the mix with differences of colours, which bytes cannot hold."""
    height, width = image.shape[:2]
    column, row = min(int(u), width - 2), min(int(v), height - 2)
    f, g = u - column, v - row
    (c00, c10), (c01, c11) = image[row : row + 2, column : column + 2]
    upper, lower = c00 + f * (c10 - c00), c01 + f * (c11 - c01)
    colour: Floats = upper + g * (lower - upper)
    return colour


def _mix(shares: Callable[..., Any]) -> dict[str, Any]:
    return {"bilinear": lambda image, u, v: mixed(image, np.asarray(u), np.asarray(v), shares)}


def _rows_and_columns(image: Any, u: float, v: float) -> Any:
    """Read image[column, row]; only square images allow it everywhere."""
    column, row = min(int(u), image.shape[1] - 2), min(int(v), image.shape[0] - 2)
    shares = _shares(u - column, v - row)
    places = [(column, row), (column + 1, row), (column, row + 1), (column + 1, row + 1)]
    return sum(share * image[place].astype(float) for share, place in zip(shares, places))


def _backward(**change: Any) -> dict[str, Any]:
    return {"warp_backward": lambda *args: asked(*args, **{"finish": np.round} | change)}


def _triangles_of_the_source(image: Any, source: Floats, target: Floats, _: Any) -> Floats:
    return asked(image, source, target, Delaunay(source).simplices, finish=np.round)


def _first_triangle(image: Any, source: Floats, target: Floats, triangles: Any) -> Floats:
    return asked(image, source, target, triangles[:1], finish=np.round)


def _still() -> tuple[Floats, Floats, Any]:
    """Return triangles whose target corners are whole numbers, so that pixels lie on edges."""
    target, source, triangles = shifted()
    return source, target, triangles


def _only_edges(got: Floats, expected: Floats, *args: Any) -> bool:
    """Tell whether pixels are missing on the edges of triangles, and nothing else is wrong."""
    _, _, target, triangles = args
    y, x = np.nonzero(got != expected)
    lost = got[y, x] == 0
    for corners in triangles:
        lost &= ~inside(target[corners], x, y, EDGE)
    return bool(lost.all())


# Colours without an order, none of them near that of a hole.
_random = np.random.default_rng(22)
SPOTS: Any = _random.integers(0, 200, (20, 20, 3)).astype(np.uint8)

MIX, INSIDE, PLACE, COLOUR, WIDE_IMAGE = "bilinear", "inside", "place", "colour", "wide image"
WARPS = (PLACE, COLOUR, WIDE_IMAGE)

TASK = Task(
    id="2.2",
    name="warp_backward",
    title="Ask where every pixel comes from",
    block="warping",
    writes="a mix of four pixels and a loop over pixels, about 12 lines",
    minutes=45,
    figure="Fig. 9, without the steps in between",
    questions=3,
    builds_on=("2.1",),
    functions=(
        Function(
            "bilinear",
            "bilinear(image, u, v)",
            Array(lambda image, u, v: (3,), "one colour, three numbers"),
            _bilinear,
        ),
        Function(
            "warp_backward",
            "warp_backward(image, source, target, triangles)",
            Array(lambda image, *_: image.shape, "an image as large as the one it is given"),
            asked,
        ),
    ),
    parts=(
        Part(
            MIX,
            lambda program, image, u, v: program.bilinear(image, u, v),
            tuple(
                Case((SPOTS, u, v))
                for u, v in [(3.25, 7.0), (4.0, 6.75), (8.25, 2.5), (0.0, 0.0), (19.0, 19.0)]
            ),
            _channel,
            unwritten=nothing,
        ),
        Part(
            INSIDE,
            _filled,
            (Case((SQUARE, *_still())),),
            unwritten=nothing,
            describe=describe,
            picture=IMAGES,
        ),
        Part(
            PLACE,
            _warped,
            (Case((SQUARE, *toy(20, 20))),),
            unwritten=nothing,
            describe=_describe,
            picture=IMAGES,
        ),
        Part(
            COLOUR,
            _warped,
            (Case((SPOTS, *toy(20, 20))),),
            unwritten=nothing,
            describe=_describe_colour,
            picture=IMAGES,
        ),
        Part(
            WIDE_IMAGE,
            _warped,
            (Case((WIDE, *toy(24, 15))),),
            unwritten=nothing,
            describe=_describe,
            picture=IMAGES,
        ),
    ),
    lines={
        "bilinear": "return the mix of both",
        "inside": "inside: if no weight is below -1e-9",
        "place": "place: inverse of A times (x, y, 1)",
        "colour": "colour: bilinear, at this place",
        "wide image": "for each row y and each column x of the new image:",
    },
    mistakes=(
        Mistake(
            "f on the wrong side",
            "From left to right the shares are exchanged. If f is 0, which pixel is it?",
            _mix(lambda f, g: _shares(1 - f, g)),
            parts=(MIX,),
            source="study: computation",
            line="mix the two pixels of the upper row",
        ),
        Mistake(
            "g on the wrong side",
            "From top to bottom the shares are exchanged. If g is 0, which row is it?",
            _mix(lambda f, g: _shares(f, 1 - g)),
            parts=(MIX,),
            source="study: computation",
        ),
        Mistake(
            "both shares on the wrong side",
            "Both pairs of shares are exchanged: near a pixel its share must be large.",
            _mix(lambda f, g: _shares(1 - f, 1 - g)),
            parts=(MIX,),
            source="study: computation",
            line="f, g: how far u, v are from it",
        ),
        Mistake(
            "f and g exchanged",
            "Which of f and g belongs to left and right, and which to top and bottom?",
            _mix(lambda f, g: _shares(g, f)),
            parts=(MIX,),
            source="study: variable",
            line="f, g: how far u, v are from it",
        ),
        Mistake(
            "only the upper row",
            "Only the upper row is mixed. What about g and the lower row?",
            _mix(lambda f, g: _shares(f, 0 * g)),
            parts=(MIX,),
            source="study: computation",
            line="mix the two pixels of the lower row",
        ),
        Mistake(
            "only the left column",
            "Only the left column is mixed. What about f and the right column?",
            _mix(lambda f, g: _shares(0 * f, g)),
            parts=(MIX,),
            source="study: computation",
            line="mix the two pixels of the upper row",
        ),
        Mistake(
            "columns read as rows",
            "Which index of the image comes first, the row or the column?",
            {"bilinear": _rows_and_columns},
            parts=(MIX,),
            source="paper: the loops of Figs. 7 and 8 mix x and y",
            line="column, row: of the pixel above and to the left",
        ),
        Mistake(
            "differences of bytes",
            "A difference of two colours cannot be negative here. Keep to weights times colours.",
            {"bilinear": _byte_mix},
            parts=(MIX,),
            source="thread: stackoverflow.com/q/26678132",
            line="mix the two pixels of the upper row",
        ),
        Mistake(
            "one pixel instead of four",
            "This is the colour of the nearest pixel. It takes a mix of four.",
            {"bilinear": lambda image, u, v: _nearest(image, np.asarray(u), np.asarray(v))},
            parts=(MIX,),
            source="study: concept",
            line="mix the two pixels of the upper row",
        ),
        Mistake(
            "nearest instead of bilinear",
            "Each colour is that of one pixel. Use bilinear where you read the image.",
            _backward(read=_nearest),
            parts=WARPS,
            source="neighbour: Task 2.1 takes whole pixels",
            line="colour: bilinear, at this place",
        ),
        Mistake(
            "decimals cut off",
            "Each colour is that of one pixel, above and to the left. Use bilinear to read.",
            _backward(read=_cut_off),
            parts=WARPS,
            source="thread: stackoverflow.com/q/77282238",
            line="colour: bilinear, at this place",
        ),
        Mistake(
            "colours cut off",
            "Colours are cut off, not rounded, at the end.",
            _backward(finish=np.trunc),
            parts=WARPS,
            source="thread: astype(int) truncates and doesn't round, numpy-discussion, 2011",
            line="colour: bilinear, at this place",
        ),
        Mistake(
            "looked up in the source",
            "The pixels (x, y) are those of the new image: in which points do they lie?",
            _backward(find_in="source"),
            source="matlab: looks triangles up among the source points",
            line="weights of (x, y) in the target triangle",
        ),
        Mistake(
            "map not inverted",
            "A goes from the source to the target. Which way do you have to go here?",
            _backward(back=affine_map),
            source="neighbour: Task 2.1 takes A itself",
            line="place: inverse of A times (x, y, 1)",
        ),
        Mistake(
            "point to the left of the map",
            "A column stands to the right of its matrix. Where does [x, y, 1] stand?",
            _backward(back=lambda source, target: affine_map(target, source).T),
            source="trial",
            line="place: inverse of A times (x, y, 1)",
        ),
        Mistake(
            "one weight is enough",
            "Pixels outside are filled as well. Look at the weights, and at how many you compare.",
            _backward(enough=np.any),
            source="trial",
            line="inside: if no weight is below -1e-9",
        ),
        Mistake(
            "outside instead of inside",
            "The pixels outside are filled, and those inside are not.",
            _backward(enough=not_all),
            source="trial",
            line="inside: if no weight is below -1e-9",
        ),
        Mistake(
            "weights of another pixel",
            "x is the column and y the row: which comes first where the weights are calculated?",
            _backward(weigh="yx"),
            parts=WARPS,
            source="trial",
            line="weights of (x, y) in the target triangle",
        ),
        Mistake(
            "place of another pixel",
            "x is the column and y the row: which comes first where the place is calculated?",
            _backward(move="yx"),
            parts=WARPS,
            source="trial",
            line="place: inverse of A times (x, y, 1)",
        ),
        Mistake(
            "only the first triangle",
            "Only the first triangle is done. Does return stand inside of the loop?",
            {"warp_backward": _first_triangle},
            source="trial",
            line="for each triangle:",
        ),
        Mistake(
            "first row and column left out",
            "The first row and the first column are left out: counting starts at 0.",
            _backward(first=1),
            parts=(PLACE, COLOUR),
            source="trial",
            line="for each row y and each column x of the new image:",
        ),
        Mistake(
            "rim left out",
            "The rim of the image is left out: loops over pixels go from 0 to the last.",
            _backward(first=1, rows=1, cols=1),
            parts=(PLACE, COLOUR),
            source="trial",
            line="for each row y and each column x of the new image:",
        ),
        Mistake(
            "warped forward",
            "This sends pixels of the old image. Go through those of the new one.",
            {"warp_backward": sent},
            source="thread: stackoverflow.com/q/77282238",
            line="for each row y and each column x of the new image:",
        ),
        Mistake(
            "triangles of the source points",
            "Use the triangles that are given. Others turn over on the way.",
            {"warp_backward": _triangles_of_the_source},
            source="matlab: triangles of the source points turn over",
            line="for each triangle:",
        ),
        Mistake(
            "edges left out",
            "Pixels on the edges of triangles are lost. Which weights has a pixel on an edge?",
            _backward(least=EDGE),
            _only_edges,
            (INSIDE,),
            source="study: condition",
            line="inside: if no weight is below -1e-9",
        ),
        Mistake(
            "x and y exchanged",
            "Which comes first where you write a pixel, and which in [x, y, 1]?",
            _backward(exchanged=True),
            parts=(PLACE, COLOUR),
            source="paper: the loops of Figs. 7 and 8 mix x and y",
            line="for each row y and each column x of the new image:",
        ),
        Mistake(
            "u and v exchanged",
            "Where you read the colour: is u the column or the row?",
            _backward(read=lambda image, u, v: mixed(image, v, u)),
            parts=(PLACE, COLOUR),
            source="paper: the loops of Figs. 7 and 8 mix x and y",
            line="colour: bilinear, at this place",
        ),
        Mistake(
            "height and width exchanged",
            "How far does y go, and how far x? A square image does not tell.",
            _backward(swap_sizes=True),
            source="matlab: loop bounds right for square images only",
            line="for each row y and each column x of the new image:",
        ),
        Mistake(
            "last row left out",
            "The last row of the image is left out.",
            _backward(rows=1),
            source="study: loop",
            line="for each row y and each column x of the new image:",
        ),
        Mistake(
            "last column left out",
            "The last column of the image is left out.",
            _backward(cols=1),
            source="study: loop",
            line="for each row y and each column x of the new image:",
        ),
        Mistake(
            "last row and column left out",
            "The last row and the last column are left out: range ends before its end.",
            _backward(rows=1, cols=1),
            source="study: loop",
            line="for each row y and each column x of the new image:",
        ),
    ),
    canim_functions=(warping.warp_backward,),
)
