"""The Content-Security-Policy that a server may send with every page, and all works."""

from __future__ import annotations

import base64
import hashlib
import re
from html import escape

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval' HASHES; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; font-src 'self'; "
    "media-src 'self'; connect-src 'self'; worker-src 'self'; form-action 'self'; "
    "base-uri 'none'; frame-ancestors 'self'"
)
START = '<div class="wraps highlight"><pre class="content-security-policy" tabindex="0">'
WRITTEN = re.compile(f"{re.escape(START)}.*?</pre>")
INLINE = re.compile(r"<script>(.*?)</script>", re.S)


class ContentSecurityPolicy(SphinxDirective):
    """`.. content-security-policy::` shows the policy, once all pages are there."""

    def run(self):
        return [nodes.raw("", f"{START}</pre></div>\n", format="html")]


def hashes(page):
    """Return the hashes of the scripts that stand in a page itself, as a policy names them."""
    scripts = (script.encode() for script in INLINE.findall(page))
    digests = (base64.b64encode(hashlib.sha256(script).digest()) for script in scripts)
    return {f"'sha256-{digest.decode()}'" for digest in digests}


def _write(app, exception):
    if exception or app.builder.format != "html":
        return
    pages = {path: path.read_text(encoding="utf-8") for path in app.outdir.rglob("*.html")}
    found = sorted(set().union(*map(hashes, pages.values())))
    text = f"Content-Security-Policy: {POLICY.replace('HASHES', ' '.join(found))}"
    for path, page in pages.items():
        new = WRITTEN.sub(lambda _: f"{START}{escape(text, quote=False)}</pre>", page)
        if new != page:
            path.write_text(new, encoding="utf-8")


def setup(app):
    app.add_directive("content-security-policy", ContentSecurityPolicy)
    app.connect("build-finished", _write, priority=950)  # old pages are gone, the zip is not made
    return {"parallel_read_safe": True, "parallel_write_safe": True}
