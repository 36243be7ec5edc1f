/** What a file is by its name: for the command and for the pages that it serves. */

/** Returns whether a name is of Markdown. */
export function isMarkdownName(name: string): boolean {
  return /\.(md|markdown)$/i.test(name);
}

/** What a file in a folder is by its name. */
export type NamedKind = "book" | "image" | "text";

const images: ReadonlyMap<string, string> = new Map([
  [".png", "image/png"],
  [".jpg", "image/jpeg"],
  [".jpeg", "image/jpeg"],
  [".gif", "image/gif"],
  [".webp", "image/webp"],
  [".avif", "image/avif"],
  [".tif", "image/tiff"],
  [".tiff", "image/tiff"],
  [".jp2", "image/jp2"],
  [".jxl", "image/jxl"],
  [".heic", "image/heic"],
]);

/** Returns what a file of a folder may be by its name's suffix; null for what is no book. */
export function kindOfName(name: string): NamedKind | null {
  if (/\.(pdf|epub|mobi|azw3?|fb2|fb2\.zip|cb[zr7t])$/i.test(name)) return "book";
  if (imageTypeOfName(name)) return "image";
  return isMarkdownName(name) || /\.txt$/i.test(name) ? "text" : null;
}

/**
 * Returns the media type of an image by the suffix of its name. SVG is not
 * included: it can hold scripts.
 */
export function imageTypeOfName(name: string): string | undefined {
  return images.get(/\.[a-z]+$/i.exec(name)?.[0].toLowerCase() ?? "");
}

/** Returns whether a name is of an archive, which may hold a comic. */
export function isArchiveName(name: string): boolean {
  return /\.(zip|rar|7z|tar)$/i.test(name);
}
