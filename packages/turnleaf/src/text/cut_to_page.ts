/**
 * Boxes of a page's text, links, fields and media, cut at the page: a file may
 * claim any box, and one that reached beyond would lie over other pages and
 * over what is around the book.
 */

import type { PageBox, PageSize, TextRun } from "../sources/page_source.ts";

/** Returns the part of a page in which its boxes may lie, in the unit of its size. */
export function boundsOf(size: PageSize, isScrolled: boolean): PageBox {
  // A scrolled page hangs together with those before and after it: lines are cut between them.
  const beyond = isScrolled ? size.height : 0;
  return { x: 0, y: 0 - beyond, width: size.width, height: size.height + 2 * beyond };
}

/** Returns what has its box within bounds, cut there; leaves out what lies beyond. */
export function cutBoxes<T extends PageBox>(boxes: readonly T[], bounds: PageBox): T[] {
  return boxes.flatMap((box) => {
    const x = Math.max(box.x, bounds.x);
    const y = Math.max(box.y, bounds.y);
    const width = Math.min(box.x + box.width, bounds.x + bounds.width) - x;
    const height = Math.min(box.y + box.height, bounds.y + bounds.height) - y;
    return width > 0 && height > 0 ? [{ ...box, x, y, width, height }] : [];
  });
}

/**
 * Returns pieces of text, each cut along its middle line, and across the middle
 * of what is left of that. All stay in the list, in which they are counted:
 * letters beyond the bounds have no width.
 */
export function cutRuns(runs: readonly TextRun[], bounds: PageBox): TextRun[] {
  return runs.map((run) => cutRun(run, bounds));
}

function cutRun(run: TextRun, bounds: PageBox): TextRun {
  const { x, y, width, height, angle, text } = run;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const at = (u: number, v: number): Place => ({
    x: x + u * width * cos - v * height * sin,
    y: y + u * width * sin + v * height * cos,
  });
  const across = (v: number) => insideOf(at(0, v), at(1, v), bounds);
  const down = (u: number) => insideOf(at(u, 0), at(u, 1), bounds);
  const middle = ([from, to]: Part): number => (from + to) / 2;
  // Letters that stand below each other run down the box.
  const along = run.vertical ? down(0.5) : across(0.5);
  const aside = run.vertical ? across(middle(along)) : down(middle(along));
  if (isWhole(along) && isWhole(aside)) return run;
  const [[left, right], [top, bottom]] = run.vertical ? [aside, along] : [along, aside];
  const [from, to] = along;
  const places = Array.from({ length: text.length }, (_, letter) => {
    // Evenly, where the source does not say.
    const place = run.places?.[letter] ?? letter / text.length;
    return to > from ? Math.min(Math.max((place - from) / (to - from), 0), 1) : 0;
  });
  const size = { width: (right - left) * width, height: (bottom - top) * height };
  const corner = size.width > 0 && size.height > 0 ? at(left, top) : { x: bounds.x, y: bounds.y };
  return { ...run, ...corner, ...size, places };
}

type Place = Pick<PageBox, "x" | "y">;

/** A part of a line, in fractions of it. */
type Part = readonly [from: number, to: number];

const isWhole = ([from, to]: Part): boolean => from === 0 && to === 1;

/** Returns the part of a line between two places that lies within bounds; [0, 0] if none does. */
function insideOf(start: Place, end: Place, bounds: PageBox): Part {
  let [from, to] = [0, 1];
  const sides = [
    [start.x, end.x, bounds.x, bounds.x + bounds.width],
    [start.y, end.y, bounds.y, bounds.y + bounds.height],
  ] as const;
  for (const [first, last, low, high] of sides) {
    const [a, b] = [(low - first) / (last - first), (high - first) / (last - first)];
    if (first === last) to = first < low || first > high ? 0 : to;
    else [from, to] = [Math.max(from, Math.min(a, b)), Math.min(to, Math.max(a, b))];
  }
  return to > from ? [from, to] : [0, 0];
}
