"""The site as readers meet it: wide and narrow, light and dark, by mouse, key and ear."""

import gzip
import os
from pathlib import Path
from urllib.parse import urlsplit

import pytest

WIDTHS = (320, 768, 1280)
MOST_KB = 600
EAGER = """() => Promise.all([...document.images].map(i => {
  i.loading = "eager"; return i.decode().catch(() => null) }))"""
WIDER = "() => document.scrollingElement.scrollWidth - document.scrollingElement.clientWidth"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_page_is_sound(visit, address, violations, page, theme):
    opened = visit(page, color_scheme=theme)
    wrong = []
    for width in WIDTHS:
        opened.set_viewport_size({"width": width, "height": 900})
        opened.evaluate(EAGER)
        if opened.evaluate(WIDER) > 0:
            wrong.append(f"{width} px: the page scrolls sideways")
        if width != 768:  # the theme has the same parts as on a phone
            wrong += [f"{width} px: {found}" for found in violations(opened)]
    host = urlsplit(address).netloc
    wrong += [f"asked: {url}" for url in opened.asked if urlsplit(url).netloc not in ("", host)]
    wrong += [f"failed: {url}" for url in opened.failed]
    wrong += [f"console: {text}" for text in opened.said]
    assert wrong == []


def test_weight(visit, address, site, page):
    opened = visit(page)
    opened.evaluate(EAGER)
    opened.wait_for_load_state("networkidle")
    total = 0
    for url in set(opened.asked):
        path = site / urlsplit(url.removeprefix(f"{address}/")).path
        data = path.read_bytes()
        is_text = path.suffix in {".html", ".css", ".js", ".svg"}
        total += len(gzip.compress(data)) if is_text else len(data)
    assert total <= MOST_KB * 1000


def test_formulas_fit_a_phone(visit, task_page):
    opened = visit(task_page, viewport={"width": 320, "height": 640})
    wide = opened.locator(".formula-body").evaluate_all(
        "all => all.filter(f => f.scrollWidth > f.clientWidth + 1).map(f => f.textContent)"
    )
    assert wide == []


def test_numbers_stand_below_formulas_on_a_phone(visit, page):
    opened = visit(page, viewport={"width": 320, "height": 640})
    apart = opened.locator(".formula:has(.eqno)").evaluate_all(
        """all => all.map(f => f.querySelector(".eqno").getBoundingClientRect().top
                            - f.querySelector(".formula-body").getBoundingClientRect().bottom)"""
    )
    assert all(distance >= 0 for distance in apart)


def test_focus_is_seen(visit, task_page):
    opened = visit(task_page)
    seen = []
    for _ in range(25):
        opened.keyboard.press("Tab")
        seen.append(
            opened.evaluate(
                """() => { const e = document.activeElement, s = getComputedStyle(e);
                     return [e.outerHTML.slice(0, 80), s.outlineStyle, s.outlineWidth] }"""
            )
        )
    assert len({element for element, *_ in seen}) > 15
    # The search box shows its focus by its ground and cursor.
    hidden = [e for e, style, width in seen if style == "none" or width == "0px"]
    assert [e for e in hidden if "sidebar-search" not in e and "<body" not in e] == []


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
    opened = visit(task_page, viewport={"width": 700, "height": 900})
    opened.emulate_media(media="print")
    pre = opened.locator("article pre").evaluate_all(
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
