// The Python of a page: it is loaded, and runs programs, in this worker, so that the page
// stays alive and an endless loop can be ended.

import { loadPyodide } from "pyodide";
import { Delivery, Undelivered } from "./delivery.js";
import program from "./run_here.py";

/** @typedef {import("./python.js").Order} Order */

const SCRIPT = "pyodide.asm.js";
const EMPTY = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0); // the smallest WebAssembly
const silent = { messageCallback() {}, errorCallback() {} };
const fetch = self.fetch.bind(self);
const instantiateStreaming = WebAssembly.instantiateStreaming;

/** @param {string} kind @param {object} [content] @param {Uint8Array[]} [blobs] */
function post(kind, content = {}, blobs = []) {
  self.postMessage({ kind, ...content, blobs });
}

export class Interpreter {
  /** @type {ReturnType<typeof this.load> | undefined} */
  #loaded;
  #isReady = false;
  #told = 0; // files
  #orders = Promise.resolve();

  /** @param {string[]} doubtful files that the browser may hold wrong */
  constructor(doubtful) {
    const delivery = new Delivery(RUN.files, fetch, doubtful);
    this.delivery = delivery;
    self.fetch = delivery.fetch;
    // Pyodide writes what goes wrong here into the console, and goes on waiting.
    WebAssembly.instantiateStreaming = async (source, imports) => {
      try {
        return await instantiateStreaming(source, imports);
      } catch (error) {
        await delivery.checked(); // if the file is wrong, this is the reason
        return delivery.fail(this.#reason(error));
      }
    };
  }

  /** @param {any} error */
  #reason(error) {
    if (error instanceof Undelivered) return error.reason;
    if (this.#isReady) return "stopped";
    return error instanceof RangeError || /MemoryError|out of memory/i.test(error) ? "memory" : "start";
  }

  /** @param {string[]} packages */
  async load(packages) {
    const indexURL = new URL(".", self.location.href).href;
    try {
      new WebAssembly.Module(EMPTY);
    } catch {
      this.delivery.fail("policy");
    }
    // Pyodide would import its script unseen; so it is fetched first, beside the other files.
    Object.assign(self, {
      _createPyodideModule: async (/** @type {object} */ settings) => {
        await (await self.fetch(indexURL + SCRIPT)).arrayBuffer();
        await this.delivery.whole(SCRIPT);
        await import(indexURL + SCRIPT);
        return /** @type {any} */ (self)._createPyodideModule(settings);
      },
    });
    const pyodide = await loadPyodide({ indexURL, packages, env: RUN.env, stderr() {} });
    await this.delivery.checked(); // Pyodide goes on without a package that does not come
    pyodide.runPython("import os; os.makedirs('/home/student'); os.chdir('/home/student')");
    const python = pyodide.toPy({ __name__: "run_here" });
    pyodide.runPython(program, { globals: python });
    python.get("begin")((/** @type {string} */ kind, /** @type {string} */ content, /** @type {any} */ blobs) =>
      post(kind, JSON.parse(content), blobs.toJs()),
    );
    this.#isReady = true;
    return { pyodide, python };
  }

  /** @param {Order} order */
  async #obey(order) {
    this.#loaded ??= this.load(order.packages);
    const { pyodide, python } = await this.#loaded;
    if (order.kind === "load") return post("ready");
    const loadImports = async (/** @type {string} */ code) => {
      await pyodide.loadPackagesFromImports(code, silent).catch(() => []); // not if it is not Python
      await this.delivery.checked();
    };
    await pyodide.loadPackage(order.packages, silent); // the program may ask for more by now
    for (const { name, bytes } of order.files) python.get("keep_file")(name, pyodide.toPy(bytes));
    await loadImports(order.code);
    const run = (/** @type {boolean} */ last) => python.get("run")(order.code, order.name, order.answers, last);
    const missing = run(false);
    if (missing) {
      // Something imports it that we cannot see in the program's text.
      await loadImports(`import ${missing}`);
      run(true);
    }
  }

  /** Do one order after the other; what goes wrong with a file ends them all. @param {Order} order */
  obey(order) {
    this.#orders = this.#orders
      .then(() => Promise.race([this.#obey(order), this.delivery.failed]))
      .then(() => this.#tellLoaded())
      .catch((error) => post("failed", { reason: this.#reason(error), file: error.file ?? "", text: String(error) }));
  }

  /** Tell the addresses of Python's files, for those that did not come through the service worker. */
  #tellLoaded() {
    const { names } = this.delivery;
    if (names.length === this.#told) return;
    this.#told = names.length;
    const { href } = self.location;
    post("loaded", { addresses: [href, ...names.map((name) => new URL(name, href).href)] });
  }

  /** Tell what has come, and what there is still to wait for. */
  tellProgress() {
    const waits = this.delivery.awaited ? "silent" : this.#isReady ? "" : "start";
    post("progress", { done: this.delivery.done, waits });
  }
}

/** @type {Interpreter | undefined} */
let interpreter;
self.onmessage = ({ data }) => {
  interpreter ??= new Interpreter(data.doubtful);
  if (data.kind === "ask") interpreter.tellProgress();
  else interpreter.obey(data);
};
