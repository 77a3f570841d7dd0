"""Firefox and WebKit, each driven by what its makers give, with keys and pointer as by a person.

Both speak WebDriver, Firefox its newer form. What they are told has the same form; only the
ways there differ.
"""

import json
import os
import shutil
import subprocess
import threading
from pathlib import Path

import websocket
from selenium import webdriver
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.client_config import ClientConfig
from selenium.webdriver.remote.command import Command
from selenium.webdriver.remote.remote_connection import RemoteConnection

LONG = 120  # seconds; slow machines load Python slowly
NAMED = {
    "\b": Keys.BACKSPACE,
    "\n": Keys.ENTER,
    "\t": Keys.TAB,
    "ArrowDown": Keys.ARROW_DOWN,
    "ArrowLeft": Keys.ARROW_LEFT,
    "ArrowRight": Keys.ARROW_RIGHT,
    "Control": Keys.CONTROL,
    "Enter": Keys.ENTER,
    "Shift": Keys.SHIFT,
    "Tab": Keys.TAB,
}
# Elements are named by a selector, or by a path as XPath has it.
IN_THE_PAGE = f"""
  const find = (path) => path.startsWith("//")
    ? document.evaluate(path, document, null, XPathResult.FIRST_ORDERED_NODE_TYPE).singleNodeValue
    : document.querySelector(path);
  const pause = () => new Promise((go) => setTimeout(go, 20));
  const wait = async (condition, what) => {{
    for (const end = Date.now() + {LONG - 10}_000; Date.now() < end; await pause()) {{
      const met = await condition();
      if (met) return met;
    }}
    const seen = [".run-status", ".run-output"].map((path) => find(path)?.innerText);
    throw `waited in vain for ${{what}}; the page says: ${{seen.join(" ")}}`;
  }};
  // Where an element is, once it is there and keeps its place.
  const place = (path, x, y) => wait(async () => {{
    const element = find(path);
    if (!element || element.disabled) return false;
    element.scrollIntoView({{ block: "center", behavior: "instant" }});
    const before = JSON.stringify(element.getBoundingClientRect());
    await new Promise(requestAnimationFrame);
    await new Promise(requestAnimationFrame);
    const box = element.getBoundingClientRect();
    const still = box.width > 0 && JSON.stringify(box) === before;
    return still && [box.left + x * box.width, box.top + y * box.height];
  }}, path);
"""


def installed(*names):
    """Return the path of the first program that is there."""
    found = next(filter(None, map(shutil.which, names)), None)
    if not found:
        raise FileNotFoundError(f"not installed: {' or '.join(names)}; .ci/run says which packages")
    return found


def button(name):
    return f"//button[normalize-space() = '{name}']"


class Engine:
    """One window of a browser: what a person does in it, and what is to be seen.

    Each engine has `go` and `renew` for pages, `evaluate`, `act` for input in WebDriver's form,
    and `close`.
    """

    def __init__(self):
        self._said = []

    def said(self):
        """Return what the console was told, as far as pages recorded it, and forget it."""
        said, self._said = self._said + self.evaluate("(window.said ?? []).splice(0)"), []
        return said

    def goto(self, address):
        self._said = self.said()
        self.go(address)

    def reload(self):
        self._said = self.said()
        self.renew()

    def type(self, text):
        self._strike((kind, sign) for sign in text for kind in ("keyDown", "keyUp"))

    def press(self, keys):
        """Press keys together, as "Shift+ArrowDown"."""
        names = keys.split("+")
        self._strike([("keyDown", name) for name in names])
        self._strike([("keyUp", name) for name in reversed(names)])

    def _strike(self, strokes):
        strokes = [{"type": kind, "value": NAMED.get(key, key)} for kind, key in strokes]
        self.act({"type": "key", "id": "keyboard", "actions": strokes})

    def click(self, path, x=0.5, y=0.5):
        """Click on an element, at a share of its width and height."""
        at = self.evaluate(f"place({json.dumps(path)}, {x}, {y})")
        self._pull(at, at)

    def drag(self, path, right, down):
        """Pull an element somewhere else, by so many pixels."""
        x, y = self.evaluate(f"place({json.dumps(path)}, 0.5, 0.5)")
        self._pull((x, y), (x + right, y + down))

    def _pull(self, start, end):
        moves = [{"type": "pointerMove", "x": round(x), "y": round(y)} for x, y in (start, end)]
        down, up = ({"type": f"pointer{way}", "button": 0} for way in ("Down", "Up"))
        actions = [moves[0], down, moves[1], up]
        mouse = {"parameters": {"pointerType": "mouse"}, "actions": actions}
        self.act({"type": "pointer", "id": "mouse", **mouse})

    def text(self, path):
        return self.evaluate(f"find({json.dumps(path)}).innerText")

    def wait_for(self, condition):
        """Wait until a condition, in JavaScript, holds in the page."""
        self.evaluate(f"wait(() => !!({condition}), {json.dumps(condition)})")


class Firefox(Engine):
    """Over WebDriver BiDi, which it speaks by itself; it tells what the console is told."""

    def __init__(self, folder):
        super().__init__()
        program = [installed("firefox-esr", "firefox"), "--headless", "--no-remote"]
        command = [*program, "--remote-debugging-port=0", "--profile", str(folder)]
        self._process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        log = self._process.stderr
        address = next(line.split()[-1] for line in log if "listening on ws://" in line)
        self._log = threading.Thread(target=log.read)  # a full pipe would stop it
        self._log.start()
        self._socket = websocket.create_connection(
            f"{address}/session", timeout=LONG, suppress_origin=True
        )
        self._asked = 0
        self._ask("session.new", capabilities={})
        self._page = {"context": self._ask("browsingContext.getTree")["contexts"][0]["context"]}
        self._ask("session.subscribe", events=["log.entryAdded"])
        size = {"width": 1280, "height": 900}
        self._ask("browsingContext.setViewport", **self._page, viewport=size)

    def _ask(self, method, **parameters):
        self._asked += 1
        self._socket.send(json.dumps({"id": self._asked, "method": method, "params": parameters}))
        while (answer := json.loads(self._socket.recv())).get("id") != self._asked:
            if answer["method"] == "log.entryAdded":
                self._said.append(answer["params"]["text"])
        assert answer["type"] == "success", answer
        return answer["result"]

    def go(self, address):
        self._ask("browsingContext.navigate", **self._page, url=address, wait="complete")

    def renew(self):
        self._ask("browsingContext.reload", **self._page, wait="complete")

    def evaluate(self, expression):
        script = f"(async () => {{ {IN_THE_PAGE} return JSON.stringify(await ({expression})) }})()"
        given = {"expression": script, "target": self._page, "awaitPromise": True}
        answer = self._ask("script.evaluate", **given)
        assert answer["type"] == "success", answer["exceptionDetails"]["text"]
        return json.loads(answer["result"].get("value", "null"))

    def act(self, actions):
        self._ask("input.performActions", **self._page, actions=[actions])

    def close(self):
        self._ask("browser.close")
        self._socket.close()
        self._process.wait(LONG)
        self._log.join()
        self._process.stderr.close()


class WebKit(Engine):
    """WebKitGTK, a stand-in for Safari, on a screen that nobody sees."""

    def __init__(self, folder):
        super().__init__()
        browsers = sorted(Path("/usr/lib").glob("*/webkit2gtk-*/MiniBrowser"))
        options = webdriver.WebKitGTKOptions()
        options.binary_location = installed(*map(str, browsers), "MiniBrowser")
        options.add_argument("--automation")
        driver, screen = installed("WebKitWebDriver"), installed("Xvfb")
        number, ready = os.pipe()
        given = ["-displayfd", str(ready), "-screen", "0", "1280x1000x24", "-nolisten", "tcp"]
        self._screen = subprocess.Popen([screen, *given], pass_fds=[ready])
        os.close(ready)
        with open(number) as file:
            display = f":{file.readline().strip()}"
        # Without a graphics card, compositing only costs time.
        environment = {**os.environ, "DISPLAY": display, "WEBKIT_DISABLE_COMPOSITING_MODE": "1"}
        self._service = webdriver.WebKitGTKService(driver, env=environment)
        self._service.start()
        server = RemoteConnection(client_config=ClientConfig(self._service.service_url))
        self._driver = webdriver.Remote(server, options=options)
        self._driver.set_script_timeout(LONG)
        self._driver.set_window_size(1280, 1000)

    def go(self, address):
        self._driver.get(address)

    def renew(self):
        self._driver.refresh()

    def evaluate(self, expression):
        script = f"""const done = arguments[0]; (async () => {{ {IN_THE_PAGE}
          return {{ value: JSON.stringify(await ({expression})) }} }})()
          .then(done, (error) => done({{ error: String(error) }}))"""
        answer = self._driver.execute_async_script(script)
        assert "error" not in answer, answer["error"]
        return json.loads(answer.get("value") or "null")

    def act(self, actions):
        self._driver.execute(Command.W3C_ACTIONS, {"actions": [actions]})

    def close(self):
        self._driver.quit()
        self._service.stop()
        self._screen.terminate()
        self._screen.wait(LONG)
