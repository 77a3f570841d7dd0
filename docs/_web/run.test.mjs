import assert from "node:assert/strict";
import { registerHooks } from "node:module";
import { beforeEach, test } from "node:test";
import { FakeWorker, show } from "./testing/page.mjs";

await import("./run.js");

const PAGE = `<canim-run data-file="task_1_1.py" data-block="interpolation">
  <template><pre>a = 1
b = 2  # TODO
</pre></template><p class="run-missing">Nothing runs here.</p></canim-run>`;

/** @type {HTMLElement} */
let page;
const press = (/** @type {string} */ name) =>
  [...page.querySelectorAll("button")].find(({ textContent }) => textContent === name)?.click();
const status = () => page.querySelector(".run-status")?.textContent;
const turn = () => new Promise((resolve) => setTimeout(resolve));

/** Press Run; return the worker, which has got ready. */
async function run() {
  press("Run");
  await turn();
  const worker = /** @type {FakeWorker} */ (FakeWorker.made.at(-1));
  if (worker.orders.at(-1)?.kind === "load") worker.tell("ready");
  await turn();
  return worker;
}

/** @param {() => any} condition */
async function until(condition) {
  while (!condition()) await turn();
}

beforeEach(() => {
  localStorage.clear();
  page = show(PAGE);
});

test("Run sends the program to Python, and shows what comes", async () => {
  const worker = await run();
  assert.deepEqual(
    worker.orders.map(({ kind, code }) => [kind, code]),
    [
      ["load", "a = 1\nb = 2  # TODO\n"],
      ["run", "a = 1\nb = 2  # TODO\n"],
    ],
  );
  worker.tell("begin");
  worker.tell("text", { text: "3" });
  worker.tell("figure", { alt: "A curve", width: 64, height: 48, film: 0 });
  worker.tell("report", { html: "<p>All pass.</p>", task: "1.1", done: true });
  worker.tell("file", { name: "a.txt" });
  worker.tell("end", { text: "Your program ended after 0.1 s." });
  assert.equal(page.querySelector(".run-output pre")?.textContent, "3");
  assert.equal(page.querySelector(".run-output img")?.getAttribute("alt"), "A curve");
  assert.equal(status(), "Your program ended after 0.1 s.");
  assert.match(page.textContent ?? "", /All pass\..*Save a\.txt/);
});

test("a line that stops the program is told", async () => {
  page.querySelector(".run-code")?.dispatchEvent(new PointerEvent("pointerenter"));
  await until(() => page.querySelector(".cm-content"));
  const worker = await run();
  worker.tell("begin");
  worker.tell("crash", { text: "The program stops in line 2.", line: 2 });
  assert.match(page.querySelector(".run-crash")?.textContent ?? "", /line 2/);
});

test("what a program asks is answered in its next run", async () => {
  const worker = await run();
  worker.tell("begin");
  worker.tell("question", { text: "Who are you?" });
  worker.tell("end", { text: "Your program waits for an answer." });
  const field = /** @type {HTMLInputElement} */ (page.querySelector("form input"));
  field.value = "Ada";
  page.querySelector("form")?.dispatchEvent(new Event("submit"));
  await turn();
  assert.deepEqual(JSON.parse(worker.orders.at(-1).answers).texts, ["Ada"]);
});

test("it is told how far Python has come", async () => {
  page.querySelector(".run-bar")?.dispatchEvent(new PointerEvent("pointerenter"));
  await turn();
  const worker = /** @type {FakeWorker} */ (FakeWorker.made.at(-1));
  assert.equal(status(), "Python is loading: 0 of 12 MB. You can edit while it does.");
  worker.tell("progress", { done: 6_000_000, waits: "silent" });
  assert.equal(status(), "Python is loading: 6 of 12 MB. You can edit while it does.");
  worker.tell("ready");
  assert.equal(status(), "Python is ready.");
  press("Run");
  press("Stop");
  await turn();
  FakeWorker.made.at(-1)?.tell("progress", { done: 6_000_000, waits: "silent" });
  assert.equal(status(), "Stopped.");
});

test("what goes wrong is told, and Run begins anew", async () => {
  const worker = await run();
  worker.tell("failed", { reason: "lost", file: "numpy.whl" });
  await until(() => /connection was lost/.test(status() ?? ""));
  assert.equal(worker.isEnded, true);
  const next = await run();
  assert.notEqual(next, worker);
  next.tell("begin");
  next.tell("end", { text: "Your program ended." });
  assert.equal(status(), "Your program ended.");
});

test("a script of the worker that was wrong is asked for anew before the next run", async (context) => {
  /** @type {any[]} */
  const asked = [];
  context.mock.method(globalThis, "fetch", async (/** @type {any} */ address, /** @type {any} */ options) => {
    asked.push(`${String(address).split("/").pop()} ${options.cache}`);
    return new Response("", { headers: { "Content-Type": "text/javascript" } });
  });
  press("Run");
  await turn();
  const worker = /** @type {FakeWorker} */ (FakeWorker.made.at(-1));
  worker.onerror({});
  await until(() => /does not start/.test(status() ?? ""));
  asked.length = 0;
  press("Run");
  await until(() => FakeWorker.made.at(-1) !== worker);
  assert.deepEqual(asked, ["worker.js reload"]);
});

test("who presses Run before the reason is known is not stopped by it", async (context) => {
  /** @type {(answer: Response) => void} */
  let answer = () => {};
  context.mock.method(globalThis, "fetch", () => new Promise((resolve) => (answer = resolve)));
  page.querySelector(".run-bar")?.dispatchEvent(new PointerEvent("pointerenter"));
  await turn();
  FakeWorker.made.at(-1)?.tell("failed", { reason: "missing", file: "numpy.whl" });
  const worker = await run();
  worker.tell("begin");
  answer(new Response(""));
  await turn();
  assert.equal(status(), "Running …");
});

test("a page older than the site offers to load itself again", async (context) => {
  const newer = '<script src="_static/run.js?v=2"></script>';
  context.mock.method(globalThis, "fetch", async () => new Response(newer));
  const reload = context.mock.method(location, "reload", () => {});
  const worker = await run();
  worker.tell("failed", { reason: "missing", file: "worker.js" });
  await until(() => /renewed/.test(status() ?? ""));
  press("Load the page again");
  assert.equal(reload.mock.callCount(), 1);
});

test("a program that is not kept is told until it is kept again", async () => {
  page.querySelector(".run-code")?.dispatchEvent(new PointerEvent("pointerenter"));
  await until(() => page.querySelector(".cm-content"));
  const type = () => {
    const content = /** @type {any} */ (page.querySelector(".cm-content"));
    const { view } = content.cmTile;
    view.dispatch({ changes: { from: 0, insert: "#" } });
  };
  const told = () => page.querySelector(".run-unkept")?.textContent;
  const { localStorage: storage } = globalThis;
  const setItem = () => {
    throw new DOMException("full", "QuotaExceededError");
  };
  Object.assign(globalThis, { localStorage: { getItem: () => null, setItem } });
  type();
  assert.match(told() ?? "", /does not keep your program/);
  const worker = await run();
  worker.tell("begin");
  worker.tell("end", { text: "Your program ended." });
  assert.match(told() ?? "", /does not keep your program/);
  Object.assign(globalThis, { localStorage: storage });
  type();
  assert.equal(told(), "");
});

test("where nothing can run, the page says why", () => {
  const why = (/** @type {object} */ place, /** @type {string} */ name, /** @type {any} */ value) => {
    const before = Object.getOwnPropertyDescriptor(place, name);
    Object.defineProperty(place, name, { value, configurable: true });
    const words = show(PAGE).querySelector(".run-missing")?.textContent ?? "";
    Reflect.deleteProperty(place, name);
    if (before) Object.defineProperty(place, name, before);
    return words;
  };
  assert.match(why(globalThis, "origin", "null"), /another page shows this one inside it/);
  assert.match(why(location, "protocol", "file:"), /opened from a folder/);
  assert.match(why(globalThis, "WebAssembly", undefined), /no WebAssembly/);
});

test("an editor that does not come is told, and asked for again", async () => {
  /** @type {string[]} */
  const asked = [];
  const hooks = registerHooks({
    resolve(name, context, next) {
      if (!name.includes("editor.js")) return next(name, context);
      asked.push(name.split("/").pop() ?? "");
      if (asked.length === 1) throw new TypeError("Failed to fetch");
      return next(name.split("?")[0], context);
    },
  });
  const turnTo = () => page.querySelector(".run-code")?.dispatchEvent(new PointerEvent("pointerenter"));
  turnTo();
  const told = () => page.querySelector(".run-editor")?.textContent ?? "";
  await until(() => /editor has not come/.test(told()));
  turnTo();
  await until(() => page.querySelector(".cm-content"));
  assert.equal(told(), "");
  assert.deepEqual(asked, ["editor.js", "editor.js?again=1"]);
  hooks.deregister();
});

test("what is written while Python loads is what runs", async () => {
  page.querySelector(".run-code")?.dispatchEvent(new PointerEvent("pointerenter"));
  await until(() => page.querySelector(".cm-content"));
  press("Run");
  await turn();
  const worker = /** @type {FakeWorker} */ (FakeWorker.made.at(-1));
  /** @type {any} */ (page.querySelector(".cm-content")).cmTile.view.dispatch({ changes: { from: 0, insert: "#" } });
  press("Run");
  worker.tell("ready");
  await turn();
  const runs = worker.orders.filter(({ kind }) => kind === "run");
  assert.deepEqual(
    runs.map(({ code }) => code),
    ["#a = 1\nb = 2  # TODO\n"],
  );
});

test("Run, Stop and Run in haste run the program once, and it can be stopped", async () => {
  const first = await run();
  press("Stop");
  press("Run");
  press("Stop");
  press("Run");
  await turn();
  const worker = /** @type {FakeWorker} */ (FakeWorker.made.at(-1));
  assert.equal(first.isEnded, true);
  for (const { kind } of [...worker.orders]) if (kind === "load") worker.tell("ready");
  await turn();
  assert.equal(worker.orders.filter(({ kind }) => kind === "run").length, 1);
  assert.equal([...page.querySelectorAll("button")].find((b) => b.textContent === "Stop")?.disabled, false);
});

test("what stops the page from giving its order is told", async () => {
  await run();
  press("Stop");
  await turn();
  const worker = /** @type {FakeWorker} */ (FakeWorker.made.at(-1));
  worker.tell("ready");
  worker.postMessage = () => {
    throw new DOMException("no copy", "DataCloneError");
  };
  press("Run");
  await until(() => /does not start/.test(status() ?? ""));
});

test("who uses the keyboard is not sent to the top of the page by what goes away", async () => {
  const worker = await run();
  const named = (/** @type {string} */ name) =>
    [...page.querySelectorAll("button")].find((b) => b.textContent === name);
  named("Stop")?.focus();
  worker.tell("begin");
  worker.tell("end", { text: "Your program ended." });
  assert.equal(document.activeElement?.textContent, "Run");
});

test("what Python has loaded is kept for a reader without the network", async () => {
  /** @type {string[][]} */
  const told = [];
  const active = { postMessage: (/** @type {string[]} */ addresses) => told.push(addresses) };
  Object.defineProperty(navigator, "serviceWorker", { value: { ready: { active } }, configurable: true });
  const worker = await run();
  worker.tell("loaded", { addresses: ["https://example.org/course/_run/12ab/worker.js"] });
  await turn();
  assert.deepEqual(told.at(-1), ["https://example.org/course/_run/12ab/worker.js"]);
  Reflect.deleteProperty(navigator, "serviceWorker");
});

test("the editor begins where the reader has clicked while it was loading", async () => {
  const text = /** @type {HTMLElement} */ (page.querySelector(".run-code pre"));
  text.tabIndex = 0;
  text.focus();
  const selection = { anchorNode: text.firstChild, anchorOffset: 5 };
  Object.assign(globalThis, { getSelection: () => selection });
  await until(() => page.querySelector(".cm-content"));
  const { view } = /** @type {any} */ (page.querySelector(".cm-content")).cmTile;
  assert.equal(view.state.selection.main.anchor, 5);
});
