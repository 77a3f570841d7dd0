"""The course in Firefox and in WebKit, with keys and pointer, as a person uses it."""

import json
import re
from pathlib import Path

import pytest
import solutions
import starter
from engines import Firefox, WebKit, button

from canim.checks import TASKS

ROOT = Path(__file__).parents[2]
SOLUTIONS = solutions.completed(ROOT)
BLOCKS = ["1.1", "2.1", "3.1"]  # a task of each
IDLE = "/ended|stopped|Stopped|waits/.test(find('.run-status').textContent)"
LINES = "[...document.querySelectorAll('.cm-line')].map((line) => line.textContent)"
DOT = ".run-ground button"
FILM = """\
import matplotlib.pyplot as plt
from matplotlib.animation import FuncAnimation

figure, axes = plt.subplots()
(dot,) = axes.plot(0, 0, "o")
film = FuncAnimation(figure, lambda k: dot.set_data([k], [k]), frames=9)
"""


def page(number):
    return f"{TASKS[number].page}.html"


class Reader:
    """Somebody who is here for the first time, with their browser."""

    def __init__(self, browser, address):
        self.browser, self.address = browser, address
        self.open("404.html")  # a light one
        browser.evaluate("localStorage.clear()")

    def open(self, name):
        self.browser.goto(f"{self.address}/{name}")

    def select(self):
        """Go into the editor and select all that is there."""
        self.browser.click(".run-code")
        self.browser.click(".cm-editor")
        self.browser.press("Control+a")

    def write(self, program):
        """Type a program in place of what is there."""
        self.select()
        self.browser.type(program)

    def paste(self, program, number):
        """Copy a program from elsewhere and paste it into the page of a task."""
        self.open("404.html")
        self.browser.evaluate(
            f"""document.body.replaceChildren(Object.assign(document.createElement("textarea"),
            {{ value: {json.dumps(program)} }}))"""
        )
        self.browser.click("textarea")
        self.browser.press("Control+a")
        self.browser.press("Control+c")
        self.open(page(number))
        self.select()
        self.browser.press("Control+v")

    def run(self, name="Run"):
        self.browser.click(button(name))
        self.browser.wait_for(IDLE)
        return self.browser.text(".run-output")


@pytest.fixture(scope="session", params=[Firefox, WebKit])
def browser(request, tmp_path_factory):
    opened = request.param(tmp_path_factory.mktemp("profile"))
    yield opened
    opened.close()


@pytest.fixture(scope="session")
def recorded(serve):
    with serve(recorded=True) as (address, _):
        yield address


@pytest.fixture
def reader(browser, recorded):
    yield Reader(browser, recorded)
    assert browser.said() == []


@pytest.mark.parametrize("name", ["index.html", *map(page, BLOCKS)])
def test_pages_and_their_pictures_are_there(reader, name):
    reader.open(name)
    shown = "[...document.images].every((image) => image.complete && image.naturalWidth)"
    reader.browser.evaluate(
        "document.querySelectorAll('img').forEach((i) => (i.loading = 'eager'))"
    )
    reader.browser.wait_for(shown)
    assert reader.browser.text("h1")


def test_the_film_of_the_front_page_plays(reader):
    reader.open("index.html")
    reader.browser.click("video")
    reader.browser.wait_for("find('video').currentTime > 0.1")


def test_what_is_typed_is_what_runs(reader):
    signs = "!#$%&*+,-./:;<=>?@^_`|~0123456789abcxyzABCXYZ"
    reader.open(page("1.1"))
    reader.write(f'signs = "{signs}"\nfor half in [7 / 2, 7 // 2]:\nprint(half, {{1: "a"}})\n')
    reader.browser.type("\bif signs:\n\b\tprint(signs[(0)], 'end')")
    assert reader.browser.evaluate(LINES) == [
        f'signs = "{signs}"',
        "for half in [7 / 2, 7 // 2]:",
        '    print(half, {1: "a"})',
        "if signs:",
        "    print(signs[(0)], 'end')",
    ]
    reader.browser.press("Control+Enter")
    reader.browser.wait_for(IDLE)
    assert reader.browser.text(".run-output").strip() == "3.5 {1: 'a'}\n3 {1: 'a'}\n! end"


@pytest.mark.parametrize("number", BLOCKS)
def test_a_starter_and_its_solution_are_reported(reader, number):
    reader.open(page(number))
    assert "not written yet" in reader.run()
    reader.paste(SOLUTIONS[TASKS[number].file_name], number)
    assert f"All checks of Task {number} pass." in reader.run()
    pictures = (
        "[...document.querySelectorAll('.run-output img')].map((image) => image.naturalWidth)"
    )
    assert min(reader.browser.evaluate(pictures)) > 0
    assert "Done" in reader.browser.text(".task-card")


def test_stop_ends_a_loop_and_the_next_run_works(reader):
    reader.open(page("1.1"))
    reader.write("print('here')\nwhile True:\npass")
    reader.browser.click(button("Run"))
    reader.browser.wait_for("find('.run-output').innerText.includes('here')")
    reader.browser.click(button("Stop"))
    reader.browser.wait_for("find('.run-status').textContent === 'Stopped.'")
    reader.write("print('again')")
    assert reader.run().strip() == "again"


def test_points_are_moved_by_keys_and_pointer_and_used(reader):
    task = starter.read(ROOT / "gallery" / TASKS["2.1"].block / TASKS["2.1"].file_name)
    program = starter.script(task, starter.release(ROOT)).replace("click = False", "click = True")
    number = r"(-?[\d.]+)"
    pattern = re.compile(rf"points: \[{number} {number}\] \[{number} {number}\] (\d+)")

    def used(text):
        return [float(part) for part in pattern.search(text).groups()]

    told = "print('points:', *(f'[{x:.1f} {y:.1f}]' for x, y in points_a[:2]), len(points_a))"
    reader.paste(f"{program}\n{told}\n", "2.1")
    before = used(reader.run())
    reader.browser.click(DOT)
    for key in ("ArrowRight", "ArrowRight", "Shift+ArrowDown"):
        reader.browser.press(key)
    wide = reader.browser.evaluate("find('.run-ground').clientWidth")
    reader.browser.drag(f"{DOT}:nth-of-type(2)", wide / 8, 0)
    reader.browser.click(".run-ground img", 0.1, 0.9)
    after = used(reader.run("Run with these key points"))
    moved = [b - a for a, b in zip(before, after)]
    assert moved == pytest.approx([2, 10, 160 / 8, 0, 1], abs=0.5)  # the pointer has whole pixels


def test_a_film_plays_and_stands_still(reader):
    reader.paste(FILM, "1.1")
    reader.run()
    reader.browser.wait_for("find('.run-film input').value === '5'")
    reader.browser.click(button("Pause"))
    reader.browser.press("Tab")
    at = reader.browser.evaluate("find('.run-film input').valueAsNumber")
    reader.browser.press("ArrowLeft" if at else "ArrowRight")
    assert reader.browser.evaluate("find('.run-film input').valueAsNumber") == (at - 1 if at else 1)
    reader.browser.click(button("Play"))
    reader.browser.wait_for("find('.run-film input').value === '8'")


def test_what_was_typed_is_there_after_a_reload(reader):
    reader.open(page("3.1"))
    reader.write("mine = 1\nkept = 2")
    reader.browser.reload()
    reader.browser.click(".run-code")
    reader.browser.wait_for("find('.cm-content')")
    assert reader.browser.evaluate(LINES) == ["mine = 1", "kept = 2"]


def test_a_page_and_its_program_work_without_a_server(browser, serve, is_kept):
    shown = "[...document.images].filter((i) => i.loading !== 'lazy').map((i) => i.naturalWidth)"
    looks = f"[document.title, [...document.styleSheets].map((sheet) => sheet.href), {shown}]"
    with serve(recorded=True) as (address, end):
        reader = Reader(browser, address)
        reader.open(page("1.1"))
        before = browser.evaluate(looks)
        assert "not written yet" in reader.run()
        browser.evaluate(f"wait(() => {is_kept(address)}, 'all that is needed is kept')")
        end()
        browser.reload()
        assert browser.evaluate(looks) == before
        reader.write("print('alone')")
        assert reader.run().strip() == "alone"
        assert browser.said() == []
