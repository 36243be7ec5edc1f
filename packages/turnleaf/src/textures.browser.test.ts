/**
 * Pictures and their textures over whole turns: none is uploaded to the
 * graphics card once it is closed, and none outlives its picture there.
 */

import { afterEach, expect, test, vi } from "vitest";
import { book, happens, scans, settled } from "./for_tests/element_books.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

/** Follows the pictures that are uploaded on a context from now on. */
function uploadsOf(context: WebGL2RenderingContext) {
  /** By texture unit. */
  const bound = new Map<number, WebGLTexture | null>();
  let unit = 0;
  vi.spyOn(context, "activeTexture").mockImplementation((to) => {
    unit = to;
  });
  vi.spyOn(context, "bindTexture").mockImplementation((_, texture) => {
    bound.set(unit, texture);
  });
  const pictures = new Map<WebGLTexture, ImageBitmap>();
  let closed = 0;
  const upload = (...args: unknown[]): void => {
    const [picture, texture] = [args.at(-1), bound.get(unit)];
    if (!(picture instanceof ImageBitmap) || !texture) return;
    // A picture that is closed has no size.
    if (picture.width === 0) closed++;
    pictures.set(texture, picture);
  };
  vi.spyOn(context, "texImage2D").mockImplementation(upload);
  vi.spyOn(context, "texSubImage2D").mockImplementation(upload);
  const freed = new Set<WebGLTexture | null>();
  vi.spyOn(context, "deleteTexture").mockImplementation((texture) => void freed.add(texture));
  return {
    /** Number of pictures that were uploaded. */
    count: () => pictures.size,
    /** Number of those that were closed by then. */
    closed: () => closed,
    /** Number of textures whose pictures are closed, and that are still on the card. */
    left: () => [...pictures].filter(([of, { width }]) => width === 0 && !freed.has(of)).length,
  };
}

test("a far jump in a hard-bound book sends no closed picture to the graphics card, and leaves none there", async () => {
  const element = book(scans(200), { duration: "200" });
  await happens(element, "load");
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const uploads = uploadsOf(canvas.getContext("webgl2") as WebGL2RenderingContext);
  await settled(element);
  for (const page of [64, 1, 150]) {
    const before = uploads.count();
    expect(await element.goTo(page)).toBe(true);
    await settled(element);
    // Both pages of the spread at the least. How many more depends on how quickly pictures come: a leaf in
    // flight shows those that are there. The cover may still be on the card.
    if (page !== 1) expect(uploads.count()).toBeGreaterThanOrEqual(before + 2);
  }
  expect([uploads.closed(), uploads.left()]).toEqual([0, 0]);
});
