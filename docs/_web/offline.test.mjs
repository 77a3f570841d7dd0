import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { SITE, settled } from "./testing/page.mjs";

const EDITOR = new URL(`${SITE}_static/editor.js`);
const { keepLoaded, keepOffline } = await import("./offline.js");
/** @type {any[]} */
const told = [];
/** @type {string[]} */
const registered = [];
const active = { postMessage: (/** @type {any} */ message) => told.push(message) };

/** A browser's way to service workers. @param {object} [given] */
const container = (given) => ({
  controller: active,
  ready: Promise.resolve({ active }),
  register: async (/** @type {URL} */ address) => registered.push(address.href),
  addEventListener() {},
  ...given,
});

/** @param {() => any} get */
const withWorker = (get) => Object.defineProperty(navigator, "serviceWorker", { get, configurable: true });

beforeEach(() => {
  told.length = registered.length = 0;
});

test("a service worker is installed, and told what was loaded before it came", async (context) => {
  context.mock.method(performance, "getEntriesByType", () => [{ name: `${SITE}a.css` }]);
  let change = () => {};
  const made = container({ controller: null, addEventListener: (_, changed) => (change = changed) });
  withWorker(() => made);
  let isDone = false;
  const kept = keepOffline(new URL(SITE), EDITOR).then(() => (isDone = true));
  await settled();
  assert.equal(isDone, false); // it is worth while to wait for it
  change();
  await kept;
  withWorker(container);
  await keepOffline(new URL(SITE), EDITOR);
  await settled();
  assert.deepEqual(registered, Array(2).fill(`${SITE}service_worker.js`));
  assert.deepEqual(told, Array(2).fill([location.href, EDITOR.href, `${SITE}a.css`]));
});

const REFUSED = async () => Promise.reject(new Error("no"));
const CANNOT = {
  "does not know service workers": () => undefined,
  "refuses them": () => container({ register: REFUSED, ready: new Promise(() => {}) }),
  "forbids to ask for them": () => {
    throw new DOMException("no", "SecurityError");
  },
};
for (const [kind, get] of Object.entries(CANNOT))
  test(`a browser that ${kind} goes on without, at once`, async (context) => {
    context.mock.timers.enable({ apis: ["setTimeout"] }); // nobody moves them on
    withWorker(get);
    await keepOffline(new URL(SITE), EDITOR);
    keepLoaded([EDITOR.href]);
    await settled();
    assert.deepEqual(told, []);
  });

test("one that is slow to begin is not waited for, and told later", async (context) => {
  context.mock.timers.enable({ apis: ["setTimeout"] });
  /** @type {(registration: object) => void} */
  let begin = () => {};
  const ready = new Promise((resolve) => (begin = resolve));
  withWorker(() => container({ controller: null, ready }));
  const begun = keepOffline(new URL(SITE), EDITOR);
  context.mock.timers.tick(1000);
  await begun;
  keepLoaded([`${SITE}_run/12ab/worker.js`]);
  await settled();
  assert.deepEqual(told, []);
  begin({ active });
  await settled();
  assert.equal(told.length, 2);
  assert.deepEqual(told[1], [`${SITE}_run/12ab/worker.js`]);
});
