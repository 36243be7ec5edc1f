/**
 * Books of few bytes that would take any time and memory, and long ones that are
 * no attack: for tests that all of them are opened or rejected.
 */

import { deflateSync, strToU8, zipSync } from "fflate";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";

const svgNamespace = 'xmlns="http://www.w3.org/2000/svg"';
const svg = (content: string): string =>
  `<svg ${svgNamespace} width="600" height="800" viewBox="0 0 600 800">${content}</svg>`;
const times = (count: number, make: (k: number) => string): string =>
  Array.from({ length: count }, (_, k) => make(k)).join("");
const rect = '<rect width="600" height="800" fill="#070"/>';
const escaped = (text: string): string => `data:image/svg+xml,${encodeURIComponent(text)}`;

/** Returns groups, each of which shows the one before it ten times by `show`. */
const tenfold = (levels: number, show: (id: string) => string): string =>
  times(levels, (k) => `<g id="g${k + 1}">${show(`g${k}`).repeat(10)}</g>`);

/** Returns levels of an element, each of which is drawn with the one before it. */
const nested = (name: string, levels: number, more = ""): string =>
  `<defs><${name} id="n0" ${more}>${rect}</${name}>${times(
    levels,
    (k) => `<${name} id="n${k + 1}" ${more}><g ${name}="url(#n${k})">${rect}</g></${name}>`,
  )}</defs>`;

/** Returns pictures within each other, of so many levels, each with so many of the next. */
function pictures(levels: number, count: number): string {
  let text = svg(rect);
  for (let k = 0; k < levels; k++) {
    const image = `<image id="i" href="${escaped(text)}" width="600" height="800"/>`;
    text = svg(image + times(count, (j) => `<use href="#i" x="${j}"/>`));
  }
  return text;
}

/** Returns a bitmap (BMP) of one colour that is run-length encoded: a few bytes for any number of pixels. */
function bitmap(width: number, height: number): string {
  const view = new DataView(new ArrayBuffer(1081));
  const [B, M] = [66, 77];
  view.setUint8(0, B);
  view.setUint8(1, M);
  for (const [at, value] of [
    ...[
      [2, 1081],
      [10, 1078],
      [14, 40],
      [18, width],
      [22, height],
    ],
    ...[
      [30, 1],
      [34, 3],
      [46, 256],
    ],
  ] as const) {
    view.setUint32(at ?? 0, value ?? 0, true);
  }
  view.setUint16(26, 1, true);
  view.setUint16(28, 8, true);
  view.setUint8(1079, 1);
  return `data:image/bmp;base64,${btoa(String.fromCharCode(...new Uint8Array(view.buffer)))}`;
}

/** Drawings that stand for more than can be drawn. */
const hostileDrawings: Readonly<Record<string, string>> = {
  "use within use": svg(
    `<defs><g id="g0">${rect}</g>${tenfold(9, (id) => `<use href="#${id}"/>`)}</defs><use href="#g9"/>`,
  ),
  "masks within masks": svg(`${nested("mask", 60)}<g mask="url(#n60)">${rect}</g>`),
  "clips within clips": svg(
    `<defs><clipPath id="c0"><rect width="9" height="9"/></clipPath>${times(
      80,
      (k) =>
        `<clipPath id="c${k + 1}" clip-path="url(#c${k})">${`<rect width="600" height="800" clip-path="url(#c${k})"/>`.repeat(9)}</clipPath>`,
    )}</defs><g clip-path="url(#c80)">${rect}</g>`,
  ),
  "patterns within patterns": svg(
    `<defs><pattern id="p0" width="1" height="1">${rect}</pattern>${times(
      60,
      (k) =>
        `<pattern id="p${k + 1}" width=".5" height=".5">${`<rect width="600" height="800" fill="url(#p${k})"/>`.repeat(4)}</pattern>`,
    )}</defs><rect width="600" height="800" fill="url(#p60)"/>`,
  ),
  "markers within markers": svg(
    `<defs><marker id="m0" markerWidth="9" markerHeight="9">${rect}</marker>${times(
      9,
      (k) =>
        `<marker id="m${k + 1}" markerWidth="9" markerHeight="9"><path d="M${times(20, (j) => `${j} ${j} `)}" marker-mid="url(#m${k})"/></marker>`,
    )}</defs><path d="M${times(20, (j) => `${j} ${j} `)}" marker-mid="url(#m9)"/>`,
  ),
  "filters within each other": svg(
    `<filter id="f"><feGaussianBlur stdDeviation="90"/><feMorphology radius="90"/></filter>${'<g filter="url(#f)">'.repeat(200)}${rect}${"</g>".repeat(200)}`,
  ),
  "a filter of thousands of steps": svg(
    `<filter id="f">${'<feGaussianBlur stdDeviation="9"/>'.repeat(2000)}</filter><g filter="url(#f)">${rect}</g>`,
  ),
  "layers by style": svg(
    `<style>g { opacity: 0.9; mix-blend-mode: multiply; }</style>${"<g>".repeat(250)}${rect}${"</g>".repeat(250)}`,
  ),
  "filters upon each other": svg(
    `<filter id="f"><feGaussianBlur stdDeviation="20"/></filter>${'<rect width="600" height="800" filter="url(#f)"/>'.repeat(2000)}`,
  ),
  "gradients upon each other": svg(
    `<radialGradient id="g"><stop/><stop stop-opacity="0"/></radialGradient>${'<rect width="600" height="800" fill="url(#g)"/>'.repeat(5000)}`,
  ),
  "clear shapes upon each other": svg(
    '<rect width="600" height="800" fill="red" opacity=".5"/>'.repeat(1900),
  ),
  "a matrix of thousands of numbers": svg(
    `<filter id="f"><feConvolveMatrix order="100" kernelMatrix="${"1 ".repeat(10_000)}"/></filter><rect width="600" height="800" filter="url(#f)"/>`,
  ),
  "pictures within pictures": pictures(3, 60),
  "a picture of an unknown kind": svg(
    `<image href="${bitmap(22_000, 22_000)}" width="600" height="800"/>`,
  ),
};

/** Returns a chapter of boxes, each as large as a page, that lie upon each other. */
function uponEachOther(what: string, style: string, count: number) {
  const place = "position: absolute; left: 0; top: 0; width: 100%; height: 100%";
  return {
    [`${what} upon each other`]: [
      `div { ${place}; background: red; ${style}; }`,
      "<div></div>".repeat(count),
    ] as const,
  };
}

/** What a chapter of an EPUB may have in its style, and its body. */
const chapters: Readonly<Record<string, readonly [css: string, body: string]>> = {
  "long content": [`p::before { content: "${"word ".repeat(100_000)}"; }`, "<p>a</p>".repeat(1000)],
  "content by variables": [
    `html { --v0: "word word "; ${times(12, (k) => `--v${k + 1}: ${`var(--v${k}) `.repeat(8)};`)} } p::before { content: var(--v12); }`,
    "<p>a</p>".repeat(1000),
  ],
  "thousands of shadows": [
    `p { text-shadow: ${times(3000, (k) => `${k ? "," : ""}${k}px 1px 9px red`)}; }`,
    "<p>Here.</p>".repeat(500),
  ],
  "large shadows of many words": [
    `p { text-shadow: ${times(200, (k) => `${k ? "," : ""}${k % 9}px 1px 99px red`)}; }`,
    "<p>Here.</p>".repeat(50),
  ],
  "large shadows by variables": [
    `html { --a: 0 0 99px red; --b: ${times(200, (k) => `${k ? "," : ""}var(--a)`)}; } p { box-shadow: var(--b); }`,
    "<p>Here.</p>".repeat(500),
  ],
  "filters of many functions": [
    `p { filter: ${"blur(9px) ".repeat(400)}; }`,
    "<p>Here.</p>".repeat(20),
  ],
  ...uponEachOther("blurs", "filter: blur(20px)", 5000),
  ...uponEachOther("gradients", "background: conic-gradient(red, transparent)", 5000),
  ...uponEachOther(
    "lists of gradients",
    `background: ${times(100, (k) => `${k ? "," : ""}radial-gradient(red, transparent)`)}`,
    200,
  ),
  ...uponEachOther("tiny gradients", "background: radial-gradient(red, blue) 0 0 / 1px 1px", 300),
  ...uponEachOther("clips", "clip-path: circle(40%)", 5000),
  "a grid of millions of columns": [
    "div { display: grid; grid-template-columns: repeat(3000000, 1px); }",
    "<div><p>a</p></div>",
  ],
  "a grid of millions of rows by variables": [
    "html { --a: 3000000; --b: var(--a); } div { display: grid; } p { grid-row-start: var(--b); }",
    "<div><p>a</p></div>",
  ],
  "a grid of millions of rows by a shorthand, half of it overridden": [
    "html { --a: repeat(3000000, 1px) / 1px; } div { display: grid; grid-template: var(--a); grid-template-columns: 2px; }",
    "<div><p>a</p></div>",
  ],
  "boxes of millions of pages": ["div { height: 33000000px; }", "<div>a</div>".repeat(50)],
  "fields of millions of lines": ["", '<textarea rows="10000000">a</textarea>'.repeat(20)],
  "a table of millions of cells": [
    "",
    `<table><tr>${'<td colspan="1000" rowspan="60000">a</td>'.repeat(50)}</tr>${"<tr><td>b</td></tr>".repeat(3000)}</table>`,
  ],
  "columns within columns": [
    "div { columns: 2; }",
    `${"<div>".repeat(30)}<p>${"word ".repeat(300)}</p>${"</div>".repeat(30)}`,
  ],
  "rules within rules": [
    `.a { ${"& &, & p { ".repeat(25)} color: red; ${"} ".repeat(25)} }`,
    "<p>a</p>".repeat(20),
  ],
  "content of nested rules": [
    `p { &::before { content: "${"word ".repeat(100_000)}"; } }`,
    "<p>a</p>".repeat(1000),
  ],
  "long marks of counters": [
    `@counter-style long { system: cyclic; symbols: "${"long ".repeat(200_000)}"; } ol { list-style: long inside; }`,
    `<ol>${"<li>a</li>".repeat(3000)}</ol>`,
  ],
  "long marks of lists": [
    `ul { list-style: "${"long ".repeat(900)}" inside; }`,
    `<ul>${"<li>a</li>".repeat(3000)}</ul>`,
  ],
  "marks upon a letter": ["", `<p>a${"\u0301".repeat(100_000)}</p>`],
  "rules that look for descendants": [
    times(300, (k) => `*:has(.a${k} ~ .b) { color: red; }`),
    "<div><p>a</p></div>".repeat(20_000),
  ],
  "rules that look at siblings": [
    times(500, (k) => `p ~ i ~ p:not(.a${k}) ~ b { color: red; }`),
    "<p>a</p>".repeat(20_000),
  ],
};

/** Chapters that are read, however long what they have is. */
const long: Readonly<Record<string, string>> = {
  "thick lines about letters": `<p style="-webkit-text-stroke: 10000px red">${"word ".repeat(3000)}</p>`,
  "a word of 400,000 letters": `<p>${"w".repeat(400_000)}</p>`,
  "a paragraph that changes its direction": `<p>${"a \u05d0 ".repeat(50_000)}</p>`,
};

/** A book by its name, as a file. */
export interface HostileBook {
  readonly name: string;
  readonly make: () => File;
  /** Whether it has to be rejected; it has to be opened otherwise. */
  readonly isRefused: boolean;
  /** What is said of its first page, if that cannot be drawn though the book is opened. */
  readonly firstPage?: RegExp;
}

const file = (parts: readonly (string | Uint8Array<ArrayBuffer>)[], name: string): File =>
  new File([...parts], name);

/** Returns an archive of drawings. */
function comic(files: Readonly<Record<string, string>>): Uint8Array<ArrayBuffer> {
  const bytes = Object.entries(files).map(([name, text]) => [name, strToU8(text)] as const);
  return zipSync(Object.fromEntries(bytes)) as Uint8Array<ArrayBuffer>;
}

/** Returns bytes that begin as a JPEG, and go on as nothing. */
function jpegOf(length: number): Uint8Array {
  const bytes = new Uint8Array(length);
  bytes.set([0xff, 0xd8, 0xff, 0xe0]);
  return bytes;
}

/** Returns a ZIP in which many entries of the directory are one file. */
function sameFile(data: Uint8Array, count: number, ending: string): Uint8Array<ArrayBuffer> {
  const packed = deflateSync(data, { level: 9 });
  const record = (mark: number, length: number, at: number, name: string): Uint8Array => {
    const bytes = new Uint8Array(length + name.length);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, mark, true);
    view.setUint16(at, 8, true);
    view.setUint32(at + 10, packed.length, true);
    view.setUint32(at + 14, data.length, true);
    view.setUint16(at + 18, name.length, true);
    bytes.set(strToU8(name), length);
    return bytes;
  };
  const start = record(0x04034b50, 30, 8, "a");
  const entries = Array.from({ length: count }, (_, k) =>
    record(0x02014b50, 46, 10, `${k}.${ending}`),
  );
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true);
  end.setUint16(8, count, true);
  end.setUint16(10, count, true);
  end.setUint32(
    12,
    entries.reduce((sum, { length }) => sum + length, 0),
    true,
  );
  end.setUint32(16, start.length + packed.length, true);
  const parts = [start, packed, ...entries, new Uint8Array(end.buffer)];
  const all = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** Returns all books. */
export function hostileBooks(): readonly HostileBook[] {
  const drawings = Object.entries(hostileDrawings).flatMap(([what, text]): HostileBook[] => {
    const isRefused = !what.includes("unknown kind");
    return [
      { name: `an SVG: ${what}`, make: () => file([text], "a.svg"), isRefused: true },
      {
        name: `a comic: ${what}`,
        make: () => file([comic({ "1.svg": text, "2.svg": svg(rect) })], "a.cbz"),
        isRefused: true,
      },
      {
        name: `an EPUB: ${what}`,
        make: () => file([tinyEpub({ chapters: [text, "<p>Here.</p>"] })], "a.epub"),
        isRefused,
      },
      {
        name: `an EPUB's picture: ${what}`,
        make: () => {
          const chapter = '<p>Here.</p><img src="a.svg" alt=""/>';
          return file([tinyEpub({ chapters: [chapter], files: { "a.svg": text } })], "a.epub");
        },
        isRefused: true,
      },
      {
        name: `Markdown: ${what}`,
        make: () => file([`Here.\n\n<div>${text}</div>\n`], "a.md"),
        isRefused,
      },
    ];
  });
  const styles = Object.entries(chapters).map(
    ([what, [css, body]]): HostileBook => ({
      name: `an EPUB: ${what}`,
      make: () => {
        const chapter = `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title><style><![CDATA[${css}]]></style></head><body>${body}</body></html>`;
        return file([tinyEpub({ chapters: [chapter, "<p>Here.</p>"] })], "a.epub");
      },
      isRefused: true,
    }),
  );
  const table = `|${" a |".repeat(20_000)}\n|${"-|".repeat(20_000)}\n${"| a |\n".repeat(20_000)}`;
  return [
    ...drawings,
    ...styles,
    {
      name: "Markdown: a table",
      make: () => file([`Here.\n\n${table}`], "a.md"),
      isRefused: false,
    },
    {
      name: "Markdown: a list",
      make: () => file(["- a\n".repeat(20_000)], "a.md"),
      isRefused: false,
    },
    {
      name: "an EPUB: italics",
      make: () =>
        file([tinyEpub({ chapters: [`<p>${"<i>a</i> ".repeat(50_000)}</p>`] })], "a.epub"),
      isRefused: false,
    },
    {
      name: "an EPUB: line breaks",
      make: () => file([tinyEpub({ chapters: [`<p>${"a<br/>".repeat(60_000)}</p>`] })], "a.epub"),
      isRefused: false,
    },
    ...Object.entries(long).map(
      ([what, body]): HostileBook => ({
        name: `an EPUB: ${what}`,
        make: () => file([tinyEpub({ chapters: [body] })], "a.epub"),
        isRefused: false,
      }),
    ),
    ...["", 'b="&gt;"', 'b=">"'].map(
      (first): HostileBook => ({
        name: `an EPUB: attributes of one element ${first}`,
        make: () => {
          const attributes = times(300_000, (k) => `a${k}="1" `);
          return file([tinyEpub({ chapters: [`<p ${first} ${attributes}>Here.</p>`] })], "a.epub");
        },
        isRefused: false,
      }),
    ),
    {
      name: "a comic: one image of 90 MB, 20,000 times",
      make: () => file([sameFile(jpegOf(90_000_000), 20_000, "jpg")], "a.cbz"),
      isRefused: false,
      firstPage: /^Page 1 of a\.cbz \(0\.jpg\) is damaged or no image; /,
    },
    {
      name: "an EPUB: a chapter of four megabytes",
      make: () => file([tinyEpub({ chapters: [prose(6000, 60)] })], "a.epub"),
      isRefused: false,
    },
  ];
}
