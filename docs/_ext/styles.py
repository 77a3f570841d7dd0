"""One style sheet and one script for all pages: a request for each part delays the first paint."""

from __future__ import annotations

import re
import zlib

TOGETHER = {
    "site.css": (
        "pygments.css",
        "styles/furo.css",
        "katex.css",
        "copybutton.css",
        "styles/furo-extensions.css",
        "course.css",
        "run.css",
    ),
    "site.js": (
        "documentation_options.js",
        "doctools.js",
        "sphinx_highlight.js",
        "scripts/furo.js",
        "clipboard.min.js",
        "copybutton.js",
    ),
}
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

    for together, files in (("site.css", "css_files"), ("site.js", "script_files")):
        names = {file: (file.filename or "").rpartition("_static/")[2] for file in context[files]}
        context[files] = [
            f"_static/{together}?v={_version(app, together)}",
            *(
                # Its name has a version; Sphinx adds one where an earlier build has left it.
                f"_static/{name}" if name.startswith("mystnb.") else file
                for file, name in names.items()
                if name not in TOGETHER[together] and not is_seldom(name)
            ),
        ]


def _version(app, together):
    texts = (app.outdir.joinpath("_static", name).read_bytes() for name in TOGETHER[together])
    return f"{zlib.crc32(b''.join(texts)):08x}"


def _write(app, exception):
    if exception or app.builder.format != "html":
        return
    static = app.outdir / "_static"
    for together, names in TOGETHER.items():
        texts = [static.joinpath(name).read_text(encoding="utf-8") for name in names]
        text = re.sub(
            r"/\*# sourceMappingURL=.*?\*/|^//# sourceMappingURL=.*$",
            "",
            "\n".join(texts),
            flags=re.M,
        )
        (static / together).write_text(text, encoding="utf-8")


def setup(app):
    app.connect("html-page-context", _link, priority=900)
    # The theme completes its parts when the build is finished.
    app.connect("build-finished", _write, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
