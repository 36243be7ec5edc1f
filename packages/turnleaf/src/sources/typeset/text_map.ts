/** Where the text of a laid out section lies: on which page, and in which lines. */

import { cleanRun } from "../book_text.ts";
import { limits } from "../limits.ts";
import { formulaAttribute } from "../markup/formulas.ts";
import { xmlOf } from "../markup/xml.ts";
import type { PageBox, TextRun } from "../page_source.ts";
import { writtenIn } from "./letter_forms.ts";
import { inPageOrder } from "./page_order.ts";
import { repeatedAttribute } from "./split_table.ts";
import type { StyleMentions } from "./style_mentions.ts";

/** How a section's pages lie beside each other in its frame. */
export interface PageFlow {
  /** The distance from page to page: CSS pixels. */
  readonly stepX: number;
  readonly stepY: number;
  readonly isVertical: boolean;
}

/** A letter of a text that reaches over several lines, with the marks beside it. */
export interface InitialLetter {
  /** Where it ends in its text. */
  readonly end: number;
  /** Its size over that of the letters after it. */
  readonly scale: number;
}

/** A piece of text on some pages, or a formula, which is on one. */
interface Piece {
  readonly node: Text | Element;
  /** Characters of the section before it. */
  readonly offset: number;
  readonly first: number;
  readonly last: number;
}

/** Returns the page on which a rectangle of a frame lies, from 0 if there is but one. */
export function pageOfRect({ stepX, stepY }: PageFlow, rect: DOMRect): number {
  if (stepY !== 0) return Math.floor((rect.top + Math.min(rect.height, stepY / 2) / 2) / stepY);
  if (stepX === 0) return 0;
  const step = Math.abs(stepX);
  const middle = rect.left + Math.min(rect.width, step / 2) / 2;
  return stepX > 0
    ? Math.floor(middle / step)
    : -Math.floor((rect.right - Math.min(rect.width, step / 2) / 2) / step);
}

/** The text of one section. */
export class TextMap {
  /**
   * The number of characters before each page; that of the next one for a page without text, or with text alone
   * that is written elsewhere than it stands.
   */
  readonly starts: readonly number[];
  /** The number of all characters. */
  readonly length: number;
  readonly #flow: PageFlow;
  readonly #initials: ReadonlyMap<Node, InitialLetter>;
  readonly #pieces: readonly Piece[];
  readonly #range: Range;

  /**
   * @param body its element, laid out
   * @param mentions of the section's own style
   * @param initials its letters that reach over several lines, by their texts
   */
  constructor(
    body: Element,
    flow: PageFlow,
    pageCount: number,
    { mentions, initials }: { mentions: StyleMentions; initials: ReadonlyMap<Node, InitialLetter> },
  ) {
    this.#flow = flow;
    this.#initials = initials;
    this.#range = body.ownerDocument.createRange();
    const pieces: Piece[] = [];
    let offset = 0;
    for (const node of textNodes(body, mentions.has(["visibility"]))) {
      const piece = this.#pieceOf(node, offset, pageCount);
      if (piece) pieces.push(piece);
      offset += lengthOf(node);
    }
    const starts: (number | undefined)[] = Array.from({ length: pageCount });
    for (const piece of inPageOrder(pieces, ({ node }) => lengthOf(node))) {
      for (let page = piece.first; page <= piece.last; page++) {
        const within = page === piece.first ? 0 : this.#firstOn(piece.node as Text, page);
        const before = within === 0 ? 0 : countOf((piece.node as Text).data.slice(0, within));
        starts[page] ??= piece.offset + before;
      }
    }
    for (let page = pageCount - 1, next = offset; page >= 0; page--) {
      next = Math.min(starts[page] ?? next, next);
      starts[page] = next;
    }
    this.starts = starts as number[];
    this.length = offset;
    this.#pieces = pieces;
  }

  /** Returns the page that shows a character of the section. */
  pageAt(offset: number): number {
    return Math.max(
      this.starts.findLastIndex((start) => start <= offset),
      0,
    );
  }

  /** Returns the characters of the section before an element, and those within it. */
  extentOf(element: Element): { readonly offset: number; readonly length: number } {
    const within = this.#pieces.filter(({ node }) => element.contains(node));
    const [first, last] = [within[0], within.at(-1)];
    if (!first || !last) return { offset: 0, length: 0 };
    return { offset: first.offset, length: last.offset + lengthOf(last.node) - first.offset };
  }

  /**
   * Returns a page's text in lines; with the places of letters, headings and which lines wrap if `exact`,
   * otherwise only whether the last one does.
   */
  runs(page: number, exact: boolean): TextRun[] {
    const runs: Line[] = [];
    let letters = 0;
    for (const piece of this.#pieces) {
      if (piece.first > page || piece.last < page) continue;
      for (const line of this.#linesOf(piece, page)) {
        letters += line.text.length;
        if (runs.length >= limits.runs || letters > limits.textLength) break;
        runs.push(line);
      }
    }
    const after = this.#firstAfter(page, runs.at(-1));
    const found = runs.map((line, k) =>
      this.#runOf(line, runs[k + 1], runs[k + 1] ?? after, exact),
    );
    return exact ? withDividedWords(found, runs) : found;
  }

  /** Returns where the text goes on after a page, whose last line it is; undefined if the section ends there. */
  #firstAfter(page: number, line: Line | undefined): TextPlace | undefined {
    if (line === undefined) return;
    const next = this.#pieces.find(({ first, last }) => first > page || last > page);
    if (next === undefined) return;
    const { node, first } = next;
    return { node, from: first > page ? 0 : this.#firstOn(node as Text, page + 1) };
  }

  #pieceOf(node: Piece["node"], offset: number, pageCount: number): Piece | null {
    this.#range.selectNodeContents(node);
    let [first, last] = [Number.POSITIVE_INFINITY, -1];
    // Marks over a letter that another element has take no room.
    const isMarks = isText(node) && /^\p{M}+$/u.test(node.data);
    for (const rect of this.#range.getClientRects()) {
      if ((rect.width === 0 && !isMarks) || rect.height === 0) continue;
      const page = Math.min(Math.max(pageOfRect(this.#flow, rect), 0), pageCount - 1);
      first = Math.min(first, page);
      last = Math.max(last, page);
    }
    // A formula is said once, where it begins.
    return last < 0 ? null : { node, offset, first, last: isText(node) ? last : first };
  }

  /** Returns the first character of a piece that is on a page or after it, blanks apart. */
  #firstOn(node: Text, page: number): number {
    let [low, high] = [0, node.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      const rect = this.#rectFrom(node, middle);
      if (rect === null || pageOfRect(this.#flow, rect) >= page) high = middle;
      else low = middle + 1;
    }
    return nextLetter(node.data, low);
  }

  /** Returns the place of the first character from `at` on that has one, blanks apart. */
  #rectFrom(node: Text, at: number): DOMRect | null {
    let k = at;
    do k = this.#firstPlaced(node, nextLetter(node.data, k));
    while (isBlank(node.data, k));
    return this.#rectOf(node, k, k + 1);
  }

  /**
   * Returns the first character from `at` on that has a place; the text's length
   * if there is none. Millions of collapsed spaces are passed over in stretches.
   */
  #firstPlaced(node: Text, at: number): number {
    let [from, step] = [at, 1];
    while (from < node.length && !this.#rectOf(node, from, from + step)) {
      from += step;
      step *= 2;
    }
    while (step > 1) {
      step /= 2;
      if (!this.#rectOf(node, from, from + step)) from += step;
    }
    return Math.min(from, node.length);
  }

  #rectOf(node: Text, from: number, to: number): DOMRect | null {
    if (from >= node.length) return null;
    this.#range.setStart(node, from);
    this.#range.setEnd(node, Math.min(to, node.length));
    // The first letter of a line has a place at the end of the line before too, if a hyphen was put there.
    const rects = [...this.#range.getClientRects()];
    return rects.findLast(({ width, height }) => width > 0 && height > 0) ?? null;
  }

  /** Returns the place of a mark over a letter that another element has: it takes no room. */
  #markRect(node: Text, from: number, to: number): DOMRect | null {
    if (!/^\p{M}/u.test(node.data.slice(from, to))) return null;
    this.#range.setStart(node, from);
    this.#range.setEnd(node, to);
    return [...this.#range.getClientRects()].find(({ height }) => height > 0) ?? null;
  }

  /** Splits a piece's part on a page where a line ends. */
  #linesOf(piece: Piece, page: number): Line[] {
    const { node } = piece;
    const isVertical = isVerticalIn(node);
    if (!isText(node)) return this.#formulaOf(node, page);
    const lines: Line[] = [];
    const from = page === piece.first ? 0 : this.#firstOn(node, page);
    const text = writtenIn(node);
    let line: Line | null = null;
    for (let k = from; k < text.length; ) {
      const next = k + (/[\ud800-\udbff]/.test(text[k] as string) ? 2 : 1);
      const rect = this.#rectOf(node, k, next) ?? this.#markRect(node, k, next);
      if (rect === null) {
        k = this.#firstPlaced(node, next);
        // Not between the halves of a character.
        if (k > next && /[\udc00-\udfff]/.test(text[k] ?? "")) k -= 1;
        continue;
      }
      const on = pageOfRect(this.#flow, rect);
      if (on !== page && isBlank(text, k)) {
        // There may be a million that hang over.
        k = blanksEnd(text, next);
        continue;
      }
      if (on > page) {
        if (line !== null && isWithinWord(text, k) && hasHyphens(node)) endInWord(line);
        break;
      }
      const letters = cleanRun(text.slice(k, next));
      if (on === page && letters !== "") {
        const box = this.#onPage(this.#wholeRect(node, k, rect), page);
        if (line === null || !continues(line, box, isVertical) || isOther(line, box, isVertical)) {
          if (line !== null && isWithinWord(text, k) && hasHyphens(node)) endInWord(line);
          line = { text: "", box, boxes: [], isVertical, node, from: k, to: k };
          lines.push(line);
        }
        line.to = next;
        line.text += letters;
        for (let unit = 0; unit < letters.length; unit++) line.boxes.push(box);
        if (!isBlank(text, k)) line.box = union(line.box, box);
      }
      k = next;
    }
    return lines;
  }

  /**
   * Returns a formula as one line: its parts stand above each other, and mean nothing one by one. Of one that
   * goes on on another page it is where the parts on this one are.
   */
  #formulaOf(math: Element, page: number): Line[] {
    this.#range.selectNodeContents(math);
    const rects = [...this.#range.getClientRects()].filter(
      (one) => one.width > 0 && one.height > 0,
    );
    const here = rects.filter((rect) => pageOfRect(this.#flow, rect) === page);
    // One that lies before the first page or after the last counts as on it.
    const [first, ...others] = (here.length > 0 ? here : rects).map((one) =>
      this.#onPage(one, page),
    );
    const text = cleanRun(math.getAttribute(formulaAttribute) ?? math.textContent ?? "");
    if (text === "" || !first) return [];
    const box = others.reduce(union, first);
    const line = {
      text,
      box,
      boxes: [],
      isVertical: isVerticalIn(math),
      node: math,
      from: 0,
      to: 0,
    };
    return [{ ...line, math: xmlOf(math) }];
  }

  /** Returns whether a line ends only because there is no more room in it. */
  #wraps(line: Line, next: TextPlace): boolean {
    const { node } = line;
    if (node === next.node) {
      const between = (node as Text).data.slice(line.to, next.from);
      return !(/\n/.test(between) && keepsLines(node as Text));
    }
    const block = blockOf(node);
    if (block !== blockOf(next.node)) return false;
    this.#range.setStartAfter(node);
    this.#range.setEndBefore(next.node);
    return this.#range.cloneContents().querySelector("br") === null;
  }

  /** Returns the place of a letter of which the browser tells another height than it has. */
  #wholeRect(node: Text, at: number, rect: DOMRect): DOMRect {
    const initial = this.#initials.get(node);
    if (!initial || at >= initial.end) return rect;
    const { x, y, width, height } = rect;
    if (!this.#flow.isVertical) return new DOMRect(x, y, width, height * initial.scale);
    const whole = width * initial.scale;
    const view = node.ownerDocument.defaultView as Window;
    const { writingMode } = view.getComputedStyle(node.parentElement as Element);
    return new DOMRect(writingMode === "vertical-rl" ? x + width - whole : x, y, whole, height);
  }

  #onPage(rect: DOMRect, page: number): PageBox {
    const { stepX, stepY } = this.#flow;
    const { width, height } = rect;
    return { x: rect.left - page * stepX, y: rect.top - page * stepY, width, height };
  }

  /**
   * @param next the line after it on its page
   * @param after where the text goes on, there or on another page
   */
  #runOf(
    line: Line,
    next: Line | undefined,
    after: TextPlace | undefined,
    exact: boolean,
  ): TextRun {
    const { text, box, boxes, isVertical, math } = line;
    const goesOn = next?.isVertical === isVertical && continues({ box }, next.box, isVertical);
    const run = {
      ...{ text, ...box, angle: 0, end: !goesOn },
      ...(isVertical ? { vertical: true } : {}),
      ...(exact ? headingOf(line.node, after?.node) : {}),
      ...((exact || !next) && !goesOn && after && this.#wraps(line, after) ? { wraps: true } : {}),
    };
    if (math !== undefined) return { ...run, math };
    if (!exact || isVertical || box.width === 0) return run;
    const places = boxes.map(({ x }) => Math.min((x - box.x) / box.width, 1));
    // Places are those of letters that run to the right.
    const isRising = places.every((place, k) => k === 0 || place >= (places[k - 1] as number));
    return isRising ? { ...run, places } : run;
  }
}

/** A place in a section's text. */
interface TextPlace {
  readonly node: Piece["node"];
  /** The first of its characters. */
  readonly from: number;
}

/** Letters on one line: those of one piece from one character to another. */
interface Line extends TextPlace {
  to: number;
  text: string;
  box: PageBox;
  readonly boxes: PageBox[];
  /** Whether they stand beneath each other, or lie so, as in a box that is turned. */
  readonly isVertical: boolean;
  /** The formula that they are. */
  readonly math?: string;
}

/**
 * Returns whether a character is a blank. Blanks at the end of a preformatted line hang over it, as far
 * as into the page beside: where they are says nothing of where the text goes on, nor of how long it is.
 */
function isBlank(text: string, at: number): boolean {
  return /\s/.test(text.charAt(at));
}

/** Returns the first character from `at` on that is no blank; the text's length if there is none. */
function nextLetter(text: string, at: number): number {
  const letter = /\S/g;
  letter.lastIndex = at;
  return letter.exec(text)?.index ?? text.length;
}

/** Returns whether the lines in which a piece stands go down the page: a box may be set otherwise than its section. */
function isVerticalIn(node: Piece["node"]): boolean {
  const parent = node.parentElement as Element;
  const view = node.ownerDocument.defaultView as Window;
  return !view.getComputedStyle(parent).writingMode.startsWith("horizontal");
}

/** Returns whether lines end where they do in a text. */
function keepsLines({ parentElement, ownerDocument }: Text): boolean {
  const view = ownerDocument.defaultView as Window;
  return (
    parentElement !== null && /pre|break/.test(view.getComputedStyle(parentElement).whiteSpace)
  );
}

/** Returns the level of the heading in which a piece stands, and whether the one after it stands there too, as a run has it. */
function headingOf(
  { parentElement }: Piece["node"],
  after: Piece["node"] | undefined,
): Pick<TextRun, "heading" | "headingGoesOn"> {
  const heading = parentElement?.closest("h1, h2, h3, h4, h5, h6");
  if (!heading) return {};
  const level = { heading: Number(heading.localName.charAt(1)) };
  return after && heading.contains(after) ? { ...level, headingGoesOn: true } : level;
}

/** Returns the box in whose lines a piece stands. */
function blockOf(node: Piece["node"]): Element | null {
  const view = node.ownerDocument.defaultView as Window;
  let at = node.parentElement;
  while (at && /^(inline|contents|ruby\b.*)$/.test(view.getComputedStyle(at).display)) {
    at = at.parentElement;
  }
  return at;
}

/** Returns where the blanks of a line that go on at `at` end: the next letter or line, or the text's length. */
function blanksEnd(text: string, at: number): number {
  const end = /[\S\n]/g;
  end.lastIndex = at;
  return end.exec(text)?.index ?? text.length;
}

/** Returns whether a box stands on the line of another: more than half beside it. */
function continues({ box }: { box: PageBox }, next: PageBox, isVertical: boolean): boolean {
  const [from, length, nextFrom, nextLength] = isVertical
    ? [box.x, box.width, next.x, next.width]
    : [box.y, box.height, next.y, next.height];
  const shared = Math.min(from + length, nextFrom + nextLength) - Math.max(from, nextFrom);
  return shared > Math.min(length, nextLength) / 2;
}

/** A letter of so many times another's height stands in a line of its own, which reaches over several. */
const largeLetter = 1.5;

/** Returns whether a letter is one that reaches over several lines while those of its text do not, or the other way round. */
function isOther({ box }: { box: PageBox }, next: PageBox, isVertical: boolean): boolean {
  const [own, other] = isVertical ? [box.width, next.width] : [box.height, next.height];
  return Math.max(own, other) > largeLetter * Math.min(own, other);
}

function union(a: PageBox, b: PageBox): PageBox {
  const [x, y] = [Math.min(a.x, b.x), Math.min(a.y, b.y)];
  const right = Math.max(a.x + a.width, b.x + b.width);
  const below = Math.max(a.y + a.height, b.y + b.height);
  return { x, y, width: right - x, height: below - y };
}

/**
 * Returns what is read and seen, in order: text, and formulas whole; readings of ruby stand beside what
 * they read.
 *
 * @param mayHide whether some of it may not be visible
 */
function textNodes(body: Element, mayHide: boolean): readonly Piece["node"][] {
  const view = body.ownerDocument.defaultView as Window;
  const found: Piece["node"][] = [];
  const collect = (parent: Element): void => {
    const isSeen = !mayHide || view.getComputedStyle(parent).visibility === "visible";
    for (let node = parent.firstChild; node !== null; node = node.nextSibling) {
      if (isText(node)) {
        if (isSeen) found.push(node);
        continue;
      }
      if (node.nodeType !== Node.ELEMENT_NODE) continue;
      const element = node as Element;
      const { localName } = element;
      const isReading = localName === "rt" || localName === "rp";
      if (isReading || element.hasAttribute(repeatedAttribute)) continue;
      if (localName !== "math") collect(element);
      else if (isSeen) found.push(element);
    }
  };
  collect(body);
  return found;
}

/** Returns whether a node is text; it may be of another window. */
function isText(node: Node): node is Text {
  return node.nodeType === Node.TEXT_NODE || node.nodeType === Node.CDATA_SECTION_NODE;
}

/** Returns the characters that a piece counts. */
function lengthOf(node: Piece["node"]): number {
  return countOf(node.textContent ?? "");
}

/** Returns the number of a text's characters, but for the soft hyphens, which come and go as the reader chooses. */
function countOf(text: string): number {
  return text.length - (text.match(/\u00ad/g)?.length ?? 0);
}

/** Returns whether a word of letters that are divided at a line's end goes on at a character. */
function isWithinWord(text: string, at: number): boolean {
  const letter = /[\p{Script=Latin}\p{Script=Greek}\p{Script=Cyrillic}]/u;
  return letter.test(text.charAt(at - 1)) && letter.test(text.charAt(at));
}

/** Returns whether words of a text are divided where lines end; others are only broken there. */
function hasHyphens({ parentElement, ownerDocument }: Text): boolean {
  const view = ownerDocument.defaultView as Window;
  return parentElement !== null && view.getComputedStyle(parentElement).hyphens === "auto";
}

/** Returns where the word of a piece that is divided at a character ends; that character if none is. */
function wordEndAt(node: Piece["node"], at: number): number {
  if (!isText(node)) return at;
  const text = writtenIn(node);
  const isDivided =
    text.charAt(at - 1) === "\u00ad" || (isWithinWord(text, at) && hasHyphens(node));
  if (!isDivided) return at;
  const blank = /\s/g;
  blank.lastIndex = at;
  return blank.exec(text)?.index ?? text.length;
}

/** Returns a page's runs with the words that are divided at its beginning and at its end. */
function withDividedWords(runs: TextRun[], lines: readonly Line[]): TextRun[] {
  const [first, last] = [lines[0], lines.at(-1)];
  if (!first || !last) return runs;
  const begin = wordEndAt(first.node, first.from);
  // One that begins before the page is read there, however many pages it is on.
  const isBegunBefore = last.node === first.node && last.to <= begin;
  const end = isBegunBefore ? last.to : wordEndAt(last.node, last.to);
  const written = ({ node }: Line, from: number, to: number): string =>
    isText(node) ? cleanRun(writtenIn(node).slice(from, to)).replaceAll("\u00ad", "") : "";
  const wordEndLength = written(first, first.from, begin).length;
  const wordEnd = written(last, last.to, end);
  return runs.map((run, k) => ({
    ...run,
    ...(k === 0 && wordEndLength > 0 ? { wordEndLength } : {}),
    ...(k === runs.length - 1 && wordEnd !== "" ? { wordEnd } : {}),
  }));
}

/** Ends a line with the hyphen that the browser has put there. */
function endInWord(line: Line): void {
  line.text += "\u00ad";
  line.boxes.push(...line.boxes.slice(-1));
}
