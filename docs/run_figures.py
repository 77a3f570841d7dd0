"""Measure how soon a program runs in the page, and what it loads (nox -s run_figures).

A headless Chromium presses Run on the built page of Task 1.1, served from this machine.
The table goes into docs/run_here.md.
"""

from __future__ import annotations

import argparse
import functools
import gzip
import os
import re
import shutil
import statistics
import sys
import threading
import time
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from playwright.sync_api import sync_playwright

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS / "_ext"))

import run_files  # noqa: E402

from canim.checks import TASKS  # noqa: E402

PAGE = DOCS / "run_here.md"
MARK = "% Below this line nox -s run_figures writes.\n"
PICTURE = ".run-output img"
ENDED = "() => /ended/.test(document.querySelector('.run-status').textContent)"


class Server(SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


def first_plot(page, used):
    """Press Run; return the seconds until the first picture is to be seen, and of processors."""
    page.evaluate(f"document.querySelectorAll('{PICTURE}').forEach((i) => (i.dataset.old = 1))")
    begin, begun = time.perf_counter(), used()
    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_selector(f"{PICTURE}:not([data-old])", timeout=120_000)
    taken = time.perf_counter() - begin, used() - begun
    page.wait_for_function(ENDED, timeout=120_000)
    return taken


def one_reader(browser, address):
    """Return three pairs of times, and what was asked for before Run and until it had ended."""
    session = browser.new_browser_cdp_session()

    def used():
        processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
        return sum(process["cpuTime"] for process in processes)

    context = browser.new_context()
    asked = []
    context.on("request", lambda request: asked.append(request.url.split("?")[0]))
    page = context.new_page()
    page.goto(address, wait_until="load")
    before = set(asked)
    asked.clear()
    cold = first_plot(page, used)
    loaded = set(asked)
    again = first_plot(page, used)
    page.reload(wait_until="load")
    cached = first_plot(page, used)
    context.close()
    return (cold, cached, again), before, loaded


def seconds(pairs):
    clock, processors = map(statistics.median, zip(*pairs))
    return f"{clock:.2f} s ({processors:.2f} s of processors)"


def kilobytes(contents):
    raw, packed = 0, 0
    for content in contents:
        raw += len(content)
        packed += len(gzip.compress(content))
    return f"{packed / 1e3:.0f} kB ({raw / 1e3:.0f} kB not compressed)"


def measure(site, rounds):
    server = ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    root = f"http://127.0.0.1:{server.server_port}/"
    name = f"{TASKS['1.1'].page}.html"
    found = filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome")))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=next(found, None))
        readers = [one_reader(browser, root + name) for _ in range(rounds)]
        version = browser.version
        browser.close()
    server.shutdown()
    cold, cached, again = (seconds(pairs) for pairs in zip(*[r[0] for r in readers]))
    _, before, loaded = readers[0]
    files = [site / url.removeprefix(root) for url in sorted(loaded) if url.startswith(root)]
    transfer = sum(run_files.transferred(path) for path in files if path.is_file())
    raw = sum(path.stat().st_size for path in files if path.is_file())
    html = (site / name).read_text(encoding="utf-8")
    element = re.search(r"<canim-run.*?</template>", html, re.S).group()
    added = [(site / url.removeprefix(root)).read_bytes() for url in before if "/run." in url]
    return version, [
        ("first plot after the click, nothing loaded yet", cold, "≤ 6 s"),
        ("first plot after the click, all in the browser's cache", cached, "≤ 3 s"),
        ("next run, to its picture", again, "≤ 0.5 s"),
        (
            "transferred until the first run has ended",
            f"{transfer / 1e6:.1f} MB ({raw / 1e6:.1f} MB from a server that does not compress)",
            "≤ 15 MB",
        ),
        (
            "added to a page on which Run is not pressed",
            kilobytes([element.encode(), *added]),
            "≤ 100 kB",
        ),
    ]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--site", type=Path, default=DOCS / "_build/html")
    parser.add_argument("--rounds", type=int, default=5)
    given = parser.parse_args()
    busy = os.getloadavg()[0]
    version, rows = measure(given.site, given.rounds)
    lines = [
        f"Chromium {version}, headless, on 2 cores; the median of {given.rounds} readers. "
        f"Load of the machine before: {busy:.1f}; with 2 and more, clock times are too long.\n",
        "| what | measured | goal |",
        "| --- | --- | --- |",
        *(f"| {' | '.join(row)} |" for row in rows),
    ]
    table = "\n".join(lines)
    print(table)
    head = PAGE.read_text(encoding="utf-8").split(MARK)[0]
    PAGE.write_text(f"{head}{MARK}\n{table}\n", encoding="utf-8")
