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
];

/**
 * Returns the media type of an image by its first bytes (latin-1); undefined
 * for any other file.
 */
export function imageType(start: string): string | undefined {
  return marks.find(([, offset, mark]) => start.startsWith(mark, offset))?.[0];
}

/**
 * Returns the media type of text in UTF-8 by its first bytes (latin-1);
 * undefined for other files and web pages.
 */
export function textType(start: string, name: string): string | undefined {
  // biome-ignore lint/suspicious/noControlCharactersInRegex: text has none of them
  if (/[\x00-\x08\x0e-\x1f\x7f]/.test(start) || /^\s*[<{[]/.test(start)) return undefined;
  try {
    // The last character may be cut off.
    const stream = start.length >= sniffLength;
    new TextDecoder("utf-8", { fatal: true }).decode(Buffer.from(start, "latin1"), { stream });
  } catch {
    return undefined;
  }
  return /\.(md|markdown)$/i.test(name) ? "text/markdown" : "text/plain";
}

const byEnding: ReadonlyMap<string, string> = new Map([
  [".png", "image/png"],
  [".jpg", "image/jpeg"],
  [".jpeg", "image/jpeg"],
  [".gif", "image/gif"],
  [".webp", "image/webp"],
  [".avif", "image/avif"],
]);

/**
 * Returns the media type of an image by the suffix of its name. SVG is not
 * included: it can hold scripts.
 */
export function imageTypeOfName(name: string): string | undefined {
  return byEnding.get(/\.[a-z]+$/i.exec(name)?.[0].toLowerCase() ?? "");
}
