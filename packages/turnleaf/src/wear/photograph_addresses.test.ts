import { expect, test } from "vitest";
import { photographAddresses } from "./photograph_addresses.ts";

const base = "https://example.org/books/";

test("numbers in braces stand for a row of addresses", () => {
  expect(photographAddresses("turn-{08-11}.webp?v=2", base)).toEqual([
    "https://example.org/books/turn-08.webp?v=2",
    "https://example.org/books/turn-09.webp?v=2",
    "https://example.org/books/turn-10.webp?v=2",
    "https://example.org/books/turn-11.webp?v=2",
  ]);
  expect(photographAddresses("/{3-1}/a.png", base)).toEqual([
    "https://example.org/3/a.png",
    "https://example.org/2/a.png",
    "https://example.org/1/a.png",
  ]);
  expect(photographAddresses("{1-120}", base)).toHaveLength(120);
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
  ["http://{1-2}:x/", "is no address of photographs."],
])("%s is refused in one sentence", ([address, sentence]) => {
  expect(() => photographAddresses(address, base)).toThrow(sentence);
});
