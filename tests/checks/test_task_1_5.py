"""Task 1.5: equations as a set, whatever their order, scale and form."""

import numpy as np
import pytest

from canim import checks

TASK = checks.TASKS["1.5"]
DONE = ["done"] * 5


def parts(x, y, start):
    """Return the equations of the pieces' beginnings and ends, of the slopes and the start."""
    count = 3 * (len(x) - 1)

    def equation(columns, numbers, right):
        row = np.zeros(count + 1)
        row[columns] = numbers
        row[-1] = right
        return row

    begins, ends, slopes = [], [], []
    for i in range(len(x) - 1):
        begins.append(equation([3 * i, 3 * i + 1, 3 * i + 2], [x[i] ** 2, x[i], 1], y[i]))
        ends.append(equation([3 * i, 3 * i + 1, 3 * i + 2], [x[i + 1] ** 2, x[i + 1], 1], y[i + 1]))
    for i in range(len(x) - 2):
        columns = [3 * i, 3 * i + 1, 3 * i + 3, 3 * i + 4]
        slopes.append(equation(columns, [2 * x[i + 1], 1, -2 * x[i + 1], -1], 0))
    first = equation([0], [1], 0) if start == "straight" else equation([0, 1], [2 * x[0], 1], 0)
    return begins, ends, slopes, [first]


def system(rows, count):
    """Return A and b of these equations; rows that are left stay unwritten."""
    A, b = np.zeros((count, count)), np.full(count, np.nan)
    for k, row in enumerate(rows):
        A[k], b[k] = row[:-1], row[-1]
    return A, b


def report(change):
    """Return the report on a solution whose equations are those of `change(parts, x, y)`."""

    def written(x, y, start):
        rows = change(parts(x, y, start), x, y)
        return system(rows, 3 * (len(x) - 1))

    return checks.run(TASK, {"quadratic_spline_system": written}, hint=True)


def states(change):
    return [result.state for result in report(change).results]


def _as_they_are(found, x, y):
    return [row for part in found for row in part]


def _backwards(found, x, y):
    return _as_they_are(found, x, y)[::-1]


def _shuffled_scaled_and_turned(found, x, y):
    rows = _as_they_are(found, x, y)
    random = np.random.default_rng(1)
    factors = random.uniform(0.2, 5, len(rows)) * random.choice([-1, 1], len(rows))
    return [factors[k] * rows[k] for k in random.permutation(len(rows))]


def _meeting_in_place_of_ends(found, x, y):
    begins, ends, slopes, first = found
    meetings = [ends[i] - begins[i + 1] for i in range(len(ends) - 1)]
    return [*begins, *meetings, ends[-1], *slopes, *first]


@pytest.mark.parametrize(
    "form", [_as_they_are, _backwards, _shuffled_scaled_and_turned, _meeting_in_place_of_ends]
)
def test_the_form_of_the_equations_does_not_matter(form):
    assert states(form) == DONE


@pytest.mark.parametrize("size", [1e-300, 1e300])
def test_the_size_of_the_numbers_does_not_matter(size):
    assert states(lambda p, x, y: [size * row for row in _as_they_are(p, x, y)]) == DONE


def test_lists_and_a_column_for_b_are_accepted():
    def written(x, y, start):
        A, b = system(_as_they_are(parts(x, y, start), x, y), 3 * (len(x) - 1))
        return A.tolist(), b[:, None]

    assert checks.run(TASK, {"quadratic_spline_system": written}).done


def test_equations_are_told_apart_as_they_come():
    assert states(lambda p, x, y: p[0]) == ["done", *["unwritten"] * 4]
    assert states(lambda p, x, y: [*p[0], *p[1]]) == ["done", "done", *["unwritten"] * 3]
    assert states(lambda p, x, y: [*p[1], *p[2]])[:3] == ["differs", "done", "done"]
    assert states(lambda p, x, y: [*p[0], *p[1], *p[2]]) == [*["done"] * 3, *["unwritten"] * 2]


def test_an_empty_program_lacks_what_was_given():
    found = report(lambda p, x, y: [])
    assert [r.state for r in found.results] == ["differs", *["unwritten"] * 4]
    assert found.results[0].message == "4 points, piece 0 begins at (-3, 15): no row says this."


def test_one_start_alone_is_half():
    def straight_only(x, y, start):
        rows = _as_they_are(parts(x, y, start), x, y)
        return system(rows if start == "straight" else rows[:-1], 3 * (len(x) - 1))

    found = checks.run(TASK, {"quadratic_spline_system": straight_only}).results
    assert [r.state for r in found] == ["done"] * 4 + ["unwritten"]


@pytest.mark.parametrize("left_out", [0, -1])
def test_one_inner_knot_left_out_is_told_wherever_it_is(left_out):
    def without(found, x, y):
        del found[2][left_out]
        return _as_they_are(found, x, y)

    result = report(without).results[2]
    assert result.state == "differs"
    assert result.mistake == "inner knot left out"
    assert result.message.endswith("no row says this.")


def test_a_wrong_equation_is_shown_beside_the_right_one_and_others_stay_done():
    def wrong(found, x, y):
        found[1][-1][-1] += 1
        return _as_they_are(found, x, y)

    found = report(wrong)
    assert [r.state for r in found.results] == ["done", "differs", "done", "done", "done"]
    assert found.results[1].message == (
        "4 points, piece 2 ends at (3, 9): expected 9 a2 + 3 b2 + c2 = 9, got 9 a2 + 3 b2 + c2 = 10"
    )


def test_signs_are_shown_as_on_the_page_and_as_written():
    def added(found, x, y):
        for i, row in enumerate(found[2]):
            row[3 * i + 3 :] *= -1
        return _as_they_are(found, x, y)

    assert report(added).results[2].message == (
        "4 points, equal slopes of pieces 0 and 1 at x = -1: "
        "expected -2 a0 + b0 + 2 a1 - b1 = 0, got -2 a0 + b0 - 2 a1 + b1 = 0"
    )


@pytest.mark.parametrize("with_slopes", [False, True])
def test_a_row_written_twice_is_told_before_the_slopes_are_written_too(with_slopes):
    def written(x, y, start):
        pieces = len(x) - 1
        A, b = np.zeros((3 * pieces, 3 * pieces)), np.full(3 * pieces, np.nan)
        for i in range(pieces):
            A[2 * i, 3 * i : 3 * i + 3], b[2 * i] = [x[i] ** 2, x[i], 1], y[i]
            A[2 * i + 2, 3 * i : 3 * i + 3] = [x[i + 1] ** 2, x[i + 1], 1]
            b[2 * i + 2] = y[i + 1]
        for i in range(with_slopes * (pieces - 1)):
            A[2 * pieces + i, 3 * i : 3 * i + 2] = [2 * x[i + 1], 1]
            A[2 * pieces + i, 3 * i + 3 : 3 * i + 5] = [-2 * x[i + 1], -1]
            b[2 * pieces + i] = 0
        return A, b

    found = checks.run(TASK, {"quadratic_spline_system": written}).results
    assert found[0].mistake == "ends in the row of the next beginning"
    assert {result.mistake for result in found[1:]} <= {found[0].mistake, ""}


def test_every_single_wrong_number_is_found():
    def spoil(k, column):
        def change(found, x, y):
            rows = _as_they_are(found, x, y)
            rows[k % len(rows)][column] += 0.01
            return rows

        return change

    for k in range(9):
        for column in range(3):
            assert states(spoil(k, column)) != DONE, (k, column)


def test_an_equation_written_twice_stands_for_the_one_that_is_missing():
    found = report(lambda p, x, y: [*p[0], *p[1], *p[2], p[0][0]])
    assert [r.state for r in found.results][3:] == ["differs", "differs"]
    assert found.results[3].message.endswith("expected a0 = 0, got 9 a0 - 3 b0 + c0 = 15")


def test_mistakes_are_told_in_any_order_and_scale():
    def added(found, x, y):
        for i, row in enumerate(found[2]):
            row[3 * i + 3 :] *= -1
        return _shuffled_scaled_and_turned(found, x, y)

    found = report(added).results
    assert found[2].mistake == "slopes added"


def _answer(A, b):
    return lambda x, y, start: (A(3 * (len(x) - 1)), b(3 * (len(x) - 1)))


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda x, y, start: None, "returns nothing (None)"),
        (lambda x, y, start: np.zeros((9, 9)), "must return two things: A and b."),
        (lambda x, y, start: 3, "must return two things: A and b."),
        (_answer(lambda n: np.zeros((n, n + 1)), np.zeros), "returns, as A, an array of shape"),
        (_answer(lambda n: "A", np.zeros), "returns, as A, a text, expected"),
        (_answer(np.eye, lambda n: np.zeros(n + 1)), "returns, as b, an array of shape (10,)"),
        (_answer(np.eye, lambda n: np.full(n, np.nan)), "row 0 of A, but b[0] is still nan."),
        (_answer(lambda n: np.zeros((n, n)), np.ones), "b[0], but row 0 of A is all zeros."),
    ],
)
def test_what_cannot_be_compared_is_said_once(function, words):
    found = checks.run(TASK, {"quadratic_spline_system": function}).results
    assert words in found[0].message
    assert [r.state for r in found] == ["unusable", *["waits"] * 4]


def test_rows_of_zeros_and_of_nan_are_not_written_yet():
    def zeros(x, y, start):
        A, b = system(parts(x, y, start)[0], 3 * (len(x) - 1))
        return A, np.nan_to_num(b)

    def nans(x, y, start):
        A, b = system(parts(x, y, start)[0], 3 * (len(x) - 1))
        A[np.isnan(b)] = np.nan
        return A, b

    for written in (zeros, nans):
        found = checks.run(TASK, {"quadratic_spline_system": written}).results
        assert [r.state for r in found] == ["done", *["unwritten"] * 4]
