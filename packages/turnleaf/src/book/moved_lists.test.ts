import { expect, test } from "vitest";
import { movedLayout, movedPages, movedRanges } from "./moved_lists.ts";

/** Pages 5 and 6 of 12 are gone. */
const without = (index: number): number | null =>
  index < 4 ? index : index < 6 ? null : index - 2;

/** Two pages have come before page 5 of 12. */
const withTwo = (index: number): number => (index < 4 ? index : index + 2);

test("numbers of pages follow them", () => {
  expect(movedPages([2, 5, 9], without)).toEqual([2, 7]);
  expect(movedPages([2, 5, 9], withTwo)).toEqual([2, 7, 11]);
});

test.each([
  ["pages and ranges", "1-2,9", "1-2,7", "1-2,11"],
  ["a range over the change", "3-8", "3-6", "3-10"],
  ["a range up to it", "1-4", "1-4", "1-4"],
  ["a range of what is gone", "5-6,12", "10", "7-8,14"],
  ["all pages and more", "1-999", "1-999", "1-999"],
  ["the last pages and more", "11-20", "9-20", "13-20"],
  ["pages beyond the last", "13,20-21", "13,20-21", "13,20-21"],
  ["nonsense", "x,4-,7", "5", "9"],
])("%s are named anew", (_, list, shorter, longer) => {
  expect(movedRanges(list, without, 12)).toBe(shorter);
  expect(movedRanges(list, withTwo, 12)).toBe(longer);
});

test("a range that loses all of its pages but reached beyond the last still does", () => {
  const withoutLast = (index: number): number | null => (index < 10 ? index : null);
  expect(movedRanges("11-99", withoutLast, 12)).toBe("11-99");
});

test("the options of a layout name the same pages", () => {
  const options = {
    shifts: [3, 9],
    hardPages: "1,7",
    stocks: "card 1-2, 12, coated 5-6",
    offset: 1,
  };
  expect(movedLayout(options, without, 12)).toEqual({
    shifts: [3, 7],
    hardPages: "1,5",
    stocks: "card 1-2, card 10",
    offset: 1,
  });
});
