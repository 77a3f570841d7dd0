"""Time pairs of functions fairly and print the result as a Markdown table.

Time is that of the processor, so waiting for another program does not count, and a second
thread gains nothing. Ours and the peers take turns, round by round, so that a busy spell of
the machine falls on all of them; each is judged by its middle round. The fastest would
flatter functions that ask for much memory: only now and then do they find it ready.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import median

Call = Callable[[], object]


@dataclass(frozen=True)
class Row:
    """One line of the table; a ratio above one means that ours is faster."""

    name: str
    ours: float
    peer: float
    peer_name: str
    goal: float | None

    @property
    def ratio(self) -> float:
        return self.peer / self.ours

    @property
    def reached(self) -> bool:
        return self.goal is None or self.ratio >= self.goal


def typical(calls: Mapping[str, Call], repeats: int = 9, least: float = 0.02) -> dict[str, float]:
    """Return the processor seconds of one call of each function, the median of `repeats` rounds.

    A round calls a function as often as it takes to fill `least` seconds.
    """
    loops = {}
    for name, call in calls.items():
        call()  # The first call pays for imports and caches.
        begin = time.process_time()
        call()
        loops[name] = max(1, round(least / max(time.process_time() - begin, 1e-7)))
    rounds: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(repeats):
        for name, call in calls.items():
            begin = time.process_time()
            for _ in range(loops[name]):
                call()
            rounds[name].append((time.process_time() - begin) / loops[name])
    return {name: median(seconds) for name, seconds in rounds.items()}


def compare(
    name: str,
    ours: Call,
    peers: Mapping[str, Call],
    goal: float | None = None,
    repeats: int = 9,
) -> Row:
    """Time `ours` against the fastest of `peers`; `goal` is the ratio to reach."""
    seconds = typical({"canim": ours, **peers}, repeats)
    mine = seconds.pop("canim")
    best = min(seconds, key=seconds.__getitem__)
    return Row(name, mine, seconds[best], best, goal)


def duration(seconds: float) -> str:
    """Return a time with three digits and a fitting unit."""
    for unit, factor in (("s", 1.0), ("ms", 1e3)):
        if seconds * factor >= 1:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e6:.3g} µs"


def table(rows: list[Row]) -> str:
    """Return the rows as a Markdown table."""
    lines = ["| name | ours | peer | ratio | goal |", "| --- | --- | --- | --- | --- |"]
    for row in rows:
        goal = "" if row.goal is None else f"≥ {row.goal:g}×"
        missed = "" if row.reached else " (missed)"
        lines.append(
            f"| {row.name} | {duration(row.ours)} | {row.peer_name} {duration(row.peer)} "
            f"| {row.ratio:.2f}× | {goal}{missed} |"
        )
    return "\n".join(lines)
