import assert from "node:assert/strict";
import { test } from "node:test";
import { SITE } from "./testing/page.mjs";

const EDITOR = new URL(`${SITE}_static/editor.js`);
const { keepOffline } = await import("./offline.js");

/** @param {object} container */
const withWorker = (container) =>
  Object.defineProperty(navigator, "serviceWorker", { value: container, configurable: true });

test("a service worker is installed, and told what was loaded before it came", async (context) => {
  context.mock.method(performance, "getEntriesByType", () => [{ name: `${SITE}a.css` }]);
  /** @type {any[]} */
  const told = [];
  /** @type {string[]} */
  const registered = [];
  const container = {
    controller: null,
    register: async (/** @type {URL} */ address) => registered.push(address.href),
    addEventListener(/** @type {string} */ _, /** @type {() => void} */ changed) {
      this.controller = { postMessage: (/** @type {any} */ message) => told.push(message) };
      changed();
    },
  };
  withWorker(container);
  await keepOffline(new URL(SITE), EDITOR);
  await keepOffline(new URL(SITE), EDITOR);
  assert.deepEqual(registered, Array(2).fill(`${SITE}service_worker.js`));
  assert.deepEqual(told, Array(2).fill([location.href, EDITOR.href, `${SITE}a.css`]));
});

test("a browser that cannot goes on without", async () => {
  withWorker({ addEventListener() {}, register: async () => Promise.reject(new Error("no")) });
  await keepOffline(new URL(SITE), EDITOR);
  withWorker(undefined);
  await keepOffline(new URL(SITE), EDITOR);
});

test("one that is slow to begin is not waited for", async (context) => {
  context.mock.timers.enable({ apis: ["setTimeout"] });
  withWorker({ addEventListener() {}, register: async () => {} });
  const begun = keepOffline(new URL(SITE), EDITOR);
  context.mock.timers.tick(1000);
  await begun;
});
