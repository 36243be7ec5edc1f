/** Pictures fitted to the leaf: their size, and what is held of them. */

import { expect, test } from "vitest";
import type { PagePicture, PageSource } from "../sources/page_source.ts";
import { fitToLeaf } from "./fit.ts";
import { PagePictures } from "./page_pictures.ts";

function sheet(width: number, height: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  return canvas;
}

test("a picture of the leaf's proportions is left alone", () => {
  const picture = sheet(300, 400);
  expect(fitToLeaf(picture, 0.75, 300)).toBe(picture);
});

test("other proportions take no more pixels than the leaf is wanted with", () => {
  for (const [width, height, aspect] of [
    [512, 2048, 4],
    [512, 128, 0.25],
    [512, 700, 0.7],
  ]) {
    const { width: w, height: h } = fitToLeaf(sheet(width, height), aspect, 512);
    expect(w).toBeLessThanOrEqual(512);
    expect(Math.abs(w / h / aspect - 1)).toBeLessThan(0.02);
  }
  // A small picture is not blown up: the graphics card does that as well.
  expect(fitToLeaf(sheet(100, 50), 0.5, 512).width).toBe(100);
});

test("the whole picture is in the middle of the paper", () => {
  const picture = sheet(100, 100);
  const pen = picture.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#00f";
  pen.fillRect(0, 0, 100, 100);
  const fitted = fitToLeaf(picture, 2, 100) as HTMLCanvasElement;
  const seen = fitted.getContext("2d") as CanvasRenderingContext2D;
  const at = (x: number, y: number) => [...seen.getImageData(x, y, 1, 1).data];
  expect([fitted.width, fitted.height]).toEqual([100, 50]);
  expect(at(50, 25)).toEqual([0, 0, 255, 255]);
  expect(at(28, 2)).toEqual([0, 0, 255, 255]);
  expect(at(20, 25)).toEqual([0xfb, 0xf5, 0xe8, 255]);
});

test("of a picture that was fitted the fitted one alone is held, and freed at the end", async () => {
  const drawn: HTMLCanvasElement[] = [];
  const source = {
    title: "Slides",
    pageCount: 1,
    label: () => "1",
    draw: async (_: number, width: number) => {
      drawn.push(sheet(width, width / 2));
      return drawn.at(-1);
    },
  } as unknown as PageSource;
  const dropped: PagePicture[] = [];
  const pictures = new PagePictures(source, 0.7, {
    onArrive: () => {},
    onDrop: (picture) => dropped.push(picture),
  });
  pictures.want({ pages: [1], inSight: 1, lyingOpen: 1 }, 256, false);
  await expect.poll(() => pictures.settled).toBe(true);
  for (const { width } of drawn) expect(width).toBe(0);
  const shown = pictures.get(1);
  expect(shown.width).toBe(256);
  pictures.close();
  expect(dropped).toContain(shown);
  expect(shown.width).toBe(0);
});
