/** The cover of an EPUB of flowing text: the first chapter, if it is a picture, or the picture that its package names. */

import { readMarkup } from "../markup/read_markup.ts";
import { lonePicture } from "../typeset/lone_picture.ts";
import type { Chapter } from "./chapter.ts";
import type { EpubFiles } from "./epub_files.ts";

const xlink = "http://www.w3.org/1999/xlink";

/** Characters of a chapter that may be a cover's page: some lines, and a drawing. */
const mostMarkup = 100_000;

/** A book's cover. */
export interface EpubCover {
  /** What its picture is read from. */
  readonly chapter: Chapter;
  /** Whether it is in place of the first chapter, and not before it. */
  readonly isFirst: boolean;
}

/**
 * Returns the cover of a book; null if it has none.
 *
 * @param title of the book
 * @param first the first chapter, if it can be read
 * @param named the picture that the package names as the cover, if the archive has it
 * @param size returns how long a file is, bytes
 */
export async function coverOf(
  title: string,
  first: Chapter | null,
  named: Chapter | null,
  files: EpubFiles,
  size: (path: string) => number,
): Promise<EpubCover | null> {
  if (first && /^image\//.test(first.mediaType)) return { chapter: first, isFirst: true };
  if (first && size(first.href) <= mostMarkup) {
    const { document } = await readMarkup(await files.text(first.href), "application/xhtml+xml");
    const body = document.querySelector("body");
    if (body && lonePicture(body)) return { chapter: first, isFirst: true };
    const pictures = [...(body?.querySelectorAll("img, image") ?? [])];
    const names = [document.querySelector("title")?.textContent, pictures[0]?.getAttribute("alt")];
    const isCaptioned = isName(body?.textContent ?? "", names, title);
    const [address = ""] = pictures.map(
      (picture) =>
        picture.getAttribute("src") ??
        picture.getAttributeNS(xlink, "href") ??
        picture.getAttribute("href") ??
        "",
    );
    const isNamed = named !== null && files.resolve(address, first.href) === named.href;
    if (isNamed && isCaptioned && pictures.length === 1) return { chapter: named, isFirst: true };
  }
  return named ? { chapter: named, isFirst: false } : null;
}

/**
 * Returns whether text beside a picture only names it, as "Cover" does, so that nothing is lost without it.
 * With the title of the book it is a title page.
 *
 * @param names of the picture, or of what it is alone in
 */
function isName(
  text: string,
  names: readonly (string | null | undefined)[],
  title: string,
): boolean {
  const said = words(text);
  if (said === "") return true;
  if (said.includes(words(title))) return false;
  return names.some((name) => words(name ?? "") === said);
}

/** Returns the words of a text with a space around each, whatever lies between them; "" if there are none. */
function words(text: string): string {
  const found = text.toLowerCase().match(/[\p{L}\p{N}]+/gu);
  return found ? ` ${found.join(" ")} ` : "";
}
