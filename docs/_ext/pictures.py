"""Pictures, films and check reports of the gallery's scripts.

`scrape` and `reset` are called by sphinx-gallery while it runs a script. Above each
figure the script has a comment `# Picture: what is to be seen` (for an animation
`# Film: …`), which becomes the alternative text; the directives `picture` and `film`
warn where it is missing. Below `# GIF: …` the script saves a file, which is shown as well.
What a check reports is shown in its place, above the figures.
"""

from __future__ import annotations

import hashlib
import io
import os
import re
import shutil
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
PAGE_SCALE = 1.15  # a picture as wide as the text is shown a little larger
SHARP = 2  # pixels of the file per pixel of the page
THUMB_WIDTH = 480
WEBP_QUALITY = 85
# One thread and no dates: the same film has the same bytes.
FILM = (
    "-threads 1 -fflags +bitexact -flags:v +bitexact -map_metadata -1"
    " -crf 24 -preset slow -movflags +faststart"
)
COMMENT = re.compile(r"^# (Picture|Film|GIF): (.*\n(?:#(?! Picture:| Film:| GIF:).*\n)*)", re.M)
GIF_FILE = re.compile(r"[\"'](\S+\.gif)[\"']")

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
    from PIL import Image

    texts = {"Picture": deque(), "Film": deque(), "GIF": deque()}
    for kind, text in comments(block.content):
        texts[kind].append(text)
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
            image = _save_film(films[figure], path.with_suffix(".mp4"))
        else:
            image = _drawn(figure)
        path = path.with_suffix(".webp")
        save(image, path)
        if path.stem.endswith("_001"):
            _save_thumb(image, path)
        alt = texts[kind].popleft() if texts[kind] else ""
        size = (round(inches * CSS_DPI) for inches in figure.get_size_inches())
        rst.append(_shown(kind, path, alt, size, gallery_conf))
    plt.close("all")
    for name in GIF_FILE.findall(block.content) if texts["GIF"] else ():
        path = Path(next(block_vars["image_path_iterator"])).with_suffix(".gif")
        shutil.move(name, path)
        with Image.open(path) as image:
            rst.append(_shown("GIF", path, texts["GIF"].popleft(), image.size, gallery_conf))
    rst += [f".. {kind.lower()}::\n   :alt: {text}\n" for kind in texts for text in texts[kind]]
    return "\n\n".join(rst)


def comments(code):
    """Return kind and text of every comment that says what is to be seen."""
    return [
        (kind, " ".join(re.sub(r"^# ?", "", text, flags=re.M).split()))
        for kind, text in COMMENT.findall(code + "\n")
    ]


def _shown(kind, path, alt, size, gallery_conf):
    address = "/" + path.relative_to(gallery_conf["src_dir"]).as_posix()
    width, height = size
    return (
        f".. {kind.lower()}:: {address}\n   :alt: {alt}\n   :width: {width}\n   :height: {height}\n"
    )


def _report(report):
    return ".. raw:: html\n\n" + textwrap.indent(report._repr_html_(), "   ")


def _drawn(figure):
    from PIL import Image

    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=SHARP * CSS_DPI)
    return Image.open(file).convert("RGB")


def _save_thumb(image, path):
    from PIL import Image

    folder = path.parent / "thumb"
    folder.mkdir(exist_ok=True)
    size = THUMB_WIDTH, round(image.height * THUMB_WIDTH / image.width)
    save(image.resize(size, Image.Resampling.LANCZOS), folder / f"{path.stem}_thumb{path.suffix}")


def _is_photograph(image):
    """Tell whether WebP is nearer to a picture than 256 colours are; in line plots it is not."""
    from PIL import Image

    file = io.BytesIO()
    image.save(file, "WEBP", quality=WEBP_QUALITY)
    with Image.open(file) as webp:
        return _error(image, webp) < _error(image, _with_palette(image))


def _error(image, other):
    from PIL import ImageChops, ImageStat

    return sum(ImageStat.Stat(ImageChops.difference(image, other.convert("RGB"))).sum2)


def save(image, path):
    """Save a picture as WebP: a photograph nearly as it is, a drawing with exact 256 colours."""
    if _is_photograph(image):
        image.save(path, quality=WEBP_QUALITY, method=6)
    else:
        # Refined until few pixels change, so that smooth shades have no bands.
        small = _with_palette(image, kmeans=1000).convert("RGB")
        small.save(path, lossless=True, method=6)


def _with_palette(image, kmeans=0):
    from PIL import Image

    small = image.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans)
    _keep_ground(image, small)
    return small


def _keep_ground(image, small):
    """Give the commonest colour, a figure's ground, back to the palette as it was."""
    _, ground = max(image.getcolors(image.width * image.height))
    _, index = max(small.getcolors())
    palette = small.getpalette()
    palette[3 * index : 3 * index + 3] = ground
    small.putpalette(palette)


def _save_film(animation, path):
    """Save the animation as mp4, always with the same bytes; return a picture of its middle."""
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
                self.middle = _drawn(self.fig)
            self.frames_left -= 1

        def finish(self):
            self.film.close()

    figure = animation._fig
    # Axes that are laid out anew for each frame would tremble.
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    writer = Writer(fps=round(1000 / animation._interval))
    animation.save(path, writer=writer, dpi=1.5 * CSS_DPI)
    return writer.middle


def load_ipython_extension(shell):
    """In the kernel of executed pages: show an animation as its film.

    What IPython hands on is a picture of the middle; the film lies in the folder PAGE_FILMS,
    under the hash of that picture, by which MyST-NB names the picture, too.
    """
    from matplotlib.animation import Animation

    shell.display_formatter.formatters["image/png"].for_type(Animation, _film_of_cell)


def _film_of_cell(animation):
    import matplotlib.pyplot as plt

    film = Path(os.environ["PAGE_FILMS"], "new.mp4")
    film.parent.mkdir(exist_ok=True)
    still = io.BytesIO()
    _save_film(animation, film).save(still, "PNG")
    plt.close(animation._fig)
    film.replace(film.with_stem(hashlib.sha256(still.getvalue()).hexdigest()))
    return still.getvalue()


class picture(nodes.image):
    """A picture with its size, so that the page does not jump while it loads."""


class film(nodes.image):
    """A film; its only child is the picture shown before it plays."""


class gif(nodes.image):
    """A picture that moves by itself; it waits until the reader opens it."""


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
        return self.node(uri=uri, alt=alt, **size)


class Gif(Picture):
    """`.. gif:: /path.gif`."""

    node = gif


class Film(Picture):
    """`.. film:: /path.png`, the picture shown before it plays; the film lies beside it."""

    node = film

    def make(self, uri, alt, size):
        still = picture(uri=uri, alt="", **size)
        return film("", still, uri=re.sub(r"\.\w+$", ".mp4", uri), alt=alt, **size)


def _address(writer, node):
    name = writer.builder.images.get(node["uri"])
    return f"{writer.builder.imgpath}/{name}" if name else node["uri"]


def _size(node):
    return "".join(f' {key}="{node[key]}"' for key in ("width", "height") if key in node)


def visit_picture(self, node):
    # Above the first picture stand title and card: text is painted first, no picture delays it.
    self.body.append(
        f'<div class="picture"><img src="{_address(self, node)}" alt="{escape(node["alt"])}"'
        f'{_size(node)} loading="lazy" decoding="async"></div>\n'
    )
    raise nodes.SkipNode


def visit_film(self, node):
    source, text = _address(self, node), escape(node["alt"])
    # A narrow film that filled the page would be higher than a screen.
    widest = f' style="max-width: {round(PAGE_SCALE * node["width"])}px"'
    self.body.append(
        f'<figure class="film"><video controls muted playsinline preload="none"'
        f' poster="{_address(self, node[0])}"{_size(node)}{widest} aria-label="Film: {text}">'
        f'<source src="{source}" type="video/mp4">'
        f'<a href="{source}">Download the film</a></video>'
        f"<figcaption>Film: {text}</figcaption></figure>\n"
    )
    raise nodes.SkipNode


def visit_gif(self, node):
    # In closed details a lazy picture is not loaded.
    self.body.append(
        '<details class="fold"><summary>Play the GIF</summary>\n'
        f'<div class="picture"><img src="{_address(self, node)}" alt="{escape(node["alt"])}"'
        f'{_size(node)} loading="lazy"></div></details>\n'
    )
    raise nodes.SkipNode


def setup(app):
    app.add_node(picture, html=(visit_picture, None))
    app.add_node(gif, html=(visit_gif, None))
    app.add_node(film, html=(visit_film, None))
    app.add_directive("picture", Picture)
    app.add_directive("gif", Gif)
    app.add_directive("film", Film)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
