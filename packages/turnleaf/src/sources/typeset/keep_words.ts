/**
 * Words that would be broken though their page has room for them: beside a float, and in a box narrower than
 * they are.
 */

import { setStyles } from "./box_styles.ts";
import { boxesIn, type StyleMentions } from "./style_mentions.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** A float beside which there is room for most words, of the length of a line. */
const narrowFloat = 0.6;

/** A box is narrow if it has no room for so many letters, as wide as their type is high. */
const fewLetters = 2;

/**
 * Has words stay whole: beside a float they begin below it, as without the rule by which words longer than a line
 * are broken, and a box of a few letters' width is as wide as its longest word.
 *
 * @param body the section's body, laid out
 * @param line the length of its lines, CSS pixels
 * @param mentions of the section's own style
 */
export function keepWords(
  body: Element,
  flow: PageFlow,
  line: number,
  mentions: StyleMentions,
): void {
  if (mentions.has(["float"]) || body.querySelector("[align]")) keepBesideFloats(body, flow, line);
  const sizes = ["width", "max-width", "inline-size", "max-inline-size"];
  if (!mentions.has(sizes)) return;
  const view = body.ownerDocument.defaultView as Window;
  const narrow = [...boxesIn(body)].filter((element) => {
    const inner = flow.isVertical ? element.clientHeight : element.clientWidth;
    if (inner >= line / 2 || !/\S{3}/.test(element.textContent ?? "")) return false;
    const { display, fontSize, position } = view.getComputedStyle(element);
    const isBlock = /^(?:block|inline-block|list-item|flow-root)$/.test(display);
    return isBlock && position !== "absolute" && inner < fewLetters * Number.parseFloat(fontSize);
  });
  for (const element of narrow) setStyles(element, { "min-inline-size": "min-content" });
}

/** Has words beside floats that leave little room be whole. */
function keepBesideFloats(body: Element, flow: PageFlow, line: number): void {
  const view = body.ownerDocument.defaultView as Window;
  const lengthOf = ({ width, height }: DOMRect): number => (flow.isVertical ? height : width);
  const beside = new Set<HTMLElement>();
  const isFloat = (element: Element): boolean => view.getComputedStyle(element).float !== "none";
  /** The floats that are beside what comes now. */
  let floats: DOMRect[] = [];
  let last: Element | null = null;
  for (const element of boxesIn(body)) {
    const [rect] = element.getClientRects();
    if (!rect) continue;
    if (isFloat(element)) {
      if (lengthOf(rect) < narrowFloat * line || lengthOf(rect) >= line) continue;
      floats = [...element.getClientRects()];
      last = element;
      const { parentElement } = element;
      if (parentElement && parentElement !== body) beside.add(parentElement);
    } else if (floats.length > 0 && isPassed(rect, floats, flow)) floats = [];
    else if (floats.length > 0 && !last?.contains(element)) beside.add(element);
  }
  for (const element of beside) setStyles(element, { "overflow-wrap": "normal" });
}

/** Returns whether a rectangle lies behind all of others, across lines or on a later page. */
function isPassed(rect: DOMRect, others: readonly DOMRect[], flow: PageFlow): boolean {
  const page = pageOfRect(flow, rect);
  return others.every((other) => {
    const on = pageOfRect(flow, other);
    if (on !== page) return on < page;
    return flow.isVertical ? rect.right <= other.left : rect.top >= other.bottom;
  });
}
