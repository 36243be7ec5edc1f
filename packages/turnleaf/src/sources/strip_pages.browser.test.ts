/** Strips in books of images that are no archives: one alone, chosen files, manifests. */

import { expect, test } from "vitest";
import { openSource } from "./open.ts";
import type { PageSource } from "./page_source.ts";

const never = new AbortController().signal;

async function image(width: number, height: number): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d");
  return await canvas.convertToBlob();
}

/** Returns the sizes of a book's pages. */
async function sizesOf(source: PageSource): Promise<string[]> {
  const sizes: string[] = [];
  for (let index = 0; index < source.pageCount; index++) {
    const { width, height } = await source.size(index);
    sizes.push(`${width} x ${height}`);
  }
  return sizes;
}

/** Of a strip of 1,500 pixels, with room to move its cuts to where there is nothing. */
const strip = Array.from({ length: 14 }, () => "100 x 150");

test("an image alone that is a strip is pages, from a file and from an address", async () => {
  const file = new File([await image(100, 1500)], "long.png");
  const chosen = await openSource(file);
  expect(await sizesOf(chosen)).toEqual(strip);
  expect((await chosen.draw(13, 50, never)).width).toBe(50);
  expect(await chosen.file?.()).toBe(file);
  const address = URL.createObjectURL(file);
  expect(await sizesOf(await openSource(address))).toEqual(strip);
  URL.revokeObjectURL(address);
});

test("a strip among chosen files is pages of their proportions", async () => {
  const files = [await image(60, 80), await image(60, 80), await image(60, 800)];
  const source = await openSource(files);
  expect((await sizesOf(source)).slice(0, 3)).toEqual(["60 x 80", "60 x 80", "60 x 80"]);
  expect(source.pageCount).toBe(2 + 14);
});

test("in a manifest with sizes, lines and links lead to the same pictures", async () => {
  const data = (blob: Blob): Promise<string> =>
    new Promise((resolve) => {
      const reader = new FileReader();
      reader.onload = () => resolve(reader.result as string);
      reader.readAsDataURL(blob);
    });
  const [tall, page] = [await data(await image(100, 1500)), await data(await image(100, 150))];
  const box = { x: 0, y: 0, width: 9, height: 9 };
  const source = await openSource({
    pages: [
      { src: page, width: 100, height: 150 },
      { src: tall, width: 100, height: 1500, label: "A", alt: "A strip" },
      { src: page, width: 100, height: 150, links: [{ ...box, page: 3 }] },
      { src: tall, width: 100, height: 1500, links: [{ ...box, page: 2 }] },
    ],
    outline: [{ title: "Last", page: 4, children: [{ title: "Third", page: 3 }] }],
  });
  expect(await sizesOf(source)).toEqual(["100 x 150", ...strip, "100 x 150", "100 x 1500"]);
  expect([source.label(1), await source.alt?.(1, never)]).toEqual(["A", "A strip"]);
  expect(await source.outline?.(never)).toEqual([
    { title: "Last", page: 17, children: [{ title: "Third", page: 16, children: [] }] },
  ]);
  const targets = [15, 16].map(async (index) => (await source.links?.(index, never))?.[0]?.to);
  expect(await Promise.all(targets)).toEqual([{ page: 16 }, { page: 2 }]);
});

test("tall pages that are no strips, and wide ones, are left whole", async () => {
  const files = [await image(60, 80), await image(60, 120), await image(200, 80)];
  expect(await sizesOf(await openSource(files))).toEqual(["60 x 80", "60 x 120", "200 x 80"]);
  expect(await sizesOf(await openSource(await image(100, 250)))).toEqual(["100 x 250"]);
});
