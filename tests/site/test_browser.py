"""The site as readers meet it: wide and narrow, light and dark, by mouse, key and ear."""

import gzip
import os
from itertools import product
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from canim.checks import BLOCKS

WIDTHS = (320, 768, 1280)
# What axe finds wrong in the dark only: other rules never ask for a colour.
RULES = {"light": (), "dark": ("color-contrast", "link-in-text-block")}
MOST_KB = 600
MOST_KB_TO_PRINT = 2000  # a page for paper has all pictures of a block
EAGER = """() => Promise.all([...document.images].map(i => {
  i.loading = "eager"; return i.decode().catch(() => null) }))"""
WIDER = "() => document.scrollingElement.scrollWidth - document.scrollingElement.clientWidth"


def test_page_is_sound(visit, address, site, violations, page):
    """One visit a page: what costs time is to load and to lay it out."""
    opened = visit(page, color_scheme="light")
    wrong = []
    for theme, width in product(RULES, WIDTHS):
        opened.emulate_media(color_scheme=theme)
        opened.set_viewport_size({"width": width, "height": 900})
        opened.evaluate(EAGER)
        if opened.evaluate(WIDER) > 0:
            wrong.append(f"{theme}, {width} px: the page scrolls sideways")
        wrong += [f"{theme}, {width} px: {found}" for found in violations(opened, *RULES[theme])]
    opened.wait_for_load_state("networkidle")
    host = urlsplit(address).netloc
    wrong += [f"asked: {url}" for url in opened.asked if urlsplit(url).netloc not in ("", host)]
    wrong += [f"failed: {url}" for url in opened.failed]
    wrong += [f"console: {text}" for text in opened.said]
    most = MOST_KB_TO_PRINT if page.endswith("/print.html") else MOST_KB
    if (weight := weigh(site, address, opened.asked)) > most * 1000:
        wrong.append(f"{weight} bytes are more than {most} KB")
    assert wrong == []


def weigh(site, address, asked):
    """Return the bytes that were sent, texts compressed as a server does it."""
    total = 0
    for url in set(asked):
        path = site / urlsplit(url.removeprefix(f"{address}/")).path
        data = path.read_bytes()
        is_text = path.suffix in {".html", ".css", ".js", ".svg"}
        total += len(gzip.compress(data)) if is_text else len(data)
    return total


def test_formulas_fit_a_phone(visit, formula_page):
    """They are no wider than the page, and their numbers stand below them."""
    opened = visit(formula_page, viewport={"width": 320, "height": 640})
    wide = opened.locator(".formula-body").evaluate_all(
        "all => all.filter(f => f.scrollWidth > f.clientWidth + 1).map(f => f.textContent)"
    )
    assert wide == []
    apart = opened.locator(".formula:has(.eqno)").evaluate_all(
        """all => all.map(f => f.querySelector(".eqno").getBoundingClientRect().top
                            - f.querySelector(".formula-body").getBoundingClientRect().bottom)"""
    )
    assert all(distance >= 0 for distance in apart)


FOCUSED = """() => { const e = document.activeElement;
  const s = getComputedStyle(e.closest(".cm-editor") ?? e);
  const kinds = {fold: "summary", card: ".task-card a", code: "pre", editor: ".cm-content",
                 next: ".next-page"};
  return {what: Object.keys(kinds).find(kind => e.matches(kinds[kind])) ?? e.tagName,
          text: e.outerHTML.slice(0, 80), inside: !!e.closest("article, .related-pages"),
          hidden: s.outlineStyle === "none" || s.outlineWidth === "0px"} }"""


def test_keyboard_walks_through_the_page(visit, task_page):
    """From the top, past the navigation, in order to the link to what comes next."""
    opened = visit(task_page)
    opened.keyboard.press("Tab")
    assert "#furo-main-content" in opened.evaluate(FOCUSED)["text"]
    opened.keyboard.press("Enter")
    stops = []
    while not stops or stops[-1]["what"] != "next":
        opened.keyboard.press("Tab")
        stops.append(opened.evaluate(FOCUSED))
        assert len(stops) < 150, "the keyboard does not get on"
        if stops[-1]["what"] == "editor":
            opened.keyboard.press("Escape")  # the Tab key belongs to the program; the page says it
        if stops[-1]["what"] == "fold":
            opened.keyboard.press("Enter")
            assert opened.evaluate("() => document.activeElement.parentElement.open")
    assert [stop["text"] for stop in stops if not stop["inside"]] == []
    assert [stop["text"] for stop in stops if stop["hidden"]] == []
    first = {what: [s["what"] for s in stops].index(what) for what in ("card", "fold", "code")}
    assert first["card"] < first["fold"] < first["code"]
    opened.keyboard.press("Enter")
    opened.wait_for_load_state("load")
    assert not opened.url.endswith(task_page)


def test_focus_is_seen(visit, page):
    opened = visit(page)
    seen = []
    for _ in range(12):
        opened.keyboard.press("Tab")
        seen.append(opened.evaluate(FOCUSED))
    # The search box shows its focus by its ground and cursor.
    hidden = [stop["text"] for stop in seen if stop["hidden"]]
    assert [text for text in hidden if "sidebar-search" not in text and "<body" not in text] == []


def test_the_page_for_wrong_addresses_is_whole_in_itself(visit):
    opened = visit("404.html")
    assert len(opened.asked) == 1
    assert opened.locator("h1").is_visible()


def test_without_javascript(visit, task_page):
    opened = visit(task_page, java_script_enabled=False)
    assert opened.locator(".formula .katex-html").first.is_visible()
    code = opened.locator("details.fold pre").first
    assert not code.is_visible()
    opened.locator("details.fold summary").first.click()
    assert code.is_visible()
    assert opened.locator(".picture img").first.is_visible()
    assert opened.locator(".task-card a.button").first.is_visible()


def test_dark_page_is_dark(visit):
    grounds = [
        visit("index.html", color_scheme=theme).evaluate(
            "() => getComputedStyle(document.body).backgroundColor"
        )
        for theme in ("light", "dark")
    ]
    assert grounds[0] != grounds[1]


def test_paper(visit, task_page):
    """Printed, folded code is open and no line of code is cut off."""
    # On paper, the whole program stands in the place of the editor.
    opened = visit(task_page, viewport={"width": 700, "height": 900})
    opened.emulate_media(media="print")
    pre = opened.locator("article pre:not(.run-code pre)").evaluate_all(
        "all => all.map(e => [e.getBoundingClientRect().height, e.scrollWidth - e.clientWidth])"
    )
    assert pre
    assert all(height > 0 and over <= 1 for height, over in pre)


def test_search_finds(visit):
    opened = visit("search.html?q=hermite")
    opened.wait_for_selector("#search-results li a")
    links = opened.locator("#search-results li a").evaluate_all("all => all.map(a => a.href)")
    assert any("task_1_1" in link for link in links)
    assert opened.said == []


def test_downloads(visit, task_page, tmp_path):
    opened = visit(task_page)
    for button in opened.locator(".task-card a[download]").all():
        with opened.expect_download() as download:
            button.click()
        target = tmp_path / os.path.basename(download.value.url)
        download.value.save_as(target)
        assert target.stat().st_size > 0
    assert {path.suffix for path in Path(tmp_path).iterdir()} == {".py", ".ipynb", ".whl"}


@pytest.mark.parametrize("block", BLOCKS)
def test_the_copyright_has_no_sheet_of_its_own(visit, block):
    """At the end of a block it often had: so on paper it is at the beginning."""
    opened = visit(f"gallery/{block}/print.html")
    opened.emulate_media(media="print")
    copyright_ = opened.locator("footer").bounding_box()
    text = opened.locator("article").bounding_box()
    assert copyright_["height"] > 0
    assert copyright_["y"] + copyright_["height"] <= text["y"]
