"""One style sheet for all pages: with a request for each of its parts a page paints later."""

from __future__ import annotations

import re
import zlib

TOGETHER = (
    "pygments.css",
    "styles/furo.css",
    "katex.css",
    "copybutton.css",
    "styles/furo-extensions.css",
    "course.css",
)
# What extensions link on every page, and the classes of the pages that need it.
SELDOM = {
    "sphinx-design.min.css": "sd-",
    "design-tabs.js": "sd-tab",
    "mystnb.": "cell",
    "sg-tags.js": "sphx-glr-tag",
}


def _link(app, pagename, templatename, context, doctree):
    used = set(" ".join(re.findall(r'class="([^"]*)"', context.get("body", ""))).split())

    def is_seldom(name):
        return any(
            name.startswith(start) and not any(css.startswith(prefix) for css in used)
            for start, prefix in SELDOM.items()
        )

    def names(files):
        return {file: (file.filename or "").rpartition("_static/")[2] for file in files}

    styles, scripts = names(context["css_files"]), names(context["script_files"])
    context["script_files"] = [file for file, name in scripts.items() if not is_seldom(name)]
    context["css_files"] = [
        f"_static/site.css?v={_version(app)}",
        *(file for file, name in styles.items() if name not in TOGETHER and not is_seldom(name)),
    ]


def _version(app):
    texts = (app.outdir.joinpath("_static", name).read_bytes() for name in TOGETHER)
    return f"{zlib.crc32(b''.join(texts)):08x}"


def _write(app, exception):
    if exception or app.builder.format != "html":
        return
    static = app.outdir / "_static"
    texts = [static.joinpath(name).read_text(encoding="utf-8") for name in TOGETHER]
    text = re.sub(r"/\*# sourceMappingURL=.*?\*/", "", "\n".join(texts))
    (static / "site.css").write_text(text, encoding="utf-8")


def setup(app):
    app.connect("html-page-context", _link, priority=900)
    # The theme completes its parts when the build is finished.
    app.connect("build-finished", _write, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
