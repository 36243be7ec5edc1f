/** Where pages are seen, measured on the canvas in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { openViewer } from "../open_viewer.ts";
import { openSource } from "../sources/open.ts";
import type { Viewer } from "../viewer.ts";

/** A page with a black square about a place of it, shares of the page. */
function marked(x: number, y: number): { src: string } {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [200, 300];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, 200, 300);
  pen.fillStyle = "#000";
  pen.fillRect(200 * x - 10, 300 * y - 10, 20, 20);
  return { src: canvas.toDataURL("image/png") };
}

const mark = { x: 0.3, y: 0.25 };

let viewer: Viewer | null = null;

afterEach(() => {
  viewer?.destroy();
  viewer = null;
  document.body.replaceChildren();
});

/** Opens a book of marked pages at a page, and answers its canvas once it rests. */
async function opened(page: number, cover: "hard" | "none"): Promise<HTMLCanvasElement> {
  const canvas = document.createElement("canvas");
  canvas.style.cssText = "width: 400px; height: 300px; background: white";
  document.body.append(canvas);
  const pages = Array.from({ length: 12 }, () => marked(mark.x, mark.y));
  const source = await openSource(pages, {});
  const nothing = () => {};
  viewer = await openViewer(
    canvas,
    source,
    {
      cover,
      cloth: "#6a2a26",
      paper: () => ({}),
      page: () => page,
      turnSeconds: () => 0.1,
      onStart: nothing,
      onRest: nothing,
      onFailure: nothing,
    },
    new AbortController().signal,
  );
  viewer.resize(400, 300, 1);
  await expect.poll(() => viewer?.settled, { timeout: 20_000 }).toBe(true);
  return canvas;
}

/** Brightness of the canvas where a page's place is seen, 0 to 255. */
async function seenAt(canvas: HTMLCanvasElement, page: number, x: number, y: number) {
  const place = viewer?.project(page, x, y);
  if (!place) return null;
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [1, 1];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  const scale = canvas.width / 400;
  // Within a frame: afterwards a WebGL canvas may be empty.
  viewer?.invalidate();
  await new Promise((resolve) => requestAnimationFrame(resolve));
  pen.drawImage(canvas, -place.x * scale, -place.y * scale);
  return pen.getImageData(0, 0, 1, 1).data[0];
}

test.each([
  { page: 6, cover: "none", seen: [6, 7] },
  { page: 6, cover: "hard", seen: [6, 7] },
  // The boards: outside, inside and both at the other end.
  { page: 1, cover: "hard", seen: [1] },
  { page: 2, cover: "hard", seen: [2, 3] },
  { page: 11, cover: "hard", seen: [10, 11] },
  { page: 12, cover: "hard", seen: [12] },
] as const)("a page's place is seen where it is said, page $page, cover $cover", async (book) => {
  const canvas = await opened(book.page, book.cover);
  for (const page of book.seen) {
    expect(await seenAt(canvas, page, mark.x, mark.y)).toBeLessThan(60);
    for (const [dx, dy] of [
      [0.12, 0],
      [-0.12, 0],
      [0, 0.08],
      [0, -0.08],
    ]) {
      expect(await seenAt(canvas, page, mark.x + dx, mark.y + dy)).toBeGreaterThan(120);
    }
  }
  for (const page of [0, 5, 8, 13, Number.NaN]) {
    if (!(book.seen as readonly number[]).includes(page)) {
      expect(viewer?.project(page, 0.5, 0.5)).toBeNull();
    }
  }
});

test("listeners are told of another view and of leaving it, once, and not at all of the same", async () => {
  await opened(6, "none");
  let told = 0;
  const stop = viewer?.onView(() => told++);
  viewer?.invalidate();
  await expect.poll(() => viewer?.settled).toBe(true);
  expect(told).toBe(0);
  viewer?.resize(360, 300, 1);
  await expect.poll(() => told).toBe(1);
  expect(viewer?.project(6, 0, 0)).not.toBeNull();
  const turned = viewer?.turning.turn(1);
  viewer?.invalidate();
  expect(viewer?.project(6, 0, 0)).toBeNull();
  await expect.poll(() => told, { timeout: 20_000 }).toBeGreaterThan(1);
  await turned;
  await expect.poll(() => told, { timeout: 20_000 }).toBe(3);
  expect(viewer?.project(8, 0, 0)).not.toBeNull();
  stop?.();
  viewer?.resize(400, 300, 1);
  await expect.poll(() => viewer?.settled, { timeout: 20_000 }).toBe(true);
  expect(told).toBe(3);
});
