/** Notes of a text, and the links to them, by EPUB's structural semantics and by the roles of DPUB-ARIA. */

import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";

const semantics = "http://www.idpf.org/2007/ops";

/** Elements that are a part of a line: a note that they mark is what is around them. */
const inline = "a, span, sup, sub, em, strong, i, b, small";

/** Returns whether a link is to a note. */
export function isNoteLink(link: Element): boolean {
  return hasMeaning(link, "noteref", "doc-noteref");
}

/** Returns the text of the note that an element marks, without the links back; may be empty. */
export function noteText(target: Element): string {
  let note: Element = target;
  while (note.matches(inline) && note.parentElement) note = note.parentElement;
  if (note.localName === "body" || note.localName === "html") return "";
  const copy = note.cloneNode(true) as Element;
  for (const link of copy.querySelectorAll("a")) {
    if (hasMeaning(link, "backlink", "doc-backlink")) link.remove();
  }
  return cleanText(copy.textContent, limits.noteLength);
}

function hasMeaning(element: Element, type: string, role: string): boolean {
  const types =
    element.getAttributeNS(semantics, "type") ?? element.getAttribute("epub:type") ?? "";
  const roles = element.getAttribute("role") ?? "";
  return types.split(/\s+/).includes(type) || roles.split(/\s+/).includes(role);
}
