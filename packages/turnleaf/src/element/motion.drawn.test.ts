/** Pages changed without motion, where the open book lies, and how strong its shadows are. */

import { afterEach, expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import {
  book,
  drawRoughly,
  happens,
  keepWhatIsDrawn,
  scans,
  settled,
} from "../for_tests/element_books.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";

keepWhatIsDrawn();
drawRoughly();

afterEach(() => document.body.replaceChildren());

async function opened(attributes: Record<string, string> = {}): Promise<TurnleafBook> {
  const element = book(scans(12), { page: "6", cover: "none", ...attributes });
  await happens(element, "load");
  await settled(element);
  return element;
}

/** Returns the mean brightness of what a book shows, 0 to 255, while a leaf is held upright. */
async function brightness(attributes: Record<string, string>): Promise<number> {
  const element = await opened(attributes);
  const pointer = new TestPointer(element);
  pointer.point("pointerdown", 245, 110);
  await pointer.move([245, 110], [170, 100]);
  await settled(element);
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [300, 220];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  pen.drawImage(pointer.canvas, 0, 0, 300, 220);
  const { data } = pen.getImageData(50, 50, 200, 120);
  let sum = 0;
  for (let at = 0; at < data.length; at += 4) sum += data[at];
  element.remove();
  return (4 * sum) / data.length;
}

test("shadows can be made weaker, and left out", async () => {
  const [full, half, none] = [
    await brightness({}),
    await brightness({ shadows: "0.5" }),
    await brightness({ shadows: "0" }),
  ];
  expect(half).toBeGreaterThan(full + 1);
  expect(none).toBeGreaterThan(half + 1);
});
