/** ACBF: a document beside a comic's images that says what it is, and which images are its pages, in order. */

import { cleanLanguage, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { type ComicMetadata, comicTitle, directionOf, noMetadata } from "./comic_metadata.ts";
import { metadataRoot, textIn } from "./metadata_markup.ts";

/** Returns what an ACBF says; nothing of another document. */
export async function readAcbf(xml: string): Promise<ComicMetadata> {
  const root = await metadataRoot(xml, "ACBF");
  if (root === null) return noMetadata;
  const find = (within: Element | undefined, name: string): Element | undefined =>
    within?.getElementsByTagNameNS("*", name)[0];
  const info = find(root, "book-info");
  const [title, series] = [find(info, "book-title"), find(info, "sequence")];
  const authors = [...(info?.getElementsByTagNameNS("*", "author") ?? [])].slice(0, limits.authors);
  const pages = [...(find(root, "body")?.getElementsByTagNameNS("*", "page") ?? [])];
  const imageOf = (element: Element | undefined): string =>
    find(element, "image")?.getAttribute("href") ?? "";
  return {
    ...noMetadata,
    title: comicTitle(
      series?.getAttribute("title") ?? "",
      cleanText(series?.textContent),
      cleanText(title?.textContent),
    ),
    authors: authors.map(nameOf).filter((name) => name !== ""),
    language: cleanLanguage(
      find(info, "text-layer")?.getAttribute("lang") ?? title?.getAttribute("lang"),
    ),
    direction: directionOf(textIn(info, "reading-direction")),
    cover: imageOf(find(info, "coverpage")),
    order: pages.slice(0, limits.pages).map(imageOf),
  };
}

function nameOf(author: Element): string {
  const parts = ["first-name", "middle-name", "last-name"].map((name) => textIn(author, name));
  return cleanText(parts.join(" ")) || textIn(author, "nickname");
}
