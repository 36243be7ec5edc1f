import { expect, test } from "vitest";
import { photographRow } from "./photograph_row.ts";

const base = "https://example.org/books/";

test("numbers in braces stand for a row of addresses", () => {
  expect(photographRow("turn-{08-11}.webp?v=2", base).addresses).toEqual([
    "https://example.org/books/turn-08.webp?v=2",
    "https://example.org/books/turn-09.webp?v=2",
    "https://example.org/books/turn-10.webp?v=2",
    "https://example.org/books/turn-11.webp?v=2",
  ]);
  expect(photographRow("/{3-1}/a.png", base).addresses).toEqual([
    "https://example.org/3/a.png",
    "https://example.org/2/a.png",
    "https://example.org/1/a.png",
  ]);
  expect(photographRow("{1-120}", base).addresses).toHaveLength(120);
});

test("the ratio of the photographed pages may be said", () => {
  expect(photographRow("{1-2}.png", base).ratio).toBeNull();
  const { addresses, ratio } = photographRow("{1-2}.png#ratio=140:210", base);
  expect(ratio).toBeCloseTo(2 / 3, 12);
  expect(addresses[0]).toBe("https://example.org/books/1.png");
  expect(photographRow("{1-2}.png#ratio=1.5:1", base).ratio).toBe(1.5);
});

test.for([
  ["", "need an address with their numbers in braces, as in turn-{01-24}.webp."],
  ["turn.webp", "need an address with their numbers in braces, as in turn-{01-24}.webp."],
  ["{1-2}{1-2}.png", "need an address with their numbers in braces"],
  ["{a-b}.png", "need an address with their numbers in braces"],
  [`${"x".repeat(5000)}{1-2}`, "need an address with their numbers in braces"],
  ["{5-5}.png", "A turn has 2 to 120 photographs; {5-5}.png names 1."],
  ["{1-121}.png", "A turn has 2 to 120 photographs; {1-121}.png names 121."],
  ["{1-999999}.png", "names 999999."],
  [
    "{1-2}.png#ratio=",
    "The ratio of photographed pages is said as width to height, as in #ratio=2:3.",
  ],
  ["{1-2}.png#ratio=0:3", "as in #ratio=2:3."],
  ["{1-2}.png#ratio=100:1", "as in #ratio=2:3."],
  ["{1-2}.png#ratio=1:NaN", "as in #ratio=2:3."],
  ["http://{1-2}:x/", "is no address of photographs."],
])("%s is rejected in one sentence", ([address, sentence]) => {
  expect(() => photographRow(address, base)).toThrow(sentence);
});
