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

test("a cut with nothing of one colour near lies where it goes through the fewest outlines, and through no line of letters", async () => {
  const canvas = new OffscreenCanvas(100, 440);
  const pen = canvas.getContext("2d")!;
  for (let y = 0; y < 440; y++) {
    // The frame of a picture at both sides, and its sky.
    pen.fillStyle = `rgb(${y >> 8} ${y & 255} 128)`;
    pen.fillRect(0, y, 100, 1);
    pen.clearRect(2, y, 1, 1);
    pen.clearRect(97, y, 1, 1);
    // Letters in rows 104 to 115, about the place of the first cut, and in 216 to 227.
    if (![104, 216].some((top) => y >= top && y < top + 12)) continue;
    for (let x = 10; x < 90; x += 4) pen.clearRect(x, y, 2, 1);
  }
  const png = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
  const source = await comic({ "1.png": png });
  expect(source.pageCount).toBe(4);
  const seen: number[][] = [];
  for (let index = 0; index < 4; index++) {
    const own = await drawn(source, index);
    seen.push(own.flatMap(([high = 0, low = 0, mark]) => (mark === 128 ? [256 * high + low] : [])));
  }
  expect(seen.flat()).toEqual(Array.from({ length: 440 }, (_, y) => y));
  const cuts = seen.slice(1).map(([first]) => first);
  // One goes down and the next one up to the nearest rows beside letters; the last one stays.
  expect(cuts).toEqual([117, 214, 330]);
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

/** Draws what a book shows, in its pixels. */
type Draw = (pen: OffscreenCanvasRenderingContext2D, width: number, height: number) => void;

/** Returns a picture with panels of gradients, lines and discs from edge to edge, over a height; each seed has its own. */
const panels =
  (seed: number): Draw =>
  (pen, width, height) => {
    let state = seed;
    const next = (most: number) => {
      state = (state * 48271) % 2147483647;
      return state % most;
    };
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, width, height);
    for (let y = 0; y < height; ) {
      const tall = 150 + next(400);
      const ink = pen.createLinearGradient(0, y, width, y + tall);
      for (const at of [0, 0.5, 1]) ink.addColorStop(at, `hsl(${next(360)} 70% ${20 + next(60)}%)`);
      pen.fillStyle = ink;
      pen.fillRect(0, y, width, tall);
      for (let k = 0; k < 12; k++) {
        pen.fillStyle = pen.strokeStyle = `hsl(${next(360)} 60% ${next(100)}%)`;
        pen.beginPath();
        pen.arc(next(width), y + next(tall), 5 + next(60), 0, 2 * Math.PI);
        if (k % 2) pen.fill();
        else pen.stroke();
      }
      y += tall + (next(3) === 0 ? 40 : 0);
    }
  };

/** Returns slices of a picture in the heights that are named. */
async function slices(
  draw: Draw,
  width: number,
  heights: readonly number[],
  type = "image/jpeg",
): Promise<Uint8Array[]> {
  const height = heights.reduce((sum, one) => sum + one, 0);
  const whole = new OffscreenCanvas(width, height);
  draw(whole.getContext("2d")!, width, height);
  const files: Uint8Array[] = [];
  let top = 0;
  for (const one of heights) {
    const canvas = new OffscreenCanvas(width, one);
    canvas.getContext("2d")!.drawImage(whole, 0, -top);
    top += one;
    const blob = await canvas.convertToBlob({ type, quality: 0.8 });
    files.push(new Uint8Array(await blob.arrayBuffer()));
  }
  return files;
}

const named = (files: readonly Uint8Array[]): Record<string, Uint8Array> =>
  Object.fromEntries(files.map((file, k) => [`${String(k).padStart(3, "0")}.jpg`, file]));

test.each([
  ["of one height", [320, 320, 320, 320, 320, 320]],
  ["of several", [320, 100, 900, 320, 20, 250]],
  ["of which there are two", [320, 200]],
])("slices of a strip %s are pages of the whole strip, in order and once", async (_, heights) => {
  const draw: Draw = (pen, width, height) => {
    panels(7)(pen, width, height);
    for (let y = 0; y < height; y++) {
      pen.fillStyle = `rgb(${y >> 8} ${y & 255} 128)`;
      pen.fillRect(0, y, 1, 1);
    }
  };
  const source = await comic(named(await slices(draw, 200, heights, "image/png")));
  const height = heights.reduce((sum, one) => sum + one, 0);
  const count = Math.ceil(height / (200 * 1.5 * 0.75));
  expect(source.pageCount).toBe(count);
  const seen: number[] = [];
  for (let index = 0; index < count; index++) {
    expect(await source.size(index)).toEqual({ width: 200, height: 300 });
    for (const [high = 0, low = 0, mark] of await drawn(source, index)) {
      if (mark === 128) seen.push(256 * high + low);
    }
  }
  expect(seen).toEqual(Array.from({ length: height }, (_, y) => y));
});

test("a cover, chapters in folders and credits stay apart, bookmarks lead to their slices", async () => {
  const strip = await slices(panels(3), 200, [320, 320, 320, 320]);
  const [cover] = await slices(panels(2000), 200, [290]);
  const [credits] = await slices(panels(4000), 200, [310]);
  const bookmark = `<ComicInfo><Pages><Page Image="3" Bookmark="Third"/></Pages></ComicInfo>`;
  const source = await comic({
    ...named([cover, ...strip, credits]),
    "ComicInfo.xml": strToU8(bookmark),
  });
  expect(source.pageCount).toBe(1 + 6 + 1);
  expect(await source.size(0)).toEqual({ width: 200, height: 290 });
  expect(await source.size(7)).toEqual({ width: 200, height: 310 });
  // The third slice begins at 640 of 1280, where the fourth page does.
  expect(await source.outline?.(never)).toEqual([{ title: "Third", page: 5, children: [] }]);
  const chapters = await comic({ "1/1.jpg": strip[0], "1/2.jpg": strip[1], "2/1.jpg": strip[2] });
  expect(chapters.pageCount).toBe(3 + 1);
});

test("slices that are chosen as files are pages of the whole strip", async () => {
  const files = await slices(panels(5), 200, [320, 320, 320, 320]);
  const blobs = files.map((file, k) => new File([file as BlobPart], `${k}.jpg`));
  expect((await openSource(blobs)).pageCount).toBe(6);
});

/** Returns pages of one width: each drawn apart. */
async function paged(draws: readonly Draw[], height = 300): Promise<number> {
  const files = await Promise.all(draws.map((draw) => slices(draw, 200, [height])));
  return (await comic(named(files.flat()))).pageCount;
}

test.each<[string, (seed: number) => Draw]>([
  ["pictures to their edges", (seed) => panels(seed)],
  [
    "white margins",
    (seed) => (pen, width, height) => {
      panels(seed)(pen, width, height);
      pen.lineWidth = 24;
      pen.strokeStyle = "#fff";
      pen.strokeRect(0, 0, width, height);
    },
  ],
  [
    "a scanner's border around specked paper",
    (seed) => (pen, width, height) => {
      panels(seed)(pen, width, height);
      pen.fillStyle = "#eee";
      for (const y of [0, height - 20]) {
        pen.fillRect(0, y, width, 20);
        for (let k = 0; k < 60; k++) {
          pen.globalAlpha = (((k + seed) * 7) % 10) / 10;
          pen.fillStyle = "#888";
          pen.fillRect((k * 37 * seed) % width, y + ((k * 13) % 20), 2, 2);
        }
        pen.globalAlpha = 1;
      }
      pen.fillStyle = "#111";
      for (const x of [0, width - 14]) pen.fillRect(x, 0, 14, height);
    },
  ],
  [
    "a black ground",
    (seed) => (pen, width, height) => {
      pen.fillStyle = "#000";
      pen.fillRect(0, 0, width, height);
      pen.translate(0, 60);
      pen.beginPath();
      pen.rect(0, 0, width, height - 120);
      pen.clip();
      panels(seed)(pen, width, height);
    },
  ],
])("pages of one width with %s are no slices", async (_, draw) => {
  expect(await paged([1, 2, 3, 4, 5, 6].map((seed) => draw(seed * 101)))).toBe(6);
});
