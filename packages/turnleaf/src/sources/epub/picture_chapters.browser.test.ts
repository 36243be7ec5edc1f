/** Chapters that are pictures of formats that few browsers show, and pictures of these that are written as data. */

import { expect, test } from "vitest";
import { closeBooks, laidOut, wordsOf } from "../../for_tests/laid_out_books.ts";
import type { PageSource } from "../page_source.ts";
import { tinyTiff } from "../rare_images/tiny_tiff.ts";
import { tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;
closeBooks();

const fixture = async (name: string): Promise<Uint8Array<ArrayBuffer>> => {
  const response = await fetch(new URL(`../rare_images/fixtures/${name}`, import.meta.url));
  return new Uint8Array(await response.arrayBuffer());
};

/** Of this folder or, if it lies turned, of the other. */
const pictureNamed = async (name: string): Promise<Uint8Array<ArrayBuffer>> => {
  if (!/^\d/.test(name)) return await fixture(name);
  const response = await fetch(new URL(`../fixtures/turned/${name}`, import.meta.url));
  return new Uint8Array(await response.arrayBuffer());
};

const fixed = '<meta property="rendition:layout">pre-paginated</meta>';

/** Opens a book with a file in its spine after a chapter. */
async function withChapter(
  name: string,
  type: string,
  file: Uint8Array<ArrayBuffer>,
  more: { readonly metadata?: string; readonly fallback?: string } = {},
): Promise<PageSource> {
  const { metadata = "", fallback = "" } = more;
  return await laidOut(
    tinyEpub({
      chapters: ["<p>Before.</p>"],
      raw: { [`OEBPS/${name}`]: file },
      items: `<item id="p" href="${name}" media-type="${type}" ${fallback}/>`,
      itemrefs: '<itemref idref="p"/>',
      metadata,
    }),
  );
}

/** Returns the colour in the middle of a page. */
async function colourOf(source: PageSource, index: number): Promise<string> {
  const drawn = (await source.draw(index, 90, never)) as ImageBitmap;
  const pen = new OffscreenCanvas(drawn.width, drawn.height).getContext("2d")!;
  pen.drawImage(drawn, 0, 0);
  const { data } = pen.getImageData(drawn.width >> 1, drawn.height >> 1, 1, 1);
  return [...data.slice(0, 3)].join(" ");
}

const red = { colour: [255, 0, 0], width: 300, height: 450 } as const;
const blue = { colour: [0, 0, 255], width: 300, height: 450 } as const;

test.each(["image/tiff", "image/x-tiff"])("each page of a TIFF of type %s is one", async (type) => {
  for (const metadata of ["", fixed]) {
    const source = await withChapter("a.tif", type, tinyTiff([red, blue]), { metadata });
    expect(source.pageCount).toBe(3);
    if (metadata === fixed) {
      expect([await colourOf(source, 1), await colourOf(source, 2)]).toEqual([
        "255 0 0",
        "0 0 255",
      ]);
      expect(await source.size(1)).toEqual({ width: 300, height: 450 });
    }
    expect(source.warnings ?? []).toEqual([]);
  }
});

test("a JPEG 2000 is shown, and so is a PNG whose type is written otherwise", async () => {
  const jpeg = await withChapter("a.jp2", "image/jp2", await fixture("rgb.jp2"), {
    metadata: fixed,
  });
  expect([jpeg.pageCount, jpeg.warnings ?? []]).toEqual([2, []]);
  await jpeg.draw(1, 50, never);
  const canvas = new OffscreenCanvas(9, 9);
  canvas.getContext("2d");
  const png = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
  const other = await withChapter("a.png", "image/x-png", png, { metadata: fixed });
  expect(await other.size(1)).toEqual({ width: 9, height: 9 });
});

test.each([
  [
    "a HEIC",
    "a.heic",
    "image/heic",
    "OEBPS/a.heic, a chapter of this book, is a HEIC, which this browser does not show; convert it to PNG or JPEG.",
  ],
  [
    "what is no image",
    "a.png",
    "image/png",
    "OEBPS/a.png, a chapter of this book, is damaged or no image; get the book again.",
  ],
])("%s is a page that says so, and is listed", async (_, name, type, sentence) => {
  for (const metadata of ["", fixed]) {
    const file = type === "image/heic" ? await fixture("rgb.heic") : Uint8Array.of(1, 2, 3);
    const source = await withChapter(name, type, file, { metadata });
    expect(source.pageCount).toBe(2);
    await expect(source.draw(1, 50, never)).rejects.toThrow(sentence);
    expect((source.warnings ?? []).map(({ message, page }) => [message, page])).toEqual([
      [sentence, 2],
    ]);
  }
});

test("what a book gives in place of a picture that few browsers show is shown", async () => {
  const source = await withChapter("a.tif", "image/tiff", tinyTiff([red, blue]), {
    fallback: 'fallback="c0"',
  });
  expect(source.pageCount).toBe(2);
  expect(await wordsOf(source, 1)).toBe("Before.");
});

test("a TIFF that is written into a chapter as data is shown; a HEIC is listed", async () => {
  const [tiff, heic] = [tinyTiff([red]), await fixture("rgb.heic")].map((bytes) =>
    btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")),
  );
  const source = await laidOut(
    tinyEpub({
      chapters: [
        `<div style="width: 300px; height: 450px; background: url(data:image/tiff;base64,${tiff})"></div>`,
        `<p>After.</p><img alt="" src="data:image/heic;base64,${heic}"/>`,
      ],
      metadata: fixed.replace(
        /$/,
        '<meta property="rendition:viewport">width=300, height=450</meta>',
      ),
    }),
  );
  expect(await colourOf(source, 0)).toBe("255 0 0");
  expect((source.warnings ?? []).map(({ code }) => code)).toEqual(["image"]);
});

/** A picture in a chapter that is drawn as its lower right quarter alone, and what it is there. */
const quarters = [
  ["rgb-lzw.tif", "255 255 255"],
  ["float-rgb.tif", "255 255 255"],
  ["ycbcr-raw22.tif", "255 255 255"],
  ["rgb.jp2", "255 255 255"],
  ["rgb.jxl", "255 255 255"],
  ["cmyk-unmarked.jpg", "255 255 255"],
  ["6.webp", "0 255 0"],
] as const;

test.each(quarters)("a picture in a chapter that is %s is shown as it is", async (name, colour) => {
  const source = await laidOut(
    tinyEpub({
      chapters: [
        '<div style="background: #808080"><img src="picture.png" alt="none" style="position: absolute; left: -1000px; top: -1000px; width: 2000px; height: 2000px"/></div>',
      ],
      properties: { 0: "rendition:layout-pre-paginated" },
      files: { "picture.png": await pictureNamed(name) },
    }),
  );
  expect(source.warnings).toEqual([]);
  expect(await colourOf(source, 0)).toBe(colour);
});

test("a picture in a chapter that no browser here shows is listed", async () => {
  const source = await laidOut(
    tinyEpub({
      chapters: [
        '<p>Before. <img src="a.heic" alt="A view"/> <img src="b.jp2" alt="Another"/></p>',
      ],
      files: {
        "a.heic": await fixture("rgb.heic"),
        "b.jp2": (await fixture("rgb.jp2")).slice(0, 60),
      },
    }),
  );
  expect((source.warnings ?? []).map(({ message }) => message)).toEqual([
    "OEBPS/a.heic, an image of this book, is missing or cannot be shown.",
    "OEBPS/b.jp2, an image of this book, is missing or cannot be shown.",
  ]);
});
