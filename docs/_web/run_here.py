"""Run a student's program in the page, and send what it prints, draws and reports.

The worker loads this module into the Python of the page and calls `begin` once, then `run`
for every press of Run. A message to the page is a kind, its content, and files as bytes.
"""

from __future__ import annotations

import builtins
import io
import json
import linecache
import os
import sys
import time
import warnings
import zlib
from contextlib import suppress
from pathlib import Path
from types import ModuleType

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import AbstractMovieWriter, Animation
from PIL import Image, ImageSequence

import canim
from canim.checks.crash import explain
from canim.checks.report import stops

MOST = 1_000_000  # characters that a program may print
AT_ONCE = 200  # prints that are sent one by one; after them, what was printed in 50 ms
DPI, FILM_DPI = 160, 100
PAGE_DPI = 100  # a figure of 6.4 inches is 640 pixels wide on the page
FRAMES = 500  # of a film; what comes later is left out
OFTEN = 0.2  # seconds from one word on how far a run is to the next

_save_film, _begin_film = Animation.save, Animation.__init__
_pick_points, _animate_chain = canim.plotting.pick_points, canim.plotting.animate_chain

post = answers = output = None
told = 0  # when it was told how far a run is
films, saved = {}, {}  # by figure: its film, and the file that the program saved it in
original = {}  # by module: its names, which a program may give to something else
printing, failing = np.get_printoptions(), np.geterr()


class Asked(BaseException):
    """Ends a program that waits for a text; it is run again with the answer."""


def begin(to_page):
    """Put in place of windows what the page can do."""
    global post
    post = lambda kind, *blobs, **content: to_page(kind, json.dumps(content), blobs)  # noqa: E731
    mpl.use("agg")
    vars(mpl)["use"] = lambda *args, **options: None
    plt.show = show
    Animation.__init__, Animation.save = _note_film, _note_file
    canim.checks.show = lambda report: post(
        "report", html=report._repr_html_(), task=report.task.id, done=report.done
    )
    canim.plotting.pick_points = pick_points
    canim.plotting.progress = progress
    canim.plotting.animate_chain = animate_chain
    canim.plotting.weight_sliders = weight_sliders
    warnings.showwarning = _warn
    for module in (plt, np):
        names = vars(module).items()
        original[module] = {name: value for name, value in names if not name.startswith("_")}


def run(code, name, given, last):
    """Run a program; return the name of a module that is missing, if this is not the `last` try."""
    global answers, output
    answers = json.loads(given) | {"texts read": 0}
    path = Path.cwd() / name
    start, before = time.monotonic(), _files()
    linecache.cache[str(path)] = len(code), None, code.splitlines(keepends=True), str(path)
    sys.modules["__main__"] = module = ModuleType("__main__")
    module.__file__ = str(path)
    builtins.input = _input
    sys.stdout = sys.stderr = output = Output()
    forget()
    post("begin")
    words = "Your program ended"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("default")
            try:
                exec(compile(code, str(path), "exec", dont_inherit=True), vars(module))
            finally:
                if not isinstance(sys.exception(), MemoryError | Asked):
                    show()
    except Asked as question:
        words = "Your program waits for an answer"
        post("question", text=str(question))
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code)
    except ModuleNotFoundError as error:
        if error.name and not last:
            return error.name
        words = _tell(error, path)
    except BaseException as error:
        words = _tell(error, path)
    output.flush()
    for file in sorted(_files().items() - before.items()):
        _send_file(Path(file[0]))
    forget()
    post("end", text=f"{words} after {time.monotonic() - start:.1f} s.")
    return None


def forget():
    """Let nothing of a run be left for the next one, but its files."""
    for module, names in original.items():
        for name in vars(module).keys() - names:
            # A module that was imported stays: it is not imported twice.
            if not name.startswith("_") and f"{module.__name__}.{name}" not in sys.modules:
                delattr(module, name)
        vars(module).update(names)
    np.set_printoptions(**printing)
    np.seterr(**failing)
    np.random.seed()  # noqa: NPY002 - programs that use it begin anywhere, as at home
    plt.close("all")
    mpl.rcdefaults()
    films.clear()
    saved.clear()


def _tell(error, path):
    crash = explain(error, lambda name: name == str(path))
    output.flush()
    post("crash", text=f"The program {stops(crash)}", line=crash.line)
    return "Your program stopped, as it says below,"


class Output(io.TextIOBase):
    """Sends what is printed: soon, but not every word by itself, and not without end."""

    def __init__(self):
        self._room, self._count, self._waiting, self._sent = MOST, 0, [], time.monotonic()

    def writable(self):
        return True

    def write(self, text):
        if self._room > 0:
            self._waiting.append(text[: self._room])
            self._room -= len(text)
            self._count += 1
            if self._room <= 0:
                self._waiting.append("\nNo more is shown: this is the first 1 MB of the output.\n")
            if self._count < AT_ONCE or time.monotonic() - self._sent > 0.05:
                self.flush()
        return len(text)

    def flush(self):
        if self._waiting:
            post("text", text="".join(self._waiting))
        self._waiting, self._sent = [], time.monotonic()


def _warn(message, category, filename, line, *rest):
    own = filename == getattr(sys.modules["__main__"], "__file__", "")
    print(f"Warning in line {line}: {message}" if own else f"Warning: {message}")


def _input(prompt=""):
    print(prompt, end="")
    if answers["texts read"] == len(answers["texts"]):
        raise Asked(prompt)
    answers["texts read"] += 1
    text = answers["texts"][answers["texts read"] - 1]
    print(text)
    return text


# -- Figures and films -----------------------------------------------------


def show(*args, **options):
    """Send all figures, then the films' frames, which take longer."""
    figures = [plt.figure(number) for number in plt.get_fignums()]
    for figure in figures:
        file = io.BytesIO()
        figure.savefig(file, format="png", dpi=DPI, pil_kwargs={"compress_level": 1})
        width = round(figure.get_figwidth() * PAGE_DPI)
        height = round(figure.get_figheight() * PAGE_DPI)
        film = id(figure) if figure in films else 0
        post("figure", file.getvalue(), alt=describe(figure), width=width, height=height, film=film)
    plt.close("all")  # what goes wrong below does not show them again
    for figure in figures:
        if figure in saved:
            _send_gif(id(figure), saved[figure])
        elif figure in films:
            film = films[figure]
            figure.set_layout_engine("none")  # it was laid out for the still, and need not be again
            figure.set_dpi(FILM_DPI)
            writer = Frames(id(figure), film._interval, getattr(film, "_save_count", 0))
            film.save("film", writer=writer, dpi=FILM_DPI)


def describe(figure):
    """Return in words what is written in a figure."""
    words = [f"Your picture {figure.get_label()}".strip()]
    for ax in figure.axes:
        names = [line.get_label() for line in ax.lines if not line.get_label().startswith("_")]
        names += [text.get_text() for text in ax.texts]
        parts = [ax.get_title(), f"x: {ax.get_xlabel()}", f"y: {ax.get_ylabel()}", ", ".join(names)]
        words.append("; ".join(p for p in parts if p and not p.endswith(": ")))
    return ". ".join(part for part in words if part) + "."


def _note_film(film, figure, *args, **options):
    _begin_film(film, figure, *args, **options)
    films[figure] = film


def _note_file(film, filename, *args, **options):
    _save_film(film, filename, *args, **options)
    if str(filename).endswith(".gif"):
        saved[film._fig] = Path(filename)


class Frames(AbstractMovieWriter):
    """Sends the frames of a film as they are drawn."""

    def __init__(self, name, interval, count):
        super().__init__()
        # To draw every other picture takes half the time, and looks smooth enough.
        self._every = 2 if interval < 50 else 1
        self._name, self._interval = name, interval * self._every
        self._last, self._count = b"", 0
        self._of_all = f" of {count}" if count else ""

    def setup(self, fig, outfile, dpi=None):
        super().setup(fig, outfile, dpi)

    def grab_frame(self, **options):
        self._count += 1
        _tell_how_far(f"Film: picture {self._count}{self._of_all}")
        if self._count % self._every or self._count > FRAMES:
            return
        canvas = self.fig.canvas
        canvas.draw()
        drawn = canvas.buffer_rgba().tobytes()
        image = Image.frombuffer("RGBA", canvas.get_width_height(), drawn)
        png = b"" if drawn == self._last else _png(image.convert("RGB"))
        post("frame", png, film=self._name, interval=self._interval)
        self._last = drawn

    def finish(self):
        post("frame", film=self._name)


def _send_gif(name, path):
    with suppress(Exception), Image.open(path) as gif:  # a program can write a broken one
        for frame in ImageSequence.Iterator(gif):
            interval = frame.info.get("duration") or 100
            post("frame", _png(frame.convert("RGB")), film=name, interval=interval)
    post("frame", film=name)


def _png(image):
    file = io.BytesIO()
    image.save(file, "PNG", compress_level=1)
    return file.getvalue()


# -- How far it is ---------------------------------------------------------


def progress(items):
    """As `canim.plotting.progress`; the page shows how far it is."""
    for number, item in enumerate(items, 1):
        _tell_how_far(f"{number} of {len(items)}")
        yield item


def _tell_how_far(text):
    """Tell how far the program is, but not more often than can be read."""
    global told
    if time.monotonic() - told > OFTEN:
        post("advance", text=text)
        told = time.monotonic()


# -- Files -----------------------------------------------------------------


def _files():
    return {str(path): path.stat().st_mtime_ns for path in Path.cwd().iterdir() if path.is_file()}


def _send_file(path):
    """Send a file that the program wrote, for the reader to save; a GIF is shown as well."""
    shown = {file.resolve() for file in saved.values()}
    if path.suffix == ".gif" and path.resolve() not in shown:
        name = path.name
        with suppress(Exception), Image.open(path) as gif:
            size = dict(zip(("width", "height"), gif.size))
            post("figure", _png(gif.convert("RGB")), alt=f"Your film {name}", film=name, **size)
            _send_gif(path.name, path)
    post("file", path.read_bytes(), name=path.name)


def keep_file(name, content):
    """Put a file of the reader's beside the program."""
    Path(os.path.basename(name)).write_bytes(content)


# -- Questions to the reader -----------------------------------------------


def pick_points(image_a, image_b, points_a, points_b, *, click=False):
    """As `canim.plotting.pick_points`; points are moved in the page, for the next run."""
    given = _pick_points(image_a, image_b, points_a, points_b)
    sizes = [np.shape(image)[1::-1] for image in (image_a, image_b)]
    frames = [[-0.5, width - 0.5, -0.5, height - 0.5] for width, height in sizes]
    shown = [np.asarray(image) for image in (image_a, image_b)]
    if click:
        images = [Image.fromarray(image) for image in shown]
        lists = _points("points", images, frames, given, 1, shown)
    elif lists := _chosen("points", _key(given, frames, shown)):
        print("The key points are those that you have moved: click = True shows them again.")
    else:
        if "points" in answers:
            print(
                "The key points are the given ones: those that you have moved belong to other "
                "pictures or other given points."
            )
        return given
    last = [np.subtract(size, 1) for size in sizes]  # the centre of a corner's pixel
    return tuple(np.clip(np.reshape(points, (-1, 2)), 0, end) for points, end in zip(lists, last))


def animate_chain(ax, reach, forward, angles, offsets, goals, *, click=False):
    """As `canim.plotting.animate_chain`; the goals are chosen in the page."""
    if click:
        ax.figure.canvas.draw()
        x0, y0, x1, y1 = np.round(ax.get_window_extent().extents).astype(int)
        drawn = np.asarray(ax.figure.canvas.buffer_rgba())
        ground = Image.fromarray(drawn[len(drawn) - y1 : len(drawn) - y0, x0:x1].copy())
        frame = (*ax.get_xlim(), *ax.get_ylim()[::-1])
        (goals,) = _points("goals", [ground], [frame], [goals], 0.05, [])
    return _animate_chain(ax, reach, forward, angles, offsets, goals)


def weight_sliders(*args, **options):
    """Say why there are none."""
    print("The sliders need a window: run this program on your own computer to move them.")
    return []


def _key(lists, frames, pictures):
    """Return a number that other given points, frames or pictures do not have."""
    told = json.dumps([np.asarray(numbers, dtype=float).tolist() for numbers in (*lists, *frames)])
    return zlib.crc32(b"".join([told.encode(), *(picture.tobytes() for picture in pictures)]))


def _chosen(kind, key):
    """Return the points that the reader has moved, if it was those with this key, else None."""
    chosen = answers.get(kind)
    return chosen["lists"] if chosen and chosen.get("key") == key else None


def _points(kind, images, frames, lists, step, belongs):
    """Return the points that the reader has chosen for what `belongs` to them, else the given."""
    first = [np.asarray(points, dtype=float).tolist() for points in lists]
    frames = [[float(number) for number in frame] for frame in frames]
    key = _key(first, frames, belongs)
    lists = _chosen(kind, key) or first
    pictures = [_png(image.convert("RGB")) for image in images]
    told = {"frames": frames, "lists": lists, "first": first, "key": key, "step": step}
    post("points", *pictures, name=kind, **told)
    return [np.array(points, dtype=float).reshape(-1, 2) for points in lists]
