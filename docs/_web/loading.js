// What is said while Python loads, and when it does not: to the student, and what they can do.

import { script } from "./site.js";

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
  silent: () => "Nothing more of Python is coming. Look at your connection to the network, then press Run again.",
  missing: (file) => `A part of Python cannot be had now. Press Run again in a few minutes. If it
    stays so, tell your teacher that ${file} is missing. ${ELSEWHERE}`,
  changed: (file) => `What has come is not Python. If your network wants you to log in, do so, then
    press Run again. If it stays so, tell your teacher that ${file} is not what it must be. ${ELSEWHERE}`,
  policy: () => `This site does not let your browser run Python. Tell your teacher. ${ELSEWHERE}`,
  memory: () => "There is not enough memory for Python. Close other tabs and programs, then press Run again.",
  start: () => "Python does not start. Press Run again. If it stays so, try another browser.",
  stopped: () => "Python has stopped. Press Run to begin again.",
  renewed: () => "This site has been renewed since you opened the page. Load the page again, then press Run.",
};

/** Return what to tell the student, and whether a newer page helps.
 *  @param {{reason: string, file: string}} failure @param {string} address of the worker's script */
export async function explain({ reason, file }, address) {
  if (reason === "script") {
    // Browsers do not say why a worker has no script.
    file = "worker.js";
    reason = await look(address).then(
      ({ ok, headers }) =>
        ok ? (/javascript/.test(headers.get("Content-Type") ?? "") ? "start" : "changed") : "missing",
      () => "lost",
    );
  }
  if (["missing", "changed"].includes(reason) && (await isRenewed())) reason = "renewed";
  return { words: WORDS[reason](file).replace(/\s+/g, " "), isRenewed: reason === "renewed" };
}

/** Ask the server, not what the browser has kept. @param {string} address @param {number} [patience] */
function look(address, patience = 5000) {
  return fetch(address, { cache: "reload", signal: AbortSignal.timeout(patience) });
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
