"""Run all benchmarks; write what they find into docs/performance.md (nox -s bench).

Every other module here with a function `rows` is a benchmark. Given names of modules, only
those run, and nothing is written. `classes` takes minutes and only runs by its name.
"""

from __future__ import annotations

import importlib
import os
import platform
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

from timing import Row, duration, table

HERE = Path(__file__).parent
PAGE = HERE.parent / "docs/performance.md"
MARK = "% Below this line nox -s bench writes.\n"
VERSIONS = (
    *("numpy", "scipy", "pillow"),
    *("bezier", "ikpy", "opencv-python-headless", "pin", "scikit-image", "svgpathtools"),
)


def benchmark(name: str) -> list[Row]:
    found: list[Row] = importlib.import_module(name).rows()
    print(f"## {name}\n{table(found)}\n", flush=True)
    return found


def import_time() -> str:
    def shortest(code: str) -> float:
        def run() -> float:
            begin = time.perf_counter()
            subprocess.run([sys.executable, "-c", code], check=True)
            return time.perf_counter() - begin

        return min(run() for _ in range(20))

    above = shortest("import canim") - shortest("pass")
    return f"`import canim` takes {duration(above)} more than starting Python (goal: ≤ 30 ms)."


def processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(": ")[1] for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def page(found: list[Row], light: str) -> str:
    used = ", ".join(f"{name} {version(name)}" for name in VERSIONS)
    return "\n".join(
        [
            f"Machine: {processor()}, {os.cpu_count()} cores, {platform.system()}. "
            f"Python {platform.python_version()}, {used}.",
            "",
            table(found),
            "",
            light,
            "",
        ]
    )


if __name__ == "__main__":
    chosen = sys.argv[1:]
    every = sorted({path.stem for path in HERE.glob("*.py")} - {"__main__", "classes", "timing"})
    results = [row for name in chosen or every for row in benchmark(name)]
    if not chosen:
        above, mark, _ = PAGE.read_text(encoding="utf-8").partition(MARK)
        PAGE.write_text(above + mark + "\n" + page(results, import_time()), encoding="utf-8")
        print(f"written: {PAGE}")
    missed = [row.name for row in results if not row.reached]
    if missed:
        sys.exit("goals missed: " + ", ".join(missed))
