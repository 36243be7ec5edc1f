/** Addresses of a row of photographs, from one with their numbers in braces. */

import { limits } from "../sources/limits.ts";
import { BookError } from "../sources/page_source.ts";

/** Photographs of a turn, at most. */
const most = 120;

/**
 * The addresses that `turn-{01-24}.webp` stands for: with every number from the
 * first to the last, as long as the first is written, rising or falling.
 *
 * @param base what relative ones are relative to
 * @throws BookError where it names no row of 2 to 120 addresses
 */
export function photographAddresses(address: string, base: string): string[] {
  const found = /^([^{}]*)\{(\d{1,6})-(\d{1,6})\}([^{}]*)$/.exec(address);
  if (found === null || address.length > limits.urlLength) {
    throw new BookError(
      "Photographs of a turn need an address with their numbers in braces, as in turn-{01-24}.webp.",
    );
  }
  const [, before, first, last, after] = found;
  const [from, to] = [Number(first), Number(last)];
  const count = Math.abs(to - from) + 1;
  if (count < 2 || count > most) {
    throw new BookError(`A turn has 2 to ${most} photographs; ${address} names ${count}.`);
  }
  const step = Math.sign(to - from);
  return Array.from({ length: count }, (_, k) => {
    const number = String(from + k * step).padStart(first.length, "0");
    try {
      return new URL(before + number + after, base).href;
    } catch {
      throw new BookError(`${address} is no address of photographs.`);
    }
  });
}
