// What is kept in the reader's browser, and nowhere else. Each copy of the site has its own:
// browsers share what they keep among all the sites at an origin.

import { site } from "./site.js";

const PREFIX = `canim ${site.pathname} `;
const BEFORE = /^canim (?!\/)/; // keys without the site, of older versions

/** @param {string | null} text @returns {any} */
function parse(text) {
  return JSON.parse(text ?? "null");
}

/** @param {string} key @returns {any} */
export function recall(key) {
  try {
    return parse(localStorage.getItem(PREFIX + key));
  } catch {
    return null;
  }
}

/** @param {string} key @param {any} value @returns {boolean} whether the browser keeps it */
export function keep(key, value) {
  try {
    const text = JSON.stringify(value);
    if (value === null) localStorage.removeItem(PREFIX + key);
    else localStorage.setItem(PREFIX + key, text);
    // Where nothing can be kept, page_head.py puts something in its place that never fails.
    return !("isForgetful" in localStorage) && (value === null || localStorage.getItem(PREFIX + key) === text);
  } catch {
    return false;
  }
}

/** Tell when another tab has changed what is kept, and what that has replaced.
 *  @param {string} key @param {(value: any, replaced: any) => void} changed */
export function watch(key, changed) {
  window.addEventListener("storage", (event) => {
    if (event.key === PREFIX + key) changed(recall(key), parse(event.oldValue));
  });
}

/** Let this site have what an older version kept, unless it has its own by now. */
export function carryOver() {
  try {
    for (const old of Object.keys(localStorage).filter((key) => BEFORE.test(key))) {
      const key = old.replace(BEFORE, () => PREFIX);
      const text = /** @type {string} */ (localStorage.getItem(old));
      if (localStorage.getItem(key) === null) localStorage.setItem(key, text);
      if (localStorage.getItem(key) !== null) localStorage.removeItem(old);
    }
  } catch {
    // Nothing is kept at all, or there is no room: what was kept stays where it is.
  }
}
