"""Functions and data of a program in another process, called as if they were here."""

import json
import multiprocessing
import sys
import threading

import numpy as np
import pytest

from canim import checks
from canim.checks import file, remote
from canim.checks.crash import Crash
from canim.checks.file import check_file
from canim.checks.guard import Fault
from canim.checks.program import Stopped
from canim.checks.remote import Gone, Peer, Remote, heard

TASK = checks.TASKS["1.4"]
HEADS = {
    "f": "def f(x):\n",
    "sample": "def sample(f, nodes):\n",
    "interpolate": "def interpolate(f, nodes, x):\n",
    "nodes": "nodes =",
}
RIGHT = {
    "f": "    return 1 / (1 + x**2)\n",
    "sample": "    return [f(node) for node in nodes]\n",
    "interpolate": "    return lagrange_interpolate(nodes, sample(f, nodes), x)\n",
    "nodes": " [1, 2, 3.5]\n",
}


@pytest.fixture
def check(tmp_path, one_guard):
    def checked(**changes):
        text = "import os\nfrom canim.interpolation import lagrange_interpolate\n"
        for name, body in (RIGHT | changes).items():
            text += HEADS[name] + body
        path = tmp_path / TASK.file_name
        path.write_text(text, encoding="utf-8")
        (report,) = check_file(path)
        return report

    return checked


def test_functions_that_take_functions_are_called(check):
    assert check().done


def test_a_function_handed_to_another_stops_under_its_own_name(check):
    report = check(f="    return x / 'a' if x < 3 else 1\n")
    assert report.results[0].message.startswith("f stops in line 4:")
    assert {r.state for r in report.results[1:]} <= {"waits", "done"}


def test_a_function_of_ours_that_gets_nonsense_fails_in_the_students_line(check):
    report = check(
        f="    import numpy as np\n    return 1 / (1 + np.asarray(x, float)**2)\n",
        sample="    return [f(str(node)) for node in nodes]\n",
    )
    assert report.results[2].message.startswith("sample stops in line 7:")
    assert "return [f(str(node)) for node in nodes]" in report.results[2].message


def test_a_function_of_ours_may_be_given_anything(check):
    given = "f(object()) + f({1: [(2, None)]}) + f(f)"
    report = check(f="    return 1.0\n", sample=f"    return [{given} for node in nodes]\n")
    assert "sample stops in line 6" in str(report)


def test_data_that_cannot_be_used_is_told_once(check):
    report = check(nodes=" [1, 1, 2]\n")
    assert "holds 1 more than once" in str(report)
    assert "nodes is missing" in str(check(nodes=" None\n"))


def test_what_is_asked_after_the_end_of_the_program_waits(check):
    report = check(sample="    os._exit(1)\n")
    assert [r.state for r in report.results] == ["done", "done", "unusable", "waits"]
    message = report.results[2].message
    assert message.startswith("sample ends the program instead of returning.")
    report = check(f="    os._exit(1)\n")
    assert [r.state for r in report.results] == ["unusable", "done", "waits", "waits"]


def break_down(*args):
    raise ValueError("no reason")


def test_a_check_that_stops_at_right_results_is_a_fault_of_ours(check, monkeypatch):
    monkeypatch.setattr(file, "judge", break_down)
    with pytest.raises(Fault, match=r"the check of Task 1\.4 stops at right results") as caught:
        check()
    assert "file.py, line" in str(caught.value)
    assert "in break_down" in str(caught.value)
    assert "ValueError: no reason" in str(caught.value)


def test_a_check_that_stops_at_these_results_says_what_is_known(check, monkeypatch):
    judge = file.judge

    def stop_at_theirs(task, names):
        return break_down() if type(names) is Remote else judge(task, names)

    monkeypatch.setattr(file, "judge", stop_at_theirs)
    told = " ".join(str(check()).split())
    assert "it has changed Python or numpy, or the check is wrong here (ValueError in" in told


@pytest.fixture
def peers():
    """One peer, and what the other answers, in a thread."""
    here, there = multiprocessing.Pipe()
    asked = []

    def answer(question):
        asked.append(question)
        return {"value": question["value"](4) if callable(question["value"]) else None}

    def serve():
        with pytest.raises(Gone):
            Peer(there, answer).serve()
        there.close()

    thread = threading.Thread(target=serve)
    thread.start()
    yield Peer(here, answer), asked, here
    here.close()
    thread.join()


@pytest.mark.parametrize(
    "value",
    [None, True, 3, -2.5, float("inf"), "ℓ", [1, (2, "a")], {"a": [None]}, np.float64(2), 1j],
)
def test_values_arrive_as_they_are(peers, value):
    peer, asked, _ = peers
    peer.ask(value=value)
    if value == 1j:
        assert type(asked[0]["value"]).__name__ == "complex"
    else:
        assert asked == [{"value": value}]
        assert type(asked[0]["value"]) is type(value)


@pytest.mark.parametrize("dtype", ["u1", "i8", "f4", "f8", ">f8", "c16", "?"])
def test_arrays_arrive_with_shape_and_type(peers, dtype):
    peer, asked, _ = peers
    array = np.arange(6).reshape(2, 3).astype(dtype).T
    peer.ask(value=array)
    arrived = asked[0]["value"]
    np.testing.assert_array_equal(arrived, array)
    assert arrived.dtype == array.dtype
    arrived[0] = 0  # is not locked


def test_arrays_of_texts_arrive_as_lists(peers):
    peer, asked, _ = peers
    peer.ask(value=np.array([["a", "b"]]))
    assert asked == [{"value": [["a", "b"]]}]


def test_functions_are_called_where_they_come_from(peers):
    peer, _, _ = peers
    assert peer.ask(value=lambda number: number + 1) == {"value": 5}


@pytest.mark.parametrize("error", [KeyError("x"), Stopped("f", "is wrong"), Gone("of no builtin")])
def test_errors_of_such_functions_are_errors_there(error):
    here, there = multiprocessing.Pipe()
    caught = []

    def fail(number):
        raise error

    def answer(question):
        try:
            question["value"](1)
        except Exception as arrived:
            caught.append(arrived)
        return {}

    def serve():
        with pytest.raises(Gone):
            Peer(there, answer).serve()

    thread = threading.Thread(target=serve)
    thread.start()
    Peer(here, answer).ask(value=fail)
    here.close()
    thread.join()
    there.close()
    expected = RuntimeError if isinstance(error, Gone) else type(error)
    assert type(caught[0]) is expected


@pytest.mark.parametrize(
    "name", ["exec", "eval", "print", "SystemExit", "KeyboardInterrupt", "__name__", "no such", 3]
)
def test_an_error_from_there_is_an_error_here_whatever_its_name(name, capsys):
    here, there = multiprocessing.Pipe()
    function = {"dict": [["value", {"function": 0}]]}
    failed = {"dict": [["error", {"list": [name, "print('ran')"]}]]}
    there.send_bytes(json.dumps({"dict": [["reply", function]]}).encode())
    there.send_bytes(json.dumps({"dict": [["reply", failed]]}).encode())
    call = Peer(here, dict).ask()["value"]
    with pytest.raises(RuntimeError, match="print"):
        call()
    assert capsys.readouterr().out == ""
    here.close()
    there.close()


@pytest.mark.parametrize("name", ["exec", "SystemExit"])
def test_a_class_of_the_student_that_is_called_like_a_builtin_does_no_harm(check, name, capsys):
    text = f"    class {name}(Exception): pass\n    raise {name}('print(\"ran\")')\n"
    report = check(f=text)
    assert report.results[0].message.startswith("f stops in line 5:")
    assert capsys.readouterr().out == ""


def test_a_place_from_there_is_made_of_numbers_and_texts():
    fields = {"line": 2.0, "code": ["x"], "sentence": None, "start": -9, "end": "3", "cell": "4"}
    stopped = heard({"stopped": 5, "problem": fields})
    assert stopped.name == "5"
    assert stopped.problem == Crash(2, "['x']", "None", 0, 3, 4)
    assert heard({"stopped": "f", "problem": 3}).problem == "3"


@pytest.mark.parametrize("stopped", [[{"line": "x"}], 7, [{"other": 1}]])
def test_a_false_place_of_the_stop_gives_a_plain_report(check, monkeypatch, stopped):
    asked = file.Peer.ask

    def ask(self, **question):
        reply = asked(self, **question)
        return reply | {"stopped": stopped} if "run" in question else reply

    monkeypatch.setattr(file.Peer, "ask", ask)
    assert "gives results that cannot be compared" in " ".join(str(check()).split())


@pytest.mark.parametrize(
    "message",
    [
        b"no JSON",
        b"[1]",
        b"{}",
        b'{"array": ["f8", [3], "AAAA"]}',
        b'{"array": ["O", [1], "AAAAAAAAAAA="]}',
        b'{"dict": [["reply", 1, 2]]}',
        b'{"dict": [["other", 1]]}',
        b"[" * 20_000,
        b"\xff",
    ],
)
def test_nonsense_counts_as_no_answer(message):
    here, there = multiprocessing.Pipe()
    there.send_bytes(message)
    with pytest.raises(Gone):
        Peer(here, dict).ask(value=1)
    here.close()
    there.close()


def test_who_is_gone_is_not_asked():
    here, there = multiprocessing.Pipe()
    there.close()
    with pytest.raises(Gone):
        Peer(here, dict).ask(value=1)
    here.close()


def test_a_copy_of_a_process_does_not_speak_for_it(monkeypatch):
    here, there = multiprocessing.Pipe()
    peer = Peer(here, dict)
    monkeypatch.setattr(remote, "getpid", lambda: -1)
    monkeypatch.setattr(remote, "_exit", sys.exit)
    with pytest.raises(SystemExit):
        peer.ask(value=1)
    here.close()
    with pytest.raises(EOFError):
        there.recv_bytes()  # nothing came before the end
    there.close()
