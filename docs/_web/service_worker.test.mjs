// The service worker with a cache and a network made up for it: node --test docs/_web
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

const SITE = "https://example.org/course/";
/** @type {Map<string, string>} */
const kept = new Map();
/** @type {{[kind: string]: (event: any) => void}} */
const on = {};
/** @type {{[address: string]: string} | null} */
let network;

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
  caches: { open: async () => cache },
  addEventListener: (kind, listener) => {
    on[kind] = listener;
  },
  fetch: async ({ url }) => {
    if (!network) throw new TypeError("no network");
    return url in network ? new Response(network[url]) : new Response("", { status: 404 });
  },
});
await import("./service_worker.js");

async function get(path, options = {}) {
  let answer;
  const request = new Request(SITE + path, options);
  on.fetch({ request, respondWith: (response) => (answer = response) });
  const text = (await answer)?.text();
  await new Promise((resolve) => setTimeout(resolve)); // what is kept is kept after the answer
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
    assert.equal(await get(path), "first");
    network[SITE + path] = "never";
    assert.equal(await get(path), "first");
  }
});

test("a new version takes the place of the old one", async () => {
  for (const path of ["_run/1/a.whl", "_run/1/b.whl", "_static/run.js?v=1", "_run/2/a.whl", "_static/run.js?v=2"]) {
    network[SITE + path] = path;
    await get(path);
  }
  assert.deepEqual([...kept.keys()].sort(), [`${SITE}_run/2/a.whl`, `${SITE}_static/run.js?v=2`]);
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
  const full = async () => Promise.reject(new DOMException("full", "QuotaExceededError"));
  const put = context.mock.method(cache, "put", full);
  assert.equal(await get("a.html?v=1"), "a");
  assert.equal(put.mock.callCount(), 1);
  context.mock.method(caches, "open", full);
  assert.equal(await get("a.html?v=1"), "a");
});
