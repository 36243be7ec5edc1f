/** FictionBooks in real Chromium: read, linked and kept within bounds. */

import { strToU8, zipSync } from "fflate";
import { expect, test } from "vitest";
import { messageOf, redness, textsOf } from "../../for_tests/source_pages.ts";
import { limits } from "../limits.ts";
import { openSource } from "../open.ts";
import { tinyFb2 } from "./tiny_fb2.ts";

const never = new AbortController().signal;

async function picture(): Promise<string> {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [40, 60];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#f00";
  pen.fillRect(0, 0, 40, 60);
  return canvas.toDataURL().split(",")[1] ?? "";
}

const chapters =
  '<title><p>A small</p><p>book</p></title><epigraph><p>From hell’s heart</p><text-author>Ahab</text-author></epigraph><section><title><p>One</p></title><p>Call me <emphasis>Ishmael</emphasis>.<a l:href="#n1" type="note">[1]</a> <a l:href="#two">On</a>, <a l:href="https://example.com/">web</a>.</p><empty-line/><poem><stanza><v>A line</v><v>and another</v></stanza></poem><section><title><p>Within</p></title><p>Deeper.</p></section></section><section id="two"><title><p>Two</p></title><p><image l:href="#p.png"/></p><table><tr><th>a</th><td colspan="2">b</td></tr></table></section>';
const notes =
  '<body name="notes"><title><p>Notes</p></title><section id="n1"><title><p>1</p></title><p>A name.</p></section></body>';

test("a FictionBook says of which series it is, and what it is about", async () => {
  const info =
    '<annotation><p>A <strong>whale</strong>.</p><p>A ship.</p></annotation><sequence name="The sea" number="2"/><sequence/>';
  const source = await openSource(
    new Blob([tinyFb2("<section><p>Call me</p></section>", "", info)]),
  );
  expect(source.details).toEqual([
    { label: "", value: "Herman Melville" },
    { label: "Series", value: "The sea, 2" },
    { label: "", value: "A whale. A ship." },
  ]);
  source.close();
});

test("a FictionBook has its cover, text, contents, notes, links, pictures and author", async () => {
  const binary = `<binary id="p.png" content-type="image/png">${await picture()}</binary>`;
  const cover = '<coverpage><image l:href="#p.png"/></coverpage>';
  const source = await openSource(new Blob([tinyFb2(chapters, notes + binary, cover)]));
  expect([source.title, source.language]).toEqual(["A small book", "en"]);
  expect(source.details).toEqual([{ label: "", value: "Herman Melville" }]);
  const pages = await textsOf(source, " ");
  expect(pages.map((page) => page.replace(/\s+/g, " ").trim())).toEqual([
    "",
    "A small book From hell’s heart Ahab",
    expect.stringMatching(
      /^One Call me Ishmael ?\. ?\[1\] On ?, web ?\. A line and another Within Deeper\.$/,
    ),
    "Two a b",
    "Notes 1 A name.",
  ]);
  expect(await source.outline?.(never)).toEqual([
    { title: "One", page: 3, children: [{ title: "Within", page: 3, children: [] }] },
    { title: "Two", page: 4, children: [] },
    { title: "Notes", page: 5, children: [] },
  ]);
  const links = await source.links?.(2, never);
  expect(links?.map(({ to, note }) => [to, note])).toEqual([
    [{ page: 5 }, "1\nA name."],
    [{ page: 4 }, undefined],
    [{ href: "https://example.com/" }, undefined],
  ]);
  expect(await redness(source, 0)).toBeGreaterThan(0.005);
  expect(await redness(source, 1)).toBe(0);
  expect(await redness(source, 3)).toBeGreaterThan(0.005);
  source.close();
});

test("it is read from a ZIP, in UTF-16 and in windows-1251", async () => {
  const text = tinyFb2("<section><p>Слово</p></section>");
  const zipped = zipSync({ "book.fb2": strToU8(text) });
  const utf16 = new Uint16Array(
    [0xfeff, ...text].map((one) => (typeof one === "string" ? one.charCodeAt(0) : one)),
  );
  const cyrillic = Uint8Array.from(text.replace("utf-8", "windows-1251"), (letter) => {
    const code = letter.charCodeAt(0);
    return code < 128 ? code : code - 0x410 + 0xc0;
  });
  for (const bytes of [zipped, utf16, cyrillic]) {
    const source = await openSource(new Blob([bytes as BlobPart]));
    expect(await textsOf(source, " ")).toEqual(["Слово"]);
    expect(source.title).toBe("A small book");
    source.close();
  }
});

test("a title without paragraphs is one, and in the contents", async () => {
  const chapters =
    "<section><title>A <emphasis>bare</emphasis> title</title><p>words</p></section>";
  const source = await openSource(new Blob([tinyFb2(chapters)]));
  expect((await source.outline?.(never))?.map(({ title }) => title)).toEqual(["A bare title"]);
  source.close();
});

test("without a declaration its encoding is found by its letters, whatever pictures are in it", async () => {
  const picture = `<binary id="a" content-type="image/png">${"\nAbCd09+/wXyZ".repeat(4).replaceAll("\n", "").padEnd(76, "q").concat("\n").repeat(800)}</binary>`;
  const text = tinyFb2(
    "<section><p>Мороз и солнце; день чудесный! Еще ты дремлешь, друг прелестный, пора, красавица, проснись: открой сомкнуты негой взоры навстречу северной Авроры, звездою севера явись!</p></section>",
    picture,
  );
  const bytes = Uint8Array.from(text.replace(/<\?.*?\?>/, "<?xml version='1.0'?>"), (letter) => {
    const code = letter.charCodeAt(0);
    return code < 128 ? code : code - 0x410 + 0xc0;
  });
  const source = await openSource(new Blob([bytes]));
  expect((await textsOf(source, " ")).join(" ")).toContain("Мороз и солнце; день чудесный!");
  source.close();
});

test("scripts in it do not run, nothing is fetched, and entities that multiply are not expanded", async () => {
  const bad =
    '<section><p>One<script xmlns="http://www.w3.org/1999/xhtml">parent.ran = 1</script><image l:href="https://elsewhere.invalid/a.png"/></p><a l:href="javascript:parent.ran = 1">two</a></section>';
  const source = await openSource(new Blob([tinyFb2(bad)]));
  expect(await source.links?.(0, never)).toEqual([]);
  expect("ran" in window).toBe(false);
  source.close();
  const entities = Array.from(
    { length: 30 },
    (_, k) => `<!ENTITY e${k + 1} "&e${k};&e${k};">`,
  ).join("");
  const laughs = tinyFb2("<section><p>&e30;</p></section>").replace(
    "<FictionBook",
    `<!DOCTYPE FictionBook [<!ENTITY e0 "ha">${entities}]><FictionBook`,
  );
  const laughing = await openSource(new Blob([laughs]));
  const runs = (await laughing.text?.(0, never)) ?? [];
  expect(runs.map(({ text }) => text).join("")).toBe("&e30;");
  laughing.close();
});

test("one that is no XML, has no text, or has too many elements says so", async () => {
  const cutOff = tinyFb2("<section><p>One").replace("</body></FictionBook>", "");
  expect(await messageOf(openSource(new Blob([cutOff])))).toMatch(
    /^this book is damaged in line \d+; repair it or get it again\.$/,
  );
  expect(await messageOf(openSource(new Blob([tinyFb2("")])))).toBe(
    "this book has no text; get it again.",
  );
  const many = tinyFb2(`<section>${"<p/>".repeat(limits.elements)}</section>`);
  expect(await messageOf(openSource(new Blob([many])))).toBe(
    `this book has more than ${limits.elements} elements; split it.`,
  );
});

test("sections within each other, as deep as the browser reads them, are read", async () => {
  const deep = tinyFb2(`${"<section>".repeat(200)}<p>Deep</p>${"</section>".repeat(200)}`);
  const source = await openSource(new Blob([deep]));
  expect(await textsOf(source, " ")).toEqual(["Deep"]);
  source.close();
});

test("a body after the first is text, unless it is named as notes or a note leads into it", async () => {
  const section = (title: string, id = "") =>
    `<section${id && ` id="${id}"`}><title><p>${title}</p></title><p>words</p></section>`;
  const link = '<section><p><a l:href="#n" type="note">1</a></p></section>';
  const others = [
    `<body>${section("Two")}${section("Three")}</body>`,
    `<body name="part 2">${section("Four")}</body>`,
    `<body name="end">${section("Five", "n")}</body>`,
    `<body name="comments">${section("Six")}</body>`,
  ].join("");
  const source = await openSource(new Blob([tinyFb2(section("One") + link, others)]));
  const lines = await source.outline?.(never);
  expect(lines?.map(({ title, page }) => [title, page])).toEqual([
    ...[["One", 1] as const, ["Two", 3] as const, ["Three", 4] as const, ["Four", 5] as const],
  ]);
  expect(source.pageCount).toBe(7);
  source.close();
});

test("a cover that is not there is none, and said to be missing", async () => {
  const cover = '<coverpage><image l:href="#gone.png"/></coverpage>';
  const source = await openSource(
    new Blob([tinyFb2("<section><p>words</p></section>", "", cover)]),
  );
  expect([source.cover, await textsOf(source, " ")]).toEqual(["stamped", ["words"]]);
  expect(source.warnings?.map(({ message }) => message)).toEqual([
    "#gone.png, an image of this book, is missing or cannot be shown.",
  ]);
  source.close();
});

test.each(["he", ""])("Hebrew goes from right to left, if its language is %j", async (language) => {
  const text = tinyFb2("<section><p>בראשית ברא אלהים.</p></section>").replace(
    "<lang>en</lang>",
    `<lang>${language}</lang>`,
  );
  const source = await openSource(new Blob([text]));
  expect(source.direction).toBe("rtl");
  const [first] = (await source.text?.(0, never)) ?? [];
  const { width } = await source.size(0);
  expect((first?.x ?? 0) + (first?.width ?? 0)).toBeGreaterThan(0.7 * width);
  source.close();
});

test("a FictionBook whose elements have a prefix is read", async () => {
  const text = tinyFb2("<section><p>words</p></section>")
    .replace("xmlns=", "xmlns:fb=")
    .replace(/<(\/?)(?=\w)/g, "<$1fb:");
  const source = await openSource(new Blob([text]));
  expect([source.title, await textsOf(source, " ")]).toEqual(["A small book", ["words"]]);
  source.close();
});
