// Pages and Run work without the network once they were loaded: see service_worker.js.

/** Begin to keep what is loaded; what the page has loaded already, too. A browser that cannot,
 *  or is slow to begin, goes on without.
 *  @param {URL} site its root
 *  @param {URL} editor on its way perhaps: it is neither loaded yet nor comes through the worker */
export async function keepOffline(site, editor) {
  const container = navigator.serviceWorker;
  if (!container) return; // an old browser, or an address that is not secure
  const begun = container.controller
    ? Promise.resolve()
    : new Promise((resolve) => container.addEventListener("controllerchange", resolve, { once: true }));
  const loaded = performance.getEntriesByType("resource").map((entry) => entry.name);
  const registered = container
    .register(new URL("service_worker.js", site))
    .then(() => begun)
    .then(() => container.controller?.postMessage([location.href.split("#")[0], editor.href, ...loaded]))
    .catch(() => {});
  await Promise.race([registered, new Promise((resolve) => setTimeout(resolve, 1000))]);
}
