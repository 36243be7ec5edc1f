/** Files of an EPUB, however they are named: books of strangers, each of which failed once. */

import { expect, test } from "vitest";
import { png } from "../../for_tests/epub_books.ts";
import { closeBooks, laidOut, wordsOf } from "../../for_tests/laid_out_books.ts";
import { tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeBooks();
const fixture = async (name: string): Promise<Blob> =>
  await (await fetch(new URL(`./fixtures/${name}`, import.meta.url))).blob();

test("reserved characters, escaped in the manifest, the contents, links and pictures", async () => {
  const source = await laidOut(await fixture("e01-hrefs.epub"));
  expect(source.pageCount).toBe(12);
  const outline = (await source.outline?.(never)) ?? [];
  expect(outline.map(({ page }) => page)).toEqual(Array.from({ length: 12 }, (_, k) => k + 1));
  for (let index = 0; index < 12; index++) {
    expect(await wordsOf(source, index)).toContain(`File ${index}`);
    expect(await source.alt?.(index, never)).toBe("pic");
    const [link] = (await source.links?.(index, never)) ?? [];
    expect(link?.to).toMatchObject({ page: ((index + 1) % 12) + 1 });
  }
});

test("names in another case, of chapters, pictures and style sheets", async () => {
  const source = await laidOut(await fixture("e28-case.epub"));
  expect(await wordsOf(source, 0)).toBe("Case");
  const picture = (await source.draw(0, 100, never)) as ImageBitmap;
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  const { data } = pen.getImageData(0, 0, picture.width, picture.height);
  expect(data.some((red, k) => k % 4 === 0 && red > 150 && (data[k + 1] ?? 255) < 100)).toBe(true);
});

test("an EPUB that is zipped in its folder, or without its container, is one", async () => {
  expect(await wordsOf(await laidOut(await fixture("e28-folder.epub")), 0)).toBe("Zip");
  const { unzipSync, zipSync } = await import("fflate");
  const files = unzipSync(tinyEpub({ chapters: ["<p>bare</p>"] }));
  delete files["META-INF/container.xml"];
  expect(await wordsOf(await laidOut(zipSync(files) as Uint8Array<ArrayBuffer>), 0)).toBe("bare");
});

test("a chapter that is listed and missing, or of a foreign type, is a page that says so", async () => {
  const source = await laidOut(
    tinyEpub({
      chapters: ["<p>there</p>"],
      items:
        '<item id="gone" href="gone.xhtml" media-type="application/xhtml+xml"/><item id="odd" href="style.css" media-type="text/css"/>',
      itemrefs: '<itemref idref="gone"/><itemref idref="odd"/><itemref idref="none"/>',
    }),
  );
  expect(source.pageCount).toBe(4);
  expect(await wordsOf(source, 0)).toBe("there");
  const errors = await Promise.all(
    [1, 2, 3].map(async (index) => {
      const drawn = source.draw(index, 100, never);
      return await Promise.resolve(drawn).then(
        () => "",
        (error: Error) => error.message,
      );
    }),
  );
  expect(errors).toEqual([
    "gone.xhtml, a chapter of this book, is missing in it; get the book again.",
    "OEBPS/style.css, a chapter of this book, is of a type that is not read (text/css); get the book again.",
    "this book has a chapter “none” of which it names no file; get the book again.",
  ]);
});

test.each([
  '<img srcset="blue.png 2x" alt="a"/>',
  '<img srcset=" none.png 1x,\n blue.png 480w, none.png" alt="a"/>',
  '<img srcset="none.png, blue.png," alt="a"/>',
  '<img srcset="none.png 1x,blue.png 2x" alt="a"/>',
  '<img src="none.png" srcset="blue.png 2x" alt="a"/>',
  '<picture><source srcset="blue.png" media="print"/><img src="none.png" alt="a"/></picture>',
  '<picture><source srcset="none.webp" type="image/webp"/><img src="blue.png" alt="a"/></picture>',
  '<embed src="blue.png" type="image/png" aria-label="a"/>',
  '<object data="blue.png" type="image/png">a</object>',
])("a picture is found by any of its addresses: %s", async (markup) => {
  const pen = new OffscreenCanvas(200, 200).getContext("2d")!;
  pen.fillStyle = "#00f";
  pen.fillRect(0, 0, 200, 200);
  const blue = new Uint8Array(await (await pen.canvas.convertToBlob()).arrayBuffer());
  const source = await laidOut(
    tinyEpub({
      chapters: [`<p>Before.</p>${markup}`],
      files: { "blue.png": blue },
    }),
  );
  const drawn = (await source.draw(0, 100, never)) as ImageBitmap;
  const page = new OffscreenCanvas(drawn.width, drawn.height).getContext("2d")!;
  page.drawImage(drawn, 0, 0);
  const { data } = page.getImageData(0, 0, drawn.width, drawn.height);
  const isBlue = (k: number): boolean => (data[k] ?? 255) < 60 && (data[k + 2] ?? 0) > 200;
  expect(data.some((_, k) => k % 4 === 0 && isBlue(k))).toBe(true);
  expect(source.warnings).toEqual([]);
});

test("addresses of a chapter that names a base lead from there, or else from its own file", async () => {
  const red = await png("#f00");
  const chapter = (base: string, body: string): string =>
    `<?xml version="1.0"?><html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title><base href="${base}"/><link rel="stylesheet" href="base.css"/></head><body>${body}</body></html>`;
  const links = '<a href="c2.xhtml">two</a> <a href="#own">own</a> <b id="own">here</b>';
  const source = await laidOut(
    tinyEpub({
      chapters: [
        chapter("parts/", `<p>one</p><img src="red picture.png" alt="far"/>${links}`),
        chapter(
          "https://example.org/book/",
          `<p>two</p><img src="parts/red%20picture.png" alt="near"/>`,
        ),
      ],
      files: { "parts/red picture.png": red, "parts/base.css": "p { font-size: 40px }" },
    }),
  );
  expect((await source.text?.(0, never))?.[0]?.height).toBeGreaterThan(40);
  expect((await source.links?.(0, never))?.map(({ to }) => to)).toMatchObject([
    { page: 2 },
    { page: 1 },
  ]);
  expect(source.warnings?.map(({ source: of }) => of)).toEqual(["OEBPS/base.css"]);
});

test("a picture that is embedded is as large as the book says", async () => {
  const red = await png("#f00");
  const style = 'style="width: 150px; height: 150px"';
  const source = await laidOut(
    tinyEpub({
      chapters: [
        `<p><object data="red.png" width="150" height="150">said</object><embed src="red.png" ${style}/></p>`,
        `<p><object data="red.png" class="wide">said</object></p>`,
      ],
      css: ".wide { width: 150px; height: 150px }",
      files: { "red.png": red },
    }),
  );
  const counts: number[] = [];
  for (const index of [0, 1]) {
    const { width } = await source.size(index);
    const drawn = (await source.draw(index, Math.round(width), never)) as ImageBitmap;
    const pen = new OffscreenCanvas(drawn.width, drawn.height).getContext("2d")!;
    pen.drawImage(drawn, 0, 0);
    const { data } = pen.getImageData(0, 0, drawn.width, drawn.height);
    const isRed = (_: number, k: number): boolean => k % 4 === 0 && (data[k + 1] ?? 255) < 100;
    counts.push(data.filter(isRed).length);
    expect(await source.alt?.(index, never)).toBe("said");
  }
  expect(counts[0]).toBeGreaterThan(1.2 * 150 * 150);
  expect(counts[1]).toBeGreaterThan(0.6 * 150 * 150);
});
