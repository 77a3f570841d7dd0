"""Task 1.2: what a student may write, and what half of it is worth."""

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["1.2"]
NAN = np.nan
M = [[2, -2, 1, 1], [-3, 3, -2, -1], [0, 0, 1, 0], [1, 0, 0, 0]]


def coefficients(f0, f1, d0, d1):
    return np.array(M) @ np.array([f0, f1, d0, d1])


def curve(t, f0, f1, d0, d1):
    return np.polyval(coefficients(f0, f1, d0, d1), t)


def states(**changes):
    names = {"M": M, "hermite_coefficients": coefficients, "hermite_curve": curve} | changes
    return [result.state for result in checks.run(TASK, names).results]


def _without_the_matrix(f0, f1, d0, d1):
    return (2 * f0 - 2 * f1 + d0 + d1, -3 * f0 + 3 * f1 - 2 * d0 - d1, d0, f0)


def _row_by_row(f0, f1, d0, d1):
    wishes = [f0, f1, d0, d1]
    return [sum(number * wish for number, wish in zip(row, wishes)) for row in M]


def _from_the_four_equations(f0, f1, d0, d1):
    return np.linalg.solve(
        [[0, 0, 0, 1], [1, 1, 1, 1], [0, 0, 1, 0], [3, 2, 1, 0]], [f0, f1, d0, d1]
    )


@pytest.mark.parametrize("written", [_without_the_matrix, _row_by_row, _from_the_four_equations])
def test_coefficients_may_be_found_in_other_ways(written):
    assert states(hermite_coefficients=written) == ["done"] * 6


def _point_by_point(t, f0, f1, d0, d1):
    a, b, c, d = coefficients(f0, f1, d0, d1)
    heights = []
    for moment in t:
        heights.append(a * moment**3 + b * moment**2 + c * moment + d)
    return heights


def _by_the_four_curves(t, f0, f1, d0, d1):
    H = [2 * t**3 - 3 * t**2 + 1, -2 * t**3 + 3 * t**2, t**3 - 2 * t**2 + t, t**3 - t**2]
    return f0 * H[0] + f1 * H[1] + d0 * H[2] + d1 * H[3]


@pytest.mark.parametrize("written", [_point_by_point, _by_the_four_curves])
def test_the_curve_may_be_drawn_in_other_ways(written):
    assert states(hermite_curve=written) == ["done"] * 6


def test_rows_are_judged_one_by_one_and_what_needs_them_waits_unwritten():
    rows = np.array([M[0], M[1], [NAN] * 4, [NAN] * 4])
    found = states(
        M=rows,
        hermite_coefficients=lambda *given: rows @ np.array(given),
        hermite_curve=lambda t, *given: np.polyval(rows @ np.array(given), t),
    )
    assert found == ["done", "done", "unwritten", "unwritten", "unwritten", "unwritten"]


def test_a_wrong_number_is_named_by_its_wish():
    wrong = [M[0], [-3, 3, -2, 1], M[2], M[3]]
    result = checks.run(TASK, {"M": wrong}).results[1]
    assert result.message == "number for f'(1): 1 is not right"
    half = checks.run(TASK, {"M": [M[0], [-3, 3, NAN, NAN], M[2], M[3]]}).results[1]
    assert half.message == "number for f'(0): not written yet"


def _of_matrix(matrix):
    def product(f0, f1, d0, d1):
        return np.array(matrix) @ np.array([f0, f1, d0, d1])

    return {
        "M": matrix,
        "hermite_coefficients": product,
        "hermite_curve": lambda t, *given: np.polyval(product(*given), t),
    }


def test_what_follows_from_a_wrong_number_is_not_told_as_a_second_mistake():
    wrong = [M[0], [-3, 3, -2, 1], M[2], M[3]]
    assert states(**_of_matrix(wrong)) == ["done", "differs", *["done"] * 4]
    turned = _of_matrix(wrong) | {"hermite_coefficients": lambda *given: given @ np.array(wrong)}
    assert states(**turned)[4] == "differs"


def test_what_follows_from_wrong_coefficients_is_not_told_as_a_second_mistake():
    def turned(f0, f1, d0, d1):
        return np.array([f0, f1, d0, d1]) @ np.array(M)

    names = {"hermite_coefficients": turned}
    names["hermite_curve"] = lambda t, *given: np.polyval(turned(*given), t)
    assert states(**names)[4:] == ["differs", "done"]


def test_without_coefficients_the_curve_is_judged_by_the_matrix():
    def stops(*given):
        raise ValueError

    wrong = _of_matrix([M[0], [-3, 3, -2, 1], M[2], M[3]])
    assert states(**wrong | {"hermite_coefficients": stops})[4:] == ["crashed", "done"]
    assert states(hermite_coefficients=stops)[4:] == ["crashed", "done"]
    assert states(M=None, hermite_coefficients=stops)[4:] == ["crashed", "done"]


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ([[2, -2, 1, 1]], "M is an array of shape (1, 4), expected (4, 4)"),
        ("2 -2 1 1", "M is a text, expected four rows of four numbers"),
    ],
)
def test_a_table_of_another_shape_is_said_once(wrong, words):
    results = checks.run(TASK, {"M": wrong}).results
    assert words in results[0].message
    assert [r.state for r in results[:4]] == ["unusable", "waits", "waits", "waits"]


def test_a_star_in_place_of_the_product_sign_is_a_wrong_shape():
    table = checks.run(
        TASK, {"hermite_coefficients": lambda *given: np.array(M) * np.array(given)}
    ).results[4]
    assert table.state == "unusable"
    assert "(4, 4), expected (4,): the four numbers a, b, c, d" in table.message


def test_the_curve_of_the_paper_alone_is_not_enough():
    def only_for_the_paper(t, f0, f1, d0, d1):
        return t**3 - t**2 + 1

    assert states(hermite_curve=only_for_the_paper)[-1] == "differs"


def test_a_mistake_in_the_curve_is_told_though_a_row_is_wrong_too():
    wrong = [M[0], [-3, -2, 3, -1], [0, 1, 0, 0], M[3]]
    names = {"M": wrong, "hermite_coefficients": coefficients}
    names["hermite_curve"] = lambda t, *given: np.polyval(coefficients(*given)[::-1], t)
    found = [result.mistake for result in checks.run(TASK, names).results]
    assert found[1] == found[2] == "columns of M in another order"
    assert found[5] == "powers turned round"
