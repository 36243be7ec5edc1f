/** Small EPUBs; for tests only. */

import { strToU8, type Zippable, zipSync } from "fflate";

/** What is in a small EPUB. */
export interface TinyEpub {
  /** The chapters: what is in their `<body>`, or whole documents. */
  readonly chapters: readonly string[];
  /** Properties of chapters in the spine, by index. */
  readonly properties?: Readonly<Record<number, string>>;
  /** Other files beside the chapters, listed in the manifest by the endings of their names. */
  readonly files?: Readonly<Record<string, string | Uint8Array>>;
  /** A style sheet for every chapter. */
  readonly css?: string;
  /** Further metadata, as XML. */
  readonly metadata?: string;
  /** Attributes of the spine, such as `page-progression-direction="rtl"`. */
  readonly spine?: string;
  /** The list in the navigation document. The default names every chapter. */
  readonly toc?: string;
  /** Files of the archive as they are, by whole names. */
  readonly raw?: Readonly<Record<string, string | Uint8Array>>;
  /** Further items of the manifest, as XML; their files are in `raw`. */
  readonly items?: string;
  /** Further items of the spine, as XML. */
  readonly itemrefs?: string;
}

const types: Readonly<Record<string, string>> = {
  css: "text/css",
  png: "image/png",
  svg: "image/svg+xml",
  woff2: "font/woff2",
  ttf: "font/ttf",
  xhtml: "application/xhtml+xml",
};

/** Returns a document with a body. */
const page = (body: string): string =>
  body.startsWith("<?xml") || body.startsWith("<html")
    ? body
    : `<?xml version="1.0" encoding="utf-8"?><html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops"><head><title>t</title><link rel="stylesheet" href="style.css"/></head><body>${body}</body></html>`;

/** Builds a valid EPUB 3. */
export function tinyEpub(epub: TinyEpub): Uint8Array<ArrayBuffer> {
  const { chapters, files = {}, css = "", properties = {} } = epub;
  const names = chapters.map((_, k) => `c${k + 1}.xhtml`);
  const others = ["style.css", ...Object.keys(files)];
  const items = [
    ...names.map(
      (name, k) => `<item id="c${k}" href="${name}" media-type="application/xhtml+xml"/>`,
    ),
    ...others.map(
      (name, k) =>
        `<item id="f${k}" href="${name}" media-type="${types[name.split(".").pop() ?? ""] ?? "application/octet-stream"}"/>`,
    ),
    '<item id="nav" href="nav.xhtml" media-type="application/xhtml+xml" properties="nav"/>',
  ];
  const spine = names.map((_, k) => `<itemref idref="c${k}" properties="${properties[k] ?? ""}"/>`);
  const toc =
    epub.toc ?? names.map((name, k) => `<li><a href="${name}">Chapter ${k + 1}</a></li>`).join("");
  const text: Record<string, string | Uint8Array> = {
    "META-INF/container.xml":
      '<container xmlns="urn:oasis:names:tc:opendocument:xmlns:container" version="1.0"><rootfiles><rootfile full-path="OEBPS/package.opf" media-type="application/oebps-package+xml"/></rootfiles></container>',
    "OEBPS/package.opf": `<package xmlns="http://www.idpf.org/2007/opf" version="3.0" unique-identifier="id"><metadata xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:identifier id="id">urn:uuid:1</dc:identifier><dc:title>A small book</dc:title><dc:language>en-GB</dc:language>${epub.metadata ?? ""}</metadata><manifest>${items.join("")}${epub.items ?? ""}</manifest><spine ${epub.spine ?? ""}>${spine.join("")}${epub.itemrefs ?? ""}</spine></package>`,
    "OEBPS/nav.xhtml": page(`<nav epub:type="toc"><ol>${toc}</ol></nav>`),
    "OEBPS/style.css": css,
    ...Object.fromEntries(chapters.map((body, k) => [`OEBPS/${names[k]}`, page(body)])),
    ...Object.fromEntries(Object.entries(files).map(([name, file]) => [`OEBPS/${name}`, file])),
    ...epub.raw,
  };
  const zip: Zippable = { mimetype: [strToU8("application/epub+zip"), { level: 0 }] };
  for (const [name, file] of Object.entries(text)) {
    zip[name] = typeof file === "string" ? strToU8(file) : file;
  }
  return zipSync(zip) as Uint8Array<ArrayBuffer>;
}

/** Returns paragraphs of words that are all different. */
export function prose(paragraphs: number, words = 60): string {
  return Array.from({ length: paragraphs }, (_, p) => {
    const text = Array.from({ length: words }, (_, w) => `word${p}x${w}`).join(" ");
    return `<p id="p${p}">${text}.</p>`;
  }).join("");
}
