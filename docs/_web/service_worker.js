// Keeps what was loaded, so that pages and Run work without the network too.
// What has a version in its address never changes, and comes from what is kept. All else comes
// from the network as long as there is one: a page is never older than the site.

/** @typedef {ServiceWorkerGlobalScope & typeof globalThis} Scope */
const worker = /** @type {Scope} */ (/** @type {unknown} */ (self));
const site = worker.registration.scope;
const NAME = `canim ${site}`;

/** @param {URL} url the folder of a version of Python, or "" */
const folder = (url) => url.href.slice(site.length).match(/^_run\/\w+\//)?.[0] ?? "";

/** @param {Request} request @param {Response} response */
async function keep(request, response) {
  if (response.status !== 200) return;
  const cache = await caches.open(NAME);
  await cache.put(request, response);
  const url = new URL(request.url);
  for (const { url: kept } of await cache.keys()) {
    const other = new URL(kept);
    const same = folder(url) ? folder(other) !== "" : other.pathname === url.pathname;
    const older = folder(url) ? folder(other) !== folder(url) : other.search !== url.search;
    if (same && older) await cache.delete(kept);
  }
}

/** @param {FetchEvent} event */
async function answer({ request }) {
  const url = new URL(request.url);
  const fixed = folder(url) !== "" || url.searchParams.has("v");
  const find = async () => (await caches.open(NAME)).match(request, { ignoreSearch: !fixed });
  const kept = fixed && (await find().catch(() => {}));
  if (kept) return kept;
  try {
    const response = await fetch(request);
    await keep(request, response.clone()).catch(() => {}); // without room the page is shown all the same
    return response;
  } catch (error) {
    const last = await find().catch(() => {});
    if (last) return last;
    throw error;
  }
}

worker.addEventListener("install", () => worker.skipWaiting());
worker.addEventListener("activate", (event) => event.waitUntil(worker.clients.claim()));
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
