/**
 * The text over a resting book, in a real browser: where it lies, and what a
 * reader does with it.
 */

import { afterEach, beforeEach, expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { drawNow } from "../for_tests/drawn_when_seen.ts";
import { happens, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { clickMouse, frame, toolSession } from "../for_tests/real_mouse.ts";
import { awayAndBack, boxIn, openedWhale } from "../for_tests/text_books.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";

let element: TurnleafBook;

beforeEach(async () => {
  element = await openedWhale();
});

afterEach(() => {
  getSelection()?.removeAllRanges();
  element.remove();
});

const root = (): ShadowRoot => element.shadowRoot as ShadowRoot;
const boxOf = (text: string): DOMRect => boxIn(element, text);

/** Returns the box of the ink on the screen within a box, CSS pixels. */
async function inkIn(box: DOMRect): Promise<DOMRect> {
  const { x: left, y: top, scale } = frame();
  const [x, y, width, height] = [box.x, box.y, box.width, box.height].map(Math.round);
  const sharpness = scale * devicePixelRatio;
  // The whole of it: after a screenshot of a part the browser has no idle time, for which
  // `convertToBlob` in each test after this one waits a second.
  drawNow();
  const { data } = (await toolSession().send("Page.captureScreenshot")) as { data: string };
  const whole = await (await fetch(`data:image/png;base64,${data}`)).blob();
  const picture = await createImageBitmap(
    whole,
    Math.round(left * devicePixelRatio + x * sharpness),
    Math.round(top * devicePixelRatio + y * sharpness),
    Math.round(width * sharpness),
    Math.round(height * sharpness),
  );
  const [w, h] = [picture.width, picture.height];
  const pen = new OffscreenCanvas(w, h).getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(picture, 0, 0);
  const pixels = pen.getImageData(0, 0, w, h).data;
  const ink = { left: w, top: h, right: 0, bottom: 0 };
  for (let row = 0; row < h; row++) {
    for (let column = 0; column < w; column++) {
      if (pixels[4 * (row * w + column)] > 110) continue;
      ink.left = Math.min(ink.left, column);
      ink.right = Math.max(ink.right, column + 1);
      ink.top = Math.min(ink.top, row);
      ink.bottom = Math.max(ink.bottom, row + 1);
    }
  }
  return new DOMRect(
    x + ink.left / sharpness,
    y + ink.top / sharpness,
    (ink.right - ink.left) / sharpness,
    (ink.bottom - ink.top) / sharpness,
  );
}

/** Returns a box with a margin around it. */
const around = ({ x, y, width, height }: DOMRect, room: number): DOMRect =>
  new DOMRect(x - room, y - room, width + 2 * room, height + 2 * room);

test("each line lies over its print", async () => {
  for (const text of ["Call me", "years ago", "never mind how", "long Ishmael"]) {
    const box = boxOf(text);
    const ink = await inkIn(around(box, 4));
    const words = boxOf(text);
    expect(Math.abs(words.left - ink.left), text).toBeLessThan(2);
    expect(Math.abs(words.right - ink.right), text).toBeLessThan(2);
    expect(words.top, text).toBeLessThan(ink.top + 1);
    expect(words.bottom, text).toBeGreaterThan(ink.bottom - 1);
  }
});

test("what is searched for is found, turned to and marked where it is printed", async () => {
  await element.goTo(6);
  const hits = await element.search("ISHMAEL");
  expect(hits.map(({ page, before, text, after }) => [page, before, text, after])).toEqual([
    [2, "Call me ", "Ishmael", ". Some years ago End"],
    [3, "never mind how long ", "Ishmael", ""],
  ]);
  expect(await element.showHit(hits[1])).toBe(true);
  await settled(element);
  await eventually(() => root().querySelectorAll(".mark").length).toBe(2);
  const [strong, ...others] = root().querySelectorAll(".here");
  expect(others).toEqual([]);
  const faint = root().querySelector(".mark:not(.here)") as HTMLElement;
  // The words as printed: "long" and a space before the one, nothing before the other.
  const line = await inkIn(around(boxOf("long Ishmael"), 3));
  expect(Math.abs(strong.getBoundingClientRect().right - line.right)).toBeLessThan(4.5);
  expect(strong.getBoundingClientRect().left).toBeGreaterThan(line.left + line.width * 0.25);
  expect(strong.getBoundingClientRect().left).toBeLessThan(line.left + line.width * 0.45);
  const first = await inkIn(around(boxOf("Ishmael. Some"), 3));
  expect(Math.abs(faint.getBoundingClientRect().left - first.left)).toBeLessThan(4.5);
  // Within a line, where letters of another font would lie elsewhere: "long", a space, and the mark.
  const word = strong.getBoundingClientRect();
  const before = await inkIn(new DOMRect(line.x - 2, line.y, word.left - line.x, line.height));
  expect(word.left - before.right).toBeGreaterThan(1);
  const marked = await inkIn(around(word, 5));
  expect(Math.abs(marked.left - word.left)).toBeLessThan(4.5);
  await element.showHit(null);
  expect(root().querySelectorAll(".mark").length).toBe(0);
});

test("zoomed, the text lies where the print is", async () => {
  const offPrint = async (): Promise<number[]> => {
    const box = boxOf("Call me");
    const ink = await inkIn(around(box, 10));
    return [box.left - ink.left, box.right - ink.right];
  };
  const before = await offPrint();
  await awayAndBack(element, () => element.zoomTo(2, { x: 110, y: 110 }));
  const after = await offPrint();
  for (const side of [0, 1]) expect(Math.abs(after[side] - 2 * before[side])).toBeLessThan(3);
});

test("what is written in a form stays, and is printed on the leaf", async () => {
  const field = (more: string, y: number): string =>
    `<< /Type /Annot /Subtype /Widget /Rect [30 ${y} 130 ${y + 24}] /DA (/Helv 12 Tf 0 g) ${more} >>`;
  const bytes = tinyPdf({
    pages: ["", "", "", ""],
    catalog: "/AcroForm << /Fields [10 0 R 11 0 R 12 0 R] /DR << /Font << /Helv 13 0 R >> >> >>",
    objects: [
      field("/FT /Tx /T (name) /TU (Your name)", 200),
      field("/FT /Btn /T (aboard) /AS /Off /AP << /N << /Yes 14 0 R /Off 14 0 R >> >>", 150),
      field("/FT /Ch /Ff 131072 /T (ship) /Opt [(Pequod) (Rachel)] /V (Pequod)", 100),
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
      "<< /Length 0 /Type /XObject /Subtype /Form /BBox [0 0 1 1] >>\nstream\n\nendstream",
    ],
    resources: ">> /Annots [10 0 R 11 0 R 12 0 R] /Ignored <<",
  });
  const loaded = happens(element, "load");
  element.pages = new File([bytes], "form.pdf");
  await loaded;
  const fields = <T extends Element>(selector: string): T[] => [
    ...root().querySelectorAll<T>(selector),
  ];
  await eventually(() => fields(".field").length).toBe(6);
  await settled(element);
  const [name] = fields<HTMLInputElement>("input[aria-label='Your name']");
  expect(fields<HTMLSelectElement>("select").map(({ value }) => value)).toEqual([
    "Pequod",
    "Pequod",
  ]);
  const box = name.getBoundingClientRect();
  await clickMouse({ x: box.left + box.width / 2, y: box.top + box.height / 2 });
  expect(root().activeElement).toBe(name);
  await toolSession().send("Input.insertText", { text: "MMMMMMMM" });
  await toolSession().send("Input.dispatchKeyEvent", { type: "keyDown", key: "ArrowRight" });
  await toolSession().send("Input.dispatchKeyEvent", { type: "keyUp", key: "ArrowRight" });
  expect(element.page).toBe(2);
  const [check] = fields<HTMLInputElement>("[type=checkbox]");
  check.click();
  // Both pages show the same fields: one value, whatever the view.
  expect(fields<HTMLInputElement>("[type=checkbox]")[1].checked).toBe(true);
  await settled(element);
  name.style.visibility = "hidden";
  await eventually(async () => (await inkIn(box)).width).toBeGreaterThan(box.width / 3);
  await element.goTo(4);
  await eventually(() => fields(".field").length).toBe(3);
  await element.goTo(2);
  await eventually(() =>
    fields<HTMLInputElement>("input[aria-label='Your name']").map(({ value }) => value),
  ).toEqual(["MMMMMMMM", "MMMMMMMM"]);
});
