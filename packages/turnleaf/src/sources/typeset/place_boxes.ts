/**
 * Boxes that a book puts beyond their page. A browser scrolls to them; on paper they would lie on another
 * page, upon its text, or on none. They are put back to where they would be otherwise. What no browser
 * scrolls to, as it lies before the beginning, is hidden so by books and stays hidden.
 */

import type { PageSize } from "../page_source.ts";
import { pageBox, pagesOf, type Styles, setStyles, tolerance } from "./box_styles.ts";
import { drawingOf, isMoved, type LayoutFrame, moving, unmoved } from "./frame.ts";
import { boxesIn, type StyleMentions } from "./style_mentions.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** Rounds of measuring and changing: what is put back takes with it what is in it. */
const rounds = 8;

/** What does not get narrower. */
const replaced = "img, svg, video, canvas, object";

type Placed = HTMLElement | SVGElement;

/**
 * Puts back what lies beyond its page.
 *
 * @param body the section's body, laid out
 * @param size of a page, CSS pixels; of no end in height if pages hang together
 * @param mentions of the section's own style
 * @param fitted boxes that were made to fit: those within one that was moved, as by a turn, are not any more
 * @returns whether anything was put back
 */
export function placeBoxes(
  frame: LayoutFrame,
  body: Element,
  flow: PageFlow,
  size: PageSize,
  mentions: StyleMentions,
  fitted: WeakSet<Element>,
): boolean {
  const view = body.ownerDocument.defaultView as Window & typeof globalThis;
  const isWhole = (element: Element): boolean => drawingOf(element, body) === element;
  const elements: readonly Placed[] = [...boxesIn(body)].filter(isWhole);
  const movable: readonly Placed[] = mentions.has([...moving, "offset"]) ? elements : [];
  const known = new Set<Placed>();
  for (let round = 0; round < rounds; round++) {
    const changes: [Placed, Styles][] = [];
    const moved = new Set(
      movable.filter(
        (element) => !known.has(element) && element.getClientRects().length > 0 && isMoved(element),
      ),
    );
    const rects = (): DOMRect[] => [...moved].map((element) => element.getBoundingClientRect());
    const places = moved.size === 0 ? [] : unmoved(frame, rects);
    [...moved].forEach((element, k) => {
      const page = pageOfRect(flow, places[k] as DOMRect);
      const rect = element.getBoundingClientRect();
      const still = Object.fromEntries(moving.map((name) => [name, "none"]));
      const change = putBack(rect, pageBox(flow, page, size), still);
      if (!change) return;
      changes.push([element, change]);
      for (const one of [element, ...element.querySelectorAll("*")]) fitted.delete(one);
    });
    for (const element of elements) {
      if (known.has(element) || moved.has(element)) continue;
      const change = changeOf(element, view.getComputedStyle(element), flow, size);
      if (change) changes.push([element, change]);
    }
    if (changes.length === 0) return round > 0;
    for (const [element, change] of changes) {
      known.add(element);
      setStyles(element, change);
    }
  }
  return true;
}

/** Returns the styles by which a rectangle that is beyond its page is there again, or hidden; null if it is not beyond. */
function putBack(rect: DOMRect, page: DOMRect, back: Styles): Styles | null {
  if (rect.right < page.left || rect.bottom < page.top) return { visibility: "hidden" };
  const isWithin =
    rect.left > page.left - tolerance &&
    rect.right < page.right + tolerance &&
    rect.top > page.top - tolerance &&
    rect.bottom < page.bottom + tolerance;
  return isWithin ? null : back;
}

/** Returns the styles by which a box that is not moved after it is laid out is on its page; null if it is. */
function changeOf(
  element: Placed,
  style: CSSStyleDeclaration,
  flow: PageFlow,
  size: PageSize,
): Styles | null {
  const { position } = style;
  const px = (name: string): number => Number.parseFloat(style.getPropertyValue(name)) || 0;
  const shift =
    position === "relative"
      ? { x: px("left") || -px("right"), y: px("top") || -px("bottom") }
      : { x: px("margin-left"), y: Math.min(px("margin-top"), 0) };
  const isAway = position === "absolute";
  const squeezed = isAway ? null : squeezedChange(element, style);
  if (squeezed) return squeezed;
  // It is that of a box, not of a part of its lines.
  const hasIndent = style.display !== "inline" && !/^0(?:px|%)$/.test(style.textIndent);
  if (!isAway && shift.x === 0 && shift.y === 0 && !hasIndent) return null;
  const rects = [...element.getClientRects()];
  const [first] = rects;
  if (!first) return null;
  if (isAway) return awayChange(element as HTMLElement, rects, flow, size);
  const { x, y, width, height } = first;
  const own = pageOfRect(flow, new DOMRect(x - shift.x, y - shift.y, width, height));
  const page = pageBox(flow, own, size);
  const back = shiftChange(element, first, shift, page);
  const isBack = back !== null && "margin-left" in back;
  const box = isBack ? new DOMRect(x - shift.x, y, width + shift.x, height) : first;
  const indented = hasIndent ? indentChange(style, box, page) : null;
  return back || indented ? { ...back, ...indented } : null;
}

/** How far a box is put from where it would be, CSS pixels. */
interface Shift {
  readonly x: number;
  readonly y: number;
}

/** Returns what `changeOf` does, of a box that is relative to where it would be, or that has margins. */
function shiftChange(element: Placed, box: DOMRect, shift: Shift, page: DOMRect): Styles | null {
  if (shift.x === 0 && shift.y === 0) return null;
  const view = element.ownerDocument.defaultView as Window;
  if (view.getComputedStyle(element).position === "relative") {
    return putBack(box, page, { inset: "auto" });
  }
  // What is wider than its page is made narrower, and what is higher breaks.
  const least = element.matches(replaced) ? box.width : Math.min(box.width, page.right - box.x);
  const start = new DOMRect(box.x, box.y, least, 0);
  const back = { ...(shift.x && { "margin-left": "0" }), ...(shift.y && { "margin-top": "0" }) };
  if (start.top < page.top - tolerance) return back;
  return start.width < 0 ? null : putBack(start, page, back);
}

/** Returns the styles by which the first line of a box begins on its page; null if it does. */
function indentChange(style: CSSStyleDeclaration, box: DOMRect, page: DOMRect): Styles | null {
  const isVertical = !style.writingMode.startsWith("horizontal");
  const isReversed = (style.direction === "rtl") !== (style.writingMode === "sideways-lr");
  const [starts, ends, length] = isVertical
    ? [box.top - page.top, page.bottom - box.bottom, box.height]
    : [box.left - page.left, page.right - box.right, box.width];
  const before = isReversed ? ends : starts;
  const indent = indentOf(style.textIndent, length);
  // Text is hidden so where a picture stands for it.
  if (before + length + indent < 0) return { "text-indent": "0", "font-size": "0" };
  return before + indent < 0 || indent >= length ? { "text-indent": "0" } : null;
}

/** Returns an indent in CSS pixels; a browser leaves percentages, of lines of some length, as they are: `calc(10% - 5px)`. */
function indentOf(value: string, length: number): number {
  let indent = 0;
  let sign = 1;
  for (const word of value.replace(/calc|[()]/g, "").split(" ")) {
    const number = Number.parseFloat(word);
    if (Number.isFinite(number))
      indent += sign * (word.endsWith("%") ? (number / 100) * length : number);
    sign = word === "-" ? -1 : 1;
  }
  return indent;
}

/** Returns the styles by which a box whose indents leave no room for two letters has none; null for others. */
function squeezedChange(element: Placed, style: CSSStyleDeclaration): Styles | null {
  if (!/^(block|list-item|flow-root)$/.test(style.display) || !element.textContent?.trim()) {
    return null;
  }
  const px = (name: string): number => Number.parseFloat(style.getPropertyValue(name)) || 0;
  const within = px("padding-inline-start") + px("padding-inline-end");
  const indents = within + px("margin-inline-start") + px("margin-inline-end");
  // It is the length of its lines, if nothing asks for another box.
  const room = px("inline-size") - (style.boxSizing === "border-box" ? within : 0);
  const isSqueezed = room < 2 * px("font-size") && indents > room;
  return isSqueezed ? { "margin-inline": "0", "padding-inline": "0" } : null;
}

/** Returns what `changeOf` does, of a box that is put elsewhere than where the text has it. */
function awayChange(
  element: HTMLElement,
  rects: readonly DOMRect[],
  flow: PageFlow,
  size: PageSize,
): Styles | null {
  const around = [element.parentElement, element.offsetParent].flatMap((one) => [
    ...(one?.getClientRects() ?? []),
  ]);
  const { first, last } = pagesOf(flow, around);
  const back = { position: "static", margin: "0" };
  for (const rect of rects) {
    if (rect.width === 0 && rect.height === 0) continue;
    const page = pageOfRect(flow, rect);
    const own = Math.min(Math.max(page, Math.max(first, 0)), Math.max(last, 0));
    const change = putBack(rect, pageBox(flow, own, size), back);
    if (change) return change;
  }
  return null;
}
