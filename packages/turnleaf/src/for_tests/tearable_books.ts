/** Books whose leaves may be torn out, for tests in a browser. */

import { expect } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "./clock.ts";
import { book, bookInPlace, happens, scans } from "./element_books.ts";
import { TestPointer } from "./test_pointer.ts";

const atFifthPage = { page: "5", cover: "none", duration: "300", tearable: "perforated" };

/** Adds an element at its fifth page, with room on the table beside the book. */
export function tearableElement(
  pages: TurnleafBook["pages"],
  attributes: Record<string, string>,
): TurnleafBook {
  const element = book(pages, { ...atFifthPage, ...attributes });
  element.style.cssText = "width: 760px; height: 320px";
  return element;
}

/** Resolves to such a book once its leaves can be torn out. */
export async function tearableBook(
  attributes: Record<string, string> = {},
  count = 12,
): Promise<TurnleafBook> {
  const element = tearableElement(scans(count), attributes);
  await happens(element, "load");
  // A pull tears nothing until what tears is loaded.
  await clock.until(() => element.ready);
  return element;
}

/** Resolves to such a book in place of the one before, as `bookInPlace` does. */
export async function tearableInPlace(
  attributes: Record<string, string> = {},
): Promise<TurnleafBook> {
  const element = await bookInPlace(scans(12), { ...atFifthPage, ...attributes }, [760, 320]);
  await clock.until(() => element.ready);
  return element;
}

/** Returns how much paper is seen on the right of the book, as a multiple of a page's area. */
export function besideBook(element: TurnleafBook): number {
  const drawn = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const bounds = element.bookBounds as DOMRect;
  const copy = document.createElement("canvas");
  const from = bounds.right + 14;
  const width = element.clientWidth - from - 2;
  [copy.width, copy.height] = [Math.floor(width), element.clientHeight];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  const scale = drawn.width / element.clientWidth;
  pen.drawImage(
    drawn,
    from * scale,
    0,
    copy.width * scale,
    copy.height * scale,
    0,
    0,
    copy.width,
    copy.height,
  );
  const { data } = pen.getImageData(0, 0, copy.width, copy.height);
  // Paper is opaque; shadows are not.
  const pixels = data.filter((value, k) => k % 4 === 3 && value > 250).length;
  return pixels / ((bounds.width / 2) * bounds.height);
}

/** Pulls the upper corner of the right page outward, in steps of a frame, some pixels farther each. */
export async function pull(element: TurnleafBook, steps: number, each = 6): Promise<TestPointer> {
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  const [x, y] = [right - 6, top + 8];
  pointer.point("pointerdown", x, y);
  for (let k = 1; k <= steps; k++) {
    pointer.point("pointermove", x + each * k, y - 0.3 * each * k, { buttons: 1 });
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  return pointer;
}

/** Tears the leaf of page 5 out. */
export async function tearOutPage5(element: TurnleafBook): Promise<void> {
  const torn = element.tearOut(5);
  await clock.until(() => element.tornLeaves === 1 && element.settled);
  expect(await torn).toBe(true);
}
