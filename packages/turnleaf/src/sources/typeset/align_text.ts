/** Sets paragraphs in lines of one length, or not, as the reader chooses: titles and verses stay as they are. */

import type { Typography } from "../page_source.ts";

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
