import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { show } from "./testing/page.mjs";

/** @type {string[]} the pictures that take memory */
const open = [];
let most = 0;
let isFull = false;

/** Files of the tests say their size in their content; others are no pictures. */
globalThis.createImageBitmap = async (file) => {
  const [width, height] = (await file.text()).split("x").map(Number);
  if (!height) throw new DOMException("The source image could not be decoded.");
  open.push(file.name);
  most = Math.max(most, open.length);
  return { width, height, close: () => open.splice(open.indexOf(file.name), 1) };
};
/** @type {number[][]} */
let drawn;
HTMLCanvasElement.prototype.getContext = () => ({ drawImage: (_, ...numbers) => drawn.push(numbers) });
HTMLCanvasElement.prototype.toBlob = function (done) {
  done(isFull ? null : new Blob([`${this.width} × ${this.height}`]));
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
  assert.match(told(), /The edges of wide\.png and high\.png were cut off, so that all have one shape\./);
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
  assert.match(told(), /^All 3 were made 141 × 200/);
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

test("the last two say the size, whatever was added before, and a picture that comes again is one of them", async () => {
  await pictures.add([file("pano.jpg", "4000x500"), file("a.jpg", "480x640"), file("b.jpg", "480x640")]);
  assert.match(told(), /^All 3 were made 480 × 640 pixels\. The edges of pano\.jpg were cut off/);
  await pictures.add([file("a.jpg", "640x640"), file("c.jpg", "640x640")]);
  assert.match(told(), /The edges of pano\.jpg and b\.jpg were/);
  await pictures.add([file("b.jpg", "200x200"), file("d.jpg", "300x200"), file("e.jpg", "200x300")]);
  assert.match(told(), /The edges of pano\.jpg, d\.jpg and e\.jpg were cut off/);
});

test("pictures are in memory one after another, and none stays", async () => {
  most = 0;
  await pictures.add([file("a.jpg", "480x640"), file("b.jpg", "480x640"), file("c.jpg", "480x640")]);
  assert.deepEqual([most, open], [1, []]);
});

test("what could not be made ready is told, and what was there stays", async () => {
  await pictures.add([file("a.png", "30x30")]);
  isFull = true;
  await pictures.add([file("b.png", "9000x9000"), file("c.png", "9000x9000")]);
  isFull = false;
  assert.match(told(), /^b\.png and c\.png could not be made ready: .*read_image\("a\.png"/s);
  assert.deepEqual(contents(), [["a.png", "30 × 30"]]);
  await pictures.add([file("d.png", "30x30")]);
  assert.match(told(), /^Both were made 30 × 30/);
});

test("a run can wait until all that was added is there", async () => {
  pictures.add([file("a.png", "30x30")]);
  pictures.add([file("b.png", "30x30")]);
  await pictures.ready;
  assert.deepEqual(contents(), [
    ["a.png", "30 × 30"],
    ["b.png", "30 × 30"],
  ]);
});
