"""What readers carry away: the site as a zip, which works from a disk, and pages for paper."""

import posixpath
import zipfile
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest

from canim.character import load_expressions
from canim.checks import BLOCKS, TASKS
from canim.data import face

NAME = "canim-course"


@pytest.fixture(scope="module")
def unpacked(site, tmp_path_factory):
    folder = tmp_path_factory.mktemp("disk")
    with zipfile.ZipFile(site / f"{NAME}.zip") as archive:
        archive.extractall(folder)
    assert [path.name for path in folder.iterdir()] == [NAME]
    return folder / NAME


def test_zip_is_the_site_without_itself(site, unpacked):
    files = {path.relative_to(site) for path in site.rglob("*") if path.is_file()}
    left_out = {"_run", "service_worker.js", "_sources", f"{NAME}.zip"}
    expected = {path for path in files if path.parts[0] not in left_out}
    assert {p.relative_to(unpacked) for p in unpacked.rglob("*") if p.is_file()} == expected
    assert [path for path in expected if path.suffix == ".mp4"]


def test_the_head_is_handed_out_as_the_files_that_the_paper_reads(site, tmp_path):
    with zipfile.ZipFile(site / "starters/canim-head.zip") as archive:
        archive.extractall(tmp_path)
    head = load_expressions(tmp_path / "canim-head")
    np.testing.assert_array_equal(head.shapes, face().shapes)
    assert "CC0" in (tmp_path / "canim-head/LICENSE.md").read_text(encoding="utf-8")


def test_zip_does_not_tell_when_it_was_made(site):
    with zipfile.ZipFile(site / f"{NAME}.zip") as archive:
        assert {member.date_time for member in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_links_lead_to_files(unpacked, read_pages):
    """On a disk a folder is no page, and what a page names must be beside it."""
    broken = []
    for page, document in read_pages(unpacked).items():
        for element in document.elements:
            for key in ("href", "src", "poster"):
                parts = urlsplit(element.get(key) or "")
                if parts.scheme or not parts.path or element.get("rel") == "canonical":
                    continue
                target = posixpath.join(posixpath.dirname(page), unquote(parts.path))
                if not (unpacked / posixpath.normpath(target)).is_file():
                    broken.append(f"{page}: {element[key]}")
    assert broken == []


@pytest.fixture
def disk(chromium):
    context = chromium.new_context()
    page = context.new_page()
    page.said = []
    page.on("console", lambda message: page.said.append(f"{page.url}: {message.text}"))
    page.on("pageerror", lambda error: page.said.append(f"{page.url}: {error}"))
    page.on("requestfailed", lambda r: page.said.append(f"{r.failure}: {r.url}"))
    yield page
    context.close()


def test_pages_open_from_a_disk(disk, unpacked):
    for path in sorted(unpacked.rglob("*.html")):
        disk.goto(path.as_uri(), wait_until="load")
        assert disk.locator("h1").first.is_visible(), path
    # An icon may still be on its way when the next page is opened.
    assert [text for text in disk.said if not text.startswith("net::ERR_ABORTED")] == []


def test_search_works_from_a_disk(disk, unpacked):
    disk.goto(f"{(unpacked / 'index.html').as_uri()}")
    disk.locator("input[name=q]").click()
    disk.keyboard.type("hermite")
    disk.keyboard.press("Enter")
    disk.locator("#search-results li a", has_text="Task 1.1").click()
    assert "task_1_1" in disk.url
    assert disk.said == []


def test_copy_on_a_disk_says_so(unpacked):
    page = (unpacked / "students/take_away.html").read_text(encoding="utf-8")
    assert f"{NAME}.zip" not in page
    assert "this is the copy on your disk" in page


@pytest.mark.parametrize("block", BLOCKS)
def test_a_block_on_paper(visit, block):
    """All tasks in order, nothing folded, nothing that only a screen can do, nothing cut off."""
    opened = visit(f"gallery/{block}/print.html", viewport={"width": 700, "height": 900})
    opened.emulate_media(media="print")
    titles = opened.locator("article h2").all_text_contents()
    tasks = [f"Task {t.id}: " for t in TASKS.values() if t.block == block]
    assert titles[0] == BLOCKS[block]
    assert [title[: len(task)] for title, task in zip(titles[1:], tasks, strict=True)] == tasks
    assert opened.locator("article pre", has_text="# TODO").count() >= len(tasks)
    assert (
        opened.locator("video, canim-run, details:not([open]), button.copybtn:visible").count() == 0
    )
    assert not opened.locator(".skip-to-content").is_visible()  # it would be on every sheet
    wide = opened.locator("article pre, article img, article .formula-body").evaluate_all(
        "all => all.filter(e => e.getBoundingClientRect().right > innerWidth + 1).length"
    )
    assert wide == 0


def test_links_of_a_block_on_paper_stay_there(visit):
    opened = visit("gallery/interpolation/print.html")
    links = opened.locator("article a[href*=task_1_2]").evaluate_all(
        "all => all.map(a => a.getAttribute('href'))"
    )
    assert links
    assert all(link.startswith("#task_1_2") for link in links)
