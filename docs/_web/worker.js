// The Python of a page: it is loaded, and runs programs, in this worker, so that the page
// stays alive and an endless loop can be ended.

import { loadPyodide } from "pyodide";
import program from "./run_here.py";

/** @typedef {import("./python.js").Order} Order */

const silent = { messageCallback() {}, errorCallback() {} };

/** @param {string} kind @param {object} [content] @param {Uint8Array[]} [blobs] */
function post(kind, content = {}, blobs = []) {
  self.postMessage({ kind, ...content, blobs });
}

/** @param {string[]} packages */
async function load(packages) {
  const indexURL = new URL(".", self.location.href).href;
  const pyodide = await loadPyodide({ indexURL, packages, env: RUN.env, stderr() {} });
  pyodide.runPython("import os; os.makedirs('/home/student'); os.chdir('/home/student')");
  const python = pyodide.toPy({ __name__: "run_here" });
  pyodide.runPython(program, { globals: python });
  python.get("begin")((/** @type {string} */ kind, /** @type {string} */ content, /** @type {any} */ blobs) =>
    post(kind, JSON.parse(content), blobs.toJs()),
  );
  return { pyodide, python };
}

/** @type {ReturnType<typeof load> | undefined} */
let loaded;

/** @param {Order} order */
async function obey(order) {
  loaded ??= load(order.packages);
  const { pyodide, python } = await loaded;
  if (order.kind === "load") return post("ready");
  await pyodide.loadPackage(order.packages, silent); // the program may ask for more by now
  for (const { name, bytes } of order.files) python.get("keep_file")(name, pyodide.toPy(bytes));
  await pyodide.loadPackagesFromImports(order.code, silent).catch(() => []); // not if it is not Python
  const run = (/** @type {boolean} */ last) => python.get("run")(order.code, order.name, order.answers, last);
  const missing = run(false);
  if (missing) {
    // Something imports it that we cannot see in the program's text.
    await pyodide.loadPackagesFromImports(`import ${missing}`, silent).catch(() => []);
    run(true);
  }
}

let orders = Promise.resolve();
self.onmessage = ({ data }) => {
  orders = orders.then(() => obey(data)).catch((error) => post("failed", { text: String(error) }));
};
