/** How sharp pages are, measured on the canvas in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { drawSharply } from "../for_tests/drawn_when_seen.ts";
import {
  brightness,
  close,
  height,
  opened,
  settledViewer,
  type ViewedBook,
  width,
} from "../for_tests/viewer_books.ts";
import type { PageBox, PageSource } from "../sources/page_source.ts";

drawSharply();

/** Bars on each page, alternately black and white from edge to edge. */
const bars = 48;

interface Drawing {
  readonly region: PageBox | undefined;
  readonly pixels: number;
  readonly signal: AbortSignal;
}

/**
 * Returns a book whose pages are bars that are sharp at any size, and a record
 * of what was drawn.
 */
function barred(): { source: PageSource; drawn: Drawing[] } {
  const drawn: Drawing[] = [];
  const source: PageSource = {
    title: "Bars",
    language: "",
    direction: "ltr",
    pageCount: 12,
    kind: "scan",
    size: async () => ({ width: 200, height: 300 }),
    label: String,
    async draw(_, across, signal, region) {
      const part = region ?? { x: 0, y: 0, width: 1, height: 1 };
      const canvas = document.createElement("canvas");
      canvas.width = Math.floor(across);
      canvas.height = Math.round((across * 1.5 * part.height) / part.width);
      drawn.push({ region, pixels: canvas.width * canvas.height, signal });
      const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
      pen.fillStyle = "#fff";
      pen.fillRect(0, 0, canvas.width, canvas.height);
      pen.fillStyle = "#000";
      const scale = canvas.width / part.width;
      for (let bar = 0; bar < bars; bar += 2) {
        pen.fillRect((bar / bars - part.x) * scale, 0, scale / bars, canvas.height);
      }
      return canvas;
    },
    close() {},
  };
  return { source, drawn };
}

let book: ViewedBook | null = null;

afterEach(() => {
  if (book) close(book);
  book = null;
});

/**
 * Returns the pixels of the screen in which a bar's edge rises from a tenth of its
 * height to nine tenths: the mean of the visible edges.
 */
async function edgeWidth(): Promise<number> {
  if (book === null) throw new Error("No book is open.");
  const [row] = await brightness(book, [{ x: 0, y: height / 2 }], book.canvas.width);
  const half = (Math.min(...row) + Math.max(...row)) / 2;
  const edges = row.flatMap((value, k) => (k > 0 && row[k - 1] < half !== value < half ? [k] : []));
  const widths: number[] = [];
  for (let k = 1; k + 1 < edges.length; k++) {
    // From the middle of one bar to that of the next, so that light along the page does not count.
    const from = Math.round((edges[k - 1] + edges[k]) / 2);
    const until = Math.round((edges[k] + edges[k + 1]) / 2);
    const part = row.slice(from, until + 1);
    const [low, high] = [Math.min(...part), Math.max(...part)];
    const rising = part[0] < part[part.length - 1] ? part : part.toReversed();
    const crossing = (fraction: number): number => {
      const level = low + fraction * (high - low);
      const at = rising.findIndex((value, i) => i > 0 && rising[i - 1] <= level && value > level);
      return at - (rising[at] - level) / (rising[at] - rising[at - 1]);
    };
    widths.push(crossing(0.9) - crossing(0.1));
  }
  expect(widths.length).toBeGreaterThan(4);
  const dots = book.canvas.width / width;
  return widths.reduce((sum, value) => sum + value, 0) / widths.length / dots;
}

const middle = { x: width / 2, y: height / 2 };
/** Over the middle of the page on the right. */
const onPage = { x: 0.72 * width, y: height / 2 };

test("zoomed, a page is as sharp as the screen can show, however near", async () => {
  const { source, drawn } = barred();
  book = await opened(source, { page: () => 6 });
  const { viewer } = book;
  expect(drawn.every(({ region }) => region === undefined)).toBe(true);
  for (const level of [2, 4, 8]) {
    viewer.zoom(level, onPage, middle, 0);
    await settledViewer(viewer);
    expect(await edgeWidth()).toBeLessThan(1.2);
  }
  const details = drawn.filter(({ region }) => region !== undefined);
  expect(details.length).toBeGreaterThan(0);
  expect(Math.max(...details.map(({ pixels }) => pixels))).toBeLessThan(8.5e6);
  // At rest nothing is drawn again.
  const before = drawn.length;
  for (let k = 0; k < 3; k++) {
    viewer.invalidate();
    await settledViewer(viewer);
  }
  expect(drawn.length).toBe(before);
});

test("without details the same page would be blurred", async () => {
  const { source } = barred();
  const draw = source.draw.bind(source);
  source.draw = (index, across, signal, region) =>
    region ? Promise.reject(new Error("No part can be drawn.")) : draw(index, across, signal);
  book = await opened(source, { page: () => 6 });
  book.viewer.zoom(8, onPage, middle, 0);
  await settledViewer(book.viewer);
  expect(await edgeWidth()).toBeGreaterThan(4);
});

test("a detail stays in sight until the next is there, and goes with the zoom", async () => {
  const { source, drawn } = barred();
  const draw = source.draw.bind(source);
  let gate = Promise.resolve();
  source.draw = async (index, across, signal, region) => {
    if (region) await gate;
    return draw(index, across, signal, region);
  };
  book = await opened(source, { page: () => 6 });
  const { viewer } = book;
  viewer.zoom(6, onPage, middle, 0);
  await settledViewer(viewer);
  let open = () => {};
  gate = new Promise((resolve) => {
    open = resolve;
  });
  // Part of what is in sight now was in sight before.
  viewer.zoom(6, middle, { x: middle.x - 120, y: middle.y }, 0);
  await new Promise((resolve) => requestAnimationFrame(resolve));
  expect(viewer.settled).toBe(false);
  const [row] = await brightness(book, [{ x: 20, y: middle.y }], 300);
  const grey = row.filter((value) => value > 70 && value < 180).length;
  expect(grey).toBeLessThan(20);
  // A movement cancels drawings for another place.
  const count = drawn.length;
  viewer.zoom(7, middle, middle, 0);
  await new Promise((resolve) => requestAnimationFrame(resolve));
  open();
  await settledViewer(viewer);
  expect(drawn.slice(count).some(({ signal }) => signal.aborted)).toBe(true);
  expect(await edgeWidth()).toBeLessThan(1.2);
  viewer.zoom(1, middle, middle, 0);
  await settledViewer(viewer);
  const parts = drawn.filter(({ region }) => region !== undefined).length;
  viewer.invalidate();
  await settledViewer(viewer);
  expect(drawn.filter(({ region }) => region !== undefined).length).toBe(parts);
});
