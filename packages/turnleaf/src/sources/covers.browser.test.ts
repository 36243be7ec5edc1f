import { strToU8, zipSync } from "fflate";
import { afterEach, describe, expect, test, vi } from "vitest";
import { prose, tinyEpub } from "./epub/tiny_epub.ts";
import { tinyFb2 } from "./fb2/tiny_fb2.ts";
import { limits } from "./limits.ts";
import { openSource } from "./open.ts";
import type { PagePicture, PageSource } from "./page_source.ts";
import { tinyPdf } from "./tiny_pdf.ts";

const never = new AbortController().signal;
const opened: PageSource[] = [];

afterEach(() => {
  for (const source of opened.splice(0)) source.close();
});

async function open(bytes: Uint8Array<ArrayBuffer>, name: string): Promise<PageSource> {
  const source = await openSource(new File([bytes], name));
  opened.push(source);
  await source.settle?.();
  return source;
}

/** Returns colours of a page at fractions of its width and height. */
async function coloursAt(
  source: PageSource,
  index: number,
  places: readonly (readonly [number, number])[],
): Promise<string[]> {
  const picture: PagePicture = await source.draw(index, 200, never);
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
  pen?.drawImage(picture, 0, 0);
  return places.map(([x, y]) => {
    const at = [Math.floor(x * picture.width), Math.floor(y * picture.height)] as const;
    return [...(pen?.getImageData(...at, 1, 1).data ?? [])].slice(0, 3).join();
  });
}

const drawing = (width: number, height: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}"><rect width="${width}" height="${height}" fill="#0000ff"/></svg>`;
const cover =
  '<item id="cv" href="cover.svg" media-type="image/svg+xml" properties="cover-image"/>';
const edges = [
  [0.01, 0.01],
  [0.99, 0.01],
  [0.01, 0.99],
  [0.99, 0.99],
] as const;
const blue = Array(4).fill("0,0,255");

describe("an EPUB", () => {
  test("has the picture that its manifest names as its first page, of the picture's proportions", async () => {
    const source = await open(
      tinyEpub({
        chapters: [prose(4)],
        items: cover,
        raw: { "OEBPS/cover.svg": drawing(600, 900), "cover.svg": drawing(600, 900) },
      }),
      "a.epub",
    );
    expect(source.cover).toBe("picture");
    const { width, height } = await source.size(0);
    expect(width / height).toBeCloseTo(2 / 3, 2);
    expect(await coloursAt(source, 0, edges)).toEqual(blue);
    expect((await source.text?.(1, never))?.length).toBeGreaterThan(0);
  });

  test("has a first chapter that is a picture as its cover, without its margins", async () => {
    const chapters = [
      '<div style="margin: 3em; text-align: center"><img src="p.svg" alt="" style="max-width: 80%"/></div>',
      prose(4),
    ];
    const source = await open(
      tinyEpub({ chapters, files: { "p.svg": drawing(600, 800) } }),
      "a.epub",
    );
    expect(source.cover).toBe("picture");
    const { width, height } = await source.size(0);
    expect(width / height).toBeCloseTo(3 / 4, 2);
    expect(await coloursAt(source, 0, edges)).toEqual(blue);
  });

  test.each([
    ["Cover", "Cover", "", 1],
    ["Untitled", "a drawing in blue", "A drawing in blue.", 1],
    ["Cover", "A small book by nobody", "", 2],
    ["A small book", "A small book", "", 2],
    ["Untitled", "Four words of text", "", 2],
  ])(
    "titled %s shows “%s” under its cover, unless that only names it",
    async (title, words, alt, before) => {
      const page = `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>${title}</title></head><body><img src="cover.svg" alt="${alt}"/><p>${words}</p></body></html>`;
      const source = await open(
        tinyEpub({
          chapters: [page, "<p>One</p>"],
          items: cover,
          files: { "cover.svg": drawing(600, 800) },
        }),
        "a.epub",
      );
      const texts = await Promise.all([0, 1].map((index) => source.text?.(index, never)));
      const said = texts.map((runs) => runs?.map(({ text }) => text).join(" "));
      expect(said).toEqual(["", before === 1 ? "One" : words]);
      expect(await coloursAt(source, 0, edges)).toEqual(blue);
    },
  );

  test("without a cover has its boards stamped", async () => {
    const metadata = "<dc:creator>Herman Melville</dc:creator>";
    const source = await open(tinyEpub({ chapters: [prose(4)], metadata }), "a.epub");
    expect([source.cover, source.authors]).toEqual(["stamped", ["Herman Melville"]]);
  });

  test("without a cover is stamped in the face of its own titles", async () => {
    const file =
      "/node_modules/@expo-google-fonts/eb-garamond/800ExtraBold/EBGaramond_800ExtraBold.ttf";
    const garamond = new Uint8Array(await (await fetch(file)).arrayBuffer());
    const css =
      '@font-face { font-family: "Own Face"; src: url(f.ttf) } h1 { font: italic small-caps 800 2em "Own Face", monospace }';
    const chapters = [`<h1>Title</h1>${prose(1)}`];
    const before = document.fonts.size;
    const source = await open(tinyEpub({ chapters, css, files: { "f.ttf": garamond } }), "a.epub");
    expect(source.titleFont?.style).toBe("italic small-caps 800");
    const { family = "" } = source.titleFont ?? {};
    expect(family).toMatch(/^"turnleaf-title-\d+-0", monospace$/);
    // Letters of another face are as wide as each other.
    const pen = new OffscreenCanvas(1, 1).getContext("2d") as OffscreenCanvasRenderingContext2D;
    pen.font = `20px ${family}`;
    expect(pen.measureText("iiii").width).toBeLessThan(0.7 * pen.measureText("mmmm").width);
    source.close();
    expect(document.fonts.size).toBe(before);
    const plain = await open(tinyEpub({ chapters }), "b.epub");
    expect(plain.titleFont).toBeUndefined();
  });

  test("has a plate of a page's proportions bleed, and a smaller picture where it stands", async () => {
    const plate = '<img src="p.svg" alt="" style="width: 100%"/>';
    const small = '<img src="p.svg" alt="" style="width: 20%"/>';
    const files = { "p.svg": drawing(129, 198) };
    const source = await open(tinyEpub({ chapters: [prose(1), plate, small], files }), "a.epub");
    expect(await coloursAt(source, 1, edges)).toEqual(blue);
    expect(await coloursAt(source, 2, edges)).toEqual(Array(4).fill("255,255,255"));
  });
});

test("a FictionBook without a cover page is stamped", async () => {
  const source = await openSource(new Blob([tinyFb2("<section><p>One</p></section>")]));
  opened.push(source);
  expect(source.cover).toBe("stamped");
});

describe("a PDF", () => {
  afterEach(() => vi.restoreAllMocks());

  const red = "1 0 0 rg 0 0 200 300 re f";
  const article = "0 0 0 rg 40 40 120 220 re f";

  test("whose first page bleeds on all sides is a whole book, its pages on the boards too", async () => {
    const source = await open(tinyPdf({ pages: [red, article, article] }), "a.pdf");
    expect(source.cover).toBe(undefined);
    expect([0, 1].map((index) => source.colouring?.(index))).toEqual(["picture", "print"]);
  });

  test("whose first page has margins is a document", async () => {
    const source = await open(tinyPdf({ pages: [article, red, article] }), "a.pdf");
    expect(source.cover).toBe("none");
  });

  test("has the same cover on a machine so busy that every time that it may take is over at once", async () => {
    const { timeout } = AbortSignal;
    // Looks at what a worker does, which count as much as it gets of a processor, go on.
    vi.spyOn(AbortSignal, "timeout").mockImplementation((time) =>
      time === limits.pdfTime / 12 ? timeout.call(AbortSignal, time) : AbortSignal.abort(),
    );
    const source = await open(tinyPdf({ pages: [red, article] }), "a.pdf");
    expect(source.cover).toBe(undefined);
  });

  test.each([
    [25_000, undefined],
    [35_000, "none"],
  ])("whose first page is drawn in %i steps has the cover %s", async (steps, cover) => {
    const first = `${red}\n${"0 0 m S\n".repeat(steps / 2)}`;
    const source = await open(tinyPdf({ pages: [first, article] }), "a.pdf");
    expect(source.cover).toBe(cover);
    expect(await coloursAt(source, 0, edges)).toEqual(Array(4).fill("255,0,0"));
  });
});

test("text is a document, and a manifest says what it is", async () => {
  const text = await open(new TextEncoder().encode("One.\n\nTwo."), "a.txt");
  expect(text.cover).toBe("none");
  const pages = ["data:image/svg+xml,x", "data:image/svg+xml,y"];
  const book = await openSource({ pages, cover: "picture" });
  opened.push(book);
  expect(book.cover).toBe("picture");
  await expect(openSource({ pages, cover: "gold" as "none" })).rejects.toThrow(
    'has an unknown cover; write "picture" or "stamped" or "none"',
  );
});

test("a comic begins with the page that ComicInfo.xml names as its front cover", async () => {
  const pages = '<Pages><Page Image="0"/><Page Image="1" Type="FrontCover"/></Pages>';
  const files = {
    "1.svg": strToU8(drawing(60, 90)),
    "2.svg": strToU8(drawing(70, 90)),
    "3.svg": strToU8(drawing(60, 90)),
    "ComicInfo.xml": strToU8(`<?xml version="1.0"?><ComicInfo>${pages}</ComicInfo>`),
  };
  const source = await open(zipSync(files) as Uint8Array<ArrayBuffer>, "a.cbz");
  expect((await source.size(0)).width / (await source.size(0)).height).toBeCloseTo(7 / 9, 2);
});
