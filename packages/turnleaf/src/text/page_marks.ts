/** Marks hits of a search on an open page. */

import type { TextRun } from "../sources/page_source.ts";
import { fractionBefore } from "./fitting.ts";
import { isFlat, layOver, type Project, placeIn } from "./run_place.ts";
import { findFrom, type SearchHit, type Stretch } from "./searching.ts";

/** What is marked: every place of a query faintly, and the one hit strongly. */
export type ShownHit = Pick<SearchHit, "query" | "page" | "index">;

/** How far a mark extends beyond the letters, as a fraction of their height. */
const beyond = 0.08;

/** Number of pieces in which a mark that does not lie flat is laid. */
const mostPieces = 8;

/**
 * Consecutive pages of text, by their numbers, in order: one on which places are marked, and those around it
 * with which its first paragraph and its last are one.
 */
export type MarkedTexts = ReadonlyMap<number, readonly TextRun[]>;

/**
 * Returns the marks of a page, none if it has no hit.
 *
 * @csspart mark A place that a search found.
 * @csspart mark-here The one of them that is shown.
 */
export function layMarks(
  texts: MarkedTexts,
  shown: ShownHit,
  page: number,
  project: Project,
): HTMLElement[] {
  const runs = texts.get(page) ?? [];
  const pages = [...texts];
  return pages.flatMap(([from], k) => {
    if (from > page) return [];
    const following = pages.slice(k).map(([, text]) => text);
    const before = pages
      .slice(k)
      .reduce((sum, [at, text]) => sum + (at < page ? text.length : 0), 0);
    return findFrom(following, shown.query).flatMap((stretches, index) => {
      const isStrong = from === shown.page && index === shown.index;
      return stretches
        .filter(({ run }) => run >= before && run < before + runs.length)
        .flatMap((stretch) =>
          layStretch(runs, { ...stretch, run: stretch.run - before }, isStrong, project),
        );
    });
  });
}

function layStretch(
  runs: readonly TextRun[],
  { run, from, to }: Stretch,
  isStrong: boolean,
  project: Project,
): HTMLElement[] {
  const box = runs[run];
  const place = placeIn(box, project);
  const along = (at: number): number => fractionBefore(box, at);
  // Along a vertical line, fractions run along the box's height.
  const part: typeof place = box.vertical ? (u, v) => place(v, u) : place;
  const margin = (beyond * Math.min(box.width, box.height)) / Math.max(box.width, box.height);
  const [start, end] = [along(from) - margin, along(to) + margin];
  const pieces = isFlat(part, start, end) ? 1 : mostPieces;
  return Array.from({ length: pieces }, (_, k) => {
    const [a, b] = [k, k + 1].map((at) => start + ((end - start) * at) / pieces);
    const mark = document.createElement("div");
    mark.className = isStrong ? "mark here" : "mark";
    mark.setAttribute("part", isStrong ? "mark mark-here" : "mark");
    layOver(mark, part, a, b);
    return mark;
  });
}
