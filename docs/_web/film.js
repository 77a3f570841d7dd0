// A film of pictures, with a button and a slider. It may begin before all pictures are there.

import { button, make } from "./elements.js";

const CALM = matchMedia("(prefers-reduced-motion: reduce)");

export class Film {
  /** @type {Blob[]} */
  #frames = [];
  #shown = 0;
  isComplete = false;
  #interval = 40;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;

  /** @param {HTMLImageElement} still the picture in whose place the film comes */
  constructor(still) {
    const { width, height, alt } = still;
    this.canvas = make("canvas", { width, height, role: "img", "aria-label": alt });
    this.play = button("Play", () => (this.#timer ? this.pause() : this.start()));
    this.slider = make("input", { type: "range", min: "0", max: "0", value: "0", "aria-label": "Picture of the film" });
    this.slider.oninput = () => {
      this.pause();
      this.#show(this.slider.valueAsNumber);
    };
    this.element = make("div", { className: "run-film" }, this.canvas, make("div", {}, this.play, this.slider));
  }

  /** @param {Uint8Array<ArrayBuffer>[]} png none where the film ends, empty for the picture before once more
   *  @param {number} interval milliseconds from picture to picture */
  add([png], interval) {
    this.isComplete = !png;
    if (!png) return;
    this.#interval = interval;
    this.#frames.push(png.length ? new Blob([png]) : this.#frames[this.#frames.length - 1]);
    this.slider.max = String(this.#frames.length - 1);
    if (this.#frames.length === 1) this.#show(0);
    if (this.#frames.length === 2 && !CALM.matches) this.start();
  }

  start() {
    this.play.textContent = "Pause";
    this.#timer = setTimeout(() => this.#next(), this.#interval);
  }

  pause() {
    this.play.textContent = "Play";
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  async #next() {
    const last = this.#frames.length - 1;
    // At its end a film begins again; one that is still being drawn waits.
    if (this.#shown < last) await this.#show(this.#shown + 1);
    else if (this.isComplete) await this.#show(0);
    if (this.#timer && this.canvas.isConnected) this.start();
  }

  /** @param {number} number */
  async #show(number) {
    this.#shown = number;
    this.slider.value = String(number);
    const picture = await createImageBitmap(this.#frames[number]);
    if (number !== this.#shown) return;
    this.canvas.width = picture.width;
    this.canvas.height = picture.height;
    this.canvas.getContext("2d")?.drawImage(picture, 0, 0);
  }
}
