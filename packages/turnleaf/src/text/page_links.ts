/** The links of an open page as real ones, over their printed text. */

import type { LinkTarget, PageLink, TextRun } from "../sources/page_source.ts";
import { fractionBefore } from "./fitting.ts";
import { NotePopover } from "./note_popover.ts";
import type { FieldPlace } from "./page_fields.ts";
import type { Point } from "./page_view.ts";
import { layOver, placeIn } from "./run_place.ts";
import { wordsOf } from "./word_bounds.ts";

/** How links are followed. */
export interface LinkActions {
  /** Follows a link within the book to a page (from 1), and to a fraction of its height there. */
  readonly goTo: (page: number, top?: number) => void;
  /** Returns what the reader is asked before a link out of the book is followed, and what follows it. */
  readonly leaving: (address: string) => { readonly question: string; readonly follow: string };
}

/**
 * Returns a page's links as elements.
 *
 * @param nameOf returns the name of a link's target
 * @param popover shows the notes to which links lead, and asks before one is followed out of the book
 */
export function makeLinks(
  links: readonly PageLink[],
  runs: readonly TextRun[],
  nameOf: (to: LinkTarget) => string,
  { goTo, leaving }: LinkActions,
  popover: NotePopover,
): FieldPlace[] {
  const words = links.length > 0 ? wordsIn(runs) : [];
  return links.map((link) => {
    const { to } = link;
    const a = document.createElement("a");
    a.title = link.title || nameOf(to);
    a.setAttribute("aria-label", link.title || textUnder(link, words) || nameOf(to));
    if ("page" in to) {
      a.href = `#page=${to.page}`;
      const { note } = link;
      const isShown = note !== undefined && NotePopover.isSupported;
      if (isShown) a.setAttribute("aria-haspopup", "dialog");
      a.addEventListener("click", (event) => {
        event.preventDefault();
        if (isShown) popover.show(note, a, nameOf(to), () => goTo(to.page, to.top));
        else goTo(to.page, to.top);
      });
    } else {
      a.href = to.href;
      a.target = "_blank";
      a.rel = "noopener noreferrer";
      if (link.asks && NotePopover.isSupported) {
        // Without listeners it is a link as any other.
        const plain = a.cloneNode() as HTMLAnchorElement;
        a.setAttribute("aria-haspopup", "dialog");
        a.addEventListener("click", (event) => {
          event.preventDefault();
          const { question, follow } = leaving(to.href);
          popover.show(question, a, follow, () => plain.click());
        });
      }
    }
    return { element: a, lay: (project) => layOver(a, placeIn(link, project)) };
  });
}

/** A word of a page, or what lies between two, and where its middle is printed. */
interface PrintedWord {
  readonly text: string;
  readonly middle: Point | null;
}

/** Divides the text of a page into words, and what lies between them. */
function wordsIn(runs: readonly TextRun[]): PrintedWord[] {
  return runs.flatMap((run) => {
    const place = placeIn(run, (x, y) => ({ x, y }));
    const words = [...wordsOf.segment(run.text)].map(({ segment, index }) => {
      const [from, to] = [index, index + segment.length].map((at) => fractionBefore(run, at));
      const middle = (from + to) / 2;
      return { text: segment, middle: run.vertical ? place(0.5, middle) : place(middle, 0.5) };
    });
    const last = words.at(-1);
    return run.end && last ? [...words, { text: " ", middle: last.middle }] : words;
  });
}

/**
 * Returns the printed text under a link: the words whose middle lies in it, whole, as boxes of links
 * are drawn by hand and end within letters.
 */
function textUnder({ x, y, width, height }: PageLink, words: readonly PrintedWord[]): string {
  const under = words.filter(
    ({ middle }) =>
      middle !== null &&
      Math.abs(middle.x - x - width / 2) <= width / 2 &&
      Math.abs(middle.y - y - height / 2) <= height / 2,
  );
  return under
    .map(({ text }) => text)
    .join("")
    .replace(/\s+/g, " ")
    .trim();
}
