"""What a report says of right, missing, wrong and broken functions."""

import sys
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

import canim
from canim import checks, interpolation
from canim.checks import program
from canim.checks.program import Program
from canim.checks.task import Array, Case, Data, Function, Mistake, Part, Task, Unusable, at

T = np.linspace(0, 1, 5)


def double(t):
    return np.array([2 * t, t**2])


def canims_double(t):
    return double(t)


def _positive(value):
    if not value > 0:
        raise Unusable(f"must be above 0, but is {value}.")
    return value


def task(**changes):
    settings = {
        "id": "9.9",
        "name": "double",
        "title": "Double a number",
        "block": "interpolation",
        "writes": "one line",
        "minutes": 1,
        "figure": "none",
        "questions": 1,
        "functions": (
            Function("f", "f(t)", Array(lambda t: (2, len(t)), "two rows"), canims_double),
        ),
        "parts": (
            Part("twice", lambda p, t: p.f(t)[0], (Case((T,)), Case((T + 1,), "late t")), at("t")),
            Part("square", lambda p, t: p.f(t)[1], (Case((T,)),), at("t")),
        ),
        "mistakes": (
            Mistake("half", "Twice, not half.", {"f": lambda t: np.array([t / 2, t**2])}),
            Mistake("halves", "Both halved.", {"f": lambda t: np.array([t / 2, t**2 / 2])}),
            Mistake("cube", "Count the powers.", {"f": lambda t: np.array([2 * t, t**3])}),
            Mistake("broken", "Never seen.", {"f": lambda t: None}),
        ),
        "canim_functions": (canims_double,),
    }
    return Task(**settings | changes)


def states(report):
    return [result.state for result in report.results]


def test_right_functions_are_done():
    report = checks.run(task(), {"f": double})
    assert states(report) == ["done", "done"]
    assert report.done
    assert str(report).splitlines()[-1] == "All checks of Task 9.9 pass."


@pytest.mark.parametrize("convert", [list, tuple, lambda a: a.tolist(), lambda a: a.astype("f4")])
def test_lists_tuples_and_other_floats_are_accepted(convert):
    assert checks.run(task(), {"f": lambda t: convert(double(t))}).done


def test_nan_is_not_written_yet():
    report = checks.run(task(), {"f": lambda t: np.array([2 * t, t * np.nan])})
    assert states(report) == ["done", "unwritten"]
    assert "square  not written yet" in str(report)


def test_a_difference_tells_place_expected_got_and_the_largest_error_of_all_inputs():
    report = checks.run(task(), {"f": lambda t: np.array([2 * t + (t == 0.5), t**2])})
    assert states(report) == ["differs", "done"]
    assert report.results[0].message == "at t = 0.5: expected 1, got 2 (largest error 1)"


def test_a_labelled_case_is_named():
    report = checks.run(task(), {"f": lambda t: np.array([2 * t + 3 * (t > 1.8), t**2])})
    assert report.results[0].message.startswith("late t, at t = 2: expected 4, got 7")


def test_one_nan_among_numbers_is_a_difference():
    report = checks.run(task(), {"f": lambda t: np.array([2 * t, np.where(t == 1, np.nan, t**2)])})
    assert report.results[1].message == "at t = 1: expected 1, got nan"


def test_infinity_is_a_difference():
    report = checks.run(task(), {"f": lambda t: np.array([2 * t, np.where(t == 1, np.inf, t**2)])})
    assert report.results[1].message == "at t = 1: expected 1, got inf"


@pytest.mark.parametrize(
    ("result", "words"),
    [
        (None, "f returns nothing (None). Is the line with return missing?"),
        ("abc", "f returns a text, expected two rows."),
        ([[1, 2], [3]], "f returns a list that is not a table of numbers, expected two rows."),
        ([None, [1]], "f returns a list that is not a table of numbers, expected two rows."),
        (np.array(["a"]), "f returns an array that does not hold numbers, expected two rows."),
        ({1: 2}, "f returns a value of type dict, expected two rows."),
        (np.zeros(3), "f returns an array of shape (3,), expected (2, 5): two rows."),
        (7, "f returns one number, expected (2, 5): two rows."),
    ],
)
def test_none_wrong_type_or_shape_is_said_once(result, words):
    report = checks.run(task(), {"f": lambda t: result})
    assert states(report) == ["unusable", "waits"]
    assert report.results[0].message == words


def test_a_shape_wrong_only_in_a_later_case_names_it():
    report = checks.run(task(), {"f": lambda t: double(t) if t[0] == 0 else np.zeros(1)})
    assert report.results[0].message.endswith("two rows. (For late t.)")


@pytest.mark.parametrize("value", [None, "missing"])
def test_a_missing_function_is_named(value):
    names = {"f": None} if value is None else {}
    report = checks.run(task(), names)
    assert report.results[0].message == "f is missing: keep this name in your program."


def test_a_number_in_place_of_a_function_is_named():
    assert checks.run(task(), {"f": 3}).results[0].message == "f must be a function."


def test_a_crash_tells_the_students_line_and_nothing_of_ours():
    def wrong(t):
        return missing_name + t  # noqa: F821

    report = checks.run(task(), {"f": wrong})
    line = wrong.__code__.co_firstlineno + 1
    assert states(report) == ["crashed", "waits"]
    text = report.results[0].message
    assert text.startswith(f"f stops in line {line}:\n  return missing_name + t")
    assert "The name missing_name is not known here." in text
    assert "site-packages" not in str(report)
    assert "Traceback" not in str(report)


def test_a_crash_inside_a_library_points_to_the_students_line():
    def wrong(t):
        return np.linalg.inv(t)

    message = checks.run(task(), {"f": wrong}).results[0].message
    assert f"line {wrong.__code__.co_firstlineno + 1}:" in message


def test_ending_the_program_is_told():
    report = checks.run(task(), {"f": lambda t: sys.exit()})
    assert "ends the program instead of returning" in report.results[0].message


def test_a_function_that_prints_without_end_is_stopped(monkeypatch):
    monkeypatch.setattr(program, "MOST_OUTPUT", 10**6)

    def f(t):
        while True:
            print("again and again " * 100)

    (problem,) = checks.run(task(), {"f": f}).problems
    assert "More than 1 MB are printed. Is there a loop without an end?" in problem


def test_functions_are_called_quietly_and_once_for_the_same_arguments(capsys):
    calls = []

    def loud(t):
        calls.append(1)
        print("loud")
        return double(t) + 0 / np.zeros(1)[0] * 0 if t is None else double(t) + np.log(0 * T[0]) * 0

    checks.run(task(), {"f": loud})
    assert capsys.readouterr().out == ""
    assert len(calls) == 2


def test_warnings_of_a_function_disturb_nobody():
    def warning(t):
        warnings.warn("look out", stacklevel=1)
        return double(t)

    assert checks.run(task(), {"f": warning}).done


def test_infinite_results_give_no_warnings_of_ours():
    endless = lambda *args: np.full((11, 2), np.inf)  # noqa: E731
    assert not checks.run(checks.TASKS["1.7"], {"cubic_bezier": endless}).done


def test_changing_the_arguments_is_told_and_does_no_harm_but_does_not_pass():
    def changing(t):
        result = double(t)
        t[:] = 7
        return result

    report = checks.run(task(), {"f": changing})
    assert states(report) == ["done", "done"]
    assert report.notes == ("f changes what it is given. Work on a copy, or make a new array.",)
    assert not report.done
    assert report.summary == "Task 9.9: 2 of 2 parts done."
    assert T[0] == 0


def test_a_function_that_is_handed_to_another_stops_under_its_own_name():
    functions = (
        Function("f", "f(t)", Array(lambda t: t.shape, "one number per t")),
        Function("g", "g(f, t)", Array(lambda f, t: t.shape, "one number per t")),
    )
    parts = (Part("g", lambda p, t: p.g(p.f, t), (Case((T,)),)),)
    changed = task(functions=functions, parts=parts, mistakes=(), canim_functions=())
    (crashed,) = checks.run(changed, {"f": lambda t: t + "1", "g": lambda f, t: f(t)}).results
    assert crashed.state == "crashed"
    assert crashed.message.startswith("f stops")
    (unusable,) = checks.run(changed, {"f": lambda t: 1.0, "g": lambda f, t: f(t)}).results
    assert unusable.message == "f returns one number, expected (5,): one number per t."


def test_canims_own_function_is_marked():
    report = checks.run(task(), {"f": lambda t: canims_double(t)})
    assert report.notes == ("f uses canim's function.",)


def test_what_wraps_canims_functions_does_not_make_them_one():
    def through_another(t):
        interpolation.lerp(0, 1, t)
        return [2 * t**3 - 3 * t**2 + 1, -2 * t**3 + 3 * t**2, t**3 - 2 * t**2 + t, t**3 - t**2]

    assert checks.run(checks.TASKS["1.1"], {"hermite_basis": through_another}).notes == ()
    marked = checks.run(checks.TASKS["1.1"], {"hermite_basis": interpolation.hermite_basis}).notes
    assert marked == ("hermite_basis uses canim's function.",)


def test_only_calls_of_canims_function_are_marked():
    # Once by hand, since what a profiler runs is not seen by coverage.
    program = Program(task(), {"f": double})
    for event, seen in [("return", []), ("call", ["f"])]:
        frame = SimpleNamespace(f_code=canims_double.__code__)
        program._see("f", frame, event, None)
        program._see("g", sys._getframe(), event, None)
        assert list(program.uses_canim) == seen


def test_another_profiler_goes_on():
    seen = []
    profiler = lambda *event: seen.append(event)  # noqa: E731
    sys.setprofile(profiler)
    try:
        checks.run(task(), {"f": double})
        assert sys.getprofile() is profiler
    finally:
        sys.setprofile(None)
    assert seen


def test_a_known_mistake_is_recognised_and_the_hint_comes_on_request():
    wrong = {"f": lambda t: np.array([t / 2, t**2])}
    first = checks.run(task(), wrong)
    assert [r.mistake for r in first.results] == ["half", ""]
    assert "Twice, not half." not in str(first)
    assert "There is a hint. In your program, write hint=True into the call:" in str(first)
    assert 'canim.check("9.9", hint=True, f=f)' in str(first)
    assert "Hint: Twice, not half." in str(checks.run(task(), wrong, hint=True))


def test_the_mistake_that_explains_most_parts_wins():
    report = checks.run(task(), {"f": lambda t: np.array([t / 2, t**2 / 2])}, hint=True)
    assert report.hints == [("twice", "Both halved.")]
    assert [r.mistake for r in report.results] == ["halves", "halves"]


def test_two_mistakes_in_two_parts_give_two_hints():
    report = checks.run(task(), {"f": lambda t: np.array([t / 2, t**3])}, hint=True)
    assert report.hints == [("twice", "Twice, not half."), ("square", "Count the powers.")]


def test_an_unknown_mistake_gets_no_hint():
    report = checks.run(task(), {"f": lambda t: np.array([t / 2 + 1, t**2])}, hint=True)
    assert report.hints == []
    assert "hint" not in str(report).lower()


def test_a_mistake_can_be_told_by_a_predicate_in_the_parts_it_names():
    negative = Mistake(
        "sign",
        "Look at the sign.",
        {"f": lambda t: -double(t)},
        applies=lambda got, expected, t: bool((got <= 0).all()),
        parts=("square",),
    )
    report = checks.run(task(mistakes=(negative,)), {"f": lambda t: -3 * double(t)})
    assert [r.mistake for r in report.results] == ["", "sign"]


def test_data_is_the_students_own_and_has_its_own_words():
    scaled = task(
        data=(Data("other", float), Data("scale", _positive)),
        parts=(
            Part("scaled", lambda p: p.scale * p.f(T)[0], expected=lambda p: 6 * T),
            Part("flat", lambda p: p.scale * p.f(T), expected=lambda p: 6 * T),
        ),
    )
    assert states(checks.run(scaled, {"f": double, "scale": 3, "other": 1})) == ["done", "differs"]
    assert checks.run(scaled, {"f": double, "scale": -3}).results[0].message == (
        "scale must be above 0, but is -3."
    )
    assert "scale is missing" in checks.run(scaled, {"f": double}).results[0].message
    shape = checks.run(scaled, {"f": double, "scale": 3, "other": 1}).results[1].message
    assert shape == "has shape (2, 5), expected (5,)"
    assert checks.run(scaled, {"f": double, "scale": 1}).results[0].message == (
        "at index 4: expected 6, got 2 (largest error 4)"
    )


def test_a_free_function_is_the_students_in_every_program():
    free = task(
        functions=(
            Function("g", "g(t)", lambda result, *args: np.asarray(result, float)),
            *task().functions,
        ),
        parts=(Part("sum", lambda p, t: p.g(t) + p.f(t)[0], (Case((T,), "some t"),), at("t")),),
    )
    assert checks.run(free, {"g": np.cos, "f": double}).done
    assert not checks.run(free, {"g": np.cos, "f": lambda t: double(t) + 1}).done
    with pytest.raises(AttributeError):
        checks.run(task(parts=(Part("x", lambda p: p.nothing),)), {"f": double})


def test_a_part_can_describe_its_difference_and_say_when_it_is_unwritten():
    described = task(
        parts=(
            Part(
                "twice",
                lambda p: p.f(T)[0],
                unwritten=lambda got: bool((got == 0).all()),
                describe=lambda got, expected: f"off by {np.abs(got - expected).max():g}",
            ),
        )
    )
    assert states(checks.run(described, {"f": lambda t: 0 * double(t)})) == ["unwritten"]
    message = checks.run(described, {"f": lambda t: double(t) + 3}).results[0].message
    assert message == "off by 3"


def test_what_is_right_may_follow_from_the_students_own_data():
    own = task(
        data=(Data("scale", _positive),),
        parts=(Part("scaled", lambda p: p.f(T)[0], expected=lambda p: p.scale * T),),
    )
    assert checks.run(own, {"f": double, "scale": 2}).done
    assert states(checks.run(own, {"f": double, "scale": 3})) == ["differs"]


def test_a_crash_names_the_case_in_which_it_happened():
    def f(t):
        return double(t) if t[0] == 0 else t / "a"

    message = checks.run(task(), {"f": f}).results[0].message
    assert message.endswith("(For late t.)")


def test_a_single_number_is_compared_without_a_largest_error():
    single = task(parts=(Part("first", lambda p: p.f(T)[0][4]),))
    message = checks.run(single, {"f": lambda t: -0.0 * double(t)}).results[0].message
    assert message == "expected 2, got 0"


def test_check_shows_one_report(capsys):
    canim.check("1.1", hermite_basis=lambda t: np.full((4, len(t)), np.nan))
    assert capsys.readouterr().out.count("not written yet") == 4


def test_check_ends_the_program_after_a_crash(capsys):
    with pytest.raises(SystemExit) as ended:
        canim.check("1.1", hermite_basis=lambda t: t / "a")
    assert ended.value.code == 1
    assert "stops in line" in capsys.readouterr().out


def test_check_ends_the_program_where_a_result_cannot_be_drawn(capsys):
    with pytest.raises(SystemExit):
        canim.check("1.1", hermite_basis=lambda t: None)
    assert "returns nothing (None)" in capsys.readouterr().out


@pytest.mark.parametrize("number", [1.1, None, ["1.1"]])
def test_a_task_is_named_by_a_text(number):
    with pytest.raises(TypeError, match=r'task must be a text such as "1\.1", but is '):
        canim.check(number)


def test_check_names_unknown_tasks_and_functions():
    with pytest.raises(ValueError, match=r"no task '9\.9'\. There are 0\.0, 1\.1"):
        canim.check("9.9")
    with pytest.raises(KeyError, match=r"9\.9"):
        checks.TASKS["9.9"]
    with pytest.raises(TypeError, match=r"Task 1\.1 has nothing called basis; .* hermite_basis"):
        canim.check("1.1", basis=double)


def test_a_function_with_other_values_between_its_brackets_is_told_with_its_first_line():
    def another(t, count):
        return double(t)

    message = checks.run(task(), {"f": another}).results[0].message
    assert "def another(t, count):" in message
    assert "It is called as f(t): keep these values between its brackets." in message
    assert "(Python says: TypeError: missing a required argument: 'count')" in message
    without_a_line = checks.run(task(), {"f": type("F", (), {"__call__": lambda self: 1})()})
    assert "f stops.\nIt is called as f(t)" in without_a_line.results[0].message


def test_a_function_without_a_signature_is_called():
    assert checks.run(task(), {"f": dict.fromkeys}).results[0].state == "unusable"
    assert states(checks.run(task(), {"f": max})) == ["unusable", "waits"]
