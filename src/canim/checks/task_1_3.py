"""Task 1.3: what "done" means for the Lagrange basis and the curve through all points."""

from __future__ import annotations

from typing import Any

import numpy as np

from canim import interpolation
from canim.checks.picture import values_over
from canim.checks.program import Stopped
from canim.checks.task import Array, Case, Floats, Function, Mistake, Part, Task

NODES = np.array([-8.0, -1.0, 2.0, 7.0])
VALUES = np.array([-5.0, 5.0, -8.0, 9.0])
OTHER_NODES = (
    np.array([0.0, 1.0, 3.0]),
    np.array([2.0, -1.0, 0.5, 4.0, 1.0, -3.0]),
    np.array([1.0, 5.0]),
)
OTHER_VALUES = (
    np.array([2.0, -1.0, 4.0]),
    np.array([1.0, -2.0, 0.0, 3.0, 5.0, -1.0]),
    np.array([3.0, -2.0]),
)


def _places(nodes: Floats) -> Floats:
    """Return the nodes and places between them: a mistake may show at either only."""
    ordered = np.sort(nodes)
    return np.sort(np.concatenate([ordered, (ordered[1:] + 2 * ordered[:-1]) / 3]))


def _label(nodes: Floats) -> str:
    return f"nodes {', '.join(f'{node:g}' for node in nodes)}"


OWN = Case((NODES, _places(NODES)))
OTHERS = tuple(Case((nodes, _places(nodes)), _label(nodes)) for nodes in OTHER_NODES)
CURVE = Case((NODES, VALUES, _places(NODES)))
OTHER_CURVES = tuple(
    Case((nodes, values, _places(nodes)), _label(nodes))
    for nodes, values in zip(OTHER_NODES, OTHER_VALUES)
)


def _basis(program: Any, nodes: Floats, x: Floats) -> Any:
    return program.lagrange_basis(nodes, x)


def _curve(program: Any, nodes: Floats, values: Floats, x: Floats) -> Any:
    return program.lagrange_interpolate(nodes, values, x)


def _expected_curve(program: Any, nodes: Floats, values: Floats, x: Floats) -> Floats:
    """Return what follows from the student's own basis if they got that, else what is right.

    So a mistake in the basis is told once, where the basis is judged.
    """
    got = program.lagrange_interpolate(nodes, values, x)
    right: Floats = interpolation.lagrange_interpolate(nodes, values, x)
    try:
        own: Floats = values @ program.lagrange_basis(nodes, x)
    except Stopped:
        return right
    return own if np.allclose(got, own, equal_nan=True) and not np.isnan(own).all() else right


def _in_row(index: tuple[int, ...], nodes: Floats, x: Floats) -> str:
    return f"row {index[0]} at x = {x[index[1]]:.3g}"


def _at_x(index: tuple[int, ...], nodes: Floats, values: Floats, x: Floats) -> str:
    return f"at x = {x[index[0]]:.3g}"


def _factors(nodes: Floats, x: Floats) -> Floats:
    """Return the factor of nodes j and m at every x as entry [j, m]."""
    numerator = x[None, None, :] - nodes[None, :, None]
    return numerator / (nodes[:, None] - nodes)[:, :, None]


def _of_others(nodes: Floats, x: Floats) -> list[Floats]:
    """Return, for every node j, the factors of all nodes but j."""
    others = ~np.eye(len(nodes), dtype=bool)
    with np.errstate(all="ignore"):
        return [row[keep] for row, keep in zip(_factors(nodes, x), others)]


def _m_equal_j(nodes: Floats, x: Floats) -> Any:
    return _factors(nodes, x).prod(axis=1)


def _scaled_by_y(nodes: Floats, x: Floats) -> Any:
    return np.resize(VALUES, len(nodes))[:, None] * interpolation.lagrange_basis(nodes, x)


def _last_factor_only(nodes: Floats, x: Floats) -> Any:
    return [factors[-1] for factors in _of_others(nodes, x)]


def _sum_of_factors(nodes: Floats, x: Floats) -> Any:
    return [factors.sum(axis=0) for factors in _of_others(nodes, x)]


def _sum_of_factors_from_one(nodes: Floats, x: Floats) -> Any:
    return [1 + factors.sum(axis=0) for factors in _of_others(nodes, x)]


def _from_zero(nodes: Floats, x: Floats) -> Any:
    return np.zeros((len(nodes), len(x)))


def _divisor_turned_round(nodes: Floats, x: Floats) -> Any:
    return (-1) ** (len(nodes) - 1) * interpolation.lagrange_basis(nodes, x)


def _first_row_only(nodes: Floats, x: Floats) -> Any:
    basis = interpolation.lagrange_basis(nodes, x)
    basis[1:] = np.nan
    return basis


def _last_row_missing(nodes: Floats, x: Floats) -> Any:
    basis = interpolation.lagrange_basis(nodes, x)
    basis[-1] = np.nan
    return basis


def _last_node_left_out(nodes: Floats, x: Floats) -> Any:
    basis = _factors(nodes, x)
    basis[range(len(nodes)), range(len(nodes))] = 1
    return basis[:, :-1].prod(axis=1)


def _nodes_exchanged(nodes: Floats, x: Floats) -> Any:
    with np.errstate(all="ignore"):
        turned = (x[None, None, :] - nodes[:, None, None]) / (nodes - nodes[:, None])[:, :, None]
    others = ~np.eye(len(nodes), dtype=bool)
    return [row[keep].prod(axis=0) for row, keep in zip(turned, others)]


def _heights_forgotten(nodes: Floats, values: Floats, x: Floats) -> Any:
    return interpolation.lagrange_basis(nodes, x).sum(axis=0)


def _last_term_only(nodes: Floats, values: Floats, x: Floats) -> Any:
    return values[-1] * interpolation.lagrange_basis(nodes, x)[-1]


def _first_term_only(nodes: Floats, values: Floats, x: Floats) -> Any:
    return values[0] * interpolation.lagrange_basis(nodes, x)[0]


def _last_term_left_out(nodes: Floats, values: Floats, x: Floats) -> Any:
    return values[:-1] @ interpolation.lagrange_basis(nodes, x)[:-1]


def _nodes_in_place_of_values(nodes: Floats, values: Floats, x: Floats) -> Any:
    return nodes @ interpolation.lagrange_basis(nodes, x)


TASK = Task(
    id="1.3",
    name="lagrange_interpolation",
    title="One curve through all points",
    block="interpolation",
    writes="a product and a sum, about 8 lines",
    minutes=35,
    figure="Fig. 2a",
    questions=3,
    functions=(
        Function(
            "lagrange_basis",
            "lagrange_basis(nodes, x)",
            Array(
                lambda nodes, x: (len(nodes), len(x)),
                "one row per node, in each row one number per x",
            ),
            interpolation.lagrange_basis,
        ),
        Function(
            "lagrange_interpolate",
            "lagrange_interpolate(nodes, values, x)",
            Array(lambda nodes, values, x: (len(x),), "one number per x"),
            interpolation.lagrange_interpolate,
        ),
    ),
    parts=(
        Part("basis, the four nodes", _basis, (OWN,), _in_row, picture=values_over("x", 1)),
        Part("basis, any number of nodes", _basis, OTHERS, _in_row, picture=values_over("x", 1)),
        Part(
            "L, the four points",
            _curve,
            (CURVE,),
            _at_x,
            _expected_curve,
            picture=values_over("x", 2),
        ),
        Part(
            "L, any number of points",
            _curve,
            OTHER_CURVES,
            _at_x,
            _expected_curve,
            picture=values_over("x", 2),
        ),
    ),
    lines={
        "basis, the four nodes": "multiply row j by the factor",
        "basis, any number of nodes": "multiply row j by the factor",
        "L, the four points": "add y_j times row j of the basis",
        "L, any number of points": "add y_j times row j of the basis",
    },
    mistakes=(
        Mistake(
            "product over m = j",
            "One factor divides by zero. Which node must the product leave out?",
            {"lagrange_basis": _m_equal_j},
            source="study: condition",
            line="if m is not j:",
        ),
        Mistake(
            "basis scaled by y",
            "The basis does not know the heights: row j is 1 at its own node. Where do they enter?",
            {"lagrange_basis": _scaled_by_y},
            source="matlab: draws y times the basis",
        ),
        Mistake(
            "last factor only",
            "Each row holds one factor, the last. What became of those before?",
            {"lagrange_basis": _last_factor_only},
            source="study: loop",
        ),
        Mistake(
            "factors added",
            "Is the basis a sum or a product of its factors?",
            {"lagrange_basis": _sum_of_factors},
            source="study: computation",
        ),
        Mistake(
            "factors added to one",
            "The product begins with 1. How does each factor then come in?",
            {"lagrange_basis": _sum_of_factors_from_one},
            source="study: computation",
        ),
        Mistake(
            "product begun with zero",
            "Everything is 0. With which number does a product begin?",
            {"lagrange_basis": _from_zero},
            source="study: variable",
            line="row j of the basis = 1",
        ),
        Mistake(
            "divisor turned round",
            "Look at the difference below the line of the fraction: what minus what?",
            {"lagrange_basis": _divisor_turned_round},
            source="study: computation",
            line="return (x - x_m) / (x_j - x_m)",
        ),
        Mistake(
            "nodes exchanged",
            "Row j must be 1 at node j. Are j and m in the right places in the factor?",
            {"lagrange_basis": _nodes_exchanged},
            source="study: variable",
            line="return (x - x_m) / (x_j - x_m)",
        ),
        Mistake(
            "first row only",
            "Only row 0 is filled. How far to the right does the line with return stand?",
            {"lagrange_basis": _first_row_only},
            source="study: function",
            line="return the basis",
        ),
        Mistake(
            "last row missing",
            "Only the last row is not filled. How far does your loop over j count?",
            {"lagrange_basis": _last_row_missing},
            source="trial",
            line="for every node j:",
        ),
        Mistake(
            "last node left out",
            "The curves are not 0 at the last node. How far does your loop over m count?",
            {"lagrange_basis": _last_node_left_out},
            source="trial",
            line="for every node m:",
        ),
        Mistake(
            "heights forgotten",
            "Your L is 1 everywhere. Where do the heights of the points come in?",
            {"lagrange_interpolate": _heights_forgotten},
            source="thread: Lagrange interpolation in Python, Stack Overflow",
        ),
        Mistake(
            "last term only",
            "Your L is the last term alone. What became of the terms before it?",
            {"lagrange_interpolate": _last_term_only},
            source="study: loop",
        ),
        Mistake(
            "first term only",
            "Your L is the first term alone. How far to the right does its return stand?",
            {"lagrange_interpolate": _first_term_only},
            source="trial",
            line="return L",
        ),
        Mistake(
            "last term left out",
            "The last point has no part in your L. How far does your loop count?",
            {"lagrange_interpolate": _last_term_left_out},
            source="trial",
            line="for every node j:",
        ),
        Mistake(
            "nodes in place of values",
            "Your L has the height of each node's place. Which list holds the heights?",
            {"lagrange_interpolate": _nodes_in_place_of_values},
            source="study: variable",
        ),
    ),
    canim_functions=(interpolation.lagrange_basis, interpolation.lagrange_interpolate),
)
