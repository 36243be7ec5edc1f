/** Estimates how many pages the sections of a book take before they are laid out. */

import type { Typography } from "../page_source.ts";
import type { FlowSection } from "./flow_book.ts";
import type { SectionMap } from "./laid_section.ts";
import { measuresOf, usualType } from "./page_measures.ts";

/** Letters of a line of print in which sections are measured: those of a page of usual type. */
const lineLetters = 54;

/** Lines that a picture of unknown size counts: it takes between none and a page, most often some of it. */
const pictureLines = 9;

/** Bytes of markup a line, before any section has been read: prose with little markup. */
const usualBytes = 65;

/** Elements whose text is not seen, pictures, and elements with which a line ends. */
const unseen = new Set(["head", "script", "style", "annotation", "annotation-xml"]);
const pictures = new Set(["img", "image", "video"]);
const blocks = new Set(
  "p div h1 h2 h3 h4 h5 h6 li tr dt dd blockquote pre section article br hr figcaption v subtitle text-author".split(
    " ",
  ),
);

const tag = /<(\/?)([\w:-]{1,40})(?![\w:-])[^<>]*>/g;
const entity = /&#?\w{1,8};/g;
/** Letters that are as wide as two: of Chinese, Japanese and Korean. */
const wide = /[\u1100-\u11ff\u2e80-\u9fff\uac00-\ud7af\uf900-\ufaff\uff00-\uff60]/g;

/** Returns how many lines of usual length the text of some markup takes: each of its paragraphs begins one. */
export function linesIn(markup: string): number {
  let [lines, letters, at] = [0, 0, 0];
  let inside = "";
  const read = (to: number): void => {
    const text = markup.slice(at, to).replace(entity, "x").replace(/\s+/g, " ");
    const seen = letters === 0 ? text.trimStart() : text;
    letters += seen.length + (seen.match(wide)?.length ?? 0);
  };
  const endLine = (): void => {
    lines += Math.ceil(letters / lineLetters);
    letters = 0;
  };
  for (const { 0: whole, 1: slash, 2: name = "", index } of markup.matchAll(tag)) {
    if (inside === "") read(index);
    at = index + whole.length;
    const local = name.slice(name.indexOf(":") + 1).toLowerCase();
    if (inside !== "") {
      if (slash !== "" && local === inside) inside = "";
    } else if (unseen.has(local) && slash === "" && !whole.endsWith("/>")) inside = local;
    else if (pictures.has(local) && slash === "") lines += pictureLines;
    else if (blocks.has(local)) endLine();
  }
  if (inside === "") read(markup.length);
  endLine();
  return lines;
}

/** How long the sections of a book are, as far as they have been read, for all its editions. */
export class SectionLengths {
  readonly #sections: readonly FlowSection[];
  readonly #lines: (number | undefined)[];

  constructor(sections: readonly FlowSection[]) {
    this.#sections = sections;
    this.#lines = sections.map(() => undefined);
  }

  /** Reads every section once. Resolves when all are read; those that cannot be are of unknown length. */
  async read(signal: AbortSignal): Promise<void> {
    for (const [section, { isFixed, lines }] of this.#sections.entries()) {
      if (isFixed) continue;
      const found = await lines().catch(() => undefined);
      if (signal.aborted) return;
      this.#lines[section] = found;
    }
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

/** A piece of a book that is laid out: its lines of usual length, and how many pages they fill. */
export interface LaidSample {
  readonly lines: number;
  readonly extent: number;
}

/**
 * Returns each section's number of pages, known or estimated: by its lines, and by how many of
 * those a page has in what is laid out.
 *
 * @param lines of each section
 * @param known what is known of each section; undefined if it is not laid out
 * @param sample a piece that is laid out besides; null if none is
 */
export function estimatePages(
  sections: readonly FlowSection[],
  lines: readonly number[],
  known: readonly (Pick<SectionMap, "pageCount" | "extent"> | undefined)[],
  typography: Typography,
  sample: LaidSample | null,
): number[] {
  const onPage = linesOnPage(typography);
  let [taken, filled] = [sample?.lines ?? 0, sample?.extent ?? 0];
  for (const [section, map] of known.entries()) {
    const length = lines[section] ?? 0;
    // A cover or a title says nothing of the others' text.
    if (map === undefined || sections[section]?.isFixed || length < onPage / 2) continue;
    taken += length;
    filled += map.extent;
  }
  const perPage = taken > 0 ? taken / filled : onPage;
  return sections.map(({ isFixed }, section) => {
    const estimate = isFixed ? 1 : Math.max(Math.ceil((lines[section] ?? 0) / perPage), 1);
    return known[section]?.pageCount ?? estimate;
  });
}

/**
 * Returns the section in which the middle of the flowing text lies: it is most likely set as most of it
 * is, where a list of contents or an index is not. Undefined if there is no flowing text.
 */
export function middleSection(
  sections: readonly FlowSection[],
  lines: readonly number[],
): number | undefined {
  const flowing = lines.map((count, section) => (sections[section]?.isFixed ? 0 : count));
  const half = flowing.reduce((sum, count) => sum + count, 0) / 2;
  let before = 0;
  const found = flowing.findIndex((count) => {
    before += count;
    return before > half;
  });
  return found < 0 ? undefined : found;
}

/** Returns how many lines of usual length fit on a page. */
function linesOnPage(typography: Typography): number {
  const { width, height, sides, ends } = measuresOf(typography);
  const area = (width - 2 * sides) * (height - 2 * ends);
  const { lineHeight } = typography;
  const line = lineHeight > 0 ? 16 * lineHeight : usualType.line;
  return area / (line * usualType.letter * lineLetters);
}
