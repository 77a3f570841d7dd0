// <canim-run>: the program of a task's page, with an editor, Run, and what the program shows.

import { Clock } from "./clock.js";
import { button, make } from "./elements.js";
import { Film } from "./film.js";
import { askAnew, explain, megabytes, packages, progress } from "./loading.js";
import { keepOffline } from "./offline.js";
import { Pictures } from "./pictures.js";
import { Points } from "./points.js";
import { markDone, noteDone } from "./progress.js";
import { Python } from "./python.js";
import { script, site } from "./site.js";
import { carryOver, keep, recall, watch } from "./store.js";

/** @typedef {import("./python.js").Message} Message
 *  @typedef {{text: string, answers: {[kind: string]: any}}} Program with what was answered to it */

const editorAddress = new URL(`editor.js${new URL(script.src).search}`, script.src);

/** Return why programs cannot run here, "" where they can. */
function hindrance() {
  if (location.protocol === "file:")
    return "Programs cannot run here, because this page was opened from a folder. On the course's web site they can.";
  if (typeof WebAssembly !== "object" || !("Worker" in window))
    return "Programs cannot run here: this browser has no WebAssembly. A newer one has it.";
  if (window.origin === "null")
    return "Programs cannot run here, because another page shows this one inside it. Open it in a window of its own.";
  return "";
}

const NO_EDITOR = "The editor has not come. Look at your connection to the network, then click on the program again.";
const MOST_BEFORE = 5; // programs that can be taken back

/** @param {Program} a @param {Program} b */
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** Change what is said only where it differs: a screen reader speaks all that is put there.
 *  @param {HTMLElement} place @param {string} words */
function write(place, words) {
  if (place.textContent !== words) place.textContent = words;
}

/** Hand a file to the reader. @param {string} name @param {BlobPart[]} content */
function save(name, content) {
  const href = URL.createObjectURL(new Blob(content));
  make("a", { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), 10_000);
}

class Run extends HTMLElement {
  #name = "";
  #starter = "";
  #text = "";
  #state = "idle"; // or "loading", when Run waits for Python; "running"
  #again = false;
  #prepared = false;
  #isPreparing = false;
  #press = 0; // of Run or Stop: what an earlier one has ordered is not sent any more
  /** @type {{[kind: string]: any}} what the reader has answered to the program */
  #answers = {};
  /** @type {string[]} what input() gets in this run */
  #texts = [];
  /** @type {Program[]} what was here before something else took its place, the newest first */
  #before = [];
  #begunWith = ""; // the starter that the reader's program was begun with
  /** @type {string | null} the text that this tab has kept, or was told of by another one */
  #seen = null;
  #pictures = new Pictures();
  /** @type {Map<string | number, Film>} */
  #films = new Map();
  /** @type {ReturnType<typeof import("./editor.js").edit> | undefined} */
  #editor;
  #isEditorComing = false;
  #misses = 0; // of the editor's script
  /** @type {Promise<void> | undefined} */
  #offline;
  #address = new URL(`${RUN.folder}worker.js`, site).href;
  #isDoubtful = false; // whether the browser may hold a wrong script of the worker
  #python = new Python(this.#address, (message) => this.#hear(message));

  #code = make("div", { className: "run-code" });
  // The editor has only those lines in the page that are in sight: on paper, and in a copy of the
  // page, this stands in its place.
  #whole = make("pre", { className: "run-whole" });
  #notice = make("div", { className: "run-notice", hidden: true });
  #go = button("Run", () => this.#run(), "run-main");
  #stop = button("Stop", () => this.#end("Stopped."));
  #back = button("Take my program back", () => this.#takeBack());
  #unkept = make("p", { className: "run-unkept", role: "status" });
  #editorStatus = make("p", { className: "run-unkept run-editor", role: "status" });
  #status = make("p", { className: "run-status", role: "status" });
  #clock = new Clock();
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
    this.#name = this.dataset.file ?? "";
    this.#starter = this.#begunWith = code?.textContent ?? "";
    this.#set(this.#starter);
    this.#code.append(code ?? "");
    this.#stop.disabled = true;
    this.#say(`Python runs here, in your browser. The first Run loads ${megabytes(this.#starter)} MB.`);
    const bar = make("div", { className: "run-bar", role: "group", "aria-label": "The program" }, this.#go, this.#stop);
    bar.append(
      button("Start over", () => this.#startOver()),
      this.#back,
    );
    bar.append(button("Download .py", () => save(this.#name, [this.#text])));
    const keys = "Ctrl+Enter runs the program. Escape, then Tab, leaves the editor.";
    this.replaceChildren(this.#notice, this.#code, this.#whole, make("p", { className: "run-keys" }, keys), bar);
    if (this.dataset.pictures) {
      this.#pictures.most = Number(this.dataset.pictures);
      bar.append(this.#pictures.element);
      this.append(this.#pictures.told);
    }
    this.append(this.#unkept, this.#editorStatus, this.#status, this.#clock.element, this.#asked, this.#output);
    this.#back.hidden = true;
    this.#lookAt();
    this.#code.onpointerenter = () => this.#edit();
    bar.onpointerenter = () => this.#prepare();
    this.addEventListener("focusin", () => {
      this.#edit();
      this.#prepare();
    });
    this.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey) && !event.defaultPrevented) this.#run();
      event.stopPropagation(); // a shortcut of the site would take a key that is typed: "/" begins a search
    });
    document.addEventListener("copy", () => this.#copyWhole());
    this.#recall();
    watch(this.#name, (kept, replaced) => this.#follow(kept, replaced));
  }

  /** Where the reader copies the page, copy all of the program. */
  #copyWhole() {
    if (!getSelection()?.containsNode(this.#code)) return;
    this.classList.add("run-copied");
    setTimeout(() => this.classList.remove("run-copied"));
  }

  #recall() {
    const kept = recall(this.#name);
    if (!kept) return;
    this.#answers = kept.answers;
    this.#before = kept.before ?? [];
    this.#seen = kept.text;
    this.#write(kept.text);
    this.#offerBack();
    if (kept.starter === this.#starter || kept.text === this.#starter) return;
    this.#begunWith = kept.starter; // until the reader has chosen
    const choose = (/** @type {() => void} */ choice) => {
      this.#begunWith = this.#starter;
      this.#leave(this.#notice, this.#go);
      this.#notice.hidden = true;
      choice();
    };
    this.#notice.append(
      make("p", {}, "The starter of this page is a new one since you began. You see your own program."),
      button("Keep my program", () => choose(() => this.#keep())),
      button("Take the new starter", () => choose(() => this.#startOver())),
    );
    this.#notice.hidden = false;
  }

  #keep() {
    // Another tab may have kept what this one was not told of, as one that slept is not.
    const other = recall(this.#name);
    if (other && other.text !== this.#seen && other.text !== this.#text)
      this.#putAside({ text: other.text, answers: other.answers });
    this.#seen = this.#text;
    const kept = keep(this.#name, { ...this.#program(), starter: this.#begunWith, before: this.#before });
    const words = kept ? "" : "This browser does not keep your program: download it before you leave.";
    write(this.#unkept, words);
    this.#offerBack();
  }

  /** Show what another tab has kept. @param {any} kept @param {any} replaced what it had seen before */
  #follow(kept, replaced) {
    if (!kept) return;
    const mine = this.#program();
    const isLost = this.#seen !== null && this.#seen !== replaced?.text && kept.text !== mine.text;
    this.#seen = kept.text;
    this.#answers = kept.answers;
    this.#before = kept.before ?? [];
    const isAside = this.#before.some((program) => same(program, mine));
    if (isLost) this.#putAside(mine);
    this.#write(kept.text);
    if (isLost && !isAside) this.#keep();
    this.#offerBack();
  }

  /** Keep a program that something else takes the place of. @param {Program} program */
  #putAside(program) {
    this.#before = [program, ...this.#others(program)].slice(0, MOST_BEFORE);
  }

  /** Return what was put aside, but for this program. @param {Program} program */
  #others(program) {
    return this.#before.filter((other) => !same(other, program));
  }

  #offerBack() {
    const isHidden = this.#others(this.#program()).length === 0;
    if (isHidden) this.#leave(this.#back, this.#go);
    this.#back.hidden = isHidden;
  }

  /** Hand on the focus of a part that goes away, or a reader with a keyboard is at the page's top.
   *  @param {HTMLElement} part @param {HTMLElement} next */
  #leave(part, next) {
    if (part.contains(document.activeElement)) next.focus({ preventScroll: true });
  }

  /** @returns {Program} */
  #program() {
    return { text: this.#text, answers: this.#answers };
  }

  /** Return whether the reader has done nothing yet. */
  #isStarter() {
    return this.#text === this.#starter && Object.keys(this.#answers).length === 0;
  }

  /** @param {string} text */
  #set(text) {
    this.#text = this.#whole.textContent = text;
  }

  /** @param {string} text */
  #write(text) {
    if (text === this.#text) return;
    this.#set(text);
    if (this.#editor) this.#editor.replace(text);
    else this.#code.replaceChildren(make("pre", { tabIndex: 0 }, text));
  }

  /** @param {string} text */
  #changed(text) {
    if (text === this.#text) return; // it was put there by #write
    this.#set(text);
    this.#keep();
  }

  /** Return where in the program the reader has clicked, in letters from its beginning. */
  #caret() {
    const selection = getSelection();
    if (!selection?.anchorNode || !this.#code.contains(selection.anchorNode)) return 0;
    const before = document.createRange();
    before.selectNodeContents(this.#code);
    before.setEnd(selection.anchorNode, selection.anchorOffset);
    return before.toString().length;
  }

  /** Put another program in place of the reader's. @param {Program} program */
  #replace({ text, answers }) {
    this.#answers = answers;
    this.#write(text);
    this.#keep();
    this.#say(`This is ${this.#isStarter() ? "the starter" : "your program"} again.`);
  }

  #startOver() {
    if (this.#isStarter()) return;
    this.#putAside(this.#program());
    this.#replace({ text: this.#starter, answers: {} });
  }

  /** Take the newest program back; what is there now can be taken back last. */
  #takeBack() {
    const now = this.#program();
    const [newest, ...older] = this.#others(now);
    this.#before = this.#isStarter() ? older : [...older, now];
    this.#replace(newest);
  }

  /** Scroll the program to a line. */
  #lookAt(line = this.#text.split("\n").findIndex((text) => text.includes("# TODO"))) {
    const box = this.#code.querySelector(".cm-scroller") ?? this.#code;
    box.scrollTop = (box.scrollHeight * line) / this.#text.split("\n").length - box.clientHeight / 2;
  }

  /** Put the editor in place of the text. */
  async #edit() {
    if (this.#editor || this.#isEditorComing) return;
    this.#isEditorComing = true;
    const address = new URL(editorAddress);
    // Browsers do not ask again for a script that did not come.
    if (this.#misses) address.searchParams.set("again", String(this.#misses));
    const told = { 1000: "The editor is loading …", 20000: NO_EDITOR };
    const timers = Object.entries(told).map(([wait, words]) =>
      setTimeout(() => write(this.#editorStatus, words), Number(wait)),
    );
    const editor = await import(address.href).catch(() => null);
    timers.forEach(clearTimeout);
    this.#isEditorComing = false;
    write(this.#editorStatus, editor ? "" : NO_EDITOR);
    if (!editor) {
      this.#misses++;
      return;
    }
    const hadFocus = this.#code.contains(document.activeElement);
    const caret = hadFocus ? this.#caret() : 0;
    const { scrollTop } = this.#code;
    this.#code.replaceChildren();
    this.#editor = editor.edit(
      this.#code,
      this.#text,
      caret,
      (/** @type {string} */ text) => this.#changed(text),
      () => this.#run(),
    );
    // The line that the reader looks at stays where it is.
    const scroller = this.#code.querySelector(".cm-scroller");
    if (scroller) scroller.scrollTop = scrollTop;
    if (hadFocus) this.#editor?.focus();
  }

  /** @param {"load" | "run"} kind */
  async #order(kind) {
    const press = this.#press;
    try {
      await (this.#offline ??= keepOffline(site, editorAddress));
      await this.#pictures.ready;
      if (this.#isDoubtful) await askAnew(this.#address);
      this.#isDoubtful = false;
      if (kind === "run" && press !== this.#press) return;
      const order = { kind, code: this.#text, name: this.#name, files: this.#pictures.files };
      const answers = JSON.stringify({ ...this.#answers, texts: this.#texts });
      this.#python.send({ ...order, packages: packages(this.#text), answers });
    } catch (error) {
      this.#fail({ kind: "failed", reason: "start", file: "", text: String(error), blobs: [] });
    }
  }

  #prepare() {
    if (this.#prepared) return;
    this.#prepared = this.#isPreparing = true;
    this.#progress(0);
    this.#order("load");
  }

  #run(texts = /** @type {string[]} */ ([])) {
    if (this.#state !== "idle") {
      this.#again = this.#state === "running"; // while Python loads, the newest text is waited for anyway
      return;
    }
    this.#texts = texts;
    this.#press++;
    this.#prepared = true;
    this.#stop.disabled = false;
    this.#state = "loading";
    if (this.#python.isReady) this.#start();
    else {
      this.#progress(0);
      if (!this.#python.hasBegun) this.#order("load");
    }
    this.#status.scrollIntoView({ block: "nearest" });
  }

  /** Run the program as it is now: the reader may have changed it while Python was loading. */
  #start() {
    this.#state = "running";
    this.#say("Running …");
    this.#order("run");
  }

  /** End what runs, and load a new Python, from what the browser has kept. @param {string} words */
  #end(words) {
    this.#again = false;
    this.#press++;
    this.#python.end();
    this.#ended(words);
    this.#order("load");
  }

  /** @param {string} words */
  #ended(words) {
    this.#state = "idle";
    this.#isPreparing = false;
    this.#leave(this.#stop, this.#go);
    this.#stop.disabled = true;
    this.#clock.stop();
    for (const film of this.#films.values()) film.isComplete = true;
    this.#output.removeAttribute("aria-busy");
    this.#say(words);
    if (this.#again) this.#run();
    this.#again = false;
  }

  /** @param {string} words */
  #say(words) {
    write(this.#status, words);
  }

  /** @param {Message} message */
  #hear(message) {
    const { kind, text, blobs } = message;
    if (kind === "progress") this.#progress(message.done);
    else if (kind === "ready") this.#ready();
    else if (kind === "begin") this.#begin();
    else if (kind === "text") this.#print(text);
    else if (kind === "advance") this.#clock.note(text);
    else if (kind === "figure") this.#show(message);
    else if (kind === "frame") this.#films.get(message.film)?.add(blobs, message.interval);
    else if (kind === "report") this.#report(message);
    else if (kind === "crash") this.#crash(message);
    else if (kind === "file") this.#shown.append(button(`Save ${message.name}`, () => save(message.name, blobs)));
    else if (kind === "points") this.#points(message);
    else if (kind === "question") this.#question(text);
    else if (kind === "end") this.#ended(text);
    else if (kind === "failed") this.#fail(message);
  }

  // After Stop, Python is loaded anew, from what the browser has: nobody waits, and nothing is said.

  #ready() {
    if (this.#state === "loading") this.#start();
    else if (this.#isPreparing && this.#state === "idle") this.#say("Python is ready.");
  }

  /** @param {number} done bytes */
  #progress(done) {
    if (this.#state !== "idle") this.#say(progress(this.#text, done));
    else if (this.#isPreparing) this.#say(`${progress(this.#text, done)} You can edit while it does.`);
  }

  /** @param {Message} failure */
  async #fail(failure) {
    const press = this.#press;
    this.#python.end();
    this.#isDoubtful = ["script", "policy"].includes(failure.reason);
    const { words, isRenewed } = await explain(/** @type {any} */ (failure), this.#address);
    if (press !== this.#press) return; // the reader was quicker
    const isKept = this.#unkept.textContent === "";
    this.#ended(isRenewed && !isKept ? `${words} Press Download .py first, or your program is lost.` : words);
    if (isRenewed) this.#asked.replaceChildren(button("Load the page again", () => location.reload()));
  }

  #begin() {
    this.#clock.start();
    this.#films.clear();
    this.#output.setAttribute("aria-busy", "true");
    this.#leave(this.#asked, this.#stop);
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
    const changed = (/** @type {any} */ chosen) => {
      const { [message.name]: _, ...others } = this.#answers;
      this.#answers = chosen ? { ...others, [message.name]: chosen } : others;
      this.#keep();
    };
    this.#asked.append(new Points(message, changed, () => this.#run()).element);
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

carryOver();
customElements.define("canim-run", Run);
markDone();
