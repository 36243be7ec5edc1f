/** One open page's text as elements: transparent, selectable, each piece exactly over its ink. */

import type { TextRun } from "../sources/page_source.ts";
import { isRunOn } from "./case_folding.ts";
import { fontSize, fractionBefore, widthOf } from "./fitting.ts";
import { formulaOf } from "./formula.ts";
import { isFlat, matrixOf, type Project, placeIn } from "./run_place.ts";

/** A piece of a run that is laid out as one: from one character to another. */
interface Piece {
  readonly text: string;
  readonly from: number;
  readonly to: number;
}

/** Returns where a place of a run is seen. */
type Place = ReturnType<typeof placeIn>;

/** Maximum distance of a word from its ink, CSS pixels. */
const mostOff = 1;

/**
 * Returns the page's text as elements in reading order, a line's end after each line that ends in itself;
 * each heading in one of their own. The rest of one that begins on the page before has no role there: that
 * page's heading owns it.
 *
 * The pieces lie each by itself, so to assistive technology each is a text by itself, even within a word.
 * They are hidden from it: before those of a paragraph stands an element from which they are read as one text.
 *
 * @param before the last run of the open page before it
 * @param after the first run of the open page after it
 */
export function layText(
  runs: readonly TextRun[],
  project: Project,
  before?: TextRun,
  after?: TextRun,
): Node[] {
  const nodes: Node[] = [];
  let heading: HTMLElement | null = null;
  let paragraph: Paragraph | null = null;
  const paragraphs: Paragraph[] = [];
  for (const [k, run] of runs.entries()) {
    const last = runs[k - 1] ?? before;
    const goesOn = last?.headingGoesOn && last.heading === run.heading;
    if (!goesOn && heading) heading = paragraph = null;
    if (run.heading !== undefined && heading === null) {
      heading = headingElement(goesOn ? null : run.heading);
      nodes.push(heading);
      paragraph = null;
    }
    const formula = run.math === undefined ? null : formulaOf(run.math);
    if (formula || !paragraph) {
      paragraph = new Paragraph();
      paragraphs.push(paragraph);
      const { spoken, pieces } = paragraph;
      const laid = formula ? [pieces, formula] : [spoken, pieces];
      if (heading) heading.append(...laid);
      else nodes.push(...laid);
    }
    const place = placeIn(run, project);
    paragraph.add(run, layRun(run, place, formula), place, runs[k + 1] ?? after);
    // A formula is read in place of its text, which is what is selected and copied.
    if (formula || paragraph.isEnded) paragraph = null;
  }
  for (const laid of paragraphs) laid.lay();
  return nodes;
}

/** Text that is heard as one: a paragraph, or a part of one before or after a formula. */
class Paragraph {
  /** What assistive technology reads; its text is neither selected nor found. */
  readonly spoken: HTMLElement = document.createElement("div");
  /** What is selected, copied and found. */
  readonly pieces: HTMLElement = document.createElement("div");
  /** Whether a line's end ends it. */
  isEnded = false;
  #text = "";
  /** The sides of the box in which it is seen, CSS pixels. */
  #left = Number.POSITIVE_INFINITY;
  #top = Number.POSITIVE_INFINITY;
  #right = Number.NEGATIVE_INFINITY;
  #bottom = Number.NEGATIVE_INFINITY;

  constructor() {
    this.spoken.className = "spoken";
    this.spoken.dir = "auto";
    this.pieces.className = "pieces";
    this.pieces.ariaHidden = "true";
  }

  /**
   * Adds a run.
   *
   * @param next the run after it
   */
  add(run: TextRun, pieces: readonly Node[], place: Place, next: TextRun | undefined): void {
    this.isEnded = run.end && !(run.wraps && next);
    const end = run.end ? endOf(run, next) : null;
    this.pieces.append(...pieces, ...(end ? [end] : []));
    // A word that a page's end divides is read where it begins.
    const read = run.text.slice(run.wordEndLength ?? 0) + (run.wordEnd ?? "");
    this.#text += read.replaceAll("\u00ad", "") + (end?.textContent ?? "");
    for (const corner of [place(0, 0), place(1, 0), place(0, 1), place(1, 1)]) {
      if (!corner) continue;
      this.#left = Math.min(this.#left, corner.x);
      this.#top = Math.min(this.#top, corner.y);
      this.#right = Math.max(this.#right, corner.x);
      this.#bottom = Math.max(this.#bottom, corner.y);
    }
  }

  /** Lays what is read over what was added. */
  lay(): void {
    this.spoken.dataset.text = this.#text;
    this.spoken.hidden = this.#right < this.#left;
    Object.assign(this.spoken.style, {
      left: `${this.#left}px`,
      top: `${this.#top}px`,
      width: `${this.#right - this.#left}px`,
      height: `${this.#bottom - this.#top}px`,
    });
  }
}

/** Lets a heading that goes on on the next page own its rest: screen readers find one heading. */
export function joinHeadings(page: Element, next: Element): void {
  const rest = next.querySelector(".heading:not([role])");
  if (!rest) return;
  // No more than two pages lie open.
  rest.id = "rest";
  page.lastElementChild?.setAttribute("aria-owns", "rest");
}

/** Returns an element without a box, which screen readers find among the headings; the rest of one if no level is given. */
function headingElement(level: number | null): HTMLElement {
  const element = document.createElement("div");
  element.className = "heading";
  if (level === null) return element;
  element.setAttribute("role", "heading");
  element.ariaLevel = String(level);
  return element;
}

/** Returns the pieces of a run; a formula is laid over it. */
function layRun(run: TextRun, place: Place, formula: MathMLElement | null): HTMLElement[] {
  const pieces = run.vertical || formula ? [wholeOf(run)] : piecesOf(run, place);
  const spans = pieces.map((piece) => {
    const span = document.createElement("span");
    // The end of the line alone has put a hyphen there.
    span.textContent = piece.text.replaceAll("\u00ad", "");
    span.dir = "auto";
    const printed = piece.text.trimEnd() || piece.text;
    const length = widthOf(printed);
    const [width, height] = run.vertical ? [fontSize, length] : [length, fontSize];
    const matrix = matrixOf(place, piece.from, piece.to, width, height);
    if (matrix === null) span.hidden = true;
    else {
      // The width is that of the ink: a space at the end extends beyond it,
      // on whichever side that is.
      Object.assign(span.style, {
        transform: matrix,
        width: `${width}px`,
        height: `${height}px`,
      });
      if (run.vertical) span.style.writingMode = "vertical-rl";
    }
    return span;
  });
  if (formula) {
    formula.setAttribute("class", "formula");
    formula.style.cssText = spans[0]?.style.cssText ?? "";
  }
  return spans;
}

/** Returns what stands between a line and the next one: a line's end, or where a paragraph goes on what joins its words. */
function endOf({ text, wraps }: TextRun, next: TextRun | undefined): Node | null {
  if (!wraps || !next) return document.createElement("br");
  const isJoined = /[\s\u00ad]$/.test(text) || isRunOn(text.slice(-1), next.text.charAt(0));
  return isJoined ? null : document.createTextNode(" ");
}

function wholeOf({ text }: TextRun): Piece {
  return { text, from: 0, to: 1 };
}

/**
 * Splits a run into the fewest pieces that lie over its ink, letter for letter;
 * each ends with a word if possible.
 */
function piecesOf(run: TextRun, place: Place): Piece[] {
  const [left, right] = [place(0, 0), place(1, 0)];
  const length = left && right ? Math.hypot(right.x - left.x, right.y - left.y) : 0;
  const split = (from: number, to: number): Piece[] => {
    const text = run.text.slice(from, to);
    const printed = from + (text.trimEnd().length || text.length);
    const [start, end] = [fractionBefore(run, from), fractionBefore(run, printed)];
    const cut = middleOf(text);
    const isRight = (): boolean => offPrint(run, from, printed) * length < mostOff;
    if (cut === 0 || (isFlat(place, start, end) && isRight()))
      return [{ text, from: start, to: end }];
    return [...split(from, from + cut), ...split(from + cut, to)];
  };
  return split(0, run.text.length);
}

/**
 * Returns how far the words of a piece would lie beside their ink if it were
 * laid out as one, as a fraction of the run.
 */
function offPrint(run: TextRun, from: number, to: number): number {
  const { text, places } = run;
  if (places === undefined) return 0;
  const [start, end] = [fractionBefore(run, from), fractionBefore(run, to)];
  const scale = (end - start) / widthOf(text.slice(from, to));
  let most = 0;
  for (let at = text.indexOf(" ", from) + 1; at > 0 && at < to; at = text.indexOf(" ", at) + 1) {
    const laid = start + scale * widthOf(text.slice(from, at));
    most = Math.max(most, Math.abs(laid - places[at]));
  }
  return most;
}

/**
 * Returns where a text can be cut near its middle: after a space, otherwise
 * between letters; 0 if it is too short.
 */
function middleOf(text: string): number {
  const half = text.length >> 1;
  const after = text.indexOf(" ", half) + 1;
  const before = text.lastIndexOf(" ", half) + 1;
  const cut = after > 0 && (before === 0 || after - half < half - before) ? after : before;
  if (cut > 0 && cut < text.length) return cut;
  // Scripts without spaces; never within a character of two units.
  const isSafe = half > 1 && !/[\ud800-\udbff]/.test(text[half - 1]);
  return isSafe && !text.trim().includes(" ") && text.length > 8 ? half : 0;
}
