/**
 * Random numbers of the fuzz tests: the same for the same seed, which is 1 or what
 * TURNLEAF_SEED says. TURNLEAF_FUZZ says how many times as many rounds as usual they go.
 */

import { it } from "vitest";

/** The seed of this run. */
export const seed: number = Number(import.meta.env.TURNLEAF_SEED ?? 1);

/** How many times as many rounds as usual a random test goes. */
export const fuzz: number = Number(import.meta.env.TURNLEAF_FUZZ ?? 1);

/** Numbers by the generator of Numerical Recipes, which the engine's tests have as well. */
export class Random {
  #state: number;

  constructor(start: number = seed) {
    this.#state = start >>> 0;
  }

  /** A whole number from 0 to less than `bound`, which is at most 2^20. */
  below(bound: number): number {
    this.#state = (Math.imul(this.#state, 1664525) + 1013904223) >>> 0;
    return Math.floor((this.#state / 2 ** 32) * bound);
  }

  /** One of some values. */
  among<T>(values: readonly T[]): T {
    return values[this.below(values.length)];
  }

  /** A text with some pieces taken out, doubled or put in, `pieces` among them. */
  mutate(text: string, pieces: readonly string[]): string {
    let mutated = text;
    for (let k = this.below(5); k >= 0; k--) {
      const at = this.below(mutated.length + 1);
      const end = at + this.below(8);
      const [before, cut, after] = [
        mutated.slice(0, at),
        mutated.slice(at, end),
        mutated.slice(end),
      ];
      const put = this.among(["", cut + cut, this.among(pieces), cut + this.among(pieces)]);
      mutated = before + put + after;
    }
    return mutated;
  }
}

/** What numbers and texts from outside have been made of to break who reads them. */
export const wildPieces: readonly string[] = [
  ...["0", "-1", "1e999", "-0", "1e-999", "NaN", "Infinity", "99999999999999999999", "0x10", "1.5"],
  ...[
    "",
    " ",
    "\0",
    "\n",
    "\ud800",
    "\u202e",
    "é",
    ",",
    "-",
    "{",
    "}",
    "[",
    "]",
    '"',
    ":",
    "=",
    "&",
    "#",
  ],
  ...["null", "true", "[[[[[[[[", '{"a":', "__proto__", "constructor", "javascript:", "//", ".."],
];

/** A test of so many rounds, more by TURNLEAF_FUZZ, whose name says its seed. */
export function fuzzed(
  name: string,
  rounds: number,
  round: (random: Random) => void | Promise<void>,
): void {
  it(`${name} (seed ${seed})`, { timeout: 120_000 * fuzz }, async () => {
    const random = new Random();
    for (let k = 0; k < rounds * fuzz; k++) await round(random);
  });
}

/** What a test says of an input that it fails on. */
export const clue = (input: unknown): string => `seed ${seed}: ${JSON.stringify(input)}`;
