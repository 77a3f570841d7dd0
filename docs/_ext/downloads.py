"""What the site hands out besides pages: starters, notebooks, their zip, the wheel, scripts."""

from __future__ import annotations

import os
import shutil
import zipfile
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

import starter
from docutils import nodes
from sphinx.errors import ConfigError
from sphinx.util.docutils import SphinxDirective

from canim.checks import TASKS
from canim.data import expressions, save_expressions

ROOT = Path(__file__).parents[2]
RELEASE = starter.release(ROOT)
OLDEST_ZIP_TIME = (1980, 1, 1, 0, 0, 0)


def served_wheel():
    """Return the wheel that the site serves: the one the docs session has built."""
    if given := os.environ.get("CANIM_WHEEL"):
        return Path(given)
    found = ROOT / "dist" / RELEASE.wheel
    if not found.exists():
        raise ConfigError(f"no {found}: build it first, or set CANIM_WHEEL")
    return found


def _say_how_to_install(app, config):
    wheel = escape(served_wheel().name)
    if RELEASE.site:
        what = f"{RELEASE.site.rstrip('/')}/wheels/{wheel}"
        first = "To work on your own computer, open a terminal once and type"
    else:
        what = wheel
        link = f'<a href="{{up}}wheels/{wheel}" download>{wheel}</a>'
        first = (
            f"To work on your own computer, download {link}, open a terminal in the folder of "
            "the download and type, once,"
        )
    config.install_line = (
        f'<p class="task-install">{first} <code>python -m pip install {escape(what)}</code>. '
        "You need Python 3.11 or newer. "
        '<a href="{up}students/setup.html">All this with pictures</a></p>\n'
    )


class Start(SphinxDirective):
    """`.. start::` puts buttons: the first task, the warm-up, all starters."""

    def run(self):
        up = "../" * self.env.docname.count("/")
        # Any task may be left out, also these.
        first = next(task for task in TASKS.values() if task.block != "warm_up")
        buttons = {f"Start with Task {first.id}": f"{first.page}.html"}
        for warm_up in (task for task in TASKS.values() if task.block == "warm_up"):
            text = f"New here? Warm up first <span>(Task {warm_up.id})</span>"
            buttons[text] = f"{warm_up.page}.html"
        buttons["All starters <span>(.zip)</span>"] = "starters/canim-starters.zip"
        links = "".join(
            f'<a href="{up}{escape(address)}" class="button">{text}</a>'
            for text, address in buttons.items()
        )
        return [nodes.raw("", f'<p class="buttons">{links}</p>', format="html")]


class Package(SphinxDirective):
    """`.. package::` puts a button with the wheel."""

    def run(self):
        up = "../" * self.env.docname.count("/")
        button = (
            f'<a href="{up}wheels/{escape(served_wheel().name)}" class="button" download>'
            "The package canim <span>(.whl)</span></a>"
        )
        return [nodes.raw("", f'<p class="buttons">{button}</p>', format="html")]


class Install(SphinxDirective):
    """`.. install:: py` shows what to type in the folder of the wheel; its content comes first."""

    required_arguments = 1
    has_content = True

    def run(self):
        lines = [*self.content, f"{self.arguments[0]} -m pip install {served_wheel().name}"]
        text = "\n".join(lines)
        return [nodes.literal_block(text, text, language="text", classes=["wraps"])]


def _hand_out(app, exception):
    if exception or app.builder.format != "html":
        return
    starters = _emptied(app.outdir / "starters")
    for page in starter.pages(ROOT):
        script, notebook = starter.script(page, RELEASE), starter.notebook(page, RELEASE)
        for name, text in ((f"{page.name}.py", script), (f"{page.name}.ipynb", notebook)):
            (starters / name).write_text(text, encoding="utf-8", newline="\n")
        shutil.copyfile(page.path, (app.outdir / page.address).with_suffix(".py"))
    with zipfile.ZipFile(starters / "canim-starters.zip", "w") as together:
        for path in sorted(starters.glob("task_*")):
            put_into(together, f"canim-starters/{path.name}", path.read_bytes())
    with zipfile.ZipFile(starters / "canim-head.zip", "w") as head, TemporaryDirectory() as folder:
        save_expressions(folder)
        about = [expressions.FILE.with_name(name) for name in ("SOURCES.md", "LICENSE.md")]
        for path in [*about, *sorted(Path(folder).iterdir())]:
            put_into(head, f"canim-head/{path.name}", path.read_bytes())
    shutil.copyfile(served_wheel(), _emptied(app.outdir / "wheels") / served_wheel().name)


def put_into(archive, name, data):
    """Add a file to a zip that is to have the same bytes every time."""
    member = zipfile.ZipInfo(name, OLDEST_ZIP_TIME)
    member.compress_type = zipfile.ZIP_DEFLATED
    member.external_attr = 0o644 << 16
    archive.writestr(member, data)


def _emptied(folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder


def setup(app):
    app.add_config_value("install_line", "", "env", types=str)
    app.add_directive("start", Start)
    app.add_directive("package", Package)
    app.add_directive("install", Install)
    app.connect("config-inited", _say_how_to_install)
    app.connect("build-finished", _hand_out)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
