"""What every page's source must have."""

import posixpath
import re
from itertools import pairwise
from urllib.parse import unquote, urlsplit


def test_head(documents, page):
    document = documents[page]
    assert document.all("html")[0]["lang"] == "en"
    assert len(document.all("title")[0]["text"]) > len("canim")
    described = [e["content"] for e in document.all("meta") if e.get("name") == "description"]
    assert len(described) == 1
    assert 20 <= len(described[0]) <= 320
    assert [e for e in document.all("link") if "icon" in e.get("rel", "")]


def test_titles_differ(documents):
    titles = [document.all("title")[0]["text"] for document in documents.values()]
    assert len(titles) == len(set(titles))


def test_headings(documents, page):
    levels = [int(e["tag"][1]) for e in documents[page].all("h1", "h2", "h3", "h4", "h5", "h6")]
    assert levels.count(1) == 1
    assert levels[0] == 1
    assert all(b <= a + 1 for a, b in pairwise(levels))


def test_every_public_name_is_in_the_api(documents):
    import canim

    ids = {name for page in documents if page.startswith("api/") for name in documents[page].ids}
    parts = [getattr(canim, name) for name in canim.__all__ if name != "check"]
    names = {f"{part.__name__}.{name}" for part in parts for name in part.__all__}
    names = {name.replace("canim.checks.check", "canim.check") for name in names}
    assert names - ids == set()


def test_ids_are_unique(documents, page):
    ids = documents[page].ids
    assert sorted(ids) == sorted(set(ids))


def test_links_and_anchors(documents, site, page):
    document, broken = documents[page], []
    used = [e.get("href") or e.get("src") or e.get("poster") for e in document.elements]
    for link in filter(None, used):
        parts = urlsplit(link)
        if parts.scheme or link.startswith("data:"):
            continue
        path = posixpath.normpath(posixpath.join(posixpath.dirname(page), unquote(parts.path)))
        target = page if not parts.path else path
        if (
            target.startswith("..")
            or not (site / target).is_file()
            or (
                target in documents
                and parts.fragment
                and unquote(parts.fragment) not in documents[target].ids
            )
        ):
            broken.append(link)
    assert not broken


def test_alternative_texts(documents, page):
    for image in documents[page].all("img"):
        text = image["alt"]
        stem = posixpath.splitext(posixpath.basename(image["src"]))[0]
        assert len(text.split()) >= 4, image["src"]
        assert re.sub(r"\W+", "", text) != re.sub(r"\W+", "", stem)
        assert int(image["width"]) > 0
        assert int(image["height"]) > 0


def test_films(documents, page):
    document = documents[page]
    for video in document.all("video"):
        assert len(video["aria-label"].split()) >= 5
        assert {"controls", "muted", "playsinline", "poster"} <= set(video)
        assert "autoplay" not in video
        assert video["preload"] == "none"
        captions = [e["text"] for e in document.all("figcaption")]
        assert video["aria-label"] in captions


def test_formulas_are_rendered(documents, page):
    document = documents[page]
    text = "".join(e["text"] for e in document.all("article"))
    formulas = [e for e in document.all("span", "div") if e.get("class") in ("math", "formula")]
    assert len(document.all("math")) >= len(formulas)
    assert "katex-error" not in text
    assert [e for e in document.all("mtable") if e.get("columnspacing") == ""] == []
    assert not [e for e in document.elements if "mathjax" in (e.get("src") or "").lower()]


def test_task_page_has_its_parts(documents, task_page):
    document = documents[task_page]
    headings = [e["text"].rstrip("¶") for e in document.all("h2")]
    assert headings == [
        "Expected result",
        "Theory",
        "Pseudocode",
        "Your task",
        "Check and draw",
        "Think about it",
        "Read more",
    ]
    card = next(e["text"] for e in document.all("div") if "task-card" in e.get("class", ""))
    for fact in ("You write", "Builds on", "Time", "In the paper", "pip install canim-"):
        assert fact in card
    folded = [e["text"] for e in document.all("summary")]
    assert folded[0].startswith("Set-up")
    assert any(text.startswith("How this") for text in folded)
    assert [e for e in document.all("div") if e.get("class") == "canim-report"]
    links = [e["href"] for e in document.all("a")]
    for ending in (".py", ".ipynb", ".whl"):
        assert [link for link in links if link.endswith(ending)]
    shown = "".join(e["text"] for e in document.all("pre"))
    assert "# Picture:" not in shown
    assert "noqa" not in shown
