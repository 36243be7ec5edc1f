/** Plain text as paragraphs: which ends of lines are of the text, and which of the width it was typed in. */

/** A paragraph, or lines that stay as they are. */
export interface PlainBlock {
  readonly text: string;
  /** Whether its ends of lines, and its spaces, are kept. */
  readonly isSet: boolean;
}

/** Characters of a line, from which on nobody has wrapped it by hand: it is a paragraph. */
const longestWrapped = 120;

/** The part of the usual width from which on a line was full: its end is none of the text. */
const full = 0.7;

/** Lines by which the usual width is measured. */
const mostMeasured = 10_000;

/** What begins a paragraph: typists indent it by spaces, and East Asian texts by one or two of a letter's width. */
const indent = /^[ \t\u3000]+(?=\S)/;
const wideIndent = /^[ \t]*\u3000/;

/** Lines that are placed by spaces. */
const placed = /^(?: {2,}|\t)\S/m;

/** An end of a line between letters of scripts that have no spaces between words. */
const wideEnd =
  /(?<=[\p{Script=Han}\p{Script=Hiragana}\p{Script=Katakana}\u3000-\u303f\uff00-\uffef])\n(?=[\p{Script=Han}\p{Script=Hiragana}\p{Script=Katakana}\u3000-\u303f\uff00-\uffef])/gu;

/** Returns text without ends of lines that are no spaces: those between Chinese or Japanese letters. */
export function withoutWideEnds(text: string): string {
  return text.replace(wideEnd, "");
}

/** Returns the blocks of each page of a text: a form feed begins another page. */
export function pagesOf(text: string): PlainBlock[][] {
  const isSpaced = /\n[ \t]*\n/.test(text);
  const linesOf = (part: string): string[] => part.split("\n").filter((line) => line.trim() !== "");
  const pages = text
    .split("\f")
    .map((page) => (isSpaced ? page.split(/\n(?:[ \t]*\n)+/) : [page]).map(linesOf));
  const { width, isWrapped } = wrappingOf(pages.flat());
  const blocksOf = (lines: readonly string[]): PlainBlock[] => {
    if (width > longestWrapped) return lines.map((line) => asParagraph([line]));
    const paragraphs = indentedParagraphs(lines, width);
    if (paragraphs) return paragraphs;
    // Without blank lines each line is a paragraph.
    if (!isSpaced) return lines.map((text) => ({ text, isSet: placed.test(text) }));
    const isFull = (line: string): boolean => line.trim().length >= full * width;
    const isSet = lines.length > 1 && !(isWrapped && lines.some(isFull));
    const text = lines.join("\n");
    return [isSet || placed.test(text) ? { text, isSet: true } : asParagraph(lines)];
  };
  return pages.map((parts) => parts.flatMap(blocksOf));
}

/**
 * Returns the width to which nine of ten lines are wrapped, of those that are followed by one at the margin,
 * and whether they are: three of four are full.
 */
function wrappingOf(parts: readonly (readonly string[])[]): {
  readonly width: number;
  readonly isWrapped: boolean;
} {
  const lengths: number[] = [];
  for (const lines of parts) {
    for (let k = 1; k < lines.length && lengths.length < mostMeasured; k++) {
      if (!indent.test(lines[k] as string)) lengths.push((lines[k - 1] as string).trim().length);
    }
  }
  lengths.sort((a, b) => a - b);
  const width = lengths[Math.floor(0.9 * lengths.length)] ?? 0;
  const count = lengths.filter((length) => length >= full * width).length;
  return { width, isWrapped: count >= 0.75 * lengths.length };
}

/** Returns the paragraphs of lines of which the first of each is indented; null if an indent means something else. */
function indentedParagraphs(lines: readonly string[], width: number): PlainBlock[] | null {
  if (lines.some((line) => wideIndent.test(line))) return grouped(lines);
  const begins = lines.map((line) => indent.test(line));
  const isFull = (line: string): boolean => line.trimEnd().length >= full * width;
  const goOn = lines.filter((_, k) => k + 1 < lines.length && !begins[k + 1]);
  // A verse whose other lines are indented has short ones.
  const isWrapped = begins[0] && goOn.length > 0 && goOn.every(isFull);
  return isWrapped ? grouped(lines) : null;
}

function grouped(lines: readonly string[]): PlainBlock[] {
  const paragraphs: string[][] = [];
  for (const line of lines) {
    if (indent.test(line) || paragraphs.length === 0) paragraphs.push([line]);
    else paragraphs.at(-1)?.push(line);
  }
  return paragraphs.map(asParagraph);
}

/** Returns lines as one paragraph, without the spaces about them. */
function asParagraph(lines: readonly string[]): PlainBlock {
  const joined = lines.map((line) => line.trim()).join("\n");
  return { text: withoutWideEnds(joined).replaceAll("\n", " "), isSet: false };
}
