// Points on pictures that the reader moves with the mouse, a finger or the arrow keys.

import { button, make } from "./elements.js";

/** @typedef {[number, number]} Point
 *  @typedef {{frames: number[][], lists: Point[][]}} Chosen */

const ARROWS = new Map([
  ["ArrowLeft", [-1, 0]],
  ["ArrowRight", [1, 0]],
  ["ArrowUp", [0, -1]],
  ["ArrowDown", [0, 1]],
]);

export class Points {
  /** @param {import("./python.js").Message} message @param {(chosen: Chosen) => void} use */
  constructor(message, use) {
    const { name, frames, lists, first, step, blobs } = message;
    this.frames = /** @type {number[][]} */ (frames); // of each picture: left, right, top, bottom
    this.lists = /** @type {Point[][]} */ (structuredClone(lists));
    this.step = /** @type {number} */ (step);
    this.grounds = blobs.map((png) => {
      const src = URL.createObjectURL(new Blob([png]));
      const image = make("img", { src, alt: "", draggable: false, onload: () => URL.revokeObjectURL(src) });
      return make("div", { className: "run-ground" }, image);
    });
    this.grounds.forEach((ground, side) => {
      ground.onclick = (event) => event.target instanceof HTMLImageElement && this.#add(this.#place(side, event));
    });
    this.told = make("output");
    const what = name === "goals" ? "goals" : "key points";
    this.element = make(
      "section",
      { className: "run-points", "aria-label": `Choose the ${what}` },
      make(
        "p",
        {},
        `This program asks for ${what}. It has used those below. Click on a picture to add one, drag
        one to move it, or go to one with Tab and press the arrow keys (with Shift: farther). Delete takes it away.`,
      ),
      make("div", { className: "run-grounds" }, ...this.grounds),
      make(
        "p",
        { className: "run-bar" },
        button(`Run with these ${what}`, () => use({ frames: this.frames, lists: this.lists }), "run-main"),
        button("Add a point", () => this.#add([0.5, 0.5])),
        button("The first ones again", () => this.#draw((this.lists = structuredClone(first)))),
        button("Take all away", () => this.#draw((this.lists = this.lists.map(() => [])))),
      ),
      this.told,
    );
    this.#draw();
  }

  /** Return where on a picture the pointer is, each number from 0 to 1.
   *  @param {number} side @param {MouseEvent} event @returns {Point} */
  #place(side, event) {
    const box = this.grounds[side].getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  /** A new point comes to the same place on all pictures, so that there are always pairs.
   *  @param {Point} place */
  #add([across, down]) {
    this.frames.forEach(([left, right, top, bottom], side) => {
      const point = /** @type {Point} */ ([left + across * (right - left), top + down * (bottom - top)]);
      this.lists[side].push(this.#inside(side, point));
    });
    this.#draw();
    this.#focus(0, this.lists[0].length - 1);
  }

  /** @param {number} side @param {Point} point @returns {Point} */
  #inside(side, [x, y]) {
    const [left, right, top, bottom] = this.frames[side];
    const margin = this.step === 1 ? 0.5 : 0; // the centre of the outermost pixel
    const limit = (/** @type {number} */ v, /** @type {number} */ a, /** @type {number} */ b) =>
      Math.min(Math.max(v, Math.min(a, b) + margin), Math.max(a, b) - margin);
    return [limit(x, left, right), limit(y, top, bottom)];
  }

  /** @param {number} side @param {number} number */
  #focus(side, number) {
    /** @type {NodeListOf<HTMLElement>} */ (this.grounds[side].querySelectorAll("button"))[number]?.focus();
  }

  /** @param {unknown} [_] */
  #draw(_) {
    this.grounds.forEach((ground, side) => {
      ground.querySelectorAll("button").forEach((old) => old.remove());
      ground.append(...this.lists[side].map((_, number) => this.#dot(side, number)));
    });
    this.told.textContent = `${this.lists[0].length} points${this.grounds.length > 1 ? " on each picture" : ""}.`;
  }

  /** @param {number} side @param {number} number */
  #dot(side, number) {
    const [left, right, top, bottom] = this.frames[side];
    const dot = button(String(number), () => {});
    const move = (/** @type {Point} */ point) => {
      const [x, y] = (this.lists[side][number] = this.#inside(side, point));
      dot.style.left = `${(100 * (x - left)) / (right - left)}%`;
      dot.style.top = `${(100 * (y - top)) / (bottom - top)}%`;
      const picture = this.grounds.length > 1 ? ` on the ${side ? "right" : "left"} picture` : "";
      dot.setAttribute("aria-label", `Point ${number}${picture}`);
      this.told.textContent = `Point ${number}${picture}: x ${x.toFixed(1)}, y ${y.toFixed(1)}`;
    };
    move(this.lists[side][number]);
    dot.onkeydown = (event) => {
      const way = ARROWS.get(event.key);
      const [x, y] = this.lists[side][number];
      const far = this.step * (event.shiftKey ? 10 : 1);
      if (way) move([x + way[0] * far * Math.sign(right - left), y + way[1] * far * Math.sign(bottom - top)]);
      else if (event.key === "Delete" || event.key === "Backspace") {
        this.lists.forEach((list) => list.splice(number, 1));
        this.#draw();
        this.#focus(side, Math.max(0, number - 1));
      } else return;
      event.preventDefault();
    };
    dot.onpointerdown = (event) => dot.setPointerCapture(event.pointerId);
    dot.onpointermove = (event) => {
      if (!dot.hasPointerCapture(event.pointerId)) return;
      const [across, down] = this.#place(side, event);
      move([left + across * (right - left), top + down * (bottom - top)]);
    };
    return dot;
  }
}
