// The service worker with a cache and a network made up for it: node --test docs/_web
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { beforeEach, test } from "node:test";

const SITE = "https://example.org/course/";
/** @type {Map<string, string>} */
const kept = new Map();
/** @type {{[kind: string]: (event: any) => void}} */
const on = {};
/** @type {{[address: string]: string | Response} | null} */
let network;
/** @type {{[path: string]: string}} what the site was built with */
const hashes = {};
/** @type {string[]} */
const others = [];
/** @type {string[]} */
const deleted = [];

const isBuilt = (/** @type {string} */ path, /** @type {string} */ text) => {
  hashes[path] = createHash("sha256").update(text).digest("hex");
};

/** A page of the site. @param {string} text */
const page = (text) =>
  new Response(`<!doctype html>\n<html class="no-js" lang="en" data-content_root="./">${text}`, {
    headers: { "Content-Type": "text/html; charset=utf-8" },
  });

const cache = {
  put: async (url, response) => kept.set(url, await response.text()),
  delete: async (url) => kept.delete(url),
  keys: async () => [...kept.keys()].map((url) => ({ url })),
  match: async (url) => (kept.has(url) ? new Response(kept.get(url)) : undefined),
};
Object.assign(globalThis, {
  self: globalThis,
  registration: { scope: SITE },
  RUN: { hashes, others },
  skipWaiting() {},
  clients: { claim: async () => {} },
  caches: { open: async () => cache, delete: async (name) => deleted.push(name) },
  addEventListener: (kind, listener) => {
    on[kind] = listener;
  },
  fetch: async ({ url }) => {
    if (!network) throw new TypeError("no network");
    const answer = network[url];
    if (answer instanceof Response) return answer.clone();
    return answer === undefined ? new Response("", { status: 404 }) : new Response(answer);
  },
});
const ask = globalThis.fetch;
await import("./service_worker.js");

async function get(path, options = {}) {
  let answer;
  /** @type {Promise<void>[]} */
  const later = [];
  const request = new Request(SITE + path, options);
  on.fetch({
    request,
    respondWith: (response) => (answer = response),
    waitUntil: (promise) => later.push(promise),
  });
  const text = (await answer)?.text();
  await Promise.all(later); // what is kept is kept after the answer
  return text;
}

beforeEach(() => {
  kept.clear();
  network = {};
});

test("a page is the newest there is, and the last one without a network", async () => {
  network[`${SITE}a.html`] = page("old");
  assert.match(await get("a.html"), /old/);
  network[`${SITE}a.html`] = page("new");
  assert.match(await get("a.html"), /new/);
  network = null;
  assert.match(await get("a.html"), /new/);
  assert.match(await get("a.html?highlight=x"), /new/);
  await assert.rejects(get("b.html"), /no network/);
});

const LOGIN = { "Content-Type": "text/html" };
for (const [path, right] of /** @type {[string, () => Response][]} */ ([
  ["", () => page("right")],
  ["a.html", () => page("right")],
  ["a", () => page("right")],
  ["_images/a.webp", () => new Response("right", { headers: { "Content-Type": "image/webp" } })],
  ["_images/b.webp", () => new Response("right", { headers: { "Content-Type": "application/octet-stream" } })],
  ["starters/a.py", () => new Response("right", { headers: { "Content-Type": "text/x-python" } })],
]))
  test(`the page of a network that wants a login takes the place of nothing: ${path || "/"}`, async () => {
    network[SITE + path] = right();
    assert.match(await get(path), /right/);
    const logins = [new Response("<html>Log in", { headers: LOGIN }), new Response("Log in")];
    // What is neither page nor picture can be anything but a page.
    for (const login of path === "a" || path.endsWith(".py") ? logins.slice(0, 1) : logins) {
      network = { [SITE + path]: login };
      assert.match(await get(path), /Log in/);
      network = null;
      assert.match(await get(path), /right/);
    }
  });

test("what has a version is asked for once", async () => {
  for (const path of ["_run/12ab/worker.js", "_static/run.js?v=1"]) {
    network[SITE + path] = "first";
    isBuilt(path.split("?")[0], "first");
    assert.equal(await get(path), "first");
    network[SITE + path] = "never";
    assert.equal(await get(path), "first");
  }
});

test("a new version takes the place of the old one", async () => {
  for (const path of ["_run/1/a.whl", "_run/1/b.whl", "_static/run.js?v=1", "_run/2/a.whl", "_static/run.js?v=2"]) {
    network[SITE + path] = path;
    isBuilt(path.split("?")[0], path);
    await get(path);
  }
  assert.deepEqual([...kept.keys()].sort(), [`${SITE}_run/2/a.whl`, `${SITE}_static/run.js?v=2`]);
});

test("a second request for the same script pushes out nothing", async () => {
  isBuilt("_static/editor.js", "editor");
  for (const again of ["", "&again=1", "&again=2"]) {
    network = { [`${SITE}_static/editor.js?v=1${again}`]: "editor" };
    assert.equal(await get(`_static/editor.js?v=1${again}`), "editor");
  }
  network = null;
  assert.equal(await get("_static/editor.js?v=1"), "editor");
});

test("nothing but the right bytes is kept of what has a version", async () => {
  for (const path of ["_run/12ab/a.wasm", "_static/site.js?v=1", "_run/unknown/a.wasm"]) {
    isBuilt(path.split("?")[0], "right");
    if (path.includes("unknown")) delete hashes[path];
    for (const answer of ["log in", "right"]) {
      network[SITE + path] = answer;
      assert.equal(await get(path), answer);
    }
    assert.equal(kept.get(SITE + path), path.includes("unknown") ? undefined : "right");
  }
});

test("who asks for the server's answer gets it, and it is kept", async () => {
  isBuilt("_run/12ab/worker.js", "right");
  network[`${SITE}_run/12ab/worker.js`] = "right";
  await get("_run/12ab/worker.js");
  network[`${SITE}_run/12ab/worker.js`] = "not right";
  assert.equal(await get("_run/12ab/worker.js", { cache: "reload" }), "not right");
  assert.equal(kept.size, 0);
});

test("an answer comes before it is whole", async () => {
  const { readable, writable } = new TransformStream();
  const writer = writable.getWriter();
  globalThis.fetch = async () => new Response(readable);
  let answer;
  const request = new Request(`${SITE}_run/12ab/a.wasm`);
  on.fetch({ request, respondWith: (response) => (answer = response), waitUntil() {} });
  writer.write(new TextEncoder().encode("begin"));
  const { value } = await (await answer).body.getReader().read();
  assert.equal(new TextDecoder().decode(value), "begin");
  globalThis.fetch = ask;
});

test("where a network leads elsewhere, nothing is kept", async (context) => {
  const login = Object.defineProperty(new Response("log in"), "redirected", { value: true });
  login.clone = () => login;
  context.mock.method(globalThis, "fetch", async () => login);
  await get("a.html");
  assert.equal(kept.size, 0);
});

test("what an older service worker kept is taken away if it was not compared or has left the site", async () => {
  isBuilt("_static/a.js", "a");
  others.push("index.html", "a.html", "b/index.html", "_images/a.webp");
  const stay = ["", "a.html", "a", "b/", "_images/a.webp", "_static/a.js?v=1"];
  const leave = ["gone.html", "_images/gone.webp", "_static/gone.js?v=1", "a.html?highlight=x"];
  for (const path of [...stay, ...leave]) kept.set(SITE + path, "");
  let done;
  on.install();
  on.activate({ waitUntil: (promise) => (done = promise) });
  await done;
  assert.deepEqual(deleted, [`canim ${SITE}`]);
  assert.deepEqual(
    [...kept.keys()],
    stay.map((path) => SITE + path),
  );
});

test("a missing page is not kept, and what is not of the site is left alone", async () => {
  assert.equal(await get("gone.html"), "");
  assert.equal(kept.size, 0);
  assert.equal(await get("a.html", { method: "POST" }), undefined);
  assert.equal(await get("film.mp4", { headers: { range: "bytes=0-" } }), undefined);
});

/** @param {string[]} addresses */
async function tell(addresses) {
  let all;
  on.message({ data: addresses, waitUntil: (promise) => (all = promise) });
  await all;
}

test("what the page had loaded before is kept too", async () => {
  network = { [`${SITE}a.html`]: page("a"), "https://other.org/b.html": page("b") };
  await tell([...Object.keys(network), `${SITE}gone.html`]);
  assert.deepEqual([...kept.keys()], [`${SITE}a.html`]);
});

test("what is kept already, or soon, is not loaded a second time", async (context) => {
  isBuilt("_run/12ab/a.whl", "a");
  network[`${SITE}_run/12ab/a.whl`] = "a";
  const asked = context.mock.method(globalThis, "fetch");
  const first = get("_run/12ab/a.whl");
  await new Promise((resolve) => setImmediate(resolve));
  await tell([`${SITE}_run/12ab/a.whl`]);
  await first;
  await tell([`${SITE}_run/12ab/a.whl`]);
  assert.equal(asked.mock.callCount(), 1);
});

test("an answer that came is shown though nothing can be kept", async (context) => {
  network = { [`${SITE}a.html?v=1`]: "a" };
  isBuilt("a.html", "a");
  const full = async () => Promise.reject(new DOMException("full", "QuotaExceededError"));
  const put = context.mock.method(cache, "put", full);
  assert.equal(await get("a.html?v=1"), "a");
  assert.equal(put.mock.callCount(), 1);
  context.mock.method(caches, "open", full);
  assert.equal(await get("a.html?v=1"), "a");
  assert.equal(await get("a.html?v=1", { cache: "reload" }), "a");
});
