import { strToU8, type Zippable, zipSync } from "fflate";
import { expect, test } from "vitest";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";

const never = new AbortController().signal;

/** Returns an image of a width whose rows have colours: the y of each row, or what a function returns for it. */
async function rows(
  width: number,
  height: number,
  colourOf = (y: number) => `rgb(${y >> 8} ${y & 255} 128)`,
): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d")!;
  for (let y = 0; y < height; y++) {
    pen.fillStyle = colourOf(y);
    pen.fillRect(0, y, width, 1);
    // What is no gutter has several colours in a row.
    if (pen.fillStyle !== "#ffffff") pen.clearRect(width - 1, y, 1, 1);
  }
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

async function comic(files: Record<string, Uint8Array>): Promise<PageSource> {
  const bytes = zipSync(files as Zippable) as Uint8Array<ArrayBuffer>;
  return await openSource(new File([bytes], "scroll.cbz"));
}

/** Returns the colours of the first pixels of a page's rows. */
async function drawn(source: PageSource, index: number): Promise<number[][]> {
  const { width, height } = await source.size(index);
  const picture = (await source.draw(index, width, never)) as ImageBitmap;
  expect([picture.width, picture.height]).toEqual([width, Math.round(height)]);
  const pen = new OffscreenCanvas(width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  const { data } = pen.getImageData(0, 0, 1, picture.height);
  return Array.from({ length: picture.height }, (_, y) => [...data.subarray(4 * y, 4 * y + 3)]);
}

const white = [255, 255, 255];

test("a strip is pages of one size, which have all of it, in order and once", async () => {
  const source = await comic({ "1.png": await rows(100, 1500), "2.png": await rows(100, 700) });
  expect(source.pageCount).toBe(14 + 7);
  const seen: number[] = [];
  for (let index = 0; index < 14; index++) {
    expect(await source.size(index)).toEqual({ width: 100, height: 150 });
    for (const [high = 0, low = 0, mark] of await drawn(source, index)) {
      if (mark === 128) seen.push(256 * high + low);
    }
  }
  expect(seen).toEqual(Array.from({ length: 1500 }, (_, y) => y));
  // A part of a page is what the page has there.
  const whole = await drawn(source, 1);
  const part = { x: 0, y: 0.5, width: 1, height: 0.2 };
  const picture = await source.draw(1, 100, never, part);
  const pen = new OffscreenCanvas(100, 30).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  expect([...pen.getImageData(0, 3, 1, 1).data.subarray(0, 3)]).toEqual(whole[78]);
});

test("a cut lies where the strip is of one colour, if that is near, which then goes on to the page's edge", async () => {
  // Pictures of 90 rows, and 10 rows of black between them; cuts are to be every 110 rows.
  const colourOf = (y: number) => (y % 100 < 90 ? `rgb(0 ${y % 100} 128)` : "#ffffff");
  const source = await comic({ "1.png": await rows(100, 440, colourOf) });
  expect(source.pageCount).toBe(4);
  const pages = await Promise.all([0, 1, 2, 3].map((index) => drawn(source, index)));
  // The first cut is moved from 110 to the white before it.
  expect(pages[0]?.at(-1)).toEqual(white);
  expect(pages[1]?.[0]).toEqual(white);
  expect(pages[1]?.filter(([, , blue]) => blue === 128).map(([, y]) => y)).toEqual(
    expect.arrayContaining([0, 89]),
  );
});

test("in a comic of pages a strip has pages of their proportions, and the cover stays first", async () => {
  const source = await comic({
    "cover.png": await rows(80, 100),
    "a1.png": await rows(80, 100),
    "a2.png": await rows(40, 200),
    "a3.png": await rows(80, 100),
  });
  // 200 rows are four times a page of 40 x 50, cut so that each may move.
  expect(source.pageCount).toBe(2 + 6 + 1);
  expect(await source.size(0)).toEqual({ width: 80, height: 100 });
  expect(await source.size(2)).toEqual({ width: 40, height: 50 });
  expect(await source.size(8)).toEqual({ width: 80, height: 100 });
});

test("a wide picture among strips is no spread, nor is one of which ComicInfo.xml says so", async () => {
  const strips = { "1.png": await rows(60, 600), "3.png": await rows(60, 600) };
  const wide = { "2.png": await rows(120, 90) };
  const scrolled = await comic({ ...strips, ...wide });
  const places = Array.from({ length: scrolled.pageCount }, (_, k) => scrolled.inSpread?.(k));
  expect(places.every((place) => place === undefined)).toBe(true);
  const pages = { "1.png": await rows(60, 90), "3.png": await rows(60, 90) };
  expect((await comic({ ...pages, ...wide })).pageCount).toBe(4);
  const xml = `<ComicInfo><Pages><Page Image="1" DoublePage="false"/></Pages></ComicInfo>`;
  const info = { "ComicInfo.xml": strToU8(xml) };
  expect((await comic({ ...pages, ...wide, ...info })).pageCount).toBe(3);
});

test("a strip that claims more pages than there can be is one page", async () => {
  const claim = await rows(1, 4);
  // The height in the header.
  new DataView(claim.buffer).setUint32(20, 0x7fffffff);
  const source = await comic({ "1.png": claim, "2.png": await rows(100, 150) });
  expect(source.pageCount).toBe(2);
});
