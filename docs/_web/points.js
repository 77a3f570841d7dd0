// Points on pictures that the reader moves with the mouse, a finger or the arrow keys.

import { button, make } from "./elements.js";

/** @typedef {[number, number]} Point
 *  @typedef {{frames: number[][], lists: Point[][]}} Chosen */

/** @type {{[key: string]: Point}} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export class Points {
  #told = make("output");

  /** @param {import("./python.js").Message} message @param {(chosen: Chosen) => void} use */
  constructor({ name, frames, lists, first, step, blobs }, use) {
    this.frames = /** @type {number[][]} */ (frames); // of each picture: left, right, top, bottom
    this.lists = /** @type {Point[][]} */ (lists);
    this.step = /** @type {number} */ (step);
    this.grounds = blobs.map((png, side) => {
      const src = URL.createObjectURL(new Blob([png]));
      const image = make("img", { src, alt: "", draggable: false, onload: () => URL.revokeObjectURL(src) });
      image.onclick = (event) => this.#add(this.#place(side, event));
      return make("div", { className: "run-ground" }, image);
    });
    const what = name === "goals" ? "goals" : "key points";
    const help = `This program asks for ${what}. It has used those below. Click on a picture to add one, drag one to
      move it, or go to one with Tab and press the arrow keys (with Shift: farther). Delete takes it away.`;
    const put = (/** @type {Point[][]} */ lists) => {
      this.lists = structuredClone(lists);
      this.#draw();
    };
    const bar = make("div", { className: "run-bar" });
    bar.append(button(`Run with these ${what}`, () => use({ frames, lists: this.lists }), "run-main"));
    bar.append(button("Add a point", () => this.#add([0.5, 0.5])));
    bar.append(button("The given ones again", () => put(first)));
    bar.append(button("Take all away", () => put(lists.map(() => []))));
    const grounds = make("div", { className: "run-grounds" }, ...this.grounds);
    this.element = make(
      "section",
      { "aria-label": `Choose the ${what}` },
      make("p", {}, help),
      grounds,
      bar,
      this.#told,
    );
    put(lists);
  }

  /** Return where on a picture the pointer is, each number from 0 to 1.
   *  @param {number} side @param {MouseEvent} event @returns {Point} */
  #place(side, event) {
    const box = this.grounds[side].getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  /** Return the point at a place, within the picture. @param {number} side @param {Point} place @returns {Point} */
  #point(side, [across, down]) {
    const [left, right, top, bottom] = this.frames[side];
    const inside = (/** @type {number} */ share) => Math.min(Math.max(share, 0), 0.999);
    return [left + inside(across) * (right - left), top + inside(down) * (bottom - top)];
  }

  /** A new point comes to the same place on all pictures, so that there are always pairs.
   *  @param {Point} place */
  #add(place) {
    this.lists.forEach((list, side) => list.push(this.#point(side, place)));
    this.#draw();
    this.#focus(0, this.lists[0].length - 1);
  }

  /** @param {number} side @param {number} number */
  #focus(side, number) {
    this.grounds[side].querySelectorAll("button")[number]?.focus();
  }

  #draw() {
    this.grounds.forEach((ground, side) => {
      const dots = this.lists[side].map((_, number) => this.#dot(side, number));
      ground.replaceChildren(ground.children[0], ...dots);
    });
    this.#told.textContent = `${this.lists[0].length} points${this.grounds.length > 1 ? " on each picture" : ""}.`;
  }

  /** @param {number} side @param {number} number */
  #dot(side, number) {
    const [left, right, top, bottom] = this.frames[side];
    const wide = right - left;
    const high = bottom - top;
    const dot = button(String(number), () => {});
    const move = (/** @type {Point} */ place) => {
      const [x, y] = (this.lists[side][number] = this.#point(side, place));
      dot.style.left = `${(100 * (x - left)) / wide}%`;
      dot.style.top = `${(100 * (y - top)) / high}%`;
      const picture = this.grounds.length > 1 ? ` on the ${side ? "right" : "left"} picture` : "";
      dot.setAttribute("aria-label", `Point ${number}${picture}`);
      this.#told.textContent = `Point ${number}${picture}: x ${x.toFixed(1)}, y ${y.toFixed(1)}`;
    };
    const [x, y] = this.lists[side][number];
    move([(x - left) / wide, (y - top) / high]);
    dot.onkeydown = (event) => {
      const [x, y] = this.lists[side][number];
      const far = this.step * (event.shiftKey ? 10 : 1);
      if (event.key in ARROWS) {
        const [across, down] = ARROWS[event.key];
        move([(x - left) / wide + (across * far) / Math.abs(wide), (y - top) / high + (down * far) / Math.abs(high)]);
      } else if (event.key === "Delete" || event.key === "Backspace") {
        for (const list of this.lists) list.splice(number, 1);
        this.#draw();
        this.#focus(side, Math.max(0, number - 1));
      } else return;
      event.preventDefault();
    };
    dot.onpointerdown = (event) => dot.setPointerCapture(event.pointerId);
    dot.onpointermove = (event) => dot.hasPointerCapture(event.pointerId) && move(this.#place(side, event));
    return dot;
  }
}
