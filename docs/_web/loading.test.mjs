import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import "./testing/page.mjs";

const { explain, megabytes, packages, progress } = await import("./loading.js");
const { script, site } = await import("./site.js");
script.src += "?v=1";
const WORKER = "https://example.org/course/_run/12ab/worker.js";
/** @type {{[address: string]: Response | undefined}} */
let network;

beforeEach(() => {
  network = {};
  globalThis.fetch = async (address) => {
    const answer = network[address];
    if (!answer) throw new TypeError("no network");
    return answer.clone();
  };
});

const page = (/** @type {string} */ version) =>
  new Response(`<script defer src="../../_static/run.js?v=${version}"></script>`);
const told = async (/** @type {string} */ reason, file = "numpy.whl") =>
  (await explain({ reason, file }, WORKER)).words;

test("a program loads what its text asks for", () => {
  assert.deepEqual(packages("import numpy"), ["numpy", "canim"]);
  assert.deepEqual(packages("import scipy"), ["numpy", "canim", "scipy"]);
  assert.equal(megabytes("import numpy"), 12);
  assert.equal(megabytes("import scipy"), 17);
});

test("progress is told in MB, and never more than there is", () => {
  assert.equal(progress("", 0), "Python is loading: 0 of 12 MB.");
  assert.equal(progress("", 6_400_000), "Python is loading: 6 of 12 MB.");
  assert.equal(progress("scipy", 12_100_000), "Python is loading: 12 of 17 MB.");
  assert.equal(progress("", 12_000_000), "Python is starting …");
  assert.equal(progress("", 19_000_000), "Python is starting …");
});

test("each reason has a sentence that says what to do", async () => {
  for (const reason of ["lost", "silent", "missing", "changed", "memory", "start", "stopped"])
    assert.match(await told(reason), /press Run/i, reason);
  for (const reason of ["missing", "changed", "policy"]) assert.match(await told(reason), /Tell|tell your teacher/);
  assert.match(await told("missing"), /numpy\.whl is missing/);
  assert.doesNotMatch(await told("changed"), /\s\s|\n/);
});

test("a file that is missing or wrong on a site that was renewed wants the new page", async () => {
  for (const reason of ["missing", "changed"]) {
    network[location.href] = page("2");
    const { words, isRenewed } = await explain({ reason, file: "a.whl" }, WORKER);
    assert.match(words, /renewed.*Load the page again/);
    assert.equal(isRenewed, true);
    for (const same of [page("1"), new Response("Log in"), undefined]) {
      network[location.href] = same;
      assert.equal((await explain({ reason, file: "a.whl" }, WORKER)).isRenewed, false);
    }
  }
});

test("a worker without a script has a reason too", async () => {
  const answers = [
    [undefined, /connection was lost/],
    [new Response("", { status: 404 }), /worker\.js is missing/],
    [new Response("Log in", { headers: { "Content-Type": "text/html" } }), /worker\.js is not the right file/],
    [new Response("no", { headers: { "Content-Type": "text/javascript" } }), /does not start/],
  ];
  for (const [answer, words] of answers) {
    network[WORKER] = answer;
    assert.match(await told("script", ""), words);
  }
});

test("an old browser that cannot set a time is told the reason too", async (context) => {
  context.mock.method(AbortSignal, "timeout");
  Object.assign(AbortSignal, { timeout: undefined });
  network[WORKER] = new Response("", { status: 404 });
  assert.match(await told("script", ""), /worker\.js is missing/);
});

const forbid = (/** @type {object} */ violation) =>
  document.dispatchEvent(Object.assign(new Event("securitypolicyviolation"), violation));

test("what a policy only reports, or forbids to others, is no reason", async () => {
  forbid({ blockedURI: `${site.href}a`, disposition: "report" });
  forbid({ blockedURI: "https://other.org/a", disposition: "enforce" });
  assert.match(await told("lost"), /connection was lost/);
});

test("a policy that forbids the worker, or what it asks for, is the reason", async () => {
  network[WORKER] = new Response("no", { headers: { "Content-Type": "text/javascript" } });
  // As browsers do, after the request has failed.
  setTimeout(() => forbid({ blockedURI: `${site.href}_run/12ab/worker.js`, disposition: "enforce" }));
  assert.match(await told("script", ""), /does not let your browser run Python/);
  assert.match(await told("lost"), /does not let your browser run Python/);
});
