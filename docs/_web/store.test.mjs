import assert from "node:assert/strict";
import { test } from "node:test";
import "./testing/page.mjs";

const { keep, recall } = await import("./store.js");

test("what is kept is there again, until it is taken away", () => {
  assert.equal(recall("a"), null);
  assert.equal(keep("a", { text: "x" }), true);
  assert.deepEqual(recall("a"), { text: "x" });
  keep("a", null);
  assert.equal(recall("a"), null);
});
