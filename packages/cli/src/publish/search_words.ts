/** The words by which books are found: the same in the index and in the reader's query. */

/** Characters of a word that count; longer ones are no words of a language. */
const longest = 40;

/** Marks that a reader may leave out. */
const accents = /\p{Mn}/gu;

/** Scripts without spaces between words. */
const unspaced =
  "\\p{Script=Han}\\p{Script=Hiragana}\\p{Script=Katakana}\\p{Script=Thai}\\p{Script=Lao}\\p{Script=Khmer}\\p{Script=Myanmar}";
const run = `[${unspaced}\u30fc]+`;
const letters = `(?:(?![${unspaced}])[\\p{L}\\p{N}\\p{M}])+`;
const apostrophe = "['\u2019]";
const words = new RegExp(`(${run})|${letters}(?:${apostrophe}${letters})*`, "gu");

/**
 * Returns the words of a text, each as it is compared: without case and
 * accents. Scripts without spaces between words yield pairs of characters.
 */
export function searchWords(text: string): string[] {
  const found: string[] = [];
  for (const [match, unspacedRun] of text.normalize("NFKC").matchAll(words)) {
    const word = foldWord(match);
    if (unspacedRun !== undefined) found.push(...pairsOf(word));
    else if (word !== "") found.push([...word].slice(0, longest).join(""));
  }
  return found;
}

function foldWord(word: string): string {
  return word
    .normalize("NFKD")
    .toUpperCase()
    .toLowerCase()
    .normalize("NFKD")
    .replace(accents, "")
    .replace(/['\u2019]/g, "")
    .normalize("NFC");
}

function pairsOf(run: string): string[] {
  const characters = [...run];
  if (characters.length === 1) return characters;
  return characters.slice(1).map((character, k) => `${characters[k]}${character}`);
}
