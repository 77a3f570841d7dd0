"""What was loaded once works without the network."""

import re

from canim.checks import TASKS

FIRST = f"{TASKS['1.1'].page}.html"
LOOKS = """() => [
  document.title,
  ...[...document.styleSheets].map((sheet) => sheet.href),
  ...[...document.images].filter((image) => image.loading !== "lazy").map((image) => image.width),
]"""
ENDED = "() => /ended/.test(document.querySelector('.run-status').textContent)"


def test_a_page_and_its_program_work_again_without_a_server(chromium, serve, is_kept):
    context = chromium.new_context()
    page = context.new_page()
    page.set_default_timeout(60_000)

    def run():
        page.get_by_role("button", name="Run", exact=True).click()
        page.wait_for_selector(".run-output img")
        page.wait_for_function(ENDED)

    with serve() as (address, end):
        page.goto(f"{address}/{FIRST}")
        looks = page.evaluate(LOOKS)
        run()
        page.wait_for_function(f"() => {is_kept(address)}")
        end()
        page.reload()
        assert page.evaluate(LOOKS) == looks
        page.locator(".run-code").click()
        page.locator(".cm-content").wait_for()
        run()
    context.close()


def test_the_service_worker_knows_the_pages_and_pictures_of_the_site(site):
    """A page without the mark would never be kept, one without its path soon be removed."""
    known = (site / "service_worker.js").read_text(encoding="utf-8")
    pages = [path for path in site.rglob("*.html") if path.name != "404.html"]
    for path in (*pages, *(site / "_images").iterdir()):
        assert f'"{path.relative_to(site).as_posix()}"' in known
    for page in pages:
        assert re.search(r"<html\b[^>]*\sdata-content_root=", page.read_text(encoding="utf-8"))
