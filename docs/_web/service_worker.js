// Keeps what was loaded, so that pages and Run work without the network too.
// What has a version in its address never changes, and comes from what is kept, if it is what the
// site was built with. All else comes from the network as long as there is one: a page is never
// older than the site.

import { hex } from "./hex.js";

/** @typedef {ServiceWorkerGlobalScope & typeof globalThis} Scope */
const worker = /** @type {Scope} */ (/** @type {unknown} */ (self));
const site = worker.registration.scope;
const NAME = `canim checked ${site}`;
const UNCHECKED = `canim ${site}`; // of older versions, which kept whatever came
const PAGE = /<html\b[^>]*\sdata-content_root=/; // so every page of the site begins
const PICTURE = /\.(gif|jpe?g|png|svg|webp)$/i;

/** @param {URL} url */
const path = (url) => `${url.origin}${url.pathname}`.slice(site.length);

/** @param {URL} url the folder of a version of Python, or "" */
const folder = (url) => path(url).match(/^_run\/\w+\//)?.[0] ?? "";

/** Whether it has a version in its address. @param {URL} url */
const isFixed = (url) => folder(url) !== "" || url.searchParams.has("v");

/** The address without what makes no other file of it. @param {URL} url */
function plain(url) {
  const version = url.searchParams.get("v");
  return url.origin + url.pathname + (version === null ? "" : `?v=${version}`);
}

/** @param {URL} url */
async function find(url) {
  try {
    return await (await caches.open(NAME)).match(plain(url));
  } catch {
    return undefined; // as if nothing was kept
  }
}

/** A network that wants a login, or a disk that is broken, answers too.
 *  @param {URL} url @param {Response} response */
async function isRight(url, response) {
  if (response.status !== 200 || response.redirected) return false;
  if (isFixed(url)) {
    const digest = await crypto.subtle.digest("SHA-256", await response.arrayBuffer());
    return RUN.hashes[path(url)] === hex(new Uint8Array(digest));
  }
  const type = response.headers.get("Content-Type") ?? "";
  if (/^text\/html\b/i.test(type)) return PAGE.test(await response.text());
  // Some servers have no name for the newer kinds of pictures.
  if (PICTURE.test(url.pathname)) return /^(image\/|application\/octet-stream)/i.test(type);
  return !/(\/|\.html)$/.test(url.pathname);
}

/** @type {Map<string, Promise<void>>} what is about to be kept */
const underway = new Map();

/** Keep it if it is right; if not, or without room, what was kept stays.
 *  @param {URL} url @param {Response} response */
function keep(url, response) {
  const keeping = put(url, response)
    .catch(() => {})
    .finally(() => underway.delete(plain(url)));
  underway.set(plain(url), keeping);
  return keeping;
}

/** @param {URL} url @param {Response} response */
async function put(url, response) {
  if (!(await isRight(url, response.clone()))) return;
  const cache = await caches.open(NAME);
  await cache.put(plain(url), response);
  for (const { url: kept } of await cache.keys()) {
    const other = new URL(kept);
    const same = folder(url) ? folder(other) !== "" : other.pathname === url.pathname;
    const older = folder(url) ? folder(other) !== folder(url) : kept !== plain(url);
    if (same && older) await cache.delete(kept);
  }
}

/** What the page has loaded without this worker. @param {URL} url */
async function keepLoaded(url) {
  await underway.get(plain(url));
  if (isFixed(url) && (await find(url))) return;
  await keep(url, await fetch(new Request(url), { cache: "force-cache" }));
}

/** Take away what is no longer in the site. */
async function prune() {
  const paths = new Set([...Object.keys(RUN.hashes), ...RUN.others]);
  const cache = await caches.open(NAME);
  for (const { url: kept } of await cache.keys()) {
    const url = new URL(kept);
    const file = path(url).replace(/(^|\/)$/, "$1index.html");
    const isThere = paths.has(file) || paths.has(`${file}.html`); // some servers hide the ending
    if (!isThere || kept !== plain(url)) await cache.delete(kept);
  }
}

/** @param {FetchEvent} event */
async function answer(event) {
  const { request } = event;
  const url = new URL(request.url);
  // Its right bytes may have come with a wrong policy: who wants to be sure asks the server.
  const isAnew = request.cache === "reload";
  const kept = isFixed(url) && !isAnew && (await find(url));
  if (kept) return kept;
  let response;
  try {
    response = await fetch(request);
  } catch (error) {
    const last = await find(url);
    if (last) return last;
    throw error;
  }
  // It is kept below, but perhaps not before it is asked for again.
  if (isFixed(url) && isAnew) await forget(url).catch(() => {});
  // The page need not wait for the end of it.
  event.waitUntil(keep(url, response.clone()));
  return response;
}

/** @param {URL} url */
async function forget(url) {
  await (await caches.open(NAME)).delete(plain(url));
}

worker.addEventListener("install", () => worker.skipWaiting());
worker.addEventListener("activate", (event) =>
  event.waitUntil(Promise.allSettled([worker.clients.claim(), caches.delete(UNCHECKED), prune()])),
);
worker.addEventListener("fetch", (event) => {
  const { method, url, headers } = event.request;
  if (method === "GET" && url.startsWith(site) && !headers.has("range")) event.respondWith(answer(event));
});
worker.addEventListener("message", (event) => {
  /** @type {string[]} */
  const loaded = event.data;
  const urls = loaded.filter((address) => address.startsWith(site)).map((address) => new URL(address));
  event.waitUntil(Promise.allSettled(urls.map(keepLoaded)));
});
