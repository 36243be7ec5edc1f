/** Where pages are visible, measured on the canvas in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import {
  brightness,
  close,
  opened,
  settledViewer,
  type ViewedBook,
} from "../for_tests/viewer_books.ts";
import { openSource } from "../sources/open.ts";

/** Returns a page with a black square about a place of it, in fractions of the page. */
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

let book: ViewedBook | null = null;

afterEach(() => {
  if (book) close(book);
  book = null;
});

/** Opens a book of marked pages at a page. */
async function openedAt(page: number, cover: "hard" | "none") {
  const pages = Array.from({ length: 12 }, () => marked(mark.x, mark.y));
  book = await opened(await openSource(pages, {}), { cover, page: () => page });
  return book;
}

const spotOf = (place: { x: number; y: number } | null): [number, number] => [
  place?.x ?? Number.NaN,
  place?.y ?? Number.NaN,
];

/** Places about the mark, in fractions of the page from it: where nothing is printed. */
const around = [
  [0.12, 0],
  [-0.12, 0],
  [0, 0.08],
  [0, -0.08],
] as const;

/** Expects the mark of every visible page, and paper at some places about it, where they are projected. */
async function expectMarks(
  pages: readonly number[],
  paper: readonly (readonly number[])[] = around,
) {
  const offsets = [[0, 0], ...paper];
  const places = pages.flatMap((page) =>
    offsets.map(([dx, dy]) => book?.viewer.project(page, mark.x + dx, mark.y + dy)),
  );
  expect(places).not.toContainEqual(null);
  const seen = await brightness(book as ViewedBook, places as { x: number; y: number }[]);
  for (const [k, [value]] of seen.entries()) {
    if (k % offsets.length === 0) expect(value).toBeLessThan(60);
    else expect(value).toBeGreaterThan(120);
  }
}

test.each([
  { page: 6, cover: "none", seen: [6, 7] },
  { page: 6, cover: "hard", seen: [6, 7] },
  // The boards: outside, inside and both at the other end.
  { page: 1, cover: "hard", seen: [1] },
  { page: 2, cover: "hard", seen: [2, 3] },
  { page: 11, cover: "hard", seen: [10, 11] },
  { page: 12, cover: "hard", seen: [12] },
] as const)(
  "a page's place is seen where it is said, page $page, cover $cover",
  async ({ page, cover, seen }) => {
    const { viewer } = await openedAt(page, cover);
    await expectMarks(seen);
    for (const page of [0, 5, 8, 13, Number.NaN]) expect(viewer.project(page, 0.5, 0.5)).toBeNull();
  },
);

test("listeners are called once for another view and for leaving it, and not for the same", async () => {
  const { viewer } = await openedAt(6, "none");
  let calls = 0;
  const stop = viewer.onViewChange(() => calls++);
  viewer.invalidate();
  await eventually(() => viewer.settled).toBe(true);
  expect(calls).toBe(0);
  viewer.resize(360, 300, 1);
  await eventually(() => calls).toBe(1);
  expect(viewer.project(6, 0, 0)).not.toBeNull();
  const turned = viewer.turning.turn(1);
  viewer.invalidate();
  expect(viewer.project(6, 0, 0)).toBeNull();
  await eventually(() => calls).toBeGreaterThan(1);
  await turned;
  await eventually(() => calls).toBe(3);
  expect(viewer.project(8, 0, 0)).not.toBeNull();
  stop();
  viewer.resize(400, 300, 1);
  await eventually(() => viewer.settled).toBe(true);
  expect(calls).toBe(3);
});

test("zoomed and panned, a page's place is seen where it is said, and what is pointed at stays there", async () => {
  const { viewer } = await openedAt(6, "hard");
  const at = viewer.project(7, mark.x, mark.y);
  if (at === null) throw new Error("Page 7 does not lie open.");
  for (const level of [2, 5, 3]) {
    viewer.zoom(level, at, at, 0);
    await settledViewer(viewer);
    expect(viewer.zoomLevel).toBe(level);
    const now = viewer.project(7, mark.x, mark.y);
    // From the reader's view to the view from above, the heights of the pages move them a little.
    expect(now?.x).toBeCloseTo(at.x, -1);
    expect(now?.y).toBeCloseTo(at.y, -1);
    const paper = [around[1], around[2]];
    await expectMarks([7], level === 5 ? [] : paper);
  }
  const before = viewer.project(7, 0, 0);
  viewer.zoom(3, { x: 100, y: 100 }, { x: 80, y: 110 }, 0);
  await settledViewer(viewer);
  const after = viewer.project(7, 0, 0);
  expect((after?.x ?? 0) - (before?.x ?? 0)).toBeCloseTo(-20, 0);
  expect((after?.y ?? 0) - (before?.y ?? 0)).toBeCloseTo(10, 0);
  await expectMarks([7], []);
  // A pointer grabs the page where it is seen.
  const hold = viewer.drags.pick(...spotOf(viewer.project(7, 0.9, 0.5)));
  expect(hold?.u).toBeCloseTo(0.9, 1);
  expect(hold?.v).toBeCloseTo(0.5, 1);
  viewer.zoom(1, at, at, 0);
  await settledViewer(viewer);
  expect(viewer.project(7, mark.x, mark.y)?.x).toBeCloseTo(at.x, 3);
  expect(viewer.project(7, mark.x, mark.y)?.y).toBeCloseTo(at.y, 3);
});

test("a size that is reported again asks for no frame", async () => {
  const { viewer, canvas } = await openedAt(1, "none");
  viewer.resize(canvas.clientWidth, canvas.clientHeight, 1);
  expect(viewer.settled).toBe(true);
  viewer.resize(canvas.clientWidth, canvas.clientHeight, 2);
  expect(viewer.settled).toBe(false);
});
