import type { PDFPageProxy } from "pdfjs-dist";
import type { PdfLibrary } from "./pdf_runtime.ts";

/** A character as a page shows it; its lengths as fractions of the font's size. */
export interface Letter {
  /** One UTF-16 unit. */
  readonly unit: string;
  readonly advance: number;
  /** The extra distance to the next one. */
  readonly kern: number;
  /** Letters of one string have the same number; between two strings anything may happen. */
  readonly group: number;
}

/** A piece of text whose letters are searched for: its length and its font's size in one unit. */
interface Line {
  readonly text: string;
  readonly width: number;
  readonly em: number;
}

/**
 * How far ahead a line's letters are searched for: pages show things that are
 * not text, or another line's.
 */
const lookAhead = 3000;

type Glyph = { unicode?: unknown; width?: unknown; isSpace?: unknown } | number | null;

/** Returns the letters of a page in the order in which they are shown. Rejects as pdf.js does. */
export async function lettersOfPage(pdfjs: PdfLibrary, page: PDFPageProxy): Promise<Letter[]> {
  const { OPS } = pdfjs;
  const { fnArray, argsArray } = await page.getOperatorList();
  const letters: Letter[] = [];
  let state = { size: 1, letter: 0, word: 0 };
  const saved: (typeof state)[] = [];
  let group = 0;
  let images = 0;
  for (let k = 0; k < fnArray.length; k++) {
    const args = argsArray[k];
    switch (fnArray[k]) {
      case OPS.save:
        saved.push(state);
        break;
      case OPS.restore:
        state = saved.pop() ?? state;
        break;
      case OPS.setFont:
        state = { ...state, size: Math.abs(Number(args[1])) || 1 };
        break;
      case OPS.setCharSpacing:
        state = { ...state, letter: Number(args[0]) || 0 };
        break;
      case OPS.setWordSpacing:
        state = { ...state, word: Number(args[0]) || 0 };
        break;
      case OPS.showText:
        group++;
        for (const glyph of args[0] as readonly Glyph[]) {
          if (typeof glyph === "number") {
            const last = letters.at(-1);
            if (last?.group !== group) continue;
            letters[letters.length - 1] = { ...last, kern: last.kern - glyph / 1000 };
          } else if (typeof glyph?.unicode === "string") {
            const spaces = state.letter + (glyph.isSpace ? state.word : 0);
            // A ligature stands for several letters.
            const text = glyph.unicode.normalize("NFKC");
            const advance = (Number(glyph.width) || 0) / 1000 / text.length;
            for (let at = 0; at < text.length; at++) {
              const kern = at === text.length - 1 ? spaces / state.size : 0;
              letters.push({ unit: text[at], advance, kern, group });
            }
          }
        }
        break;
      case OPS.paintImageXObject:
        images++;
    }
  }
  // A scan's image was decoded a second time for this, and is freed.
  if (images > 0) page.cleanup();
  return letters;
}

/**
 * Returns where each letter of each line begins, as a fraction of the line's
 * length; null if a line's letters are not found one after the other.
 */
export function placeLetters(
  lines: readonly Line[],
  letters: readonly Letter[],
): (readonly number[] | null)[] {
  let next = 0;
  return lines.map((line) => {
    const wanted = line.text.replace(/\s/g, "").slice(0, 6);
    for (let from = next; from < letters.length && from < next + lookAhead; from++) {
      const found = startsAt(letters, from, wanted) ? follow(line, letters, from) : null;
      if (found === null) continue;
      next = found.next;
      return found.places;
    }
    return null;
  });
}

function startsAt(letters: readonly Letter[], from: number, wanted: string): boolean {
  for (let k = 0, at = from; k < wanted.length; at++) {
    const unit = letters[at]?.unit;
    if (unit === wanted[k]) k++;
    else if (k === 0 || unit?.trim() !== "") return false;
  }
  return true;
}

/** Matches a line letter by letter from a letter on. */
function follow(
  { text, width, em }: Line,
  letters: readonly Letter[],
  from: number,
): { places: number[]; next: number } | null {
  const places: number[] = [];
  /** Characters before which another string begins: the width of such a gap is unknown. */
  const gaps: number[] = [];
  let [at, x, end] = [from, 0, 0];
  for (let k = 0; k < text.length; k++) {
    places.push(x);
    if (text[k].trim() === "") continue;
    for (let isFound = false; !isFound; at++) {
      const letter = letters[at];
      if (letter === undefined) return null;
      if (at > from && letter.group !== letters[at - 1].group) gaps.push(k);
      isFound = letter.unit === text[k];
      if (isFound) places[k] = x;
      // Visible spaces count; anything else is another line.
      else if (letter.unit.trim() !== "") return null;
      x += letter.advance;
      if (isFound) end = x;
      x += letter.kern;
    }
  }
  const space = gaps.length > 0 ? (width / em - end) / gaps.length : 0;
  const length = end + space * gaps.length;
  if (!(length > 0)) return null;
  let passed = 0;
  const fractions = places.map((place, k) => {
    while (gaps[passed] <= k) passed++;
    return Math.min(Math.max((place + space * passed) / length, 0), 1);
  });
  return { places: fractions, next: at };
}
