/** Styles that boxes of a section are given so that they fit their pages. */

import type { PageSize } from "../page_source.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** Values of CSS by their properties. */
export type Styles = Readonly<Record<string, string>>;

/** What is not quite a pixel too large is as large as it should be: the browser rounds lengths. */
export const tolerance = 1;

/** Gives an element styles that are above those of the book. */
export function setStyles(element: HTMLElement | SVGElement, styles: Styles): void {
  for (const [name, value] of Object.entries(styles)) {
    element.style.setProperty(name, value, "important");
  }
}

/** Displays that do not break from page to page, and those like them that do. */
const breaking: Styles = {
  "inline-block": "block",
  "inline-flex": "flex",
  "inline-grid": "grid",
  "inline-table": "table",
};

/** The inner table's parts, whose widths the table decides. */
export const tableParts: RegExp = /^table-/;

/** Returns the styles by which a box grows with what is in it and breaks where a page ends. */
export function opened(style: CSSStyleDeclaration, writingMode: string): Styles {
  const change: Record<string, string> = {};
  if (tableParts.test(style.display)) return change;
  if (style.overflow !== "visible") change.overflow = "visible";
  const display = breaking[style.display];
  if (display) change.display = display;
  // A browser does not say whether a height is its own; it is none, if nothing asks for one.
  change["block-size"] = "auto";
  change["max-block-size"] = "none";
  if (style.position === "absolute") change.position = "static";
  if (style.writingMode !== writingMode) change["writing-mode"] = writingMode;
  if (style.getPropertyValue("-webkit-line-clamp") !== "none") {
    change["-webkit-line-clamp"] = "none";
  }
  return change;
}

/** Returns whether a box does not break from page to page. */
export function isUnbroken({ overflow, display, position }: CSSStyleDeclaration): boolean {
  return overflow !== "visible" || display in breaking || position === "absolute";
}

/** Returns the place of a page (from 0) in its section's frame. */
export function pageBox({ stepX, stepY }: PageFlow, page: number, size: PageSize): DOMRect {
  return new DOMRect(page * stepX, page * stepY, size.width, size.height);
}

/** Returns how wide a box is, along its lines, on the page where it is widest. */
export function widthOf(rects: readonly DOMRect[], isVertical: boolean): number {
  return rects.reduce((most, { width, height }) => Math.max(most, isVertical ? height : width), 0);
}

/** Returns the pages (from 0) on which rectangles lie: the first and the last. */
export function pagesOf(
  flow: PageFlow,
  rects: readonly DOMRect[],
): { readonly first: number; readonly last: number } {
  let [first, last] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  // There may be more of them than a function takes arguments.
  for (const rect of rects) {
    const page = pageOfRect(flow, rect);
    [first, last] = [Math.min(first, page), Math.max(last, page)];
  }
  return { first, last };
}

/** Returns the box in whose lines an element stands: what is as wide as its own text gives it no room. */
export function boxAround(element: Element): Element {
  const view = element.ownerDocument.defaultView as Window;
  let box = element.parentElement as Element;
  while (box.parentElement && /^(inline|contents)$/.test(view.getComputedStyle(box).display)) {
    box = box.parentElement;
  }
  return box;
}

/** Returns lengths of a computed style, CSS pixels; 0 for other values. */
export function lengthsOf(style: CSSStyleDeclaration, ...names: readonly string[]): number[] {
  return names.map((name) => Number.parseFloat(style.getPropertyValue(name)) || 0);
}
