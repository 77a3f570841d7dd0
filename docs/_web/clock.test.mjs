import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { show } from "./testing/page.mjs";

mock.timers.enable({ apis: ["setInterval"] });
const { Clock } = await import("./clock.js");

let now = 0;
mock.method(performance, "now", () => now);
function pass(seconds) {
  now += 1000 * seconds;
  mock.timers.tick(1000 * seconds);
}

test("a long run shows how long it takes and how far it is, a short one does not", () => {
  const clock = new Clock();
  const page = show("");
  page.append(clock.element);
  clock.start();
  pass(1);
  clock.note("1 of 9");
  assert.equal(clock.element.hidden, true);
  pass(2);
  assert.equal(clock.element.hidden, false);
  assert.equal(clock.element.textContent, "3 s. 1 of 9");
  clock.note("Film: picture 12 of 30");
  assert.equal(clock.element.textContent, "3 s. Film: picture 12 of 30");
  clock.stop();
  pass(5);
  assert.equal(clock.element.hidden, true);
  clock.start();
  pass(4);
  assert.equal(clock.element.textContent, "4 s.");
  clock.stop();
});
