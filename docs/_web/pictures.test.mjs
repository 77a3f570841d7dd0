import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { show } from "./testing/page.mjs";

/** Files of the tests say their size in their content; others are no pictures. */
globalThis.createImageBitmap = async (file) => {
  const [width, height] = (await file.text()).split("x").map(Number);
  if (!height) throw new DOMException("The source image could not be decoded.");
  return { width, height, close() {} };
};
/** @type {number[][]} */
let drawn;
HTMLCanvasElement.prototype.getContext = () => ({ drawImage: (_, ...numbers) => drawn.push(numbers) });
HTMLCanvasElement.prototype.toBlob = function (done) {
  done(new Blob([`${this.width} × ${this.height}`]));
};
const { Pictures, commonSize, middle } = await import("./pictures.js");

let pictures;
let told;
beforeEach(() => {
  drawn = [];
  pictures = new Pictures();
  const page = show("");
  page.append(pictures.element, pictures.told);
  told = () => pictures.told.textContent;
});
const file = (name, content) => new File([content], name);
const contents = () => pictures.files.map(({ name, bytes }) => [name, new TextDecoder().decode(bytes)]);

test("two photographs of one shape become small and are whole", async () => {
  await pictures.add([file("a.jpg", "3000x4000"), file("b.jpg", "1500x2000")]);
  assert.deepEqual(contents(), [
    ["a.jpg", "480 × 640"],
    ["b.jpg", "480 × 640"],
  ]);
  assert.match(told(), /^Both were made 480 × 640 pixels\. Put/);
  const lines = ["a", "b"].map((x) => `image_${x} = canim.data.read_image("${x}.jpg", size=(480, 640))`);
  assert.ok(told().includes(lines.join("\n")));
  assert.deepEqual(drawn[0], [0, 0, 3000, 4000, 0, 0, 480, 640]);
});

test("pictures of two shapes get the one in the middle, and it is told what is cut off", async () => {
  await pictures.add([file("wide.png", "4000x3000"), file("high.png", "3000x4000")]);
  assert.deepEqual(
    contents().map(([, size]) => size),
    ["640 × 640", "640 × 640"],
  );
  assert.match(told(), /Of wide\.png and high\.png the middle was taken, so that they have one shape\./);
  assert.deepEqual(drawn[0].slice(0, 4), [500, 0, 3000, 3000]);
  assert.deepEqual(drawn[1].slice(0, 4), [0, 500, 3000, 3000]);
});

test("one small picture stays as it is; the next one is brought to the same size, from its original", async () => {
  await pictures.add([file("a.png", "200x100")]);
  assert.deepEqual(contents(), [["a.png", "200 × 100"]]);
  assert.match(told(), /^Your picture was made 200 × 100 pixels\..*Add a second picture/s);
  await pictures.add([file("b.png", "100x200")]);
  assert.deepEqual(
    contents().map(([, size]) => size),
    ["200 × 200", "200 × 200"],
  );
  await pictures.add([file("c.png", "200x200")]);
  assert.match(told(), /^All 3 were made 200 × 200/);
  assert.match(told(), /image_a = canim\.data\.read_image\("b\.png", size/);
});

test("what is no picture is named, and the others are taken", async () => {
  await pictures.add([file("a.heic", "?")]);
  assert.match(told(), /^This browser cannot read a\.heic as a picture\. Save it as JPEG or PNG, and add that\.$/);
  assert.deepEqual(pictures.files, []);
  await pictures.add([file("b.txt", "no"), file("c.png", "64x64")]);
  assert.deepEqual(contents(), [["c.png", "64 × 64"]]);
  assert.match(told(), /cannot read b\.txt as a picture.*Your picture was made 64 × 64/s);
});

test("a name with quotes is written as Python reads it", async () => {
  await pictures.add([file('my "cat".png', "20x20")]);
  assert.match(told(), /read_image\("my \\"cat\\"\.png", size/);
});

test("the same file can be chosen again", async () => {
  const input = pictures.element.querySelector("input");
  Object.defineProperty(input, "files", { value: [file("a.png", "30x30")] });
  input.onchange();
  await new Promise((resolve) => setTimeout(resolve));
  assert.equal(input.value, "");
  assert.equal(pictures.files.length, 1);
});

test("a size is never larger than 640 pixels and never flat", () => {
  assert.deepEqual(commonSize([{ width: 9000, height: 3 }], 640), { width: 640, height: 2 });
  assert.deepEqual(commonSize([{ width: 3, height: 9000 }], 640), { width: 2, height: 640 });
  const part = middle({ width: 9000, height: 3 }, { width: 640, height: 2 });
  assert.deepEqual(part, { left: 4020, top: 0, width: 960, height: 3 });
});
