/** What files beside a comic's pages say of it, in the formats of several programs. */

import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";

/** What is said of a page. */
export interface ComicPage {
  /** Whether it is both pages of a spread; null if nothing is said. */
  readonly double: boolean | null;
  /** Whether it is the front cover. */
  readonly isCover: boolean;
  /** Whether it is not to be shown. */
  readonly deleted: boolean;
  /** The title of a bookmark on it, or "". */
  readonly bookmark: string;
}

/** What is said of a comic. */
export interface ComicMetadata {
  /** Its title; "" if unknown. */
  readonly title: string;
  readonly authors: readonly string[];
  /** BCP 47 tag; "" if unknown. */
  readonly language: string;
  /** Null if nothing is said. */
  readonly direction: "ltr" | "rtl" | null;
  /** By the number of the image, from 0, in the archive's natural order. */
  readonly pages: ReadonlyMap<number, ComicPage>;
  /** The address of the front cover's image, from the file that says it; "" if unknown. */
  readonly cover: string;
  /** The addresses of the pages' images in order, from the file that says them; empty if unknown. */
  readonly order: readonly string[];
}

/** Of a comic of which nothing is said. */
export const noMetadata: ComicMetadata = {
  title: "",
  authors: [],
  language: "",
  direction: null,
  pages: new Map(),
  cover: "",
  order: [],
};

/** Returns whether something is said: more than `noMetadata` has. */
function isSaid(value: ComicMetadata[keyof ComicMetadata]): boolean {
  if (value === null) return false;
  return (typeof value === "object" && "size" in value ? value.size : value.length) > 0;
}

/** Returns what is said in one place or another: in the first that says it. */
export function joinedMetadata(all: readonly ComicMetadata[]): ComicMetadata {
  const said = all.map(
    (one): Partial<ComicMetadata> =>
      Object.fromEntries(Object.entries(one).filter(([, value]) => isSaid(value))),
  );
  return Object.assign({ ...noMetadata }, ...said.reverse());
}

/** Returns a comic's title, as "Hero 3: The End", by the parts of it that are said. */
export function comicTitle(series: string, number: string, title: string): string {
  const own = number && `${series ? " " : ""}${number}`;
  return cleanText([`${series}${own}`, title].filter((part) => part !== "").join(": "));
}

/** Returns the names in a list between commas. */
export function listedNames(text: string): string[] {
  const names = text.split(",").map((name) => name.trim());
  return names.filter((name) => name !== "").slice(0, limits.authors);
}

/** Returns a direction as files write it, "rtl" or "LTR". */
export function directionOf(text: string): "ltr" | "rtl" | null {
  const direction = text.toLowerCase();
  return direction === "ltr" || direction === "rtl" ? direction : null;
}
