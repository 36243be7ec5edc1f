/** What MOBI and KF8 have in common: what their text is read from, and what becomes of it. */

import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { parseMarkup } from "../markup/parse_markup.ts";
import type { FlowOutline, FlowSection, FlowTarget } from "../typeset/flow_book.ts";
import type { IndexTable } from "./index_table.ts";
import type { KindleHeader } from "./kindle_header.ts";
import type { KindleResources } from "./kindle_resources.ts";
import type { ReadRecord } from "./text_records.ts";

/** What both kinds of books are read from. */
export interface KindleParts {
  readonly name: string;
  readonly header: KindleHeader;
  /** All text, unpacked. */
  readonly text: Uint8Array<ArrayBuffer>;
  readonly resources: KindleResources;
  /** Returns a record of this part of the file. */
  readonly read: ReadRecord;
  /** Returns the table at a record. */
  readonly table: (record: number) => Promise<IndexTable>;
}

/** What the two kinds differ in. */
export interface KindleText {
  readonly sections: readonly FlowSection[];
  readonly outline: readonly FlowOutline[];
  /** Whether the first section is the cover's picture; undefined for pages of fixed layout. */
  readonly isCovered?: boolean;
  resolve(href: string): FlowTarget | null;
}

/** Returns text whose letters may be written as entities of HTML. */
export function plainText(text: string): string {
  const short = text.slice(0, 8 * limits.titleLength);
  return cleanText(parseMarkup(short.replaceAll("<", "&lt;"), "text/html").body.textContent);
}

/** Returns the lines of the contents, from entries that name their parents. */
export function outlineOf(
  { entries, text }: IndexTable,
  targetOf: (numbers: (tag: number) => readonly number[]) => FlowTarget | null,
): FlowOutline[] {
  const roots: FlowOutline[] = [];
  const lines: FlowOutline[][] = [];
  entries.slice(0, limits.outlineEntries).forEach(({ numbers }, index) => {
    const children: FlowOutline[] = [];
    lines.push(children);
    const parent = numbers(21)[0];
    const title = plainText(text(numbers(3)[0])) || "–";
    const target = targetOf(numbers);
    const line = { title, target, isLost: target === null, children };
    // Parents come before their children, so that there is no circle.
    const siblings = parent === undefined || parent >= index ? roots : (lines[parent] ?? roots);
    siblings.push(line);
  });
  return roots;
}
