"""The generator of starters: what it keeps, what it leaves out, what it refuses."""

import json

import pytest
import starter

PAGE = '''r"""
.. _task-0-0:

Task 0.0: Blend
===============

One ``sentence``.
"""

import numpy as np  # noqa: F401

x = 1

# %%
# Expected result
# ---------------
# Secret.

secret = 1

# %%
# Theory
# ------
# .. math:: x

# %%
# Pseudocode
# ----------
# Words.

# %%
# Your task
# ---------
# Complete :math:`x^2` with ``f`` as in :ref:`Task 1.1 <task-1-1>`, :func:`canim.x.f`.


def f():
    # TODO
    return None


# %%
# And a second block of it.

z = 2

# %%
# Check and draw
# --------------
# Run.

canim.check("0.0", f=f)

# Picture: a dot
# on a line.
ax.plot(x)

# %%
# Think about it
# --------------
# 1. Is :math:`x = 1` **right**
#    or wrong?
# 2. Why ``2 * x**2``?
#
# Read more
# ---------
# Nothing.
'''


@pytest.fixture
def page(tmp_path):
    return _read(tmp_path, PAGE)


def _read(folder, text):
    path = folder / "task_0_0_blend.py"
    path.write_text(text, encoding="utf-8")
    return starter.read(path)


OF = starter.Release("", "1.0")
ON = starter.Release("https://example.org/course/", "1.0")


def test_a_starter_has_the_students_parts_and_nothing_else(page):
    text = starter.script(page, OF)
    compile(text, "starter.py", "exec")
    assert text.startswith("# Task 0.0: Blend\n")
    assert all(part in text for part in ("x = 1", "# TODO", "z = 2", "canim.check", "ax.plot"))
    for absent in ("secret", "Secret", "%%", "Picture", "on a line", "noqa", ":math:", "Nothing"):
        assert absent not in text
    assert text.endswith('answers = {1: "", 2: ""}\n\nplt.show()\n')
    assert "# 1. Is x = 1 right or wrong?" in text
    assert "# 2. Why 2 * x**2?" in text


def test_the_header_names_the_page_once_the_site_has_an_address(page):
    assert "Page:" not in starter.script(page, OF)
    assert "canim-1.0-py3-none-any.whl" in starter.script(page, OF)
    text = starter.script(page, ON)
    folder = page.path.parent.name
    assert f"# Page: https://example.org/course/gallery/{folder}/task_0_0_blend.html" in text
    assert "https://example.org/course/wheels/canim-1.0-py3-none-any.whl" in text


def test_a_notebook_has_the_prose_as_markdown_and_clean_cells(page):
    cells = json.loads(starter.notebook(page, ON))["cells"]
    kinds = [cell["cell_type"] for cell in cells]
    assert " ".join(k[0] for k in kinds) == "m c c m c m c m c m c"
    text = "\n".join("".join(cell["source"]) for cell in cells)
    assert "Complete $x^2$ with `f` as in Task 1.1, `f`." in text
    assert "%pip install --quiet https://example.org/course/wheels/" in text
    assert "secret" not in text
    assert all(not cell.get("outputs") for cell in cells)
    code = ["".join(c["source"]) for c in cells if c["cell_type"] == "code"]
    assert code[-2].endswith("plt.show()")
    assert "Before: download" in starter.notebook(page, OF)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("# Theory\n", "# Theorie\n", "Theorie"),
        ("===============", "", "no title"),
        ('r"""', "x = 1\n", "docstring|invalid|unterminated"),
    ],
)
def test_a_page_that_misses_a_part_is_refused(tmp_path, old, new, words):
    with pytest.raises((ValueError, SyntaxError), match=words):
        _read(tmp_path, PAGE.replace(old, new, 1))


def test_a_role_that_a_notebook_cannot_show_is_refused(tmp_path):
    page = _read(tmp_path, PAGE.replace(":math:`x^2`", ":cite:t:`A`"))
    with pytest.raises(ValueError, match="cannot show"):
        starter.notebook(page, OF)


def test_a_question_with_a_formula_that_plain_text_cannot_show_is_refused(tmp_path):
    page = _read(tmp_path, PAGE.replace(":math:`x = 1`", r":math:`\\sum`"))
    with pytest.raises(ValueError, match="without formulas"):
        starter.script(page, OF)


def test_the_version_and_the_site_are_those_of_the_project(root, tmp_path):
    import canim

    assert starter.release(root).version == canim.__version__
    (tmp_path / "src/canim").mkdir(parents=True)
    (tmp_path / "src/canim/__init__.py").write_text("", encoding="utf-8")
    (tmp_path / "pyproject.toml").write_text('[tool.canim]\nsite = ""\n', encoding="utf-8")
    with pytest.raises(ValueError, match="__version__"):
        starter.release(tmp_path)
