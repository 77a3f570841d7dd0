// The page's side of the worker: one Python for the page, ended and made anew by Stop.

import { keepLoaded } from "./offline.js";

/**
 * What the worker is to do.
 * @typedef {{kind: "load" | "run", packages: string[], code: string, name: string,
 *   answers: string, files: {name: string, bytes: Uint8Array}[]}} Order
 * What the worker tells: the kind, files, and what belongs to this kind.
 * @typedef {{kind: string, blobs: Uint8Array<ArrayBuffer>[], [content: string]: any}} Message
 */

const BEAT = 500; // milliseconds; so often the worker is asked how far it is
/** Milliseconds of silence that are borne, by what is waited for. With a beat, and the time to
 *  say it, those of the network are less than 20 s.
 *  @type {{[waits: string]: number}} */
const PATIENCE = { silent: 19_000, start: 60_000 };

export class Python {
  /** @type {Worker | undefined} */
  #worker;
  /** @type {ReturnType<typeof setInterval> | undefined} */
  #beat;
  #unanswered = 0; // orders
  #isAsked = false;
  #isLate = false; // its answer: it was busy
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
      let worker;
      try {
        worker = new Worker(this.address, { type: "module" });
      } catch (error) {
        return this.#fail("script", String(error)); // some browsers throw where a policy forbids it
      }
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
    this.#isLate = this.#isAsked;
    if (this.#isLate) return; // it is busy, which is no silence
    this.#isAsked = true;
    this.#worker?.postMessage({ kind: "ask" });
  }

  /** @param {string} reason for which it waits, given if it takes too long */
  #wait(reason) {
    this.#silence += BEAT;
    if (this.#silence >= PATIENCE[reason]) this.#fail(reason);
  }

  /** @param {string} reason @param {string} [text] */
  #fail(reason, text = "") {
    this.#pass({ kind: "failed", reason, file: "", text, blobs: [] });
  }

  /** @param {Message} message */
  #hear(message) {
    const { kind, done, waits } = message;
    this.#isHeard = true;
    if (kind === "loaded") return void keepLoaded(message.addresses);
    if (kind === "progress") {
      this.#isAsked = false;
      const hasWorked = waits === "start" && this.#isLate;
      if (done !== this.#done || !waits || hasWorked) this.#silence = 0;
      else this.#wait(waits);
      this.#done = done;
      if (!waits) return;
    }
    if (kind === "ready" || kind === "begin") this.isReady = true;
    if ((kind === "ready" || kind === "end") && --this.#unanswered === 0) this.#rest();
    if (kind === "failed" && message.file) this.#doubtful.push(message.file);
    this.#pass(message);
  }

  /** @param {Message} message */
  #pass(message) {
    // What the reader is told is not the cause, which a maintainer wants to know.
    if (message.kind === "failed") console.warn(`Run here: ${message.reason} ${message.file}`, message.text);
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
