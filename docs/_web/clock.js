// How long a run has taken, and how far it is: so that a long one never looks dead.

import { make } from "./elements.js";

const PATIENCE = 2; // seconds; what ends sooner needs no clock

export class Clock {
  #start = 0;
  #note = "";
  /** @type {ReturnType<typeof setInterval> | undefined} */
  #ticking;
  // A timer is not read out at each tick, as a status would be.
  element = make("p", { className: "run-clock", role: "timer", hidden: true });

  start() {
    this.stop();
    this.#start = performance.now();
    this.#ticking = setInterval(() => this.#show(), 1000);
  }

  /** Show how far the run is. @param {string} text */
  note(text) {
    this.#note = text;
    this.#show();
  }

  stop() {
    clearInterval(this.#ticking);
    this.#note = "";
    this.element.hidden = true;
  }

  #show() {
    const seconds = Math.floor((performance.now() - this.#start) / 1000);
    if (seconds < PATIENCE) return;
    this.element.hidden = false;
    this.element.textContent = `${seconds} s. ${this.#note}`.trim();
  }
}
