/** Kindle books in real Chromium: MOBI and KF8, read, linked and kept within bounds. */

import { expect, test } from "vitest";
import { messageOf, redness, textsOf } from "../../for_tests/source_pages.ts";
import { limits } from "../limits.ts";
import { openSource } from "../open.ts";
import { k32, packPalmDoc, tinyKf8, tinyMobi } from "./tiny_kindle.ts";

const never = new AbortController().signal;

async function png(colour = "#f00"): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(40, 60);
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.fillStyle = colour;
  pen.fillRect(0, 0, 40, 60);
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

const one =
  '<html><head><guide></guide></head><body><h1>One</h1><p height="2em">Käse and <a filepos=0000000200>two</a>, <a href="https://example.com/">web</a>.</p>';
const second = `${one.padEnd(180)}<mbp:pagebreak/>`;

test.each([
  ["as it is", 1],
  ["by PalmDoc", 2],
])(
  "a MOBI packed %s has its text, contents, links, pictures and what it says of itself",
  async (_, compression) => {
    const start = new TextEncoder().encode(second).length;
    const text =
      `${second}<h1>Two</h1><p>Käse, Käse, Käse.</p><p><img recindex="00001"></p></body></html>`.replace(
        "0000000200",
        String(start).padStart(10, "0"),
      );
    const contents = [
      { title: "One &amp; all", at: 0 },
      { title: "Two", at: start, parent: 0 },
    ];
    const metadata = { 100: "Herman Melville", 524: "de" };
    const file = tinyMobi({
      text,
      contents,
      metadata,
      compression,
      resources: [await png()],
      recordSize: 64,
    });
    const source = await openSource(new Blob([file]));
    expect([source.title, source.language, source.direction]).toEqual([
      "A small book",
      "de",
      "ltr",
    ]);
    expect(source.details).toEqual([{ label: "", value: "Herman Melville" }]);
    expect(await textsOf(source, "")).toEqual(["OneKäse and two, web.", "TwoKäse, Käse, Käse."]);
    expect(await source.outline?.(never)).toEqual([
      { title: "One & all", page: 1, children: [{ title: "Two", page: 2, children: [] }] },
    ]);
    expect((await source.links?.(0, never))?.map(({ to }) => to)).toEqual([
      { page: 2 },
      { href: "https://example.com/" },
    ]);
    expect(await redness(source, 0)).toBe(0);
    expect(await redness(source, 1)).toBeGreaterThan(0.005);
    source.close();
  },
);

test("a MOBI without a table has the contents that its guide names, and its cover first", async () => {
  const list = '<p><a filepos="0000000000">Start</a></p>';
  const place =
    '<html><head><guide><reference type="toc" filepos=0000000123></guide></head><body><p>Text</p><mbp:pagebreak/>'
      .length;
  const text = `<html><head><guide><reference type="toc" filepos=${String(place).padStart(10, "0")}></guide></head><body><p>Text</p><mbp:pagebreak/>${list}<mbp:pagebreak/></body></html>`;
  const source = await openSource(
    new Blob([tinyMobi({ text, metadata: { 201: 0 }, resources: [await png()] })]),
  );
  expect(await textsOf(source, "")).toEqual(["", "Text", "Start"]);
  expect(await redness(source, 0)).toBeGreaterThan(0.005);
  expect(await source.outline?.(never)).toEqual([{ title: "Start", page: 2, children: [] }]);
  source.close();
});

test("a KF8 has its sections, style, pictures, drawings, links and contents", async () => {
  const link = (section: number, offset: number) =>
    `kindle:pos:fid:${k32(section)}:off:${k32(offset, 10)}`;
  const bodies = [
    `<h1>One</h1><p class="red"><a href="${link(1, 12)}">On</a></p>`,
    '<h1>Two</h1><p id="here">There</p><img src="kindle:embed:0001?mime=image/png" alt=""/>',
    '<p>Three</p><img src="kindle:flow:0002?mime=image/svg+xml" alt=""/>',
  ];
  const drawing =
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="90" height="90"><image xlink:href="kindle:embed:0001?mime=image/png" width="90" height="90"/></svg>';
  const file = tinyKf8({
    text: bodies,
    flows: [".red { background: #f00; height: 60px }", drawing],
    resources: [await png()],
    contents: [
      { title: "One", at: 0 },
      { title: "Three", at: 2 },
    ],
    compression: 2,
    recordSize: 300,
    metadata: { 527: "rtl" },
  });
  const source = await openSource(new Blob([file]));
  expect(source.direction).toBe("rtl");
  expect(await textsOf(source, "")).toEqual(["OneOn", "TwoThere", "Three"]);
  expect((await source.links?.(0, never))?.map(({ to }) => to)).toEqual([{ page: 2 }]);
  expect((await source.outline?.(never))?.map(({ title, page }) => [title, page])).toEqual([
    ["One", 1],
    ["Three", 3],
  ]);
  for (const page of [0, 1, 2])
    expect(await redness(source, page), `${page}`).toBeGreaterThan(0.005);
  source.close();
});

test("a link of a KF8 to a name in its own section leads there", async () => {
  const text = ["<p>One</p>", `<p><a href="#end">Two</a></p><p id="end">End</p>`];
  const source = await openSource(new Blob([tinyKf8({ text })]));
  expect((await source.links?.(1, never))?.map(({ to }) => to)).toEqual([{ page: 2 }]);
  source.close();
});

test("a picture of a MOBI that is there in another resolution alone is shown", async () => {
  const text = '<html><body><p><img hirecindex="00001"></p></body></html>';
  const source = await openSource(new Blob([tinyMobi({ text, resources: [await png()] })]));
  expect(await redness(source, 0)).toBeGreaterThan(0.005);
  source.close();
});

test("a KF8 of fixed layout has pages of the size that it names", async () => {
  const metadata = { 122: "true", 126: "600x800" };
  const source = await openSource(
    new Blob([tinyKf8({ text: ["<p>One</p>", "<p>Two</p>"], metadata })]),
  );
  expect(await source.size(0)).toEqual({ width: 600, height: 800 });
  expect([source.pageCount, source.typeset]).toEqual([2, undefined]);
  source.close();
});

test("what is encrypted, and what is no book, is rejected in one sentence", async () => {
  expect(await messageOf(openSource(tinyMobi({ text: "<p>One</p>", encryption: 2 })))).toBe(
    "this book is protected against copying (DRM); open it in its shop's reader.",
  );
  const empty = tinyMobi({ text: "" });
  expect(await messageOf(openSource(empty))).toBe("this book has no text; get it again.");
  const palm = tinyMobi({ text: "<p>One</p>" });
  palm.set(new TextEncoder().encode("TEXtREAd"), 60);
  expect(await messageOf(openSource(palm))).toMatch(/^this book is a text of a Palm \(PalmDOC\)/);
  expect(await messageOf(openSource(tinyMobi({ text: "x", compression: 3 })))).toMatch(
    /^this book is damaged or no Kindle book/,
  );
});

test("scripts in it do not run, and nothing is fetched", async () => {
  const bad =
    '<p onclick="parent.ran = 1">One<script>parent.ran = 1</script><img src="https://elsewhere.invalid/a.png" onerror="parent.ran = 1"></p>';
  for (const file of [tinyMobi({ text: bad }), tinyKf8({ text: [bad] })]) {
    const source = await openSource(file);
    expect(await textsOf(source, "")).toEqual(["One"]);
    source.close();
  }
  expect("ran" in window).toBe(false);
});

test("a section whose root is of no known namespace is read as browsers read web pages", async () => {
  const whole = tinyKf8({ text: ["<p>One</p>", "<p>Two</p>"] });
  const letters = String.fromCharCode(...whole);
  whole[letters.lastIndexOf("www.w3.org") + 1] = 0x78;
  const source = await openSource(whole);
  expect(await textsOf(source, "")).toEqual(["One", "Two"]);
  source.close();
});

test("text that unpacks to more than its bound is rejected", async () => {
  // Each record repeats itself to five times its length.
  const packed = packPalmDoc(new Uint8Array(1_000_000).fill(65));
  const file = tinyMobi({ text: "x".repeat(packed.length * 20), recordSize: packed.length });
  const bytes = new Uint8Array(file);
  const view = new DataView(bytes.buffer);
  const at = (record: number) => view.getUint32(78 + 8 * record);
  for (let record = 1; record <= 20; record++) bytes.set(packed, at(record));
  view.setUint16(at(0), 2);
  expect(await messageOf(openSource(bytes))).toBe(
    `this book has more than ${limits.markupBytes / 1e6} MB of text; split it.`,
  );
});

test.each([
  ["heads, none of which ends", "<head>".repeat(200_000)],
  ["guides, none of which ends", `<!--${"<guide ".repeat(200_000)}-->`],
  ["breaks before its text", `<mbp:pagebreak${" ".repeat(200)}>`.repeat(limits.pages)],
])("a MOBI of many %s is gone through once", async (_, markup) => {
  const source = await openSource(tinyMobi({ text: `${markup}<p>Text</p>` }));
  expect((await textsOf(source, "")).join("")).toContain("Text");
  source.close();
});

test("metadata and tables that would have no end come to one", async () => {
  const contents = [{ title: "One", at: 0 }];
  const whole = tinyMobi({ text: "<p>One</p>", contents });
  const view = new DataView(whole.buffer);
  const first = view.getUint32(78);
  // An entry of no length, of four thousand million.
  view.setUint32(first + 264 + 8, 0xffffffff);
  view.setUint32(first + 264 + 16, 0);
  const source = await openSource(whole.slice());
  expect(await textsOf(source, "")).toEqual(["One"]);
  source.close();
  // A table of entries that claim more numbers than there are bytes.
  const table = view.getUint32(78 + 8 * 2);
  view.setUint32(table + 24, 0xffffffff);
  const without = await openSource(whole);
  expect(await without.outline?.(never)).toEqual([]);
  without.close();
});

test("a file cut off anywhere, or with any byte changed, is read or rejected in a sentence", async () => {
  const mobi = tinyMobi({
    text: "<p>One</p><mbp:pagebreak/><p>Two</p>",
    contents: [{ title: "One", at: 0 }],
    compression: 2,
  });
  const kf8 = tinyKf8({
    text: ["<p>One</p>", "<p>Two</p>"],
    contents: [{ title: "Two", at: 1 }],
    flows: ["p { color: red }"],
  });
  for (const whole of [mobi, kf8]) {
    const step = Math.floor(whole.length / 25);
    for (let at = 70; at < whole.length; at += step) {
      const changed = whole.slice();
      changed[at] = (changed[at] ?? 0) ^ 0x55;
      for (const bytes of [whole.slice(0, at), changed]) {
        await openSource(new Blob([bytes])).then(
          async (source) => {
            await source.outline?.(never);
            source.close();
          },
          (error: Error) => expect(error.name).toBe("BookError"),
        );
      }
    }
  }
});

test("a MOBI in Hebrew goes from right to left", async () => {
  const file = tinyMobi({ text: "<p>בראשית ברא אלהים.</p>", metadata: { 524: "he" } });
  const source = await openSource(new Blob([file]));
  expect(source.direction).toBe("rtl");
  const [first] = (await source.text?.(0, never)) ?? [];
  const { width } = await source.size(0);
  expect((first?.x ?? 0) + (first?.width ?? 0)).toBeGreaterThan(0.7 * width);
  source.close();
});

test.each([
  ["MOBI", tinyMobi],
  ["KF8", tinyKf8],
])("a cover that a %s names and does not have is none, and said to be missing", async (_, pack) => {
  const file = pack({ text: "<p>words</p>", metadata: { 201: 7 } });
  const source = await openSource(new Blob([file]));
  expect([source.cover, await textsOf(source, "")]).toEqual(["stamped", ["words"]]);
  expect(source.warnings?.map(({ message }) => message)).toEqual([
    "cover, an image of this book, is missing or cannot be shown.",
  ]);
  source.close();
});

test("a MOBI that ends within its text is damaged, and one that ends behind it is read", async () => {
  const resources = [await png()];
  const file = tinyMobi({ text: `<p>${"words ".repeat(2000)}</p>`, resources });
  const records = new DataView(file.buffer);
  const startOf = (record: number): number => records.getUint32(78 + 8 * record);
  expect(await messageOf(openSource(new Blob([file.subarray(0, startOf(2) + 100)])))).toBe(
    "this book is damaged or no Kindle book; repair it or get it again.",
  );
  const source = await openSource(new Blob([file.subarray(0, startOf(4) + 10)]));
  expect((await textsOf(source, "")).join("")).toContain("words words");
  source.close();
});

test("a MOBI is in the code page that it names", async () => {
  const file = tinyMobi({ text: "<p>????</p>", metadata: { 503: "A" } });
  const at = file.findIndex((_, k) => String.fromCharCode(...file.subarray(k, k + 4)) === "????");
  file.set([0xd1, 0xeb, 0xee, 0xe2], at);
  const first = new DataView(file.buffer).getUint32(78);
  new DataView(file.buffer).setUint32(first + 28, 1251);
  const source = await openSource(new Blob([file]));
  expect(await textsOf(source, "")).toEqual(["Слов"]);
  source.close();
});

test("a link of a MOBI into a tag, an entity or a letter leads to where that begins, and shows nothing", async () => {
  const text = "<p class='a'>Käse &amp; Brot</p><p>Ende</p>";
  const place = (words: string, more: number): number =>
    new TextEncoder().encode(text.slice(0, text.indexOf(words))).length + more;
  const places = [place("class", 2), place("ä", 1), place("amp", 1), place("Ende", -1)];
  const contents = places.map((at, k) => ({ title: `Line ${k}`, at }));
  const source = await openSource(new Blob([tinyMobi({ text, contents })]));
  expect(await textsOf(source, "")).toEqual(["Käse & BrotEnde"]);
  expect((await source.outline?.(never))?.map(({ page }) => page)).toEqual([1, 1, 1, 1]);
  source.close();
});

test("a drawing or a style sheet that a KF8 names and does not have is said to be missing", async () => {
  const text =
    '<p>words</p><img src="kindle:flow:0007?mime=image/svg+xml"/><link rel="stylesheet" type="text/css" href="kindle:flow:0009?mime=text/css"/>';
  const source = await openSource(new Blob([tinyKf8({ text })]));
  await textsOf(source, "");
  expect(source.warnings?.map(({ code, source }) => [code, source])).toEqual([
    ["style", "kindle:flow:0009?mime=text/css"],
    ["image", "kindle:flow:0007?mime=image/svg+xml"],
  ]);
  source.close();
});
