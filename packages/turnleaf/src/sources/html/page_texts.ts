/** What the text of elements says, to be found and to lead to pages. */

import { cleanRun, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import type { OutlineEntry, TextRun } from "../page_source.ts";

/** Returns the text that a page shows, a run for each line of each piece of text. */
export function textIn(page: HTMLElement): TextRun[] {
  const around = page.getBoundingClientRect();
  const scale = around.width > 0 ? page.offsetWidth / around.width : 1;
  const document = page.ownerDocument;
  const walker = document.createTreeWalker(page, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  const runs: TextRun[] = [];
  for (let node = walker.nextNode(); node && runs.length < limits.runs; node = walker.nextNode()) {
    const value = node.nodeValue ?? "";
    if (value.trim() === "" || node.parentElement?.closest("script, style, textarea")) continue;
    for (const [from, to] of linesOf(value, (at) => topOf(range, node, at))) {
      range.setStart(node, from);
      range.setEnd(node, to);
      const { left, top, width, height } = range.getBoundingClientRect();
      const text = cleanRun(value.slice(from, to)).replace(/\s+/g, " ");
      if (width === 0 || height === 0 || text.trim() === "") continue;
      const [x, y] = [(left - around.left) * scale, (top - around.top) * scale];
      runs.push({ text, x, y, width: width * scale, height: height * scale, angle: 0, end: true });
    }
  }
  return runs.filter(
    ({ x, y, width, height }) =>
      x < page.offsetWidth && y < page.offsetHeight && x + width > 0 && y + height > 0,
  );
}

/** Returns where a word's first letter is seen from above; null if it is not shown. */
function topOf(range: Range, node: Node, at: number): number | null {
  range.setStart(node, at);
  range.setEnd(node, at + 1);
  const { height, bottom } = range.getBoundingClientRect();
  return height > 0 ? bottom : null;
}

/** Divides a text into lines: where a word's letters stand lower than those of the word before. */
function* linesOf(
  text: string,
  bottomAt: (at: number) => number | null,
): Generator<readonly [from: number, to: number]> {
  let from = 0;
  let line: number | null = null;
  for (const { index } of text.slice(0, limits.textLength).matchAll(/\S+/g)) {
    const bottom = bottomAt(index);
    if (bottom === null) continue;
    if (line !== null && Math.abs(bottom - line) > 1) {
      yield [from, index];
      from = index;
    }
    line = bottom;
  }
  yield [from, text.length];
}

/** Returns the contents that the headings of pages make. */
export function headingsIn(pages: readonly HTMLElement[]): OutlineEntry[] {
  const top: OutlineEntry[] = [];
  const open: { readonly level: number; readonly children: OutlineEntry[] }[] = [];
  let count = 0;
  for (const [index, page] of pages.entries()) {
    for (const heading of page.querySelectorAll("h1, h2, h3")) {
      const title = cleanText(heading.textContent);
      if (title === "" || ++count > limits.outlineEntries) continue;
      const level = Number(heading.localName[1]);
      while ((open.at(-1)?.level ?? 0) >= level) open.pop();
      const children: OutlineEntry[] = [];
      (open.at(-1)?.children ?? top).push({ title, page: index + 1, children });
      open.push({ level, children });
    }
  }
  return top;
}
