/**
 * Unpacks LZMA (the ".lzma" file of Pavlov's LZMA SDK, which is in the public
 * domain). A browser unpacks deflate by itself, but machine code packs a fifth
 * smaller this way, which outweighs these lines many times over.
 */

const START = 1024;
/** Probabilities by what they are of: where each kind begins in the one array. */
const IS_MATCH = 0;
const IS_REP = 192;
const REP_0_LONG = 240;
const SLOT = 432;
const SPECIAL = 688;
const ALIGN = 802;
const LENGTH = 818;
const REP_LENGTH = 1332;
const LITERAL = 1846;

/**
 * The bytes that were packed.
 * @param packed a whole .lzma file whose head names its length. It is trusted:
 *   broken bytes give broken bytes, or a RangeError
 */
export function unpackLzma(packed: Uint8Array): Uint8Array<ArrayBuffer> {
  const head = packed[0] as number;
  const [lc, lp, pb] = [head % 9, ((head / 9) | 0) % 5, (head / 45) | 0];
  const view = new DataView(packed.buffer, packed.byteOffset);
  const out = new Uint8Array(view.getUint32(5, true));
  const odds = new Uint16Array(LITERAL + (0x300 << (lc + lp))).fill(START);
  // The first byte is always 0. Both stay below 2^32, which a double holds exactly.
  let code = view.getUint32(14);
  let range = 2 ** 32 - 1;
  let at = 18;

  const shift = () => {
    if (range < 2 ** 24) {
      range *= 256;
      code = code * 256 + (packed[at++] as number);
    }
  };
  const bit = (of: number): number => {
    const odd = odds[of] as number;
    const bound = (range >>> 11) * odd;
    const one = code >= bound;
    if (one) {
      range -= bound;
      code -= bound;
      odds[of] = odd - (odd >> 5);
    } else {
      range = bound;
      odds[of] = odd + ((2048 - odd) >> 5);
    }
    shift();
    return one ? 1 : 0;
  };
  const evenBit = (): number => {
    range = range >>> 1;
    const one = code >= range;
    if (one) code -= range;
    shift();
    return one ? 1 : 0;
  };
  const tree = (from: number, bits: number): number => {
    let node = 1;
    while (node < 1 << bits) node = (node << 1) | bit(from + node);
    return node - (1 << bits);
  };
  /** As `tree`, the lowest bit first. */
  const reversed = (from: number, bits: number): number => {
    let [node, value] = [1, 0];
    for (let i = 0; i < bits; i++) {
      const one = bit(from + node);
      node = (node << 1) | one;
      value |= one << i;
    }
    return value;
  };
  const length = (from: number, position: number): number => {
    if (bit(from) === 0) return 2 + tree(from + 2 + 8 * position, 3);
    if (bit(from + 1) === 0) return 10 + tree(from + 130 + 8 * position, 3);
    return 18 + tree(from + 258, 8);
  };
  const distance = (count: number): number => {
    const slot = tree(SLOT + 64 * Math.min(count - 2, 3), 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    let high = 2 | (slot & 1);
    if (slot < 14) return (high << bits) + reversed(SPECIAL + (high << bits) - slot - 1, bits);
    for (let i = 4; i < bits; i++) high = (high << 1) | evenBit();
    return (high << 4) + reversed(ALIGN, 4);
  };

  let state = 0;
  const last: [number, number, number, number] = [0, 0, 0, 0];
  for (let to = 0; to < out.length; ) {
    const position = to & ((1 << pb) - 1);
    if (bit(IS_MATCH + 16 * state + position) === 0) {
      const before = to === 0 ? 0 : (out[to - 1] as number);
      const set = ((to & ((1 << lp) - 1)) << lc) | (before >> (8 - lc));
      const from = LITERAL + 0x300 * set;
      let node = 1;
      if (state >= 7) {
        let match = out[to - last[0] - 1] as number;
        let same = true;
        while (same && node < 256) {
          const expected = (match >> 7) & 1;
          match <<= 1;
          const one = bit(from + 256 * (1 + expected) + node);
          node = (node << 1) | one;
          same = one === expected;
        }
      }
      while (node < 256) node = (node << 1) | bit(from + node);
      out[to++] = node;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let count = 1;
    if (bit(IS_REP + state) === 0) {
      count = length(LENGTH, position);
      last.unshift(distance(count));
      last.length = 4;
      state = state < 7 ? 7 : 10;
    } else {
      let which = 0;
      if (bit(IS_REP + 12 + state) === 1) {
        which = 1;
        while (which < 3 && bit(IS_REP + 12 + 12 * which + state) === 1) which++;
      }
      if (which === 0 && bit(REP_0_LONG + 16 * state + position) === 0) {
        state = state < 7 ? 9 : 11;
      } else {
        last.unshift(...last.splice(which, 1));
        count = length(REP_LENGTH, position);
        state = state < 7 ? 8 : 11;
      }
    }
    for (const end = Math.min(to + count, out.length); to < end; to++) {
      out[to] = out[to - last[0] - 1] as number;
    }
  }
  return out;
}
