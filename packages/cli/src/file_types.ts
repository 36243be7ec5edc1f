import { isMarkdownName, kindOfName } from "./file_names.ts";

/**
 * Number of first bytes of a file that determine its format: a PDF's mark has
 * up to 1024 others before it.
 */
export const sniffLength = 1029;

const marks: readonly (readonly [string, number, string])[] = [
  ["image/png", 0, "\x89PNG\r\n\x1a\n"],
  ["image/jpeg", 0, "\xff\xd8\xff"],
  ["image/gif", 0, "GIF8"],
  ["image/webp", 8, "WEBP"],
  ["image/avif", 4, "ftypavi"],
  ["image/tiff", 0, "II*\0"],
  ["image/tiff", 0, "MM\0*"],
  ["image/jp2", 4, "jP  \r\n\x87\n"],
  ["image/jp2", 0, "\xff\x4f\xff\x51"],
  ["image/jxl", 4, "JXL \r\n\x87\n"],
  ["image/jxl", 0, "\xff\x0a"],
  ["image/heic", 4, "ftyphei"],
];

const archives: typeof marks = [
  ["application/zip", 0, "PK\x03\x04"],
  ["application/zip", 0, "PK\x05\x06"],
  ["application/vnd.rar", 0, "Rar!\x1a\x07"],
  ["application/x-7z-compressed", 0, "7z\xbc\xaf\x27\x1c"],
  ["application/x-tar", 257, "ustar"],
  ["application/gzip", 0, "\x1f\x8b\x08"],
  ["application/zstd", 0, "\x28\xb5\x2f\xfd"],
  ["application/x-xz", 0, "\xfd7zXZ\0"],
];

/** A Kindle book: the type of its database, after its name, its dates and the like. */
const [kindle, kindleAt] = ["BOOKMOBI", 60];
const kindleType = "application/x-mobipocket-ebook";

/** What a FictionBook begins with, and its root. */
const fictionBook = [/^<(\?xml|!--|!doctype fictionbook|fictionbook)/i, /<fictionbook[\s>]/i];

/** A manifest that is an array has strings or objects: [text] is a link of Markdown. */
const json = /^(\{|\[\s*["{\]])/;

/** What is no book, and why: tests of a file's first words. */
const rejected: readonly (readonly [(words: string) => boolean, string])[] = [
  [
    (words) => /^<(!doctype svg|svg[\s>])/i.test(afterProlog(words)),
    "is an SVG, which may hold scripts",
  ],
  [
    (words) => /^<(!doctype html|html|\?xml|!--|head|body)/i.test(words),
    "is a web page, not a book",
  ],
  [(words) => /^BZh\d1AY&SY/.test(words), "is packed by bzip2, which is not unpacked here"],
  [
    (words) => /^\0{512,}$/.test(words),
    "has no pages but only zeros, as an empty tar or a file that was not fetched whole",
  ],
  [(words) => json.test(words), "is JSON (a IIIF manifest is opened by its address)"],
];

/**
 * Returns the media type of an image by its first bytes (latin-1); undefined
 * for any other file.
 */
export function imageType(start: string): string | undefined {
  return marks.find(([, offset, mark]) => start.startsWith(mark, offset))?.[0];
}

/** Returns whether a media type is of archives. */
export function isArchiveType(type: string): boolean {
  return archives.some(([one]) => one === type);
}

/** Returns whether a media type is of Kindle books. */
export function isKindleType(type: string): boolean {
  return type === kindleType;
}

/**
 * Returns the media type of a book by its first bytes (latin-1), of text by its
 * name too; undefined if it cannot be served. What an archive holds is the
 * viewer's to find out.
 */
export function bookType(start: string, name: string): string | undefined {
  // Before a PDF, which may be the first file in it.
  const archive = archives.find(([, offset, mark]) => start.startsWith(mark, offset));
  if (archive) return archive[0];
  if (start.includes("%PDF-")) return "application/pdf";
  const image = imageType(start);
  if (image !== undefined) return image;
  if (start.startsWith(kindle, kindleAt)) return kindleType;
  if (isFictionBook(start)) return "application/x-fictionbook+xml";
  if (!isText(start, name)) return undefined;
  // Markdown may begin as a web page or JSON does.
  if (isMarkdownName(name)) return "text/markdown";
  return rejected.some(([isOne]) => isOne(wordsOf(start))) ? undefined : "text/plain";
}

/** Returns whether a file is a FictionBook, by its first bytes (latin-1), in UTF-16 too. */
function isFictionBook(start: string): boolean {
  const words = wordsOf(start.replace(/^(\xff\xfe|\xfe\xff)/, "").replaceAll("\0", ""));
  return fictionBook.every((mark) => mark.test(words));
}

/** Returns whether a file is JSON, by its first bytes (latin-1). */
export function isJson(start: string): boolean {
  return json.test(wordsOf(start));
}

/** Returns why a file is not served, by its first bytes (latin-1), as the end of a sentence. */
export function rejectionOf(start: string): string {
  const found = rejected.find(([isOne]) => isOne(wordsOf(start)));
  return found?.[1] ?? "is of an unknown format";
}

/** Control characters that are rare in text, and the bytes of it for each at least, as the viewer has them. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: these are looked for
const strangeControls = /[\x00-\x06\x10-\x19\x1c-\x1f\x7f]/g;
const leastText = 10;

/**
 * Returns whether bytes, as latin-1, are text: UTF-8, UTF-16 by its mark, or, where the name says text, in
 * any encoding; none with a byte of 0.
 */
function isText(start: string, name: string): boolean {
  if (/^(\xff\xfe|\xfe\xff)/.test(start)) return true;
  if (start.includes("\0")) return false;
  const strange = start.match(strangeControls)?.length ?? 0;
  if (strange * leastText > start.length && kindOfName(name) !== "text") return false;
  try {
    // The last character may be cut off.
    const stream = start.length >= sniffLength;
    new TextDecoder("utf-8", { fatal: true }).decode(Buffer.from(start, "latin1"), { stream });
    return true;
  } catch {
    return kindOfName(name) === "text";
  }
}

/** Returns the text without the mark of its byte order and without spaces before it. */
function wordsOf(start: string): string {
  return start.replace(/^\xef\xbb\xbf/, "").trimStart();
}

/** Returns markup after its XML declarations, comments and the spaces between them. */
function afterProlog(markup: string): string {
  let rest = markup;
  for (;;) {
    const end = rest.startsWith("<!--") ? "-->" : /^<\?xml/i.test(rest) ? ">" : null;
    const at = end === null ? -1 : rest.indexOf(end, 4);
    if (end === null || at < 0) return rest;
    rest = rest.slice(at + end.length).trimStart();
  }
}
