/**
 * Texts whose lines stand across those around them, as an English appendix of a Japanese book, and that are longer
 * than a page. A browser does not break them: they are split into as many boxes, each on a page of its own.
 */

import { lengthsOf, type Styles, setStyles, tolerance } from "./box_styles.ts";
import { continuedClass, numberAfter } from "./divide.ts";

/** Parts of one text, at most: the section is laid out for each. */
const mostParts = 50;

/** What is not divided: it goes to the next page whole. */
const whole = "tr, svg, math, ruby, figure, img, video, canvas, object, select, button";

/** Displays of boxes whose items stand beside each other. */
const besideEachOther = /(?:flex|grid|table)$/;

/**
 * Splits a text into boxes that are no longer than there is room for. The last one is longer if what is first in
 * it has no room.
 *
 * @param box laid out, with lines as long as there is room for
 * @param length of a page in the direction in which its lines follow each other, CSS pixels
 * @param styles of each part
 * @returns whether it is split
 */
export function splitCrossed(box: HTMLElement, length: number, styles: Styles): boolean {
  let part = box;
  for (let count = 1; count < mostParts; count++) {
    const end = endOf(part, length);
    const rest = end && splitAt(part, end);
    if (!rest) break;
    setStyles(rest, styles);
    part = rest;
  }
  return part !== box;
}

/** Where a text is split. */
interface Place {
  readonly node: Node;
  readonly offset: number;
}

/** Returns the place of the first line in a box for which there is no room; null if there is room for all. */
function endOf(box: HTMLElement, length: number): Place | null {
  const { ownerDocument } = box;
  const view = ownerDocument.defaultView as Window;
  const style = view.getComputedStyle(box);
  const place = box.getBoundingClientRect();
  const isVertical = !style.writingMode.startsWith("horizontal");
  const isFromRight = style.writingMode.endsWith("-rl");
  const down = ({ left, right, bottom }: DOMRect): number =>
    isVertical ? (isFromRight ? place.right - left : right - place.left) : bottom - place.top;
  const margins = lengthsOf(style, "margin-block-start", "margin-block-end");
  const room = margins.reduce((left, margin) => left - margin, length);
  /** Returns the room that is needed below the lines in an element of the box. */
  const below = (element: Element): number => {
    const edges = ["padding-block-end", "border-block-end-width"] as const;
    const own = lengthsOf(view.getComputedStyle(element), ...edges);
    const outer = element === box ? 0 : below(element.parentElement as Element);
    return own.reduce((sum, edge) => sum + edge, outer);
  };
  const range = ownerDocument.createRange();
  const nodes = ownerDocument.createTreeWalker(box, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
  for (let node = nodes.nextNode(); node !== null; node = nodes.nextNode()) {
    const isText = node.nodeType === Node.TEXT_NODE;
    if (!isText && !(node as Element).matches(whole)) continue;
    range.selectNode(node);
    const parent = node.parentElement as Element;
    const left = room - below(parent) + tolerance;
    // Lines are higher than their letters.
    const line = Number.parseFloat(view.getComputedStyle(parent).lineHeight) || 0;
    const isBeyond = (): boolean =>
      [...range.getClientRects()].some((rect) => {
        const { width, height } = rect;
        const leading = isText ? Math.max(line - (isVertical ? width : height), 0) / 2 : 0;
        return width > 0 && height > 0 && down(rect) + leading > left;
      });
    if (!isBeyond()) continue;
    const around = isText ? wholeAround(node, box) : node;
    if (around !== null) return before(around, box);
    let [low, high] = [0, (node as Text).length];
    while (low < high) {
      const middle = (low + high) >> 1;
      range.setStart(node, 0);
      range.setEnd(node, middle + 1);
      if (isBeyond()) high = middle;
      else low = middle + 1;
    }
    const isFirst = (node as Text).data.slice(0, low).trim() === "";
    return isFirst ? before(node, box) : { node, offset: low };
  }
  return null;
}

/** Returns the outermost element around a node, in a box, that is not divided; null if there is none. */
function wholeAround(node: Node, box: Element): Element | null {
  const view = box.ownerDocument.defaultView as Window;
  let found: Element | null = null;
  for (let at = node.parentElement; at && at !== box; at = at.parentElement) {
    const { display } = view.getComputedStyle(at);
    const isTable = display.endsWith("table") && at.querySelector("tr") !== null;
    if (at.matches(whole) || (besideEachOther.test(display) && !isTable)) found = at;
  }
  return found;
}

/** Returns the place before a node in a box, and before what it is first in. */
function before(node: Node, box: Element): Place {
  const isBlank = ({ nodeType, nodeValue }: Node): boolean =>
    nodeType !== Node.ELEMENT_NODE && !nodeValue?.trim();
  let first = node as ChildNode;
  for (let parent = first.parentElement; parent && parent !== box; parent = first.parentElement) {
    const siblings = [...parent.childNodes];
    if (!siblings.slice(0, siblings.indexOf(first)).every(isBlank)) break;
    first = parent;
  }
  const parent = first.parentNode as Node;
  return { node: parent, offset: [...parent.childNodes].indexOf(first) };
}

/** Moves what follows a place in a box to a box like it behind it; returns that, null if nothing is before the place. */
function splitAt(box: HTMLElement, { node, offset }: Place): HTMLElement | null {
  const range = box.ownerDocument.createRange();
  range.setStart(box, 0);
  range.setEnd(node, offset);
  if (![...range.getClientRects()].some(({ width, height }) => width > 0 && height > 0))
    return null;
  const rest = box.cloneNode(false) as HTMLElement;
  range.setStart(node, offset);
  range.setEnd(box, box.childNodes.length);
  rest.append(range.extractContents());
  rest.removeAttribute("id");
  let original: Element = box;
  let copy: Element = rest;
  for (;;) {
    const last: Element | null = original.lastElementChild;
    const first: Element | null = copy.firstElementChild;
    const isDivided = last?.contains(node) === true;
    if (copy.localName === "ol" && last) {
      const step = original.hasAttribute("reversed") ? -1 : 1;
      const next = numberAfter(original, last);
      copy.setAttribute("start", String(isDivided ? next - step : next));
    }
    if (!isDivided || !last || !first) break;
    // Each goes on, and ids are of one element.
    first.removeAttribute("id");
    first.classList.add(continuedClass);
    [original, copy] = [last, first];
  }
  box.after(rest);
  // No room is needed between this and what follows on its own page.
  let last = box.lastElementChild as HTMLElement | null;
  for (; last; last = last.lastElementChild as HTMLElement | null) {
    setStyles(last, { "margin-block-end": "0" });
  }
  return rest;
}
