import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";
import { show } from "./testing/page.mjs";

const { Points, triangles } = await import("./points.js");

const FRAME = [-0.5, 99.5, -0.5, 199.5]; // a picture of 100 × 200 pixels
const PNG = new Uint8Array([1]);
/** @type {any[]} */
let chosen;
let runs = 0;
let page;
mock.timers.enable({ apis: ["setTimeout"] });
Object.assign(URL, { createObjectURL: () => "blob:x", revokeObjectURL() {} });

/** @param {object} [message] @param {number} [scale] pixels of the page for one of the picture */
function points(message = {}, scale = 2) {
  const lists = [[[20, 30]], [[40, 60]]];
  const first = structuredClone(lists);
  const made = new Points(
    { name: "points", frames: [FRAME, FRAME], lists, first, key: 7, step: 1, blobs: [PNG, PNG], ...message },
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
const told = () => page.querySelector(".run-told").textContent;
const spoken = () => page.querySelector("output").textContent;
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
  assert.equal(told(), "Point 0 on the right picture: x 31.0, y 61.0. ");
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
  assert.equal(chosen.at(-1), null);
  assert.equal(told(), "1 point on each picture.");
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
  assert.equal(told(), "Point 0: x 5.0, y 2.5. ");
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

/** What a browser sends for a press of the pointer: it is captured, so that the picture is clicked. */
function dragged(dot, ...places) {
  const ground = dot.parentElement;
  point(dot, "pointerdown", ...places[0]);
  for (const place of places) point(ground, "pointermove", ...place);
  point(ground, "pointerup", ...places.at(-1));
  ground.dispatchEvent(new Event("lostpointercapture"));
  point(ground, "click", ...places.at(-1));
}

test("a click on a grip, or dragging it, adds no point; the next click beside it does", () => {
  points();
  dragged(dots(0)[0], [52, 82]);
  assert.deepEqual(chosen, []);
  assert.equal(dots(0).length, 1);
  dragged(dots(0)[0], [52, 82], [72, 82]);
  assert.equal(chosen.length, 1);
  assert.deepEqual(
    chosen[0].lists.map(([place]) => place.map(Math.round)),
    [
      [30, 30],
      [40, 60],
    ],
  );
  const image = page.querySelector("img");
  for (const type of ["pointerdown", "pointerup", "click"]) point(image, type, 110, 220);
  assert.equal(chosen.at(-1).lists[1].length, 2);
});

test("a new point has the focus on the picture that was clicked, and the page stays where it is", () => {
  points();
  const focus = mock.method(HTMLElement.prototype, "focus");
  point(page.querySelectorAll("img")[1], "click", 110, 220);
  assert.ok(document.activeElement === dots(1)[1]);
  assert.deepEqual(focus.mock.calls.at(-1).arguments, [{ preventScroll: true }]);
  focus.mock.restore();
});

test("points at the same place, or at a corner, are put aside", () => {
  points();
  named("Add a point").click();
  named("Add a point").click();
  point(page.querySelector("img"), "click", 110, 220);
  point(page.querySelector("img"), "click", 10, 20);
  assert.deepEqual(
    chosen.at(-1).lists[0].map((place) => place.map((number) => Math.round(number) + 0)),
    [
      [20, 30],
      [50, 100],
      [60, 100],
      [70, 100],
      [10, 0],
    ],
  );
});

test("where a picture has no free place, a point comes where it was wanted", () => {
  points({ frames: [[-0.5, 1.5, -0.5, 1.5]], lists: [[]], first: [[]], blobs: [PNG], step: 5 });
  named("Add a point").click();
  assert.deepEqual(chosen[0].lists, [[[0.5, 0.5]]]);
});

test("the chosen point is taken away by a button", () => {
  const lists = [0, 1].map(() => [
    [20, 30],
    [60, 80],
  ]);
  points({ lists });
  named("Take this point away").click();
  assert.match(told(), /^Choose a point first/);
  dragged(dots(1)[1], [132, 182]);
  named("Take this point away").click();
  assert.deepEqual(chosen, [{ key: 7, lists: [[[20, 30]], [[20, 30]]] }]);
  assert.ok(document.activeElement === dots(1)[0]);
});

test("Undo takes back what was done, and steps of one point as one", () => {
  points();
  for (let i = 0; i < 3; i++) press(dots(0)[0], "ArrowRight");
  const moved = chosen.at(-1);
  named("Take all away").click();
  named("Add a point").click();
  named("The given ones again").click();
  const counts = [];
  for (let i = 0; i < 3; i++) {
    named("Undo").click();
    counts.push(dots(1).length);
  }
  assert.deepEqual(counts, [1, 0, 1]);
  assert.deepEqual(chosen.at(-1), moved);
  named("Undo").click();
  assert.equal(chosen.at(-1), null); // the given ones are no answer
  const { length } = chosen;
  named("Undo").click();
  assert.equal(told(), "There is nothing to undo.");
  assert.equal(chosen.length, length);
});

test("the given ones again are kept as no answer, also where those moved were of other pictures", () => {
  points();
  named("The given ones again").click();
  assert.deepEqual(chosen, [null]);
});

test("a screen reader is told after the last move, with values as of a slider", () => {
  points();
  mock.timers.tick(300);
  assert.equal(spoken(), "1 point on each picture.");
  const dot = dots(1)[0];
  assert.equal(dot.getAttribute("role"), "slider");
  assert.equal(dot.getAttribute("aria-valuetext"), "x 40.0, y 60.0");
  for (let i = 0; i < 9; i++) {
    press(dot, "ArrowRight");
    mock.timers.tick(299);
  }
  assert.equal(dot.getAttribute("aria-valuetext"), "x 40.0, y 60.0");
  mock.timers.tick(1);
  assert.equal(dot.getAttribute("aria-valuetext"), "x 49.0, y 60.0");
  assert.equal(dot.getAttribute("aria-valuenow"), "49.0");
  assert.equal(spoken(), "");
});

test("grips are smaller where there are many", () => {
  const lists = [0, 1].map(() => Array.from({ length: 17 }, (_, i) => [5 * i, 9]));
  points({ lists });
  const many = () => page.querySelectorAll(".run-many").length;
  assert.equal(many(), 2);
  press(dots(0)[0], "Delete");
  assert.equal(many(), 0);
});
