"""Task 1.3: what a student may write, and what is told of what goes wrong."""

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["1.3"]
PAPER = ([-8.0, -1.0, 2.0, 7.0], [-5.0, 5.0, -8.0, 9.0])


def basis(nodes, x):
    rows = []
    for node in nodes:
        row = np.ones(len(x))
        for other in nodes:
            if other != node:
                row = row * (x - other) / (node - other)
        rows.append(row)
    return rows


def curve(nodes, values, x):
    return values @ np.array(basis(nodes, x))


def report(**changes):
    names = {"lagrange_basis": basis, "lagrange_interpolate": curve} | changes
    return checks.run(TASK, names, hint=True)


def states(**changes):
    return [result.state for result in report(**changes).results]


def _all_at_once(nodes, x):
    factors = (x - nodes[:, None]) / np.where(
        np.eye(len(nodes), dtype=bool), 1, nodes[:, None] - nodes
    )[:, :, None]
    factors[np.arange(len(nodes)), np.arange(len(nodes))] = 1
    return factors.prod(axis=1)


def _number_by_number(nodes, x):
    rows = []
    for j in range(len(nodes)):
        row = []
        for place in x:
            product = 1
            for m in range(len(nodes)):
                if m != j:
                    product *= (place - nodes[m]) / (nodes[j] - nodes[m])
            row.append(product)
        rows.append(row)
    return tuple(rows)


@pytest.mark.parametrize("written", [basis, _all_at_once, _number_by_number])
def test_the_basis_may_be_written_in_other_ways(written):
    assert states(lagrange_basis=written) == ["done"] * 4


def _by_solving_for_a_polynomial(nodes, values, x):
    return np.vander(x, len(nodes)) @ np.linalg.solve(np.vander(nodes), values)


def _term_by_term(nodes, values, x):
    return [sum(y * row[i] for y, row in zip(values, basis(nodes, x))) for i in range(len(x))]


@pytest.mark.parametrize("written", [_by_solving_for_a_polynomial, _term_by_term])
def test_the_curve_may_be_written_in_other_ways(written):
    assert states(lagrange_interpolate=written) == ["done"] * 4


def test_four_nodes_written_out_are_half_of_the_task():
    def written_out(nodes, x):
        a, b, c, d = (x - node for node in nodes[:4])
        p, q, r, s = nodes[:4]
        return [
            b * c * d / ((p - q) * (p - r) * (p - s)),
            a * c * d / ((q - p) * (q - r) * (q - s)),
            a * b * d / ((r - p) * (r - q) * (r - s)),
            a * b * c / ((s - p) * (s - q) * (s - r)),
        ]

    assert states(lagrange_basis=written_out)[:2] == ["done", "crashed"]


def test_nodes_may_come_in_any_order():
    assert states(lagrange_basis=lambda nodes, x: basis(np.sort(nodes), x))[:2] == [
        "done",
        "differs",
    ]


def test_the_paper_s_points_give_the_cubic_found_by_the_original_program():
    cubic = [0.102857143, 0.143809524, -4.785714286, 0.173333333]

    def that_cubic(nodes, values, x):
        return np.polyval(cubic, x)

    assert states(lagrange_interpolate=that_cubic)[2:] == ["done", "differs"]


def test_a_basis_scaled_by_the_heights_of_the_program_is_told_though_others_crash():
    heights = np.array(PAPER[1])
    found = report(lagrange_basis=lambda nodes, x: heights[:, None] * np.array(basis(nodes, x)))
    assert found.results[0].mistake == "basis scaled by y"
    assert found.results[1].state == "crashed"
    assert "The sizes of two arrays" in found.results[1].message


def test_a_product_over_every_node_is_told_though_it_is_nan_at_the_nodes():
    def over_every_node(nodes, x):
        rows = np.ones((len(nodes), len(x)))
        for j in range(len(nodes)):
            for m in range(len(nodes)):
                rows[j] *= (x - nodes[m]) / (nodes[j] - nodes[m])
        return rows

    found = report(lagrange_basis=over_every_node).results[:2]
    assert [result.mistake for result in found] == ["product over m = j"] * 2


def test_a_row_too_many_is_a_wrong_shape_said_once():
    found = report(lagrange_basis=lambda nodes, x: np.ones((len(nodes) + 1, len(x)))).results
    assert found[0].message.startswith("lagrange_basis returns an array of shape (5, 7)")
    assert found[1].state == "waits"


def test_what_follows_from_a_wrong_basis_is_not_told_as_a_second_mistake():
    def doubled(nodes, x):
        return 2 * np.array(basis(nodes, x))

    def curve_of_it(nodes, values, x):
        return values @ doubled(nodes, x)

    found = states(lagrange_basis=doubled, lagrange_interpolate=curve_of_it)
    assert found == ["differs", "differs", "done", "done"]
    assert states(lagrange_interpolate=curve_of_it)[2:] == ["differs", "differs"]
    assert states(lagrange_basis=lambda nodes, x: 1 / 0)[2:] == ["done", "done"]


def test_while_the_basis_is_missing_the_curve_is_not_written_rather_than_wrong():
    def missing(nodes, x):
        return np.full((len(nodes), len(x)), np.nan)

    def curve_of_it(nodes, values, x):
        return values @ missing(nodes, x)

    assert states(lagrange_basis=missing, lagrange_interpolate=curve_of_it) == ["unwritten"] * 4
