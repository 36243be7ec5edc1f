/** What the text of elements says, to be found and to lead to pages. */

import { ElementPlane } from "../../element_plane.ts";
import { cleanRun, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import type { OutlineEntry, TextRun } from "../page_source.ts";

/** Where something is on a page, in the page's own CSS pixels. */
interface Bounds {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** Returns where a point of the window is on the page, CSS pixels; null if that cannot be seen. */
type Locate = (x: number, y: number) => { readonly x: number; readonly y: number } | null;

/** Returns the text that a page shows, a run for each line of each piece of text. */
export function textIn(page: HTMLElement): TextRun[] {
  // In a book it is seen as the box around it is, and has its size.
  const box = page.assignedSlot?.parentElement;
  if (!box) {
    const { left, top } = page.getBoundingClientRect();
    return runsIn(page, (x, y) => ({ x: x - left, y: y - top }));
  }
  const plane = new ElementPlane(box);
  try {
    return runsIn(page, plane.measure());
  } finally {
    plane.remove();
  }
}

function runsIn(page: HTMLElement, locate: Locate): TextRun[] {
  const { ownerDocument, offsetWidth, offsetHeight } = page;
  const walker = ownerDocument.createTreeWalker(page, NodeFilter.SHOW_TEXT);
  const range = ownerDocument.createRange();
  const runs: TextRun[] = [];
  for (let node = walker.nextNode(); node && runs.length < limits.runs; node = walker.nextNode()) {
    const value = node.nodeValue ?? "";
    if (value.trim() === "" || node.parentElement?.closest("script, style, textarea")) continue;
    const { writingMode = "" } = node.parentElement ? getComputedStyle(node.parentElement) : {};
    const isVertical = /^(vertical|sideways)/.test(writingMode);
    for (const { from, to, bounds } of linesOf(value, (...word) =>
      boundsOf(range, [node, isVertical], locate, ...word),
    )) {
      const text = cleanRun(value.slice(from, to)).replace(/\s+/g, " ");
      const { left: x, top: y, right, bottom } = bounds;
      const [width, height] = [right - x, bottom - y];
      if (width > 0 && height > 0 && text.trim() !== "") {
        runs.push({ text, x, y, width, height, angle: 0, end: true });
      }
    }
  }
  return runs.filter(
    ({ x, y, width, height }) =>
      x < offsetWidth && y < offsetHeight && x + width > 0 && y + height > 0,
  );
}

/**
 * Returns where a word of a node lies on its page; null if it is not shown. The browser says where
 * things are by upright boxes around them: those of a turned word are too large, but have its middle,
 * and that of the caret at its end is a line from corner to corner: upright on the page or, in vertical
 * lines, level. The word is the same on both sides of its middle.
 */
function boundsOf(
  range: Range,
  [node, isVertical]: readonly [node: Node, isVertical: boolean],
  locate: Locate,
  from: number,
  to: number,
): Bounds | null {
  range.setStart(node, from);
  range.setEnd(node, to);
  const word = range.getBoundingClientRect();
  if (word.width === 0 && word.height === 0) return null;
  range.collapse();
  const caret = range.getBoundingClientRect();
  const middle = locate(word.left + word.width / 2, word.top + word.height / 2);
  const end = lineIn(caret.width > 0 || caret.height > 0 ? caret : word, isVertical, locate);
  if (!middle || !end) return null;
  const xs = end.flatMap(({ x }) => [x, 2 * middle.x - x]);
  const ys = end.flatMap(({ y }) => [y, 2 * middle.y - y]);
  const [left, top] = [Math.min(...xs), Math.min(...ys)];
  return { left, top, right: Math.max(...xs), bottom: Math.max(...ys) };
}

/** Returns the diagonal of a box that is upright on the page, or level, or nearest to that. */
function lineIn({ left, top, right, bottom }: DOMRect, isLevel: boolean, locate: Locate) {
  const diagonals = [
    [locate(left, top), locate(right, bottom)],
    [locate(right, top), locate(left, bottom)],
  ].flatMap(([from, to]) => (from && to ? [[from, to] as const] : []));
  // Of a page that is turned by 45 degrees one is upright, and the other level.
  const slant = ([from, to]: (typeof diagonals)[number]): number =>
    Math.abs(isLevel ? to.y - from.y : to.x - from.x);
  return diagonals.sort((a, b) => slant(a) - slant(b))[0];
}

/** A line of a text: from one character to another. */
interface Line {
  readonly from: number;
  readonly to: number;
  readonly bounds: Bounds;
}

/** Divides a text into lines: where a word stands lower than the one before. */
function* linesOf(
  text: string,
  boundsOf: (from: number, to: number) => Bounds | null,
): Generator<Line> {
  let line = null as Line | null;
  for (const { 0: word, index } of text.slice(0, limits.textLength).matchAll(/\S+/g)) {
    const bounds = boundsOf(index, index + word.length);
    if (bounds === null) continue;
    if (line && Math.abs(bounds.bottom - line.bounds.bottom) > 1) {
      yield { ...line, to: index };
      line = null;
    }
    const to = index + word.length;
    line = line
      ? { ...line, to, bounds: around(line.bounds, bounds) }
      : { from: index, to, bounds };
  }
  if (line) yield { ...line, to: text.length };
}

function around(a: Bounds, b: Bounds): Bounds {
  return {
    left: Math.min(a.left, b.left),
    top: Math.min(a.top, b.top),
    right: Math.max(a.right, b.right),
    bottom: Math.max(a.bottom, b.bottom),
  };
}

/** Returns the contents that the headings of pages make. */
export function headingsIn(pages: readonly HTMLElement[]): OutlineEntry[] {
  const top: OutlineEntry[] = [];
  const open: { readonly level: number; readonly children: OutlineEntry[] }[] = [];
  let count = 0;
  for (const [index, page] of pages.entries()) {
    for (const heading of page.querySelectorAll("h1, h2, h3")) {
      const title = cleanText(heading.textContent);
      if (title === "" || ++count > limits.outlineEntries) continue;
      const level = Number(heading.localName[1]);
      while ((open.at(-1)?.level ?? 0) >= level) open.pop();
      const children: OutlineEntry[] = [];
      (open.at(-1)?.children ?? top).push({ title, page: index + 1, children });
      open.push({ level, children });
    }
  }
  return top;
}
