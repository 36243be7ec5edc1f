/** The links of an open page as real ones, over their printed text. */

import type { LinkTarget, PageLink, TextRun } from "../sources/page_source.ts";
import { NotePopover } from "./note_popover.ts";
import type { FieldPlace } from "./page_fields.ts";
import { layOver, placeIn } from "./run_place.ts";

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
  return links.map((link) => {
    const { to } = link;
    const a = document.createElement("a");
    a.title = link.title || nameOf(to);
    a.setAttribute("aria-label", link.title || textUnder(link, runs) || nameOf(to));
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

/** Returns the printed text under a link: the fraction of each level run that lies in it. */
function textUnder(link: PageLink, runs: readonly TextRun[]): string {
  const parts = runs.map((run) => {
    const middle = run.y + run.height / 2;
    if (run.angle !== 0 || middle < link.y || middle > link.y + link.height) return "";
    const at = (x: number): number =>
      Math.round(Math.min(Math.max((x - run.x) / run.width, 0), 1) * run.text.length);
    return run.text.slice(at(link.x), at(link.x + link.width));
  });
  return parts.join("").replace(/\s+/g, " ").trim();
}
