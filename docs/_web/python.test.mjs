import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { FakeWorker, settled } from "./testing/page.mjs";

const { Python } = await import("./python.js");
const ORDER = { kind: "load", packages: [], code: "", name: "a.py", answers: "{}", files: [] };

/** @type {any[]} */
const told = [];
/** @type {InstanceType<typeof Python>} */
let python;

/** @param {import("node:test").TestContext} context */
function begin(context, kind = "load") {
  context.mock.timers.enable({ apis: ["setInterval"] });
  python.send({ ...ORDER, kind });
  return /** @type {FakeWorker} */ (FakeWorker.made.at(-1));
}

/** Let seconds go by; the worker, if it answers, has got so far.
 *  @param {import("node:test").TestContext} context @param {number} seconds
 *  @param {() => void} [answer] */
function wait(context, seconds, answer = () => {}) {
  for (let beat = 0; beat < 2 * seconds; beat++) {
    context.mock.timers.tick(500);
    answer();
  }
}

beforeEach(() => {
  told.length = 0;
  python = new Python("https://example.org/worker.js", (message) => told.push(message));
});

test("one worker gets all orders, until it is ended", (context) => {
  const worker = begin(context);
  python.send(ORDER);
  assert.equal(worker.address, "https://example.org/worker.js");
  assert.equal(worker.orders.length, 2);
  assert.equal(python.hasBegun, true);
  worker.tell("ready");
  assert.equal(python.isReady, true);
  python.end();
  assert.equal(worker.isEnded, true);
  assert.equal(python.isReady || python.hasBegun, false);
  python.send(ORDER);
  assert.notEqual(FakeWorker.made.at(-1), worker);
});

test("the worker is asked how far it is, until it has done what it was ordered", (context) => {
  const worker = begin(context);
  wait(context, 2);
  assert.deepEqual(worker.orders.slice(1), [{ kind: "ask" }]); // it has not answered
  worker.tell("progress", { done: 5, waits: "silent" });
  assert.equal(told[0].done, 5);
  wait(context, 0.5);
  assert.equal(worker.orders.length, 3);
  worker.tell("progress", { done: 5, waits: "" });
  assert.equal(told.length, 1);
  worker.tell("ready");
  wait(context, 60);
  assert.equal(worker.orders.length, 3);
});

test("a line that brings something is never given up", (context) => {
  const worker = begin(context);
  let done = 0;
  wait(context, 100, () => worker.tell("progress", { done: done++ / 100, waits: "silent" }));
  assert.equal(told.at(-1).kind, "progress");
});

test("a worker that is busy is not silent", (context) => {
  const worker = begin(context, "run");
  worker.tell("begin");
  wait(context, 1000);
  worker.tell("progress", { done: 0, waits: "start" });
  assert.deepEqual(
    told.map(({ kind }) => kind),
    ["begin", "progress"],
  );
});

for (const [waits, seconds] of /** @type {const} */ ([
  ["silent", 20],
  ["start", 61],
])) {
  test(`nothing for ${seconds} seconds is told: ${waits}`, (context) => {
    const worker = begin(context);
    const answer = () => worker.tell("progress", { done: 5, waits });
    wait(context, seconds - 2, answer);
    assert.equal(told.at(-1).kind, "progress");
    wait(context, 2, answer);
    assert.equal(told.find(({ kind }) => kind === "failed").reason, waits);
  });
}

test("a worker that is busy now and then is not given up while it starts", (context) => {
  const worker = begin(context);
  for (let spell = 0; spell < 20; spell++) {
    wait(context, 20, () => worker.tell("progress", { done: 5, waits: "start" }));
    wait(context, 3); // busy
    worker.tell("progress", { done: 5, waits: "start" });
  }
  assert.ok(told.every(({ kind }) => kind === "progress"));
});

test("what was loaded is handed on, to be kept", async (context) => {
  /** @type {any[]} */
  const kept = [];
  const active = { postMessage: (/** @type {any} */ addresses) => kept.push(addresses) };
  const serviceWorker = { ready: Promise.resolve({ active }) };
  Object.defineProperty(navigator, "serviceWorker", { value: serviceWorker, configurable: true });
  begin(context).tell("loaded", { addresses: ["https://example.org/a.whl"] });
  await settled();
  assert.deepEqual(kept, [["https://example.org/a.whl"]]);
});

test("the cause of a failure is on the console, for a maintainer", (context) => {
  const warn = context.mock.method(console, "warn", () => {});
  begin(context).tell("failed", { reason: "start", file: "", text: "Error: the cause" });
  assert.match(String(warn.mock.calls[0].arguments), /start.*the cause/);
});

test("a script of the worker that does not come is told", (context) => {
  begin(context);
  wait(context, 18);
  assert.deepEqual(told, []);
  wait(context, 1);
  assert.equal(told[0].reason, "silent");
});

test("a browser that makes no worker is told", (context) => {
  context.mock.method(globalThis, "Worker", () => {
    throw new DOMException("no", "SecurityError");
  });
  python.send(ORDER);
  assert.equal(told[0].reason, "script");
});

test("a worker that fails is told: without its script, or at its work", (context) => {
  const worker = begin(context);
  worker.onerror({});
  assert.equal(told.at(-1).reason, "script");
  worker.tell("begin");
  worker.onerror({ message: "out of memory" });
  assert.equal(told.at(-1).reason, "stopped");
});

test("a file that was wrong is asked for anew", (context) => {
  const worker = begin(context);
  worker.tell("failed", { reason: "changed", file: "numpy.whl" });
  python.end();
  python.send(ORDER);
  assert.deepEqual(FakeWorker.made.at(-1).orders[0].doubtful, ["numpy.whl"]);
});
