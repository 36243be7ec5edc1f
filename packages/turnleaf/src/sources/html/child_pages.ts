/** Which children of a book are its pages. */

/** Children that are none: what shows nothing, and what is for a slot of the book itself. */
const noPages = "script, style, link, meta, template, noscript, [slot]";

/** Returns the children of an element that are pages of a book. */
export function pagesIn(parent: Element): HTMLElement[] {
  return [...parent.children].filter((child): child is HTMLElement => {
    return !child.matches(noPages) && "offsetWidth" in child;
  });
}
