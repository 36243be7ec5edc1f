/** What a file is, as far as its first bytes tell. */
export type Kind = "pdf" | "json" | "image" | "html" | "archive" | "unknown";

/** How many first bytes `sniff` looks at. */
export const sniffLength = 1024;

const formats: readonly (readonly [Kind, number, string])[] = [
  ["image", 0, "\x89PNG\r\n\x1a\n"],
  ["image", 0, "\xff\xd8\xff"],
  ["image", 0, "GIF87a"],
  ["image", 0, "GIF89a"],
  ["image", 8, "WEBP"],
  ["image", 4, "ftypavif"],
  ["image", 4, "ftypavis"],
  ["archive", 0, "PK\x03\x04"],
  ["archive", 0, "Rar!"],
  ["archive", 0, "7z\xbc\xaf"],
];

/**
 * The format by its first bytes, whatever its name and the server say. A PDF
 * may have up to 1024 bytes of other matter before its mark.
 * @param start the first `sniffLength` bytes, fewer where the file has fewer
 */
export function sniff(start: Uint8Array): Kind {
  const text = latin1(start.subarray(0, sniffLength));
  for (const [kind, offset, mark] of formats) {
    if (text.startsWith(mark, offset)) return kind;
  }
  if (text.includes("%PDF-")) return "pdf";
  const words = text.replace(/^\xef\xbb\xbf/, "").trimStart();
  if (words.startsWith("{") || words.startsWith("[")) return "json";
  if (/^<(!doctype html|html|\?xml|!--|head|body)/i.test(words)) return "html";
  return "unknown";
}

function latin1(bytes: Uint8Array): string {
  return String.fromCharCode(...bytes);
}
