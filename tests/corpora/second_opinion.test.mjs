/** What the judge of collections compares texts by. */

import { expect, test } from "vitest";
import { lettersOf } from "./second_opinion.js";

test("a mark joins the letter before it, whatever blanks or brackets are between them", () => {
  for (const text of ["\u00c2", "A\u0302", "A\n  \u0302", "(A)\u0302"]) {
    expect(lettersOf(`Let ${text} be`)).toBe("Let\u00c2be");
  }
});

test("a mark that is lost or stands elsewhere is a difference", () => {
  const letters = ["AB", "A \u0302B", "AB \u0302", "\u0302 AB", "A \u0301B"].map(lettersOf);
  expect(new Set(letters).size).toBe(letters.length);
});
