// The files of Python on their way from the site: counted as they come, and compared with what
// they must be. Pyodide asks for them with fetch, waits without end, and reads whatever comes.

import { sha256 } from "@noble/hashes/sha2.js";
import { hex } from "./hex.js";

/** Why Python cannot be had: the reason, for loading.js, and the file it is about. */
export class Undelivered extends Error {
  /** @param {string} reason @param {string} [file] */
  constructor(reason, file = "") {
    super(`${reason} ${file}`);
    this.reason = reason;
    this.file = file;
  }
}

/** @param {Uint8Array<ArrayBuffer>} bytes */
async function digest(bytes) {
  // Browsers have it only where the address is secure; ours takes four times as long.
  const hash = crypto.subtle ? new Uint8Array(await crypto.subtle.digest("SHA-256", bytes)) : sha256(bytes);
  return hex(hash);
}

export class Delivery {
  /** bytes that have come, as a server that compresses sends them */
  done = 0;
  awaited = 0;
  /** @type {Map<string, Promise<void>>} */
  #checks = new Map();
  /** @type {(reason: Undelivered) => void} */
  #reject = () => {};
  /** @type {Promise<never>} never ends well: it is raced with what needs the files */
  failed = new Promise((_, reject) => {
    this.#reject = reject;
  });

  /** @param {typeof RUN.files} files @param {typeof fetch} ask
   *  @param {string[]} doubtful files that the browser may hold wrong: they come from the server */
  constructor(files, ask, doubtful = []) {
    this.files = files;
    this.ask = ask;
    this.doubtful = doubtful;
    this.failed.catch(() => {});
  }

  /** @param {string} reason @param {string} [file] @returns {never} */
  fail(reason, file) {
    const failure = new Undelivered(reason, file);
    this.#reject(failure);
    throw failure;
  }

  /** Resolve when all that was asked for has come, and was right. */
  async checked() {
    await Promise.race([this.failed, Promise.all(this.#checks.values())]);
  }

  /** The same for one file. @param {string} name */
  whole(name) {
    return this.#checks.get(name);
  }

  /** The names of all that was asked for. */
  get names() {
    return [...this.#checks.keys()];
  }

  /** As the browser's own. @type {typeof fetch} */
  fetch = async (input, options) => {
    const address = String(input instanceof Request ? input.url : input);
    const name = new URL(address).pathname.split("/").pop() ?? "";
    if (!(name in this.files)) return this.ask(input, options);
    const cache = this.doubtful.includes(name) ? "reload" : "default";
    this.awaited++;
    // Without Pyodide's own hash: browsers hold a file back until it is compared.
    const response = await this.ask(address, { cache }).catch(() => this.fail("lost", name));
    if (!response.ok) this.fail("missing", name);
    const check = this.#check(name, response.clone());
    check.catch(() => {});
    this.#checks.set(name, check);
    const isWasm = name.endsWith(".wasm") && response.headers.get("Content-Type") !== "application/wasm";
    return isWasm ? new Response(response.body, { headers: { "Content-Type": "application/wasm" } }) : response;
  };

  /** @param {string} name @param {Response} response */
  async #check(name, response) {
    const [size, travels, hash] = this.files[name];
    const content = new Uint8Array(size);
    let length = 0;
    const body = /** @type {ReadableStream<Uint8Array>} */ (response.body).getReader();
    for (;;) {
      const { done, value } = await body.read().catch(() => this.fail("lost", name));
      if (done) break;
      if (length + value.length > size) this.fail("changed", name);
      content.set(value, length);
      length += value.length;
      this.done += (value.length / size) * travels;
    }
    if (length < size || (await digest(content)) !== hash) this.fail("changed", name);
    this.awaited--;
  }
}
