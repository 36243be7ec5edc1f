/**
 * The formats of files: how each is recognised, named and served. `open_file.ts` has the code that opens
 * each. It imports nothing of a browser, as the command reads it too.
 */

import { readTarHeader } from "./archive/tar_header.ts";
import { isEpub } from "./epub/epub_names.ts";
import { limits } from "./limits.ts";

/** What one part of the code opens. */
export type OpenedKind =
  | "pdf"
  | "epub"
  | "kindle"
  | "fb2"
  | "zip"
  | "rar"
  | "7z"
  | "tar"
  | "gzip"
  | "zstd"
  | "xz"
  | "image"
  | "json"
  | "text";

/** The kind of a file, as far as its first bytes show. */
export type Kind = OpenedKind | "html" | "palmdoc" | "bzip2" | "zeros" | "unread" | "unknown";

/** What is known of a file before it is read whole. */
export interface FileStart {
  /** Its first `sniffLength` bytes, fewer if it has fewer. */
  readonly start: Uint8Array;
  /** The media type that its server or its owner gives; "" if none. */
  readonly type: string;
  /** Its name, if it has one. */
  readonly name?: string;
}

/** The first bytes of a file, as the tests of formats read them. */
interface FirstBytes extends FileStart {
  /** The bytes as Latin-1. */
  readonly text: string;
  /** The same without a mark of byte order and spaces at the beginning; of UTF-16 the letters of ASCII. */
  readonly words: string;
}

/** A format of files. */
export interface FileFormat {
  readonly kind: Kind;
  /** Its media type. */
  readonly type: string;
  /** How sentences name it: one name for each kind of file, if several are alike. */
  readonly labels?: readonly string[];
  /** With which others lists of what can be read name it; undefined if they leave it out. */
  readonly family?: "book" | "comic" | "text" | "image" | "manifest";
  /** Endings of names that say it, in lower case, without the first dot. */
  readonly endings?: readonly string[];
  /** Endings of names of archives, which hold a book or something else. */
  readonly archiveEndings?: readonly string[];
  /** Returns whether a file is of it. */
  readonly is?: (file: FirstBytes) => boolean;
  /** Returns whether an archive is of it, by the names of the files in it. */
  readonly isIn?: (names: readonly string[]) => boolean;
  /** Maximum of bytes of a file; undefined for what is not opened. */
  readonly most?: number;
  /** If true, few browsers show such an image. */
  readonly isRare?: boolean;
  /** Why it is not opened, as the end of a sentence about a file. */
  readonly reason?: string;
  /** What to do about that; undefined if a list of what can be read says it. */
  readonly remedy?: string;
}

/** A PDF's mark, and the maximum of bytes that may precede it. */
const pdfMark = "%PDF-";
const mostBefore = 1024;

/** The mark of a file in a ZIP. */
const zipMark = "PK\x03\x04";

/** What a PDF without its mark begins with: comments, and an object; or the mark of the first PDFs. */
const firstObject =
  /^(?:(?:%[^\r\n]{0,99}[\r\n]{1,9}){0,9}\d{1,9} \d{1,5} obj\b|%!PS-Adobe-\d\.\d PDF-\d)/;

/** How many first bytes show the format. */
export const sniffLength: number = mostBefore + pdfMark.length;

/** Where a Palm database has its type: after its name, its dates and the like. */
const palmTypeAt = 60;

/** Returns a test for one of several marks at a place, in bytes. */
export const at =
  (offset: number, ...marks: readonly string[]) =>
  ({ text }: FirstBytes): boolean =>
    marks.some((mark) => text.startsWith(mark, offset));

/** Returns the row of an image, with what else it says. */
const image = (
  label: string,
  type: string,
  endings: readonly string[],
  is: FileFormat["is"],
  more: Partial<FileFormat> = {},
): FileFormat => {
  const most = limits.imageBytes;
  return { kind: "image", type, labels: [label], family: "image", endings, is, most, ...more };
};

/** Few browsers show it, and a decoder is here; or none is, so that lists leave it out. */
const decoded: Partial<FileFormat> = { isRare: true };
const undecoded: Partial<FileFormat> = { isRare: true, family: undefined };

/** The headers of bitmaps by their lengths: of OS/2, and of Windows with what was added to it. */
const bitmapHeader = at(
  14,
  ...["\x0c", "\x10", "\x28", "\x34", "\x38", "\x40", "\x6c", "\x7c"].map(
    (length) => `${length}\0\0\0`,
  ),
);

/** What web pages begin with, and what a text may begin with too. */
const webPage = /^<(!doctype html|html)\b/i;
const webPageOrXml = /^(<(!doctype html|html|!--|head|body)|<\?xml[^<]*<(!doctype )?html)/i;

/** What files begin with that name others: shortcuts to the web, lists of torrents, lists of what to play. */
export const pointer: RegExp =
  /^(?:\[(?:InternetShortcut|Desktop Entry)\]|d\d{1,2}:(?:announce|comment|created by|creation date|encoding|info|nodes|url-list)|#EXTM3U|magnet:\?|bplist00|<\?xml[^<]{0,99}<!DOCTYPE plist)/i;

const isFictionBookName = (name: string): boolean => /\.fb2$/i.test(name);

/**
 * All formats. A file is of the first whose test it passes, so that a certain mark comes before what is
 * searched for, then text, and last what a name may say.
 */
export const formats: readonly FileFormat[] = [
  image("PNG", "image/png", ["png"], at(0, "\x89PNG\r\n\x1a\n")),
  image("JPEG", "image/jpeg", ["jpg", "jpeg", "jpe", "jfif"], at(0, "\xff\xd8\xff")),
  image("WebP", "image/webp", ["webp"], at(8, "WEBP")),
  image("AVIF", "image/avif", ["avif"], hasBrand(/^avi[fs]$/)),
  image("GIF", "image/gif", ["gif"], at(0, "GIF87a", "GIF89a")),
  // Its mark is short, so that the length of its header is tested too: programs write what they like between.
  image("BMP", "image/bmp", ["bmp"], (file) => at(0, "BM")(file) && bitmapHeader(file)),
  image("SVG", "image/svg+xml", ["svg"], isSvg),
  // BigTIFF too.
  image("TIFF", "image/tiff", ["tif", "tiff"], at(0, "II*\0", "MM\0*", "II+\0", "MM\0+"), decoded),
  image(
    "JPEG 2000",
    "image/jp2",
    ["jp2", "jpx", "j2k", "j2c", "jpf"],
    (file) => at(4, "jP  \r\n\x87\n")(file) || at(0, "\xff\x4f\xff\x51")(file),
    decoded,
  ),
  image("HEIC", "image/heic", ["heic", "heif"], hasBrand(/^(hei|hev|mif1|msf1)/), undecoded),
  image(
    "JPEG XL",
    "image/jxl",
    ["jxl"],
    (file) => at(0, "\xff\x0a")(file) || at(4, "JXL \r\n\x87\n")(file),
    undecoded,
  ),
  {
    kind: "tar",
    type: "application/x-tar",
    labels: ["CBT"],
    family: "comic",
    endings: ["cbt"],
    archiveEndings: ["tar"],
    is: ({ start }) => readTarHeader(start) !== null,
    most: limits.archiveBytes,
  },
  {
    kind: "rar",
    type: "application/vnd.rar",
    labels: ["CBR"],
    family: "comic",
    endings: ["cbr"],
    archiveEndings: ["rar"],
    is: at(0, "Rar!\x1a\x07"),
    most: limits.archiveBytes,
  },
  {
    kind: "7z",
    type: "application/x-7z-compressed",
    labels: ["CB7"],
    family: "comic",
    endings: ["cb7"],
    archiveEndings: ["7z"],
    is: at(0, "7z\xbc\xaf\x27\x1c"),
    most: limits.archiveBytes,
  },
  { kind: "gzip", type: "application/gzip", is: at(0, "\x1f\x8b\x08"), most: limits.archiveBytes },
  {
    kind: "zstd",
    type: "application/zstd",
    is: at(0, "\x28\xb5\x2f\xfd"),
    most: limits.archiveBytes,
  },
  {
    kind: "xz",
    type: "application/x-xz",
    is: at(0, "\xfd7zXZ\0"),
    most: limits.archiveBytes,
  },
  {
    kind: "bzip2",
    type: "application/x-bzip2",
    // A digit between says how much was packed at a time.
    is: ({ text }) => /^BZh[1-9]1AY&SY/.test(text),
    reason: "is packed by bzip2, which is not unpacked here",
  },
  {
    kind: "pdf",
    type: "application/pdf",
    labels: ["PDF"],
    family: "book",
    endings: ["pdf"],
    is: isPdf,
    most: limits.pdfBytes,
  },
  {
    kind: "epub",
    type: "application/epub+zip",
    labels: ["EPUB"],
    family: "book",
    endings: ["epub"],
    isIn: isEpub,
    most: limits.archiveBytes,
  },
  {
    kind: "kindle",
    type: "application/x-mobipocket-ebook",
    labels: ["MOBI", "AZW3"],
    family: "book",
    endings: ["mobi", "prc", "azw", "azw3"],
    is: at(palmTypeAt, "BOOKMOBI"),
    most: limits.archiveBytes,
  },
  {
    kind: "palmdoc",
    type: "application/vnd.palm",
    is: at(palmTypeAt, "TEXtREAd"),
    reason: "is a text of a Palm (PalmDOC), which is not read",
  },
  {
    kind: "fb2",
    type: "application/x-fictionbook+xml",
    labels: ["FB2"],
    family: "book",
    endings: ["fb2", "fb2.zip", "fbz"],
    is: isFictionBook,
    isIn: (names) => names.filter(isFictionBookName).length === 1,
    most: limits.archivedBytes,
  },
  {
    kind: "zip",
    type: "application/zip",
    labels: ["CBZ"],
    family: "comic",
    endings: ["cbz"],
    archiveEndings: ["zip"],
    // Something may stand before it, such as the headers of a mail. One of no files has an end alone.
    is: ({ text }) => text.includes(zipMark) || text.startsWith("PK\x05\x06"),
    most: limits.archiveBytes,
  },
  {
    kind: "text",
    type: "text/markdown",
    labels: ["Markdown"],
    family: "text",
    endings: ["md", "markdown"],
    // It may begin as a web page or JSON does.
    is: (file) => isNamedMarkdown(file) && isText(file),
    most: limits.markupBytes,
  },
  {
    kind: "json",
    type: "application/json",
    labels: ["IIIF and JSON manifests"],
    family: "manifest",
    // A manifest that is an array has strings or objects: [text] is a link of Markdown, {\rtf a document.
    is: (file) => {
      const isBegun = /^(\{(?!\\)|\[\s*["{\]])/.test(file.words);
      return file.type === "application/json"
        ? isBegun || isText(file)
        : isBegun && !isNamedText(file);
    },
    most: limits.manifestBytes,
  },
  {
    kind: "html",
    type: "text/html",
    is: (file) => (isNamedText(file) ? webPage : webPageOrXml).test(file.words),
    reason: "is a web page, not a book",
  },
  {
    kind: "unread",
    type: "application/octet-stream",
    // What would pass for text: RTF, PostScript, XML of any kind, shortcuts. What each is `unread_formats.ts` says.
    is: (file) =>
      /^\{\\rtf/i.test(file.words) ||
      (pointer.test(file.words) && !isNamedText(file)) ||
      (/^<(\?xml|!doctype|[\w:-]+ xmlns\b)/i.test(file.words) && !isNamedText(file)) ||
      at(0, "%!PS", "\x04%!PS")(file),
    reason: "is a document of a kind that is not read",
  },
  {
    kind: "text",
    type: "text/plain",
    labels: ["text"],
    family: "text",
    endings: ["txt"],
    is: isText,
    most: limits.markupBytes,
  },
  {
    kind: "zeros",
    type: "application/octet-stream",
    is: ({ text }) => /^\0{512,}$/.test(text),
    reason: "has no pages but only zeros, as an empty tar or a file that was not fetched whole",
  },
  // Something stands before it, of any length, as the program that unpacks it.
  { kind: "zip", type: "application/zip", is: isNamedZip, most: limits.archiveBytes },
];

/**
 * Returns the format of a file by its first bytes; null if it is none of these. Its media type and its
 * name count only where bytes do not tell. What an archive holds is not looked at.
 *
 * @param among the formats that it may be of
 */
export function formatOfFile(
  file: FileStart,
  among: readonly FileFormat[] = formats,
): FileFormat | null {
  const start = file.start.subarray(0, sniffLength);
  const text = latin1(start);
  const first = { ...file, start, text, words: wordsOf(narrowed(text)) };
  return among.find(({ is }) => is?.(first)) ?? null;
}

/** Returns the kind of a file, as `formatOfFile` finds it. */
export function sniff(file: FileStart): Kind {
  return formatOfFile(file)?.kind ?? "unknown";
}

const byEnding = mapOf(({ endings }) => endings);
const byArchiveEnding = mapOf(({ archiveEndings }) => archiveEndings);

function mapOf(
  endingsOf: (format: FileFormat) => readonly string[] | undefined,
): ReadonlyMap<string, FileFormat> {
  return new Map(
    formats.flatMap((format) => (endingsOf(format) ?? []).map((ending) => [ending, format])),
  );
}

/** Returns the format that the ending of a name says; null if it says none, or an archive of any files. */
export function formatOfName(name: string): FileFormat | null {
  const parts = name.toLowerCase().split(".").slice(1).slice(-2);
  // The longest ending first: "a.fb2.zip" is a FictionBook.
  return byEnding.get(parts.join(".")) ?? byEnding.get(parts.at(-1) ?? "") ?? null;
}

/** Returns the format of archives that the ending of a name says; null if it says none. */
export function archiveOfName(name: string): FileFormat | null {
  return byArchiveEnding.get(/\.([^.]*)$/.exec(name)?.[1]?.toLowerCase() ?? "") ?? null;
}

/** Returns the format of an archive by the names of the files in it; null if it is one of images. */
export function formatOfArchive(names: readonly string[]): FileFormat | null {
  return formats.find(({ isIn }) => isIn?.(names)) ?? null;
}

/** The families in the order of lists, each with the word before its labels. */
const families: readonly (readonly [family: FileFormat["family"], word: string])[] = [
  ["book", ""],
  ["comic", "comics"],
  ["text", ""],
  ["image", "images"],
  ["manifest", ""],
];

/** Returns the names of formats for a sentence, such as "PDF, comics (CBZ, CBR), images (PNG, JPEG)". */
export function listFormats(listed: readonly FileFormat[] = formats): string {
  const parts = families.flatMap(([family, word]) => {
    const labels = labelsOf(listed, family);
    if (labels.length === 0) return [];
    return word === "" ? labels : [`${word} (${labels.join(", ")})`];
  });
  return parts.join(", ");
}

/** Returns the names of the images that can be shown, for a sentence. */
export function listImages(): string {
  const labels = labelsOf(formats, "image");
  return `${labels.slice(0, -1).join(", ")} and ${labels.at(-1)}`;
}

const labelsOf = (listed: readonly FileFormat[], family: FileFormat["family"]): string[] =>
  listed.flatMap((format) => (format.family === family ? (format.labels ?? []) : []));

/** The formats of images. */
const images: readonly FileFormat[] = formats.filter(({ kind }) => kind === "image");

/** Returns whether a media type is of images that browsers show. */
export function isShownType(type: string): boolean {
  return images.some((format) => format.type === type && !format.isRare);
}

/** Returns how a sentence names the format of an image that few browsers show; undefined for others. */
export function unshownFormat(type: string): string | undefined {
  const [label] = images.find((format) => format.isRare && format.type === type)?.labels ?? [];
  return label && `a ${label}`;
}

/** Returns the media type of an image that few browsers show by its first bytes; null if it is none. */
export function rareImageType(start: Uint8Array): string | null {
  const format = imageFormat(start);
  return format?.isRare ? format.type : null;
}

/** Returns the media type of an image that browsers show by its first bytes; null if they are not such an image's. */
export function imageType(start: Uint8Array): string | null {
  const format = imageFormat(start);
  return format && !format.isRare ? format.type : null;
}

function imageFormat(start: Uint8Array): FileFormat | null {
  return formatOfFile({ start, type: "" }, images);
}

/**
 * Returns whether a file is a PDF. Anything may precede its mark but a ZIP, which may hold a PDF, and the words
 * of a text, which may tell of PDFs. Readers of PDFs read those without a mark too.
 */
function isPdf(file: FirstBytes): boolean {
  const { text, words } = file;
  if (isNamedText(file)) return words.startsWith(pdfMark);
  const place = text.indexOf(pdfMark);
  if (place < 0) return firstObject.test(words);
  const before = text.slice(0, place);
  const isNamedIn = /[^\r\n]$/.test(before) && isSaidText(file) && isText(file);
  return !before.includes(zipMark) && !isNamedIn;
}

/** Returns the brands of a file of ISO's media, as AVIF, HEIC and MP4 are: which readers can read it. */
export function brandsOf({ start, text }: FirstBytes): readonly string[] {
  if (!text.startsWith("ftyp", 4)) return [];
  const [, , high = 0, low = 0] = start;
  const box = text.slice(8, Math.max(256 * high + low, 12));
  // Behind the first is its version.
  return [box.slice(0, 4), ...(box.slice(8).match(/.{4}/gs) ?? [])];
}

/** Returns a test for one of several brands. */
function hasBrand(pattern: RegExp): (file: FirstBytes) => boolean {
  return (file) => brandsOf(file).some((brand) => pattern.test(brand));
}

/** Returns whether a file is a drawing, in UTF-16 too. Markdown may begin with one. */
function isSvg(file: FirstBytes): boolean {
  const { words } = file;
  return (
    !isNamedMarkdown(file) &&
    /^<(\?xml|!--|!doctype svg|([\w-]+:)?svg[\s>])/i.test(words) &&
    /<([\w-]+:)?svg[\s>]/i.test(words) &&
    !/<html[\s>]/i.test(words)
  );
}

/** Returns whether a file's name says that it is text. */
function isNamedText({ name = "" }: FirstBytes): boolean {
  return formatOfName(name)?.family === "text";
}

/** Returns whether a file's media type or its name says that it is Markdown. */
function isNamedMarkdown({ type, name = "" }: FirstBytes): boolean {
  const isNamed = formatOfName(name)?.type === "text/markdown";
  // What a server sends for a file that is not there is a web page.
  return type === "text/markdown" || (isNamed && type !== "text/html");
}

/** Returns whether a name says that a file is a ZIP: a format that is in archives alone, as EPUB is, is in one. */
function isNamedZip({ name = "" }: FirstBytes): boolean {
  const named = archiveOfName(name) ?? formatOfName(name);
  return named?.kind === "zip" || (named !== null && named.is === undefined);
}

/** What a FictionBook begins with, and its root. */
const fictionBook = [
  /^<(\?xml|!--|!doctype fictionbook|([\w.-]{1,40}:)?fictionbook)/i,
  /<([\w.-]{1,40}:)?fictionbook[\s>]/i,
];

/** Returns whether a file is a FictionBook, in UTF-16 too. */
function isFictionBook({ words }: FirstBytes): boolean {
  return fictionBook.every((mark) => mark.test(words));
}

/** Returns whether a media type or a name says that a file is text. */
function isSaidText(file: FirstBytes): boolean {
  // Many servers, and systems that do not know an ending, give files no type, or a general one.
  return /^text\/|^application\/json$/.test(file.type) || isNamedText(file);
}

/** Control characters that neither terminals and printers know nor DOS writes at the end of a file. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: these are looked for
const strangeControls = /[\x00-\x06\x10-\x19\x1c-\x1f\x7f]/g;

/** What text in UTF-16 or UTF-32 without its mark begins with. */
const wideLetters = /^(?:[\t-~]\0{1,3}){2}|^(?:\0{1,3}[\t-~]){2}/;

/** Bytes of text, at least, for each of these, unless a file says that it is text: code has one in fewer. */
const leastText = 10;

/**
 * Returns whether bytes are text: UTF-8, UTF-16 or UTF-32 by its mark, or, where the
 * media type or the name says text, in any encoding. Old programs wrote control characters into text, such as the
 * end of a DOS file or what terminals print bold; others are rare in it, and a byte of 0 is in none that does not
 * say that it is text.
 */
function isText(file: FirstBytes): boolean {
  const { start, text } = file;
  if (start.length === 0) return false;
  const isSaid = isSaidText(file);
  if (/^(\xff\xfe|\xfe\xff|\0\0\xfe\xff)/.test(text)) return true;
  // Letters of ASCII of two or four bytes each.
  const isWide = isSaid && wideLetters.test(text);
  const strange = text.match(strangeControls)?.length ?? 0;
  const isStrange = strange * leastText > start.length;
  // A byte of 0 is in text where something went wrong as it was written.
  if (start.includes(0)) return isWide || (isSaid && !isStrange);
  if (isStrange && !isSaid) return false;
  try {
    // The last character may be cut off.
    const stream = start.length >= sniffLength;
    new TextDecoder("utf-8", { fatal: true }).decode(start, { stream });
    return true;
  } catch {
    return isSaid;
  }
}

/** Returns text, each byte a character; of UTF-16 the letters of ASCII in it. */
function narrowed(text: string): string {
  if (!/^(\xff\xfe|\xfe\xff)/.test(text) && !wideLetters.test(text)) return text;
  return text.replace(/^(\xff\xfe|\xfe\xff)/, "").replaceAll("\0", "");
}

function wordsOf(text: string): string {
  return text.replace(/^\xef\xbb\xbf/, "").trimStart();
}

function latin1(bytes: Uint8Array): string {
  return String.fromCharCode(...bytes);
}
