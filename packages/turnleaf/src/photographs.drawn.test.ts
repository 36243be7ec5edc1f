/**
 * Photographs of a turn over a book, in real Chromium: which of them is seen
 * where, by its colour.
 */

import { afterEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "./element.ts";
import {
  book,
  drawRoughly,
  happens,
  keepWhatIsDrawn,
  scans,
  settled,
} from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { hueOf, photograph, serve } from "./for_tests/photographs.ts";
import { TestPointer } from "./for_tests/test_pointer.ts";

keepWhatIsDrawn();
drawRoughly();

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

const count = 5;

async function opened(attributes: Record<string, string> = {}): Promise<TurnleafBook> {
  const element = book(scans(10), {
    model: "photographs",
    "model-src": `/photographs/{0-${count - 1}}.png`,
    cover: "none",
    duration: "300",
    page: "4",
    ...attributes,
  });
  await happens(element, "load");
  await eventually(() => element.ready).toBe(true);
  return element;
}

/**
 * Returns the number of the photograph seen at a place, in fractions of the
 * element's size; null if the book is.
 */
function seenAt(element: TurnleafBook, x: number, y: number): number | null {
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [1, 1];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  pen.drawImage(canvas, -Math.round(x * canvas.width), -Math.round(y * canvas.height));
  const [r, g, b] = pen.getImageData(0, 0, 1, 1).data;
  const most = Math.max(r, g, b);
  const span = most - Math.min(r, g, b);
  if (span < 150) return null;
  const sixth = most === r ? (g - b) / span : most === g ? 2 + (b - r) / span : 4 + (r - g) / span;
  const number = ((((60 * sixth - hueOf(0)) % 360) + 360) % 360) / 72;
  return Math.round(number) % count;
}

const ways = [
  { binding: "left", start: [0.88, 0.6], clear: [0.8, 0.5], order: [0, 2, 4] },
  { binding: "right", start: [0.12, 0.6], clear: [0.8, 0.5], order: [4, 2, 0] },
] as const;

test.for(ways)(
  "bound at the $binding, they follow a pointer over and back",
  async ({ binding, start, clear, order }) => {
    serve(photograph);
    const element = await opened({ binding });
    const pointer = new TestPointer(element);
    const at = (x: number, y = 0.5): [number, number] => [300 * x, 220 * y];
    const sees = (number: number | null) =>
      eventually(() => seenAt(element, 0.3, 0.5)).toBe(number);
    expect(seenAt(element, 0.3, 0.5)).toBeNull();
    const middle = at(0.5, 0.3);
    const near = at(start[0] + (0.5 - start[0]) * 0.1);
    const far = at(1 - start[0]);
    pointer.point("pointerdown", ...at(start[0], start[1]));
    await pointer.move(at(start[0], start[1]), near);
    await sees(order[0]);
    await pointer.move(near, middle);
    await sees(order[1]);
    // Where a photograph is transparent the book's own page is seen.
    expect(seenAt(element, ...clear)).toBeNull();
    await pointer.move(middle, far);
    await sees(order[2]);
    await pointer.move(far, middle);
    await sees(order[1]);
    const turned = happens(element, "pagechange");
    await pointer.move(middle, far);
    await sees(order[2]);
    pointer.point("pointerup", ...far);
    expect(await turned).toMatchObject({ direction: "forward" });
    await settled(element);
    await sees(null);
  },
);

test("bound at the top they are quarterTurned with the book, and a command turns too", async () => {
  serve(photograph);
  const element = await opened({ binding: "top", duration: "60000" });
  const turned = element.next();
  // A page stands alone here: only a strip of the left half of a photograph,
  // above the spine, in the book's margin, is visible.
  const { top } = element.bookBounds as DOMRect;
  const strip = (top - element.getBoundingClientRect().top) / 220;
  await eventually(() => seenAt(element, 0.5, strip / 2)).not.toBeNull();
  expect(seenAt(element, 0.5, 0.75)).toBeNull();
  element.duration = 300;
  element.remove();
  expect(await turned).toBe(false);
});
