/** ComicInfo.xml: what comic readers write into an archive about its pages. */

import { cleanLanguage, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { readMarkup } from "../markup/read_markup.ts";

/** What ComicInfo.xml says of a page. */
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

/** Returns what a ComicInfo.xml says; nothing of another document. */
export async function readComicInfo(xml: string): Promise<ComicInfo> {
  // It has no declarations, and those of others could define entities of any size.
  if (/<!DOCTYPE/i.test(xml)) return noInfo;
  const root = (await readMarkup(xml, "application/xml")).document.documentElement;
  if (root.localName !== "ComicInfo") return noInfo;
  // Wherever it is: what stands after an element without an end is within that.
  const find = (name: string): Element | undefined => root.getElementsByTagNameNS("*", name)[0];
  const text = (name: string): string => {
    const nodes = [...(find(name)?.childNodes ?? [])].filter(({ nodeType }) => nodeType !== 1);
    return cleanText(nodes.map(({ nodeValue }) => nodeValue).join(""));
  };
  const number = text("Number") && `${text("Series") ? " " : ""}${text("Number")}`;
  const names = [`${text("Series")}${number}`, text("Title")];
  return {
    title: cleanText(names.filter((name) => name !== "").join(": ")),
    language: cleanLanguage(text("LanguageISO")),
    direction: text("Manga") === "YesAndRightToLeft" ? "rtl" : "ltr",
    pages: new Map([...(find("Pages")?.children ?? [])].slice(0, limits.pages).flatMap(pageOf)),
  };
}

function pageOf(element: Element): [number, ComicPage][] {
  const index = Number.parseInt(element.getAttribute("Image") ?? "", 10);
  if (!(index >= 0)) return [];
  return [
    [
      index,
      {
        double: element.hasAttribute("DoublePage")
          ? element.getAttribute("DoublePage")?.toLowerCase() === "true"
          : null,
        isCover: element.getAttribute("Type") === "FrontCover",
        deleted: element.getAttribute("Type") === "Deleted",
        bookmark: cleanText(element.getAttribute("Bookmark")),
      },
    ],
  ];
}
