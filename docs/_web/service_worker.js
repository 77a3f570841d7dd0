// Keeps what was loaded, so that pages and Run work without the network too.
// What has a version in its address never changes, and comes from what is kept, if it is what the
// site was built with. All else comes from the network as long as there is one: a page is never
// older than the site.

/** @typedef {ServiceWorkerGlobalScope & typeof globalThis} Scope */
const worker = /** @type {Scope} */ (/** @type {unknown} */ (self));
const site = worker.registration.scope;
const NAME = `canim checked ${site}`;
const UNCHECKED = `canim ${site}`; // of older versions, which kept whatever came

/** @param {URL} url */
const path = (url) => `${url.origin}${url.pathname}`.slice(site.length);

/** @param {URL} url the folder of a version of Python, or "" */
const folder = (url) => path(url).match(/^_run\/\w+\//)?.[0] ?? "";

/** Whether it has a version in its address. @param {URL} url */
const isFixed = (url) => folder(url) !== "" || url.searchParams.has("v");

/** A network that wants a login, or a disk that is broken, answers too.
 *  @param {URL} url @param {Response} response */
async function isRight(url, response) {
  if (response.status !== 200 || response.redirected) return false;
  if (!isFixed(url)) return true;
  const digest = await crypto.subtle.digest("SHA-256", await response.arrayBuffer());
  const hash = [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  return RUN.hashes[path(url)] === hash;
}

/** @param {Request} request @param {Response} response */
async function keep(request, response) {
  const url = new URL(request.url);
  if (!(await isRight(url, response.clone()))) return;
  const cache = await caches.open(NAME);
  await cache.put(request, response);
  for (const { url: kept } of await cache.keys()) {
    const other = new URL(kept);
    const same = folder(url) ? folder(other) !== "" : other.pathname === url.pathname;
    const older = folder(url) ? folder(other) !== folder(url) : other.search !== url.search;
    if (same && older) await cache.delete(kept);
  }
}

/** @param {FetchEvent} event */
async function answer(event) {
  const { request } = event;
  const fixed = isFixed(new URL(request.url));
  const find = async () => (await caches.open(NAME)).match(request, { ignoreSearch: !fixed });
  // Its right bytes may have come with a wrong policy: who wants to be sure asks the server.
  const kept = fixed && request.cache !== "reload" && (await find().catch(() => {}));
  if (kept) return kept;
  try {
    const response = await fetch(request);
    // It is kept below, but perhaps not before it is asked for again.
    if (fixed && request.cache === "reload") await (await caches.open(NAME)).delete(request.url).catch(() => {});
    // The page need not wait for the end of it; and without room it is shown all the same.
    event.waitUntil(keep(request, response.clone()).catch(() => {}));
    return response;
  } catch (error) {
    const last = await find().catch(() => {});
    if (last) return last;
    throw error;
  }
}

worker.addEventListener("install", () => worker.skipWaiting());
worker.addEventListener("activate", (event) =>
  event.waitUntil(Promise.all([worker.clients.claim(), caches.delete(UNCHECKED)])),
);
worker.addEventListener("fetch", (event) => {
  const { method, url, headers } = event.request;
  if (method === "GET" && url.startsWith(site) && !headers.has("range")) event.respondWith(answer(event));
});
worker.addEventListener("message", (event) => {
  /** @type {string[]} */
  const loaded = event.data;
  const requests = loaded.filter((address) => address.startsWith(site)).map((address) => new Request(address));
  const kept = requests.map((request) => fetch(request, { cache: "force-cache" }).then((got) => keep(request, got)));
  event.waitUntil(Promise.allSettled(kept));
});
