/** ComicInfo.xml: what comic readers write into an archive about its pages. */

import { cleanLanguage, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import {
  type ComicMetadata,
  type ComicPage,
  comicTitle,
  listedNames,
  noMetadata,
} from "./comic_metadata.ts";
import { metadataRoot, textIn } from "./metadata_markup.ts";

/** Returns what a ComicInfo.xml says; nothing of another document. */
export async function readComicInfo(xml: string): Promise<ComicMetadata> {
  const root = await metadataRoot(xml, "ComicInfo");
  if (root === null) return noMetadata;
  const text = (name: string): string => textIn(root, name);
  const [list] = root.getElementsByTagNameNS("*", "Pages");
  return {
    ...noMetadata,
    title: comicTitle(text("Series"), text("Number"), text("Title")),
    authors: listedNames(text("Writer") || text("Penciller")),
    language: cleanLanguage(text("LanguageISO")),
    direction: text("Manga") === "YesAndRightToLeft" ? "rtl" : null,
    pages: new Map([...(list?.children ?? [])].slice(0, limits.pages).flatMap(pageOf)),
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
