/** Bitmaps fitted to the leaf: their size, and which of them are kept. */

import { expect, test } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import type { PageBox, PagePicture, PageSource } from "../sources/page_source.ts";
import { fitToLeaf, unfold } from "./fit.ts";
import { PageBitmaps } from "./page_bitmaps.ts";
import { foldAt, placeOnLeaf } from "./page_place.ts";

function sheet(width: number, height: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  return canvas;
}

test("other proportions take no more pixels than the leaf is wanted with", () => {
  for (const [width, height, aspect] of [
    [512, 2048, 4],
    [512, 128, 0.25],
    [512, 700, 0.7],
  ]) {
    const place = placeOnLeaf({ width, height }, { width: aspect, height: 1 }, false, "left");
    const { width: w, height: h } = fitToLeaf(sheet(width, height), place, aspect, 512, "#fbf5e8");
    expect(w).toBeLessThanOrEqual(512);
    expect(Math.abs(w / h / aspect - 1)).toBeLessThan(0.02);
  }
  // A small bitmap is not enlarged: the graphics card does that as well.
  const half = { x: 0, y: 0.375, width: 1, height: 0.25 };
  expect(fitToLeaf(sheet(100, 50), half, 0.5, 512, "#fbf5e8").width).toBe(100);
});

test("a smaller page lies on a clear leaf, a little smaller one on paper", () => {
  const picture = sheet(100, 100);
  const pen = picture.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#00f";
  pen.fillRect(0, 0, 100, 100);
  const colours = (place: PageBox, ...places: [number, number][]) => {
    const fitted = fitToLeaf(picture, place, 2, 100, "#fbf5e8") as HTMLCanvasElement;
    const seen = fitted.getContext("2d") as CanvasRenderingContext2D;
    expect([fitted.width, fitted.height]).toEqual([100, 50]);
    return places.map(([x, y]) => [...seen.getImageData(x, y, 1, 1).data]);
  };
  const blue = [0, 0, 255, 255];
  const half = { x: 0.5, y: 0, width: 0.5, height: 1 };
  expect(colours(half, [52, 2], [98, 48], [48, 25])).toEqual([blue, blue, [0, 0, 0, 0]]);
  const most = { x: 0, y: 0, width: 0.95, height: 1 };
  expect(colours(most, [2, 2], [93, 48], [98, 25])).toEqual([blue, blue, [0xfb, 0xf5, 0xe8, 255]]);
});

test("a fold-out is folded in: its flap's back lies on the page, at its fore-edge", () => {
  for (const [on, free] of [
    ["left", 0.4],
    ["right", 0.6],
  ] as const) {
    const picture = sheet(150, 100);
    const pen = picture.getContext("2d") as CanvasRenderingContext2D;
    pen.fillStyle = "#00f";
    pen.fillRect(0, 0, 150, 100);
    const place = placeOnLeaf({ width: 15, height: 10 }, { width: 10, height: 10 }, false, on);
    const fitted = fitToLeaf(picture, place, 1, 100, "#fbf5e8") as HTMLCanvasElement;
    const seen = fitted.getContext("2d") as CanvasRenderingContext2D;
    const at = (x: number) => [...seen.getImageData(x, 50, 1, 1).data];
    expect(at(100 * (0.5 + 1.2 * (free > 0.5 ? 0.3 : -0.3)))).toEqual([0, 0, 255, 255]);
    expect(at(100 * (1 - free))).toEqual([0xfb, 0xf5, 0xe8, 255]);
    const { page, flap } = unfold(picture, place, 1, 100, "#fbf5e8");
    expect([page.width, flap.width]).toEqual([100, 52]);
    for (const part of [page, flap]) {
      const pixels = part.getContext("2d") as CanvasRenderingContext2D;
      const { width, height } = part;
      expect([...pixels.getImageData(width / 2, height / 2, 1, 1).data]).toEqual([0, 0, 255, 255]);
    }
  }
});

test("of the parts of a page, and of one beside which its leaf is clear, no pixel is covered in part", () => {
  const picture = sheet(200, 100);
  const pen = picture.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#00f";
  pen.fillRect(0, 0, 200, 100);
  const isWhole = (canvas: HTMLCanvasElement): boolean => {
    const { data } = (canvas.getContext("2d") as CanvasRenderingContext2D).getImageData(
      0,
      0,
      canvas.width,
      canvas.height,
    );
    return data.every((alpha, k) => k % 4 < 3 || alpha === 0 || alpha === 255);
  };
  for (const on of ["left", "right"] as const) {
    for (const wide of [17, 23, 37]) {
      const leaf = { width: 10, height: 10 };
      const place = placeOnLeaf({ width: wide, height: 10 }, leaf, true, on);
      const small = placeOnLeaf({ width: 6.3, height: 8.7 }, leaf, true, on);
      for (const width of [97, 100, 103]) {
        const { page, flap, back } = unfold(picture, place, 1, width, "#fbf5e8");
        const shut = fitToLeaf(picture, place, 1, width, "#fbf5e8");
        const cut = fitToLeaf(picture, small, 1, width, "#fbf5e8");
        expect([page, flap, back, shut, cut].map(isWhole)).toEqual(Array(5).fill(true));
        // What is printed goes on under the flap, which begins within a pixel of the fold.
        const fold = Math.ceil(foldAt * page.width);
        const under = on === "left" ? fold : page.width - 1 - fold;
        const seen = page.getContext("2d") as CanvasRenderingContext2D;
        expect([...seen.getImageData(under, 50, 1, 1).data]).toEqual([0, 0, 255, 255]);
      }
    }
  }
});

/** Returns a source of one page, twice as wide as it is high, and a list of what it has drawn. */
function slides(): { source: PageSource; drawn: HTMLCanvasElement[] } {
  const drawn: HTMLCanvasElement[] = [];
  const source = {
    title: "Slides",
    pageCount: 1,
    label: () => "1",
    kind: "scan",
    size: async () => ({ width: 2, height: 1 }),
    draw: async (_: number, width: number) => {
      drawn.push(sheet(width, width / 2));
      return drawn.at(-1);
    },
  } as unknown as PageSource;
  return { source, drawn };
}

test("a picture of the leaf's proportions is shown itself", async () => {
  const { source, drawn } = slides();
  const leaf = { width: 2, height: 1 };
  const pictures = new PageBitmaps(source, leaf, { onArrive: () => {}, onDrop: () => {} });
  pictures.want({ pages: [1], inSight: 1, lyingOpen: 1 }, () => 256, false);
  await eventually(() => pictures.settled).toBe(true);
  expect(pictures.get(1)).toBe(drawn.at(-1));
  pictures.close();
});

test("of a picture that was fitted the fitted one alone is held, and freed at the end", async () => {
  const { source, drawn } = slides();
  const dropped: PagePicture[] = [];
  const pictures = new PageBitmaps(
    source,
    { width: 2.2, height: 1 },
    {
      onArrive: () => {},
      onDrop: (picture) => dropped.push(picture),
    },
  );
  pictures.want({ pages: [1], inSight: 1, lyingOpen: 1 }, () => 256, false);
  await eventually(() => pictures.settled).toBe(true);
  for (const { width } of drawn) expect(width).toBe(0);
  const shown = pictures.get(1);
  expect(shown.width).toBe(256);
  pictures.close();
  expect(dropped).toContain(shown);
  expect(shown.width).toBe(0);
});

test("in place of a page that takes long stands a sentence, until it is drawn", async () => {
  let finish = (_: HTMLCanvasElement): void => {};
  const { source } = slides();
  source.draw = () =>
    new Promise((resolve) => {
      finish = resolve;
    });
  let elapse = (): void => {};
  let arrived = 0;
  const leaf = { width: 2, height: 1 };
  const pictures = new PageBitmaps(source, leaf, {
    onArrive: () => arrived++,
    onDrop: () => {},
    slowText: (label) => `Page ${label} takes long.`,
    later: (call) => {
      elapse = call;
      return () => {};
    },
  });
  const ink = (picture: PagePicture) => {
    const pen = (picture as HTMLCanvasElement).getContext("2d") as CanvasRenderingContext2D;
    const { data } = pen.getImageData(0, 0, picture.width, picture.height);
    return data.filter((value, k) => k % 4 === 0 && value < 0xc0).length;
  };
  pictures.want({ pages: [1], inSight: 1, lyingOpen: 1 }, () => 300, false);
  await eventually(() => finish.length).toBe(1);
  const waiting = pictures.get(1);
  elapse();
  expect(arrived).toBe(1);
  const slow = pictures.get(1);
  expect(slow).not.toBe(waiting);
  expect(ink(slow)).toBeGreaterThan(10 * ink(waiting) + 100);
  expect(pictures.failure(1)).toBeNull();
  const drawn = sheet(300, 150);
  finish(drawn);
  await eventually(() => pictures.get(1)).toBe(drawn);
  pictures.close();
});

test("a page out of sight that is to be drawn in other colours is not shown in those that it had", async () => {
  const { source } = slides();
  const leaf = { width: 2, height: 1 };
  const pictures = new PageBitmaps(source, leaf, { onArrive: () => {}, onDrop: () => {} });
  pictures.want({ pages: [1], inSight: 1, lyingOpen: 1 }, () => 256, false);
  await eventually(() => pictures.settled).toBe(true);
  const byDay = pictures.get(1);
  pictures.want({ pages: [], inSight: 0, lyingOpen: 0 }, () => 256, false);
  expect(pictures.getIfDrawn(1)).toBe(byDay);
  pictures.recolour("night");
  // The edges of a board beside other pages would be as bright as its cover was.
  expect(pictures.getIfDrawn(1)).toBeNull();
  // In sight it is shown until it is drawn anew.
  pictures.want({ pages: [1], inSight: 1, lyingOpen: 1 }, () => 256, false);
  expect(pictures.getIfDrawn(1)).toBe(byDay);
  await eventually(() => pictures.getIfDrawn(1) !== byDay).toBe(true);
  pictures.close();
});
