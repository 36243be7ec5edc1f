import { describe, expect, it } from "vitest";
import { type Letter, placeLetters } from "./pdf_letters.ts";

/** Letters of strings in a font whose letters are all half as wide as high; "_" is a kern of half a letter. */
function shown(...strings: string[]): Letter[] {
  return strings.flatMap((text, group) => {
    const letters: Letter[] = [];
    for (const unit of text) {
      const last = letters.length - 1;
      if (unit === "_") letters[last] = { ...letters[last], kern: letters[last].kern + 0.25 };
      else letters.push({ unit, advance: 0.5, kern: 0, group });
    }
    return letters;
  });
}

/** Places in lengths of letters; the line is `width` letters long. */
function places(text: string, width: number, letters: readonly Letter[]): number[] | null {
  const [found] = placeLetters([{ text, width: width / 2, em: 1 }], letters);
  return found === null ? null : found.map((place) => Math.round(place * width * 100) / 100);
}

describe("letters of a line", () => {
  it("stand where the page shows them", () => {
    expect(places("abc", 3, shown("abc"))).toEqual([0, 1, 2]);
    expect(places("ab cd", 5.5, shown("ab_ cd"))).toEqual([0, 1, 2.5, 3.5, 4.5]);
  });

  it("are found though spaces are not shown, or more are", () => {
    expect(places("ab cd", 4.5, shown("ab_cd"))).toEqual([0, 1, 2.5, 2.5, 3.5]);
    expect(places("abcd", 5, shown("ab cd"))).toEqual([0, 1, 3, 4]);
  });

  it("divide the space between strings among the gaps", () => {
    expect(places("ab cd e", 9, shown("ab", "cd", "e"))).toEqual([0, 1, 2, 4, 5, 6, 8]);
  });

  it("are found behind what is no text, line after line", () => {
    const letters = shown("xyz", "ab", "abc", "d");
    const lines = ["abc", "d"].map((text) => ({ text, width: text.length / 2, em: 1 }));
    expect(placeLetters(lines, letters)).toEqual([[0, 1 / 3, 2 / 3], [0]]);
  });

  it("are not made up", () => {
    expect(places("abc", 3, shown("abd"))).toBeNull();
    expect(places("abc", 3, shown("ab"))).toBeNull();
    expect(places("abc", 3, [])).toBeNull();
    const nothing = shown("abc").map((letter) => ({ ...letter, advance: 0 }));
    expect(places("abc", 3, nothing)).toBeNull();
    for (const place of placeLetters([{ text: "ab", width: Number.NaN, em: 0 }], shown("a", "b"))) {
      expect(place?.some(Number.isNaN) ?? false).toBe(false);
    }
  });
});
