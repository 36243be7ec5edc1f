/** CoMet: a file that says what a comic is, which side it is read from, and which image is its cover. */

import { cleanLanguage } from "../book_text.ts";
import { limits } from "../limits.ts";
import { type ComicMetadata, comicTitle, directionOf, noMetadata } from "./comic_metadata.ts";
import { metadataRoot, textIn, textsIn } from "./metadata_markup.ts";

/** Returns what a CoMet.xml says; nothing of another document. */
export async function readComet(xml: string): Promise<ComicMetadata> {
  const root = await metadataRoot(xml, "comet");
  if (root === null) return noMetadata;
  const text = (name: string): string => textIn(root, name);
  const [writers, artists] = [
    textsIn(root, "writer", limits.authors),
    textsIn(root, "penciller", limits.authors),
  ];
  return {
    ...noMetadata,
    title: comicTitle(text("series"), text("issue"), text("title")),
    authors: writers.length > 0 ? writers : artists,
    language: cleanLanguage(text("language")),
    direction: directionOf(text("readingDirection")),
    cover: text("coverImage"),
  };
}
