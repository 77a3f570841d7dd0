import assert from "node:assert/strict";
import { test } from "node:test";
import { show } from "./testing/page.mjs";

const { markDone, noteDone } = await import("./progress.js");

const CARDS = `<ul class="task-cards">
  <li><p class="task-cards-title"><a href="task_1_1_plot_hermite_basis.html">Task 1.1</a></p></li>
  <li><p class="task-cards-title"><a href="task_1_2_other.html">Task 1.2</a></p></li></ul>`;
const marked = (/** @type {Element} */ page) =>
  [...page.querySelectorAll("li:has(.run-done) a")].map(({ textContent }) => textContent);

test("tasks that are done are marked, in this tab and in others, until they are forgotten", () => {
  const page = show(CARDS);
  noteDone("1.1");
  assert.deepEqual(marked(page), ["Task 1.1"]);
  noteDone("1.2");
  markDone();
  assert.deepEqual(marked(page), ["Task 1.1", "Task 1.2"]);
  assert.equal(page.querySelectorAll("button").length, 1);
  page.querySelector("button")?.click();
  assert.deepEqual(marked(page), []);
  assert.equal(page.querySelector("button"), null);
});

test("the page of a task marks its own card", () => {
  const page = show('<div class="task-card"></div>');
  noteDone("1.1");
  assert.match(page.textContent ?? "", /Done in this browser/);
});
