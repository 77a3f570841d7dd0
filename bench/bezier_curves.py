"""Time Bézier curves, their length and equal steps against bezier, SciPy and svgpathtools.

Run `python bench bezier_curves` with `src` on the path, one thread.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import bezier
import numpy as np
import svgpathtools
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.interpolate import BPoly
from timing import Row, compare, typical

from canim.interpolation import (
    arc_length,
    bezier_curve,
    de_casteljau,
    equidistant_parameters,
    equidistant_points,
)

Points = NDArray[np.float64]
CUBIC = np.array([[5, -10], [9, 38], [38, -5], [45, 15]], dtype=float)
# Cubics whose length is easy or hard to find, the length, and the goal.
LENGTHS: dict[str, tuple[list[list[float]], float, float]] = {
    "the paper's cubic": ([[5, -10], [9, 38], [38, -5], [45, 15]], 59.886741958389137, 1.4),
    "a gentle cubic": ([[0, 0], [1, 2], [3, 3], [4, 1]], 5.3700156190519618, 1.4),
    "a straight line": ([[0, 0], [1, 2], [2, 4], [3, 6]], math.sqrt(45), 1.4),
    "coincident points": ([[0, 0], [0, 0], [1, 2], [3, 1]], 3.5472650711287174, 1.4),
    "a loop": ([[0, 0], [3, 2], [-2, 2], [1, 0]], 4.4962418076561891, 1.0),
    "a cusp at 0.5": ([[0, 0], [1, 1], [0, 1], [1, 0]], 1.8284271247461901, 1.0),
    "a cusp at 0.3": (
        [[0.09, -0.027], [-0.11, 0.063], [0.07 / 3, -0.147], [0.49, 0.343]],
        (4.81**1.5 + 8.41**1.5 - 16) / 27,
        1.0,
    ),
}


def exact_curve(corners: Points, t: Points) -> Points:
    """Evaluate with more digits than a float has."""
    degree, t = len(corners) - 1, t.astype(np.longdouble)
    basis = [math.comb(degree, k) * t**k * (1 - t) ** (degree - k) for k in range(degree + 1)]
    curve: Points = np.transpose(basis) @ corners
    return curve


def curve(degree: int, corners: Points, count: int, goal: float) -> Row:
    t = np.linspace(0, 1, count)
    error = np.abs(bezier_curve(corners, t) - exact_curve(corners, t)).max()
    assert error <= 1e-14 * np.abs(corners).max(), error
    nodes = np.asfortranarray(corners.T)
    peers: dict[str, Callable[[], object]] = {
        "bezier": lambda: bezier.Curve(nodes, degree).evaluate_multi(t),
        "SciPy `BPoly`": lambda: BPoly(corners[:, None], [0, 1])(t),
    }
    if degree == 3:
        peers["svgpathtools"] = lambda: svgpathtools.CubicBezier(*(corners @ [1, 1j])).poly()(t)
    name = f"`bezier_curve`, degree {degree}, 1e{round(math.log10(count))} points"
    return compare(name, lambda: bezier_curve(corners, t), peers, goal)


def length(name: str, with_floats: bool = False) -> Row:
    """Compare with `quad` for the same accuracy, the speed written with NumPy or with floats."""
    table, exact, goal = LENGTHS[name]
    corners = np.array(table, dtype=float)
    assert abs(arc_length(corners) / exact - 1) <= 1e-10
    steps = 3 * np.diff(corners, axis=0)
    (x0, y0), (x1, y1), (x2, y2) = steps.tolist()

    def speed(t: float) -> float:
        s = 1 - t
        return np.linalg.norm(s * s * steps[0] + 2 * s * t * steps[1] + t * t * steps[2])

    def plane_speed(t: float) -> float:
        s = 1 - t
        a, b, c = s * s, 2 * s * t, t * t
        return math.hypot(a * x0 + b * x1 + c * x2, a * y0 + b * y1 + c * y2)

    polygon = sum(math.dist(*pair) for pair in pairwise(table))
    integrand = plane_speed if with_floats else speed
    return compare(
        f"`arc_length`, {name}",
        lambda: arc_length(corners),
        {
            "SciPy `quad`" + (" of a cubic in plain floats" if with_floats else ""): lambda: quad(
                integrand, 0, 1, epsabs=1e-10 * polygon, epsrel=1e-10, limit=200
            )
        },
        None if with_floats else goal,
    )


def equal_steps(count: int) -> Row:
    t = equidistant_parameters(CUBIC, count)
    chosen = np.linspace(0, count - 2, 200).astype(int)
    total = arc_length(CUBIC)
    for start, end in zip(t[chosen], t[chosen + 1], strict=True):
        after = [level[-1] for level in de_casteljau(CUBIC, start)[::-1]]
        between = [level[0] for level in de_casteljau(after, (end - start) / (1 - start))]
        assert abs(arc_length(between) - total / (count - 1)) <= 1e-9 * total
    path = svgpathtools.CubicBezier(*(CUBIC @ [1, 1j]))
    # The peer takes seconds for all points: time it on one in a hundred.
    targets = np.linspace(0, path.length(), count // 100)
    seconds = typical(
        {
            "canim": lambda: equidistant_points(CUBIC, count),
            "svgpathtools": lambda: [path.point(path.ilength(s)) for s in targets],
        }
    )
    name = f"`equidistant_points`, {count} points"
    return Row(name, seconds["canim"], 100 * seconds["svgpathtools"], "svgpathtools", 1000)


def rows() -> list[Row]:
    high = np.random.default_rng(20).uniform(-1, 1, (21, 2))
    return [
        curve(3, CUBIC, 1_000_000, 1.5),
        curve(20, high, 100_000, 1.0),
        *(length(name) for name in LENGTHS),
        length("the paper's cubic", with_floats=True),
        length("a gentle cubic", with_floats=True),
        length("a cusp at 0.3", with_floats=True),
        equal_steps(10_000),
    ]
