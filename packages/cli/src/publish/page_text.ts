/** The text of a page as paragraphs, for readers without JavaScript and for search engines. */

import type { SiteRun } from "./site_book.ts";

/** Gap between lines from which on a paragraph begins, in heights of a line. */
const paragraphGap = 1.75;
/** Indent from which on a paragraph begins, in heights of a line. */
const paragraphIndent = 0.8;

/** A line of a page. */
export interface Line {
  readonly text: string;
  /** Where it begins, and how high its letters are. */
  readonly x: number;
  readonly y: number;
  readonly height: number;
  readonly isUpright: boolean;
  /** The upright box around it: left, upper, right and lower edge. */
  readonly box: readonly [number, number, number, number];
}

/** Returns the paragraphs of a page: lines joined, words that a line's end divides made whole. */
export function paragraphsOf(runs: readonly SiteRun[]): string[] {
  const paragraphs: string[] = [];
  let before: Line | null = null;
  for (const line of linesOf(runs)) {
    const text = line.text.replace(/\s+/g, " ").trim();
    if (text === "") continue;
    const last = paragraphs.at(-1);
    if (last === undefined || before === null || begins(before, line)) paragraphs.push(text);
    else paragraphs[paragraphs.length - 1] = joined(last, text);
    before = line;
  }
  return paragraphs;
}

/** Returns the lines of a page. */
export function linesOf(runs: readonly SiteRun[]): Line[] {
  const lines: Line[] = [];
  let isOpen = false;
  for (const run of runs) {
    const [text, x, y, , height, angle, flags] = run;
    const box = boxAround(run);
    const line = isOpen ? lines.pop() : undefined;
    if (line) lines.push({ ...line, text: line.text + text, box: union(line.box, box) });
    else lines.push({ text, x, y, height, isUpright: angle === 0 && (flags & 2) === 0, box });
    isOpen = (flags & 1) === 0;
  }
  return lines;
}

/** Returns the upright box around a run, which is turned about its first corner. */
function boxAround([, x, y, width, height, angle]: SiteRun): Line["box"] {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const across = [0, width * cos, -height * sin, width * cos - height * sin];
  const down = [0, width * sin, height * cos, width * sin + height * cos];
  const [left, upper] = [x + Math.min(...across), y + Math.min(...down)];
  return [left, upper, x + Math.max(...across), y + Math.max(...down)];
}

function union(a: Line["box"], b: Line["box"]): Line["box"] {
  return [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
}

/** Whether a line begins a paragraph. Turned and vertical lines go on without one. */
function begins(before: Line, line: Line): boolean {
  if (!before.isUpright || !line.isUpright) return before.isUpright !== line.isUpright;
  const height = Math.max(before.height, line.height, 1e-9);
  const down = line.y - before.y;
  if (down < -height || down > paragraphGap * height) return true;
  const isSameSize = Math.abs(before.height - line.height) < 0.3 * height;
  return !isSameSize || (down > 0.5 * height && line.x - before.x > paragraphIndent * height);
}

function joined(text: string, next: string): string {
  if (/\p{L}[-\u2010\u00ad]$/u.test(text) && /^\p{L}/u.test(next)) {
    // Before a capital the hyphen is the word's own, as in a double name.
    return (/^\p{Ll}/u.test(next) ? text.slice(0, -1) : text) + next;
  }
  const isUnspaced = /[\p{Script=Han}\p{Script=Hiragana}\p{Script=Katakana}\u3000-\u303f]$/u.test(
    text,
  );
  return isUnspaced ? text + next : `${text} ${next}`;
}
