// The service worker with a cache and a network made up for it: node --test docs/_web
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { beforeEach, test } from "node:test";

const SITE = "https://example.org/course/";
/** @type {Map<string, string>} */
const kept = new Map();
/** @type {{[kind: string]: (event: any) => void}} */
const on = {};
/** @type {{[address: string]: string} | null} */
let network;
/** @type {{[path: string]: string}} what the site was built with */
const hashes = {};
/** @type {string[]} */
const deleted = [];

const isBuilt = (/** @type {string} */ path, /** @type {string} */ text) => {
  hashes[path] = createHash("sha256").update(text).digest("hex");
};

const cache = {
  put: async (request, response) => kept.set(request.url, await response.text()),
  delete: async (url) => kept.delete(url),
  keys: async () => [...kept.keys()].map((url) => ({ url })),
  match: async (request, { ignoreSearch = false } = {}) => {
    const plain = (/** @type {string} */ url) => (ignoreSearch ? url.split("?")[0] : url);
    const found = [...kept.keys()].find((url) => plain(url) === plain(request.url));
    return found && new Response(kept.get(found));
  },
};
Object.assign(globalThis, {
  self: globalThis,
  registration: { scope: SITE },
  RUN: { hashes },
  skipWaiting() {},
  clients: { claim: async () => {} },
  caches: { open: async () => cache, delete: async (name) => deleted.push(name) },
  addEventListener: (kind, listener) => {
    on[kind] = listener;
  },
  fetch: async ({ url }) => {
    if (!network) throw new TypeError("no network");
    return url in network ? new Response(network[url]) : new Response("", { status: 404 });
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
  network[`${SITE}a.html`] = "old";
  assert.equal(await get("a.html"), "old");
  network[`${SITE}a.html`] = "new";
  assert.equal(await get("a.html"), "new");
  network = null;
  assert.equal(await get("a.html"), "new");
  assert.equal(await get("a.html?highlight=x"), "new");
  await assert.rejects(get("b.html"), /no network/);
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

test("what an older service worker kept, right or wrong, is taken away", async () => {
  let done;
  on.install();
  on.activate({ waitUntil: (promise) => (done = promise) });
  await done;
  assert.deepEqual(deleted, [`canim ${SITE}`]);
});

test("a missing page is not kept, and what is not of the site is left alone", async () => {
  assert.equal(await get("gone.html"), "");
  assert.equal(kept.size, 0);
  assert.equal(await get("a.html", { method: "POST" }), undefined);
  assert.equal(await get("film.mp4", { headers: { range: "bytes=0-" } }), undefined);
});

test("what the page had loaded before is kept too", async () => {
  network = { [`${SITE}a.html`]: "a", "https://other.org/b.html": "b" };
  let all;
  on.message({ data: [...Object.keys(network), `${SITE}gone.html`], waitUntil: (promise) => (all = promise) });
  await all;
  assert.deepEqual([...kept.keys()], [`${SITE}a.html`]);
});

test("a page is shown though nothing can be kept", async (context) => {
  network = { [`${SITE}a.html?v=1`]: "a" };
  isBuilt("a.html", "a");
  const full = async () => Promise.reject(new DOMException("full", "QuotaExceededError"));
  const put = context.mock.method(cache, "put", full);
  assert.equal(await get("a.html?v=1"), "a");
  assert.equal(put.mock.callCount(), 1);
  context.mock.method(caches, "open", full);
  assert.equal(await get("a.html?v=1"), "a");
});
