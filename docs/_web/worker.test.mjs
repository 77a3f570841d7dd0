// The worker with a Pyodide made up for it, which asks for its files as the true one does.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { registerHooks } from "node:module";
import { beforeEach, test } from "node:test";

const SCRIPT = "globalThis._createPyodideModule = async () => globalThis.createModule();";
const made = (/** @type {string} */ url, /** @type {string} */ source) => ({
  url,
  format: "module",
  shortCircuit: true,
  source,
});
registerHooks({
  resolve: (name, context, next) =>
    /^pyodide$|asm\.js$|\.py$/.test(name) ? { url: `made:${name}`, shortCircuit: true } : next(name, context),
  load(url, context, next) {
    if (url === "made:pyodide")
      return made(url, "export const loadPyodide = (...given) => globalThis.loadPyodide(...given);");
    if (url.endsWith("asm.js")) return made(url, SCRIPT);
    return url.endsWith(".py") ? made(url, "export default 'program';") : next(url, context);
  },
});

const entry = (/** @type {string} */ text) => [
  text.length,
  text.length,
  createHash("sha256").update(text).digest("hex"),
];
/** @type {{[name: string]: string | undefined}} what the server has */
let network;
/** @type {any[]} */
let told;
/** @type {any[]} what there is to keep for later */
const loaded = [];
/** @type {any} what goes wrong in Pyodide */
let wrong;
/** @type {string[]} */
let calls;
let number = 0;

const python = {
  begin: (/** @type {Function} */ post) => {
    python.post = post;
  },
  keep_file: (/** @type {string} */ name) => calls.push(`keep ${name}`),
  run: (/** @type {string} */ code, _, __, /** @type {boolean} */ last) => {
    calls.push(`run ${last}`);
    if (code === "breaks") throw new RangeError("stack");
    if (code === "imports" && !last) return "scipy";
    python.post("end", "{}", { toJs: () => [] });
  },
};
const fetchAll = (/** @type {string[]} */ names) =>
  Promise.all(
    names.map((name) =>
      self
        .fetch(`https://example.org/${name}.whl`)
        .then((answer) => answer.text())
        .catch(() => {}),
    ),
  );
const pyodide = {
  runPython() {},
  toPy: (/** @type {any} */ value) =>
    "__name__" in value ? { get: (/** @type {string} */ name) => python[name] } : value,
  loadPackage: fetchAll,
  loadPackagesFromImports: async (/** @type {string} */ code) => {
    if (code === "not Python") throw new SyntaxError("no");
    if (code === "import scipy") await fetchAll(["scipy"]);
  },
};

Object.assign(globalThis, {
  self: globalThis,
  location: { href: "https://example.org/0/worker.js" },
  postMessage: (/** @type {any} */ message) => (message.kind === "loaded" ? loaded : told).push(message),
  RUN: {
    env: {},
    files: { "pyodide.asm.js": entry("js"), "a.wasm": entry("wasm"), "numpy.whl": entry("n"), "scipy.whl": entry("s") },
  },
  createModule() {
    if (wrong?.where === "script") throw wrong;
  },
  loadPyodide: async ({ indexURL, packages }) => {
    await /** @type {any} */ (globalThis)._createPyodideModule({});
    WebAssembly.instantiateStreaming(self.fetch(`${indexURL}a.wasm`), {}).catch(() => {}); // it says nothing
    if (wrong || network["a.wasm"] !== "wasm") await new Promise(() => {});
    await fetchAll(packages);
    return pyodide;
  },
});
const ask = async (/** @type {any} */ address) => {
  const content = network[String(address).split("/").pop() ?? ""];
  return content === undefined ? new Response("", { status: 404 }) : new Response(content);
};
const compile = async (/** @type {any} */ source) => {
  if (wrong?.where === "WebAssembly") throw wrong;
  if ((await (await source).text()) !== "wasm") throw new WebAssembly.CompileError("magic word");
};
let isAllowed = true;
class Module {
  constructor() {
    if (!isAllowed) throw new WebAssembly.CompileError("blocked by Content Security Policy");
  }
}
Object.assign(globalThis, { fetch: ask });
Object.assign(WebAssembly, { instantiateStreaming: compile, Module });
const { Interpreter } = await import("./worker.js");

beforeEach(() => {
  told = [];
  calls = [];
  wrong = undefined;
  network = { "pyodide.asm.js": "js", "a.wasm": "wasm", "numpy.whl": "n", "scipy.whl": "s" };
});

/** @type {InstanceType<typeof Interpreter>} */
let interpreter;

/** Let a new interpreter obey; return what it tells at last. @param {object} [given] */
async function obey(given) {
  interpreter = new Interpreter([]);
  location.href = `https://example.org/${++number}/worker.js`; // its script is imported once
  return order(given);
}

/** @param {object} [given] */
async function order(given) {
  const before = told.length;
  interpreter.obey({ packages: ["numpy"], files: [], name: "", code: "", answers: "{}", ...given });
  while (told.length === before) await new Promise((resolve) => setTimeout(resolve));
  return told.at(-1);
}

test("it loads, runs, and tells how far it is", async () => {
  const say = (/** @type {object} */ data) =>
    self.onmessage?.(/** @type {any} */ ({ data: { doubtful: [], ...data } }));
  say({ kind: "ask" });
  assert.deepEqual(told.pop(), { kind: "progress", done: 0, waits: "start", blobs: [] });
  say({ kind: "load", packages: ["numpy"] });
  while (!told.length) await new Promise((resolve) => setTimeout(resolve));
  assert.equal(told.pop().kind, "ready");
  say({ kind: "ask" });
  assert.deepEqual(told.pop(), { kind: "progress", done: 7, waits: "", blobs: [] });

  assert.equal((await obey({ files: [{ name: "a.png", bytes: [] }] })).kind, "end");
  assert.deepEqual(calls, ["keep a.png", "run false"]);
});

test("what a program imports unseen is loaded, and it runs again", async () => {
  assert.equal((await obey({ code: "imports" })).kind, "end");
  assert.deepEqual(calls, ["run false", "run true"]);
  assert.equal((await obey({ code: "not Python" })).kind, "end");
});

test("the addresses of all that was loaded are told, each time that there are more", async () => {
  await obey();
  loaded.length = 0;
  await order({ code: "import numpy" });
  await order({ code: "import scipy" });
  await order();
  const names = ["worker.js", "pyodide.asm.js", "a.wasm", "numpy.whl", "scipy.whl"];
  assert.deepEqual(
    loaded.map(({ addresses }) => addresses),
    [names.map((name) => new URL(name, location.href).href)],
  );
});

test("a package that is missing or wrong is told, and no program runs without it", async () => {
  network["numpy.whl"] = undefined;
  const { kind, reason, file } = await obey();
  assert.deepEqual([kind, reason, file], ["failed", "missing", "numpy.whl"]);
  network = { ...network, "numpy.whl": "n", "scipy.whl": "wrong" };
  assert.equal((await obey({ packages: ["numpy", "scipy"] })).reason, "changed");
  network["scipy.whl"] = undefined;
  assert.equal((await obey({ code: "imports" })).reason, "missing");
  assert.deepEqual(calls, ["run false"]);
});

test("Python's own files are told too, where Pyodide would wait for ever", async () => {
  network["a.wasm"] = "log in";
  const { reason, file } = await obey({ kind: "load" });
  assert.deepEqual([reason, file], ["changed", "a.wasm"]);
  network["pyodide.asm.js"] = undefined;
  assert.equal((await obey({ kind: "load" })).file, "pyodide.asm.js");
});

test("a policy against WebAssembly is told", async () => {
  isAllowed = false;
  assert.equal((await obey()).reason, "policy");
  isAllowed = true;
});

test("too little memory is told, and what is not known", async () => {
  for (const [error, reason] of /** @type {const} */ ([
    [new RangeError("could not allocate memory"), "memory"],
    [new Error("MemoryError"), "memory"],
    [new Error("no idea"), "start"],
  ])) {
    for (const where of ["script", "WebAssembly"]) {
      wrong = Object.assign(error, { where });
      assert.equal((await obey()).reason, reason);
    }
  }
});

test("a Python that breaks while it runs has stopped", async () => {
  assert.equal((await obey({ code: "breaks" })).reason, "stopped");
});
