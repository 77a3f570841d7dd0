// <canim-run>: the program of a task's page, with an editor, Run, and what the program shows.

import { button, make } from "./elements.js";
import { Film } from "./film.js";
import { keepOffline } from "./offline.js";
import { Points } from "./points.js";
import { markDone, noteDone } from "./progress.js";
import { Python } from "./python.js";
import { keep, recall, watch } from "./store.js";

/** @typedef {import("./python.js").Message} Message */

const script = /** @type {HTMLScriptElement} */ (document.currentScript);
const site = new URL("../", script.src);

/** Return why programs cannot run here, "" where they can. */
function hindrance() {
  if (location.protocol === "file:")
    return "Programs cannot run here, because this page was opened from a folder. On the course's web site they can.";
  if (typeof WebAssembly !== "object" || !("Worker" in window))
    return "Programs cannot run here: this browser has no WebAssembly. A newer one has it.";
  return "";
}

/** @param {string} program */
function packages(program) {
  return [...RUN.first, ...Object.keys(RUN.needs).filter((name) => new RegExp(RUN.needs[name]).test(program))];
}

/** @param {string} program */
function megabytes(program) {
  const parts = ["first", ...packages(program)];
  return Math.ceil(parts.reduce((sum, name) => sum + (RUN.bytes[name] ?? 0), 0) / 1e6);
}

class Run extends HTMLElement {
  #name = "";
  #starter = "";
  #text = "";
  #state = "idle"; // or "loading", when Run waits for Python; "running"
  #again = false;
  /** @type {Promise<void> | undefined} */
  offline;
  /** @type {{[kind: string]: any}} what the reader has answered to the program */
  #answers = {};
  /** @type {{name: string, bytes: Uint8Array}[]} */
  #files = [];
  /** @type {Map<string | number, Film>} */
  #films = new Map();
  /** @type {Promise<ReturnType<typeof import("./editor.js").edit>> | undefined} */
  #editor;

  connectedCallback() {
    const reason = hindrance();
    if (reason) {
      const missing = this.querySelector(".run-missing");
      if (missing) missing.textContent = reason;
      return;
    }
    const code = /** @type {HTMLTemplateElement} */ (this.querySelector("template")).content.firstElementChild;
    this.#name = this.dataset.file ?? "";
    this.#text = this.#starter = code?.textContent ?? "";
    this.python = new Python(new URL(`${RUN.folder}worker.js`, site).href, (message) => this.#hear(message));
    this.#build(/** @type {HTMLElement} */ (code));
    this.#recall();
    watch(this.#name, (kept) => kept && this.#write(kept.text));
  }

  /** @param {HTMLElement} code the starter, coloured */
  #build(code) {
    this.run = button("Run", () => this.#start(), "run-main");
    this.stop = button("Stop", () => this.#stop("Stopped."));
    this.stop.disabled = true;
    const bar = make(
      "div",
      { className: "run-bar", role: "group", "aria-label": "The program" },
      this.run,
      this.stop,
      button("Start over", () => confirm("Take the starter again? Your own program is lost.") && this.#startOver()),
      button("Download .py", () => save(this.#name, [this.#text])),
    );
    if (this.dataset.block === "warping") bar.append(this.#pictures());
    this.status = make("p", { className: "run-status", role: "status" });
    this.status.textContent = `Python runs here, in your browser. The first Run loads ${megabytes(this.#starter)} MB.`;
    this.notice = make("div", { className: "run-notice", hidden: true });
    this.code = make("div", { className: "run-code" }, code);
    this.printed = make("pre", { tabIndex: 0 });
    this.shown = make("div");
    this.output = make("div", { className: "run-output", role: "log", "aria-label": "What the program shows" });
    this.asked = make("div");
    this.output.append(this.shown);
    const keys = make(
      "p",
      { className: "run-keys" },
      "Ctrl+Enter runs the program. Escape, then Tab, leaves the editor.",
    );
    this.replaceChildren(this.notice, this.code, keys, bar, this.status, this.asked, this.output);
    this.#lookAt();
    this.code.addEventListener("pointerenter", () => this.#edit());
    bar.addEventListener("pointerenter", () => this.#prepare());
    this.addEventListener("focusin", () => {
      this.#edit();
      this.#prepare();
    });
    this.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey) && !event.defaultPrevented) this.#start();
    });
  }

  #pictures() {
    const input = make("input", { type: "file", multiple: true, accept: "image/*", className: "run-file" });
    input.onchange = async () => {
      const added = [...(input.files ?? [])];
      for (const file of added) {
        const bytes = new Uint8Array(await file.arrayBuffer());
        this.#files = [...this.#files.filter((f) => f.name !== file.name), { name: file.name, bytes }];
      }
      const calls = added.map((file) => `canim.data.read_image("${file.name}")`);
      this.#say(`Your program can use ${calls.join(" and ")}, until this page is closed.`);
    };
    return make("label", { className: "run-pictures" }, "Add pictures", input);
  }

  // -- The text ------------------------------------------------------------

  #recall() {
    const kept = recall(this.#name);
    if (!kept) return;
    this.#answers = kept.answers ?? {};
    if (kept.text !== this.#starter) this.#write(kept.text);
    if (kept.starter === this.#starter || kept.text === this.#starter) return;
    const choose = (/** @type {string} */ text) => {
      this.notice?.setAttribute("hidden", "");
      this.#write(text);
      this.#keep();
      this.run?.focus();
    };
    this.notice?.replaceChildren(
      make("p", {}, "The starter of this page is a new one since you began. You see your own program."),
      button("Keep my program", () => choose(this.#text)),
      button("Take the new starter", () => choose(this.#starter)),
    );
    this.notice?.removeAttribute("hidden");
  }

  #keep() {
    const kept = keep(this.#name, { text: this.#text, starter: this.#starter, answers: this.#answers });
    if (!kept) this.#say("This browser does not keep your program: download it before you leave.");
  }

  /** @param {string} text */
  #write(text) {
    if (text === this.#text) return;
    this.#text = text;
    if (this.#editor) this.#editor.then((editor) => editor.replace(text));
    else this.code?.replaceChildren(make("pre", { tabIndex: 0 }, text));
  }

  #startOver() {
    this.#answers = {};
    this.#write(this.#starter);
    keep(this.#name, null);
    this.#say("This is the starter again.");
  }

  /** Scroll the program to a line. */
  #lookAt(line = this.#text.split("\n").findIndex((text) => text.includes("# TODO"))) {
    const code = /** @type {HTMLElement} */ (this.code);
    const box = code.querySelector(".cm-scroller") ?? code;
    box.scrollTop = (box.scrollHeight * line) / this.#text.split("\n").length - box.clientHeight / 2;
  }

  /** Put the editor in place of the text. */
  #edit() {
    this.#editor ??= (async () => {
      const { edit } = await import(new URL(`editor.js${new URL(script.src).search}`, script.src).href);
      const code = /** @type {HTMLElement} */ (this.code);
      const hadFocus = code.contains(document.activeElement);
      code.replaceChildren();
      const editor = edit(code, this.#text, {
        run: () => this.#start(),
        changed: (/** @type {string} */ text) => {
          this.#text = text;
          this.#keep();
        },
      });
      this.#lookAt();
      if (hadFocus) editor.focus();
      return editor;
    })();
  }

  // -- Python --------------------------------------------------------------

  /** @param {"load" | "run"} kind */
  async #order(kind) {
    await (this.offline ??= keepOffline(site));
    if (kind === "run" && this.#state === "idle") return; // Stop was quicker
    const answers = JSON.stringify(this.#answers);
    const order = { kind, code: this.#text, name: this.#name, files: this.#files, answers };
    this.python?.send({ ...order, packages: packages(this.#text) });
  }

  #prepare() {
    if (this.prepared) return;
    this.prepared = true;
    this.#say(`Python is loading, ${megabytes(this.#text)} MB the first time. You can edit while it does.`);
    this.#order("load");
  }

  #start() {
    if (this.#state === "running") {
      this.#again = true;
      return;
    }
    if (this.#state === "loading") return;
    this.#state = this.python?.isReady ? "running" : "loading";
    if (this.stop) this.stop.disabled = false;
    this.#prepare();
    this.#say(
      this.python?.isReady
        ? "Running …"
        : `Python is loading, ${megabytes(this.#text)} MB the first time. Then your program runs.`,
    );
    this.status?.scrollIntoView({ block: "nearest" });
    this.#order("run");
  }

  /** @param {string} words */
  #stop(words) {
    this.python?.end();
    this.#films.forEach((film) => film.complete());
    this.#ended(words);
    this.#order("load"); // a new Python, from what the browser has kept
  }

  /** @param {string} words */
  #ended(words) {
    this.#state = "idle";
    if (this.stop) this.stop.disabled = true;
    this.output?.removeAttribute("aria-busy");
    this.#say(words);
    if (this.#again) {
      this.#again = false;
      this.#start();
    }
  }

  /** @param {string} words */
  #say(words) {
    if (this.status) this.status.textContent = words;
  }

  // -- What Python tells ---------------------------------------------------

  /** @param {Message} message */
  #hear(message) {
    const { kind, blobs } = message;
    if (kind === "ready") {
      if (this.#state === "idle" && this.status?.textContent?.startsWith("Python is loading"))
        this.#say("Python is ready.");
    } else if (kind === "begin") this.#begin();
    else if (kind === "text") this.#print(message.text);
    else if (kind === "figure") this.#show(message, blobs[0]);
    else if (kind === "frame") this.#films.get(message.film)?.add(blobs[0], message.interval);
    else if (kind === "frames end") this.#films.get(message.film)?.complete();
    else if (kind === "report") this.#report(message);
    else if (kind === "crash") this.#crash(message);
    else if (kind === "file")
      this.shown?.append(
        make(
          "p",
          {},
          button(`Save ${message.name}`, () => save(message.name, blobs)),
        ),
      );
    else if (kind === "points")
      this.asked?.append(new Points(message, (chosen) => this.#answer(message.name, chosen)).element);
    else if (kind === "question") this.#question(message.text);
    else if (kind === "end") this.#end(message);
    else if (kind === "failed") this.#stop(`Python has stopped, and a new one is loading. ${message.text}`);
  }

  #begin() {
    this.#state = "running";
    this.#say("Running …");
    this.#films.clear();
    this.output?.setAttribute("aria-busy", "true");
    this.printed?.replaceChildren();
    this.printed?.remove();
    this.shown?.replaceChildren();
    this.asked?.replaceChildren();
    this.#editor?.then((editor) => editor.mark(0));
  }

  /** @param {string} text */
  #print(text) {
    const printed = /** @type {HTMLElement} */ (this.printed);
    printed.append(text);
    if (!printed.isConnected) this.output?.prepend(printed);
  }

  /** @param {Message} message @param {Uint8Array<ArrayBuffer>} png */
  #show({ alt, width, height, film }, png) {
    const src = URL.createObjectURL(new Blob([png], { type: "image/png" }));
    const image = make("img", { src, alt, width, height, onload: () => URL.revokeObjectURL(src) });
    if (film) this.#films.set(film, new Film(image));
    this.shown?.append(make("figure", { className: "picture" }, this.#films.get(film)?.element ?? image));
  }

  /** @param {Message} report */
  #report({ html, task, done }) {
    const place = make("div");
    place.innerHTML = html; // made by canim.checks, which escapes what comes from the program
    this.shown?.append(place);
    if (done) noteDone(task);
  }

  /** @param {Message} crash */
  #crash({ text, line }) {
    this.shown?.prepend(make("pre", { className: "run-crash", tabIndex: 0 }, text));
    if (!line) return;
    this.#editor?.then((editor) => editor.mark(line));
    this.#lookAt(line);
  }

  /** @param {string} prompt */
  #question(prompt) {
    const field = make("input", { type: "text" });
    const form = make("form", { className: "run-bar" });
    form.onsubmit = (event) => {
      event.preventDefault();
      const texts = [...(this.#answers.texts ?? []), field.value];
      this.#answer("texts", texts);
    };
    form.append(
      make("label", {}, prompt || "The program asks for a text with input():", " ", field),
      make("button", {}, "Answer"),
    );
    this.asked?.append(form);
    field.focus();
  }

  /** @param {string} name @param {any} answer */
  #answer(name, answer) {
    this.#answers[name] = answer;
    this.#keep();
    this.#start();
  }

  /** @param {Message} end */
  #end({ state, seconds }) {
    const time = seconds < 0.05 ? "" : ` after ${seconds.toFixed(1)} s`;
    if (state !== "asked") delete this.#answers.texts;
    this.#ended(
      state === "crashed"
        ? `Your program stopped${time}. Below it says why.`
        : state === "asked"
          ? "Your program waits for an answer."
          : `Your program ended${time}.`,
    );
  }
}

/** Hand a file to the reader. @param {string} name @param {BlobPart[]} content */
function save(name, content) {
  const href = URL.createObjectURL(new Blob(content));
  make("a", { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), 10_000);
}

customElements.define("canim-run", Run);
markDone();
