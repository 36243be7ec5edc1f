/** Addresses of a series of photographs, from one with their numbers in braces. */

import { limits } from "../sources/limits.ts";
import { BookError } from "../sources/page_source.ts";

/** A series of photographs. */
export interface PhotographRow {
  readonly addresses: readonly string[];
  /** Width over height of a page in them; null if unknown. */
  readonly ratio: number | null;
}

/** Maximum of photographs of a turn. */
const most = 120;

/** Maximum ratio of a page's longer to its shorter side. */
const longest = 10;

/**
 * Expands `turn-{01-24}.webp#ratio=2:3`: the addresses with every number from
 * the first to the last, as long as the first is written, rising or falling,
 * and the ratio of the pages in the photographs, which may be left out.
 *
 * @param base base of relative addresses
 * @throws BookError if it does not name a series of 2 to 120 addresses, or the
 * ratio is impossible for a page
 */
export function photographRow(address: string, base: string): PhotographRow {
  const [row, said] = address.split("#ratio=");
  const ratio = said === undefined ? null : ratioOf(said);
  const found = /^([^{}]*)\{(\d{1,6})-(\d{1,6})\}([^{}]*)$/.exec(row);
  if (found === null || address.length > limits.urlLength) {
    throw new BookError(
      "Photographs of a turn need an address with their numbers in braces, as in turn-{01-24}.webp.",
      { code: "misused" },
    );
  }
  const [, before, first, last, after] = found;
  const [from, to] = [Number(first), Number(last)];
  const count = Math.abs(to - from) + 1;
  if (count < 2 || count > most) {
    throw new BookError(`A turn has 2 to ${most} photographs; ${address} names ${count}.`, {
      code: "misused",
    });
  }
  const step = Math.sign(to - from);
  const addresses = Array.from({ length: count }, (_, k) => {
    const number = String(from + k * step).padStart(first.length, "0");
    try {
      return new URL(before + number + after, base).href;
    } catch {
      throw new BookError(`${address} is no address of photographs.`, {
        code: "misused",
        source: address,
      });
    }
  });
  return { addresses, ratio };
}

function ratioOf(said: string): number {
  const [, width, height] = /^(\d+(?:\.\d+)?):(\d+(?:\.\d+)?)$/.exec(said) ?? [];
  const ratio = Number(width) / Number(height);
  if (!(ratio >= 1 / longest && ratio <= longest)) {
    throw new BookError(
      "The ratio of photographed pages is said as width to height, as in #ratio=2:3.",
      { code: "misused" },
    );
  }
  return ratio;
}
