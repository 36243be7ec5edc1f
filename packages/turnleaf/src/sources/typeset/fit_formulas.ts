/** Formulas that are wider than a line, which no browser breaks: they are smaller, and else broken between their parts. */

import { setStyles, tolerance } from "./box_styles.ts";

/** The smallest size of a formula, over its own; wider still, it is broken. */
const smallest = 0.6;

/** Elements of a formula that put its parts beside each other. */
const rows = ":scope > mrow, :scope > mstyle, :scope > semantics";

/** Makes all formulas in a section's body, laid out, as wide as what is around them lets them be. */
export function fitFormulas(body: Element, isVertical: boolean): void {
  const view = body.ownerDocument.defaultView as Window;
  const wide: { math: HTMLElement; size: number; type: number }[] = [];
  // All are measured before any is changed: after a change the browser lays out the whole section.
  for (const math of body.querySelectorAll<HTMLElement>("math")) {
    const [own, room] = [math, boxAround(math)].map((element) => {
      // One rectangle for each page that it is on.
      const lengths = [...element.getClientRects()].map((one) =>
        isVertical ? one.height : one.width,
      );
      return Math.max(...lengths, 0);
    }) as [number, number];
    const width = widthIn(math, own, isVertical);
    if (room === 0 || width <= room + tolerance) continue;
    const type = Number.parseFloat(view.getComputedStyle(math).fontSize);
    wide.push({ math, size: room / width, type });
  }
  for (const { math, size, type } of wide) {
    setStyles(math, { "font-size": `${type * Math.max(size, smallest)}px` });
    if (size < smallest) breakUp(math);
  }
}

/** Returns the box whose lines a formula is in: what is as wide as its own text gives it no room. */
function boxAround(math: Element): Element {
  const view = math.ownerDocument.defaultView as Window;
  let box = math.parentElement as Element;
  while (box.parentElement && /^(inline|contents)$/.test(view.getComputedStyle(box).display))
    box = box.parentElement;
  return box;
}

/** Returns how wide a formula is with all its parts, which may lie beyond its own box. */
function widthIn(math: Element, own: number, isVertical: boolean): number {
  const range = math.ownerDocument.createRange();
  range.selectNodeContents(math);
  const { width, height } = range.getBoundingClientRect();
  return Math.max(own, isVertical ? height : width);
}

/** Has the parts of a formula follow each other as words do. */
function breakUp(math: HTMLElement): void {
  setStyles(math, { display: "block" });
  for (let row: Element | null = math; row; row = row.querySelector(rows)) {
    if (row !== math) setStyles(row as HTMLElement, { display: "inline" });
    for (const part of row.children as HTMLCollectionOf<HTMLElement>) {
      // Operators stand apart from their terms by rules of the row.
      if (part.localName === "mo") setStyles(part, { "margin-inline": "0.25em" });
      setStyles(part, { display: "inline math" });
    }
    if (row.childElementCount > 1) break;
  }
}
