import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { show } from "./testing/page.mjs";

const { Points, triangles } = await import("./points.js");

const FRAME = [-0.5, 99.5, -0.5, 199.5]; // a picture of 100 × 200 pixels
const PNG = new Uint8Array([1]);
/** @type {any[]} */
let chosen;
let runs = 0;
let page;
Object.assign(URL, { createObjectURL: () => "blob:x", revokeObjectURL() {} });

/** @param {object} [message] @param {number} [scale] pixels of the page for one of the picture */
function points(message = {}, scale = 2) {
  const lists = [[[20, 30]], [[40, 60]]];
  const first = structuredClone(lists);
  const made = new Points(
    { name: "points", frames: [FRAME, FRAME], lists, first, step: 1, blobs: [PNG, PNG], ...message },
    (now) => chosen.push(structuredClone(now)),
    () => runs++,
  );
  page = show("");
  page.append(made.element);
  for (const ground of made.grounds)
    Object.assign(ground, {
      getBoundingClientRect: () => ({ left: 10, top: 20, width: 100 * scale, height: 200 * scale }),
      setPointerCapture() {},
    });
  return made;
}

const named = (name) => [...page.querySelectorAll("button")].find((button) => button.textContent === name);
const dots = (side) => [...page.querySelectorAll(".run-ground")[side].querySelectorAll("button")];
const told = () => page.querySelector("output").textContent;
const point = (target, type, x, y) =>
  target.dispatchEvent(new PointerEvent(type, { clientX: x, clientY: y, bubbles: true, cancelable: true }));
const press = (target, key, options = {}) =>
  target.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...options }));

beforeEach(() => {
  chosen = [];
  Points.isLarge = false;
});

test("the arrow keys move a point, with Shift farther, and each move is told and kept", () => {
  points();
  for (const key of ["ArrowRight", "ArrowDown"]) press(dots(1)[0], key);
  press(dots(1)[0], "ArrowLeft", { shiftKey: true });
  press(dots(1)[0], "x");
  assert.deepEqual(chosen.at(-1).lists[1][0].map(Math.round), [31, 61]);
  assert.equal(chosen.length, 3);
  assert.equal(told(), "Point 0 on the right picture: x 31.0, y 61.0.");
  assert.equal(Number.parseFloat(dots(1)[0].style.left).toFixed(3), "31.500");
});

test("a point stays in its picture", () => {
  points();
  for (let i = 0; i < 9; i++) press(dots(0)[0], "ArrowLeft", { shiftKey: true });
  assert.equal(chosen.at(-1).lists[0][0][0], -0.5);
});

test("the pointer drags the nearest point by where it was taken", () => {
  const lists = [
    [
      [20, 30],
      [26, 30],
    ],
    [
      [20, 30],
      [26, 30],
    ],
  ];
  points({ lists });
  const [under, over] = dots(0);
  const at = (x, y) => [10 + 2 * (x + 0.5), 20 + 2 * (y + 0.5)];
  point(over, "pointermove", ...at(50, 50)); // nothing is held
  point(over, "pointerdown", ...at(22, 31)); // the grip of one point lies on the other point
  assert.equal(document.activeElement, under);
  point(over, "pointermove", ...at(42, 71));
  assert.deepEqual(chosen, []);
  page.querySelector(".run-ground").dispatchEvent(new Event("lostpointercapture"));
  assert.deepEqual(
    chosen[0].lists[0].map((place) => place.map(Math.round)),
    [
      [40, 70],
      [26, 30],
    ],
  );
  point(over, "pointermove", ...at(1, 1));
  assert.equal(chosen.length, 1);
});

test("a click on a picture adds a point to all, one on a point does not", () => {
  points();
  point(page.querySelector("img"), "click", 110, 220);
  point(dots(0)[0], "click", 110, 220);
  assert.deepEqual(
    chosen.map(({ lists }) => lists.map((list) => list[1])),
    [
      [
        [49.5, 99.5],
        [49.5, 99.5],
      ],
    ],
  );
  assert.equal(document.activeElement, dots(0)[1]);
  assert.equal(told(), "2 points on each picture.");
});

test("a point is marked together with its partner", () => {
  points({ lists: [[...Array(2)].map(() => [5, 5]), [...Array(2)].map(() => [9, 9])] });
  dots(0)[1].focus();
  dots(0)[1].dispatchEvent(new FocusEvent("focusin", { bubbles: true }));
  assert.deepEqual(
    [0, 1].map((side) => dots(side).map((dot) => dot.classList.contains("run-pair"))),
    [
      [false, true],
      [false, true],
    ],
  );
});

test("Delete takes a pair away, and the buttons do what they say", () => {
  points();
  press(dots(1)[0], "Delete");
  assert.deepEqual(chosen.at(-1).lists, [[], []]);
  named("Add a point").click();
  named("Add a point").click();
  press(dots(0)[1], "Backspace");
  assert.equal(chosen.at(-1).lists[0].length, 1);
  named("The given ones again").click();
  assert.deepEqual(chosen.at(-1).lists, [[[20, 30]], [[40, 60]]]);
  named("Take all away").click();
  assert.deepEqual(chosen.at(-1).lists, [[], []]);
  assert.equal(told(), "0 points on each picture.");
  named("Run with these key points").click();
  assert.equal(runs, 1);
});

test("pictures are enlarged, also in the next run", () => {
  points();
  named("Enlarge the pictures").click();
  points();
  assert.ok(page.querySelector(".run-large"));
  named("Make the pictures small again").click();
  assert.equal(page.querySelector(".run-large"), null);
});

test("goals are on one picture, whose y may go up, without triangles", () => {
  points({ name: "goals", frames: [[0, 10, 10, 0]], lists: [[[5, 2]]], first: [[[5, 2]]], step: 0.5, blobs: [PNG] });
  assert.equal(page.querySelector("svg"), null);
  assert.ok(named("Enlarge the picture"));
  assert.equal(dots(0)[0].style.top, "80%");
  press(dots(0)[0], "ArrowUp");
  assert.deepEqual(chosen[0].lists, [[[5, 2.5]]]);
  assert.equal(told(), "Point 0: x 5.0, y 2.5.");
});

test("triangles join the points halfway, with the corners, as in Python", () => {
  const all = triangles([FRAME, FRAME], [[[20, 30]], [[40, 60]]]);
  assert.equal(all.length, 4);
  for (const { places, isFolded } of all) {
    assert.equal(isFolded, false);
    assert.equal(places[0].length, 3);
    assert.ok(places[0].some((place) => String(place) === "20,30"));
    assert.ok(places[1].some((place) => String(place) === "40,60"));
  }
});

test("a triangle that turns over is drawn in red, and told", () => {
  const left = [
    [30, 100],
    [60, 100],
    [45, 60],
  ];
  points({ lists: [left, structuredClone(left)] });
  assert.equal(page.querySelector(".run-fold").getAttribute("d"), "");
  for (let i = 0; i < 7; i++) press(dots(1)[2], "ArrowDown", { shiftKey: true });
  assert.match(page.querySelector(".run-fold").getAttribute("d"), /^M/);
  assert.match(told(), /turns over/);
});
