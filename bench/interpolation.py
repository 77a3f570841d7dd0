"""Time Hermite, Lagrange and quadratic-spline interpolation against SciPy.

Run `python bench/interpolation.py` with `src` on the path, one thread.
"""

from __future__ import annotations

import numpy as np
import scipy.interpolate as peer
from scipy.linalg import solve_banded
from timing import Row, compare, table

from canim.interpolation import hermite_spline, lagrange_interpolate, quadratic_spline


def lagrange(count: int, goal: float) -> Row:
    nodes = np.cos(np.pi * (np.arange(count) + 0.5) / count)
    x = np.linspace(-1, 1, 100_000)
    # A polynomial that the nodes determine, and whose values are known.
    degree = min(count - 1, 12)
    values = np.cos(degree * np.arccos(nodes))
    error = np.abs(lagrange_interpolate(nodes, values, x) - np.cos(degree * np.arccos(x))).max()
    assert error <= 1e-13, error
    return compare(
        f"`lagrange_interpolate`, {count} nodes, 1e5 points",
        lambda: lagrange_interpolate(nodes, values, x),
        {"SciPy `BarycentricInterpolator`": lambda: peer.BarycentricInterpolator(nodes, values)(x)},
        goal,
    )


def quadratic(count: int) -> list[Row]:
    rng = np.random.default_rng(1)
    x = np.cumsum(rng.uniform(0.5, 1.5, count))
    y = rng.normal(size=count)
    # The peer only solves m[i] + m[i + 1] = 2 s[i]; all else is made beforehand.
    lines = np.diff(y) / np.diff(x)
    bands, right = np.ones((2, count)), np.concatenate([lines[:1], 2 * lines])

    def slopes() -> object:
        return solve_banded((1, 0), bands, right)

    spline = quadratic_spline(x, y)
    np.testing.assert_allclose(spline.slopes, slopes(), rtol=0, atol=1e-9)
    np.testing.assert_allclose(spline(x), y, rtol=0, atol=1e-9)
    return [
        compare(
            f"`quadratic_spline`, {count} points",
            lambda: quadratic_spline(x, y),
            {f"SciPy `{name}`": call},
            goal,
        )
        for name, call, goal in (
            ("solve_banded", slopes, 1.0),
            ("make_interp_spline(k=2)", lambda: peer.make_interp_spline(x, y, k=2), 1.5),
        )
    ]


def hermite(pieces: int, goal: float) -> Row:
    rng = np.random.default_rng(2)
    knots = np.cumsum(rng.uniform(0.5, 1.5, pieces + 1))
    values, slopes = rng.normal(size=(2, pieces + 1))
    t = np.linspace(knots[0], knots[-1], 1_000_000)
    np.testing.assert_allclose(
        hermite_spline(t, knots, values, slopes),
        peer.CubicHermiteSpline(knots, values, slopes)(t),
        rtol=0,
        atol=1e-9,
    )
    return compare(
        f"`hermite_spline`, {pieces} pieces, 1e6 points",
        lambda: hermite_spline(t, knots, values, slopes),
        {"SciPy `CubicHermiteSpline`": lambda: peer.CubicHermiteSpline(knots, values, slopes)(t)},
        goal,
    )


def rows() -> list[Row]:
    return [
        lagrange(20, 2),
        lagrange(100, 3),
        lagrange(1000, 7),
        *quadratic(1000),
        *quadratic(100_000),
        hermite(10, 2),
        hermite(1000, 1),
    ]


if __name__ == "__main__":
    print(table(rows()))
