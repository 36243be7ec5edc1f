/** Whatever a file of a book says, it is opened within the bounds or rejected in one sentence. */

import { strToU8, type Zippable, zipSync } from "fflate";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { commands } from "vitest/browser";
import { eventually } from "../for_tests/eventually.ts";
import { sampleBooks } from "../for_tests/format_samples.ts";
import { canvas2, canvas3, manifest2, manifest3, serve } from "../for_tests/image_server.ts";
import { clue, fuzzed, type Random, wildPieces } from "../for_tests/random_numbers.ts";
import { rar4, rar5, sevenZip } from "../for_tests/stored_archives.ts";
import { tinyFb2 } from "./fb2/tiny_fb2.ts";
import { tinyKf8, tinyMobi } from "./kindle/tiny_kindle.ts";
import { limits } from "./limits.ts";
import { openSource } from "./open.ts";
import { BookError, type PageSource } from "./page_source.ts";
import { tinyPdf } from "./tiny_pdf.ts";

const never = new AbortController().signal;
const elsewhere = "https://elsewhere.invalid";

/** Pages that are read of each book. */
const mostRead = 3;

beforeEach(async () => {
  // foliate-js writes on the console what is wrong with a book.
  vi.spyOn(console, "warn").mockImplementation(() => {});
  await commands.requestsElsewhere();
});
afterEach(() => {
  vi.restoreAllMocks();
  Reflect.deleteProperty(window, "ran");
});

/** Pieces of markup, style and XML that run, fetch, multiply or break something. */
const wildMarkup: readonly string[] = [
  ...wildPieces,
  ...[
    "<",
    ">",
    "</",
    "/>",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?x",
    "&",
    "&#0;",
    "&#xd800;",
    "&a;",
  ],
  '<!DOCTYPE a [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]>',
  `<!DOCTYPE a [<!ENTITY a SYSTEM "${elsewhere}/a">]>`,
  "<script>parent.ran = 1</script>",
  '<img src="x" onerror="parent.ran = 1"/>',
  '<svg xmlns="http://www.w3.org/2000/svg" onload="parent.ran = 1"><foreignObject><script>parent.ran = 1</script></foreignObject></svg>',
  `<img src="${elsewhere}/b.png"/><link rel="stylesheet" href="${elsewhere}/c.css"/>`,
  `<iframe src="${elsewhere}/d"></iframe><meta http-equiv="refresh" content="0; url=${elsewhere}/e"/>`,
  `@import "${elsewhere}/f.css";`,
  `background: url(${elsewhere}/g.png);`,
  "width: 1e9px; columns: 1000; column-width: 0.001px;",
  ...[
    "../../../x",
    "%00",
    "%",
    "#%",
    "c1.xhtml#%zz",
    "data:text/html,<script>parent.ran=1</script>",
  ],
  ...[
    'id="id"',
    'href=""',
    'href="OEBPS"',
    'media-type="image/png"',
    'properties="nav cover-image"',
  ],
];

/** Opens a book, and reads some of its pages if it can be opened. Fails if it does not keep the bounds. */
async function expectReadOrRejected(file: Blob, input: unknown): Promise<void> {
  let source: PageSource | undefined;
  const rejected = (error: unknown): void => {
    expect(error, clue(input)).toBeInstanceOf(BookError);
    expect((error as Error).message, clue(input)).toMatch(/^[^\n]+\.$/);
    expect((error as Error).message.length, clue(input)).toBeLessThan(1000);
  };
  try {
    source = await openSource(file);
    await read(source, rejected, clue(input));
  } catch (error) {
    rejected(error);
  } finally {
    source?.close();
  }
  expect("ran" in window, clue(input)).toBe(false);
  expect(await commands.requestsElsewhere(), clue(input)).toEqual([]);
  // One that is being laid out goes when it is done.
  await eventually(() => document.querySelectorAll("iframe").length).toBe(0);
}

async function read(
  source: PageSource,
  rejected: (error: unknown) => void,
  said: string,
): Promise<void> {
  expect(source.pageCount >= 1 && source.pageCount <= 2 * limits.pages, said).toBe(true);
  expect(source.title.length, said).toBeLessThanOrEqual(limits.titleLength);
  for (let index = 0; index < Math.min(source.pageCount, mostRead); index++) {
    try {
      const { width, height } = await source.size(index);
      expect(width > 0 && height > 0 && width + height < 1e6, said).toBe(true);
      const picture = await source.draw(index, 60, never);
      expect(picture.width * picture.height, said).toBeLessThanOrEqual(limits.pixels);
      if ("close" in picture) picture.close();
      const runs = (await source.text?.(index, never)) ?? [];
      expect(runs.length, said).toBeLessThanOrEqual(limits.runs);
      expect(
        runs.every((run) => Number.isFinite(run.x + run.y + run.width)),
        said,
      ).toBe(true);
      for (const { to } of (await source.links?.(index, never)) ?? []) {
        if ("href" in to) expect(to.href, said).toMatch(/^(https?|mailto):/);
        else expect(to.page >= 1 && to.page <= source.pageCount, said).toBe(true);
      }
      await source.alt?.(index, never);
    } catch (error) {
      // The other pages are read nevertheless.
      rejected(error);
    }
  }
  await source.outline?.(never);
  await source.file?.();
}

/** Changes, takes out or doubles some bytes; now and then cuts the end off. */
function mutateBytes(random: Random, bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  let mutated = bytes.slice();
  for (let k = random.below(6); k >= 0; k--) {
    mutated[random.below(mutated.length)] = random.among([0, 255, 1, random.below(256)]);
  }
  if (random.below(4) === 0) mutated = mutated.slice(0, random.below(mutated.length));
  return mutated;
}

const zip = (files: Readonly<Record<string, string | Uint8Array>>): Uint8Array<ArrayBuffer> =>
  zipSync(
    Object.fromEntries(
      Object.entries(files).map(([name, all]) => [
        name,
        typeof all === "string" ? strToU8(all) : all,
      ]),
    ) as Zippable,
  ) as Uint8Array<ArrayBuffer>;

async function png(): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(4, 6);
  canvas.getContext("2d")?.fillRect(0, 0, 2, 3);
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

const document3 = (body: string): string =>
  `<?xml version="1.0"?><html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops"><head><title>t</title><link rel="stylesheet" href="style.css"/></head><body>${body}</body></html>`;
const drawing =
  '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><image href="a.png" width="9" height="9"/></svg>';

/** The texts of a small EPUB, each a parser's input. */
const epubTexts: Readonly<Record<string, string>> = {
  "META-INF/container.xml":
    '<container xmlns="urn:oasis:names:tc:opendocument:xmlns:container" version="1.0"><rootfiles><rootfile full-path="OEBPS/package.opf" media-type="application/oebps-package+xml"/></rootfiles></container>',
  "META-INF/encryption.xml":
    '<encryption xmlns="urn:oasis:names:tc:opendocument:xmlns:container" xmlns:enc="http://www.w3.org/2001/04/xmlenc#"><enc:EncryptedData><enc:EncryptionMethod Algorithm="http://www.idpf.org/2008/embedding"/><enc:CipherData><enc:CipherReference URI="OEBPS/f.ttf"/></enc:CipherData></enc:EncryptedData></encryption>',
  "OEBPS/package.opf":
    '<package xmlns="http://www.idpf.org/2007/opf" version="3.0" unique-identifier="id" prefix="x: https://x.example/"><metadata xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:identifier id="id">urn:uuid:1</dc:identifier><dc:title id="t">A book</dc:title><meta refines="#t" property="title-type">main</meta><dc:language>en</dc:language><meta name="cover" content="p"/></metadata><manifest><item id="c1" href="c1.xhtml" media-type="application/xhtml+xml"/><item id="c2" href="c2.xhtml" media-type="application/xhtml+xml" properties="svg"/><item id="c3" href="c3.svg" media-type="image/svg+xml"/><item id="x" href="x.bin" media-type="application/x-other" fallback="c2"/><item id="s" href="style.css" media-type="text/css"/><item id="p" href="a.png" media-type="image/png"/><item id="n" href="nav.xhtml" media-type="application/xhtml+xml" properties="nav"/><item id="ncx" href="toc.ncx" media-type="application/x-dtbncx+xml"/></manifest><spine toc="ncx" page-progression-direction="ltr"><itemref idref="c1"/><itemref idref="c2" linear="no"/><itemref idref="c3" properties="rendition:layout-pre-paginated page-spread-left"/><itemref idref="x"/></spine><guide><reference type="cover" title="Cover" href="c1.xhtml"/></guide></package>',
  "OEBPS/nav.xhtml": document3(
    '<nav epub:type="toc"><ol><li><a href="c1.xhtml#a">One</a><ol><li><a href="c2.xhtml">Two</a></li></ol></li></ol></nav>',
  ),
  "OEBPS/toc.ncx":
    '<ncx xmlns="http://www.daisy.org/z3986/2005/ncx/"><navMap><navPoint id="a" playOrder="1"><navLabel><text>One</text></navLabel><content src="c1.xhtml"/></navPoint></navMap></ncx>',
  "OEBPS/c1.xhtml": document3(
    '<h1 id="a">One</h1><p style="color: red; background: url(a.png)">Call me <a href="c2.xhtml#b">Ishmael</a>.</p><img src="a.png" alt="A whale"/>',
  ),
  "OEBPS/c2.xhtml": document3(
    `<p id="b">Two</p>${drawing}<table><tr><td>1</td></tr></table><math xmlns="http://www.w3.org/1998/Math/MathML"><mi>x</mi></math>`,
  ),
  "OEBPS/c3.svg": drawing,
  "OEBPS/style.css":
    '@import "more.css"; @font-face { font-family: f; src: url(f.ttf) } p { color: red; background: url("a.png") } @media screen { p::before { content: "x" } }',
  "OEBPS/x.bin": "other",
};

fuzzed("a mutated EPUB is read or rejected", 10, async (random) => {
  const name = random.among(Object.keys(epubTexts));
  const text = random.mutate(epubTexts[name] as string, wildMarkup);
  // Without a navigation document the NCX is read.
  const files = { mimetype: "application/epub+zip", ...epubTexts, [name]: text };
  const bytes = zip({ ...files, "OEBPS/a.png": await png() });
  await expectReadOrRejected(new Blob([bytes]), { name, text });
});

fuzzed("a file of any format with mutated bytes is read or rejected", 40, async (random) => {
  const [name, , make] = random.among(sampleBooks);
  const book = await make();
  const whole = typeof book === "string" ? (strToU8(book) as Uint8Array<ArrayBuffer>) : book;
  const bytes = mutateBytes(random, whole);
  await expectReadOrRejected(new Blob([bytes]), [name, [...bytes].join()]);
});

fuzzed("a mutated comic is read or rejected", 20, async (random) => {
  const info = random.mutate(
    '<?xml version="1.0"?><ComicInfo><Title>Dawn</Title><Series>Hero</Series><Number>1</Number><LanguageISO>ja</LanguageISO><Manga>YesAndRightToLeft</Manga><Pages><Page Image="0" Bookmark="Cover"/><Page Image="1" DoublePage="true" Type="Deleted"/></Pages></ComicInfo>',
    wildMarkup,
  );
  const image = await png();
  const whole = zip({
    "ComicInfo.xml": info,
    "1.png": image,
    "2.png": image,
    "3.svg": random.mutate(drawing, wildMarkup),
  });
  const bytes = random.below(2) === 0 ? mutateBytes(random, whole) : whole;
  await expectReadOrRejected(new File([bytes], "a.cbz"), { info, bytes: [...bytes].join() });
});

fuzzed("a mutated comic of RAR or 7-Zip is read or rejected", 15, async (random) => {
  const image = await png();
  const pack = random.among([rar4, rar5, sevenZip]);
  const whole = pack({
    "ComicInfo.xml": random.mutate("<ComicInfo><Title>Dawn</Title></ComicInfo>", wildMarkup),
    "1.png": image,
    "2.png": image,
    "3.svg": random.mutate(drawing, wildMarkup),
  });
  const bytes = random.below(4) === 0 ? whole : mutateBytes(random, whole);
  await expectReadOrRejected(new File([bytes], "a.cbr"), [...bytes].join());
});

fuzzed("a mutated MOBI or KF8 is read or rejected", 15, async (random) => {
  const contents = [
    { title: "One", at: 0 },
    { title: "Two", at: 1, parent: 0 },
  ];
  const more = { contents, compression: random.among([1, 2]), resources: [await png()] };
  const link = '<a filepos=0000000009>x</a><a href="kindle:pos:fid:0001:off:0000000000">y</a>';
  const text = random.mutate(
    `<html><body><p>One ${link}</p><mbp:pagebreak/><p height="1em"><img recindex="00001"/><img src="kindle:embed:0001"/></p></body></html>`,
    wildMarkup,
  );
  const flows = [random.mutate("p { color: red; background: url(kindle:embed:0001) }", wildMarkup)];
  const isMobi = random.below(2) === 0;
  const whole = isMobi
    ? tinyMobi({ text, ...more })
    : tinyKf8({ text: [text, "<p>Two</p>"], flows, ...more });
  const bytes = random.below(4) === 0 ? whole : mutateBytes(random, whole);
  await expectReadOrRejected(new Blob([bytes]), [...bytes].join());
});

fuzzed("a mutated FictionBook is read or rejected", 10, async (random) => {
  const whole = tinyFb2(
    '<title><p>A</p></title><section id="a"><title><p>One</p></title><p>Call <a l:href="#n" type="note">1</a> <image l:href="#p"/></p><poem><stanza><v>b</v></stanza></poem></section>',
    '<body name="notes"><section id="n"><p>Note</p></section></body><binary id="p" content-type="image/png">iVBORw0KGgo=</binary>',
  );
  const text = random.mutate(whole, wildMarkup);
  const bytes =
    random.below(3) === 0 ? mutateBytes(random, strToU8(text) as Uint8Array<ArrayBuffer>) : text;
  await expectReadOrRejected(new Blob([bytes]), text);
});

fuzzed("an image with mutated bytes is read or rejected", 30, async (random) => {
  const type = random.among(["image/png", "image/jpeg", "image/webp"]);
  const canvas = new OffscreenCanvas(20, 30);
  canvas.getContext("2d")?.fillRect(0, 0, 10, 10);
  const whole = new Uint8Array(await (await canvas.convertToBlob({ type })).arrayBuffer());
  const bytes = mutateBytes(random, whole);
  await expectReadOrRejected(new Blob([bytes]), [...bytes].join());
});

fuzzed("mutated Markdown and text are read or rejected", 20, async (random) => {
  const marks = [
    "#",
    "\n\n",
    "> ",
    "- ",
    "1. ",
    "    ",
    "```\n",
    "|",
    "|-|\n",
    "*",
    "_",
    "[",
    "](",
    ")",
  ];
  const text = random.mutate(
    "---\na: b\n---\n# One\n\nCall [me](#one) *Ishmael* ![x](a.png) `code`.\n\n> quoted\n\n- a\n  - b\n\n| a | b |\n|---|---|\n| c | d |\n\n## Two\n\n<b>bold</b> <https://x.example/>\n",
    [...wildMarkup, ...marks, ...marks],
  );
  await expectReadOrRejected(new File([text], random.among(["a.md", "a.txt"])), text);
});

fuzzed("a mutated manifest of IIIF is read or rejected", 40, async (random) => {
  const note = {
    motivation: "supplementing",
    body: { type: "TextualBody", value: "Call me" },
    target: "c#xywh=1,2,30,40",
  };
  const whole = random.among([
    manifest3([canvas3("a", { annotations: [{ items: [note] }] }), canvas3("b")]),
    manifest2([canvas2("a"), canvas2("b")]),
  ]);
  const text = random.mutate(JSON.stringify(whole), wildMarkup);
  const image = { width: 40, height: 60 };
  serve({ a: image, b: image }, {});
  await expectReadOrRejected(new File([text], "m.json"), text);
  for (const [address] of vi.mocked(fetch).mock.calls) {
    // Relative addresses lead to the page's own host.
    const { host } = new URL(String(address));
    expect(
      host === location.host || text.includes(host) || host.endsWith("example"),
      clue(text),
    ).toBe(true);
  }
  vi.restoreAllMocks();
});

fuzzed("a mutated PDF is read or rejected", 5, async (random) => {
  const bytes = tinyPdf({
    pages: ["BT /F 12 Tf 20 200 Td (Call me) Tj ET", "0 0 1 rg 0 0 50 50 re f"],
    catalog: "/Lang (en) /OpenAction << /S /JavaScript /JS (app.alert(1)) >> /Outlines 10 0 R",
    resources: "/Font << /F 11 0 R >>",
    objects: [
      "<< /First 12 0 R /Last 12 0 R /Count 1 >>",
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
      `<< /Title (One) /Parent 10 0 R /A << /S /URI /URI (${elsewhere}/a) >> >>`,
    ],
  });
  const text = String.fromCharCode(...bytes);
  const words = [
    "/Kids [2 0 R]",
    "/Count 999999999",
    "/Parent 2 0 R",
    "stream\n",
    "endstream",
    "<<",
    ">>",
  ];
  const mutated =
    random.below(3) === 0
      ? mutateBytes(random, bytes)
      : Uint8Array.from(random.mutate(text, [...wildPieces, ...words]), (c) => c.charCodeAt(0));
  await expectReadOrRejected(new Blob([mutated]), String.fromCharCode(...mutated));
});

test("a request to another host would be seen, of a frame too", async () => {
  await fetch(`${elsewhere}/seen`).catch(() => {});
  const frame = document.createElement("iframe");
  frame.srcdoc = `<img src="${elsewhere}/framed" alt="">`;
  const loaded = new Promise((resolve) => frame.addEventListener("load", resolve));
  document.body.append(frame);
  await loaded;
  frame.remove();
  await eventually(() => commands.requestsElsewhere()).toEqual(
    expect.arrayContaining([expect.stringContaining("elsewhere")]),
  );
});
