// The page's side of the worker: one Python for the page, ended and made anew by Stop.

/**
 * What the worker is to do.
 * @typedef {{kind: "load" | "run", packages: string[], code: string, name: string,
 *   answers: string, files: {name: string, bytes: Uint8Array}[]}} Order
 * What the worker tells: the kind, files, and what belongs to this kind.
 * @typedef {{kind: string, blobs: Uint8Array<ArrayBuffer>[], [content: string]: any}} Message
 */

const BEAT = 500; // milliseconds; so often the worker is asked how far it is
const PATIENCE = 19_000; // of silence; with a beat, and the time to say it, less than 20 s

export class Python {
  /** @type {Worker | undefined} */
  #worker;
  /** @type {ReturnType<typeof setInterval> | undefined} */
  #beat;
  #unanswered = 0; // orders
  #isAsked = false;
  #isHeard = false;
  #silence = 0;
  #done = 0;
  /** @type {string[]} */
  #doubtful = [];

  /** @param {string} address of the worker's script
   *  @param {(message: Message) => void} tell */
  constructor(address, tell) {
    this.address = address;
    this.tell = tell;
  }

  isReady = false;

  get hasBegun() {
    return this.#worker !== undefined;
  }

  /** @param {Order} order */
  send(order) {
    if (!this.#worker) {
      const worker = new Worker(this.address, { type: "module" });
      // What an ended worker still had to say is not told.
      worker.onmessage = ({ data }) => worker === this.#worker && this.#hear(data);
      worker.onerror = (event) =>
        worker === this.#worker && this.#fail(this.#isHeard ? "stopped" : "script", event.message);
      this.#worker = worker;
    }
    this.#worker.postMessage({ ...order, doubtful: this.#doubtful });
    this.#unanswered++;
    this.#silence = 0;
    this.#beat ??= setInterval(() => this.#ask(), BEAT);
  }

  #ask() {
    if (!this.#isHeard) this.#wait("silent");
    if (this.#isAsked) return; // it is busy, which is no silence
    this.#isAsked = true;
    this.#worker?.postMessage({ kind: "ask" });
  }

  /** @param {string} reason that is given if it takes too long */
  #wait(reason) {
    this.#silence += BEAT;
    if (this.#silence >= PATIENCE) this.#fail(reason);
  }

  /** @param {string} reason @param {string} [text] */
  #fail(reason, text = "") {
    this.tell({ kind: "failed", reason, file: "", text, blobs: [] });
  }

  /** @param {Message} message */
  #hear(message) {
    const { kind, done, waits } = message;
    this.#isHeard = true;
    if (kind === "progress") {
      this.#isAsked = false;
      if (done !== this.#done || !waits) this.#silence = 0;
      else this.#wait(waits);
      this.#done = done;
      if (!waits) return;
    }
    if (kind === "ready" || kind === "begin") this.isReady = true;
    if ((kind === "ready" || kind === "end") && --this.#unanswered === 0) this.#rest();
    if (kind === "failed" && message.file) this.#doubtful.push(message.file);
    this.tell(message);
  }

  #rest() {
    clearInterval(this.#beat);
    this.#beat = undefined;
  }

  /** End what runs, whatever it does. */
  end() {
    this.#rest();
    this.#worker?.terminate();
    this.#worker = undefined;
    this.#unanswered = this.#silence = this.#done = 0;
    this.isReady = this.#isAsked = this.#isHeard = false;
  }
}
