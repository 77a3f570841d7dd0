// What is kept in the reader's browser, and nowhere else.

const PREFIX = "canim ";

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
    if (value === null) localStorage.removeItem(PREFIX + key);
    else localStorage.setItem(PREFIX + key, JSON.stringify(value));
    return true;
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
