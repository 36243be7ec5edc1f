import { afterEach, expect, test, vi } from "vitest";
import { commands } from "vitest/browser";
import { clock } from "../../for_tests/clock.ts";
import { hugeImages } from "../../for_tests/huge_images.ts";
import { limits } from "../limits.ts";
import { messageOf } from "../message_of.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";
import { prose, type TinyEpub, tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;
const web = "https://elsewhere.invalid";

afterEach(() => {
  vi.restoreAllMocks();
  Reflect.deleteProperty(window, "ran");
});

/** Opens a book, draws its pages and reads them. Returns their text. */
async function readAll(epub: TinyEpub | Uint8Array<ArrayBuffer>): Promise<string> {
  const source: PageSource = await openSource(epub instanceof Uint8Array ? epub : tinyEpub(epub));
  let text = "";
  try {
    for (let index = 0; index < Math.min(source.pageCount, 4); index++) {
      const picture = await source.draw(index, 100, never);
      if ("close" in picture) picture.close();
      text += ((await source.text?.(index, never)) ?? []).map((run) => run.text).join(" ");
      await source.links?.(index, never);
    }
    await source.outline?.(never);
  } finally {
    source.close();
  }
  return text;
}

/** Returns the addresses that the page and its frames have requested since. */
function requests(): () => string[] {
  // The browser lists a few hundred, of which the viewer's own modules are most.
  performance.clearResourceTimings();
  return () =>
    performance
      .getEntriesByType("resource")
      .map(({ name }) => name)
      .filter((name) => name.includes("elsewhere"));
}

test.each([
  ["a script", "<script>parent.ran = 1; ran = 1</script>"],
  [
    "an event",
    '<img src="x" onerror="parent.ran = 1" alt=""/><svg xmlns="http://www.w3.org/2000/svg" onload="parent.ran = 1"/>',
  ],
  ["a frame", '<iframe srcdoc="&lt;script>parent.parent.ran = 1&lt;/script>"></iframe>'],
  [
    "an address",
    '<a href="javascript:parent.ran=1" id="a">x</a><form action="javascript:parent.ran=1"><input type="image" src="x"/></form>',
  ],
  [
    "a drawing",
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"><script>parent.ran = 1</script><animate onbegin="parent.ran=1" attributeName="x" dur="1s"/><use xlink:href="data:image/svg+xml,&lt;svg id=&quot;a&quot; xmlns=&quot;http://www.w3.org/2000/svg&quot;>&lt;script>parent.ran=1&lt;/script>&lt;/svg>#a"/></svg>',
  ],
  [
    "an object",
    '<object data="evil.svg" type="image/svg+xml"></object><embed src="evil.svg"/><img src="evil.svg" alt=""/>',
  ],
  [
    "a mutation",
    '<math xmlns="http://www.w3.org/1998/Math/MathML"><mtext><table xmlns="http://www.w3.org/1999/xhtml"><mglyph><style><!--</style><img title="--&gt;&lt;img src=1 onerror=parent.ran=1>" alt=""/></mglyph></table></mtext></math>',
  ],
])("a chapter with %s runs nothing", async (_, markup) => {
  const evil =
    '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><script>parent.ran = 1; top.ran = 1</script></svg>';
  const text = await readAll({
    chapters: [`<p>Before.</p>${markup}<p>After.</p>`],
    files: { "evil.svg": evil },
  });
  expect(text).toContain("Before.");
  expect(text).toContain("After.");
  await clock.pass(50);
  expect("ran" in window).toBe(false);
});

test("a book fetches nothing, whatever it names", async () => {
  const fetched = requests();
  const fetching = vi.spyOn(globalThis, "fetch");
  const names = [
    `<img src="${web}/a.png" srcset="${web}/b.png 2x" alt=""/>`,
    `<picture><source srcset="${web}/c.png"/><img src="//elsewhere.invalid/d.png" alt=""/></picture>`,
    `<video poster="${web}/e.png" src="${web}/f.mp4"></video><audio src="${web}/g.mp3" autoplay=""/>`,
    `<link rel="stylesheet" href="${web}/h.css"/><link rel="preload" as="image" href="${web}/i.png"/>`,
    `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"><image xlink:href="${web}/j.png" width="9" height="9"/><use href="${web}/k.svg#a"/><filter><feImage href="${web}/l.png"/></filter></svg>`,
    `<p style="background: url(${web}/m.png); list-style-image: image-set('${web}/n.png' 1x); --x: url(${web}/o.png); border-image: var(--x)">p</p>`,
    `<object data="${web}/p.svg"></object><embed src="${web}/q.svg"/><iframe src="${web}/r"></iframe>`,
    `<base href="${web}/"/><meta http-equiv="refresh" content="0; url=${web}/s"/><table background="${web}/t.png"><tr><td>.</td></tr></table>`,
  ];
  const css = [
    `@import "${web}/1.css"; @import url(${web}/2.css);`,
    `@font-face { font-family: x; src: url(${web}/3.woff2), local("x") } body { font-family: x }`,
    `p { background: u\\72l("${web}/4.png"); cursor: url(${web}/5.png), auto; --y: u\\72l(${web}/6.png); background: var(--y) }`,
    `p::before { content: url(${web}/7.png); mask: url(${web}/8.svg#a); filter: url(${web}/9.svg#a) }`,
    `@media screen { p { background: -webkit-image-set(url(${web}/10.png) 1x) } }`,
    `@supports (color: red) { p { shape-outside: url(${web}/11.png) } } @page { background: url(${web}/12.png) }`,
  ].join("\n");
  const text = await readAll({ chapters: [`<p>Before.</p>${names.join("")}`], css });
  expect(text).toContain("Before.");
  await clock.pass(100);
  expect(fetched()).toEqual([]);
  expect(fetching.mock.calls.filter(([to]) => String(to).includes("elsewhere"))).toEqual([]);
});

test("names that lead out of the archive find nothing", async () => {
  const chapters = ['<img src="../../../../etc/passwd" alt="none"/><p>Here.</p>'];
  expect(
    await readAll({ chapters, css: '@import "../../x.css";', raw: { "../up.png": "x" } }),
  ).toContain("Here.");
});

const bomb = (levels: number): string => {
  const entities = Array.from({ length: levels }, (_, k) =>
    k === 0 ? '<!ENTITY e0 "lol">' : `<!ENTITY e${k} "${`&e${k - 1};`.repeat(10)}">`,
  );
  return `<!DOCTYPE html [${entities.join("")}]>`;
};

test("entities that multiply are not expanded", async () => {
  const chapter = `<?xml version="1.0"?>${bomb(10)}<html xmlns="http://www.w3.org/1999/xhtml"><body><p>&e9;</p></body></html>`;
  // As a chapter: it is read as a web page, in which the entities mean nothing.
  expect((await readAll({ chapters: [chapter] })).length).toBeLessThan(10_000);
  const container = `<?xml version="1.0"?>${bomb(10)}<container>&e9;</container>`;
  // The package is found without it.
  expect(await readAll({ chapters: ["x"], raw: { "META-INF/container.xml": container } })).toBe(
    "x",
  );
});

test("a package whose entities multiply lists nothing, contents that do are left out", async () => {
  const list = `<?xml version="1.0"?>${bomb(10)}`;
  const opf = { "OEBPS/package.opf": `${list}<package>&e9;</package>` };
  expect(await readAll({ chapters: ["Here."], raw: opf })).toContain("Here.");
  const nav = `${list}<html xmlns="http://www.w3.org/1999/xhtml"><body>&e9;</body></html>`;
  expect(await readAll({ chapters: ["Here."], raw: { "OEBPS/nav.xhtml": nav } })).toContain(
    "Here.",
  );
});

test.each(Object.entries(hugeImages))(
  "a picture of too many pixels is left out, the text is not: %s",
  async (format, bytes) => {
    const data = `data:image/${format};base64,${btoa(String.fromCharCode(...bytes))}`;
    const files = { "big.png": bytes };
    const css = `p { background: url("big.png") } p::before { content: url(${data}) }`;
    const pictures = `<img src="big.png" alt=""/><img src="${data}" alt=""/>`;
    const source = await openSource(
      tinyEpub({ chapters: [`${pictures}<p>Here.</p>`], files, css }),
    );
    expect((await source.text?.(0, never))?.map(({ text }) => text)).toContain("Here.");
    const frame = document.querySelector("iframe")?.contentDocument;
    expect(frame?.querySelectorAll("img")).toHaveLength(2);
    expect(frame?.querySelectorAll("img[src]")).toHaveLength(0);
    const styles = frame?.adoptedStyleSheets.flatMap(({ cssRules }) => [...cssRules]) ?? [];
    expect(styles.some(({ cssText }) => cssText.includes(data.slice(5)))).toBe(false);
    source.close();
  },
);

test("a style sheet of thousands of imports, none of which ends, is read", async () => {
  for (const css of [`${"@import x ".repeat(200_000)}{`, `@import x${" ".repeat(1_000_000)}{`]) {
    expect(await readAll({ chapters: ["Here."], css })).toContain("Here.");
  }
});

test.each([
  ["strings, none of which ends", `p { --x: ${'\\\\"'.repeat(300_000)}; }`],
  [
    "fonts in a string",
    `p::before { content: "${"@font-face { ".repeat(200_000)}"; display: none }`,
  ],
])("a style sheet of many %s is gone through once", async (_, css) => {
  expect(await readAll({ chapters: ["Here."], css })).toContain("Here.");
});

test("style sheets that import each other many times, and links to large ones, come to an end", async () => {
  const style = vi.spyOn(CSSStyleSheet.prototype, "replaceSync");
  const longest = (): number => Math.max(...style.mock.calls.map(([css]) => css.length));
  const times = (name: string, count: number): string => `@import "${name}";\n`.repeat(count);
  const files = {
    "b.css": times("c.css", 1) + times("d.css", 600),
    "c.css": times("d.css", 600) + times("e.css", 600),
    "d.css": "p { color: red; }\n".repeat(50),
    "e.css": "p { color: blue; }\n".repeat(50),
  };
  await readAll({ chapters: ["Here."], css: times("b.css", 600), files });
  expect(longest()).toBeLessThan(100_000);
  style.mockClear();
  const large = `p::before { content: "${"x".repeat(1_000_000)}" }`;
  const links = Array.from({ length: 30 }, (_, k) => `<link rel="stylesheet" href="l.css?${k}"/>`);
  const chapter = `<html xmlns="http://www.w3.org/1999/xhtml"><head>${links.join("")}</head><body>Here.</body></html>`;
  expect(await readAll({ chapters: [chapter], files: { "l.css": large } })).toContain("Here.");
  expect(longest()).toBeLessThan(limits.markupBytes + 100);
});

test.each([
  ["screen", "9px"],
  ["screen, &quot;", "9px"],
  ["(foo &quot;", "0px"],
  ["screen, (x: '", "0px"],
  ["all { p { color: red } } @media all", "0px"],
])("the media %s of a link to a style sheet do not reach into the sheet", async (media, margin) => {
  const link = `<link rel="stylesheet" href="quoted.css" media="${media}"/>`;
  const source = await openSource(
    tinyEpub({
      chapters: [
        `<html xmlns="http://www.w3.org/1999/xhtml"><head>${link}</head><body><p>Here.</p></body></html>`,
      ],
      files: {
        "quoted.css": `p { margin-left: 9px } i::before { content: "{ p { color: red } }" } i::after { content: "' { p { color: red } }" }`,
      },
    }),
  );
  await source.draw(0, 50, never);
  const paragraph = document.querySelector("iframe")?.contentDocument?.querySelector("p");
  const { color, marginLeft } = getComputedStyle(paragraph as Element);
  expect([color === "rgb(255, 0, 0)", marginLeft]).toEqual([false, margin]);
  source.close();
});

test("millions of spaces between two words are passed over in few steps", async () => {
  // The page's own clock stands still while a book is read, and that on the wall is other work's too.
  await commands.processUse();
  const spaces = " ".repeat(4_000_000);
  expect(await readAll({ chapters: [`<p>One${spaces}two.</p>`] })).toContain("One");
  // A step for each took 20 seconds, and the rest takes one.
  expect((await commands.processUse()).seconds).toBeLessThan(8);
});

test("a chapter of hundreds of pictures, each another, is read", async () => {
  const picture = (k: number): string =>
    `<img alt="" src="data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw${String(k).padStart(1200, "A")}"/>`;
  const pictures = Array.from({ length: 800 }, (_, k) => picture(k)).join("");
  expect(await readAll({ chapters: [`<p>Here.</p>${pictures}`] })).toContain("Here.");
});

test("a package of too many elements is rejected, one of thousands of chapters is read", async () => {
  const many = Array.from({ length: 60_000 }, () => "<meta/>").join("");
  expect(await messageOf(readAll({ chapters: ["x"], metadata: many }))).toBe(
    "this book has a list of more than 50000 elements; split it.",
  );
  // None of them can be read, nor the fallback of any.
  const items = Array.from(
    { length: 3000 },
    (_, k) => `<item id="x${k}" href="x" media-type="x/x" fallback="x${k + 1}"/>`,
  ).join("");
  const itemrefs = Array.from({ length: 3000 }, (_, k) => `<itemref idref="x${k}"/>`).join("");
  const source = await openSource(tinyEpub({ chapters: ["Here."], items, itemrefs }));
  await source.draw(0, 50, never);
  expect(await messageOf(source.draw(source.pageCount - 1, 50, never))).toContain("is missing");
  source.close();
});

test("lines of a package in which something is missing are left out", async () => {
  const items = '<item id="a" media-type="text/css"/><item href="cover.png"/><item/>';
  const itemrefs = "<itemref/>";
  const metadata = '<guide><reference title="x"/></guide>';
  expect(await readAll({ chapters: ["Here."], items, itemrefs, metadata })).toContain("Here.");
});

test("a chapter of too many elements says so on its page, and the rest is read", async () => {
  const source = await openSource(
    tinyEpub({ chapters: ["<p>One.</p>", "<i/>".repeat(limits.elements + 1)] }),
  );
  await source.draw(0, 50, never);
  expect(await messageOf(source.draw(source.pageCount - 1, 50, never))).toBe(
    `A chapter of this book has more than ${limits.elements} elements; split it.`,
  );
  source.close();
});

test("a first chapter that cannot be read leaves the rest readable", async () => {
  const source = await openSource(
    tinyEpub({ chapters: ["<i/>".repeat(limits.elements + 1), "<p>Two.</p>"] }),
  );
  await messageOf(source.draw(0, 50, never));
  const last = source.pageCount - 1;
  expect((await source.text?.(last, never))?.map(({ text }) => text)).toEqual(["Two."]);
  source.close();
});

test("a chapter whose root is of no known namespace is read as one of HTML", async () => {
  const odd = '<html xmlns="http://www.x3.org/1999/xhtml"><body><p>One</p></body></html>';
  expect(await readAll({ chapters: [odd] })).toBe("One");
});

test("what is encrypted is rejected in one sentence", async () => {
  const encryption =
    '<encryption xmlns="urn:oasis:names:tc:opendocument:xmlns:container" xmlns:enc="http://www.w3.org/2001/04/xmlenc#"><enc:EncryptedData><enc:EncryptionMethod Algorithm="http://www.w3.org/2001/04/xmlenc#aes128-cbc"/><enc:CipherData><enc:CipherReference URI="OEBPS/c1.xhtml"/></enc:CipherData></enc:EncryptedData></encryption>';
  expect(
    await messageOf(readAll({ chapters: ["x"], raw: { "META-INF/encryption.xml": encryption } })),
  ).toBe("this book is protected against copying (DRM); open it in its shop's reader.");
});

test.each([
  ["no package", { "OEBPS/package.opf": "" }],
  ["a package of another kind", { "OEBPS/package.opf": "<html/>" }],
])("an EPUB with %s fails in one sentence", async (_, raw) => {
  expect(await messageOf(readAll({ chapters: ["x"], raw }))).toMatch(
    /^this book (is damaged or no EPUB|has no chapters).*\.$/,
  );
});

test("an EPUB cut off or with bytes changed fails in a sentence or is read", async () => {
  const whole = tinyEpub({ chapters: [prose(3)], css: "p { color: red }" });
  const tries = [0.2, 0.5, 0.9, 0.99].map((part) => whole.slice(0, part * whole.length));
  for (let at = 40; at < whole.length; at += Math.floor(whole.length / 25)) {
    tries.push(whole.with(at, (whole[at] as number) ^ 0x55) as Uint8Array<ArrayBuffer>);
  }
  for (const bytes of tries) {
    await readAll(bytes).catch((error: Error) => expect(error.name).toBe("BookError"));
  }
});
