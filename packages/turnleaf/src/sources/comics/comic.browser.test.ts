import { strToU8, type Zippable, zipSync } from "fflate";
import { expect, test } from "vitest";
import { rar4, rar5, sevenZip, tar, tarWithLinks, xz } from "../../for_tests/stored_archives.ts";
import { fixture } from "../archive/unpacker/fixtures_for_tests.ts";
import { messageOf } from "../message_of.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";

const never = new AbortController().signal;

/** Returns an image whose left half is red and whose right half is blue. */
async function scan(width: number, height: number, type = "image/png"): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d")!;
  pen.fillStyle = "#f00";
  pen.fillRect(0, 0, width / 2, height);
  pen.fillStyle = "#00f";
  pen.fillRect(width / 2, 0, width / 2, height);
  return new Uint8Array(await (await canvas.convertToBlob({ type })).arrayBuffer());
}

type Pack = (files: Record<string, Uint8Array>) => Uint8Array;

const zip: Pack = (files) => zipSync(files as Zippable);

async function comic(
  files: Record<string, Uint8Array | string>,
  pack: Pack = zip,
  name = "Hero 1.cbz",
): Promise<PageSource> {
  const entries = Object.entries(files).map(([name, file]) => [
    name,
    typeof file === "string" ? strToU8(file) : file,
  ]);
  const bytes = pack(Object.fromEntries(entries)) as Uint8Array<ArrayBuffer>;
  return await openSource(new File([bytes], name));
}

async function colour(source: PageSource, index: number): Promise<string> {
  const picture = await source.draw(index, 10, never);
  const pen = new OffscreenCanvas(1, 1).getContext("2d")!;
  pen.drawImage(picture, 0, 0, 1, 1);
  const [red, , blue] = pen.getImageData(0, 0, 1, 1).data;
  return red > 200 ? "red" : blue > 200 ? "blue" : "both";
}

/** Why an archive that has files has no pages. */
const none = "no file in it is a book or an image";

/** Returns bytes as Zstandard has those that it does not pack: in blocks as they are. */
function zstdOf(bytes: Uint8Array): Uint8Array<ArrayBuffer> {
  const most = 1 << 17;
  // A frame of one segment that says its length in four bytes.
  const out = [0x28, 0xb5, 0x2f, 0xfd, 0xa0, ...littleEndian(bytes.length, 4)];
  for (let at = 0; at < bytes.length; at += most) {
    const part = bytes.subarray(at, at + most);
    const isLast = at + most >= bytes.length;
    out.push(...littleEndian(part.length * 8 + (isLast ? 1 : 0), 3), ...part);
  }
  return Uint8Array.from(out);
}

const littleEndian = (value: number, length: number): number[] =>
  Array.from({ length }, (_, k) => (value >> (8 * k)) & 0xff);

const places = (source: PageSource) =>
  Array.from({ length: source.pageCount }, (_, index) => source.inSpread?.(index));

test("a ZIP of images is a book in their natural order, titled by its file", async () => {
  const [page, small] = [await scan(40, 60), await scan(20, 30, "image/jpeg")];
  const source = await comic({ "10.png": page, "9.jpg": small, "Thumbs.db": "x" });
  expect(source.pageCount).toBe(2);
  expect(source.title).toBe("Hero 1");
  expect(await source.size(0)).toEqual({ width: 20, height: 30 });
  expect((await source.draw(1, 400, never)).width).toBe(40);
  expect((await source.file!()).size).toBeGreaterThan(100);
});

test("a wide scan is two pages that face each other, each half of it", async () => {
  const [page, wide] = [await scan(40, 60), await scan(82, 60)];
  const source = await comic({ "1.png": page, "2.png": wide, "3.png": page, "4.png": wide });
  // The last scan is the cover.
  expect(places(source)).toEqual([undefined, "first", "second", undefined, undefined]);
  expect(await source.size(1)).toEqual({ width: 41, height: 60 });
  expect([await colour(source, 1), await colour(source, 2)]).toEqual(["red", "blue"]);
  expect(await colour(source, 0)).toBe("both");
  const part = await source.draw(2, 100, never, { x: 0.5, y: 0, width: 0.5, height: 1 });
  expect([part.width, part.height]).toEqual([20, 60]);
});

test("ComicInfo.xml gives title, language, direction, double and deleted pages, bookmarks", async () => {
  const [page, wide] = [await scan(40, 60), await scan(60, 60)];
  const source = await comic({
    "1.png": page,
    "2.png": wide,
    "3.png": page,
    "4.png": page,
    "ComicInfo.xml": `\ufeff<?xml version="1.0"?><ComicInfo xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
      <Title>Dawn &amp; dusk</Title><Series>Hero</Series><Number>1</Number>
      <LanguageISO>ja</LanguageISO><Manga>YesAndRightToLeft</Manga>
      <Pages><Page Image="0" Type="FrontCover" Bookmark="Cover"/><Page Image="1" DoublePage="true" Bookmark="One"/>
      <Page Image="2" Type="Deleted"/><Page Image="3"/><Page Image="x"/><Page Image="99" Bookmark="None"/></Pages></ComicInfo>`,
  });
  expect(source.title).toBe("Hero 1: Dawn & dusk");
  expect([source.language, source.direction, source.pageCount]).toEqual(["ja", "rtl", 4]);
  expect(places(source)).toEqual([undefined, "first", "second", undefined]);
  // Read from right to left, the right half comes first.
  expect([await colour(source, 1), await colour(source, 2)]).toEqual(["blue", "red"]);
  const lines = await source.outline!(never);
  expect(lines.map(({ title, page }) => [title, page])).toEqual([
    ["Cover", 1],
    ["One", 2],
  ]);
});

const statements: readonly [name: string, text: string][] = [
  [
    "ComicInfo.xml",
    "<ComicInfo><Series>Hero</Series><Number>3</Number><Title>Dawn</Title><Writer>Ann A, Bo B</Writer><LanguageISO>ja</LanguageISO><Manga>YesAndRightToLeft</Manga></ComicInfo>",
  ],
  [
    "MetronInfo.xml",
    `<MetronInfo><Publisher><Name>P</Name></Publisher><Series lang="ja"><Name>Hero</Name></Series><Number>3</Number>
      <Stories><Story>Dawn</Story></Stories><Credits>
      <Credit><Creator>Dee D</Creator><Roles><Role>Letterer</Role></Roles></Credit>
      <Credit><Creator>Ann A</Creator><Roles><Role>Artist</Role><Role>Writer</Role></Roles></Credit>
      <Credit><Creator>Bo B</Creator><Roles><Role>Writer</Role></Roles></Credit></Credits></MetronInfo>`,
  ],
  [
    "CoMet.xml",
    `<comet xmlns="http://www.denvog.com/comet/"><title>Dawn</title><series>Hero</series><issue>3</issue>
      <writer>Ann A</writer><writer>Bo B</writer><language>ja</language><readingDirection>rtl</readingDirection></comet>`,
  ],
  [
    "hero.acbf",
    `<ACBF xmlns="http://www.acbf.info/xml/acbf/1.1"><meta-data><book-info>
      <author><first-name>Ann</first-name><last-name>A</last-name></author><author><nickname>Bo B</nickname></author>
      <book-title lang="ja">Dawn</book-title><sequence title="Hero">3</sequence>
      <reading-direction>RTL</reading-direction></book-info></meta-data></ACBF>`,
  ],
];

test.each(statements)("%s says title, authors, language and direction", async (name, text) => {
  const source = await comic({ "1.png": await scan(4, 6), [name]: text });
  expect([source.title, source.authors, source.language]).toEqual([
    "Hero 3: Dawn",
    ["Ann A", "Bo B"],
    "ja",
  ]);
  expect(source.direction).toBe(name === "MetronInfo.xml" ? "ltr" : "rtl");
  expect(source.details?.map(({ value }) => value)).toEqual(["Ann A", "Bo B"]);
});

test("what is said in a folder is about the images in it", async () => {
  const page = await scan(4, 6);
  const info = (title: string) => `<ComicInfo><Title>${title}</Title></ComicInfo>`;
  const deep = await comic({
    "a/b/1.png": page,
    "a/b/c/2.png": page,
    "a/b/ComicInfo.xml": info("Deep"),
  });
  expect(deep.title).toBe("Deep");
  const volumes = { "a/1.png": page, "b/2.png": page };
  const infos = { "a/ComicInfo.xml": info("One"), "b/ComicInfo.xml": info("Two") };
  expect((await comic({ ...volumes, ...infos })).title).toBe("Hero 1");
  expect((await comic({ ...volumes, ...infos, "ComicInfo.xml": info("All") })).title).toBe("All");
});

test("a tar that breaks off says so beside its pages", async () => {
  const page = await scan(40, 60);
  const bytes = tar({ "1.png": page, "2.png": page });
  const cut = new File([bytes.slice(0, 2 * 512 + page.length)], "a.cbt");
  const { pageCount, warnings } = await openSource(cut);
  expect(pageCount).toBeGreaterThan(0);
  expect(warnings?.map(({ message }) => message)).toContain(
    "a.cbt is damaged or breaks off, and pages may be missing; get it again.",
  );
});

test("the comment of a ZIP says what the comic is, where no file does", async () => {
  const info = {
    ...{ title: "Dusk", series: "Hero", issue: 4, language: "English" },
    credits: [{ person: "Ann A", role: "Writer" }, { person: "Dee D", role: "Letterer" }, 7],
  };
  const comment = strToU8(JSON.stringify({ appID: "a", "ComicBookInfo/1.0": info }));
  const withComment: Pack = (files) => {
    const bytes = zip(files);
    // The end of a ZIP has the length of what is written behind it.
    bytes.set([comment.length & 255, comment.length >> 8], bytes.length - 2);
    return Uint8Array.from([...bytes, ...comment]);
  };
  const page = { "1.png": await scan(4, 6) };
  const source = await comic(page, withComment);
  expect([source.title, source.authors, source.language]).toEqual(["Hero 4: Dusk", ["Ann A"], ""]);
  const stated = { ...page, "ComicInfo.xml": "<ComicInfo><Title>Dawn</Title></ComicInfo>" };
  const both = await comic(stated, withComment);
  expect([both.title, both.authors]).toEqual(["Dawn", ["Ann A"]]);
});

test("an ACBF says the order of the pages and the cover, CoMet the cover, by their files", async () => {
  const pages = Object.fromEntries(
    await Promise.all(
      [1, 2, 3, 4].map(async (k) => [`b/${k}.png`, await scan(36 + 2 * k, 60)] as const),
    ),
  );
  const widths = async (source: PageSource): Promise<number[]> =>
    await Promise.all(
      Array.from({ length: source.pageCount }, async (_, k) => (await source.size(k)).width),
    );
  const acbf = `<ACBF><meta-data><book-info><coverpage><image href="4.png"/></coverpage></book-info></meta-data>
    <body><page><image href="3.png"/></page><page><image href="1.png"/></page><page><image href="none.png"/></page></body></ACBF>`;
  expect(await widths(await comic({ ...pages, "b/book.acbf": acbf }))).toEqual([44, 42, 38, 40]);
  const comet = "<comet><coverImage>b/3.png</coverImage></comet>";
  expect(await widths(await comic({ ...pages, "CoMet.xml": comet }))).toEqual([42, 38, 40, 44]);
});

test.each([
  [
    "entities",
    `<!DOCTYPE c [<!ENTITY a "ha"><!ENTITY b "&a;&a;">]><ComicInfo><Title>&b;</Title></ComicInfo>`,
  ],
  ["no XML", "<ComicInfo><Title>"],
  ["another format", "<html/>"],
])("a ComicInfo.xml of %s says nothing", async (_, xml) => {
  const source = await comic({ "1.png": await scan(4, 6), "ComicInfo.xml": xml });
  expect([source.title, source.pageCount]).toEqual(["Hero 1", 1]);
});

test("an archive without images, and an EPUB, are rejected in a sentence", async () => {
  expect(await messageOf(comic({ "a.txt": "a" }))).toBe(
    "Hero 1.cbz has no pages: no file in it is a book or an image; open another.",
  );
});

test("the book that is packed in an archive is read, and one of several is to be chosen", async () => {
  const inner = zipSync({ "1.png": await scan(4, 6), "2.png": await scan(4, 6) });
  const epub = zipSync({
    mimetype: strToU8("application/epub+zip"),
    "p.opf": strToU8(
      `<package xmlns="http://www.idpf.org/2007/opf" version="3.0"><metadata xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:title>Packed</dc:title></metadata><manifest><item id="a" href="a.xhtml" media-type="application/xhtml+xml"/></manifest><spine><itemref idref="a"/></spine></package>`,
    ),
    "a.xhtml": strToU8(
      `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>a</title></head><body><p>Words</p></body></html>`,
    ),
  });
  const titleOf = async (files: Record<string, Uint8Array | string>, name = "shelf.zip") => {
    const source = await comic(files, zip, name);
    return [source.title, source.pageCount];
  };
  const cover = await scan(4, 6);
  const litter = { "__MACOSX/._a.epub": "x", "Shelf/.a.epub": "x" };
  // As a program that sorts books keeps them: one in several formats, its cover and what is known of it.
  expect(
    await titleOf({
      ...{ "Shelf/a.pdf": "%PDF-", "Shelf/a.epub": epub, "Shelf/a.mobi": "x" },
      ...{ "Shelf/cover.jpg": cover, "Shelf/metadata.opf": "<package/>" },
      ...litter,
    }),
  ).toEqual(["Packed", 1]);
  expect(await titleOf({ "inner.cbz": inner, "read me.txt": "x" }, "Hero 1.cbz")).toEqual([
    "inner",
    2,
  ]);
  expect(await titleOf({ "Letter.md": "# A letter\n\nWords" })).toEqual(["A letter", 1]);
  expect(await messageOf(comic({ "b/Two.epub": epub, "One.cbz": inner }, zip, "shelf.zip"))).toBe(
    "shelf.zip holds several books; unpack it and open one of them, such as Two.epub.",
  );
});

test("an archive in an archive is the book, where there is no other, and of several one is to be chosen", async () => {
  const inner = zipSync({ "1.png": await scan(4, 6), "2.png": await scan(4, 6) });
  expect((await comic({ "b/inner.zip": inner, "readme.txt": "a" })).pageCount).toBe(2);
  expect((await comic({ "inner.rar": rar5({ "1.png": await scan(4, 6) }) })).pageCount).toBe(1);
  expect(await messageOf(comic({ "1.zip": inner, "2.zip": inner }))).toBe(
    "Hero 1.cbz holds several books; unpack it and open one of them, such as 1.zip.",
  );
});

test("an archive in one that is in an archive is not opened, nor one beside a comic's pages", async () => {
  const inner = zipSync({ "1.png": await scan(4, 6) });
  const twice = zipSync({ "inner.cbz": inner });
  expect(await messageOf(comic({ "twice.cbz": twice }))).toBe(
    "twice.cbz is packed several times over; unpack it first.",
  );
  const pages = { "1.png": await scan(4, 6), "2.png": await scan(4, 6) };
  expect((await comic({ ...pages, "inner.cbz": inner })).pageCount).toBe(2);
});

test("images that cannot be shown are named, whether others can or not", async () => {
  const psd = strToU8("8BPS\0\x01");
  expect(await messageOf(comic({ "1.psd": psd, "2.psd": psd }))).toBe(
    "Hero 1.cbz has no pages: no file in it, such as 1.psd, is a book or an image that can be shown; open another.",
  );
  const files = {
    "1.png": await scan(4, 6),
    "2.psd": psd,
    three: psd,
    LICENSE: "Copy it.",
    empty: "",
  };
  const { warnings } = await comic(files);
  expect(warnings?.map(({ message }) => message)).toEqual([
    "2.psd, listed in Hero 1.cbz, is no page that can be shown.",
    "three, listed in Hero 1.cbz, is no page that can be shown.",
  ]);
});

test.each([
  ["word/document.xml", "is a Word document (DOCX), which is not read; save it as PDF."],
  ["FixedDocSeq.fdseq", "is an XPS document, which is not read; convert it to PDF."],
  ["META-INF/MANIFEST.MF", "is a program (JAR), which is not read; open a book."],
])("an archive that is a document is no comic of its pictures: %s", async (file, said) => {
  const page = await scan(4, 6);
  const files = { "word/media/1.png": page, "word/media/2.png": page, [file]: "<a/>" };
  expect(await messageOf(comic(files, zip, "letter.docx"))).toBe(`letter.docx ${said}`);
});

test("links in a tar are pages, and the second of two files of one name is", async () => {
  const page = await scan(4, 6);
  const files = tarWithLinks({ "1.png": page }, [
    ["2.png", "1", "1.png"],
    ["3.png", "2", "none.png"],
  ]);
  const source = await openSource(new File([files], "a.cbt"));
  expect(source.pageCount).toBe(3);
  expect((await source.draw(1, 4, never)).width).toBe(4);
  expect(await messageOf(source.draw(2, 4, never))).toMatch(/is a link to none\.png, which is no/);
  const twice = rar5({ "1.png": page, "../1.png": await scan(8, 6) });
  expect((await openSource(new File([twice], "a.cbr"))).pageCount).toBe(2);
});

test("a page that is cut off or claims 50,000 x 50,000 pixels fails alone", async () => {
  const page = await scan(40, 60);
  const huge = page.slice();
  new DataView(huge.buffer).setUint32(16, 50_000);
  new DataView(huge.buffer).setUint32(20, 50_000);
  const source = await comic({ "1.png": page, "2.png": page.slice(0, 60), "3.png": huge });
  expect((await source.draw(0, 10, never)).width).toBe(10);
  expect(await messageOf(source.draw(1, 10, never))).toBe(
    "Page 2 of Hero 1.cbz (2.png) is damaged or no image; PNG, JPEG, WebP, AVIF, GIF, BMP, SVG, TIFF and JPEG 2000 can be shown.",
  );
  expect(await messageOf(source.draw(2, 10, never))).toBe(
    "Page 3 of Hero 1.cbz (3.png) has 50000 x 50000 pixels, more than can be shown; make it smaller.",
  );
});

test("an image that unpacks to more than its bound fails alone", async () => {
  const source = await comic({ "1.png": await scan(4, 6), "2.png": new Uint8Array(101_000_000) });
  expect((await source.draw(0, 4, never)).width).toBe(4);
  expect(await messageOf(source.draw(1, 4, never))).toContain("when unpacked; make it smaller.");
});

const packers: readonly [name: string, pack: Pack][] = [
  ["Hero 1.cbr", rar4],
  ["Hero 1.rar", rar5],
  ["Hero 1.cb7", sevenZip],
  ["Hero 1.cbt", tar],
];

test.each(packers)("%s is a comic as one in a ZIP is", async (name, pack) => {
  const [page, wide] = [await scan(40, 60), await scan(82, 60)];
  const files = {
    "b/10.png": page,
    "b/9.png": wide,
    "b/2.png": page,
    "b/.2.png": page,
    "Thumbs.db": "x",
    "ComicInfo.xml":
      "<ComicInfo><Title>Dawn</Title><Manga>YesAndRightToLeft</Manga><LanguageISO>ja</LanguageISO></ComicInfo>",
  };
  const source = await comic(files, pack, name);
  expect([source.title, source.language, source.direction]).toEqual(["Dawn", "ja", "rtl"]);
  expect(places(source)).toEqual([undefined, "first", "second", undefined]);
  expect([await colour(source, 1), await colour(source, 2)]).toEqual(["blue", "red"]);
  expect((await source.draw(0, 400, never)).width).toBe(40);
  expect((await source.file!()).size).toBeGreaterThan(100);
  const { "ComicInfo.xml": _, ...untitled } = files;
  expect((await comic(untitled, pack, name)).title).toBe("Hero 1");
});

test.each(packers)("%s without images, or with a page that is damaged", async (name, pack) => {
  expect(await messageOf(comic({ "a.nfo": "a" }, pack, name))).toBe(
    `${name} has no pages: no file in it is a book or an image; open another.`,
  );
  const page = await scan(40, 60);
  const source = await comic({ "1.png": page, "2.png": page.slice(0, 60) }, pack, name);
  expect((await source.draw(0, 10, never)).width).toBe(10);
  expect(await messageOf(source.draw(1, 10, never))).toBe(
    `Page 2 of ${name} (2.png) is damaged or no image; PNG, JPEG, WebP, AVIF, GIF, BMP, SVG, TIFF and JPEG 2000 can be shown.`,
  );
});

test("a solid archive of LZMA is read", async () => {
  const source = await openSource(new File([fixture("lzma.cb7")], "lzma.cb7"));
  expect(source.pageCount).toBe(6);
  for (let index = 0; index < 6; index++) {
    expect(await source.size(index)).toEqual({ width: 30, height: 40 });
    expect((await source.draw(index, 30, never)).height).toBe(40);
  }
});

test("names in the encodings of several systems, one with a byte of a backslash, lose no page", async () => {
  const address = new URL("./fixtures/c05-names.cbz", import.meta.url);
  const file = await (await fetch(address)).blob();
  const { openZip } = await import("../archive/zip.ts");
  expect((await openZip(file, "c05")).names.slice().sort()).toEqual(
    ["第1話/01.jpg", "第1話/02.jpg", "第2話/01.jpg", "zzôquoteö.jpg", "章十.jpg", "表.jpg"].sort(),
  );
  expect((await openSource(new File([file], "c05.cbz"))).pageCount).toBe(6);
});

test("the cover stands first, images without an ending are pages, and what shared drives leave is none", async () => {
  const page = await scan(40, 60);
  const files = {
    "p1.png": page,
    p2: await scan(44, 60),
    "Cover.png": await scan(48, 60),
    "@eaDir/p1.png": page,
    "#recycle/p0.png": page,
    "p3.dat": "no image",
    "a cover story.png": await scan(36, 60),
  };
  const source = await comic(files);
  const widths = [];
  for (let index = 0; index < source.pageCount; index++)
    widths.push((await source.size(index)).width);
  expect(widths).toEqual([48, 36, 40, 44]);
});

test.each(["表紙.png", "Обложка.png", "Couverture.png"])(
  "a cover named %s stands first",
  async (name) => {
    const source = await comic({ "1.png": await scan(40, 60), [name]: await scan(48, 60) });
    expect((await source.size(0)).width).toBe(48);
  },
);

test("covers stand at the ends of their folders", async () => {
  const page = await scan(4, 6);
  const names = [
    ...["Back Cover.png", "v1/002.png", "v1/back_cover.png", "v1/cover.png", "v1/extra/001.png"],
    ...["v2/001.png", "v2/backcover.png", "v2/Cover.png", "zz credits.png"],
  ];
  // The width of a page says which it is.
  const images = await Promise.all(
    names.map(async (name, k) => [name, await scan(10 + 2 * k, 30)]),
  );
  const source = await comic({ ...Object.fromEntries(images), "cover.png": page });
  const sizes = await Promise.all(
    Array.from({ length: source.pageCount }, (_, index) => source.size(index)),
  );
  expect(sizes.map(({ width }) => (width === 4 ? "cover.png" : names[(width - 10) / 2]))).toEqual([
    ...["cover.png", "v1/cover.png", "v1/002.png", "v1/extra/001.png", "v1/back_cover.png"],
    ...["v2/Cover.png", "v2/001.png", "v2/backcover.png", "zz credits.png", "Back Cover.png"],
  ]);
});

test("a ComicInfo.xml in which an element has no end is read", async () => {
  const address = new URL("./fixtures/c06-unclosed.cbz", import.meta.url);
  const source = await openSource(new File([await (await fetch(address)).blob()], "c06.cbz"));
  expect([source.title, source.language, source.direction]).toEqual([
    "S 1: T unclosed",
    "ja",
    "rtl",
  ]);
});

test("what is packed with a comic's pages and is none is listed, a damaged page with its number", async () => {
  const page = await scan(40, 60);
  const source = await comic({
    "1.png": page,
    "2.jpg": "no picture",
    "3.tif": "II*\0\u0008\0\0\0",
    "4.pdf": "%PDF-1.7",
    "more.zip": "x",
    "ComicInfo.xml": "<ComicInfo><Title>A</Title></ComicInfo>",
    "read me.txt": "x",
  });
  expect(source.pageCount).toBe(3);
  expect(source.warnings?.map(({ code, source: about, page }) => [code, about, page])).toEqual([
    ["page", "4.pdf", undefined],
    ["page", "more.zip", undefined],
    ["page", "2.jpg", 2],
  ]);
  expect(await messageOf(source.draw(2, 10, never))).toContain("(3.tif) is a TIFF");
});

test.each([
  ["a ZIP", zip({}), "it is empty"],
  ["a ZIP of metadata", zip({ "ComicInfo.xml": strToU8("<ComicInfo/>") }), none],
  ["a tar of metadata", tar({ "ComicInfo.xml": strToU8("<ComicInfo/>") }), none],
  ["a RAR", rar5({}), "it is empty"],
  ["an old RAR", rar4({}), "it is empty"],
  // Its header, the sum of that, and no list of files behind it.
  [
    "a 7-Zip",
    Uint8Array.of(
      ...[0x37, 0x7a, 0xbc, 0xaf, 0x27, 0x1c, 0, 4],
      ...[0x8d, 0x9b, 0xd5, 0x0f, ...Array.from({ length: 20 }, () => 0)],
    ),
    "it is empty",
  ],
  ["an EPUB", zip({ mimetype: strToU8("application/epub+zip") }), none],
])("%s without pages is said to have none", async (_, bytes, reason) => {
  expect(await messageOf(openSource(new File([bytes as Uint8Array<ArrayBuffer>], "x")))).toBe(
    `x has no pages: ${reason}; open another.`,
  );
});

test("an empty tar is said to be one", async () => {
  expect(await messageOf(openSource(new File([new Uint8Array(1024)], "x.cbt")))).toMatch(
    /^x\.cbt has no pages but only zeros, as an empty tar or a file that was not fetched whole; /,
  );
});

const gzipOf = async (part: BlobPart): Promise<Blob> =>
  await new Response(new Blob([part]).stream().pipeThrough(new CompressionStream("gzip"))).blob();

test.each<[string, (bytes: Uint8Array<ArrayBuffer>) => BlobPart | Promise<BlobPart>]>([
  ["gzip", gzipOf],
  ["zstd", zstdOf],
  ["xz", xz],
])("a tar that is packed by %s is a comic", async (_, pack) => {
  const bytes = tar({ "1.png": await scan(4, 6), "2.png": await scan(4, 6) });
  const packed = await pack(bytes);
  const source = await openSource(new File([packed], "Hero 1.cbt"));
  expect([source.pageCount, source.title]).toEqual([2, "Hero 1"]);
});

/** Returns a ZIP in whose headers some bytes are changed: how each file is packed, and whether it is encrypted. */
function withHeaders(bytes: Uint8Array, change: (header: DataView) => void): Uint8Array {
  const at = (k: number, ...mark: readonly number[]): boolean =>
    mark.every((byte, j) => bytes[k + j] === byte);
  for (let k = 0; k < bytes.length - 30; k++) {
    // The central directory has its flags two bytes later.
    const start = at(k, 0x50, 0x4b, 3, 4) ? k + 6 : at(k, 0x50, 0x4b, 1, 2) ? k + 8 : null;
    if (start !== null) change(new DataView(bytes.buffer, bytes.byteOffset + start, 4));
  }
  return bytes;
}

test("a comic of which no page can be unpacked is rejected in a sentence", async () => {
  const files = { "1.png": await scan(4, 6), "2.png": await scan(4, 6) };
  const opened = (change: (header: DataView) => void): Promise<string> =>
    messageOf(comic(files, (all) => withHeaders(zip(all), change)));
  expect(await opened((header) => header.setUint16(0, 1, true))).toBe(
    "Hero 1.cbz is protected by a password; unpack it first.",
  );
  expect(await opened((header) => header.setUint16(2, 14, true))).toBe(
    "1.png in Hero 1.cbz is packed by LZMA, which cannot be unpacked here; pack it again as usual, by Deflate.",
  );
});

test("a comic behind other bytes is read", async () => {
  const bytes = zip({ "1.png": await scan(4, 6) }) as Uint8Array<ArrayBuffer>;
  for (const length of [20, 5000]) {
    const source = await openSource(new File([new Uint8Array(length).fill(1), bytes], "a.cbz"));
    expect(source.pageCount).toBe(1);
    expect(await colour(source, 0)).toBe("both");
  }
});

test("what is packed otherwise, or damaged, says so", async () => {
  const message = (bytes: BlobPart) => messageOf(openSource(new File([bytes], "x.cbt")));
  expect(await message(Uint8Array.of(0x1f, 0x8b, 8, 0, 1))).toBe(
    "x.cbt is damaged: it cannot be unpacked; get it again.",
  );
  expect(await message(await gzipOf(await gzipOf("text")))).toBe(
    "x.cbt is packed several times over; unpack it first.",
  );
  expect(await message((await gzipOf("text ".repeat(99))).slice(0, 15))).toBe(
    "x.cbt is damaged: it cannot be unpacked; get it again.",
  );
  const packed = xz(strToU8("text "));
  for (const damaged of [packed.slice(0, 10), packed.slice(0, -1), packed.with(28, 0)]) {
    expect(await message(damaged)).toMatch(
      /^x\.cbt is damaged \([^)]+\); repair it or get it again\.$/,
    );
  }
  // A dictionary of 4 GB.
  expect(await message(xz(strToU8("text"), 40))).toMatch(
    /^x\.cbt needs more memory to unpack than a book may have \(.*\); pack it again as ZIP \(CBZ\)\.$/,
  );
  expect(await message(xz(new Uint8Array()))).toBe("x.cbt is empty; get the file again.");
  expect(await message(await gzipOf(xz(strToU8("text"))))).toBe(
    "x.cbt is packed several times over; unpack it first.",
  );
  expect(await message("BZh91AY&SY\x01")).toMatch(/^x\.cbt is packed by bzip2, /);
});
