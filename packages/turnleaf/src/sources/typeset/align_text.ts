/**
 * Sets paragraphs in lines of one length, or not, as the reader chooses, and where neither the reader nor the
 * book does, as it is read best: titles and verses stay as they are.
 */

import type { Typography } from "../page_source.ts";
import { canDivide, languageOf } from "./hyphenation/divide_words.ts";

/** Elements of running text. Pages call many of their paragraphs otherwise. */
const paragraphs = "p, li, dd, blockquote, div, section, article, body";

/** Alignments that are no choice of the book's for a single paragraph. */
const usual = new Set(["start", "left", "right", "justify"]);

/**
 * Changes how the paragraphs of a section are aligned.
 *
 * @param body the section's body, with its style sheets
 * @param align "" for the book's own
 */
export function alignText(body: Element, align: Typography["align"]): void {
  if (align === "") return;
  const view = body.ownerDocument.defaultView as Window;
  const all = [body, ...body.querySelectorAll<HTMLElement>(paragraphs)] as HTMLElement[];
  // All are read before any is changed: what one inherits is not its own.
  const changed = all.filter((element) => {
    const { textAlign, whiteSpace, direction } = view.getComputedStyle(element);
    const isOpposite = textAlign === (direction === "rtl" ? "left" : "right");
    return usual.has(textAlign) && !isOpposite && !whiteSpace.startsWith("pre");
  });
  for (const element of changed) element.style.setProperty("text-align", align, "important");
  // A title in running text has its own, which is the one that it inherited.
  if (align !== "justify") return;
  for (const title of body.querySelectorAll<HTMLElement>("h1, h2, h3, h4, h5, h6, th, td, pre")) {
    if (view.getComputedStyle(title).textAlign === "justify") {
      title.style.setProperty("text-align", "start", "important");
    }
  }
}

/** Paragraphs that are set in lines of one length if nobody says how, and what is set otherwise. */
const prose = "p, li, dd, blockquote";
const noProse = "h1, h2, h3, h4, h5, h6, th, td, pre, figcaption, nav, header";

/**
 * Sets the paragraphs of a section as nobody says: in lines of one length with their words divided, where
 * the browser divides words of their language. Elsewhere their lines end where words do: of one length they
 * would have gaps. Lines that the book or the reader sets of one length have their words divided likewise.
 *
 * @param body the section's body, with its style sheets, aligned as the reader chooses
 * @param divides returns whether the browser divides the words of an element
 */
export function alignUnsaid(
  body: Element,
  { align, hyphens }: Pick<Typography, "align" | "hyphens">,
  divides: (element: Element) => boolean = (element) => canDivide(body, languageOf(element)),
): void {
  if (hyphens === "none") return;
  const view = body.ownerDocument.defaultView as Window;
  const all = [...body.querySelectorAll<HTMLElement>(prose)].filter(
    (element) => element.closest(noProse) === null && divides(element),
  );
  const styles = all.map((element) => {
    const { textAlign, whiteSpace, hyphens } = view.getComputedStyle(element);
    return { element, textAlign, hyphens, isSet: whiteSpace.startsWith("pre") };
  });
  for (const { element, textAlign, hyphens: own, isSet } of styles) {
    // What a book sets in lines of several lengths is "left" or "right" to it.
    const isUnsaid = align === "" && textAlign === "start";
    if (isSet || own === "none" || !(isUnsaid || textAlign === "justify")) continue;
    element.style.setProperty("text-align", "justify", "important");
    if (own === "manual") element.style.setProperty("hyphens", "auto", "important");
  }
}
