/** The kind of a file, as far as its first bytes show. */
export type Kind = "pdf" | "json" | "image" | "html" | "archive" | "unknown";

/** A PDF's mark, and the maximum of bytes that may precede it. */
const pdfMark = "%PDF-";
const mostBefore = 1024;

/** How many first bytes `sniff` examines. */
export const sniffLength: number = mostBefore + pdfMark.length;

const images: readonly (readonly [type: string, offset: number, mark: string])[] = [
  ["image/png", 0, "\x89PNG\r\n\x1a\n"],
  ["image/jpeg", 0, "\xff\xd8\xff"],
  ["image/gif", 0, "GIF87a"],
  ["image/gif", 0, "GIF89a"],
  ["image/webp", 8, "WEBP"],
  ["image/avif", 4, "ftypavif"],
  ["image/avif", 4, "ftypavis"],
];

const archives = ["PK\x03\x04", "Rar!", "7z\xbc\xaf"];

/**
 * Returns the format by the first bytes, whatever the file's name and the
 * server say. A PDF may have up to 1024 bytes of other data before its mark.
 *
 * @param start the first `sniffLength` bytes, fewer if the file has fewer
 */
export function sniff(start: Uint8Array): Kind {
  const text = latin1(start.subarray(0, sniffLength));
  if (imageType(start) !== null) return "image";
  if (text.includes(pdfMark)) return "pdf";
  if (archives.some((mark) => text.startsWith(mark))) return "archive";
  const words = wordsOf(text);
  if (words.startsWith("{") || words.startsWith("[")) return "json";
  if (/^<(!doctype html|html|\?xml|!--|head|body)/i.test(words)) return "html";
  return "unknown";
}

/** Returns the MIME type of an image by its first bytes; null if they are not an image's. */
export function imageType(start: Uint8Array): string | null {
  const text = latin1(start.subarray(0, sniffLength));
  const found = images.find(([, offset, mark]) => text.startsWith(mark, offset));
  if (found) return found[0];
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
