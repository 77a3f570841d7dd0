"""Figures of executed pages look like those of the gallery, and have a text in words.

A page names the kernel `page` (in `jupyter/kernels`), which draws them as large and as sharp.
In a cell that draws, `# Picture: what is to be seen` stands above the figure. A cell that ends
with an animation shows its film, and has `# Film: what is to be seen`. The code of a cell with
the tag `fold` is folded, that of one with the tag `only-result` is not on the page.
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

EXT = Path(__file__).parent
FILMS = "films"


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
                image.replace_self(_shown(app, image, *texts.pop(0)))
            else:
                _warn("a picture without a comment '# Picture: …' above it", cell)
        for trace in list(cell.findall(_is_empty_trace)):
            trace.parent.remove(trace)
        if "tag_fold" in cell["classes"]:
            kind = "film" if next(cell.findall(pictures.film), None) else "picture"
            summary = f"How this {kind} is drawn"
            cell[0].replace_self(fold("", cell[0].deepcopy(), summary=summary))
        elif "tag_only-result" in cell["classes"]:
            cell.pop(0)
        for kind, text in texts:
            _warn(f"'# {kind}: {text}' has no {kind.lower()} below it", cell)


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
    texts = [(kind, text) for kind, text in pictures.comments(code.astext()) if kind != "GIF"]
    clean(code)
    return texts


def _shown(app, image, kind, text):
    """Return the picture or film that a cell has drawn, with its text and its size."""
    path = Path(app.srcdir, image["uri"])
    smaller = path.with_suffix(".webp")
    with Image.open(path) as figure:
        width, height = (round(pixels / pictures.SHARP) for pixels in figure.size)
        if not smaller.exists():  # its name is made from what it shows
            pictures.save(figure.convert("RGB"), smaller)
    del app.env.images[image["uri"]]
    size = {"width": width, "height": height}
    if kind == "Picture":
        return pictures.picture(alt=text, **_file(app, smaller), **size)
    still = pictures.picture(alt="", **_file(app, smaller), **size)
    film = Path(app.doctreedir, FILMS, f"{path.stem}.mp4")
    return pictures.film("", still, alt=text, **_file(app, film), **size)


def _file(app, path):
    """Return the attributes by which Sphinx finds a file that is not among the sources."""
    uri = Path(os.path.relpath(path, app.srcdir)).as_posix()
    app.env.images.add_file(app.env.docname, uri)
    return {"uri": uri, "candidates": {"*": uri}}


def _say_where_films_go(app):
    os.environ["PAGE_FILMS"] = str(Path(app.doctreedir, FILMS))


def _warn(message, node):
    logger.warning(message, location=node, type="pictures")


def setup(app):
    _put_first("JUPYTER_PATH", EXT / "jupyter")
    _put_first("PYTHONPATH", EXT)  # for the kernel, which saves films
    # A style of Pygments lets every library write to the terminal what it is doing.
    python_logging.getLogger("traitlets").setLevel(python_logging.WARNING)
    app.connect("builder-inited", _say_where_films_go)
    app.connect("doctree-read", _arrange)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _put_first(variable, folder):
    os.environ[variable] = os.pathsep.join(filter(None, (str(folder), os.environ.get(variable))))
