import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { test } from "node:test";
import { Delivery } from "./delivery.js";

const PLACE = "https://example.org/course/_run/12ab/";
const CONTENT = "0123456789";
const FILES = {
  "a.whl": [10, 10, createHash("sha256").update(CONTENT).digest("hex")],
  "b.wasm": [10, 5, createHash("sha256").update(CONTENT).digest("hex")],
};

/** @param {Response | (() => Response)} answer @param {string[]} [doubtful] */
function deliver(answer, doubtful) {
  /** @type {any[]} */
  const asked = [];
  const delivery = new Delivery(
    FILES,
    async (...request) => {
      asked.push(request);
      return typeof answer === "function" ? answer() : answer;
    },
    doubtful,
  );
  return { delivery, asked };
}

/** @param {Delivery} delivery @param {string} file @param {string} reason */
async function failed(delivery, file, reason) {
  await delivery.fetch(PLACE + file).then(
    (response) => response.text(),
    () => {},
  );
  await assert.rejects(delivery.failed, { reason, file });
}

test("a file comes, is counted and compared", async () => {
  const { delivery, asked } = deliver(new Response(CONTENT));
  const response = await delivery.fetch(`${PLACE}a.whl`, { integrity: "sha256-x" });
  assert.equal(delivery.awaited, 1);
  assert.equal(await response.text(), CONTENT);
  await delivery.whole("a.whl");
  assert.equal(delivery.done, 10);
  assert.equal(delivery.awaited, 0);
  assert.deepEqual(asked, [[`${PLACE}a.whl`, { cache: "default" }]]);
});

test("bytes are counted as they travel, whether the server compresses them or not", async () => {
  const { delivery } = deliver(new Response(CONTENT));
  await delivery.fetch(new Request(`${PLACE}b.wasm`));
  await delivery.checked();
  assert.equal(delivery.done, 5);
});

test("a wrong type of WebAssembly is put right", async () => {
  for (const type of ["text/plain", "application/wasm"]) {
    const { delivery } = deliver(new Response(CONTENT, { headers: { "Content-Type": type } }));
    const response = await delivery.fetch(`${PLACE}b.wasm`);
    assert.equal(response.headers.get("Content-Type"), "application/wasm");
    assert.equal(await response.text(), CONTENT);
  }
});

test("what is not of Python is left alone", async () => {
  const { delivery, asked } = deliver(new Response("x"));
  await delivery.fetch(`${PLACE}other`, { method: "POST" });
  assert.deepEqual(asked, [[`${PLACE}other`, { method: "POST" }]]);
  assert.equal(delivery.awaited, 0);
});

test("a file that the browser may hold wrong comes from the server", async () => {
  const { delivery, asked } = deliver(new Response(CONTENT), ["a.whl"]);
  await delivery.fetch(`${PLACE}a.whl`);
  assert.deepEqual(asked[0][1], { cache: "reload" });
});

const WRONG = { "other bytes": "9876543210", "fewer bytes": "0123", "more bytes": `${CONTENT} and more` };
for (const [kind, content] of Object.entries(WRONG)) {
  test(`${kind} are told`, async () => {
    await failed(deliver(new Response(content)).delivery, "a.whl", "changed");
  });
}

test("a missing file is told", async () => {
  await failed(deliver(new Response("", { status: 404 })).delivery, "a.whl", "missing");
});

test("a connection that is lost is told, at its beginning and midway", async () => {
  const none = () => {
    throw new TypeError("no network");
  };
  await failed(deliver(none).delivery, "a.whl", "lost");
  let count = 0;
  const read = async () => (count++ ? none() : { done: false, value: Buffer.from("0123") });
  const midway = { ok: true, clone: () => ({ body: { getReader: () => ({ read }) } }), text: async () => "" };
  await failed(deliver(/** @type {any} */ (midway)).delivery, "a.whl", "lost");
});

test("an address that is not secure has no hashes of the browser's", async (context) => {
  context.mock.getter(globalThis.crypto, "subtle", () => undefined);
  const { delivery } = deliver(new Response(CONTENT));
  await delivery.fetch(`${PLACE}a.whl`);
  await delivery.checked();
  await failed(deliver(new Response(WRONG["other bytes"])).delivery, "a.whl", "changed");
});
