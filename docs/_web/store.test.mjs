import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { beforeEach, test } from "node:test";
import vm from "node:vm";
import "./testing/page.mjs";

const { site } = await import("./site.js");
const { carryOver, keep, recall, watch } = await import("./store.js");
const OWN = `canim ${site.pathname} `;
const storage = localStorage;

beforeEach(() => {
  storage.clear();
  globalThis.localStorage = storage;
});

test("what is kept is there again, until it is taken away", () => {
  assert.equal(recall("a"), null);
  assert.equal(keep("a", { text: "x" }), true);
  assert.deepEqual(recall("a"), { text: "x" });
  assert.equal(keep("a", null), true);
  assert.equal(recall("a"), null);
  storage.setItem(`${OWN}a`, "{");
  assert.equal(recall("a"), null);
});

test("two copies of the site share nothing", () => {
  keep("done", { 1.1: true });
  assert.deepEqual(Object.keys(storage), [`${OWN}done`]);
});

test("what an older version kept is carried over once", () => {
  storage.setItem("canim task_1_1.py", '{"text":"old"}');
  storage.setItem("canim done", '{"1.1":true}');
  storage.setItem("canim /other/ done", "{}");
  storage.setItem("theme", "dark");
  storage.setItem(`${OWN}done`, '{"1.2":true}');
  carryOver();
  assert.equal(recall("task_1_1.py").text, "old");
  assert.deepEqual(recall("done"), { 1.2: true });
  keep("task_1_1.py", null);
  carryOver();
  assert.equal(recall("task_1_1.py"), null);
  assert.deepEqual(Object.keys(storage).sort(), ["canim /other/ done", `${OWN}done`, "theme"].sort());
});

test("without room the old text stays where it is", () => {
  storage.setItem("canim task_1_1.py", '{"text":"old"}');
  globalThis.localStorage = full();
  carryOver();
  assert.equal(storage.getItem("canim task_1_1.py"), '{"text":"old"}');
});

test("a browser that keeps nothing, says so, or fails without a word is found out", () => {
  globalThis.localStorage = full();
  assert.equal(keep("a", 1), false);
  Object.defineProperty(globalThis, "localStorage", {
    get: () => {
      throw new DOMException("blocked", "SecurityError");
    },
    configurable: true,
  });
  assert.equal(keep("a", 1), false);
  assert.equal(recall("a"), null);
  carryOver();
  Object.defineProperty(globalThis, "localStorage", { value: storage, configurable: true, writable: true });
});

test("another tab's change is told", () => {
  /** @type {any[]} */
  const seen = [];
  watch("a", (value) => seen.push(value));
  storage.setItem(`${OWN}a`, "2");
  for (const key of [`${OWN}a`, `${OWN}b`, "canim a"]) dispatchEvent(new StorageEvent("storage", { key }));
  assert.deepEqual(seen, [2]);
});

test("what stands in for a storage that fails lets scripts go on, and is known to forget", async () => {
  const place = new URL("stand_in.js", import.meta.url);
  const source = await readFile(place, "utf8");
  class Storage {
    getItem() {
      return "old";
    }
    setItem() {
      throw new DOMException("full", "QuotaExceededError");
    }
  }
  const window = { Storage, localStorage: new Storage() };
  vm.runInNewContext(source, window, place.href);
  window.localStorage.setItem("theme", "dark");
  assert.equal(window.localStorage.getItem("theme"), "old");

  for (const blocked of [() => null, () => assert.fail("blocked")]) {
    const window = { Storage, Map, window: {} };
    Object.defineProperty(window, "localStorage", { get: blocked, configurable: true });
    window.window = window;
    vm.runInNewContext(source, window, place.href);
    const value = /** @type {any} */ (vm.runInNewContext("localStorage", window));
    assert.equal(value.getItem("theme"), null);
    value.setItem("theme", "dark");
    assert.equal(value.getItem("theme"), "dark");
    value.removeItem("theme");
    assert.equal(value.getItem("theme"), null);
    globalThis.localStorage = value;
    assert.equal(keep("a", 1), false);
  }
});

/** A storage that has no room. */
function full() {
  return new Proxy(storage, {
    get: (target, name) => {
      if (name === "setItem")
        return () => {
          throw new DOMException("full", "QuotaExceededError");
        };
      const value = Reflect.get(target, name);
      return typeof value === "function" ? value.bind(target) : value;
    },
  });
}
