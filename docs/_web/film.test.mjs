import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";
import { settled, show } from "./testing/page.mjs";

let isCalm = false;
Object.assign(globalThis, {
  matchMedia: () => ({
    get matches() {
      return isCalm;
    },
  }),
  createImageBitmap: async (blob) => ({ width: blob.size, height: 1, blob }),
});
const { Film } = await import("./film.js");

/** @type {number[]} */
let drawn;
let film;

mock.timers.enable({ apis: ["setTimeout"] });
beforeEach(() => {
  isCalm = false;
  drawn = [];
  film = new Film(Object.assign(document.createElement("img"), { width: 4, height: 3, alt: "A film." }));
  film.canvas.getContext = () => ({ drawImage: ({ width }) => drawn.push(width) });
  show("").append(film.element);
});

/** A picture that is known by its size. @param {number} size */
const png = (size) => new Uint8Array(size);

async function tick(count = 1) {
  for (let i = 0; i < count; i++) {
    await settled();
    mock.timers.tick(40);
    await settled();
  }
}

test("a film begins by itself, waits for pictures, and begins again at its end", async () => {
  film.add([png(1)], 40);
  await tick();
  assert.deepEqual(drawn, [1]);
  film.add([png(2)], 40);
  await tick(3); // the third picture is still being drawn
  assert.deepEqual(drawn, [1, 2]);
  film.add([png(3)], 40);
  film.add([], 40);
  assert.equal(film.isComplete, true);
  await tick(2);
  assert.deepEqual(drawn, [1, 2, 3, 1]);
  film.element.remove();
  await tick(2);
  assert.equal(drawn.length, 5); // nothing goes on that is not in the page
  film.pause();
});

test("a picture that is the same as the one before is sent as nothing", async () => {
  film.add([png(7)], 40);
  film.add([png(0)], 40);
  await tick();
  assert.deepEqual(drawn, [7, 7]);
  film.pause();
});

test("for those who want it so a film keeps still until Play is pressed", async () => {
  isCalm = true;
  film.add([png(1)], 40);
  film.add([png(2)], 40);
  await tick(2);
  assert.deepEqual(drawn, [1]);
  film.play.click();
  assert.equal(film.play.textContent, "Pause");
  await tick();
  film.play.click();
  assert.equal(film.play.textContent, "Play");
  await tick(2);
  assert.deepEqual(drawn, [1, 2]);
});

test("the slider shows a picture, and only the last one that was asked for", async () => {
  for (const size of [1, 2, 3]) film.add([png(size)], 40);
  await tick();
  drawn = [];
  for (const number of ["0", "2"]) {
    film.slider.value = number;
    film.slider.dispatchEvent(new Event("input"));
  }
  await tick();
  assert.deepEqual(drawn, [3]);
  assert.equal(film.play.textContent, "Play");
  assert.equal(film.canvas.width, 3);
});
