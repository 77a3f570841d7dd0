"""Figures of executed pages look like those of the gallery, and have a text in words.

A page names the kernel `page` (in `jupyter/kernels`), which draws them as large and as sharp.
In a cell that draws, `# Picture: what is to be seen` stands above the figure. The code of a
cell with the tag `fold` is folded.
"""

from __future__ import annotations

import logging as python_logging
import os
from pathlib import Path

import pictures
from docutils import nodes
from PIL import Image
from sphinx.util import logging
from task_page import clean, fold

logger = logging.getLogger(__name__)


def _arrange(app, doctree):
    for cell in list(doctree.findall(_is_cell)):
        texts = [
            text
            for code in cell.findall(nodes.literal_block)
            if "cell_input" in code.parent["classes"]
            for text in _take_texts(code)
        ]
        for image in list(cell.findall(nodes.image)):
            if texts:
                image.replace_self(_picture(app, image["uri"], texts.pop(0)))
            else:
                _warn("a picture without a comment '# Picture: …' above it", cell)
        for trace in list(cell.findall(_is_empty_trace)):
            trace.parent.remove(trace)
        if "tag_fold" in cell["classes"]:
            cell[0].replace_self(fold("", cell[0].deepcopy(), summary="How this picture is drawn"))
        for text in texts:
            _warn(f"'# Picture: {text}' has no picture below it", cell)


def _is_cell(node):
    return isinstance(node, nodes.container) and "cell" in node["classes"]


def _is_empty_trace(node):
    """Tell what is left of a cell that a check has ended: its report says why."""
    return (
        isinstance(node, nodes.literal_block)
        and "traceback" in node["classes"]
        and not node.astext().strip()
    )


def _take_texts(code):
    texts = [text for kind, text in pictures.comments(code.astext()) if kind == "Picture"]
    clean(code)
    return texts


def _picture(app, uri, text):
    path = Path(app.srcdir, uri)
    smaller = path.with_suffix(".webp")
    with Image.open(path) as figure:
        width, height = (round(pixels / pictures.SHARP) for pixels in figure.size)
        if not smaller.exists():  # its name is made from what it shows
            pictures.save(figure.convert("RGB"), smaller)
    del app.env.images[uri]
    uri = uri.removesuffix(".png") + ".webp"
    app.env.images.add_file(app.env.docname, uri)
    return pictures.picture(alt=text, width=width, height=height, uri=uri, candidates={"*": uri})


def _warn(message, node):
    logger.warning(message, location=node, type="pictures")


def setup(app):
    paths = (str(Path(__file__).parent / "jupyter"), os.environ.get("JUPYTER_PATH"))
    os.environ["JUPYTER_PATH"] = os.pathsep.join(filter(None, paths))
    # A style of Pygments lets every library write to the terminal what it is doing.
    python_logging.getLogger("traitlets").setLevel(python_logging.WARNING)
    app.connect("doctree-read", _arrange)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
