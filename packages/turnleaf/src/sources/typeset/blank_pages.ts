/**
 * Pages on which nothing would be seen: those between two breaks about an empty box, and those of blank
 * paragraphs alone.
 */

import { type Styles, setStyles } from "./box_styles.ts";
import { boxesIn } from "./style_mentions.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** What is seen without any text in it. */
const shown = "img, svg, math, video, canvas, object, input, meter, progress, textarea, select, hr";

/** The largest room above what comes first, of a page: the more would leave its page empty. */
const mostRoom = 1 / 3;

/**
 * Takes away what leaves pages empty and is nothing itself: breaks about boxes that have neither content nor a
 * height, blank paragraphs that go on over a whole page, and room above the first words that is as high as a page.
 * A page stays where a book breaks pages about a blank line: it is to be one.
 *
 * @param body of a section that is set in columns, laid out
 * @param page the length of a page across lines, CSS pixels
 */
export function closeBlankPages(body: Element, flow: PageFlow, page: number): void {
  const nothings = new Map<HTMLElement, number>();
  const view = body.ownerDocument.defaultView as Window;
  for (const element of boxesIn(body)) {
    if (!isNothing(element, view)) continue;
    const [rect] = element.getClientRects();
    if (rect) nothings.set(element, pageOfRect(flow, rect));
  }
  const blank = new Set([...nothings.values(), 0]);
  const first = takeFilled(body, flow, blank);
  if (blank.size === 0) return;
  const changes: [HTMLElement, Styles][] = [];
  const isAsked = new Set<number>();
  for (const [element, on] of nothings) {
    if (!blank.has(on)) continue;
    const { breakBefore, breakAfter } = view.getComputedStyle(element);
    if (breakBefore !== "column" && breakAfter !== "column") continue;
    if (element.getClientRects()[0]?.height) isAsked.add(on);
    else changes.push([element, { "break-before": "auto", "break-after": "auto" }]);
  }
  for (const [element, on] of nothings) {
    const isLine = blank.has(on) && !isAsked.has(on) && element.getClientRects()[0]?.height;
    // What links may lead to has a place.
    if (isLine && element.id === "") changes.push([element, { display: "none" }]);
  }
  for (let box = first; blank.has(0) && box && box !== body; box = box.parentElement) {
    const room = Number.parseFloat(view.getComputedStyle(box).marginBlockStart);
    if (room > page / 2) changes.push([box, { "margin-block-start": `${mostRoom * page}px` }]);
  }
  for (const [element, change] of changes) setStyles(element, change);
}

/** Takes the pages on which anything is seen out of a set, and returns the element that is seen first. */
function takeFilled(body: Element, flow: PageFlow, blank: Set<number>): HTMLElement | null {
  const range = body.ownerDocument.createRange();
  const nodes = body.ownerDocument.createTreeWalker(
    body,
    NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT,
  );
  const view = body.ownerDocument.defaultView as Window;
  let first: HTMLElement | null = null;
  for (let node = nodes.nextNode(); node !== null && blank.size > 0; node = nodes.nextNode()) {
    const isText = node.nodeType === Node.TEXT_NODE;
    const element = (isText ? node.parentElement : node) as HTMLElement;
    if (isText ? !node.nodeValue?.trim() : !element.matches(shown) && !isPainted(element, view)) {
      continue;
    }
    range.selectNode(node);
    for (const rect of range.getClientRects()) {
      if (rect.width === 0 && rect.height === 0) continue;
      first ??= element;
      blank.delete(pageOfRect(flow, rect));
    }
  }
  return first;
}

/** Returns whether an element shows nothing: a blank line, or a box without content. */
function isNothing(element: HTMLElement, view: Window): boolean {
  const isBlank = element.firstElementChild === null && !element.textContent?.trim();
  return isBlank && !element.matches(shown) && !isPainted(element, view);
}

/** Returns whether the style of an element without content shows anything. */
function isPainted(element: HTMLElement, view: Window): boolean {
  if (element.firstElementChild !== null || element.textContent?.trim()) return false;
  const style = view.getComputedStyle(element);
  const { backgroundColor, backgroundImage, boxShadow, outlineStyle } = style;
  const hasBorder = ["top", "right", "bottom", "left"].some(
    (side) => Number.parseFloat(style.getPropertyValue(`border-${side}-width`)) > 0,
  );
  const hasPart = ["::before", "::after"].some(
    (part) => !/^(?:none|normal)$/.test(view.getComputedStyle(element, part).content),
  );
  const isPlain = /^(?:transparent|rgba\(\d+, \d+, \d+, 0\))$/.test(backgroundColor);
  return (
    !isPlain ||
    backgroundImage !== "none" ||
    boxShadow !== "none" ||
    outlineStyle !== "none" ||
    hasBorder ||
    hasPart
  );
}
