// Where this script is, and so the site. It must be asked while the script begins.

export const script = /** @type {HTMLScriptElement} */ (document.currentScript);
export const site = new URL("../", script.src);
