/** Formulas that are wider than a line, which no browser breaks: they are smaller, and else broken between their parts. */

import { boxAround, type Styles, setStyles, tolerance, widthOf } from "./box_styles.ts";

/** The smallest size of a formula, over its own; wider still, it is broken. */
const smallest = 0.6;

/** Elements of a formula that put its parts beside each other or, in tables, beneath. */
const rows = /^m(?:row|style|padded|table|tr|labeledtr|td)$/;

/** Makes all formulas in a section's body, laid out, as wide as what is around them lets them be. */
export function fitFormulas(body: Element, isVertical: boolean): void {
  const view = body.ownerDocument.defaultView as Window;
  const wide: { math: HTMLElement; size: number; type: number; room: number }[] = [];
  // All are measured before any is changed: after a change the browser lays out the whole section.
  for (const math of body.querySelectorAll<HTMLElement>("math")) {
    const [own, room] = [math, boxAround(math)].map((element) => {
      // One rectangle for each page that it is on.
      return widthOf([...element.getClientRects()], isVertical);
    }) as [number, number];
    const width = widthIn(math, own, isVertical);
    if (room === 0 || width <= room + tolerance) continue;
    const type = Number.parseFloat(view.getComputedStyle(math).fontSize);
    wide.push({ math, size: room / width, type, room });
  }
  const broken: { math: HTMLElement; room: number }[] = [];
  for (const { math, size, type, room } of wide) {
    setStyles(math, { "font-size": `${type * Math.max(size, smallest)}px` });
    if (size < smallest) broken.push({ math, room });
  }
  for (const { math, room } of broken) breakUp(math, room, isVertical);
}

/** Returns how wide a formula, or a part of one, is with all its parts, which may lie beyond its own box. */
function widthIn(math: Element, own: number, isVertical: boolean): number {
  const range = math.ownerDocument.createRange();
  range.selectNodeContents(math);
  const { width, height } = range.getBoundingClientRect();
  return Math.max(own, isVertical ? height : width);
}

/** Has the parts of a formula follow each other as words do, and those of parts that are wider than a line. */
function breakUp(math: HTMLElement, room: number, isVertical: boolean): void {
  const changes: [part: HTMLElement, styles: Styles][] = [[math, { display: "block" }]];
  const wide = [math];
  // All are measured before any is changed.
  for (const row of wide) {
    for (const part of row.children as HTMLCollectionOf<HTMLElement>) {
      const { localName } = part;
      const isWide = widthIn(part, 0, isVertical) > room + tolerance;
      const isRow = rows.test(localName);
      // Of a table that is broken the rows stand beneath each other, and their cells follow each other.
      const display = /^m(?:table|tr|labeledtr)$/.test(localName) ? "block" : "inline";
      const isOfTable = /^m(?:tr|labeledtr|td)$/.test(localName);
      // Words and signs have no parts.
      const isBroken = isOfTable || (isWide && (isRow || part.childElementCount === 0));
      changes.push([
        part,
        {
          display: isBroken ? display : "inline math",
          ...(isBroken && { "white-space": "normal" }),
          // Operators and cells stand apart from what is beside them by rules of the row.
          ...(/^m[ot]d?$/.test(localName) && { "margin-inline": "0.25em" }),
        },
      ]);
      if (isBroken && isRow) wide.push(part);
    }
  }
  for (const [part, styles] of changes) setStyles(part, styles);
}
