import assert from "node:assert/strict";
import { test } from "node:test";
import { FakeWorker, show } from "./testing/page.mjs";

await import("./run.js");

const PAGE = `<canim-run data-file="task_1_1.py" data-block="interpolation">
  <template><pre>a = 1
b = 2  # TODO
</pre></template><p class="run-missing">Nothing runs here.</p></canim-run>`;

test("Run sends the program to Python, and shows what comes", async () => {
  const page = show(PAGE);
  page.querySelector(".run-main").click();
  await new Promise((resolve) => setTimeout(resolve));
  const [worker] = FakeWorker.made;
  assert.deepEqual(
    worker.orders.map(({ kind, code }) => [kind, code]),
    [
      ["load", "a = 1\nb = 2  # TODO\n"],
      ["run", "a = 1\nb = 2  # TODO\n"],
    ],
  );
  worker.tell("begin");
  worker.tell("text", { text: "3" });
  worker.tell("end", { text: "Your program ended after 0.1 s." });
  assert.equal(page.querySelector(".run-output pre").textContent, "3");
  assert.equal(page.querySelector(".run-status").textContent, "Your program ended after 0.1 s.");
});
