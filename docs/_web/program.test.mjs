// What is kept of a reader's program, when something else takes its place.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { FakeWorker, show } from "./testing/page.mjs";

await import("./run.js");
const { keep, recall } = await import("./store.js");

let program = "";
let tests = 0;
const STARTER = "a = 1\n";
let html = "";
const pageOf = (name) => `<canim-run data-file="${name}" data-pictures="640">
  <template><pre>${STARTER}</pre></template></canim-run>`;
const MINE = { text: "mine = 1", starter: STARTER, answers: { points: 3 } };
let page;
const back = () =>
  [...page.querySelectorAll("button")].find(({ textContent }) => textContent === "Take my program back");
const named = (name) => [...page.querySelectorAll("button")].find(({ textContent }) => textContent === name);
const text = () => page.querySelector(".run-whole").textContent;

/** What a browser does in this tab after another one has kept something. @param {any} value @param {any} replaced */
function toldOf(value, replaced) {
  const key = Object.keys(localStorage).find((name) => name.endsWith(program));
  keep(program, value);
  const event = new Event("storage");
  dispatchEvent(
    Object.assign(event, {
      key: key ?? Object.keys(localStorage).find((name) => name.endsWith(program)),
      oldValue: JSON.stringify(replaced),
      newValue: JSON.stringify(value),
    }),
  );
}

beforeEach(() => {
  localStorage.clear();
  // The elements of earlier tests still listen: each test has a program of its own.
  program = `task_${tests++}.py`;
  html = pageOf(program);
});

test("Start over puts the program aside, and it can be taken back, also after a reload", () => {
  keep(program, MINE);
  page = show(html);
  assert.equal(back().hidden, true);
  named("Start over").click();
  assert.equal(text(), STARTER);
  assert.deepEqual(recall(program).answers, {});
  page = show(html);
  assert.equal(text(), STARTER);
  back().click();
  assert.equal(text(), "mine = 1");
  assert.deepEqual(recall(program).answers, { points: 3 });
  assert.equal(back().hidden, true);
  assert.equal(page.querySelector(".run-status").textContent, "This is your program again.");
});

test("what is written after Start over is not lost when the first program is taken back", () => {
  keep(program, { ...MINE, text: "second", before: [{ text: "first", answers: {} }] });
  page = show(html);
  back().click();
  assert.equal(text(), "first");
  back().click();
  assert.equal(text(), "second");
});

test("a program stays to be taken back though Start over is pressed once more", () => {
  keep(program, { ...MINE, text: "a letter", before: [{ text: "mine", answers: {} }] });
  page = show(html);
  named("Start over").click();
  back().click();
  assert.equal(text(), "a letter");
  back().click();
  assert.equal(text(), "mine");
});

test("Start over does nothing to a starter that nobody has changed", () => {
  page = show(html);
  named("Start over").click();
  assert.equal(back().hidden, true);
  assert.equal(recall(program), null);
});

test("the new starter can be taken, and the program taken back", () => {
  keep(program, { ...MINE, starter: "an old one" });
  page = show(html);
  named("Take the new starter").click();
  assert.equal(page.querySelector(".run-notice").hidden, true);
  assert.equal(text(), STARTER);
  back().click();
  assert.equal(text(), "mine = 1");
});

test("a program that is kept is not asked about again", () => {
  keep(program, { ...MINE, starter: "an old one" });
  page = show(html);
  named("Keep my program").click();
  assert.equal(recall(program).starter, STARTER);
  assert.equal(text(), "mine = 1");
});

test("what another tab writes is shown", () => {
  keep(program, MINE);
  page = show(html);
  toldOf({ ...MINE, text: "mine = 12" }, MINE);
  assert.equal(text(), "mine = 12");
  assert.equal(back().hidden, true);
});

test("what another tab has written over without having seen it can be taken back", () => {
  keep(program, MINE);
  page = show(html);
  toldOf({ ...MINE, text: "theirs" }, { ...MINE, text: "older" });
  assert.equal(text(), "theirs");
  assert.equal(recall(program).before[0].text, "mine = 1"); // also after a reload
  back().click();
  assert.equal(text(), "mine = 1");
  assert.equal(recall(program).before[0].text, "theirs");
});

test("a tab that was not told of what another one wrote puts that aside", () => {
  keep(program, MINE);
  page = show(html);
  keep(program, { ...MINE, text: "theirs" });
  named("Start over").click(); // a change of this tab
  assert.equal(recall(program).before[0].text, "theirs");
});

test("points that were moved are kept, and every run is told of them", async () => {
  keep(program, MINE);
  page = show(html);
  Object.assign(URL, { createObjectURL: () => "blob:x", revokeObjectURL() {} });
  named("Run").click();
  await new Promise((resolve) => setTimeout(resolve));
  const worker = FakeWorker.made.at(-1);
  worker.tell("ready");
  await new Promise((resolve) => setTimeout(resolve));
  worker.tell("begin");
  const frame = [-0.5, 9.5, -0.5, 9.5];
  const lists = [[[2, 3]], [[4, 5]]];
  const blobs = [new Uint8Array(1), new Uint8Array(1)];
  worker.tell("points", { name: "points", frames: [frame, frame], lists, first: lists, step: 1, blobs });
  worker.tell("end", { text: "Your program ended." });
  named("Take all away").click();
  named("Run").click();
  await new Promise((resolve) => setTimeout(resolve));
  assert.deepEqual(JSON.parse(worker.orders.at(-1).answers).points.lists, [[], []]);
  worker.tell("begin");
  worker.tell("points", { name: "points", frames: [frame, frame], lists, first: lists, step: 1, blobs });
  worker.tell("end", { text: "Your program ended." });
  const runs = worker.orders.length;
  named("Run with these key points").click();
  await new Promise((resolve) => setTimeout(resolve));
  assert.equal(worker.orders.length, runs + 1);
  worker.tell("end", { text: "Your program ended." });
});

test("what an ended Python still says is not shown", async () => {
  page = show(html);
  named("Run").click();
  await new Promise((resolve) => setTimeout(resolve));
  const worker = FakeWorker.made.at(-1);
  worker.tell("begin");
  named("Stop").click();
  const { onerror } = worker;
  onerror?.({ message: "Uncaught NoGilError" });
  worker.tell("text", { text: "late" });
  assert.equal(page.querySelector(".run-status").textContent, "Stopped.");
  assert.doesNotMatch(page.textContent, /late|NoGil/);
  await new Promise((resolve) => setTimeout(resolve));
  FakeWorker.made.at(-1).tell("ready");
  assert.equal(page.querySelector(".run-status").textContent, "Stopped.");
});

test("a key that is typed does not reach a shortcut of the site; Ctrl+Enter runs the program", async () => {
  page = show(html);
  let reached = 0;
  document.addEventListener("keydown", () => reached++);
  const press = (key, options = {}) =>
    page
      .querySelector(".run-code pre")
      .dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...options }));
  press("/");
  press("Enter", { ctrlKey: true });
  assert.equal(reached, 0);
  await new Promise((resolve) => setTimeout(resolve));
  FakeWorker.made.at(-1).tell("ready");
  await new Promise((resolve) => setTimeout(resolve));
  assert.equal(FakeWorker.made.at(-1).orders.at(-1).kind, "run");
});

test("a copy of the whole page has the whole program, one within it is left alone", async () => {
  page = show(html);
  const run = page.querySelector("canim-run");
  let isAround = false;
  globalThis.getSelection = () => ({ containsNode: () => isAround });
  document.dispatchEvent(new Event("copy"));
  assert.equal(run.classList.contains("run-copied"), false);
  isAround = true;
  document.dispatchEvent(new Event("copy"));
  assert.equal(run.classList.contains("run-copied"), true);
  await new Promise((resolve) => setTimeout(resolve));
  assert.equal(run.classList.contains("run-copied"), false);
});
