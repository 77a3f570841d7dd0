"""What readers carry away: each block on one page, to be printed, and the site as one zip."""

from __future__ import annotations

import re
import zipfile
from pathlib import PurePosixPath

from bs4 import BeautifulSoup
from docutils import nodes
from downloads import put_into
from sphinx.util.docutils import SphinxDirective

from canim.checks import BLOCKS, TASKS

OFFLINE = "canim-course.zip"
PRINTED = {f"gallery/{block}/print": block for block in BLOCKS}
# Python in the page needs a server; the rest is for Sphinx, or this file itself.
LEFT_OUT = {"_run", "service_worker.js", "_sources", ".buildinfo", OFFLINE}
COPIED = "You are reading it: this is the copy on your disk."
RUN = re.compile(r"<script[^>]*/run\.js[^>]*></script>")
COPY = re.compile(r'<p class="buttons" id="take-course">.*?</p>')
ONLY_ON_SCREEN = (
    "script, button, canim-run > template, .run-missing, .buttons, .task-install, .page-source, "
    ".task-cards, .headerlink"
)
REFERRING = ("id", "for", "aria-controls", "aria-describedby", "aria-labelledby")


class TakeAway(SphinxDirective):
    """`.. take-away:: course`, `starters` or `paper` puts buttons with what its argument names."""

    required_arguments = 1

    def run(self):
        kind = self.arguments[0]
        buttons = {
            "course": {OFFLINE: "The whole course"},
            "starters": {"starters/canim-starters.zip": "All starters"},
            "paper": {f"{page}.html": BLOCKS[block] for page, block in PRINTED.items()},
        }[kind]
        up = "../" * self.env.docname.count("/")
        links = "".join(
            f'<a href="{up}{address}" class="button">{text}'
            f"{' <span>(.zip)</span>' if address.endswith('.zip') else ''}</a>"
            for address, text in buttons.items()
        )
        return [nodes.raw("", f'<p class="buttons" id="take-{kind}">{links}</p>\n', format="html")]


def _print_pages(app):
    """Yield a page for each block: its own page and those of its tasks, one below the other."""
    for page, block in PRINTED.items():
        tasks = [task for task in TASKS.values() if task.block == block]
        names = ["index", *(PurePosixPath(task.page).name for task in tasks)]
        folder = app.outdir / "gallery" / block
        if not all((folder / f"{name}.html").exists() for name in names):
            continue  # a project with one page, as in tests
        parts = {name: _article(folder / f"{name}.html") for name in names}
        anchors = {name: f"{name}-page" for name in names}
        title = BLOCKS[block]
        for name, part in parts.items():
            _fit_in(part, name, anchors)
        contents = "".join(
            f'<li><a href="#{anchors[name]}">{parts[name].h2.decode_contents()}</a></li>'
            for name in names[1:]
        )
        body = "".join(
            f'<section id="{anchors[name]}" class="on-paper">{part.decode_contents()}</section>\n'
            for name, part in parts.items()
        )
        yield (
            page,
            {
                "title": f"{title}: all on one page",
                "description": f"{title}: the whole block with all its tasks on one page, to be "
                "printed or saved as a PDF.",
                "meta": {"hide-toc": True},
                "body": f"<h1>{title}: all on one page</h1>\n"
                "<p>Print this page, or save it as a PDF, with your browser.</p>\n"
                f"<ol>{contents}</ol>\n{body}",
            },
            "page.html",
        )


def _article(path):
    return BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser").article


def _fit_in(part, name, anchors):
    """Make a page a part of a larger one: its headings, its ids, and what paper cannot do."""
    for gone in part.select(ONLY_ON_SCREEN):
        gone.decompose()
    for run in part.find_all("canim-run"):
        run.unwrap()  # the program in it stays
    for image in part.select('details img[src$=".gif"]'):
        image.find_parent("details").decompose()
    for details in part.find_all("details"):
        details["open"] = ""
    for video in part.find_all("video"):
        size = {name: video[name] for name in ("width", "height", "style")}
        text = "A moment of the film that is described below."
        video.replace_with(part.new_tag("img", src=video["poster"], alt=text, attrs=size))
    for image in part.find_all("img"):
        image.attrs.pop("loading", None)  # a printer does not scroll
    for heading in part.find_all(re.compile("^h[1-5]$")):
        heading.name = f"h{int(heading.name[1]) + 1}"
    for element in part.find_all(True):
        for attribute in REFERRING:
            if attribute in element.attrs:
                value = element[attribute]
                words = value if isinstance(value, list) else value.split()
                element[attribute] = " ".join(f"{name}-{word}" for word in words)
    for link in part.find_all("a", href=True):
        page, _, anchor = link["href"].partition("#")
        other = PurePosixPath(page).stem if page else name
        if page in ("", f"{other}.html") and other in anchors:
            link["href"] = f"#{other}-{anchor}" if anchor else f"#{anchors[other]}"


def _zip(app, exception):
    if exception or app.builder.format != "html":
        return
    target = app.outdir / OFFLINE
    target.unlink(missing_ok=True)
    with zipfile.ZipFile(target, "w") as together:
        for path in sorted(app.outdir.rglob("*")):
            name = path.relative_to(app.outdir)
            if not path.is_file() or name.parts[0] in LEFT_OUT:
                continue
            data = path.read_bytes()
            if path.suffix == ".html":
                text = COPY.sub(f"<p>{COPIED}</p>", data.decode())
                data = RUN.sub("", text).encode()
            put_into(together, f"canim-course/{name.as_posix()}", data)


def setup(app):
    app.add_directive("take-away", TakeAway)
    app.connect("html-collect-pages", _print_pages)
    app.connect("build-finished", _zip, priority=999)  # when all is written
    return {"parallel_read_safe": True, "parallel_write_safe": True}
