// Points on pictures that the reader moves with the mouse, a finger or the arrow keys.

import Delaunator from "delaunator";
import { button, make } from "./elements.js";

/** @typedef {[number, number]} Point
 *  @typedef {{key: number, lists: Point[][]}} Chosen with a key of the pictures and points that were given */

/** @type {{[key: string]: Point}} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const SVG = "http://www.w3.org/2000/svg";
const HALF = 0.5; // of a pixel: from the rim of a picture to the centre of its first pixel
const FAR = 10; // steps: with Shift, and from a point to one that was added at the same place
const MANY = 16; // points, of which smaller grips leave more of a picture free
const PAUSE = 300; // milliseconds without a move, before a screen reader tells where a point is

/** Return the places of a picture's corners, which are points too. @param {number[]} frame @returns {Point[]} */
function corners([left, right, top, bottom]) {
  return [left + HALF, right - HALF].flatMap((x) =>
    [top + HALF, bottom - HALF].map((y) => /** @type {Point} */ ([x, y])),
  );
}

/** Return the triangles over matching points and the corners of their pictures, and of each, whether
 *  it turns over from one picture to the other. They are those of `canim.warping.triangulate`; but where
 *  four points or more lie on one circle, each of the two may divide what is between them in its own way.
 *  @param {number[][]} frames @param {Point[][]} lists */
export function triangles(frames, lists) {
  const sets = lists.map((list, side) => [...list, ...corners(frames[side])]);
  const means = sets[0].map((_, i) => [0, 1].map((k) => sets.reduce((sum, set) => sum + set[i][k], 0) / sets.length));
  const numbers = Delaunator.from(means).triangles;
  return Array.from({ length: numbers.length / 3 }, (_, i) => {
    const places = sets.map((set) => [...numbers.slice(3 * i, 3 * i + 3)].map((number) => set[number]));
    const sides = places.map(([a, b, c]) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
    return { places, isFolded: sides.some((side) => side !== sides[0]) };
  });
}

export class Points {
  static isLarge = false; // also in the next run
  #told = make("p", { "aria-hidden": "true", className: "run-told" });
  #spoken = make("output", { className: "run-spoken" });
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  /** @type {{number: number, from: Point, at: Point} | null} the point that is dragged, and where it was taken */
  #held = null;
  #wasTaken = false; // whether the pointer went down on a grip
  /** @type {{side: number, number: number} | null} the point that had the focus last */
  #chosen = null;
  /** @type {string[]} what was here before, for Undo */
  #past = [];
  #deed = ""; // the last one
  #now;

  /** @param {import("./python.js").Message} message
   *  @param {(chosen: Chosen | null) => void} changed gets null where the points are the given ones
   *  @param {() => void} run */
  constructor({ name, frames, lists, first, key, step, blobs }, changed, run) {
    this.frames = /** @type {number[][]} */ (frames); // of each picture: left, right, top, bottom
    this.lists = /** @type {Point[][]} */ (lists);
    this.step = /** @type {number} */ (step);
    this.#now = JSON.stringify(lists);
    const given = JSON.stringify(first);
    this.changed = () => changed(this.#now === given ? null : { key, lists: JSON.parse(this.#now) });
    const isPair = name === "points";
    const what = isPair ? "key points" : "goals";
    this.grounds = blobs.map((png, side) => this.#ground(png, side, isPair));
    const help = `This program asks for ${what}. It has used those below. Drag one to move it. Click on a picture to
      add one. Or go to one with Tab and press the arrow keys (with Shift: farther); Delete takes it away.
      Every Run uses them as they are here.`;
    const put = (/** @type {Point[][]} */ lists) => {
      this.lists = structuredClone(lists);
      this.#draw();
      this.#store();
    };
    const larger = button("", () => this.#enlarge(larger, !Points.isLarge));
    const bar = make("div", { className: "run-bar" }, button(`Run with these ${what}`, run, "run-main"), larger);
    bar.append(button("Add a point", () => this.#add(this.#chosen?.side ?? 0, [0.5, 0.5])));
    bar.append(button("Take this point away", () => this.#takeAway()));
    bar.append(button("Take all away", () => put(this.lists.map(() => []))));
    const again = () => {
      put(first);
      changed(null); // also what was moved on other pictures
    };
    bar.append(button("The given ones again", again));
    bar.append(button("Undo", () => this.#undo()));
    const windows = this.grounds.map((ground) => make("div", { className: "run-window" }, ground));
    this.pictures = make("div", { className: "run-grounds" }, ...windows);
    const label = { "aria-label": `Choose the ${what}` };
    this.element = make("section", label, make("p", {}, help), this.pictures, bar, this.#told, this.#spoken);
    this.#enlarge(larger, Points.isLarge);
    this.#draw();
  }

  /** @param {Uint8Array<ArrayBuffer>} png @param {number} side @param {boolean} isPair */
  #ground(png, side, isPair) {
    const src = URL.createObjectURL(new Blob([png]));
    const image = make("img", { src, alt: "", draggable: false, onload: () => URL.revokeObjectURL(src) });
    const ground = make("div", { className: "run-ground" }, image);
    if (isPair) ground.append(document.createElementNS(SVG, "svg"));
    ground.onclick = (event) => {
      // A captured pointer clicks on the picture, where it was on a grip.
      if (!this.#wasTaken && !this.#isDot(event)) this.#add(side, this.#place(side, event), true);
      this.#wasTaken = false;
    };
    ground.onpointerdown = (event) => {
      this.#wasTaken = this.#isDot(event);
      if (this.#wasTaken) this.#take(side, event);
    };
    ground.onpointermove = (event) => {
      if (!this.#held) return;
      const { number, from, at } = this.#held;
      const place = this.#place(side, event);
      const way = [place[0] - at[0], place[1] - at[1]];
      const [across, down] = this.#share(side, from);
      this.#move(side, number, way.some(Boolean) ? this.#point(side, [across + way[0], down + way[1]]) : from);
    };
    ground.onlostpointercapture = () => {
      this.#held = null;
      this.#store();
    };
    // The partner of a point on the other picture is marked with it.
    ground.addEventListener("focusin", ({ target }) => {
      const number = this.#dots(side).indexOf(/** @type {HTMLButtonElement} */ (target));
      this.#chosen = { side, number };
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
    const lengths = this.lists[side].map((point) => {
      const [across, down] = this.#share(side, point);
      return Math.hypot((across - place[0]) * box.width, (down - place[1]) * box.height);
    });
    const number = lengths.indexOf(Math.min(...lengths));
    this.#held = { number, from: this.lists[side][number], at: place };
    this.grounds[side].setPointerCapture(event.pointerId);
    event.preventDefault(); // the browser would give the focus to the grip that lies on top
    this.#focus(side, number, true);
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

  /** Return a place where no point is yet, the wanted one or one aside: equal points have no triangles.
   *  @param {Point} place @returns {Point} */
  #free([across, down]) {
    const [left, right, top, bottom] = this.frames[0];
    const [wide, high] = [right - left, bottom - top].map((length) => (FAR * this.step) / Math.abs(length));
    const taken = this.lists.map((list, side) => [...list, ...corners(this.frames[side])]);
    /** @type {Point[]} */
    const places = taken[0].map((_, i) => {
      const way = across + i * wide;
      return [way % 1, (down + Math.floor(way) * high) % 1];
    });
    const isFree = (/** @type {Point} */ place) =>
      taken.every((points, side) => {
        const [x, y] = this.#point(side, place);
        return points.every((point) => Math.hypot(point[0] - x, point[1] - y) >= this.step);
      });
    return places.find(isFree) ?? [across, down];
  }

  /** A new point comes to the same place on all pictures, so that there are always pairs.
   *  @param {number} side @param {Point} wanted @param {boolean} [isInSight] */
  #add(side, wanted, isInSight) {
    const place = this.#free(wanted);
    this.lists.forEach((list, other) => list.push(this.#point(other, place)));
    this.#draw();
    this.#focus(side, this.lists[0].length - 1, isInSight);
    this.#store();
  }

  /** @param {number} side @param {number} number */
  #remove(side, number) {
    for (const list of this.lists) list.splice(number, 1);
    this.#draw();
    this.#focus(side, Math.max(0, number - 1));
    this.#store();
  }

  #takeAway() {
    if (this.#chosen) this.#remove(this.#chosen.side, this.#chosen.number);
    else this.#tell("Choose a point first: click on it, or go to it with Tab.");
  }

  /** Keep what is here now. @param {string} [deed] those of one name that follow each other are undone as one */
  #store(deed = "") {
    const now = JSON.stringify(this.lists);
    if (now === this.#now) return; // a click on a grip moves nothing
    if (!deed || deed !== this.#deed) this.#past.push(this.#now);
    this.#deed = deed;
    this.#now = now;
    this.changed();
  }

  #undo() {
    const before = this.#past.pop();
    if (!before) {
      this.#tell("There is nothing to undo.");
      return;
    }
    this.#deed = "";
    this.#now = before;
    this.lists = JSON.parse(before);
    this.#draw();
    this.changed();
  }

  /** @param {number} side */
  #dots(side) {
    return [...this.grounds[side].querySelectorAll("button")];
  }

  /** @param {number} side @param {number} number @param {boolean} [preventScroll] where it is in sight */
  #focus(side, number, preventScroll = false) {
    this.#dots(side)[number]?.focus({ preventScroll });
  }

  #draw() {
    this.#chosen = null;
    this.grounds.forEach((ground, side) => {
      for (const old of this.#dots(side)) old.remove();
      ground.classList.toggle("run-many", this.lists[side].length > MANY);
      ground.append(...this.lists[side].map((_, number) => this.#dot(side, number)));
    });
    this.#join();
    const { length } = this.lists[0];
    this.#tell(`${length} point${length === 1 ? "" : "s"}${this.grounds.length > 1 ? " on each picture" : ""}.`);
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

  /** Show words at once, and let a screen reader tell them after the last of many.
   *  @param {string} words @param {string} [spoken] */
  #tell(words, spoken = words) {
    this.#told.textContent = words;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#spoken.textContent = spoken;
      for (const side of this.grounds.keys())
        for (const [number, dot] of this.#dots(side).entries()) this.#value(dot, side, number);
    }, PAUSE);
  }

  /** @param {number} side @param {number} number @param {Point} point */
  #move(side, number, point) {
    this.lists[side][number] = point;
    this.#put(this.#dots(side)[number], side, number);
    this.#join();
    const folded = this.folded ? "A triangle turns over: it is red." : "";
    this.#tell(`${this.#name(side, number)}: ${this.#words(side, number)}. ${folded}`, folded);
  }

  /** @param {number} side @param {number} number */
  #words(side, number) {
    const [x, y] = this.lists[side][number];
    return `x ${x.toFixed(1)}, y ${y.toFixed(1)}`;
  }

  /** Tell a screen reader, which speaks the value of what has the focus, where a point is.
   *  @param {HTMLButtonElement} dot @param {number} side @param {number} number */
  #value(dot, side, number) {
    dot.setAttribute("aria-valuenow", this.lists[side][number][0].toFixed(1));
    dot.setAttribute("aria-valuetext", this.#words(side, number));
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
    // A slider gets the arrow keys, which screen readers keep from buttons.
    const dot = make("button", { type: "button", role: "slider", "aria-label": this.#name(side, number) });
    const [left, right] = this.frames[side];
    dot.setAttribute("aria-valuemin", String(left));
    dot.setAttribute("aria-valuemax", String(right));
    this.#value(dot, side, number);
    dot.append(make("span", {}, String(number)));
    this.#put(dot, side, number);
    dot.onkeydown = (event) => {
      const [left, right, top, bottom] = this.frames[side];
      const far = this.step * (event.shiftKey ? FAR : 1);
      if (event.key in ARROWS) {
        const [across, down] = ARROWS[event.key];
        const [x, y] = this.#share(side, this.lists[side][number]);
        const steps = [far / Math.abs(right - left), far / Math.abs(bottom - top)];
        this.#move(side, number, this.#point(side, [x + across * steps[0], y + down * steps[1]]));
        this.#store(`${side} ${number}`);
      } else if (event.key === "Delete" || event.key === "Backspace") {
        this.#remove(side, number);
      } else return;
      event.preventDefault();
    };
    return dot;
  }
}
