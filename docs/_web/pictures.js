// Pictures of the reader's own, for programs that work on them: brought to one size, quick to warp.

import { make } from "./elements.js";

/** @typedef {{width: number, height: number}} Size */

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

/** @param {ImageBitmap} picture @param {Size} size */
async function fitted(picture, size) {
  const canvas = make("canvas", size);
  const ink = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  ink.imageSmoothingQuality = "high";
  const { left, top, width, height } = middle(picture, size);
  ink.drawImage(picture, left, top, width, height, 0, 0, size.width, size.height);
  /** @type {Blob} */
  const png = await new Promise((resolve) => canvas.toBlob(/** @type {BlobCallback} */ (resolve)));
  return new Uint8Array(await png.arrayBuffer());
}

const list = (/** @type {string[]} */ names) => names.join(" and ");

export class Pictures {
  /** @type {{name: string, bytes: Uint8Array}[]} what stands beside the program */
  files = [];
  most = 640; // pixels on a side
  /** @type {Map<string, File>} as they came, for the next ones may be of another shape */
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
  async add(added) {
    this.told.replaceChildren("The pictures are made ready …");
    const unread = [];
    for (const file of added) this.#originals.set(file.name, file);
    /** @type {Map<string, ImageBitmap>} */
    const pictures = new Map();
    for (const [name, file] of this.#originals) {
      try {
        pictures.set(name, await createImageBitmap(file)); // turned upright, as the camera says
      } catch {
        this.#originals.delete(name);
        unread.push(name);
      }
    }
    const size = commonSize([...pictures.values()], this.most);
    const files = [];
    for (const [name, picture] of pictures) files.push({ name, bytes: await fitted(picture, size) });
    this.files = files;
    this.told.replaceChildren(...this.#words(pictures, size, unread));
    for (const picture of pictures.values()) picture.close();
  }

  /** @param {Map<string, ImageBitmap>} pictures @param {Size} size @param {string[]} unread */
  #words(pictures, size, unread) {
    const words = [];
    if (unread.length)
      words.push(
        make("p", {}, `This browser cannot read ${list(unread)} as a picture. Save it as JPEG or PNG, and add that.`),
      );
    const names = [...pictures.keys()];
    if (!names.length) return words;
    const cut = names.filter((name) => {
      const picture = /** @type {ImageBitmap} */ (pictures.get(name));
      const part = middle(picture, size);
      return part.width < 0.99 * picture.width || part.height < 0.99 * picture.height;
    });
    const all = ["", "Your picture was", "Both were"][names.length] ?? `All ${names.length} were`;
    const made = `${all} made ${size.width} × ${size.height} pixels.`;
    const rim = cut.length ? ` Of ${list(cut)} the middle was taken, so that they have one shape.` : "";
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
