"""What a reader is told, and can do, when servers, networks and browsers fail."""

import json
import re
import threading
import zipfile
from contextlib import closing, contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from canim.checks import TASKS

FIRST = f"{TASKS['1.1'].page}.html"
WARP = f"{TASKS['2.1'].page}.html"
MOUNT, COPY = "/courses/canim/", "/courses/copy/"
LOGIN = b"<!doctype html><title>Log in</title>"
BIG = "pyodide.asm.wasm"
TOLD = "words => document.querySelector('canim-run').textContent.includes(words)"


class Handler(SimpleHTTPRequestHandler):
    """Sends the site as its server's fields say; `wrong` has what is wrong, by the file's name."""

    def send_head(self):
        path = urlsplit(self.path).path
        root = next((root for root in (MOUNT, COPY) if path.startswith(root)), None)
        parts = path.removeprefix(root or "").split("/")
        file = Path(self.directory, *parts)
        # As free hosts do, that make a site of what they find.
        passed_over = path.count("/_") and not Path(self.directory, ".nojekyll").exists()
        if root is None or passed_over or not file.is_file():
            return self.send_error(404)
        self.send(file, file.read_bytes(), self.server.wrong.get(file.name))
        return None

    def send(self, file, content, wrong):
        kind = self.guess_type(str(file))
        if wrong == "missing":
            return self.send_error(404)
        if wrong == "login page":
            kind, content = "text/html", LOGIN
        if wrong == "changed":
            content = content[:-1] + bytes([content[-1] ^ 1])
        if wrong and "/" in wrong:
            kind = wrong
        if callable(self.server.rewrite) and file.suffix in {".html", ".js"}:
            content = self.server.rewrite(content)
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        for name, value in self.server.headers.items():
            self.send_header(name, value)
        self.end_headers()
        if wrong in {"dropped", "held"}:
            half = len(content) // 2
            self.wfile.write(content[:half])
            self.wfile.flush()
            if wrong == "dropped":
                return self.close_connection
            self.server.free.wait()
            content = content[half:]
        self.wfile.write(content)
        return None

    def log_message(self, *args):
        pass


@contextmanager
def serving(folder):
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(folder)))
    server.wrong, server.headers, server.rewrite = {}, {}, None
    server.free = threading.Event()
    server.handle_error = lambda *args: None  # a browser that does not want the rest
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    server.root = f"http://127.0.0.1:{server.server_port}"
    yield server
    server.free.set()
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture
def server(site):
    with serving(site) as server:
        yield server


class Reader:
    def __init__(self, context):
        self.context = context
        self.page = context.new_page()
        self.page.set_default_timeout(60_000)
        self.said = []
        self.page.on("console", self.hear)
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.status = self.page.locator(".run-status")

    def hear(self, message):
        if message.type in {"error", "warning"}:
            self.said.append(message.text)

    def open(self, address):
        self.page.goto(address)

    def click(self, name):
        self.page.get_by_role("button", name=name, exact=True).click()

    def run(self):
        self.click("Run")

    def type(self, text):
        self.page.locator(".run-code").click()
        self.page.locator(".cm-content").click()
        self.page.keyboard.press("Control+Home")
        self.page.keyboard.type(text)

    def text(self):
        with self.page.expect_download() as download:
            self.click("Download .py")
        return Path(download.value.path()).read_text(encoding="utf-8")

    def is_told(self, words):
        self.page.wait_for_function(TOLD, arg=words)

    def sees_how_much_has_come(self):
        some = re.compile(r"^Python is loading: [1-9]\d* of 1[3-6] MB\.$")
        self.status.filter(has_text=some).wait_for()

    def sees_a_picture(self):
        self.page.wait_for_selector(".run-output img")
        self.is_told("Your program ended")


@pytest.fixture
def reader(chromium):
    context = chromium.new_context()
    yield Reader(context)
    context.close()


def whl(site, start):
    (file,) = (site / "_run").glob(f"*/{start}*")
    return file.name


def test_loading_shows_how_far_it_is(server, reader):
    server.wrong = {BIG: "held"}
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.run()
    reader.sees_how_much_has_come()
    server.free.set()
    reader.sees_a_picture()


@pytest.mark.parametrize("kind", ["application/octet-stream", "text/plain"])
def test_a_wrong_type_of_webassembly_does_not_matter(server, reader, kind):
    server.wrong = {BIG: kind}
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.run()
    reader.sees_a_picture()


FAULTS = [
    (BIG, "missing", f"tell your teacher that {BIG} is missing"),
    (BIG, "dropped", "The connection was lost while Python was loading."),
    (BIG, "login page", "If your network wants you to log in, do so"),
    (BIG, "changed", f"tell your teacher that {BIG} is not the right file"),
    ("pyodide.asm.js", "missing", "tell your teacher that pyodide.asm.js is missing"),
    ("pyodide.asm.js", "login page", "If your network wants you to log in, do so"),
    ("python_stdlib.zip", "changed", "tell your teacher that python_stdlib.zip is not"),
    ("pyodide-lock.json", "login page", "If your network wants you to log in, do so"),
    ("numpy", "missing", "tell your teacher that numpy"),
    ("numpy", "changed", "tell your teacher that numpy"),
    ("worker.js", "missing", "tell your teacher that worker.js is missing"),
    ("worker.js", "login page", "If your network wants you to log in, do so"),
]


@pytest.mark.parametrize(("file", "wrong", "words"), FAULTS)
def test_what_is_wrong_is_told_and_run_works_when_it_is_gone(
    server, reader, site, file, wrong, words
):
    file = file if "." in file else whl(site, file)
    server.wrong = {file: wrong}
    # Bad answers that browsers may keep are the worst.
    server.headers = {"Cache-Control": "public, max-age=31536000, immutable"}
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.run()
    reader.is_told(words)
    told = reader.status.inner_text()
    assert "Traceback" not in reader.page.locator("canim-run").inner_text()
    assert "Press Run again" in told or "press Run again" in told
    server.wrong = {}
    reader.run()
    reader.sees_a_picture()


def test_scipy_that_is_missing_is_no_mistake_of_the_program(server, reader, site):
    server.wrong = {whl(site, "scipy-1"): "missing"}
    reader.open(f"{server.root}{MOUNT}{WARP}")
    reader.run()
    reader.is_told("tell your teacher that scipy")
    assert "spelling" not in reader.page.locator("canim-run").inner_text()
    server.wrong = {}
    reader.run()
    reader.is_told("Your program ended")


def test_a_line_that_brings_nothing_more_is_told_after_20_seconds(server, reader):
    server.wrong = {BIG: "held"}
    reader.page.clock.install()
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.run()
    reader.sees_how_much_has_come()
    for _ in range(500):  # the worker has its own clock, and must answer in between
        reader.page.clock.run_for(500)
        if "stopped loading" in reader.status.inner_text():
            break
    assert "Look at your connection to the network, then press Run again." in (
        reader.status.inner_text()
    )
    server.wrong = {}
    server.free.set()
    reader.run()
    reader.page.clock.resume()
    reader.sees_a_picture()


def test_python_is_kept_though_the_service_worker_comes_after_it(server, reader, is_kept):
    server.wrong = {"service_worker.js": "held"}
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.run()
    reader.sees_a_picture()
    server.free.set()
    reader.page.wait_for_function(f"() => {is_kept(server.root + MOUNT.rstrip('/'))}")


def test_a_policy_that_forbids_workers_or_requests_is_told(server, reader):
    for forbidden in ("worker-src", "connect-src"):
        server.headers = {"Content-Security-Policy": f"{forbidden} 'none'"}
        reader.open(f"{server.root}{MOUNT}{FIRST}")
        reader.run()
        reader.is_told("This site does not let your browser run Python. Tell your teacher.")


def test_a_page_older_than_the_site_offers_to_load_itself_again(server, reader, site):
    (folder,) = (site / "_run").iterdir()
    version = re.search(r"run\.js\?v=(\w+)", (site / FIRST).read_text(encoding="utf-8"))[1]

    def older(content):
        return content.replace(folder.name.encode(), b"0" * 12).replace(
            f"run.js?v={version}".encode(), b"run.js?v=00"
        )

    server.rewrite = older
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.type("# mine\n")
    server.rewrite = None
    reader.run()
    reader.is_told("This site has been renewed since you opened the page.")
    with reader.page.expect_navigation():
        reader.click("Load the page again")
    reader.run()
    reader.sees_a_picture()
    assert reader.text().startswith("# mine\n")


def test_a_policy_that_forbids_webassembly_is_told(server, reader):
    server.headers = {"Content-Security-Policy": "script-src 'self' 'unsafe-inline'"}
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.run()
    reader.is_told("This site does not let your browser run Python. Tell your teacher.")
    server.headers = {}
    reader.run()
    reader.sees_a_picture()


def test_a_frame_without_its_origin_is_told(server, reader):
    reader.open(f"{server.root}{MOUNT}404.html")
    reader.page.set_content(
        f'<iframe sandbox="allow-scripts" src="{server.root}{MOUNT}{FIRST}"></iframe>'
    )
    frame = reader.page.frame_locator("iframe")
    frame.get_by_text("Open it in a window of its own.").wait_for()
    assert frame.locator("canim-run pre").first.is_visible()


def test_too_little_memory_is_told(chromium, chromium_path, server):
    small = chromium.browser_type.launch(
        executable_path=chromium_path,
        args=["--no-sandbox", "--js-flags=--wasm-max-mem-pages=16"],
    )
    with closing(small):
        reader = Reader(small.new_context())
        reader.open(f"{server.root}{MOUNT}{FIRST}")
        reader.run()
        reader.is_told("There is not enough memory for Python. Close other tabs and programs")


def test_where_storage_is_blocked_all_works_and_a_warning_stays(
    chromium, chromium_path, server, tmp_path, request
):
    """Blocked in the browser's settings, as its users do it."""
    profile = tmp_path / "Default"
    profile.mkdir()
    settings = {"profile": {"default_content_setting_values": {"cookies": 2}}}
    (profile / "Preferences").write_text(json.dumps(settings), encoding="utf-8")
    context = chromium.browser_type.launch_persistent_context(
        tmp_path, executable_path=chromium_path, args=["--no-sandbox"]
    )
    request.addfinalizer(context.close)
    reader = Reader(context)
    reader.open(f"{server.root}{MOUNT}search.html?q=hermite")
    reader.page.wait_for_selector("#search-results li a")
    reader.page.locator(".theme-toggle:visible").first.click()
    assert reader.page.locator("body").get_attribute("data-theme") != "auto"
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.type("# mine\n")
    reader.run()
    reader.sees_a_picture()
    assert reader.page.get_by_text("This browser does not keep your program").is_visible()
    assert reader.said == []


def test_two_copies_of_the_site_do_not_share_texts(server, reader):
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    reader.type("# mine\n")
    reader.open(f"{server.root}{COPY}{FIRST}")
    assert not reader.text().startswith("# mine")
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    assert reader.text().startswith("# mine\n")


def test_all_works_under_the_policy_of_the_documentation(server, reader):
    reader.open(f"{server.root}{MOUNT}run_here.html")
    name, policy = reader.page.locator(".content-security-policy").inner_text().split(": ", 1)
    server.headers = {name: policy}
    for page in ("index.html", "search.html?q=hermite", "api/index.html", WARP, FIRST):
        reader.open(f"{server.root}{MOUNT}{page}")
        if "search" in page:
            reader.page.wait_for_selector("#search-results li a")
    reader.type("# mine\n")
    reader.run()
    reader.sees_a_picture()
    theme = reader.page.locator(".theme-toggle:visible").first
    theme.click()
    assert reader.page.locator("body").get_attribute("data-theme") != "auto"
    assert reader.said == []


def test_the_zip_works_on_a_server_as_it_does_from_a_folder(site, reader, tmp_path):
    with zipfile.ZipFile(site / "canim-course.zip") as course:
        course.extractall(tmp_path)
    failed = []
    reader.page.on("response", lambda r: failed.append(r.url) if r.status >= 400 else None)
    with serving(tmp_path / "canim-course") as server:
        for page in ("index.html", FIRST):
            reader.open(f"{server.root}{MOUNT}{page}")
        assert reader.page.locator("canim-run pre").first.is_visible()
        assert "Programs do not run here" in reader.page.locator(".run-missing").inner_text()
    assert reader.said + failed == []


def test_descriptions_of_pictures_can_be_read_in_the_dark(server, reader):
    reader.page.emulate_media(color_scheme="dark")
    reader.page.route(re.compile(r"_images/"), lambda route: route.abort())
    reader.open(f"{server.root}{MOUNT}{FIRST}")
    colours = reader.page.locator(".picture img").first.evaluate(
        "image => [getComputedStyle(image).color, getComputedStyle(image).backgroundColor]"
    )
    dark, light = (sum(map(int, re.findall(r"\d+", colour)[:3])) for colour in colours)
    assert light - dark > 400
