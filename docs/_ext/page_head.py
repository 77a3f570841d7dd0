"""What a page says of itself to search engines, and to readers who hear or type; where it is from.

``:repository:`the repository``` leads to the project's files, once `pyproject.toml` says where
they are. Until then it is these words, and the foot of the pages has no link either.
"""

from __future__ import annotations

import re
from html import escape
from pathlib import Path
from urllib.parse import quote

from docutils import nodes
from downloads import RELEASE
from markupsafe import Markup
from task_page import fold

# Where site data is blocked, or the disk is full, Sphinx's search and the theme's switch end at
# localStorage; it stands in for it, and must be there before all other scripts.
STAND_IN = Path(__file__).parents[1].joinpath("_web/stand_in.js").read_text(encoding="utf-8")
SITE = RELEASE.site.rstrip("/")
REPOSITORY = RELEASE.repository
LONGEST = 160
GENERATED = {
    "genindex": "All functions and classes of canim, from A to Z.",
    "search": "Search the pages of the canim course.",
    "404": "There is no page at this address. Here is the way back to the canim course.",
}
CARD = {
    "og:image:width": "1200",
    "og:image:height": "900",
    "og:image:alt": "A smooth curve, a portrait that turns into another, an arm, and two faces.",
    "twitter:card": "summary_large_image",
}
LANDMARKS = {
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="Site navigation">',
    '<aside class="toc-drawer': '<aside aria-label="On this page" class="toc-drawer',
    # docutils' roles for citations are no longer allowed inside a list.
    'role="doc-biblioentry"': 'role="listitem"',
    # A box that scrolls must be reached by keyboard.
    "<pre>": '<pre tabindex="0">',
    '<div class="table-wrapper': '<div tabindex="0" class="table-wrapper',
}


def _describe(app, pagename, templatename, context, doctree):
    text = GENERATED.get(pagename) or context.get("description") or _first_sentences(doctree)
    tags = {"description": text}
    if SITE:
        tags |= {
            "og:type": "website",
            "og:site_name": app.config.html_title,
            "og:title": Markup(context.get("title", "Index")).striptags(),
            "og:description": text,
            "og:url": f"{SITE}/{pagename}.html",
            "og:image": f"{SITE}/_static/canim.png",
            **CARD,
        }
    context["metatags"] = context.get("metatags", "") + "".join(
        f'<meta {"property" if ":" in name else "name"}="{name}" content="{escape(value)}">\n'
        for name, value in tags.items()
    )
    if pagename != "404":  # whose only script this would be
        context["metatags"] += f"<script>\n{STAND_IN}</script>\n"


def _first_sentences(doctree):
    """Return the beginning of a page's text, cut at the end of a sentence."""
    page = next(doctree.findall(nodes.section))
    paragraphs = [p for p in page.findall(nodes.paragraph) if not isinstance(p.parent, fold)]
    text = " ".join(paragraphs[0].astext().split()) if paragraphs else page[0].astext()
    if len(text) <= LONGEST:
        return text
    ends = [found.end() for found in re.finditer(r"[.!?](?= )", text) if found.end() <= LONGEST]
    return text[: ends[-1]] if ends else text[: text.rindex(" ", 0, LONGEST)] + " …"


def _label(app):
    """Complete what the theme's templates leave out and offer no block for."""
    if app.builder.format != "html":
        return
    render = app.builder.templates.render

    def labelled(template, context):
        html = render(template, context)
        for old, new in LANDMARKS.items():
            html = html.replace(old, new)
        return html

    app.builder.templates.render = labelled


def _map(app, exception):
    if exception or not SITE:
        return
    pages = sorted(app.env.found_docs)
    lines = [f"<url><loc>{SITE}/{page}.html</loc></url>" for page in pages]
    (app.outdir / "sitemap.xml").write_text(
        '<?xml version="1.0" encoding="utf-8"?>\n'
        '<urlset xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">\n'
        + "\n".join(lines) + "\n</urlset>\n",
        encoding="utf-8",
    )  # fmt: skip


def _missing(app):
    """Write 404.html. A server shows it at any address, so it has no relative ones in it."""
    icon = (Path(app.srcdir) / app.config.html_favicon).read_text(encoding="utf-8")
    address = "data:image/svg+xml," + quote(" ".join(icon.split()))
    yield "404", {"title": "No page here", "icon": address, "site": SITE}, "404.html"


def _set_address(app, config):
    config.html_baseurl = RELEASE.site
    if REPOSITORY:
        words = "All files of the course"
        link = {"name": words, "html": words, "class": "", "url": REPOSITORY}
        config.html_theme_options["footer_icons"] = [link]


def _to_repository(name, rawtext, text, lineno, inliner, options=None, content=None):
    if not REPOSITORY:
        return [nodes.Text(text)], []
    return [nodes.reference(rawtext, text, refuri=REPOSITORY)], []


def setup(app):
    app.add_role("repository", _to_repository)
    app.connect("config-inited", _set_address)
    app.connect("builder-inited", _label)
    app.connect("html-page-context", _describe)
    app.connect("html-collect-pages", _missing)
    app.connect("build-finished", _map)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
