import { readTarHeader } from "./archive/tar_header.ts";

/** The kind of a file, as far as its first bytes show. */
export type Kind =
  | "pdf"
  | "json"
  | "image"
  | "html"
  | "zip"
  | "rar"
  | "7z"
  | "tar"
  | "gzip"
  | "zstd"
  | "xz"
  | "bzip2"
  | "zeros"
  | "kindle"
  | "palmdoc"
  | "fb2"
  | "text"
  | "unknown";

/** What is known of a file before it is read whole. */
export interface FileStart {
  /** Its first `sniffLength` bytes, fewer if it has fewer. */
  readonly start: Uint8Array;
  /** The media type that its server or its owner gives; "" if none. */
  readonly type: string;
}

/** A PDF's mark, and the maximum of bytes that may precede it. */
const pdfMark = "%PDF-";
const mostBefore = 1024;

/** How many first bytes `sniff` examines. */
export const sniffLength: number = mostBefore + pdfMark.length;

/** Images that browsers show. */
const images: readonly (readonly [type: string, offset: number, mark: string])[] = [
  ["image/png", 0, "\x89PNG\r\n\x1a\n"],
  ["image/jpeg", 0, "\xff\xd8\xff"],
  ["image/gif", 0, "GIF87a"],
  ["image/gif", 0, "GIF89a"],
  ["image/webp", 8, "WEBP"],
  ["image/avif", 4, "ftypavif"],
  ["image/avif", 4, "ftypavis"],
];

/** Those that few browsers show, and whose sizes are not known before they do. */
const rareImages: typeof images = [
  ["image/heic", 4, "ftyphei"],
  ["image/heic", 4, "ftypmif1"],
  ["image/tiff", 0, "II*\0"],
  ["image/tiff", 0, "MM\0*"],
  // BigTIFF.
  ["image/tiff", 0, "II+\0"],
  ["image/tiff", 0, "MM\0+"],
  ["image/jxl", 0, "\xff\x0a"],
  ["image/jxl", 4, "JXL \r\n\x87\n"],
  ["image/jp2", 4, "jP  \r\n\x87\n"],
  ["image/jp2", 0, "\xff\x4f\xff\x51"],
];

/** Formats of images that few browsers show, as sentences name them. */
const unshown: Readonly<Record<string, string>> = {
  "image/heic": "a HEIC",
  "image/tiff": "a TIFF",
  "image/jxl": "a JPEG XL",
  "image/jp2": "a JPEG 2000",
};

/** Returns how a sentence names the format of an image that few browsers show; undefined for others. */
export function unshownFormat(type: string): string | undefined {
  return unshown[type];
}

/** A BMP: its mark is short, so that the four bytes which it leaves empty are asked too. */
const isBmp = (text: string): boolean => text.startsWith("BM") && text.startsWith("\0\0\0\0", 6);

/** Archives, and files that are packed each by itself. A ZIP of no files has an end alone. */
const packed: readonly (readonly [kind: Kind, mark: string])[] = [
  ["zip", "PK\x03\x04"],
  ["zip", "PK\x05\x06"],
  ["rar", "Rar!\x1a\x07"],
  ["7z", "7z\xbc\xaf\x27\x1c"],
  ["gzip", "\x1f\x8b\x08"],
  ["zstd", "\x28\xb5\x2f\xfd"],
  ["xz", "\xfd7zXZ\0"],
  // A digit between says how much was packed at a time.
  ...Array.from({ length: 9 }, (_, k) => ["bzip2", `BZh${k + 1}1AY&SY`] as const),
];

/** Types of Palm databases, after the name, the dates and the like. */
const palmTypeAt = 60;
const kindle = "BOOKMOBI";
const palmDoc = "TEXtREAd";

/** What a FictionBook begins with, and its root. */
const fictionBook = [/^<(\?xml|!--|!doctype fictionbook|fictionbook)/i, /<fictionbook[\s>]/i];

/**
 * Returns the format by the first bytes, whatever the file's name. The media
 * type counts only where bytes do not tell. A PDF may have up to 1024 bytes of
 * other data before its mark.
 */
export function sniff({ start, type }: FileStart): Kind {
  const text = latin1(start.subarray(0, sniffLength));
  if (imageType(start) ?? rareImageType(start)) return "image";
  // Before what may be within its first file.
  if (readTarHeader(start)) return "tar";
  if (text.includes(pdfMark)) return "pdf";
  const archive = packed.find(([, mark]) => text.startsWith(mark));
  if (archive) return archive[0];
  if (text.startsWith(kindle, palmTypeAt)) return "kindle";
  if (text.startsWith(palmDoc, palmTypeAt)) return "palmdoc";
  const words = wordsOf(text);
  if (isFictionBook(text)) return "fb2";
  // Markdown may begin as the others do.
  if (type !== "text/markdown") {
    // A manifest that is an array has strings or objects: [text] is a link of Markdown.
    if (/^(\{|\[\s*["{\]])/.test(words)) return "json";
    if (/^<(!doctype html|html|\?xml|!--|head|body)/i.test(words)) return "html";
  }
  if (isText(start, type)) return "text";
  return /^\0{512,}$/.test(text) ? "zeros" : "unknown";
}

/** Returns whether the first bytes of a file, as latin-1, are those of a FictionBook, in UTF-16 too. */
function isFictionBook(text: string): boolean {
  const words = wordsOf(text.replace(/^(\xff\xfe|\xfe\xff)/, "").replaceAll("\0", ""));
  return fictionBook.every((mark) => mark.test(words));
}

/** Control characters that neither terminals and printers know nor DOS writes at the end of a file. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: these are looked for
const strangeControls = /[\x00-\x06\x10-\x19\x1c-\x1f\x7f]/g;

/** Bytes of text, at least, for each of these, unless the media type says text: code has one in fewer. */
const leastText = 10;

/**
 * Returns whether bytes are text: UTF-8, UTF-16 by its mark, or, where the
 * media type says text, in any encoding. Old programs wrote control characters into text, such as the
 * end of a DOS file or what terminals print bold; a byte of 0 none did, and others are rare in it.
 */
function isText(start: Uint8Array, type: string): boolean {
  if (start.length === 0) return false;
  const text = latin1(start);
  if (/^(\xff\xfe|\xfe\xff)/.test(text)) return true;
  if (start.includes(0)) return false;
  const strange = text.match(strangeControls)?.length ?? 0;
  if (strange * leastText > start.length && !type.startsWith("text/")) return false;
  try {
    // The last character may be cut off.
    const stream = start.length >= sniffLength;
    new TextDecoder("utf-8", { fatal: true }).decode(start, { stream });
    return true;
  } catch {
    return type.startsWith("text/");
  }
}

/** Returns the MIME type of an image that few browsers show by its first bytes; null if it is none. */
export function rareImageType(start: Uint8Array): string | null {
  const text = latin1(start.subarray(0, sniffLength));
  return rareImages.find(([, offset, mark]) => text.startsWith(mark, offset))?.[0] ?? null;
}

/** Returns the MIME type of an image that browsers show by its first bytes; null if they are not such an image's. */
export function imageType(start: Uint8Array): string | null {
  const text = latin1(start.subarray(0, sniffLength));
  const found = images.find(([, offset, mark]) => text.startsWith(mark, offset));
  if (found) return found[0];
  if (isBmp(text)) return "image/bmp";
  const words = wordsOf(text);
  const isSvg =
    /^<(\?xml|!--|!doctype svg|([\w-]+:)?svg[\s>])/i.test(words) &&
    /<([\w-]+:)?svg[\s>]/i.test(words) &&
    !/<html[\s>]/i.test(words);
  return isSvg ? "image/svg+xml" : null;
}

function wordsOf(text: string): string {
  return text.replace(/^\xef\xbb\xbf/, "").trimStart();
}

function latin1(bytes: Uint8Array): string {
  return String.fromCharCode(...bytes);
}
