// What is said while Python loads, and when it does not: to the student, and what they can do.

import { script, site } from "./site.js";

/** @param {string} program */
export function packages(program) {
  return [...RUN.first, ...Object.keys(RUN.needs).filter((name) => new RegExp(RUN.needs[name]).test(program))];
}

/** How many MB a program loads. @param {string} program */
export function megabytes(program) {
  const bytes = ["first", ...packages(program)].map((name) => RUN.bytes[name] ?? 0);
  return Math.ceil(bytes.reduce((sum, more) => sum + more) / 1e6);
}

/** @param {string} program @param {number} done bytes */
export function progress(program, done) {
  const all = megabytes(program);
  const come = Math.min(Math.floor(done / 1e6), all);
  return come < all - 1 ? `Python is loading: ${come} of ${all} MB.` : "Python is starting …";
}

const ELSEWHERE = "On your own computer it runs all the same: press Download .py.";
/** @type {{[reason: string]: (file: string) => string}} */
const WORDS = {
  lost: () => "The connection was lost while Python was loading. When it is back, press Run again.",
  silent: () => "Python has stopped loading. Look at your connection to the network, then press Run again.",
  missing: (file) => `A file of Python is missing on the server. Press Run again in a few minutes. If that
    does not help, tell your teacher that ${file} is missing. ${ELSEWHERE}`,
  changed: (file) => `The server has sent a wrong file. If your network wants you to log in, do so, then
    press Run again. If that does not help, tell your teacher that ${file} is not the right file. ${ELSEWHERE}`,
  policy: () => `This site does not let your browser run Python. Tell your teacher. ${ELSEWHERE}`,
  memory: () => "There is not enough memory for Python. Close other tabs and programs, then press Run again.",
  start: () => "Python does not start. Press Run again. If that does not help, try another browser.",
  stopped: () => "Python has stopped. Press Run to begin again.",
  renewed: () => "This site has been renewed since you opened the page. Load the page again, then press Run.",
};

// What the policy of the server has forbidden to this page, which looks like a lost connection.
let isForbidden = false;
document.addEventListener("securitypolicyviolation", ({ blockedURI, disposition }) => {
  isForbidden ||= disposition === "enforce" && blockedURI.startsWith(site.href);
});

/** Return what to tell the student, and whether a newer page helps.
 *  @param {{reason: string, file: string}} failure @param {string} address of the worker's script */
export async function explain({ reason, file }, address) {
  if (["script", "lost"].includes(reason)) {
    const found = await look(address).then(
      ({ ok, headers }) =>
        ok ? (/javascript/.test(headers.get("Content-Type") ?? "") ? "start" : "changed") : "missing",
      () => "lost",
    );
    // Browsers do not say why a worker has no script.
    if (reason === "script") [reason, file] = [found, "worker.js"];
    // They tell of their policy a moment later.
    if (!isForbidden) await new Promise((resolve) => setTimeout(resolve, 100));
    if (isForbidden) reason = "policy";
  }
  if (["missing", "changed"].includes(reason) && (await isRenewed())) reason = "renewed";
  return { words: WORDS[reason](file).replace(/\s+/g, " "), isRenewed: reason === "renewed" };
}

/** Ask the server, not what the browser has kept. @param {string} address @param {number} [patience] */
async function look(address, patience = 5000) {
  // Where a browser cannot set a time, its own one holds.
  return fetch(address, { cache: "reload", signal: AbortSignal.timeout?.(patience) });
}

/** Let the browser keep what the server has by now. @param {string} address */
export async function askAnew(address) {
  await look(address, 15_000)
    .then((answer) => answer.arrayBuffer())
    .catch(() => {});
}

/** Whether the site has another script for this page by now. */
async function isRenewed() {
  try {
    const page = await (await look(location.href)).text();
    const newest = /run\.js(\?v=\w+)/.exec(page)?.[1];
    return newest !== undefined && newest !== new URL(script.src).search;
  } catch {
    return false;
  }
}
