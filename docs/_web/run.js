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
function loads(program) {
  const bytes = ["first", ...packages(program)].map((name) => RUN.bytes[name] ?? 0);
  return `${Math.ceil(bytes.reduce((sum, more) => sum + more) / 1e6)} MB`;
}

/** Hand a file to the reader. @param {string} name @param {BlobPart[]} content */
function save(name, content) {
  const href = URL.createObjectURL(new Blob(content));
  make("a", { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), 10_000);
}

class Run extends HTMLElement {
  #name = this.dataset.file ?? "";
  #starter = "";
  #text = "";
  #state = "idle"; // or "loading", when Run waits for Python; "running"
  #again = false;
  #prepared = false;
  /** @type {{[kind: string]: any}} what the reader has answered to the program */
  #answers = {};
  /** @type {string[]} what input() gets in this run */
  #texts = [];
  /** @type {{name: string, bytes: Uint8Array}[]} */
  #files = [];
  /** @type {Map<string | number, Film>} */
  #films = new Map();
  /** @type {ReturnType<typeof import("./editor.js").edit> | undefined} */
  #editor;
  /** @type {Promise<void> | undefined} */
  #offline;
  #python = new Python(new URL(`${RUN.folder}worker.js`, site).href, (message) => this.#hear(message));

  #code = make("div", { className: "run-code" });
  #notice = make("div", { className: "run-notice", hidden: true });
  #stop = button("Stop", () => this.#end("Stopped."));
  #status = make("p", { className: "run-status", role: "status" });
  #asked = make("div");
  #printed = make("pre", { tabIndex: 0 });
  #shown = make("div");
  #output = make("div", { className: "run-output", role: "log", "aria-label": "What the program shows" }, this.#shown);

  connectedCallback() {
    const reason = hindrance();
    if (reason) {
      this.querySelector(".run-missing")?.replaceChildren(reason);
      return;
    }
    const code = this.querySelector("template")?.content.firstElementChild;
    this.#text = this.#starter = code?.textContent ?? "";
    this.#code.append(code ?? "");
    this.#stop.disabled = true;
    this.#say(`Python runs here, in your browser. The first Run loads ${loads(this.#starter)}.`);
    const bar = make("div", { className: "run-bar", role: "group", "aria-label": "The program" }, this.#stop);
    bar.prepend(button("Run", () => this.#run(), "run-main"));
    bar.append(
      button("Start over", () => confirm("Take the starter again? Your program will be lost.") && this.#startOver()),
    );
    bar.append(button("Download .py", () => save(this.#name, [this.#text])));
    if (this.dataset.block === "warping") bar.append(this.#pictures());
    const keys = "Ctrl+Enter runs the program. Escape, then Tab, leaves the editor.";
    this.replaceChildren(this.#notice, this.#code, make("p", { className: "run-keys" }, keys), bar);
    this.append(this.#status, this.#asked, this.#output);
    this.#lookAt();
    this.#code.onpointerenter = () => this.#edit();
    bar.onpointerenter = () => this.#prepare();
    this.addEventListener("focusin", () => {
      this.#edit();
      this.#prepare();
    });
    this.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey) && !event.defaultPrevented) this.#run();
    });
    this.#recall();
    watch(this.#name, (kept) => kept && this.#write(kept.text));
  }

  #pictures() {
    const input = make("input", { type: "file", multiple: true, accept: "image/*", className: "run-file" });
    input.onchange = async () => {
      const calls = [];
      for (const file of input.files ?? []) {
        this.#files.push({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
        calls.push(`canim.data.read_image("${file.name}")`);
      }
      this.#say(`Your program can use ${calls.join(" and ")}, until this page is closed.`);
    };
    return make("label", { className: "run-pictures" }, "Add pictures", input);
  }

  #recall() {
    const kept = recall(this.#name);
    if (!kept) return;
    this.#answers = kept.answers;
    this.#write(kept.text);
    if (kept.starter === this.#starter || kept.text === this.#starter) return;
    const choose = (/** @type {string} */ text) => {
      this.#notice.hidden = true;
      this.#write(text);
      this.#keep();
    };
    this.#notice.append(
      make("p", {}, "The starter of this page is a new one since you began. You see your own program."),
      button("Keep my program", () => choose(this.#text)),
      button("Take the new starter", () => choose(this.#starter)),
    );
    this.#notice.hidden = false;
  }

  #keep() {
    const kept = keep(this.#name, { text: this.#text, starter: this.#starter, answers: this.#answers });
    if (!kept) this.#say("This browser does not keep your program: download it before you leave.");
  }

  /** @param {string} text */
  #write(text) {
    if (text === this.#text) return;
    this.#text = text;
    if (this.#editor) this.#editor.replace(text);
    else this.#code.replaceChildren(make("pre", { tabIndex: 0 }, text));
  }

  #startOver() {
    this.#answers = {};
    this.#write(this.#starter);
    keep(this.#name, null);
    this.#say("This is the starter again.");
  }

  /** Scroll the program to a line. */
  #lookAt(line = this.#text.split("\n").findIndex((text) => text.includes("# TODO"))) {
    const box = this.#code.querySelector(".cm-scroller") ?? this.#code;
    box.scrollTop = (box.scrollHeight * line) / this.#text.split("\n").length - box.clientHeight / 2;
  }

  /** Put the editor in place of the text. */
  async #edit() {
    const { edit } = await import(new URL(`editor.js${new URL(script.src).search}`, script.src).href);
    if (this.#editor) return;
    const hadFocus = this.#code.contains(document.activeElement);
    this.#code.replaceChildren();
    const changed = (/** @type {string} */ text) => {
      this.#text = text;
      this.#keep();
    };
    this.#editor = edit(this.#code, this.#text, changed, () => this.#run());
    this.#lookAt();
    if (hadFocus) this.#editor?.focus();
  }

  /** @param {"load" | "run"} kind */
  async #order(kind) {
    await (this.#offline ??= keepOffline(site));
    if (kind === "run" && this.#state === "idle") return; // Stop was quicker
    const order = { kind, code: this.#text, name: this.#name, files: this.#files };
    const answers = JSON.stringify({ ...this.#answers, texts: this.#texts });
    this.#python.send({ ...order, packages: packages(this.#text), answers });
  }

  #prepare() {
    if (this.#prepared) return;
    this.#prepared = true;
    this.#say(`Python is loading, ${loads(this.#text)} the first time. You can edit while it does.`);
    this.#order("load");
  }

  #run(texts = /** @type {string[]} */ ([])) {
    if (this.#state !== "idle") {
      this.#again = this.#state === "running";
      return;
    }
    this.#texts = texts;
    this.#prepare();
    this.#state = this.#python.isReady ? "running" : "loading";
    this.#say(this.#python.isReady ? "Running …" : `Python is loading, ${loads(this.#text)} the first time.`);
    this.#stop.disabled = false;
    this.#status.scrollIntoView({ block: "nearest" });
    this.#order("run");
  }

  /** End what runs, and load a new Python, from what the browser has kept. @param {string} words */
  #end(words) {
    this.#again = false;
    this.#python.end();
    for (const film of this.#films.values()) film.isComplete = true;
    this.#ended(words);
    this.#order("load");
  }

  /** @param {string} words */
  #ended(words) {
    this.#state = "idle";
    this.#stop.disabled = true;
    this.#output.removeAttribute("aria-busy");
    this.#say(words);
    if (this.#again) this.#run();
    this.#again = false;
  }

  /** @param {string} words */
  #say(words) {
    this.#status.textContent = words;
  }

  /** @param {Message} message */
  #hear(message) {
    const { kind, text, blobs } = message;
    if (kind === "ready" && this.#state === "idle") this.#say("Python is ready.");
    else if (kind === "begin") this.#begin();
    else if (kind === "text") this.#print(text);
    else if (kind === "figure") this.#show(message);
    else if (kind === "frame") this.#films.get(message.film)?.add(blobs, message.interval);
    else if (kind === "report") this.#report(message);
    else if (kind === "crash") this.#crash(message);
    else if (kind === "file") this.#shown.append(button(`Save ${message.name}`, () => save(message.name, blobs)));
    else if (kind === "points") this.#points(message);
    else if (kind === "question") this.#question(text);
    else if (kind === "end") this.#ended(text);
    else if (kind === "failed") {
      this.#python.end();
      this.#prepared = false;
      this.#ended(`Python has stopped. Press Run to begin again. ${text}`);
    }
  }

  #begin() {
    this.#state = "running";
    this.#say("Running …");
    this.#films.clear();
    this.#output.setAttribute("aria-busy", "true");
    this.#printed.remove();
    for (const old of [this.#printed, this.#shown, this.#asked]) old.replaceChildren();
    this.#editor?.mark(0);
  }

  /** @param {string} text */
  #print(text) {
    this.#printed.append(text);
    if (!this.#printed.isConnected) this.#output.prepend(this.#printed);
  }

  /** @param {Message} figure */
  #show({ alt, width, height, film, blobs }) {
    const src = URL.createObjectURL(new Blob(blobs, { type: "image/png" }));
    const image = make("img", { src, alt, width, height, onload: () => URL.revokeObjectURL(src) });
    if (film) this.#films.set(film, new Film(image));
    this.#shown.append(make("figure", { className: "picture" }, this.#films.get(film)?.element ?? image));
  }

  /** @param {Message} report */
  #report({ html, task, done }) {
    const place = make("div");
    place.innerHTML = html; // made by canim.checks, which escapes what comes from the program
    this.#shown.append(place);
    if (done) noteDone(task);
  }

  /** @param {Message} crash */
  #crash({ text, line }) {
    this.#shown.prepend(make("pre", { className: "run-crash", tabIndex: 0 }, text));
    if (!line) return;
    this.#editor?.mark(line);
    this.#lookAt(line);
  }

  /** @param {Message} message */
  #points(message) {
    const use = (/** @type {any} */ chosen) => {
      this.#answers[message.name] = chosen;
      this.#keep();
      this.#run();
    };
    this.#asked.append(new Points(message, use).element);
  }

  /** @param {string} prompt */
  #question(prompt) {
    const field = make("input", { type: "text" });
    const label = make("label", {}, prompt || "The program asks for a text with input():", " ", field);
    const texts = this.#texts;
    const form = make("form", { className: "run-bar" }, label, make("button", {}, "Answer"));
    form.onsubmit = (event) => {
      event.preventDefault();
      this.#run([...texts, field.value]);
    };
    this.#asked.append(form);
    field.focus();
  }
}

customElements.define("canim-run", Run);
markDone();
