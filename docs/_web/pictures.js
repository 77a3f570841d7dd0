// Pictures of the reader's own, for programs that work on them: brought to one size, quick to warp.

import { make } from "./elements.js";

/** @typedef {{width: number, height: number}} Size
 *  @typedef {{file: File, size: Size}} Original */

/** Return the one size that pictures are brought to. Their shape is the one in the middle, so that
 *  each loses as little as it can; none becomes larger than the largest one was.
 *  @param {Size[]} sizes @param {number} most pixels on a side @returns {Size} */
export function commonSize(sizes, most) {
  const mean = sizes.reduce((sum, { width, height }) => sum + Math.log(width / height), 0) / sizes.length;
  const shape = Math.exp(mean);
  const longest = Math.min(most, Math.max(...sizes.map(({ width, height }) => Math.max(width, height))));
  const round = (/** @type {number} */ length) => Math.max(2, Math.round(length));
  return shape > 1
    ? { width: longest, height: round(longest / shape) }
    : { width: round(longest * shape), height: longest };
}

/** Return the part of a picture that has the shape of a size: the middle.
 *  @param {Size} picture @param {Size} size */
export function middle(picture, size) {
  const scale = Math.min(picture.width / size.width, picture.height / size.height);
  const [width, height] = [scale * size.width, scale * size.height];
  return { left: (picture.width - width) / 2, top: (picture.height - height) / 2, width, height };
}

/** Do something with the content of a file, and give its memory back at once.
 *  @template T
 *  @param {File} file @param {(picture: ImageBitmap) => T} use */
async function decoded(file, use) {
  const picture = await createImageBitmap(file); // turned upright, as the camera says
  try {
    return use(picture);
  } finally {
    picture.close();
  }
}

/** @param {File} file @param {Size} size */
async function fitted(file, size) {
  const canvas = make("canvas", size);
  const ink = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  ink.imageSmoothingQuality = "high";
  await decoded(file, (picture) => {
    const { left, top, width, height } = middle(picture, size);
    ink.drawImage(picture, left, top, width, height, 0, 0, size.width, size.height);
  });
  /** @type {Blob | null} */
  const png = await new Promise((resolve) => canvas.toBlob(resolve));
  if (!png) throw new Error(`${file.name} gives no PNG.`);
  return new Uint8Array(await png.arrayBuffer());
}

const list = (/** @type {string[]} */ names) => new Intl.ListFormat("en-GB").format(names);

export class Pictures {
  /** @type {{name: string, bytes: Uint8Array}[]} what stands beside the program */
  files = [];
  most = 640; // pixels on a side
  /** @type {Promise<void>} until `files` are those that were added last; it never fails */
  ready = Promise.resolve();
  /** @type {Map<string, Original>} as they came, for the next ones may be of another shape */
  #originals = new Map();

  constructor() {
    const input = make("input", { type: "file", multiple: true, accept: "image/*", className: "run-file" });
    input.onchange = async () => {
      const added = [...(input.files ?? [])];
      input.value = ""; // the same one can be chosen again
      await this.add(added);
    };
    this.element = make("label", { className: "run-pictures" }, "Add pictures", input);
    this.told = make("div", { className: "run-own", role: "status" });
  }

  /** @param {File[]} added */
  add(added) {
    this.ready = this.ready.then(() => this.#make(added));
    return this.ready;
  }

  /** @param {File[]} added */
  async #make(added) {
    const before = new Map(this.#originals);
    const told = [...this.told.children];
    this.told.replaceChildren("The pictures are made ready …");
    try {
      const unread = await this.#read(added);
      // The lines name the last two: only these say which size all get.
      const sizes = [...this.#originals.values()].slice(-2).map(({ size }) => size);
      const size = commonSize(sizes, this.most);
      const files = [];
      for (const [name, { file }] of this.#originals) files.push({ name, bytes: await fitted(file, size) });
      this.files = files;
      this.told.replaceChildren(...this.#words(size, unread));
    } catch {
      this.#originals = before;
      const words = `${list(added.map(({ name }) => name))} could not be made ready: perhaps this device has too little
        memory. Close other pages, or make the pictures smaller, and add them again.`;
      this.told.replaceChildren(make("p", {}, words), ...told);
    }
  }

  /** Return the names of those that are no pictures. @param {File[]} added */
  async #read(added) {
    const unread = [];
    for (const file of added) {
      this.#originals.delete(file.name); // it becomes the last one
      try {
        const size = await decoded(file, ({ width, height }) => ({ width, height }));
        this.#originals.set(file.name, { file, size });
      } catch {
        unread.push(file.name);
      }
    }
    return unread;
  }

  /** @param {Size} size @param {string[]} unread */
  #words(size, unread) {
    const words = [];
    if (unread.length)
      words.push(
        make("p", {}, `This browser cannot read ${list(unread)} as a picture. Save it as JPEG or PNG, and add that.`),
      );
    const names = [...this.#originals.keys()];
    if (!names.length) return words;
    const originals = [...this.#originals].filter(([, { size: whole }]) => {
      const part = middle(whole, size);
      return part.width < 0.99 * whole.width || part.height < 0.99 * whole.height;
    });
    const cut = originals.map(([name]) => name);
    const all = ["", "Your picture was", "Both were"][names.length] ?? `All ${names.length} were`;
    const made = `${all} made ${size.width} × ${size.height} pixels.`;
    const rim = cut.length ? ` The edges of ${list(cut)} were cut off, so that all have one shape.` : "";
    const [a, b] = names.slice(-2);
    // With the size, the program does the same on the reader's own computer, where pictures are as they came.
    const read = (/** @type {string} */ name) =>
      `canim.data.read_image(${JSON.stringify(name)}, size=(${size.width}, ${size.height}))`;
    const lines = [`image_a = ${read(a)}`, `image_b = ${read(b ?? a)}`];
    words.push(make("p", {}, `${made}${rim} Put these lines into your program, below the line that begins with `));
    words[words.length - 1].append(
      make("code", {}, "image_a, image_b"),
      ", and set ",
      make("code", {}, "click = True"),
    );
    words[words.length - 1].append(" to give them key points:");
    words.push(make("pre", { tabIndex: 0 }, lines.join("\n")));
    const end = names.length > 1 ? "" : " Add a second picture, and there is one for image_b.";
    words.push(make("p", {}, `The pictures are here until this page is closed or loaded again.${end}`));
    return words;
  }
}
