"""The build of the site: the same bytes every time, and a warning for what is wrong."""

import filecmp
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).parents[2]


def sphinx(source, target, *options, **variables):
    command = [sys.executable, "-m", "sphinx", "-q", *options, source, target]
    paths = (str(ROOT / "docs/_ext"), os.environ.get("PYTHONPATH"))
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        "PYTHONHASHSEED": "7",
    }
    environment.setdefault("CANIM_PYODIDE", str(ROOT / "docs/_build/pyodide"))
    return subprocess.run(
        command,
        capture_output=True,
        text=True,
        encoding="utf-8",
        env=environment | variables,
        check=False,
    )


def copy_of_the_project(copy):
    """Copy all that the site is made from."""
    generated = shutil.ignore_patterns("_build", "node_modules", "__pycache__", "*.pyc")
    shutil.copytree(ROOT / "docs", copy / "docs", ignore=generated)
    shutil.rmtree(copy / "docs/gallery", ignore_errors=True)
    (copy / "docs/node_modules").symlink_to(ROOT / "docs/node_modules")
    for folder in ("gallery", "src", "tests/gallery/solutions"):
        shutil.copytree(ROOT / folder, copy / folder, ignore=generated)
    for name in ("pyproject.toml", "CONTRIBUTING.md", "CHANGELOG.md"):
        shutil.copyfile(ROOT / name, copy / name)


def test_second_build_gives_the_same_bytes(site, tmp_path):
    """Built from nothing, in another folder, with another hash seed."""
    copy = tmp_path / "copy"
    copy_of_the_project(copy)
    again = tmp_path / "html"
    built = sphinx(copy / "docs", again, "-W", "-n", "-d", tmp_path / "doctrees")
    assert built.stderr == ""
    assert built.returncode == 0
    files = {path.relative_to(site) for path in site.rglob("*") if path.is_file()}
    assert files == {path.relative_to(again) for path in again.rglob("*") if path.is_file()}
    _, different, _ = filecmp.cmpfiles(site, again, files, shallow=False)
    assert different == []


# No program runs: pages have no pictures, and no Python in them.
TEXT_ALONE = (
    *("-D", "plot_gallery=0", "-D", "nb_execution_mode=off"),
    *("-D", "suppress_warnings=myst-nb.lexer,pictures,tasks"),
)


LEFT_OUT = ("0_0", "1_1", "2_1", "3_2", "3_4")  # the warm-up, the first, what others build on
ELSEWHERE = "https://example.org/files"


@pytest.fixture(scope="module")
def other_course(tmp_path_factory):
    """The site of a course with fewer tasks, whose files are somewhere in the net."""
    copy, built = tmp_path_factory.mktemp("copy"), tmp_path_factory.mktemp("built")
    copy_of_the_project(copy)
    for task in LEFT_OUT:
        for path in [*copy.rglob(f"task_{task}_*"), *copy.rglob(f"task_{task}.py")]:
            path.unlink()
    settings = (copy / "pyproject.toml").read_text(encoding="utf-8")
    settings = re.sub(r"(?m)^repository = .*", f'repository = "{ELSEWHERE}"', settings)
    (copy / "pyproject.toml").write_text(settings, encoding="utf-8")
    # Which parts show a mistake is tested elsewhere, and takes as long as all the rest.
    with (copy / "docs/_ext/known_mistakes.py").open("a", encoding="utf-8") as extension:
        extension.write('\nshows_in = lambda *args: ["part"]\n')
    ran = sphinx(
        *(copy / "docs", built, "-W", "-n", "--keep-going", "-d", copy / "doctrees"),
        *TEXT_ALONE,
        PYTHONPATH=os.pathsep.join([str(copy / "docs/_ext"), str(copy / "src")]),
        CANIM_PYODIDE=str(copy / "none"),
        CI="",  # there, a site without Python in its pages is not built
    )
    assert ran.returncode == 0, ran.stderr
    return built


def test_every_page_leads_to_the_repository_where_there_is_one(other_course, read_pages):
    documents = read_pages(other_course)
    for name, document in documents.items():
        if name != "404.html":
            (link,) = [e for e in document.all("a") if e["text"] == "All files of the course"]
            assert link["href"] == ELSEWHERE, name
            assert link["aria-label"] == link["text"], "who speaks to a computer says what is seen"
    links = documents["course/marking.html"].all("a")
    named = [e["text"] for e in links if e.get("href") == ELSEWHERE]
    assert named.count("the repository") == 2


@pytest.mark.parametrize("repository", ["", ELSEWHERE])
def test_the_repository_is_a_word_while_there_is_none(monkeypatch, repository):
    import page_head

    monkeypatch.setattr(page_head, "REPOSITORY", repository)
    (shown,), said = page_head._to_repository("repository", "", "the repository", 1, None)
    assert said == []
    assert shown.astext() == "the repository"
    assert (getattr(shown, "attributes", {}).get("refuri") or "") == repository
    config = SimpleNamespace(html_theme_options={})
    page_head._set_address(None, config)
    assert ("footer_icons" in config.html_theme_options) == bool(repository)


def test_tasks_can_be_left_out(other_course, read_pages):
    built = other_course
    documents = read_pages(built)
    gone = [name for name in documents for task in LEFT_OUT if f"task_{task}_" in name]
    assert gone == []
    assert "gallery/warping/task_2_2_warp_backward.html" in documents
    for name, document in documents.items():
        for link in document.all("a"):
            target = link.get("href", "").partition("#")[0]
            if target and "://" not in target and target.endswith(".html"):
                path = (built / name).parent / target
                assert path.exists(), f"{name} links to {target}"
    (start,) = [e for e in documents["index.html"].all("a") if e["text"].startswith("Start with")]
    assert start["href"] == "gallery/interpolation/task_1_2_hermite_interpolation.html"
    mistakes = documents["course/mistakes.html"]
    assert "mistakes-2-2" in mistakes.ids
    assert "mistakes-2-1" not in mistakes.ids
    words = (built / "gallery/warping/index.html").read_text(encoding="utf-8")
    assert re.search(r"<strong>Push\.</strong> <span[^>]*>Task 2\.1</span> takes every", words)


@pytest.fixture
def warnings(tmp_path):
    """Build one page with one of our extensions, alone; return the page and the warnings."""

    def build(text, extension, *options):
        source, target = tmp_path / "source", tmp_path / "html"
        source.mkdir()
        (source / "index.rst").write_text(text, encoding="utf-8")
        (source / "dot.png").write_bytes((ROOT / "docs/_static/canim.png").read_bytes())
        built = sphinx(source, target, "-C", "-D", f"extensions={extension}", *options)
        assert built.returncode == 0, built.stderr
        return (target / "index.html").read_text(encoding="utf-8"), built.stderr

    return build


def test_links_can_be_checked(tmp_path):
    (tmp_path / "index.rst").write_text("T\n=\n", encoding="utf-8")
    alone = ("-C", "-D", "extensions=page_head")
    built = sphinx(tmp_path, tmp_path / "links", "-b", "linkcheck", *alone)
    assert built.returncode == 0, built.stderr


KATEX = ("formulas", "-D", "html_math_renderer=katex")


def test_formula_is_rendered(warnings):
    page, said = warnings("T\n=\n\n:math:`a^2`\n\n.. math::\n\n   a &= 1 \\\\\n   b &= 2\n", *KATEX)
    assert said == ""
    assert page.count("<math ") == 2
    assert "katex.css" in page


def test_wrong_formula_is_a_warning_with_its_place(warnings):
    page, said = warnings("T\n=\n\nText.\n\n.. math:: \\frac{1\n\n:math:`\\wrong<`\n", *KATEX)
    assert "index.rst:6: WARNING: formula: KaTeX parse error" in said
    assert "index.rst:8: WARNING: formula: KaTeX parse error" in said
    assert r"<code>\wrong&lt;</code>" in page


def test_picture_without_text_is_a_warning(warnings):
    _, said = warnings("T\n=\n\n.. picture:: /dot.png\n   :alt:\n", "pictures")
    assert "index.rst:4: WARNING: a picture without a comment '# Picture: …' above it" in said


def test_text_without_picture_is_a_warning(warnings):
    _, said = warnings("T\n=\n\n.. film::\n   :alt: a dot moves\n", "pictures")
    assert "index.rst:4: WARNING: '# Film: a dot moves' has no film below it" in said


def test_scripts_run_again_when_canim_has_changed(tmp_path):
    import freshness

    scripts, generated = tmp_path / "gallery/block", tmp_path / "docs/gallery/block"
    scripts.mkdir(parents=True)
    generated.mkdir(parents=True)
    (scripts / "task_a.py").touch()
    config = SimpleNamespace(
        sphinx_gallery_conf={"examples_dirs": "../gallery", "gallery_dirs": "gallery"}
    )
    app = SimpleNamespace(srcdir=tmp_path / "docs")
    freshness._forget(app, config)
    for name in ("task_a.py.md5", "task_gone.py.md5", "task_gone.rst"):
        (generated / name).touch()

    freshness._forget(app, config)  # nothing has changed but a script is gone
    assert [path.name for path in generated.iterdir()] == ["task_a.py.md5"]

    (generated.parent / "figures.sha256").write_text("of an older canim", encoding="utf-8")
    freshness._forget(app, config)
    assert list(generated.iterdir()) == []


def test_address_of_the_site_is_told(tmp_path, monkeypatch):
    import page_head

    monkeypatch.setattr(page_head, "SITE", "https://example.org/course")
    index, search = {}, {"title": "Find &amp; <em>search</em>"}
    course = SimpleNamespace(
        config=SimpleNamespace(html_title="Course", html_favicon="_static/favicon.svg"),
        srcdir=ROOT / "docs",
    )
    page_head._describe(course, "genindex", "genindex.html", index, None)
    page_head._describe(course, "search", "search.html", search, None)
    assert 'content="https://example.org/course/genindex.html"' in index["metatags"]
    assert 'content="https://example.org/course/_static/canim.png"' in index["metatags"]
    assert '<meta property="og:title" content="Find &amp; search">' in search["metatags"]
    app = SimpleNamespace(
        outdir=tmp_path, env=SimpleNamespace(found_docs={"index", "gallery/index"})
    )
    page_head._map(app, None)
    ((_, missing, _),) = page_head._missing(course)
    assert missing["site"] == "https://example.org/course"
    assert (tmp_path / "sitemap.xml").read_text(encoding="utf-8").count("<loc>https://") == 2


EXECUTED = """---
file_format: mystnb
kernelspec:
  name: page
---

# T

```{code-cell} python
:tags: [fold]

import matplotlib.pyplot as plt

# Picture: A line that rises,
# from left to right.
plt.subplots(figsize=(3, 2))[1].plot([0, 1])
plt.show()
```
"""


@pytest.fixture
def execute(tmp_path):
    """Build one executed page with the settings of the site."""

    def build(text):
        (tmp_path / "source").mkdir()
        (tmp_path / "source/index.md").write_text(text, encoding="utf-8")
        settings = (ROOT / "docs/conf.py").read_text(encoding="utf-8")
        lines = re.findall(r"^(?:nb_|html_scaled).*\n", settings, re.M)
        lines.append('extensions = ["myst_nb", "notebooks", "pictures", "task_page"]')
        (tmp_path / "source/conf.py").write_text("".join(lines), encoding="utf-8")
        return sphinx(tmp_path / "source", tmp_path / "html", "-W", "--keep-going")

    return build


def test_a_figure_has_its_text_and_size_and_its_code_is_folded(execute, tmp_path):
    built = execute(EXECUTED)
    assert built.stderr == ""
    page = (tmp_path / "html/index.html").read_text(encoding="utf-8")
    assert 'alt="A line that rises, from left to right." width="300" height="200"' in page
    assert page.index("How this picture is drawn") < page.index("subplots") < page.index("<img")
    assert "# Picture" not in page


def test_a_figure_without_text_is_a_warning(execute):
    built = execute(EXECUTED.replace("# Picture: A", "# A"))
    assert "WARNING: a picture without a comment '# Picture: …' above it" in built.stderr


def test_a_text_without_figure_is_a_warning(execute):
    built = execute(EXECUTED.replace("plt.show()", "plt.close()"))
    assert "WARNING: '# Picture: A line that rises, from left to right.'" in built.stderr


def test_an_error_ends_the_build(execute):
    built = execute(EXECUTED.replace("plt.show()", "1 / 0"))
    assert built.returncode != 0
    assert "ZeroDivisionError" in built.stderr


MOVING = """
fig, ax = plt.subplots(figsize=(3, 2))
(dot,) = ax.plot(0, 0, "o")
FuncAnimation(fig, lambda i: dot.set_data([i / 9], [0]), frames=9, interval=40)
"""


def test_an_animation_is_shown_as_its_film(execute, tmp_path):
    code = EXECUTED.replace(
        "import matplotlib", "from matplotlib.animation import FuncAnimation\nimport matplotlib"
    )
    code = code.replace("# Picture: A line", "# Film: A dot").replace(
        "plt.subplots(figsize=(3, 2))[1].plot([0, 1])\nplt.show()\n", MOVING
    )
    built = execute(code)
    assert built.stderr == ""
    page = (tmp_path / "html/index.html").read_text(encoding="utf-8")
    (film,) = re.findall(r'<source src="(_images/\w+\.mp4)"', page)
    (poster,) = re.findall(r'poster="(_images/\w+\.webp)" width="300" height="200"', page)
    assert page.count("<img") == 0  # the picture of the middle is only the poster
    assert 'aria-label="Film: A dot that rises, from left to right."' in page
    assert "How this film is drawn" in page
    assert all((tmp_path / "html" / name).stat().st_size > 1000 for name in (film, poster))


def test_only_the_result_of_a_cell_is_shown(execute, tmp_path):
    built = execute(EXECUTED.replace("[fold]", "[only-result]"))
    assert built.stderr == ""
    page = (tmp_path / "html/index.html").read_text(encoding="utf-8")
    assert "subplots" not in page
    assert "A line that rises" in page
