/** Markup that is not well-formed: books of strangers, each of which failed once, and others of their kind. */

import { unzipSync, zipSync } from "fflate";
import { expect, test } from "vitest";
import { closeBooks, laidOut, pagesOf, wordsOf } from "../../for_tests/laid_out_books.ts";
import { openSource } from "../open.ts";
import { tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeBooks();
const fixture = async (name: string): Promise<Blob> =>
  await (await fetch(new URL(`./fixtures/${name}`, import.meta.url))).blob();

test("chapters with characters by name, tags without ends, prefixes undeclared and the like are whole", async () => {
  const source = await laidOut(await fixture("e09b-malformed.epub"));
  const pages = await pagesOf(source);
  for (const page of pages) {
    expect(page).toContain("TAIL");
    expect(page).not.toContain("damaged");
  }
  expect(pages.join(" ")).toContain("Graham & James");
  for (let index = 0; index < source.pageCount; index++) await source.draw(index, 50, never);
});

test("contents whose ampersands stand bare, and a chapter in HTML's ways", async () => {
  const source = await laidOut(await fixture("e04-ncxamp.epub"));
  const outline = (await source.outline?.(never)) ?? [];
  expect(outline.map(({ title, page }) => [title, page])).toEqual([
    ["Tom & Jerry", 1],
    ["Second", 2],
  ]);
  expect(await wordsOf(source, 0)).toBe(
    "Café — naïve “quotes” Unclosed bold Second é & ampersand break",
  );
});

test("a package with blanks before it, or an encoding that it is not in", async () => {
  expect(await wordsOf(await laidOut(await fixture("e11-opfspace.epub")), 0)).toBe("X é");
  expect(await wordsOf(await laidOut(await fixture("e29-decl16.epub")), 0)).toBe("decl");
});

test("a chapter in another language than HTML has its words", async () => {
  const file =
    '<dtbook xmlns="http://www.daisy.org/z3986/2005/dtbook/"><book><bodymatter><level1><h1>Title</h1><p>Some <em>words</em></p><list type="ul"><li>item</li></list></level1></bodymatter></book></dtbook>';
  const source = await laidOut(
    tinyEpub({
      chapters: ["<p>before</p>"],
      raw: { "OEBPS/d.xml": file },
      items: '<item id="d" href="d.xml" media-type="application/x-dtbook+xml"/>',
      itemrefs: '<itemref idref="d"/>',
    }),
  );
  expect(await wordsOf(source, 1)).toBe("Title Some words item");
  const [title, words] = (await source.text?.(1, never)) ?? [];
  expect(title?.height).toBeGreaterThan((words?.height ?? 0) * 1.5);
});

const xhtml = (body: string): string =>
  `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title></head><body>${body}</body></html>`;

test.each([
  [
    "<p>a & b &lt;c&gt; &eacute;&hellip;&nbsp;&#8212;&#x2014; &unknown; d</p>",
    "a & b <c> é… —— &unknown; d",
  ],
  ["<p>x<br>y<hr>z<img src='n.png'></p>", "x y z"],
  ["<p>one<p>two<ul><li>three<li>four</ul>", "one two three four"],
  ["<p><i>a<b>b</i>c</b>d</p>", "a b c d"],
  ["<p a=1 b='2' a='3' c>attributes</p>", "attributes"],
  ["<o:p>office</o:p><p foo:bar='1'>prefix</p>", "office prefix"],
  ["<p><![CDATA[a < b && c]]> d</p>&", "a < b && c d &"],
  [
    "<svg viewBox='0 0 9 9' width=9><linearGradient id='a'/><text>drawn</text></svg><p>&nbsp;after</p>",
    "drawn after",
  ],
  ["<div/><p/><a id='x'/><span>kept</span>&copy;", "kept ©"],
  ["<p>3 < 4 and 5 > 4 & so on</p>", "3 < 4 and 5 > 4 & so on"],
  ["</p></div><p>ends without beginnings</p></span>", "ends without beginnings"],
  ["<!-- a -- b --><p>a comment&nbsp;</p>", "a comment"],
  ["<p>\u0001\uffff&#1;&#xFFFE;&#x110000;control</p>", "control"],
  ["<p>one</p><![CDATA[ <b> & ]]><p>two</p>", "one <b> & two"],
  ["<p>&#147;quoted&#x94; \u0085 &#x97;</p>", "“quoted” … —"],
  ["<p>&#xD83D;&#xDE00; &#55357;&#56832; &#xD83D;</p>", "😀 😀"],
  [
    "<p>if a < b then x<y and z<a.b <b>bold</b></p><p title='a<b'>c</p>",
    "if a < b then x<y and z<a.b bold c",
  ],
  ["<P Class='a'>one<BR/>two</P><P>three</P>", "one two three"],
  ["<noscript><p>one</p></noscript><xmp>two</xmp>", "one two"],
  ["<p>one</p></body><body><p>two</p></body><p>three</p><body>", "one two three"],
  ["<p>one&nbsp;</p></body></html><p>two</p>three<html><body>", "one two three"],
])("%j", async (body, text) => {
  const source = await laidOut(tinyEpub({ chapters: [xhtml(body), "<p>next</p>"] }));
  const page = await wordsOf(source, 0);
  expect(page.replace(/ /g, "")).toBe(text.replace(/ /g, ""));
  await source.draw(0, 50, never);
});

test("a chapter that breaks off says so above what there is of it", async () => {
  const broken = xhtml("<p>whole</p><p>&nbsp;half").replace("</body></html>", "");
  const source = await laidOut(tinyEpub({ chapters: [broken] }));
  const page = await wordsOf(source, 0);
  expect(page).toContain("This chapter is damaged in line 1; something in it may be missing.");
  expect(page).toContain("half");
});

test("elements that lie deeper than any parser of HTML goes are read as a web page", async () => {
  const deep = xhtml(`${"<div>".repeat(3000)}&nbsp;deep`);
  expect(await wordsOf(await laidOut(tinyEpub({ chapters: [deep] })), 0)).toContain("deep");
});

test("a chapter behind another's end is part of it, and nothing of it is damaged", async () => {
  const two = `${xhtml("<p>one</p>")}\n${xhtml("<p>two</p>")}\0`;
  expect(await wordsOf(await laidOut(tinyEpub({ chapters: [two] })), 0)).toBe("one two");
});

test("a chapter in an old encoding that it names as web pages do, or not at all", async () => {
  const russian = [0xcf, 0xf0, 0xe8, 0xe2, 0xe5, 0xf2, 0x20, 0xec, 0xe8, 0xf0];
  for (const head of ['<meta charset="windows-1251"/>', ""]) {
    const [before, after] = xhtml("<p>|</p>").replace("<title>", `${head}<title>`).split("|");
    const encoder = new TextEncoder();
    const chapter = [...encoder.encode(before), ...russian, ...encoder.encode(after)];
    const raw = { "OEBPS/c1.xhtml": Uint8Array.from(chapter) };
    expect(await wordsOf(await laidOut(tinyEpub({ chapters: ["x"], raw })), 0)).toBe("Привет мир");
  }
});

test.each([
  ["windows-1251", [0xcf, 0xf0, 0xe8], "При"],
  ["utf-16", [0xc3, 0xa9], "é"],
  ["iso-8859-1", [0xc3, 0xa9], "é"],
  ["iso-8859-1", [0xe9], "é"],
  ["none", [0xc3, 0xa9], "é"],
])("a chapter that declares %s", async (encoding, bytes, text) => {
  const [before, after] = xhtml("<p>|</p>").split("|") as [string, string];
  const encoder = new TextEncoder();
  const chapter = Uint8Array.from([
    ...encoder.encode(`<?xml version="1.0" encoding="${encoding}"?>${before}`),
    ...bytes,
    ...encoder.encode(after),
  ]);
  const book = tinyEpub({ chapters: ["x"], raw: { "OEBPS/c1.xhtml": chapter } });
  expect(await wordsOf(await laidOut(book), 0)).toBe(text);
});

test("a FictionBook with bare ampersands and named characters", async () => {
  const source = await laidOut(await fixture("f2-amp.fb2"));
  expect(source.title).toBe("Tom & Jerry");
  expect((await pagesOf(source)).join(" ")).toContain("Text a & b x TAIL");
});

test.each([
  ["no spine", ""],
  ["an empty spine", "<spine/>"],
  ["a spine that names nothing", "<spine><itemref/></spine>"],
])("a package with %s is read in the order of its manifest", async (_, spine) => {
  const item = (name: string, type = "application/xhtml+xml", more = ""): string =>
    `<item id="${name}" href="${name}.xhtml" media-type="${type}" ${more}/>`;
  const items = [
    item("nav", "application/xhtml+xml", 'properties="nav"'),
    item("c2"),
    item("c1", "text/html"),
  ].join("");
  const epub = tinyEpub({
    chapters: ["<p>one</p>", "<p>two</p>"],
    raw: {
      "OEBPS/package.opf": `<package xmlns="http://www.idpf.org/2007/opf" version="3.0"><manifest>${items}</manifest>${spine}</package>`,
    },
  });
  expect(await pagesOf(await laidOut(epub))).toEqual(["two", "one"]);
});

/** A package of two chapters. */
const twoChapters =
  '<package xmlns="http://www.idpf.org/2007/opf" version="2.0"><metadata/><manifest><item id="a" href="c1.xhtml" media-type="application/xhtml+xml"/><item id="b" href="c2.xhtml" media-type="application/xhtml+xml"/></manifest><spine><itemref idref="a"/><itemref idref="b"/></spine></package>';

test.each([
  ["items without ends", /xml"\/>/g, 'xml">'],
  ["lists without ends", /<\/metadata>|<\/manifest>|<metadata\/>/g, "<metadata>"],
  [
    "types in capitals, with parameters",
    /application\/xhtml\+xml/g,
    "Application/XHTML+XML; charset=utf-8",
  ],
  ["types that say nothing", /application\/xhtml\+xml/, "application/octet-stream"],
  ["items without types", / media-type="[^"]*"/g, ""],
  ["items of one id", /"b"/g, '"a"'],
  ["ids with blanks", /idref="a"/g, 'idref=" a "'],
  ["addresses of places in files", /xhtml" /g, 'xhtml#start" '],
  ["neither items nor lines", /<manifest>.*<\/spine>/g, ""],
])("a package that has %s is read", async (_, found, written) => {
  const raw = { "OEBPS/package.opf": twoChapters.replace(found, written) };
  const files = unzipSync(tinyEpub({ chapters: ["<p>one</p>", "<p>two</p>"], raw }));
  delete files["OEBPS/nav.xhtml"];
  const source = await laidOut(zipSync(files) as Uint8Array<ArrayBuffer>);
  expect(await pagesOf(source)).toEqual(["one", "two"]);
});

test("a package that lists nothing in an archive without chapters is rejected", async () => {
  const raw = { "OEBPS/package.opf": "<package/>" };
  const files = unzipSync(tinyEpub({ chapters: [], raw }));
  delete files["OEBPS/nav.xhtml"];
  const book = new Blob([zipSync(files) as Uint8Array<ArrayBuffer>]);
  await expect(openSource(book)).rejects.toThrow("this book has no chapters; get it again.");
});

test("an item that names no file is a page that says so", async () => {
  const raw = { "OEBPS/package.opf": twoChapters.replace('"c1.xhtml"', '""') };
  const source = await laidOut(tinyEpub({ chapters: ["<p>one</p>", "<p>two</p>"], raw }));
  await expect(source.draw(0, 50, never)).rejects.toThrow(
    "this book has a chapter “a” of which it names no file; get the book again.",
  );
});

test("a file that is not listed is shown in books from before EPUB 3, which forbids it", async () => {
  const style = "p { font-size: 40px }";
  const heights: number[] = [];
  for (const version of ["2.0", "3.0"]) {
    const raw = {
      "OEBPS/package.opf": twoChapters.replace("2.0", version),
      "OEBPS/style.css": style,
    };
    const source = await laidOut(tinyEpub({ chapters: ["<p>one</p>", "<p>two</p>"], raw }));
    heights.push((await source.text?.(0, never))?.[0]?.height ?? 0);
  }
  expect(heights[0]).toBeGreaterThan(1.5 * (heights[1] ?? 0));
});

test("what a chapter declares by name stands in it where it had to be repaired", async () => {
  const declared =
    '<!ENTITY press "Acme &amp; Sons"><!ENTITY both \'&press; and &#169; others\'><!ENTITY far SYSTEM "far.txt"><!ENTITY self "me &self;">';
  const laughs = Array.from(
    { length: 9 },
    (_, k) => `<!ENTITY l${k + 1} "${`&l${k};`.repeat(10)}">`,
  );
  const chapter = `<?xml version="1.0"?><!DOCTYPE html [${declared}<!ENTITY l0 "ha">${laughs.join("")}]><html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title></head><body><p>By &press; / &both; <br> &far; &self; &l9; end</p></body></html>`;
  const source = await laidOut(tinyEpub({ chapters: [chapter] }));
  const words = await wordsOf(source, 0);
  expect(words).toContain("By Acme & Sons / Acme & Sons and © others &far; me &self; &l");
  expect(words.length).toBeLessThan(10_000);
});
