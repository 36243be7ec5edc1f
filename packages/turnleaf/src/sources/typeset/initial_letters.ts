/**
 * Letters that reach over several lines at the beginning of a paragraph (`initial-letter`). A browser tells
 * where such a letter begins and how wide it is, but gives it the height of the other letters.
 */

import { fitGenerated, unfitGenerated } from "./fit_type.ts";
import type { StyleMentions } from "./style_mentions.ts";
import type { InitialLetter } from "./text_map.ts";

/** What such letters are: one letter, number or sign with the marks before and after it. */
const initial = /^\s*(?:\p{P}\s*)*[^\s\p{P}]\p{M}*\p{P}*/u;

/**
 * Returns the large first letters of paragraphs by their texts. Those that are larger than a page are as the
 * letters after them.
 *
 * @param body the section's body, laid out
 * @param line the length of its lines, CSS pixels
 * @param page the length of a page across them, likewise; infinite if pages hang together
 * @param mentions of the section's own style
 */
export function initialLetters(
  body: Element,
  { line, page }: { readonly line: number; readonly page: number },
  mentions: StyleMentions,
): ReadonlyMap<Node, InitialLetter> {
  const initials = new Map<Node, InitialLetter>();
  if (!mentions.has(["initial-letter"])) return initials;
  const view = body.ownerDocument.defaultView as Window;
  const range = body.ownerDocument.createRange();
  const isVertical = !view.getComputedStyle(body).writingMode.startsWith("horizontal");
  const sizeOf = ({ text, end }: { text: Text; end: number }): Record<"along" | "down", number> => {
    range.setStart(text, text.data.search(/\S/));
    range.setEnd(text, end);
    const { width, height } = range.getBoundingClientRect();
    return isVertical ? { along: height, down: width } : { along: width, down: height };
  };
  const found: { element: Element; text: Text; end: number; along: number }[] = [];
  for (const element of body.querySelectorAll("*")) {
    const { initialLetter } = view.getComputedStyle(element, "::first-letter") as unknown as {
      readonly initialLetter?: string;
    };
    if (!initialLetter || initialLetter === "normal") continue;
    const text = firstText(element);
    const end = initial.exec(text?.data ?? "")?.[0].length ?? 0;
    if (!text || end === 0) continue;
    found.push({ element, text, end, along: sizeOf({ text, end }).along });
  }
  // All are measured before any is changed: after a change the browser lays out the whole section.
  for (const { element } of found) fitGenerated(element, "initial");
  const plain = found.map(sizeOf);
  found.forEach(({ element, text, end, along }, k) => {
    const own = plain[k] as ReturnType<typeof sizeOf>;
    const scale = along / own.along;
    if (!Number.isFinite(scale) || along > line || own.down * scale > page) return;
    unfitGenerated(element, "initial");
    initials.set(text, { end, scale });
  });
  return initials;
}

/** Returns the first text in an element that is more than blanks; null if there is none. */
function firstText(element: Element): Text | null {
  const texts = element.ownerDocument.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  while (texts.nextNode())
    if (texts.currentNode.nodeValue?.trim()) return texts.currentNode as Text;
  return null;
}
