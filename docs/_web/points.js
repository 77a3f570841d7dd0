// Points on pictures that the reader moves with the mouse, a finger or the arrow keys.

import Delaunator from "delaunator";
import { button, make } from "./elements.js";

/** @typedef {[number, number]} Point
 *  @typedef {{frames: number[][], lists: Point[][]}} Chosen */

/** @type {{[key: string]: Point}} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const SVG = "http://www.w3.org/2000/svg";
const HALF = 0.5; // of a pixel: from the rim of a picture to the centre of its first pixel

/** Return the triangles over matching points and the corners of their pictures: those of
 *  `canim.warping.triangulate`, and of each, whether it turns over from one picture to the other.
 *  @param {number[][]} frames @param {Point[][]} lists */
export function triangles(frames, lists) {
  const sets = lists.map((list, side) => {
    const [left, right, top, bottom] = frames[side];
    const corners = [left + HALF, right - HALF].flatMap((x) => [top + HALF, bottom - HALF].map((y) => [x, y]));
    return [...list, ...corners];
  });
  const means = sets[0].map((_, i) => [0, 1].map((k) => sets.reduce((sum, set) => sum + set[i][k], 0) / sets.length));
  const corners = Delaunator.from(means).triangles;
  return Array.from({ length: corners.length / 3 }, (_, i) => {
    const places = sets.map((set) => [...corners.slice(3 * i, 3 * i + 3)].map((corner) => set[corner]));
    const sides = places.map(([a, b, c]) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
    return { places, isFolded: sides.some((side) => side !== sides[0]) };
  });
}

export class Points {
  static isLarge = false; // also in the next run
  #told = make("output");
  /** @type {{number: number, away: Point} | null} the point that is dragged */
  #held = null;

  /** @param {import("./python.js").Message} message
   *  @param {(chosen: Chosen) => void} changed @param {() => void} run */
  constructor({ name, frames, lists, first, step, blobs }, changed, run) {
    this.frames = /** @type {number[][]} */ (frames); // of each picture: left, right, top, bottom
    this.lists = /** @type {Point[][]} */ (lists);
    this.step = /** @type {number} */ (step);
    this.changed = () => changed({ frames, lists: this.lists });
    const isPair = name === "points";
    const what = isPair ? "key points" : "goals";
    this.grounds = blobs.map((png, side) => this.#ground(png, side, isPair));
    const help = `This program asks for ${what}. It has used those below. Drag one to move it. Click on a picture to
      add one. Or go to one with Tab and press the arrow keys (with Shift: farther); Delete takes it away.
      Every Run uses them as they are here.`;
    const put = (/** @type {Point[][]} */ lists) => {
      this.lists = structuredClone(lists);
      this.#draw();
      this.changed();
    };
    const larger = button("", () => this.#enlarge(larger, !Points.isLarge));
    const bar = make("div", { className: "run-bar" }, button(`Run with these ${what}`, run, "run-main"), larger);
    bar.append(button("Add a point", () => this.#add([0.5, 0.5])));
    bar.append(button("The given ones again", () => put(first)));
    bar.append(button("Take all away", () => put(lists.map(() => []))));
    const windows = this.grounds.map((ground) => make("div", { className: "run-window" }, ground));
    this.pictures = make("div", { className: "run-grounds" }, ...windows);
    const label = { "aria-label": `Choose the ${what}` };
    this.element = make("section", label, make("p", {}, help), this.pictures, bar, this.#told);
    this.#enlarge(larger, Points.isLarge);
    this.#draw();
  }

  /** @param {Uint8Array<ArrayBuffer>} png @param {number} side @param {boolean} isPair */
  #ground(png, side, isPair) {
    const src = URL.createObjectURL(new Blob([png]));
    const image = make("img", { src, alt: "", draggable: false, onload: () => URL.revokeObjectURL(src) });
    const ground = make("div", { className: "run-ground" }, image);
    if (isPair) ground.append(document.createElementNS(SVG, "svg"));
    ground.onclick = (event) => this.#isDot(event) || this.#add(this.#place(side, event));
    ground.onpointerdown = (event) => this.#isDot(event) && this.#take(side, event);
    ground.onpointermove = (event) => {
      if (!this.#held) return;
      const [across, down] = this.#place(side, event);
      const [right, below] = this.#held.away;
      this.#move(side, this.#held.number, [across + right, down + below]);
    };
    ground.onlostpointercapture = () => {
      this.#held = null;
      this.changed();
    };
    // The partner of a point on the other picture is marked with it.
    ground.addEventListener("focusin", ({ target }) => {
      const number = this.#dots(side).indexOf(/** @type {HTMLButtonElement} */ (target));
      for (const [other] of this.grounds.entries())
        for (const [i, dot] of this.#dots(other).entries()) dot.classList.toggle("run-pair", i === number);
    });
    return ground;
  }

  /** @param {Event} event */
  #isDot(event) {
    return /** @type {Element} */ (event.target).closest("button") !== null;
  }

  /** Take hold of the nearest point: where they are close, the grips lie on each other.
   *  @param {number} side @param {PointerEvent} event */
  #take(side, event) {
    const box = this.grounds[side].getBoundingClientRect();
    const place = this.#place(side, event);
    const ways = this.lists[side].map((point) => {
      const [across, down] = this.#share(side, point);
      return /** @type {Point} */ ([across - place[0], down - place[1]]);
    });
    const lengths = ways.map(([across, down]) => Math.hypot(across * box.width, down * box.height));
    const number = lengths.indexOf(Math.min(...lengths));
    this.#held = { number, away: ways[number] };
    this.grounds[side].setPointerCapture(event.pointerId);
    event.preventDefault(); // the browser would give the focus to the grip that lies on top
    this.#focus(side, number);
  }

  /** @param {HTMLButtonElement} switched @param {boolean} isLarge */
  #enlarge(switched, isLarge) {
    Points.isLarge = isLarge;
    this.pictures.classList.toggle("run-large", isLarge);
    const one = this.grounds.length > 1 ? "the pictures" : "the picture";
    switched.textContent = isLarge ? `Make ${one} small again` : `Enlarge ${one}`;
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

  /** Return the place of a point, each number from 0 to 1. @param {number} side @param {Point} point @returns {Point} */
  #share(side, [x, y]) {
    const [left, right, top, bottom] = this.frames[side];
    return [(x - left) / (right - left), (y - top) / (bottom - top)];
  }

  /** A new point comes to the same place on all pictures, so that there are always pairs.
   *  @param {Point} place */
  #add(place) {
    this.lists.forEach((list, side) => list.push(this.#point(side, place)));
    this.#draw();
    this.#focus(0, this.lists[0].length - 1);
    this.changed();
  }

  /** @param {number} side */
  #dots(side) {
    return [...this.grounds[side].querySelectorAll("button")];
  }

  /** @param {number} side @param {number} number */
  #focus(side, number) {
    this.#dots(side)[number]?.focus();
  }

  #draw() {
    this.grounds.forEach((ground, side) => {
      for (const old of this.#dots(side)) old.remove();
      ground.append(...this.lists[side].map((_, number) => this.#dot(side, number)));
    });
    this.#join();
    this.#told.textContent = `${this.lists[0].length} points${this.grounds.length > 1 ? " on each picture" : ""}.`;
  }

  /** Draw the triangles between the points. */
  #join() {
    const drawings = this.grounds.map((ground) => ground.querySelector("svg"));
    if (!drawings[0]) return;
    const all = triangles(this.frames, this.lists);
    drawings.forEach((drawing, side) => {
      const [left, right, top, bottom] = this.frames[side];
      drawing?.setAttribute("viewBox", `${left} ${top} ${right - left} ${bottom - top}`);
      const path = (/** @type {string} */ kind, /** @type {typeof all} */ some) => {
        const line = document.createElementNS(SVG, "path");
        line.setAttribute("class", kind);
        line.setAttribute("d", some.map(({ places }) => `M${places[side].join("L")}Z`).join(""));
        return line;
      };
      const folded = all.filter(({ isFolded }) => isFolded);
      drawing?.replaceChildren(path("run-under", all), path("run-over", all), path("run-fold", folded));
    });
    this.folded = all.filter(({ isFolded }) => isFolded).length;
  }

  /** @param {number} side @param {number} number @param {Point} place */
  #move(side, number, place) {
    const [x, y] = (this.lists[side][number] = this.#point(side, place));
    this.#put(this.#dots(side)[number], side, number);
    this.#join();
    const folded = this.folded ? " A triangle turns over: it is red." : "";
    this.#told.textContent = `${this.#name(side, number)}: x ${x.toFixed(1)}, y ${y.toFixed(1)}.${folded}`;
  }

  /** @param {number} side @param {number} number */
  #name(side, number) {
    return `Point ${number}${this.grounds.length > 1 ? ` on the ${side ? "right" : "left"} picture` : ""}`;
  }

  /** @param {HTMLButtonElement} dot @param {number} side @param {number} number */
  #put(dot, side, number) {
    const [across, down] = this.#share(side, this.lists[side][number]);
    dot.style.left = `${100 * across}%`;
    dot.style.top = `${100 * down}%`;
  }

  /** @param {number} side @param {number} number */
  #dot(side, number) {
    const dot = make("button", { type: "button", "aria-label": this.#name(side, number) });
    dot.append(make("span", {}, String(number)));
    this.#put(dot, side, number);
    dot.onkeydown = (event) => {
      const [left, right, top, bottom] = this.frames[side];
      const far = this.step * (event.shiftKey ? 10 : 1);
      if (event.key in ARROWS) {
        const [across, down] = ARROWS[event.key];
        const [x, y] = this.#share(side, this.lists[side][number]);
        const steps = [far / Math.abs(right - left), far / Math.abs(bottom - top)];
        this.#move(side, number, [x + across * steps[0], y + down * steps[1]]);
      } else if (event.key === "Delete" || event.key === "Backspace") {
        for (const list of this.lists) list.splice(number, 1);
        this.#draw();
        this.#focus(side, Math.max(0, number - 1));
      } else return;
      event.preventDefault();
      this.changed();
    };
    return dot;
  }
}
