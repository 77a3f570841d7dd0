// Which tasks are done: noted in the reader's browser, shown on cards.

import { button, make } from "./elements.js";
import { keep, recall, watch } from "./store.js";

/** @param {string} task */
export function noteDone(task) {
  keep("done", { ...recall("done"), [task]: true });
  markDone();
}

/** The task that a card belongs to. @param {Element} card */
function taskOf(card) {
  const address = card.querySelector(".task-cards-title a")?.getAttribute("href") ?? location.pathname;
  return /task_(\d+)_(\d+)_/.exec(address)?.slice(1).join(".") ?? "";
}

/** Mark the cards of this page. */
export function markDone() {
  const done = recall("done") ?? {};
  for (const old of document.querySelectorAll(".run-done")) old.remove();
  const cards = [...document.querySelectorAll(".task-cards > li, .task-card")];
  const marked = cards.filter((card) => done[taskOf(card)]);
  for (const card of marked) card.append(make("p", { className: "run-done" }, "✓ Done in this browser"));
  const list = marked[0]?.closest(".task-cards");
  list?.before(make("p", { className: "run-done" }, button("Forget which tasks are done", forget)));
}

function forget() {
  keep("done", null);
  markDone();
}

watch("done", markDone);
