"""A server for the built site, and a browser that reads it: pytest tests/site --site DIR."""

import json
import os
import shutil
import sys
import threading
from contextlib import contextmanager
from functools import cached_property, partial
from html.parser import HTMLParser
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "docs/_ext"), str(Path(__file__).parent)]
os.environ["MPLBACKEND"] = "agg"
AXE_FILE = ROOT / "docs/node_modules/axe-core/axe.min.js"
CHECK = """rules => axe.run(document, {resultTypes: ["violations"],
  ...(rules.length && {runOnly: rules})}).then(result =>
  result.violations.flatMap(v => v.nodes.map(n => `${v.id}: ${n.target.join(" ")}`)))"""
KEPT = """async (names) => {
  const addresses = performance.getEntriesByType("resource").map((entry) => entry.name);
  const isOurs = (name) => name.startsWith(location.origin) && !/service_worker/.test(name);
  const all = [location.href, ...addresses.filter(isOurs), ...names];
  const wanted = all.map((name) => name.split("?")[0]);
  const kept = [];
  for (const name of await caches.keys())
    for (const { url } of await (await caches.open(name)).keys()) kept.push(url.split("?")[0]);
  return wanted.every((address) => kept.includes(address));
}"""
MOUNT = "/some/folder"  # of the server: a site at its root would hide wrong addresses


def pytest_addoption(parser):
    default = ROOT / "docs/_build/html"
    parser.addoption("--site", type=Path, default=default, help="folder of the built site")


def pytest_generate_tests(metafunc):
    site = metafunc.config.getoption("--site")
    pages = sorted(path.relative_to(site).as_posix() for path in site.rglob("*.html"))
    if not pages:
        raise pytest.UsageError(f"no pages in {site}: build the site first (nox -s docs)")
    if "page" in metafunc.fixturenames:
        metafunc.parametrize("page", pages)
    if "task_page" in metafunc.fixturenames:
        metafunc.parametrize("task_page", [page for page in pages if "/task_" in page])
    if "formula_page" in metafunc.fixturenames:
        # Those of the API, for readers who know more, may scroll in their box.
        sources = {p: (site / p).read_text(encoding="utf-8") for p in pages if p[:4] != "api/"}
        with_one = [page for page, text in sources.items() if 'class="formula-body' in text]
        metafunc.parametrize("formula_page", with_one)


@pytest.fixture(scope="session")
def site(request):
    return request.config.getoption("--site").resolve()


class Handler(SimpleHTTPRequestHandler):
    extensions_map = SimpleHTTPRequestHandler.extensions_map | {".woff2": "font/woff2"}

    def translate_path(self, path):
        if not path.startswith(f"{MOUNT}/"):
            return str(Path(self.directory, "not", "there"))
        return super().translate_path(path.removeprefix(MOUNT))

    def log_message(self, *args):
        pass


class Recorder(Handler):
    """Has every page keep what it says on the console; not every browser hands that out."""

    SCRIPT = b"""<script>
      window.said = [];
      const tell = (...words) => said.push(words.join(" "));
      for (const kind of ["error", "warn", "log", "info"]) console[kind] = tell;
      const say = ({ message, target }) => tell(message ?? `not loaded: ${target.outerHTML}`);
      addEventListener("error", say, true);
      addEventListener("unhandledrejection", (e) => tell(e.reason));
      addEventListener("securitypolicyviolation", (e) => tell(e.violatedDirective, e.blockedURI));
    </script>"""

    def do_GET(self):
        path = Path(self.translate_path(self.path.split("?")[0]))
        if path.suffix != ".html" or not path.is_file():
            super().do_GET()
            return
        page = path.read_bytes().replace(b"<head>", b"<head>" + self.SCRIPT, 1)
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.send_header("Content-Length", str(len(page)))
        self.end_headers()
        self.wfile.write(page)


@pytest.fixture(scope="session")
def serve(site):
    """Serve the site: `with serve() as (address, end)`; a test may end the server before."""

    @contextmanager
    def start(recorded=False):
        handler = Recorder if recorded else Handler
        server = ThreadingHTTPServer(("127.0.0.1", 0), partial(handler, directory=str(site)))
        thread = threading.Thread(target=server.serve_forever)
        thread.start()

        def end():
            server.shutdown()
            thread.join()
            server.server_close()

        try:
            yield f"http://127.0.0.1:{server.server_port}{MOUNT}", end
        finally:
            end()

    return start


@pytest.fixture(scope="session")
def address(serve):
    """Address of the site on a server of ours."""
    with serve() as (address, _):
        yield address


@pytest.fixture(scope="session")
def is_kept(site):
    """Return an expression of JavaScript: whether a page can do without its server, at an address.

    It has been loaded, and so has all of Python that the first task needs.
    """
    others = ("run.json", "scipy", "openblas", "canim-face")
    files = [f for f in (site / "_run").glob("*/*") if not f.name.startswith(others)]

    def expression(address):
        names = [f"{address}/{file.relative_to(site).as_posix()}" for file in files]
        return f"({KEPT})({json.dumps(names)})"

    return expression


@pytest.fixture(scope="session")
def chromium_path():
    """Return the path of the system's browser; without one, playwright looks for its own."""
    names = ("chromium", "chromium-browser", "google-chrome", "chrome")
    return next(filter(None, map(shutil.which, names)), None)


@pytest.fixture(scope="session")
def chromium(chromium_path):
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium_path, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture
def visit(chromium, address):
    """Open a page of the site; what it says on the console and asks of servers is kept."""
    contexts = []

    def open_page(name, **options):
        context = chromium.new_context(**{"viewport": {"width": 1280, "height": 900}} | options)
        contexts.append(context)
        page = context.new_page()
        page.said, page.asked, page.failed = [], [], []
        page.on("console", lambda message: page.said.append(message.text))
        page.on("pageerror", lambda error: page.said.append(str(error)))
        page.on("request", lambda request: page.asked.append(request.url))
        page.on("requestfailed", lambda request: page.failed.append(request.url))
        page.on("response", lambda r: page.failed.append(r.url) if r.status >= 400 else None)
        page.goto(f"{address}/{name}", wait_until="load")
        return page

    yield open_page
    for context in contexts:
        context.close()


@pytest.fixture(scope="session")
def violations():
    """Return what axe finds wrong in an open page, by all its rules or by those that are named."""

    def find(page, *rules):
        if not page.evaluate("() => 'axe' in window"):
            page.add_script_tag(path=AXE_FILE)
        return page.evaluate(CHECK, rules)

    return find


class Document(HTMLParser):
    """What the tests ask of a page's source."""

    VOID = ("br", "col", "hr", "img", "input", "link", "meta", "source", "wbr")

    def __init__(self, path):
        super().__init__()
        self.elements, self._open = [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        element = {"tag": tag, "text": "", **dict(attributes)}
        self.elements.append(element)
        if tag not in self.VOID:
            self._open.append(element)

    def handle_endtag(self, tag):
        while self._open and self._open.pop()["tag"] != tag:
            pass

    def handle_data(self, text):
        for element in self._open:
            element["text"] += text

    def all(self, *tags):
        return [element for element in self.elements if element["tag"] in tags]

    @cached_property
    def ids(self):
        return [e["id"] for e in self.elements if "id" in e]


@pytest.fixture(scope="session")
def read_pages():
    """Read all pages in a folder; return them by their address within it."""

    def read(folder):
        pages = folder.rglob("*.html")
        return {path.relative_to(folder).as_posix(): Document(path) for path in pages}

    return read


@pytest.fixture(scope="session")
def documents(site, read_pages):
    """All pages, by their address within the site."""
    return read_pages(site)
