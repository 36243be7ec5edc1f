/** What a file is by its name: for the command and for the pages that it serves. */

import { formatOfName } from "../../turnleaf/src/sources/formats.ts";

/** What a file in a folder is by its name. */
export type NamedKind = "book" | "image" | "text";

/** Returns what a file of a folder may be by its name's ending; null for what is no book. */
export function kindOfName(name: string): NamedKind | null {
  if (imageTypeOfName(name)) return "image";
  const family = formatOfName(name)?.family;
  if (family === "text") return "text";
  return family === "book" || family === "comic" ? "book" : null;
}

/**
 * Returns the media type of an image by the ending of its name. SVG is not
 * included: it can hold scripts.
 */
export function imageTypeOfName(name: string): string | undefined {
  const format = formatOfName(name);
  return format?.kind === "image" && format.type !== "image/svg+xml" ? format.type : undefined;
}
