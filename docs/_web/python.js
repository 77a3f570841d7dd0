// The page's side of the worker: one Python for the page, ended and made anew by Stop.

/**
 * What the worker is to do.
 * @typedef {{kind: "load" | "run", packages: string[], code: string, name: string,
 *   answers: string, files: {name: string, bytes: Uint8Array}[]}} Order
 * What the worker tells: the kind, files, and what belongs to this kind.
 * @typedef {{kind: string, blobs: Uint8Array<ArrayBuffer>[], [content: string]: any}} Message
 */

export class Python {
  /** @type {Worker | undefined} */
  #worker;

  /** @param {string} address of the worker's script
   *  @param {(message: Message) => void} tell */
  constructor(address, tell) {
    this.address = address;
    this.tell = tell;
  }

  isReady = false;

  /** @param {Order} order */
  send(order) {
    if (!this.#worker) {
      const worker = new Worker(this.address, { type: "module" });
      // What an ended worker still had to say is not told.
      worker.onmessage = ({ data }) => {
        if (worker !== this.#worker) return;
        if (data.kind === "ready" || data.kind === "begin") this.isReady = true;
        this.tell(data);
      };
      worker.onerror = (event) =>
        worker === this.#worker && this.tell({ kind: "failed", text: event.message ?? "", blobs: [] });
      this.#worker = worker;
    }
    this.#worker.postMessage(order);
  }

  /** End what runs, whatever it does. */
  end() {
    this.#worker?.terminate();
    this.#worker = undefined;
    this.isReady = false;
  }
}
