import { expect, it } from "vitest";
import type { Typography } from "../page_source.ts";
import type { FlowSection } from "./flow_book.ts";
import { keptCounts, readCounts } from "./kept_counts.ts";

/** Sections of some lengths. */
const sections = (...lengths: number[]) => lengths.map((length) => ({ length }) as FlowSection);

const book = sections(120, 4000, 77);
const setting: Typography = {
  font: "",
  size: 1,
  lineHeight: 0,
  margins: 1,
  align: "",
  hyphens: "",
  letterSpacing: 0,
  wordSpacing: 0,
  width: 500,
};

it("gives back the numbers of pages of the same book, set alike", () => {
  const kept = keptCounts(book, setting, [1, 12, 3]) ?? "";
  expect(readCounts(kept, book, { ...setting })).toEqual([1, 12, 3]);
  expect(readCounts(kept, book, { ...setting, size: 1.1 })).toBe(null);
  expect(readCounts(kept, book, { ...setting, width: 501 })).toBe(null);
  expect(readCounts(kept, sections(120, 4001, 77), setting)).toBe(null);
  expect(readCounts(kept, sections(120, 4000), setting)).toBe(null);
});

it("takes nothing else, and keeps no text that is long", () => {
  const hash = keptCounts(book, setting, [1, 12, 3])?.split(".")[0];
  for (const counts of ["0.12.3", "1.12", "1.-2.3", "1.1e9.3", "1.9999999.3", "1..3", "a.b.c"]) {
    expect(readCounts(`${hash}.${counts}`, book, setting)).toBe(null);
  }
  const many = Array.from({ length: 2000 }, () => 1);
  expect(keptCounts(sections(...many), setting, many)).toBe(undefined);
});
