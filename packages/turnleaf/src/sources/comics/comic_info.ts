/** ComicInfo.xml: what comic readers write into an archive about its pages. */

import { cleanLanguage, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";

/** What ComicInfo.xml says of a page. */
export interface ComicPage {
  /** Whether it is both pages of a spread. */
  readonly double: boolean;
  /** Whether it is not to be shown. */
  readonly deleted: boolean;
  /** The title of a bookmark on it, or "". */
  readonly bookmark: string;
}

/** What ComicInfo.xml says of a comic. */
export interface ComicInfo {
  /** Its title; "" if unknown. */
  readonly title: string;
  /** BCP 47 tag; "" if unknown. */
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  /** By the number of the image, from 0, in the archive's natural order. */
  readonly pages: ReadonlyMap<number, ComicPage>;
}

/** Of a comic without ComicInfo.xml. */
export const noInfo: ComicInfo = { title: "", language: "", direction: "ltr", pages: new Map() };

/** Returns what a ComicInfo.xml says; of a damaged one, nothing. */
export function parseComicInfo(xml: string): ComicInfo {
  // It has no declarations, and those of others could define entities of any size.
  if (/<!DOCTYPE/i.test(xml)) return noInfo;
  const root = new DOMParser().parseFromString(xml, "application/xml").documentElement;
  if (root.localName !== "ComicInfo") return noInfo;
  const child = (name: string): Element | undefined =>
    [...root.children].find((element) => element.localName === name);
  const text = (name: string): string => cleanText(child(name)?.textContent);
  const number = text("Number") && `${text("Series") ? " " : ""}${text("Number")}`;
  const names = [`${text("Series")}${number}`, text("Title")];
  return {
    title: cleanText(names.filter((name) => name !== "").join(": ")),
    language: cleanLanguage(text("LanguageISO")),
    direction: text("Manga") === "YesAndRightToLeft" ? "rtl" : "ltr",
    pages: new Map([...(child("Pages")?.children ?? [])].slice(0, limits.pages).flatMap(pageOf)),
  };
}

function pageOf(element: Element): [number, ComicPage][] {
  const index = Number.parseInt(element.getAttribute("Image") ?? "", 10);
  if (!(index >= 0)) return [];
  return [
    [
      index,
      {
        double: element.getAttribute("DoublePage")?.toLowerCase() === "true",
        deleted: element.getAttribute("Type") === "Deleted",
        bookmark: cleanText(element.getAttribute("Bookmark")),
      },
    ],
  ];
}
