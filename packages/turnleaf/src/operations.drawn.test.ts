/**
 * Any sequence of operations on a book: at rest each visible page is shown, and
 * WebGL reports no error.
 */

import { expect, test } from "vitest";
import { commands } from "vitest/browser";
import pdf from "../../../books/moby-dick.pdf?url";
import { keepWhatIsDrawn } from "./for_tests/element_books.ts";
import { isLong } from "./for_tests/long.ts";
import { seed } from "./for_tests/random_numbers.ts";
import { RandomOperations } from "./for_tests/random_operations.ts";
import "./index.ts";

keepWhatIsDrawn();

/** Operations of each test; of any kind, and folds and tears. */
const counts = { any: isLong ? 80 : 50, folds: 30 };

/** Operations between two checks. */
const between = 5;

/** What a book's canvas shows, each pixel of it one CSS pixel. */
function picture(element: HTMLElement): Promise<ImageData> {
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const home = element.getBoundingClientRect();
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const seen = document.createElement("canvas");
  [seen.width, seen.height] = [home.width, home.height];
  const pen = seen.getContext("2d", { willReadFrequently: true }) as CanvasRenderingContext2D;
  pen.drawImage(canvas, left - home.left, top - home.top, width, height);
  return Promise.resolve(pen.getImageData(0, 0, seen.width, seen.height));
}

test(`at rest every page in sight is seen, whatever was asked before (seed ${seed})`, {
  timeout: 1_000_000,
}, async () => {
  const operations = new RandomOperations({ seed, pdf, picture });
  await operations.start();
  for (let k = 1; k <= counts.any; k++) {
    await operations.next();
    if (k % between > 0) continue;
    expect(await operations.check(), `seed ${seed}, ${operations.state}`).toEqual([]);
    expect(await commands.webglComplaints(), `seed ${seed}, ${operations.state}`).toEqual([]);
  }
  expect(operations.errors).toEqual([]);
  expect(Math.min(operations.checked.hues, operations.checked.prints)).toBeGreaterThan(3);
  operations.end();
});

test(`all pages are back in their places once folds and tears are undone (seed ${seed})`, {
  timeout: 1_000_000,
}, async () => {
  const operations = new RandomOperations({ seed, pdf, picture, only: "folds" });
  await operations.start();
  for (let k = 1; k <= counts.folds; k++) {
    await operations.next();
    if (k % 10 > 0) continue;
    expect(await operations.undoAll(), `seed ${seed}, ${operations.state}`).toEqual([]);
    expect(await operations.check(), `seed ${seed}, ${operations.state}`).toEqual([]);
    expect(await commands.webglComplaints(), `seed ${seed}, ${operations.state}`).toEqual([]);
  }
  expect(operations.errors).toEqual([]);
  const { undone, folds, tears } = operations.checked;
  expect(Math.min(undone, folds, tears)).toBeGreaterThan(2);
  operations.end();
});
