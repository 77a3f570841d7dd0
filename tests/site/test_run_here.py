"""Programs run in the page: every starter, every solution, and what can go wrong."""

import re
from pathlib import Path
from urllib.parse import urlsplit

import pytest
import solutions
import starter

from canim.checks import TASKS

ROOT = Path(__file__).parents[2]
SOLUTIONS = solutions.completed(ROOT)
FIRST = TASKS["1.1"].page + ".html"
IDLE = """() => /ended|stopped|Stopped|waits/.test(
  document.querySelector(".run-status").textContent)"""
WIDER = "document.scrollingElement.scrollWidth - document.scrollingElement.clientWidth"
LONG = 60_000  # milliseconds; slow machines load Python slowly


class Page:
    """A task's page as its reader uses it."""

    def __init__(self, page):
        self.page = page
        page.set_default_timeout(LONG)
        self.status = page.locator(".run-status")
        self.output = page.locator(".run-output")
        self.editor = page.locator(".cm-content")

    def click(self, name):
        self.page.get_by_role("button", name=name, exact=True).click()

    def write(self, program):
        self.page.locator(".run-code").click()
        self.editor.click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(program)

    def text(self):
        """What the editor holds; it keeps only what is in sight in the page."""
        with self.page.expect_download() as download:
            self.click("Download .py")
        return Path(download.value.path()).read_text(encoding="utf-8")

    def run(self, program=None):
        if program is not None:
            self.write(program)
        self.click("Run")
        self.wait()
        return self.output.inner_text()

    def wait(self):
        self.page.wait_for_function(IDLE)

    def said(self, words):
        self.page.wait_for_function(
            "words => document.querySelector('canim-run').textContent.includes(words)", arg=words
        )


@pytest.fixture(scope="module")
def reader(chromium, address):
    """One reader, whose browser has already loaded what is needed, and how it behaves."""
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    asked, said = [], []
    context.on("request", lambda request: asked.append(request.url))
    context.on("console", lambda message: said.append(message.text))
    context.on("weberror", lambda error: said.append(str(error.error)))
    yield context
    context.close()
    host = urlsplit(address).netloc
    assert {urlsplit(url).netloc for url in asked} <= {"", host}
    assert said == []


@pytest.fixture
def opened(reader, address):
    """Open a task's page; nothing is kept from other tests."""
    pages = []

    def open_task(number="1.1", forget=True):
        page = reader.new_page()
        pages.append(page)
        page.goto(f"{address}/{TASKS[number].page}.html")
        if forget:
            page.evaluate("localStorage.clear()")
            page.reload()
        return Page(page)

    yield open_task
    for page in pages:
        page.close()


@pytest.fixture(scope="module")
def used(reader, address):
    """A page on which one test after the other runs programs, without loading Python again."""
    page = reader.new_page()
    page.goto(f"{address}/{FIRST}")
    used = Page(page)
    used.run()
    yield used
    page.close()


@pytest.mark.parametrize("number", TASKS)
def test_a_starter_says_what_is_missing_and_its_solution_is_done(opened, number):
    task = TASKS[number]
    here = opened(number)
    page = starter.read(ROOT / "gallery" / task.block / task.file_name)
    assert here.text() == starter.script(page, starter.release(ROOT))
    here.run()
    assert "not written yet" in here.output.inner_text()
    here.run(SOLUTIONS[task.file_name])
    shown = here.output.inner_text()
    assert f"All checks of Task {number} pass." in shown
    pictures = here.output.locator("img, canvas")
    assert pictures.count() > 0
    for picture in pictures.all():
        assert picture.get_attribute("alt") or picture.get_attribute("aria-label")
    assert here.page.locator(".task-card .run-done").is_visible()


def test_stop_ends_an_endless_loop_at_once(used):
    used.write("print('here')\nwhile True:\n    pass")
    used.click("Run")
    used.said("here")
    took = used.page.get_by_role("button", name="Stop").evaluate(
        """stop => { const start = performance.now(); stop.click();
        return [performance.now() - start, document.querySelector(".run-status").textContent] }"""
    )
    assert took[0] < 200
    assert took[1] == "Stopped."
    # The loop would never end: this is another Python.
    assert "again" in used.run("print('again')")


def test_stop_ends_what_waits_to_run_as_well(used):
    used.write("while True:\n    print('here')")
    used.click("Run")
    used.said("here")
    used.click("Run")
    used.click("Stop")
    used.said("Python is ready.")
    assert used.status.inner_text() == "Python is ready."
    assert "again" in used.run("print('again')")


def test_only_the_students_lines_are_told(used):
    shown = used.run("import numpy as np\n\ndef f():\n    return np.zeros(2) + np.zeros(3)\n\nf()")
    assert "stops in line 4" in shown
    assert "The sizes of two arrays differ." in shown
    assert "Traceback" not in shown
    assert used.page.locator(".run-crashed").inner_text().strip().startswith("return")
    shown = used.run("x = (1")
    assert "stops in line 1" in shown
    assert "A bracket is opened and never closed." in shown


def test_output_is_capped(used):
    shown = used.run("for k in range(30_000):\n    print('x' * 99)")
    assert "No more is shown" in shown
    assert len(shown) < 1_001_000
    assert "small" in used.run("print('small')")


def test_a_huge_array_is_said_to_be_huge(used):
    shown = used.run("import numpy as np\na = np.ones((100_000, 100_000))")
    assert "larger than the memory" in shown
    assert "fine" in used.run("print('fine')")


def test_a_run_knows_nothing_of_the_one_before(used):
    used.run("x = 5\nimport matplotlib.pyplot as plt\nplt.plot([1, 2])")
    assert used.output.locator("img").count() == 1
    shown = used.run("print(x)")
    assert "The name x is not known" in shown
    assert used.output.locator("img").count() == 0


def test_what_a_program_breaks_is_mended_for_the_next(used):
    used.run(
        "import matplotlib.pyplot as plt\nimport numpy as np\nplt.title = 'x'\n"
        "np.own = 1\nnp.random.seed(1)\nnp.set_printoptions(precision=2)\n"
        "import numpy.matlib"
    )
    shown = used.run(
        "import matplotlib.pyplot as plt\nimport numpy as np\nplt.plot([1])\nplt.title('x')\n"
        "print(hasattr(np, 'own'), np.array([0.1234]), np.matlib.ones(1))"
    )
    assert "False [0.1234] [[1.]]" in shown
    assert "Your program ended" in used.status.inner_text()
    assert used.output.locator("img").count() == 1


WRONG = ["raise ModuleNotFoundError('no')", "open('a.gif', 'w').write('no')", "import nothing"]


@pytest.mark.parametrize("program", WRONG)
def test_a_program_that_goes_wrong_ends_like_others(used, program):
    used.run(program)
    assert used.status.inner_text().startswith("Your program")


def test_a_second_run_comes_after_the_first(used):
    used.write("import time\ntime.sleep(0.3)\nprint('slow')")
    used.click("Run")
    used.click("Run")
    used.wait()
    used.write("print('new')")
    used.page.keyboard.press("Control+Enter")
    used.page.keyboard.press("Control+Enter")
    used.page.wait_for_function("document.querySelector('.run-output').innerText.trim() === 'new'")


def test_a_program_that_asks_gets_an_answer(used):
    used.write("name = input('Who are you? ')\nprint('Hello', name)")
    used.click("Run")
    used.page.get_by_label("Who are you?").fill("Ada")
    used.click("Answer")
    used.said("Hello Ada")
    used.click("Run")
    used.page.get_by_label("Who are you?").wait_for()
    assert "new" in used.run("print('new')")
    used.write("print('Hello', input('Who is there? '))")
    used.click("Run")
    used.page.get_by_label("Who is there?").wait_for()


def test_a_module_of_the_course_comes_when_it_is_imported(used):
    program = "m = __import__('scipy.spatial')\nprint(m.spatial.distance.sqeuclidean([0], [2]))"
    assert "4.0" in used.run(program)


def test_text_survives_a_reload_in_the_middle_of_a_run(opened):
    here = opened()
    here.write("while True:\n    pass")
    here.click("Run")
    here.said("Running")
    here.page.reload()
    assert here.text() == "while True:\n    pass"
    assert "alive" in here.run("print('alive')")


def test_two_tabs_hold_the_same_text(opened):
    one, two = opened(), opened(forget=False)
    one.write("print('from the first')")
    two.said("from the first")
    assert two.text() == "print('from the first')"
    assert "from the first" in two.run()


def test_start_over_asks_first(opened):
    here = opened()
    starter_text = here.text()
    here.write("x = 1")
    here.page.once("dialog", lambda dialog: dialog.dismiss())
    here.click("Start over")
    assert here.text() == "x = 1"
    here.page.once("dialog", lambda dialog: dialog.accept())
    here.click("Start over")
    assert here.text() == starter_text


@pytest.mark.parametrize("choice", ["Keep my program", "Take the new starter"])
def test_a_new_starter_leaves_the_choice(opened, choice):
    here = opened()
    starter_text = here.text()
    here.write("mine = 1")
    here.page.evaluate(
        """() => { const key = Object.keys(localStorage).find(key => key.includes("task"));
        const kept = JSON.parse(localStorage[key]);
        localStorage[key] = JSON.stringify({...kept, starter: "an old one"}) }"""
    )
    here.page.reload()
    assert here.text() == "mine = 1"
    here.click(choice)
    chosen = "mine = 1" if choice.startswith("Keep") else starter_text
    assert here.text() == chosen
    here.page.reload()
    assert here.text() == chosen
    assert not here.page.locator(".run-notice").is_visible()


def test_points_are_moved_with_mouse_and_keys(opened):
    here = opened("2.1")
    program = here.text().replace("click = False", "click = True")
    here.run(f"{program}\nprint('points:', points_a[0].round(1), len(points_a))")
    before = re.search(r"points: \[(\S+) +(\S+)\] (\d+)", here.output.inner_text())
    dots = here.page.locator(".run-ground").first.get_by_role("button")
    dots.first.focus()
    for key in ("ArrowRight", "ArrowRight", "Shift+ArrowDown"):
        here.page.keyboard.press(key)
    here.page.locator(".run-ground img").first.click(position={"x": 30, "y": 40})
    here.click("Run with these key points")
    here.page.wait_for_function(IDLE)
    after = re.search(r"points: \[(\S+) +(\S+)\] (\d+)", here.output.inner_text())
    moved = [float(after[k]) - float(before[k]) for k in (1, 2, 3)]
    assert moved == pytest.approx([2, 10, 1])


def test_goals_are_chosen_on_the_picture(opened):
    here = opened("3.2")
    program = here.text().replace("click = False", "click = True")
    here.run(program.replace("(5, 2)", "(1, 2)"))
    here.click("Take all away")
    here.page.locator(".run-ground img").click()  # in its middle
    here.write(f"{program}\nprint(film is not None)")
    here.click("Run with these goals")
    here.said("True")


def test_own_pictures_can_be_read(opened):
    here = opened("2.1")
    picture = ROOT / "docs/_static/canim.png"
    here.page.locator(".run-file").set_input_files(picture)
    here.said('canim.data.read_image("canim.png")')
    shown = here.run("import canim\nprint(canim.data.read_image('canim.png').shape)")
    assert re.search(r"\(\d+, \d+, \d\)", shown)


def test_a_film_keeps_still_for_those_who_want_it_so(opened):
    here = opened("2.3")
    here.page.emulate_media(reduced_motion="reduce")
    here.page.reload()
    here.run(SOLUTIONS[TASKS["2.3"].file_name])
    assert here.page.get_by_role("button", name="Play").is_visible()
    assert here.page.get_by_label("Picture of the film").input_value() == "0"
    here.click("Play")
    here.page.wait_for_function("document.querySelector('.run-film input').value > 2")
    here.click("Pause")


def test_all_of_it_by_keyboard(opened):
    here = opened()
    here.page.locator(".run-code pre").focus()
    here.editor.wait_for()
    here.page.wait_for_function("document.activeElement.matches('.cm-content')")
    here.page.keyboard.press("Control+a")
    here.page.keyboard.insert_text("if True:\n")
    here.page.keyboard.press("Tab")
    here.page.keyboard.insert_text("print('typed')")
    here.page.keyboard.press("Escape")
    here.page.keyboard.press("Tab")
    assert here.page.evaluate("document.activeElement.textContent") == "Run"
    here.page.keyboard.press("Enter")
    here.said("typed")
    here.wait()
    assert here.status.get_attribute("role") == "status"


def test_editor_and_output_are_sound(opened, violations):
    here = opened("2.3")
    here.run(here.text().replace("click = False", "click = True") + "\nprint('text')\n1 / 0")
    wrong = []
    for theme in ("light", "dark"):
        here.page.emulate_media(color_scheme=theme)
        for width in (1280, 320):
            here.page.set_viewport_size({"width": width, "height": 900})
            wrong += violations(here.page)
            assert here.page.evaluate(WIDER) <= 0
    assert wrong == []


def test_tasks_that_are_done_are_marked_and_can_be_forgotten(opened, reader, address):
    here = opened()
    here.run(SOLUTIONS[TASKS["1.1"].file_name])
    page = reader.new_page()
    page.goto(f"{address}/gallery/interpolation/index.html")
    assert page.locator("li .run-done").count() == 1
    page.get_by_role("button", name="Forget which tasks are done").click()
    assert page.locator(".run-done").count() == 0
    page.close()


def test_python_is_not_loaded_without_need(visit, address):
    opened = visit(FIRST)
    opened.wait_for_load_state("networkidle")
    assert [url for url in opened.asked if "/_run/" in url or "editor" in url] == []


def test_from_a_folder_the_page_says_why_nothing_runs(chromium, site):
    page = chromium.new_page()
    page.goto((site / FIRST).as_uri())
    assert "opened from a folder" in page.locator(".run-missing").inner_text()
    assert page.locator("canim-run pre").is_visible()
    page.close()


def test_without_webassembly_the_page_says_so(chromium, address):
    page = chromium.new_page()
    page.add_init_script("delete window.WebAssembly")
    page.goto(f"{address}/{FIRST}")
    assert "no WebAssembly" in page.locator(".run-missing").inner_text()
    page.close()


def test_without_javascript_the_code_is_shown(visit):
    opened = visit(FIRST, java_script_enabled=False)
    assert "JavaScript" in opened.locator(".run-missing").inner_text()
    assert "def hermite_basis" in opened.locator("canim-run pre").inner_text()
