/** Where words of a text begin and end. */

import { expect, test } from "vitest";
import { wordAround } from "./word_bounds.ts";

test.each([
  ["Call me Ishmael.", 5, "me"],
  ["Call me Ishmael.", 0, "Call"],
  // On the space after a word, and on the mark at the end.
  ["Call me Ishmael.", 4, "Call"],
  ["Call me Ishmael.", 15, "Ishmael"],
  ["“Don’t", 0, "Don’t"],
  // A line's end divides it.
  ["circum\u00adambulate", 9, "circum\u00adambulate"],
  ["吾輩は猫である", 3, "猫"],
  ["--- ---", 3, " "],
  ["", 0, ""],
])("of %j at %i it is %j", (text, at, word) => {
  const { from, to } = wordAround(text, at);
  expect(text.slice(from, to)).toBe(word);
});
