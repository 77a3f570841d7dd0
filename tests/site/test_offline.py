"""What was loaded once works without the network."""

import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest

from canim.checks import TASKS

FIRST = f"{TASKS['1.1'].page}.html"
LOOKS = """() => [
  document.title,
  ...[...document.styleSheets].map((sheet) => sheet.href),
  ...[...document.images].filter((image) => image.loading !== "lazy").map((image) => image.width),
]"""
ENDED = "() => /ended/.test(document.querySelector('.run-status').textContent)"


class Handler(SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


@pytest.fixture
def server(site):
    """A server of its own, that a test can end."""
    serving = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(site)))
    threading.Thread(target=serving.serve_forever).start()

    def end():
        serving.shutdown()
        serving.server_close()

    yield f"http://127.0.0.1:{serving.server_port}/", end
    end()


def test_a_page_and_its_program_work_again_without_a_server(chromium, server):
    address, end = server
    context = chromium.new_context()
    page = context.new_page()
    page.set_default_timeout(60_000)

    def run():
        page.get_by_role("button", name="Run", exact=True).click()
        page.wait_for_selector(".run-output img")
        page.wait_for_function(ENDED)

    page.goto(address + FIRST)
    looks = page.evaluate(LOOKS)
    run()
    end()
    page.reload()
    assert page.evaluate(LOOKS) == looks
    run()
    context.close()
