// Pages and Run work without the network once they were loaded: see service_worker.js.

const PATIENCE = 1000; // milliseconds

/** Begin to keep what is loaded; what the page has loaded already, too. A browser that cannot,
 *  or is slow to begin, goes on without.
 *  @param {URL} site its root
 *  @param {URL} editor on its way perhaps: it is neither loaded yet nor comes through the worker */
export async function keepOffline(site, editor) {
  await Promise.race([begin(site), new Promise((resolve) => setTimeout(resolve, PATIENCE))]);
  const loaded = performance.getEntriesByType("resource").map((entry) => entry.name);
  keepLoaded([location.href.split("#")[0], editor.href, ...loaded]);
}

/** Resolve when all that is loaded comes through the service worker, or cannot.
 *  @param {URL} site */
async function begin(site) {
  try {
    const container = navigator.serviceWorker;
    const registered = container.register(new URL("service_worker.js", site));
    const begun = new Promise((resolve) => container.addEventListener("controllerchange", resolve, { once: true }));
    await registered;
    if (!container.controller) await begun;
  } catch {
    // an old browser, an address that is not secure, or one that forbids it
  }
}

/** Keep also what was loaded without the service worker, once there is one, however late.
 *  @param {string[]} addresses */
export async function keepLoaded(addresses) {
  try {
    const { active } = await navigator.serviceWorker.ready;
    active?.postMessage(addresses);
  } catch {
    // as above
  }
}
