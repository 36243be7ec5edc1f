import { expect, test } from "vitest";
import { Random, seed } from "../../for_tests/random_numbers.ts";
import { inPageOrder } from "./page_order.ts";

interface Piece {
  readonly first: number;
  readonly last: number;
  readonly weight: number;
}

const piece = (first: number, last = first, weight = 1): Piece => ({ first, last, weight });
const ordered = (pieces: readonly Piece[]): readonly Piece[] =>
  inPageOrder(pieces, ({ weight }) => weight);

test("text in the order of its pages is all in order", () => {
  const pieces = [piece(0), piece(0, 2), piece(2), piece(5, 6)];
  expect(ordered(pieces)).toEqual(pieces);
});

test("a caption that is written first and stands last is out of order, and so is a line put at the head of pages", () => {
  const rows = [0, 0, 1, 1, 2].map((page) => piece(page));
  expect(ordered([piece(2), ...rows])).toEqual(rows);
  expect(ordered([...rows, piece(0)])).toEqual(rows);
});

test("what is heavier is in order, though it is of fewer pieces", () => {
  const text = piece(0, 1, 100);
  expect(ordered([piece(2), piece(2), piece(2), text])).toEqual([text]);
});

/** Returns the weight of the heaviest order, by trying all. */
function heaviest(pieces: readonly Piece[], from = 0, page = 0): number {
  return pieces.slice(from).reduce((most, { first, last, weight }, k) => {
    if (first < page) return most;
    return Math.max(most, weight + heaviest(pieces, from + k + 1, last));
  }, 0);
}

test(`no other order is heavier (seed ${seed})`, () => {
  const random = new Random();
  for (let round = 0; round < 200; round++) {
    const pieces = Array.from({ length: random.below(9) }, () => {
      const first = random.below(6);
      return piece(first, first + random.below(3), 1 + random.below(20));
    });
    const found = ordered(pieces);
    expect(found.every(({ first }, k) => first >= (found[k - 1]?.last ?? 0))).toBe(true);
    const weight = found.reduce((sum, one) => sum + one.weight, 0);
    expect(weight).toBe(heaviest(pieces));
  }
});
