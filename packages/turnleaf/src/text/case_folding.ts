/** Folds text for comparison in a search: case, accents, ligatures and hyphens do not count. */

import type { TextRun } from "../sources/page_source.ts";

/** Marks on letters that a reader may leave out; vowels of Indic scripts and voiced kana are letters of their own. */
const accents =
  /(?![\u3099\u309a])(?=[\p{Script=Inherited}\p{Script=Hebrew}\p{Script=Arabic}])\p{Mn}/gu;
const singleQuotes = /[\u2018-\u201b\u2032\u02bc]/g;
const doubleQuotes = /[\u201c-\u201f\u2033\u00ab\u00bb]/g;
const hyphens = /[\u2010\u2011\u2212\u00ad]/g;
/** Dashes separate words as spaces do. */
const dashes = /[\u2012-\u2015]/g;
/** Scripts without spaces between words, so that a line ends anywhere. */
const unspaced =
  /[\p{Script=Han}\p{Script=Hiragana}\p{Script=Katakana}\u3000-\u303f\uff00-\uffef]/u;
const letter = /[\p{L}\p{M}]/u;

/** Returns whether there is no space between two characters where a line ends between them. */
export function isRunOn(before: string, after: string): boolean {
  return unspaced.test(before) && unspaced.test(after);
}

/** Folded text, and where in the page's runs each of its characters is. */
export interface FoldedText {
  readonly text: string;
  /** Index of the run, and the character's place in it, for each character of `text`. */
  readonly runs: readonly number[];
  readonly places: readonly number[];
}

/** Returns one character as it is compared; may be several, or none. */
function foldCharacter(character: string): string {
  // Most text is plain, and a book has millions of characters.
  if (character < "\u0080") return character.toLowerCase();
  if (character >= "\u4e00" && character <= "\u9fff") return character;
  return character
    .normalize("NFKD")
    .toUpperCase()
    .toLowerCase()
    .normalize("NFKD")
    .replace(accents, "")
    .replace(singleQuotes, "'")
    .replace(doubleQuotes, '"')
    .replace(hyphens, "-")
    .replace(dashes, " ")
    .normalize("NFC");
}

/** Returns the text of a page's runs, folded into one line. */
export function foldRuns(runs: readonly Pick<TextRun, "text" | "end">[]): FoldedText {
  let text = "";
  const runsAt: number[] = [];
  const placesAt: number[] = [];
  let last = "";
  const put = (characters: string, run: number, place: number): void => {
    text += characters;
    for (let k = 0; k < characters.length; k++) {
      runsAt.push(run);
      placesAt.push(place);
    }
    last = characters;
  };
  /** A pending space, which counts only between two letters. */
  let space = false;
  let broken = 0;
  for (const [run, { text: said, end }] of runs.entries()) {
    let place = 0;
    for (const character of said) {
      const folded = foldCharacter(character);
      if (folded === "-") broken++;
      else if (folded.trim() === "") space ||= folded !== "";
      else {
        const between = broken > 0 || space;
        if (between && last !== "") {
          const isJoined = letter.test(last) && letter.test(folded) && broken === 1 && !space;
          const isOneWord = isJoined || (broken === 0 && isRunOn(last, folded));
          if (!isOneWord) put(broken > 0 ? "-".repeat(broken) : " ", run, place);
        }
        put(folded, run, place);
        space = false;
        broken = 0;
      }
      place += character.length;
    }
    // A hyphen at a line's end stands for nothing but the end itself.
    if (end && broken === 0) space = true;
  }
  return { text, runs: runsAt, places: placesAt };
}

/** Returns a query, folded as the text that is searched. */
export function foldQuery(query: string): string {
  return foldRuns([{ text: query, end: false }]).text;
}
