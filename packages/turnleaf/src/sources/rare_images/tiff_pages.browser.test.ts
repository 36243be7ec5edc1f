/** TIFFs of several pages: all of them are pages of the book. */

import { zipSync } from "fflate";
import { expect, test } from "vitest";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";
import { type TinyPicture, tinyTiff } from "./tiny_tiff.ts";

const never = new AbortController().signal;
const [red, green, blue]: TinyPicture[] = [
  { colour: [255, 0, 0] },
  { colour: [0, 255, 0], width: 10, height: 14 },
  { colour: [0, 0, 255] },
] as const;

/** Returns the colours of a book's pages. */
async function coloursOf(source: PageSource): Promise<string[]> {
  const found: string[] = [];
  for (let index = 0; index < source.pageCount; index++) {
    const drawn = await source.draw(index, 4, never);
    const pen = new OffscreenCanvas(1, 1).getContext("2d")!;
    pen.drawImage(drawn, 0, 0, 1, 1);
    found.push([...pen.getImageData(0, 0, 1, 1).data.slice(0, 3)].join(" "));
  }
  source.close();
  return found;
}

const inOrder = ["255 0 0", "0 255 0", "0 0 255"];
const file = (bytes: Uint8Array<ArrayBuffer>, name = "fax.tif"): File => new File([bytes], name);

test.each([true, false])("each page is a page, whatever the order of bytes", async (isLittle) => {
  const bytes = tinyTiff([red, green, blue] as TinyPicture[], isLittle);
  const source = await openSource(file(bytes));
  expect([source.title, source.pageCount]).toEqual(["fax.tif", 3]);
  expect(await source.size(1)).toEqual({ width: 10, height: 14 });
  expect(await (await source.file?.())?.arrayBuffer()).toEqual(bytes.buffer);
  expect(await coloursOf(source)).toEqual(inOrder);
});

test("one at an address has all of its pages, and so has one that is written as data", async () => {
  const bytes = tinyTiff([red, green, blue] as TinyPicture[]);
  const address = URL.createObjectURL(new Blob([bytes]));
  expect(await coloursOf(await openSource(address))).toEqual(inOrder);
  URL.revokeObjectURL(address);
  const data = `data:image/tiff;base64,${btoa(String.fromCharCode(...bytes))}`;
  expect(await coloursOf(await openSource(data))).toEqual(inOrder);
});

test("smaller copies and masks are no pages, a page that is turned is upright", async () => {
  const [page, other] = [red, blue] as [TinyPicture, TinyPicture];
  const source = await openSource(
    file(
      tinyTiff([
        { ...other, subfile: 1 },
        { ...page, subfile: 2 },
        { ...other, subfile: 5 },
        { ...other, oldSubfile: 2 },
        { ...other, subfile: 4 },
        { ...other, orientation: 6 },
      ]),
    ),
  );
  expect(await source.size(1)).toEqual({ width: 12, height: 8 });
  expect(await coloursOf(source)).toEqual(["255 0 0", "0 0 255"]);
});

test("a list of pages that goes in a circle, or breaks off, has those before", async () => {
  const bytes = tinyTiff([red, green] as TinyPicture[]);
  const view = new DataView(bytes.buffer);
  const link = (directory: number): number => directory + 2 + 12 * view.getUint16(directory, true);
  const second = view.getUint32(link(8), true);
  for (const next of [8, 1_000_000, 3]) {
    view.setUint32(link(second), next, true);
    expect(await coloursOf(await openSource(file(bytes)))).toEqual(inOrder.slice(0, 2));
  }
});

test("a page that is damaged fails alone", async () => {
  const bytes = tinyTiff([red, green, blue] as TinyPicture[]);
  const view = new DataView(bytes.buffer);
  const second = view.getUint32(10 + 12 * view.getUint16(8, true), true);
  // Its packing is none that there is.
  view.setUint16(second + 2 + 12 * 3 + 8, 9999, true);
  const source = await openSource(file(bytes));
  await expect(source.draw(1, 4, never)).rejects.toThrow(
    "Page 2 of fax.tif is a TIFF that is damaged or of a kind that cannot be read (it is packed by method 9999); convert it to PNG or JPEG.",
  );
  expect((await source.draw(2, 4, never)).width).toBe(4);
  source.close();
});

test("in a comic its pages follow each other, at their place", async () => {
  const zip = zipSync({
    "1.tif": tinyTiff([red, green] as TinyPicture[]),
    "2.tif": tinyTiff([blue as TinyPicture]),
  }) as Uint8Array<ArrayBuffer>;
  expect(await coloursOf(await openSource(file(zip, "a.cbz")))).toEqual(inOrder);
});

test("among files that are chosen its pages follow each other", async () => {
  const files = [
    file(tinyTiff([red, green] as TinyPicture[])),
    file(tinyTiff([blue as TinyPicture])),
  ];
  expect(await coloursOf(await openSource(files))).toEqual(inOrder);
});

test("where a list gives it one page, what is not shown is listed once it is known", async () => {
  const data = `data:image/tiff;base64,${btoa(String.fromCharCode(...tinyTiff([red, green] as TinyPicture[])))}`;
  const source = await openSource({ pages: [data, data] });
  let warned = 0;
  source.watchWarnings?.(() => warned++);
  await source.draw(1, 4, never);
  expect(warned).toBe(1);
  expect(source.warnings).toEqual([
    {
      code: "image",
      message: "Page 2 of This book is a TIFF of 2 pages, of which only the first is shown.",
      page: 2,
    },
  ]);
  source.close();
});
