/** Heights and room that a book sets for a screen: where nothing is in them, they would leave pages empty. */

import type { PageSize } from "../page_source.ts";
import { pagesOf, setStyles, tolerance } from "./box_styles.ts";
import { fitGenerated } from "./fit_type.ts";
import { drawingOf } from "./frame.ts";
import { boxesIn } from "./style_mentions.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** What has a height without anything in it. */
const replaced = "img, svg, video, canvas, object, input, meter, progress";

/**
 * Makes pictures, and boxes that end on a later page than what is in them, as high as there is room for.
 *
 * @param body of a section that is set in columns, laid out
 * @param area the type area, CSS pixels
 */
export function trimHeights(body: Element, flow: PageFlow, area: PageSize): void {
  const page = flow.isVertical ? area.width : area.height;
  for (const picture of body.querySelectorAll<HTMLElement | SVGElement>(replaced)) {
    if (drawingOf(picture, body) !== picture) continue;
    const { width, height } = picture.getBoundingClientRect();
    const room = page - leadOf(picture, body);
    // The line that it stands in is no higher than it.
    const styles = { "max-block-size": `${room}px`, "vertical-align": "top" };
    if ((flow.isVertical ? width : height) > room) setStyles(picture, styles);
  }
  /** What is around boxes that are changed: it is higher by them alone. */
  const around = new Set<Element>();
  for (const element of [...boxesIn(body)].reverse()) {
    if (around.has(element)) continue;
    const rects = [...element.getClientRects()];
    if (rects.length < 2 || element.matches(replaced) || isStretched(element, rects, flow))
      continue;
    let content = contentOf(element);
    if (trimRoom(element, content, body, flow)) content = contentOf(element);
    const { first, last } = pagesOf(flow, [...element.getClientRects()]);
    const ends = pagesOf(flow, content);
    if (Math.max(first, ends.last) >= last) continue;
    for (let box = element.parentElement; box && !around.has(box); box = box.parentElement) {
      around.add(box);
    }
    const isOnOne = content.length > 0 && ends.first === ends.last;
    setStyles(element, {
      "block-size": "auto",
      "min-block-size": isOnOne ? `${page - tolerance}px` : "0",
      "box-sizing": "border-box",
      ...(isOnOne ? { "break-inside": "avoid" } : {}),
      // Room alone ends its page; blank lines are not only that.
      ...(content.length === 0 && !element.querySelector("br") ? { "break-after": "column" } : {}),
    });
  }
}

/**
 * Takes away the room at the ends of a box that fills a page, or ends on a later one than what is in it. What
 * begins or ends there does so on the page that follows. Returns whether any was taken away.
 *
 * @param content the places of what is in it
 */
function trimRoom(
  element: HTMLElement,
  content: readonly DOMRect[],
  body: Element,
  flow: PageFlow,
): boolean {
  if (content.length === 0) return false;
  const view = element.ownerDocument.defaultView as Window;
  const take = (end: "start" | "end", part: "before" | "after"): void => {
    fitGenerated(element, `${part}-room`);
    setStyles(element, {
      [`padding-block-${end}`]: "0",
      [`border-block-${end}-width`]: "0",
      ...(view.getComputedStyle(element).display.endsWith("table") && { "border-spacing": "0" }),
      [`break-${part}`]: "column",
    });
  };
  const { first } = pagesOf(flow, [...element.getClientRects()]);
  const { first: from } = pagesOf(flow, content);
  const isFar = from > first + 1;
  const isLate =
    from > first &&
    hasRoom(element, view, "start") &&
    (isFar || isFirstOn(element, body, flow, first));
  if (isLate) take("start", "before");
  const { last } = pagesOf(flow, [...element.getClientRects()]);
  const { last: to } = pagesOf(flow, isLate ? contentOf(element) : content);
  const isEarly = last > to && hasRoom(element, view, "end");
  if (isEarly) take("end", "after");
  return isLate || isEarly;
}

/** Returns whether there is room at an end of a box, within it. */
function hasRoom(element: Element, view: Window, end: "start" | "end"): boolean {
  const style = view.getComputedStyle(element);
  const part = view.getComputedStyle(element, end === "start" ? "::before" : "::after");
  const isOver = (of: CSSStyleDeclaration, names: readonly string[]): boolean =>
    names.some((name) => Number.parseFloat(of.getPropertyValue(name)) > 0);
  const isApart =
    style.display.endsWith("table") &&
    !/^0px(?: 0px)?$/.test(style.getPropertyValue("border-spacing"));
  const isMade = !/^(?:none|normal)$/.test(part.content);
  const sizes = ["block-size", "padding-block-start", "padding-block-end", "margin-block-start"];
  return (
    isApart ||
    isOver(style, [`padding-block-${end}`, `border-block-${end}-width`]) ||
    (isMade && isOver(part, sizes))
  );
}

/**
 * Returns whether a box on several pages is only as high as what is beside it in a row: no page may end where
 * that box does, as what is beside it would be pushed off its own.
 */
function isStretched(element: HTMLElement, rects: readonly DOMRect[], flow: PageFlow): boolean {
  const { rowSpan = 1 } = element as Partial<HTMLTableCellElement>;
  // The rows that a cell goes over are beside it.
  if (rowSpan !== 1) return true;
  const { parentElement: row, ownerDocument } = element;
  const view = ownerDocument.defaultView as Window;
  const end = rects.at(-1);
  if (!row || !end || !/(?:flex|grid|table-row)$/.test(view.getComputedStyle(row).display)) {
    return false;
  }
  const isBesideEnd = (rect: DOMRect): boolean =>
    pageOfRect(flow, rect) === pageOfRect(flow, end) &&
    (flow.isVertical
      ? rect.left < end.right && rect.right > end.left
      : rect.top < end.bottom && rect.bottom > end.top);
  return [...row.children].some((one) => one !== element && contentOf(one).some(isBesideEnd));
}

/** Returns whether nothing before an element is on a page. */
function isFirstOn(element: Element, body: Element, flow: PageFlow, page: number): boolean {
  const range = element.ownerDocument.createRange();
  range.setStart(body, 0);
  range.setEndBefore(element);
  const rects = [...range.getClientRects()].filter(({ width, height }) => width > 0 && height > 0);
  return rects.every((rect) => pageOfRect(flow, rect) !== page);
}

/** Returns the places of what is in a box. */
function contentOf(element: Element): DOMRect[] {
  const range = element.ownerDocument.createRange();
  range.selectNodeContents(element);
  return [...range.getClientRects()].filter(({ width, height }) => width > 0 && height > 0);
}

/** Returns how far below the edge of what it is first in an element begins, at most, CSS pixels. */
function leadOf(element: Element, body: Element): number {
  const view = body.ownerDocument.defaultView as Window;
  let [lead, margin] = [0, 0];
  for (let box = element; isFirst(box); box = box.parentElement as Element) {
    const parent = box.parentElement;
    if (parent === null || parent === body) break;
    const style = view.getComputedStyle(parent);
    const px = (name: string): number => Number.parseFloat(style.getPropertyValue(name)) || 0;
    const inner = px("padding-block-start") + px("border-block-start-width");
    // Margins that meet are one.
    if (inner > 0) [lead, margin] = [lead + margin + inner, 0];
    margin = Math.max(margin, px("margin-block-start"));
  }
  return lead + margin;
}

/** Returns whether nothing is before an element in what it is in. */
function isFirst(element: Element): boolean {
  let node = element.previousSibling;
  while (node && !node.nodeValue?.trim() && !(node as Partial<Element>).getClientRects) {
    node = node.previousSibling;
  }
  return node === null;
}
