/**
 * The print of a book at rest beside plain HTML of the same size in the same browser: as black, as sharp,
 * as level, whatever the pixel ratio, drawn by WebGL in software and on the flat.
 */

import type { Page } from "playwright-core";
import { PNG } from "pngjs";
import { afterAll, beforeAll, expect, test } from "vitest";
import { isLong } from "../../turnleaf/src/for_tests/long.ts";
import { chromiumForTests } from "./browser.ts";
import { serveViewer, type ViewerSite } from "./viewer_page.ts";
import { bookSettles, passFrames } from "./waiting.ts";

const { newPage } = chromiumForTests({ isDrawn: true });

/** Of five lines in the type area of a page of text, whatever its size. */
const paragraph =
  "Call me Ishmael. Some years ago, never mind how long precisely, having little or no money in my purse, " +
  "and nothing particular to interest me on shore, I thought I would sail about a little and see the watery " +
  "part of the world.";
const linesOfParagraph = 5;
const text = Array.from({ length: 150 }, () => paragraph).join("\n\n");

/** Size of the type that the book asks for, CSS pixels. */
const asked = 16;

const style = "body { margin: 0; background: #fff } turnleaf-book { width: 1400px; height: 820px }";

let site: ViewerSite;
beforeAll(async () => {
  site = await serveViewer((path) =>
    path === "/book.html"
      ? `<!doctype html><style>${style}</style>
         <script type="importmap">{"imports":{"three":"/three/three.module.js"}}</script>
         <script type="module" src="/turnleaf/index.js"></script>
         <turnleaf-book src="book.txt" page="10" cover="hard"></turnleaf-book>`
      : path === "/book.txt"
        ? text
        : path === "/plain.html"
          ? `<!doctype html><style>${style}</style>`
          : null,
  );
});
afterAll(() => site.stop());

/** Brightness of a picture's pixels, row by row, 0 to 255. */
interface Grey {
  readonly width: number;
  readonly height: number;
  readonly data: Float32Array;
}

async function photograph(page: Page): Promise<Grey> {
  const { width, height, data } = PNG.sync.read(await page.screenshot());
  const grey = new Float32Array(width * height);
  for (let k = 0; k < grey.length; k++) {
    grey[k] = (data[4 * k] + data[4 * k + 1] + data[4 * k + 2]) / 3;
  }
  return { width, height, data: grey };
}

/** A part of a picture: left, top, right, bottom, pixels. */
type Part = readonly [number, number, number, number];

/** Returns a part that begins with its first ink and ends with its last. */
function inkIn({ width, data }: Grey, [left, top, right, bottom]: Part): Part {
  let [l, t, r, b] = [right, bottom, left, top];
  for (let y = top; y < bottom; y++) {
    for (let x = left; x < right; x++) {
      if (data[y * width + x] > 128) continue;
      [l, t, r, b] = [Math.min(l, x), Math.min(t, y), Math.max(r, x + 1), Math.max(b, y + 1)];
    }
  }
  return [l, t, r, b];
}

/** Returns the darkness of each row of a part: 0 without ink. */
function darknessOf({ width, data }: Grey, [left, top, right, bottom]: Part): number[] {
  return Array.from({ length: bottom - top }, (_, k) => {
    let sum = 0;
    for (let x = left; x < right; x++) sum += 255 - data[(top + k) * width + x];
    return sum;
  });
}

/** Returns where the lines of a part stand, pixels: where most ink of a row is followed by least. */
function baselinesOf(grey: Grey, part: Part, pitch: number): number[] {
  const drops = dropsOf(grey, part);
  const found: number[] = [];
  for (let from = 0; from + 0.6 * pitch < drops.length; ) {
    const at = largest(drops, from, Math.round(from + pitch));
    found.push(part[1] + at);
    from = Math.round(at + 0.5 * pitch);
  }
  return found;
}

/** Returns by how much less ink a row of a part has than the one above it. */
function dropsOf(grey: Grey, part: Part): number[] {
  const rows = darknessOf(grey, part);
  return rows.map((dark, k) => (k === 0 ? 0 : rows[k - 1] - dark));
}

function largest(values: readonly number[], from: number, to: number): number {
  const some = values.slice(from, to);
  return from + some.indexOf(Math.max(...some));
}

/**
 * Returns how high letters without ascenders are, pixels: in twenty lines, on the average, as far as rows
 * are at least half as dark as those between.
 */
function xHeightOf(grey: Grey, [left, top, right, bottom]: Part, pitch: number): number {
  const lines = baselinesOf(grey, [left, top, right, bottom + 9], pitch).slice(0, 20);
  const around = Math.round(0.5 * pitch);
  const heights = lines.map((at) => {
    const rows = darknessOf(grey, [left, at - around, right, at + around]);
    const middle = around - Math.round(0.15 * pitch);
    const half = (rows[middle - 1] + rows[middle] + rows[middle + 1]) / 6;
    // A row that is partly as dark counts in part.
    const part = (row: number): number => Math.min(rows[row] / (2 * half), 1);
    const isDark = (row: number): boolean => rows[row] >= half;
    let [first, last] = [middle, middle];
    while (isDark(first - 1)) first -= 1;
    while (isDark(last + 1)) last += 1;
    return last - first + 1 + part(first - 1) + part(last + 1);
  });
  return heights.reduce((sum, height) => sum + height, 0) / heights.length;
}

/** How black and how sharp a part of a picture is. */
interface Ink {
  /** Darkness of its darkest hundredth, and the 99th percentile of its gradients, 0 to 255. */
  readonly black: number;
  readonly steep: number;
}

function inkOf({ width, data }: Grey, [left, top, right, bottom]: Part): Ink {
  const [values, slopes]: [number[], number[]] = [[], []];
  for (let y = top; y < bottom; y++) {
    for (let x = left; x < right; x++) {
      const at = y * width + x;
      values.push(255 - data[at]);
      slopes.push(Math.hypot(data[at + 1] - data[at], data[at + width] - data[at]));
    }
  }
  values.sort((a, b) => b - a);
  slopes.sort((a, b) => b - a);
  const some = Math.ceil(values.length / 100);
  const black = values.slice(0, some).reduce((sum, value) => sum + value, 0) / some;
  return { black, steep: slopes[some] };
}

/** Opens the book. */
async function openBook(deviceScaleFactor: number, isFlat: boolean): Promise<Page> {
  const page = await newPage({ viewport: { width: 1400, height: 820 }, deviceScaleFactor });
  if (isFlat) {
    await page.addInitScript(() => {
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (this: unknown, ...args: unknown[]) {
        return args[0] === "webgl2" ? null : Reflect.apply(getContext, this, args);
      } as typeof getContext;
    });
  }
  await page.goto(`${site.url}book.html`);
  await bookSettles(page);
  await passFrames(page, 2);
  return page;
}

/** Shows the paragraph, over and over, in the size that is asked for and in lines of some length and height. */
async function setPlainly(page: Page, width: number, pitch: number): Promise<void> {
  await page.goto(`${site.url}plain.html`);
  await page.evaluate(
    ([paragraph, width, size, line]) => {
      const column = document.createElement("div");
      column.style.cssText = `position: absolute; left: 40px; top: 40px; width: ${width}px; font: ${size}px/${line}px serif; color: #000`;
      for (let k = 0; k < 6; k++) {
        const one = document.createElement("p");
        one.style.cssText = "margin: 0; text-indent: 1.4em; text-align: justify";
        one.textContent = paragraph;
        column.append(one);
      }
      document.body.append(column);
    },
    [paragraph, width, asked, pitch] as const,
  );
}

/** Places of a page's type: of five lines each, the left or the right half of them, or all. */
function placesOf([left, top, right]: Part, pitch: number): Part[] {
  const middle = Math.round((left + right) / 2);
  const high = Math.round(linesOfParagraph * pitch);
  const part = (from: number, x0: number, x1: number): Part => {
    const y = Math.round(top + from * linesOfParagraph * pitch);
    return [x0, y, x1, y + high];
  };
  return [
    part(0, left, middle),
    part(0, middle, right),
    part(2, left, right),
    part(4, left, middle),
    part(4, middle, right),
  ];
}

/** Ratios of which `make test` has one each: where print is coarsest, and where CSS pixels are no whole ones. */
const usual = { webgl: 1, flat: 1.5 };

const cases = [1, 1.5, 2].flatMap((ratio) =>
  [
    { ratio, backend: "WebGL in software", isFlat: false, isUsual: ratio === usual.webgl },
    { ratio, backend: "the flat", isFlat: true, isUsual: ratio === usual.flat },
  ].filter(({ isUsual }) => isLong || isUsual),
);

test.for(cases)(
  "at a pixel ratio of $ratio print on $backend is that of plain HTML",
  async ({ ratio, isFlat }, { annotate }) => {
    const page = await openBook(ratio, isFlat);
    const seen = await photograph(page);
    const [whole, half] = [seen.width, seen.width / 2];
    const high = Math.round(seen.height * 0.9);
    const low = Math.round(seen.height * 0.1);
    // Between the boards, the folds and the fore-edges.
    const pages = [
      inkIn(seen, [Math.round(0.17 * whole), low, Math.round(half - 0.015 * whole), high]),
      inkIn(seen, [Math.round(half + 0.015 * whole), low, Math.round(0.83 * whole), high]),
    ];
    const ends = pages.map(([left, top, right, bottom]) =>
      baselinesOf(seen, [left, top, (left + right) >> 1, bottom + 9], (bottom - top) / 24),
    );
    expect(ends[0].length).toBeGreaterThanOrEqual(20);
    const pitch = (ends[0][20] - ends[0][0]) / 20;
    // Both pages at one height, and lines level: what of one stands right of the middle stands as high.
    for (let line = 0; line < 20; line++) {
      expect(Math.abs(ends[0][line] - ends[1][line]), `line ${line}`).toBeLessThanOrEqual(
        ratio / 2,
      );
    }
    for (const [k, [left, , right]] of pages.entries()) {
      for (const at of ends[k].slice(0, 20)) {
        const around = Math.round(0.4 * pitch);
        const part: Part = [(left + right) >> 1, at - around, right, at + around];
        // The last line of a paragraph is short.
        if (Math.max(...darknessOf(seen, part)) < 255 * 10) continue;
        const drops = dropsOf(seen, part);
        const there = at - around + largest(drops, 0, drops.length);
        expect(Math.abs(there - at), `line at ${at}`).toBeLessThanOrEqual(ratio / 2);
      }
    }
    // Lines of one beginning begin at one place.
    for (const [k, [left, , right]] of pages.entries()) {
      const starts = ends[k].map(
        (at) => inkIn(seen, [left - 2, Math.round(at - 0.75 * pitch), right, at + 1])[0],
      );
      for (let line = 0; line + linesOfParagraph < starts.length; line++) {
        expect(Math.abs(starts[line + linesOfParagraph] - starts[line])).toBeLessThanOrEqual(
          ratio / 2,
        );
      }
    }
    await setPlainly(page, (pages[0][2] - pages[0][0]) / ratio, pitch / ratio);
    const plain = await photograph(page);
    const column = inkIn(plain, [0, 0, plain.width, plain.height]);
    const wanted = placesOf(column, pitch).map((part) => inkOf(plain, part));
    const report: string[] = [];
    // 16 px asked for are 16 px drawn: letters without ascenders are as high.
    const high16 = xHeightOf(plain, column, pitch);
    for (const type of pages) {
      const drawn = xHeightOf(seen, type, pitch);
      report.push(`x-height ${drawn.toFixed(2)}/${high16.toFixed(2)}`);
      expect(Math.abs(drawn / high16 - 1), report.join(", ")).toBeLessThan(1 / 32);
    }
    for (const type of pages) {
      for (const [k, part] of placesOf(type, pitch).entries()) {
        const { black, steep } = inkOf(seen, part);
        report.push(
          `${black.toFixed(0)}/${wanted[k].black.toFixed(0)} ${steep.toFixed(0)}/${wanted[k].steep.toFixed(0)}`,
        );
        expect(Math.abs(black / wanted[k].black - 1), report.join(", ")).toBeLessThan(0.05);
        expect(Math.abs(steep / wanted[k].steep - 1), report.join(", ")).toBeLessThan(0.05);
      }
    }
    await annotate(`Blackness and steepness, in the book / plain: ${report.join(", ")}`);
  },
);
