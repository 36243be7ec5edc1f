/** Estimates how many pages the sections of a book take before they are laid out. */

import type { Typography } from "../page_source.ts";
import type { FlowSection } from "./flow_book.ts";
import type { SectionMap } from "./lay_section.ts";
import { measuresOf, usualType } from "./page_measures.ts";

/** Letters of a line of print in which sections are measured: those of a page of usual type. */
const lineLetters = 54;

/** Lines that a picture of unknown size counts: it takes between none and a page, most often some of it. */
const pictureLines = 9;

/** Bytes of markup a line, before any section has been read: the median of books of many makers. */
const usualBytes = 70;

/** How full of lines pages are, before any is laid out, likewise: the rest is between paragraphs and chapters. */
const usualFill = 0.8;

/** The fraction by which an estimate may be off: it is corrected, and made of more text, only beyond that. */
export const mostOff = 0.05;

/** Sections that are read as a book opens, for a guess at its thickness: at the half and the quarters of the text. */
export const openingRead = 3;

/** Sections that are read before the first estimate: at the half, the quarters and so on to the 32nds of the text. */
export const firstRead = 31;

/** Sections that are read at the same time: unpacking one mostly waits. */
const readTogether = 8;

/** Elements whose text is not seen, pictures, and elements with which a line ends. */
const unseen = new Set(["head", "script", "style", "annotation", "annotation-xml"]);
const pictures = new Set(["img", "image", "video"]);
const blocks = new Set(
  "p div h1 h2 h3 h4 h5 h6 li dt dd blockquote pre section article br hr figcaption v subtitle text-author".split(
    " ",
  ),
);

/** An attribute of an element that is not seen, such as a list of a printed book's pages. */
const hiding = /\shidden(?=[\s=/>])/i;

const tag = /<(\/?)([\w:-]{1,40})(?![\w:-])[^<>]*>/g;
const entity = /&#?\w{1,8};/g;
/** Letters that are as wide as two: of Chinese, Japanese and Korean. */
const wide = /[\u1100-\u11ff\u2e80-\u9fff\uac00-\ud7af\uf900-\ufaff\uff00-\uff60]/g;

/**
 * Returns how many lines of usual length the text of some markup takes: each of its paragraphs begins
 * one, preformatted text has its own, and columns of a table are equally wide.
 */
export function linesIn(markup: string): number {
  let [lines, letters, at] = [0, 0, 0];
  let inside = "";
  let isPreformatted = false;
  /** The letters of each paragraph of each cell of a row. */
  let row: number[][] = [];
  const endLine = (): void => {
    const cell = row.at(-1);
    if (cell) cell.push(letters);
    else lines += Math.ceil(letters / lineLetters);
    letters = 0;
  };
  const endRow = (): void => {
    endLine();
    const letterLines = (cell: readonly number[]): number =>
      cell.reduce((sum, count) => sum + Math.ceil((count * row.length) / lineLetters), 0);
    lines += row.reduce((most, cell) => Math.max(most, letterLines(cell)), 0);
    row = [];
  };
  const read = (to: number): void => {
    const text = markup.slice(at, to).replace(entity, "x");
    const parts = isPreformatted ? text.split("\n") : [text.replace(/\s+/g, " ")];
    for (const [k, part] of parts.entries()) {
      // An empty line is as high as another.
      if (k > 0) letters = Math.max(letters, 1);
      if (k > 0) endLine();
      const seen = letters === 0 && !isPreformatted ? part.trimStart() : part;
      letters += seen.length + (seen.match(wide)?.length ?? 0);
    }
  };
  for (const { 0: whole, 1: slash, 2: name = "", index } of markup.matchAll(tag)) {
    if (inside === "") read(index);
    at = index + whole.length;
    const local = name.slice(name.indexOf(":") + 1).toLowerCase();
    const isStart = slash === "" && !whole.endsWith("/>");
    if (inside !== "") {
      if (slash !== "" && local === inside) inside = "";
    } else if (isStart && (unseen.has(local) || hiding.test(whole))) inside = local;
    else if (pictures.has(local) && slash === "") lines += pictureLines;
    else if (local === "tr" || local === "table") endRow();
    else if (local === "td" || local === "th") {
      endLine();
      if (isStart) row.push([]);
    } else if (blocks.has(local)) {
      endLine();
      if (local === "pre") isPreformatted = isStart;
    }
  }
  if (inside === "") read(markup.length);
  endRow();
  return lines;
}

/** How long the sections of a book are, as far as they have been read, for all its editions. */
export class SectionLengths {
  readonly #sections: readonly FlowSection[];
  readonly #lines: (number | undefined)[];
  /** The flowing sections with text, first some that are spread evenly over it. */
  readonly spread: readonly number[];
  /** How many of these are read. */
  #read = 0;

  constructor(sections: readonly FlowSection[]) {
    this.#sections = sections;
    this.spread = spreadOver(sections.map(({ isFixed, length }) => (isFixed ? 0 : length)));
    this.#lines = sections.map(() => undefined);
  }

  /**
   * Reads the sections that are not read yet, in the order of `spread`. Those that cannot be read are of
   * unknown length.
   *
   * @param most after how many it resolves
   */
  async read(signal: AbortSignal, most: number = Number.POSITIVE_INFINITY): Promise<void> {
    const end = Math.min(this.#read + most, this.spread.length);
    while (this.#read < end) {
      const next = this.spread.slice(this.#read, Math.min(this.#read + readTogether, end));
      const read = next.map((section) => this.#sections[section]?.lines().catch(() => undefined));
      const found = await Promise.all(read);
      if (signal.aborted) return;
      for (const [k, section] of next.entries()) this.#lines[section] = found[k];
      this.#read += next.length;
    }
  }

  /** Returns the length of a section in lines of usual length; undefined if it is not read. */
  known(section: number): number | undefined {
    return this.#lines[section];
  }

  /** Returns each section's length in lines of usual length: of one that is not read, by its bytes. */
  lines(): number[] {
    let [bytes, lines] = [0, 0];
    for (const [section, known] of this.#lines.entries()) {
      if (known === undefined) continue;
      bytes += this.#sections[section]?.length ?? 0;
      lines += known;
    }
    const perByte = bytes > 0 && lines > 0 ? lines / bytes : 1 / usualBytes;
    return this.#sections.map(({ length }, section) => this.#lines[section] ?? length * perByte);
  }
}

/**
 * Returns the parts of a whole in an order in which the first few are spread evenly over it: those at
 * its half, its quarters, its eighths and so on, then the others. Parts of no length are left out.
 */
function spreadOver(lengths: readonly number[]): number[] {
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  const parts = [...lengths.keys()].filter((part) => (lengths[part] ?? 0) > 0);
  const found = new Set<number>();
  for (let divisor = 2; divisor <= parts.length; divisor *= 2) {
    let next = 1;
    let end = 0;
    for (const part of parts) {
      end += lengths[part] ?? 0;
      while (next < divisor && (next / divisor) * whole < end) {
        found.add(part);
        next += 2;
      }
    }
  }
  for (const part of parts) found.add(part);
  return [...found];
}

/** A piece of a section that is laid out: its lines of usual length, and how many pages they fill. */
export interface LaidSample {
  readonly lines: number;
  readonly extent: number;
}

/**
 * Returns whether pieces, two or more, have so nearly as many lines on a page that an estimate by
 * their mean is off by no more than it may be: by the standard error of that.
 */
export function areAlike(samples: readonly LaidSample[]): boolean {
  const onPage = samples.map(({ lines, extent }) => lines / extent);
  const count = onPage.length;
  const mean = onPage.reduce((sum, lines) => sum + lines, 0) / count;
  const squares = onPage.reduce((sum, lines) => sum + (lines - mean) ** 2, 0);
  return count > 1 && Math.sqrt(squares / (count - 1) / count) <= mostOff * mean;
}

/**
 * Returns each section's number of pages, known or estimated: by its lines, and by how many of those a
 * page has in what is laid out next to it.
 *
 * @param known what is known of each section; undefined if it is not laid out
 * @param samples pieces of other sections that are laid out, by section
 */
export function estimatePages(
  sections: readonly FlowSection[],
  lengths: SectionLengths,
  known: readonly (Pick<SectionMap, "pageCount" | "extent"> | undefined)[],
  typography: Typography,
  samples: ReadonlyMap<number, LaidSample>,
): number[] {
  const onPage = linesOnPage(typography);
  const lines = lengths.lines();
  /** Lines before the middle of each section. */
  const middles: number[] = [];
  let before = 0;
  for (const length of lines) {
    middles.push(before + length / 2);
    before += length;
  }
  const laid = [...sections.keys()].flatMap((section) => {
    const extent = known[section]?.extent;
    const own = lengths.known(section);
    const sample =
      extent !== undefined && own !== undefined ? { lines: own, extent } : samples.get(section);
    // A cover or a title says nothing of the others' text.
    if (sample === undefined || sample.lines < onPage / 2) return [];
    return [{ middle: middles[section] ?? 0, perPage: sample.lines / sample.extent }];
  });
  let nearest = 0;
  return sections.map(({ isFixed }, section) => {
    const middle = middles[section] ?? 0;
    const away = (k: number): number => Math.abs((laid[k]?.middle ?? Infinity) - middle);
    while (away(nearest + 1) < away(nearest)) nearest += 1;
    const perPage = laid[nearest]?.perPage ?? usualFill * onPage;
    const estimate = isFixed ? 1 : Math.max(Math.ceil((lines[section] ?? 0) / perPage), 1);
    return known[section]?.pageCount ?? estimate;
  });
}

/** Returns how many lines of usual length fit on a page. */
export function linesOnPage(typography: Typography): number {
  const { width, height, sides, ends } = measuresOf(typography);
  const area = (width - 2 * sides) * (height - 2 * ends);
  const { lineHeight } = typography;
  const line = lineHeight > 0 ? 16 * lineHeight : usualType.line;
  return area / (line * usualType.letter * lineLetters);
}
