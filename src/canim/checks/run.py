"""Judge a student's functions part by part."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from canim.checks.crash import Crash
from canim.checks.picture import Drawing
from canim.checks.program import Program, Stopped
from canim.checks.report import Report, Result, stops
from canim.checks.task import Mistake, Part, Task

# For each case: its arguments, its label, what the student got, and what was expected.
Compared = list[tuple[tuple[Any, ...], str, np.ndarray, np.ndarray]]


def run(task: Task, names: Mapping[str, Any], *, hint: int = 0) -> Report:
    """Return the report on the functions and data in `names`."""
    return judge(task, Program(task, names), hint=hint)


# Differences of infinite results are nan, and their warnings would show our lines.
@np.errstate(all="ignore")
def judge(task: Task, student: Program, *, hint: int = 0) -> Report:
    """Return the report on a student's functions and data."""
    given = student.given
    reference = Program(
        task, given | {f.name: f.reference for f in task.functions if f.reference is not None}
    )
    results, wrong, drawings, told = [], {}, list[Drawing](), set[str]()
    for part in task.parts:
        try:
            compared = list(_compare(part, student, reference))
        except Stopped as stopped:
            results.append(_result_of_stop(part, stopped, told))
            continue
        result = _judge(part, compared)
        if result.state == "differs":
            wrong[part.name] = compared
            drawings += _drawing(part, compared)
        results.append(result)
    explained = _explain(task, wrong, given)
    results = [
        _with_hint(r, explained[r.part], task) if r.part in explained else r for r in results
    ]
    arguments = ", ".join(f"{name}={name}" for name in task.names)
    return Report(
        task,
        tuple(results),
        notes=tuple(_notes(student)),
        changing=tuple(student.changes),
        drawings=tuple(drawings),
        show_hints=hint,
        how_to_hint=(
            f"In your program, write hint=True into the call:\n"
            f'canim.check("{task.id}", hint=True, {arguments})',
            f"In your program, write hint=2 into the call:\n"
            f'canim.check("{task.id}", hint=2, {arguments})',
        ),
    )


def _drawing(part: Part, compared: Compared) -> list[Drawing]:
    """Return what is to be drawn of a part: the case that its sentence is about."""
    args, _, got, expected = next(c for c in compared if not _equal(c[2], c[3], part.tolerance))
    if part.picture is None or got.shape != expected.shape:
        return []
    # Beside numbers that are much too large, what is expected would not be seen.
    if np.any(np.abs(got) > 1e4 * max(1.0, float(np.nanmax(np.abs(expected))))):
        return []
    return [Drawing(part.name, part.picture, got, expected, args)]


def _with_hint(result: Result, mistake: Mistake, task: Task) -> Result:
    line = mistake.line or task.lines.get(result.part, "")
    return replace(result, mistake=mistake.name, hint=mistake.hint, line=line)


def _compare(
    part: Part, program: Program, reference: Program
) -> Iterator[tuple[tuple[Any, ...], str, np.ndarray, np.ndarray]]:
    for case in part.cases:
        try:
            got = np.asarray(part.measure(program, *case.args), dtype=float)
        except Stopped as stopped:
            raise _of_case(stopped, case.label) from None
        if part.expected:
            expected = part.expected(program, *case.args)
        else:
            expected = part.measure(reference, *case.args)
        yield case.args, case.label, got, np.asarray(expected, dtype=float)


def _of_case(stopped: Stopped, label: str) -> Stopped:
    """Return `stopped` with the case named in its sentence."""
    problem = stopped.problem
    if not label:
        return stopped
    if isinstance(problem, Crash):
        return Stopped(
            stopped.name, replace(problem, sentence=f"{problem.sentence} (For {label}.)")
        )
    return Stopped(stopped.name, f"{problem} (For {label}.)")


def _result_of_stop(part: Part, stopped: Stopped, told: set[str]) -> Result:
    if stopped.name in told:
        return Result(part.name, "waits")
    told.add(stopped.name)
    if isinstance(stopped.problem, Crash):
        return Result(part.name, "crashed", f"{stopped.name} {stops(stopped.problem)}")
    return Result(part.name, "unusable", stopped.problem)


def _judge(part: Part, compared: Compared) -> Result:
    if all(part.unwritten(got) for _, _, got, _ in compared):
        return Result(part.name, "unwritten")
    differing = [c for c in compared if not _equal(c[2], c[3], part.tolerance)]
    if not differing:
        return Result(part.name, "done")
    return Result(part.name, "differs", _difference(part, differing))


def _equal(a: np.ndarray, b: np.ndarray, tolerance: float) -> bool:
    """Tell whether two results agree; nan agrees with nan only (a part not written)."""
    if a.shape != b.shape:
        return False
    finite = np.abs(b[np.isfinite(b)])
    scale = max(1.0, float(finite.max())) if finite.size else 1.0
    return bool(np.allclose(a, b, rtol=0, atol=tolerance * scale, equal_nan=True))


def _difference(part: Part, differing: Compared) -> str:
    """Return the first sentence about the case that is shown: expected and got."""
    args, label, got, expected = differing[0]
    if part.describe:
        return part.describe(got, expected, *args)
    if got.shape != expected.shape:
        return f"has shape {got.shape}, expected {expected.shape}" + (
            f" ({label})" if label else ""
        )
    error = np.where(np.isnan(got) & ~np.isnan(expected), np.inf, np.abs(got - expected))
    index = np.unravel_index(int(np.nanargmax(error)), error.shape)
    place = part.place(tuple(int(i) for i in index), *args)
    where = ", ".join(text for text in (label, place) if text)
    largest = max(_largest_error(g, e) for _, _, g, e in differing)
    of_all = "" if largest <= error[index] else " of all tests"
    size = f" (largest error{of_all} {number(largest)})"
    size = size if got.size > 1 and np.isfinite(largest) else ""
    head = f"{where}: " if where else ""
    return f"{head}expected {number(expected[index])}, got {number(got[index])}{size}"


def _largest_error(got: np.ndarray, expected: np.ndarray) -> float:
    if got.shape != expected.shape or np.isnan(got).any():
        return float("nan")
    return float(np.abs(got - expected).max(initial=0))


def number(value: float) -> str:
    """Return `value` with at most four digits, as a student would write it."""
    text = f"{float(value):.4g}"
    return "0" if text == "-0" else text


def _explain(task: Task, wrong: dict[str, Compared], given: dict[str, Any]) -> dict[str, Mistake]:
    """Return, for each wrong part, the mistake that explains most of the wrong parts."""
    reference = {f.name: f.reference for f in task.functions if f.reference is not None}
    parts = {part.name: part for part in task.parts}
    matches: dict[str, list[str]] = {}
    for mistake in task.mistakes:
        program = Program(task, given | reference | dict(mistake.program))
        matches[mistake.name] = [
            name
            for name, compared in wrong.items()
            if _matches(mistake, parts[name], compared, program)
        ]
    by_name = {mistake.name: mistake for mistake in task.mistakes}
    best = sorted(by_name, key=lambda name: -len(matches[name]))
    return {
        part: by_name[next(name for name in best if part in matches[name])]
        for part in wrong
        if any(part in found for found in matches.values())
    }


def _matches(mistake: Mistake, part: Part, compared: Compared, program: Program) -> bool:
    if mistake.parts and part.name not in mistake.parts:
        return False
    if mistake.applies:
        differing = [c for c in compared if not _equal(c[2], c[3], part.tolerance)]
        return all(mistake.applies(got, expected, *args) for args, _, got, expected in differing)
    try:
        return all(
            _equal(got, np.asarray(part.measure(program, *args), dtype=float), part.tolerance)
            for args, _, got, _ in compared
        )
    except Stopped:
        return False


def _notes(student: Program) -> Iterator[str]:
    for name in student.changes:
        yield f"{name} changes what it is given. Work on a copy, or make a new array."
    for name in student.uses_canim:
        yield f"{name} uses canim's function."
