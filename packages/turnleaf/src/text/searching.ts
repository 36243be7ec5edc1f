/** Finds a word or phrase in a whole book. */

import type { TextPage, TextRun } from "../sources/page_source.ts";
import { foldQuery, foldRuns } from "./case_folding.ts";
import type { PageTexts } from "./page_texts.ts";

/** A hit of a search. */
export interface SearchHit {
  /** The page on which it begins, from 1, as pages are numbered now: it follows its text while they are counted. */
  readonly page: number;
  /**
   * The text before it on the page, some fifty characters in one line; begins
   * with "… " if there is more.
   */
  readonly before: string;
  /** The text that was found, as the page writes it. */
  readonly text: string;
  /**
   * The text after it, likewise, on the next pages too if a paragraph goes on there; ends with " …" if there
   * is more.
   */
  readonly after: string;
  /** The query. */
  readonly query: string;
  /** Its index among the hits that begin on the page, from 0. */
  readonly index: number;
}

/** A stretch of one run: from one character to another, UTF-16 units. */
export interface Stretch {
  readonly run: number;
  readonly from: number;
  readonly to: number;
}

/** Maximum of characters of a query, and of hits in a book: more than anybody looks through. */
const longestQuery = 200;
const mostHits = 2000;

/** Maximum of characters of the pages after a page in which a place that begins on it may end. */
const longestHead = 4 * longestQuery;

/** Characters of context around a hit. */
const about = 48;

/** Pages after which the search yields to the browser. */
const pagesAtOnce = 8;

/**
 * Returns every place of a book that contains a text, in reading order, at most
 * 2,000. Case, accents, ligatures, width, quotation marks and hyphens do not
 * count; a line's end counts as a space, and so does a page's where a paragraph
 * goes on. Rejects with the signal's reason when aborted.
 *
 * @param pages the book's pages, in reading order
 * @param found called with the places that begin on a page as soon as they are found
 */
export async function searchBook(
  pages: AsyncIterable<TextPage>,
  texts: PageTexts,
  query: string,
  signal: AbortSignal,
  found: (hits: readonly SearchHit[]) => void = () => {},
): Promise<readonly SearchHit[]> {
  signal.throwIfAborted();
  const hits: SearchHit[] = [];
  if (foldQuery(query.slice(0, longestQuery)) === "") return hits;
  /** Pages in which places begin that may end on a page to come: each but the last goes on on the next one. */
  let waiting: ReadPage[] = [];
  const searchFirst = (): void => {
    const [first, ...rest] = waiting;
    waiting = rest;
    if (!first) return;
    const around = [first.runs, ...rest.map(({ runs }) => runs)];
    const joined = joinPages(around);
    const here = findFrom(around, query)
      .slice(0, mostHits - hits.length)
      .map((stretches, index) => hitOn(first.page, contextOf(joined, stretches), query, index));
    if (here.length === 0) return;
    hits.push(...here);
    found(here);
  };
  let read = 0;
  for await (const page of pages) {
    if (++read % pagesAtOnce === 0) await new Promise((resolve) => setTimeout(resolve));
    const runs = await texts.of(page, signal);
    signal.throwIfAborted();
    const last = waiting.at(-1);
    if (last && !isNext(last.page, page)) while (waiting.length > 0) searchFirst();
    waiting.push({ page, runs });
    while (waiting.length > 0 && !mayGoOn(waiting.map((one) => one.runs))) searchFirst();
    if (hits.length === mostHits) break;
  }
  while (waiting.length > 0) searchFirst();
  // Pages of another source among these come after them.
  return hits.sort((a, b) => a.page - b.page);
}

/** A page and its text. */
interface ReadPage {
  readonly page: TextPage;
  readonly runs: readonly TextRun[];
}

/** Returns whether a page lies next after another. */
function isNext(page: TextPage, next: TextPage): boolean {
  const index = page.index();
  return index !== null && next.index() === index + 1;
}

/** Returns whether a page's last paragraph goes on on the next one. */
export function goesOn(runs: readonly TextRun[]): boolean {
  return runs.at(-1)?.wraps ?? false;
}

/** Returns whether a place that begins on the first of consecutive pages may end on the page after the last. */
export function mayGoOn(pages: readonly (readonly TextRun[])[]): boolean {
  const following = pages.slice(1).flat();
  return (
    pages.every(goesOn) && following.reduce((sum, { text }) => sum + text.length, 0) < longestHead
  );
}

/**
 * Returns the runs of the first of consecutive pages, and those of the others in which a place that begins
 * on it may end: as far as each page goes on on the next one.
 */
function joinPages(pages: readonly (readonly TextRun[])[]): readonly TextRun[] {
  const joined = [...(pages[0] ?? [])];
  let letters = 0;
  for (let k = 1; k < pages.length && goesOn(pages[k - 1] ?? []); k++) {
    for (const run of pages[k] ?? []) {
      if (letters >= longestHead) return joined;
      letters += run.text.length;
      joined.push(run);
    }
  }
  return joined;
}

/** Returns a hit whose number follows its page. */
function hitOn(
  page: TextPage,
  context: Pick<SearchHit, "before" | "text" | "after">,
  query: string,
  index: number,
): SearchHit {
  let last = 0;
  return {
    get page() {
      last = page.index() ?? last;
      return last + 1;
    },
    ...context,
    query,
    index,
  };
}

/**
 * Returns every place of a page that contains a text, each as the stretches of
 * the runs that it covers.
 */
export function findIn(runs: readonly TextRun[], query: string): readonly (readonly Stretch[])[] {
  const wanted = foldQuery(query.slice(0, longestQuery));
  const found: Stretch[][] = [];
  if (wanted === "") return found;
  const folded = foldRuns(runs);
  for (let at = folded.text.indexOf(wanted); at >= 0; ) {
    const stretches: Stretch[] = [];
    for (let k = at; k < at + wanted.length; k++) {
      const [run, place] = [folded.runs[k], folded.places[k]];
      const to = place + lengthAt(runs[run].text, place);
      const last = stretches.at(-1);
      if (last?.run === run) stretches[stretches.length - 1] = { ...last, to };
      else stretches.push({ run, from: place, to });
    }
    found.push(stretches);
    if (found.length === mostHits) break;
    at = folded.text.indexOf(wanted, at + wanted.length);
  }
  return found;
}

/**
 * Returns every place that begins on the first of consecutive pages, as `findIn` does; one that ends on
 * another has stretches there too, whose runs are counted on from page to page.
 */
export function findFrom(
  pages: readonly (readonly TextRun[])[],
  query: string,
): readonly (readonly Stretch[])[] {
  const count = pages[0]?.length ?? 0;
  return findIn(joinPages(pages), query).filter(([first]) => first.run < count);
}

/** Returns the UTF-16 units of the character at a place. */
function lengthAt(text: string, place: number): number {
  return (text.codePointAt(place) ?? 0) > 0xffff ? 2 : 1;
}

function contextOf(
  runs: readonly TextRun[],
  stretches: readonly Stretch[],
): Pick<SearchHit, "before" | "text" | "after"> {
  const [first, last] = [stretches[0], stretches[stretches.length - 1]];
  let before = runs[first.run].text.slice(0, first.from);
  for (let run = first.run - 1; run >= 0 && before.length < about; run--) {
    before = joined(runs[run]) + before;
  }
  let after = joined(runs[last.run]).slice(last.to);
  for (let run = last.run + 1; run < runs.length && after.length < about; run++) {
    after += joined(runs[run]);
  }
  const text = stretches
    .map(({ run, from, to }, k) => {
      const isLast = k === stretches.length - 1;
      return isLast ? runs[run].text.slice(from, to) : joined(runs[run]).slice(from);
    })
    .join("");
  return { before: startOf(before), text: oneLine(text).trim(), after: endOf(after) };
}

/** Returns a run with its separator in one line: a space at a line's end, and no hyphen there. */
function joined({ text, end }: TextRun): string {
  if (!end) return text;
  const isBroken = /\p{L}[-\u00ad\u2010]\s*$/u.test(text);
  return isBroken ? text.replace(/[-\u00ad\u2010]\s*$/, "") : `${text} `;
}

const oneLine = (text: string): string => text.replace(/\s+/g, " ");

/** Returns the end of a text, beginning with a whole word if possible. */
function startOf(text: string): string {
  const line = oneLine(text);
  if (line.length <= about) return line.trimStart();
  const cut = line.slice(-about);
  const space = cut.indexOf(" ");
  return `… ${space >= 0 && space < about / 2 ? cut.slice(space + 1) : cut}`;
}

function endOf(text: string): string {
  const line = oneLine(text);
  if (line.length <= about) return line.trimEnd();
  const cut = line.slice(0, about);
  const space = cut.lastIndexOf(" ");
  return `${space > about / 2 ? cut.slice(0, space) : cut} …`;
}
