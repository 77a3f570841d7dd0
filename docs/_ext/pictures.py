"""Pictures, films and check reports of the gallery's scripts.

`scrape` and `reset` are called by sphinx-gallery while it runs a script. Above each
figure the script has a comment `# Picture: what is to be seen` (for an animation
`# Film: …`), which becomes the alternative text; the directives `picture` and `film`
warn where it is missing. What a check reports is shown in its place, above the figures.
"""

from __future__ import annotations

import re
import textwrap
from collections import deque
from html import escape
from pathlib import Path
from typing import ClassVar

import imageio_ffmpeg
from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective

logger = logging.getLogger(__name__)

CSS_DPI = 100  # a figure of 6.4 inches is 640 pixels wide on the page
SHARP = 2  # pixels of the file per pixel of the page
THUMB_WIDTH = 480
# One thread and no dates: the same film has the same bytes.
FILM = (
    "-threads 1 -fflags +bitexact -flags:v +bitexact -map_metadata -1"
    " -crf 24 -preset slow -movflags +faststart"
)
COMMENT = re.compile(r"^# (Picture|Film): (.*\n(?:#(?! Picture:| Film:).*\n)*)", re.M)

_reports = []


def reset(gallery_conf, fname):
    """Before a script runs: collect its reports, do not print them."""
    import canim.checks

    _reports.clear()
    canim.checks.show = _reports.append


def scrape(block, block_vars, gallery_conf):
    """Save the figures that a block has made; return the rst that shows them."""
    import matplotlib.pyplot as plt
    from matplotlib.animation import Animation

    texts = {"Picture": deque(), "Film": deque()}
    for kind, text in COMMENT.findall(block.content + "\n"):
        texts[kind].append(" ".join(re.sub(r"^# ?", "", text, flags=re.M).split()))
    variables = block_vars["example_globals"].values()
    # By the figure, not by its number: an animation of an earlier block is still a variable.
    films = {v._fig: v for v in variables if isinstance(v, Animation)}
    rst = [_report(report) for report in _reports]
    _reports.clear()
    for number, path in zip(plt.get_fignums(), block_vars["image_path_iterator"], strict=False):
        path = Path(path)
        figure = plt.figure(number)
        kind = "Film" if figure in films else "Picture"
        if kind == "Film":
            _save_film(films[figure], path)
        else:
            _save_picture(figure, path)
        if path.stem.endswith("_001"):
            _save_thumb(path)
        alt = texts[kind].popleft() if texts[kind] else ""
        address = "/" + path.relative_to(gallery_conf["src_dir"]).as_posix()
        width, height = (round(inches * CSS_DPI) for inches in figure.get_size_inches())
        rst.append(
            f".. {kind.lower()}:: {address}\n   :alt: {alt}\n"
            f"   :width: {width}\n   :height: {height}\n"
        )
    plt.close("all")
    rst += [f".. {kind.lower()}::\n   :alt: {text}\n" for kind in texts for text in texts[kind]]
    return "\n\n".join(rst)


def _report(report):
    return ".. raw:: html\n\n" + textwrap.indent(report._repr_html_(), "   ")


def _save_picture(figure, path):
    figure.savefig(path, dpi=SHARP * CSS_DPI, metadata={"Software": None})
    _save_small(path, path)


def _save_thumb(picture):
    folder = picture.parent / "thumb"
    folder.mkdir(exist_ok=True)
    _save_small(picture, folder / f"{picture.stem}_thumb.png", THUMB_WIDTH)


def _save_small(source, target, width=None):
    """Save a PNG with a palette where the eye cannot tell, as it cannot in line plots."""
    from PIL import Image, ImageChops

    with Image.open(source) as image:
        image = image.convert("RGB")
    if width:
        image = image.resize((width, round(image.height * width / image.width)), Image.LANCZOS)
    small = image.quantize(256, Image.Quantize.MAXCOVERAGE)
    _keep_ground(image, small)
    error = ImageChops.difference(image, small.convert("RGB")).convert("L")
    if sum(error.histogram()[12:]) < 0.001 * image.width * image.height:
        image = small
    image.save(target, optimize=True)


def _keep_ground(image, small):
    """Give the commonest colour, a figure's ground, back to the palette as it was."""
    _, ground = max(image.getcolors(image.width * image.height))
    _, index = max(small.getcolors())
    palette = small.getpalette()
    palette[3 * index : 3 * index + 3] = ground
    small.putpalette(palette)


def _save_film(animation, poster):
    """Save the animation as mp4, always with the same bytes, and its middle as a picture."""
    from matplotlib.animation import AbstractMovieWriter

    class Writer(AbstractMovieWriter):
        """Hands each frame on as it was drawn; matplotlib's own draws it three times."""

        def setup(self, fig, outfile, dpi=None):
            fig.dpi = dpi
            super().setup(fig, outfile, dpi)
            self.frames_left = len(list(animation.new_saved_frame_seq())) // 2
            self.film = imageio_ffmpeg.write_frames(
                str(outfile),
                tuple(map(round, self.frame_size)),
                pix_fmt_in="rgba",
                fps=self.fps,
                quality=None,
                macro_block_size=2,
                output_params=FILM.split(),
            )
            self.film.send(None)

        def grab_frame(self, **options):
            self.film.send(self.fig.canvas.buffer_rgba())
            if self.frames_left == 0:
                _save_picture(self.fig, poster)
            self.frames_left -= 1

        def finish(self):
            self.film.close()

    figure = animation._fig
    # Axes that are laid out anew for each frame would tremble.
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    writer = Writer(fps=round(1000 / animation._interval))
    animation.save(poster.with_suffix(".mp4"), writer=writer, dpi=1.5 * CSS_DPI)


class picture(nodes.image):
    """A picture with its size, so that the page does not jump while it loads."""


class film(nodes.image):
    """A film; its only child is the picture shown before it plays."""


class Picture(SphinxDirective):
    """`.. picture:: /path.png` with :alt:, :width:, :height: in pixels of the page."""

    optional_arguments = 1
    final_argument_whitespace = True
    option_spec: ClassVar = {
        "alt": directives.unchanged,
        "width": directives.nonnegative_int,
        "height": directives.nonnegative_int,
    }
    node = picture

    def run(self):
        kind = self.node.__name__
        alt = self.options.get("alt", "")
        if not self.arguments:
            self.warn(f"'# {kind.title()}: {alt}' has no {kind} below it")
            return []
        if not alt:
            self.warn(f"a {kind} without a comment '# {kind.title()}: …' above it")
        size = {key: self.options[key] for key in ("width", "height") if key in self.options}
        return [self.make(self.arguments[0], alt, size)]

    def warn(self, message):
        logger.warning(message, location=self.get_location(), type="pictures")

    def make(self, uri, alt, size):
        return picture(uri=uri, alt=alt, **size)


class Film(Picture):
    """`.. film:: /path.png`, the picture shown before it plays; the film lies beside it."""

    node = film

    def make(self, uri, alt, size):
        still = picture(uri=uri, alt="", **size)
        return film("", still, uri=re.sub(r"\.png$", ".mp4", uri), alt=alt, **size)


def _address(writer, node):
    name = writer.builder.images.get(node["uri"])
    return f"{writer.builder.imgpath}/{name}" if name else node["uri"]


def _size(node):
    return "".join(f' {key}="{node[key]}"' for key in ("width", "height") if key in node)


def visit_picture(self, node):
    # The first picture is often what a page shows first: only later ones wait.
    lazy = ' loading="lazy"' if getattr(self, "_seen_picture", False) else ""
    self._seen_picture = True
    self.body.append(
        f'<div class="picture"><img src="{_address(self, node)}" alt="{escape(node["alt"])}"'
        f'{_size(node)}{lazy} decoding="async"></div>\n'
    )
    raise nodes.SkipNode


def visit_film(self, node):
    source, text = _address(self, node), escape(node["alt"])
    self.body.append(
        f'<figure class="film"><video controls muted playsinline preload="none"'
        f' poster="{_address(self, node[0])}"{_size(node)} aria-label="Film: {text}">'
        f'<source src="{source}" type="video/mp4">'
        f'<a href="{source}">Download the film</a></video>'
        f"<figcaption>Film: {text}</figcaption></figure>\n"
    )
    raise nodes.SkipNode


def setup(app):
    app.add_node(picture, html=(visit_picture, None))
    app.add_node(film, html=(visit_film, None))
    app.add_directive("picture", Picture)
    app.add_directive("film", Film)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
