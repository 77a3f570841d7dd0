"""Programs run in the page: every starter, every solution, and what can go wrong."""

import re
import string
from pathlib import Path
from urllib.parse import urlsplit

import pytest
import solutions
import starter
from PIL import Image

from canim.checks import TASKS

ROOT = Path(__file__).parents[2]
SOLUTIONS = solutions.completed(ROOT)
FIRST = TASKS["1.1"].page + ".html"
IDLE = """() => /ended|stopped|Stopped|waits/.test(
  document.querySelector(".run-status").textContent)"""
SAYING = ".run-status, .run-clock, .run-notice, .run-own, .run-output"
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
        """Copy a program from elsewhere, and paste it over the one that is there."""
        self.page.locator(".run-code").click()
        self.editor.click()
        self.page.evaluate("text => navigator.clipboard.writeText(text)", program)
        self.page.keyboard.press("Control+a")
        self.page.keyboard.press("Control+v")

    def type(self, *keys):
        """Press keys: one by its name, or "text:" and those of the characters of a text."""
        for key in keys:
            if key.startswith("text:"):
                self.page.keyboard.type(key[5:])
            else:
                self.page.keyboard.press(key)

    def walk_to(self, element, key):
        """Press Tab, or Shift+Tab, until an element has the focus."""
        for _ in range(99):
            if element.evaluate("element => element === document.activeElement"):
                return
            self.type(key)
        raise AssertionError(f"{key} does not come to {element}")

    def walk_in(self):
        """Press Tab until the editor has the focus."""
        while not self.page.evaluate("document.activeElement.closest('.run-code') !== null"):
            self.type("Tab")
        self.page.wait_for_function("document.activeElement.matches('.cm-content')")

    def go_to(self, line):
        """Walk from wherever the cursor is to the end of a line, counted from 1."""
        self.type("Control+Home", *["ArrowDown"] * (line - 1), "End")

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
        """Wait until the page, not the program in it, says something."""
        self.page.locator(SAYING, has_text=words).first.wait_for()


@pytest.fixture(scope="module")
def reader(chromium, address):
    """One reader, whose browser has already loaded what is needed, and how it behaves."""
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    context.grant_permissions(["clipboard-read", "clipboard-write"])
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
        if forget:
            # As the browser's own "Clear site data" does, but for what makes Python load quickly.
            browser = reader.new_cdp_session(page)
            origin = address.removesuffix(urlsplit(address).path)
            kinds = {"origin": origin, "storageTypes": "local_storage"}
            browser.send("Storage.clearDataForOrigin", kinds)
        page.goto(f"{address}/{TASKS[number].page}.html")
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
    used.click("Stop")
    assert used.status.inner_text() == "Stopped."
    # The loop would never end: this is another Python.
    assert "again" in used.run("print('again')")
    assert "Your program ended" in used.status.inner_text()


def test_stop_ends_what_waits_to_run_as_well(used):
    used.write("while True:\n    print('here')")
    used.click("Run")
    used.said("here")
    used.click("Run")
    used.click("Stop")
    assert "again" in used.run("print('again')")


def test_a_long_run_shows_how_far_it_is_until_it_is_stopped(used):
    used.write(
        "import time\nfrom canim.plotting import progress\n"
        "for k in progress(range(1000)):\n    time.sleep(0.3)"
    )
    used.click("Run")
    clock = used.page.get_by_role("timer")
    clock.filter(has_text=re.compile(r"^\d+ s\. \d+ of 1000$")).wait_for()
    used.click("Stop")
    assert used.status.inner_text() == "Stopped."
    assert not clock.is_visible()


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
    answer = used.page.get_by_label("Who are you?")
    answer.click()
    answer.press_sequentially("Ada")
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
    two.page.get_by_text("from the first").first.wait_for()
    assert two.text() == "print('from the first')"
    assert "from the first" in two.run()
    two.write("print('from the second')")
    one.page.get_by_text("from the second").first.wait_for()
    one.editor.click()
    one.type("Control+z")  # what the other tab has written can be undone as well
    assert one.text() == "print('from the first')"


def test_start_over_can_be_taken_back(opened):
    here = opened()
    starter_text = here.text()
    back = here.page.get_by_role("button", name="Take my program back")
    assert not back.is_visible()
    here.write("mine = 1")
    here.click("Start over")
    assert here.text() == starter_text
    here.page.reload()
    assert here.text() == starter_text
    back.click()
    assert here.text() == "mine = 1"  # the page of other tests may have put aside more
    here.page.reload()
    assert here.text() == "mine = 1"
    here.editor.click()
    here.click("Start over")
    here.editor.click()
    here.type("Control+z")
    assert here.text() == "mine = 1"


@pytest.mark.parametrize("choice", ["Keep my program", "Take the new starter"])
def test_a_new_starter_leaves_the_choice(chromium, address, choice):
    """The site that the reader began with has another starter."""
    # Without service workers, which would ask the server past us.
    context = chromium.new_context(service_workers="block")
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    here = Page(context.new_page())

    def older(route):
        page = route.fetch()
        route.fulfill(response=page, body=page.text().replace("end slope", "slope at the end"))

    here.page.route("**/*.html", older)
    here.page.goto(f"{address}/{FIRST}")
    assert "slope at the end" in here.text()
    here.write("mine = 1")
    here.page.unroute("**/*.html")
    here.page.reload()
    assert here.text() == "mine = 1"
    here.click(choice)
    shown = here.text()
    assert shown == "mine = 1" if choice.startswith("Keep") else "# TODO: H[3], end slope" in shown
    here.page.reload()
    assert here.text() == shown
    assert not here.page.locator(".run-notice").is_visible()
    if not choice.startswith("Keep"):
        here.click("Take my program back")
        assert here.text() == "mine = 1"
    context.close()


POINTS = r"points: \[(\S+) +(\S+)\] (\d+)"


def with_points(text):
    """Let a program ask for points, print the first one of the left picture, and end."""
    asking = text.replace("click = False", "click = True")
    start = asking.split("points_a = canim.warping.add_frame_points")[0]
    return f"{start}print('points:', points_a[0].round(1), len(points_a))"


def first_point(here):
    found = re.search(POINTS, here.output.inner_text())
    return [float(number) for number in found.groups()]


def test_points_are_moved_with_keys_and_mouse_and_every_run_uses_them(opened):
    here = opened("2.1")
    here.run(with_points(here.text()))
    before = first_point(here)
    ground = here.page.locator(".run-ground").first
    here.walk_to(ground.get_by_role("slider").first, "Tab")
    here.type("ArrowRight", "ArrowRight", "Shift+ArrowDown")
    ground.click(position={"x": 30, "y": 40})
    here.click("Run with these key points")
    here.wait()
    keyed = first_point(here)
    assert [b - a for a, b in zip(before, keyed)] == pytest.approx([2, 10, 1])

    size = ground.bounding_box()["width"]
    x, y = centre(ground.get_by_role("slider").first)
    here.page.mouse.click(x, y)
    here.page.mouse.move(x, y)
    here.page.mouse.down()
    here.page.mouse.move(x + size / 8, y - size / 16, steps=3)
    here.page.mouse.up()
    here.run()
    dragged = first_point(here)
    # A picture of 160 pixels; a pointer stands on whole pixels of the page.
    assert [b - a for a, b in zip(keyed, dragged)][:2] == pytest.approx([20, -10], abs=1)
    assert dragged[2] == keyed[2]
    here.run(here.text().replace("click = True", "click = False"))
    assert first_point(here) == dragged
    assert "click = True shows them again" in here.output.inner_text()


def centre(dot):
    box = dot.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_points_are_moved_by_a_finger(chromium, address):
    context = chromium.new_context(
        viewport={"width": 390, "height": 800}, has_touch=True, is_mobile=True
    )
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    here = Page(context.new_page())
    here.page.goto(f"{address}/{TASKS['2.1'].page}.html")
    here.run(with_points(here.text()))
    before = first_point(here)
    ground = here.page.locator(".run-ground").first
    here.page.get_by_role("button", name="Enlarge the pictures").tap()
    dot = ground.get_by_role("slider").first
    dot.scroll_into_view_if_needed()
    size = ground.bounding_box()["width"]
    assert size > 600
    finger = context.new_cdp_session(here.page)
    x, y = centre(dot)
    # It takes the point a little beside its centre, and the page does not scroll under it.
    for kind, way in (("Start", 0), ("Move", 10), ("Move", 40), ("End", None)):
        places = [] if way is None else [{"x": x + 8 - way, "y": y + 8 + way}]
        finger.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": places})
    here.click("Run")
    here.wait()
    moved = [b - a for a, b in zip(before, first_point(here))]
    assert moved == pytest.approx([-40 * 160 / size, 40 * 160 / size, 0], abs=0.3)
    context.close()


def test_goals_are_chosen_on_the_picture(opened):
    here = opened("3.2")
    program = here.text().replace("click = False", "click = True")
    here.run(program.replace("(5, 2)", "(1, 2)"))
    here.click("Take all away")
    here.page.locator(".run-ground img").click()  # in its middle
    here.write(f"{program}\nprint(film is not None)")
    here.type("Control+Enter")
    here.said("True")


def test_own_pictures_get_one_size_and_the_lines_that_use_them(opened, tmp_path):
    """Of a phone, held upright, with 12 megapixels; and of another shape."""
    upright = Image.Exif()
    upright[0x0112] = 6
    Image.new("RGB", (4000, 3000), "red").save(tmp_path / "phone.jpg", exif=upright)
    Image.new("RGB", (800, 600), "blue").save(tmp_path / "wide.png")
    here = opened("2.1")
    with here.page.expect_file_chooser() as chooser:
        here.page.get_by_text("Add pictures").click()
    chooser.value.set_files([tmp_path / "phone.jpg", tmp_path / "wide.png"])
    here.said("Both were made 320 × 320 pixels.")
    here.said("The edges of phone.jpg and wide.png were cut off")
    lines = here.page.locator(".run-own pre").inner_text()
    assert lines.splitlines()[0] == (
        'image_a = canim.data.read_image("phone.jpg", size=(320, 320))'
    )
    shape = "print(image_a.shape == image_b.shape, canim.data.read_image('phone.jpg').shape)"
    assert "True (320, 320, 3)" in here.run(f"import canim\n{lines}\n{shape}")


def test_pictures_of_two_sizes_are_refused_at_once(opened):
    here = opened("2.3")
    line = "points_a, points_b = pick_points"
    shown = here.run(here.text().replace(line, f"image_b = image_b[:90]\n{line}"))
    assert "image_a is 160 × 160 pixels and image_b 160 × 90" in shown
    assert "not written yet" not in shown


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
    here.walk_in()
    here.type("Control+a", "text:if True:", "Enter", "text:print('typed')", "Escape", "Tab")
    assert here.page.evaluate("document.activeElement.textContent") == "Run"
    here.type("Enter")
    here.said("typed")
    here.wait()
    assert here.status.get_attribute("role") == "status"


LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
SIGNS = "!#$%&()*+,-./:;<=>?@[]^_`{|}~ \\\\"
TYPED = [
    *("text:letters = '" + LETTERS + "'", "Enter"),
    *('text:signs = "' + SIGNS + '"', "Enter"),
    *("text:for x in [2, 4]:", "Enter", "text:if x > 2:  # 4/2", "Enter"),
    *("text:print('a' + \"b\", {'half': (x / 2)}, x // 2)", "Enter"),
    # Enter after a bracket puts the closing one on a line of its own.
    *("Shift+Tab", "text:y = (", "Enter", "text:x,", "Enter", "text:3"),
    *("ArrowDown", "End", "Enter", "Tab", "Shift+Tab", "Shift+Tab"),
    *("text:print(letters)", "Enter", "text:print(signs)"),
]
WRITTEN = f"""letters = '{LETTERS}'
signs = "{SIGNS}"
for x in [2, 4]:
    if x > 2:  # 4/2
        print('a' + "b", {{'half': (x / 2)}}, x // 2)
    y = (
        x,
        3
    )
print(letters)
print(signs)"""


@pytest.mark.parametrize("width", [1280, 390])
def test_every_key_reaches_the_editor(opened, width):
    here = opened()
    here.page.set_viewport_size({"width": width, "height": 900})
    assert {*(LETTERS + SIGNS + "'\"")} == {*string.printable.rstrip("\t\n\r\v\f")}
    here.page.locator(".run-code").click()
    here.editor.click()
    here.type("Control+a", "Delete", *TYPED)
    assert here.text() == WRITTEN
    here.type("Control+Enter")
    here.said(LETTERS)
    here.wait()
    assert here.output.inner_text().split("\n")[2].endswith("~ \\")


TO_TYPE = {
    "1.1": {
        "# TODO: H[1]": ["text:H[1] = -2 * t**3 + 3 * t**2"],
        "# TODO: H[2]": ["text:H[2] = t**3 - 2 * t**2 + t"],
        "# TODO: H[3]": ["text:H[3] = t**3 - t**2"],
    },
    "2.3": {
        "# TODO: points in between: on": ["text:points = points_a + t * (points_b - points_a)"],
        "# TODO: points in between: at": [
            "text:p = points_between(points_a, points_b, t)",
            *("Enter", "text:a = canim.warping.warp_backward(a, points_a, p, triangles)"),
            *("Enter", "text:b = canim.warping.warp_backward(b, points_b, p, triangles)"),
        ],
        "# TODO: blend": ["text:blend = (1 - t) * a + t * b"],
    },
    "3.4": {
        "# TODO: start": ["text:vertices = 0 * shapes[0]"],
        "# TODO: weighted": [
            *("text:for weight, shape in zip(weights, shapes):", "Enter"),
            "text:vertices = vertices + weight * shape",
        ],
        "# TODO: weights": ["text:weights[[first, second]] = 1 - t, t"],
    },
}


@pytest.mark.parametrize("number", TO_TYPE)
def test_a_task_is_done_by_typing_alone(opened, number):
    here = opened(number)
    lines = here.text().splitlines()
    here.page.reload()
    here.walk_in()
    for todo, keys in reversed(TO_TYPE[number].items()):  # from below: numbers above stay
        (line,) = (n for n, text in enumerate(lines, 1) if text.strip().startswith(todo))
        here.go_to(line)
        here.type("Enter", *keys)
    here.type("Control+Enter")
    here.wait()
    assert f"All checks of Task {number} pass." in here.output.inner_text()


FOCUS = "() => document.activeElement.outerHTML.slice(0, 60)"


def test_no_shortcut_of_the_site_takes_a_key_from_what_has_the_focus(opened):
    here = opened("3.2")
    here.type("/")
    assert 'name="q"' in here.page.evaluate(FOCUS).replace("'", '"')
    here.write(here.text().replace("click = False", "click = True") + "\ninput('Your name? ')")
    here.click("Run")
    answer = here.page.get_by_label("Your name?")
    answer.wait_for()
    here.type("text:1/2")
    assert answer.input_value() == "1/2"
    dot = here.page.locator(".run-ground").get_by_role("slider").first
    slider = here.page.get_by_label("Picture of the film")
    run = here.page.get_by_role("button", name="Run", exact=True)
    output = here.page.locator(".run-crash, .run-output pre").first
    for key, element in (("Shift+Tab", dot), ("Shift+Tab", run), ("Tab", output), ("Tab", slider)):
        here.walk_to(element, key)
        before = here.page.evaluate(FOCUS)
        here.type("/", "Shift+/", "s")
        assert here.page.evaluate(FOCUS) == before


def test_paper_and_copies_have_all_of_the_program(opened):
    here = opened("2.3")
    text = here.text()
    here.page.locator(".run-code").click()
    here.editor.click()
    here.go_to(1)
    here.type("Enter", "text:# " + "a long line " * 30, "Control+End")
    assert here.text() == text.replace("\n", "\n# " + "a long line " * 30 + "\n", 1)
    here.editor.click()
    here.type("Control+a", "Control+c")
    text = here.text()
    assert here.page.evaluate("navigator.clipboard.readText()") == text
    here.page.locator("article h1").click()
    here.type("Control+a", "Control+c")
    copied = here.page.evaluate("navigator.clipboard.readText()")
    here.page.emulate_media(media="print")
    whole = here.page.locator(".run-whole")
    assert [line for line in text.splitlines() if line.strip() not in copied] == []
    assert whole.inner_text().rstrip("\n") == text.rstrip("\n")
    assert whole.evaluate("pre => pre.scrollWidth - pre.clientWidth") <= 1
    assert whole.evaluate("pre => pre.scrollHeight - pre.clientHeight") <= 1
    assert not here.page.locator(".run-code").is_visible()


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


def test_the_editor_begins_where_the_reader_has_clicked(visit):
    opened = visit(FIRST, service_workers="block")
    held = []
    opened.route("**/editor.js*", lambda route: held.append(route))
    opened.locator(".run-code pre").get_by_text("# TODO: H[1]").last.click()
    opened.get_by_text("The editor is loading").wait_for()
    for route in held:
        route.continue_()
    opened.wait_for_selector(".cm-content:focus")
    opened.keyboard.press("End")
    opened.keyboard.type("  # here")
    typed = opened.locator(".cm-activeLine").inner_text()
    assert typed.strip() == "# TODO: H[1], end value  # here"
