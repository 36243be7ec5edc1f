/** Notes of a text, and the links to them, by EPUB's structural semantics and by the roles of DPUB-ARIA. */

import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { writtenIn } from "./letter_forms.ts";

const semantics = "http://www.idpf.org/2007/ops";

/** Elements that are a part of a line: a note that they mark is what is around them. */
const inline = "a, span, sup, sub, em, strong, i, b, small, bdi, bdo, cite, code, u, mark";

/** Elements that are not of a line: text on both sides of their edges is of two. */
const block =
  /^(address|article|aside|blockquote|br|caption|dd|details|div|dl|dt|figcaption|figure|footer|h[1-6]|header|hr|li|main|ol|p|pre|section|summary|table|td|th|tr|ul)$/;

/** Elements that have something else to show than text. */
const shown = "img, svg, math, table, audio, video";

/** Elements beside a note that are looked at. */
const mostSiblings = 1000;

/** Elements at which whatever stands before them ends. */
const divider = /^(h[1-6]|hr|section|article|aside|nav|footer|header)$/;

/** Returns whether a link is to a note. */
export function isNoteLink(link: Element): boolean {
  return hasMeaning(link, "noteref", "doc-noteref");
}

/** Returns the text of the note that an element marks, a line for each paragraph, without the links back; may be empty. */
export function noteText(target: Element): string {
  let text = "";
  for (const part of noteOf(target)) {
    text += "\n";
    for (const piece of piecesOf(part)) {
      text += piece;
      // Of lines that are not clean yet more are needed than are shown.
      if (text.length > 2 * limits.noteLength) break;
    }
  }
  const lines = text.split("\n").map((line) => cleanText(line, limits.noteLength));
  return lines
    .filter((line) => line !== "")
    .join("\n")
    .slice(0, limits.noteLength);
}

/** Returns the ids of elements in a section that mark no note: there is nothing to show for them. */
export function blankIds(root: Element): ReadonlySet<string> {
  // Each element is gone through once, however they are nested.
  const filled = new Set<Element>();
  const fill = (from: Element | null): void => {
    for (let at = from; at && !filled.has(at); at = at.parentElement) filled.add(at);
  };
  const walker = root.ownerDocument.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    if (/\S/.test(node.nodeValue ?? "")) fill(node.parentElement);
  }
  for (const element of root.querySelectorAll(shown)) fill(element);
  const blank = [...root.querySelectorAll("[id]")].filter((element) => !filled.has(element));
  const ids = blank
    .slice(0, limits.annotations)
    .filter((element) => !noteOf(element).some((part) => filled.has(part)))
    .map(({ id }) => id);
  return new Set(ids);
}

/** Returns the elements of the note that an element marks, in order. */
function noteOf(target: Element): Element[] {
  let note = target;
  while (note.matches(inline) && note.parentElement && !isContainer(note.parentElement)) {
    note = note.parentElement;
  }
  if (/^(html|body)$/.test(note.localName)) return [];
  // Its number stands in a cell or a term of its own.
  if (/^t[dh]$/.test(note.localName)) return [note.closest("tr") ?? note];
  if (note.localName === "dt") return [note, ...following(note, (one) => one.localName !== "dd")];
  // A mark between paragraphs, and a heading, are of what follows.
  if (note.matches(inline)) {
    const next = note.nextElementSibling;
    return next && block.test(next.localName) ? [note, ...noteOf(next)] : [note];
  }
  if (/^h[1-6]$/.test(note.localName)) {
    const isEnd = ({ localName }: Element): boolean =>
      /^h[1-6]$/.test(localName) && localName <= note.localName;
    return [note, ...following(note, isEnd)];
  }
  const isMarked = /\b(foot|end|rear)?note\b/.test(meaningsOf(note));
  if (note.localName !== "p" || isMarked || !isInListOfNotes(note)) return [note];
  return [note, ...following(note, (one) => divider.test(one.localName) || beginsNote(one))];
}

/** Returns whether an element has parts that are not of one line. */
function isContainer(element: Element): boolean {
  const isBlock = ({ localName }: Element): boolean => localName !== "br" && block.test(localName);
  return element.localName === "body" || [...element.children].some(isBlock);
}

/** Returns the siblings after an element, up to one at which they end. */
function following(element: Element, isEnd: (sibling: Element) => boolean): Element[] {
  const found: Element[] = [];
  let next = element.nextElementSibling;
  while (next && !isEnd(next) && found.length < mostSiblings) {
    found.push(next);
    next = next.nextElementSibling;
  }
  return found;
}

/** Returns whether a paragraph stands in a list of notes: after a heading, or what else divides a text, the first is one. */
function isInListOfNotes(paragraph: Element): boolean {
  let first = paragraph;
  for (let steps = 0; steps < mostSiblings; steps++) {
    const before = first.previousElementSibling;
    if (!before || divider.test(before.localName)) return beginsNote(first);
    first = before;
  }
  return false;
}

/** Returns whether a note begins with an element: it can be linked to, and has a link back. */
function beginsNote(element: Element): boolean {
  const hasId = element.id !== "" || element.querySelector("[id]") !== null;
  return hasId && [...element.querySelectorAll("a[href]")].some((link) => !isNoteLink(link));
}

/** Arrows that are all that a link back from a note says, each in either of its forms. */
const arrows = /^\s*(?:[\u2190-\u21ff\u23ce\u2b00-\u2b11\u{1f519}^](?:\ufe0e|\ufe0f)?\s?)+\s*$/u;

/** Returns whether an element is a link back from a note: it says so, or is an arrow. */
function isBacklink(element: Element): boolean {
  if (element.localName !== "a") return false;
  if (hasMeaning(element, "backlink", "doc-backlink")) return true;
  return element.hasAttribute("href") && arrows.test(element.textContent ?? "");
}

/** Returns an element's text in pieces, with the ends of its lines; without the links back from a note. */
function* piecesOf(element: Element): Generator<string> {
  for (const child of element.childNodes) {
    if (child.nodeType === Node.TEXT_NODE || child.nodeType === Node.CDATA_SECTION_NODE) {
      // The markup's own lines are none of the text.
      yield writtenIn(child as CharacterData).replace(/\s+/g, " ");
    }
    if (child.nodeType !== Node.ELEMENT_NODE) continue;
    const inner = child as Element;
    if (isBacklink(inner)) continue;
    const edge = block.test(inner.localName) ? (/^t[dh]$/.test(inner.localName) ? " " : "\n") : "";
    if (edge !== "") yield edge;
    yield* piecesOf(inner);
    if (edge !== "") yield edge;
  }
}

function hasMeaning(element: Element, type: string, role: string): boolean {
  const meanings = meaningsOf(element).split(/\s+/);
  return meanings.includes(type) || meanings.includes(role);
}

/** Returns an element's semantics and roles, with blanks between them. */
function meaningsOf(element: Element): string {
  const types =
    element.getAttributeNS(semantics, "type") ?? element.getAttribute("epub:type") ?? "";
  return `${types} ${element.getAttribute("role") ?? ""}`;
}
