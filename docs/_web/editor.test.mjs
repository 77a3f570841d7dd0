import assert from "node:assert/strict";
import { test } from "node:test";
import { show } from "./testing/page.mjs";

const { edit } = await import("./editor.js");

test("the line that stopped the program is marked until the text changes", () => {
  const page = show("");
  /** @type {string[]} */
  const texts = [];
  const editor = edit(
    page,
    "a = 1\nb = 2\n",
    0,
    (text) => texts.push(text),
    () => {},
  );
  const marked = () => [...page.querySelectorAll(".run-crashed")].map(({ textContent }) => textContent);
  editor.mark(2);
  assert.deepEqual(marked(), ["b = 2"]);
  editor.mark(0);
  assert.deepEqual(marked(), []);
  editor.mark(99);
  assert.deepEqual(marked(), []);
  editor.mark(1);
  editor.replace("c = 3\n");
  assert.deepEqual(marked(), []);
  assert.deepEqual(texts, ["c = 3\n"]);
});

test("Ctrl+Enter in the editor runs the program", () => {
  const page = show("");
  let count = 0;
  const editor = edit(
    page,
    "",
    0,
    () => {},
    () => count++,
  );
  editor.focus();
  const keys = { key: "Enter", ctrlKey: true, keyCode: 13, bubbles: true, cancelable: true };
  page.querySelector(".cm-content")?.dispatchEvent(new KeyboardEvent("keydown", keys));
  assert.equal(count, 1);
});
