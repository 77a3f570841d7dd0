// A page for the tests of its scripts, from happy-dom: its names become those of node. Each
// file of tests has a process, and so a page, of its own.

import { Window } from "happy-dom";

export const SITE = "https://example.org/course/";

const page = new Window({ url: `${SITE}gallery/interpolation/task_1_1_plot_hermite_basis.html` });
const OBJECTS = ["document", "location", "navigator", "localStorage", "sessionStorage", "customElements"];
const FUNCTIONS = ["matchMedia", "addEventListener", "removeEventListener", "dispatchEvent", "getComputedStyle"];
const CLASSES = Object.getOwnPropertyNames(page).filter((name) =>
  /^(HTML\w*Element|Element|Node|\w*Event)$/.test(name),
);
const OTHERS = [
  "MutationObserver",
  "ResizeObserver",
  "IntersectionObserver",
  "Range",
  "Selection",
  "requestAnimationFrame",
];

const names = new Map([
  ["window", globalThis],
  ...[...OBJECTS, ...CLASSES, ...OTHERS].map((name) => /** @type {const} */ ([name, page[name]])),
  ...FUNCTIONS.map((name) => /** @type {const} */ ([name, page[name].bind(page)])),
]);
for (const [name, value] of names)
  Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });

/** The workers that the page has made. A test answers with `onmessage`. */
export class FakeWorker {
  /** @type {FakeWorker[]} */
  static made = [];
  /** @type {any[]} */
  orders = [];
  isEnded = false;

  /** @param {string} address */
  constructor(address) {
    this.address = String(address);
    FakeWorker.made.push(this);
  }

  /** @param {any} order */
  postMessage(order) {
    this.orders.push(order);
  }

  terminate() {
    this.isEnded = true;
  }

  /** Tell the page something. @param {string} kind @param {object} [content] */
  tell(kind, content = {}) {
    this.onmessage({ data: { kind, blobs: [], ...content } });
  }
}

const { setInterval } = globalThis;
Object.assign(globalThis, {
  // What a page still waits for does not keep its test alive.
  setInterval: (...given) => setInterval(...given).unref(),
  Worker: FakeWorker,
  confirm: () => true,
  RUN: {
    folder: "_run/12ab/",
    first: ["numpy", "canim"],
    needs: { scipy: "\\bscipy\\b" },
    bytes: { first: 12_000_000, scipy: 5_000_000 },
    env: {},
  },
});
// run.js finds the site by its own address; what it imports when needed is beside it.
const script = { src: new URL("../run.js", import.meta.url).href };
Object.defineProperty(document, "currentScript", { value: script, configurable: true });

/** Let all that waits for nothing but its turn have it. */
export const settled = () => new Promise((resolve) => setImmediate(resolve));

/** Put what a test needs into the page. Elements get their content before they are connected,
 *  as from a script that waits for the page. @param {string} html */
export function show(html) {
  const main = document.createElement("main");
  main.innerHTML = html;
  document.body.replaceChildren(main);
  return main;
}
