/**
 * Names in ZIPs from before Unicode, which do not say in which encoding they are: that of the system on
 * which they were packed. In some of East Asia's, a byte of a letter is that of a backslash.
 */

/** An encoding of two bytes a letter, and the bytes of the letters that are in common use. */
interface Encoding {
  readonly name: string;
  /** Whether a letter's two bytes are of its commonest letters. */
  isCommon(first: number, second: number): boolean;
}

/** First bytes of common letters by their standards: JIS X 0208, GB 2312, Big5 and KS X 1001, level 1. */
const encodings: readonly Encoding[] = [
  // Kana and signs; kanji of level 1.
  {
    name: "shift_jis",
    isCommon: (a, b) =>
      (a >= 0x81 && a <= 0x84) || (a >= 0x88 && a <= 0x97) || (a === 0x98 && b <= 0x72),
  },
  { name: "euc-kr", isCommon: (a, b) => a >= 0xb0 && a <= 0xc8 && b >= 0xa1 },
  { name: "gbk", isCommon: (a, b) => a >= 0xb0 && a <= 0xd7 && b >= 0xa1 },
  { name: "big5", isCommon: (a) => a >= 0xa4 && a <= 0xc6 },
];

/** The fraction of letters that are common in names that are in an encoding. */
const leastCommon = 0.7;

/**
 * Returns names as text.
 *
 * @param raw the bytes of all names of an archive that do not say their encoding
 * @param usual the names as they are in the encoding of DOS, which stands where no other fits better
 */
export function legacyNames(raw: readonly Uint8Array[], usual: readonly string[]): string[] {
  // Packed on several systems, each is in its own.
  return namesIn(raw) ?? raw.map((bytes, k) => namesIn([bytes])?.[0] ?? usual[k] ?? "");
}

/** Returns names in the one encoding that all of them fit; null if there is none. */
function namesIn(raw: readonly Uint8Array[]): string[] | null {
  const utf8 = decodedAs("utf-8", raw);
  if (utf8) return utf8;
  const encoding = eastAsianEncoding(raw);
  return encoding === null ? null : decodedAs(encoding, raw);
}

/** Returns the encoding of East Asia that fits texts best, all of them; null if none does. */
export function eastAsianEncoding(raw: readonly Uint8Array[]): string | null {
  let best: { readonly name: string; readonly fit: number } | null = null;
  for (const { name, isCommon } of encodings) {
    if (!decodedAs(name, raw)) continue;
    const fit = commonIn(raw, isCommon);
    if (fit >= leastCommon && fit > (best?.fit ?? 0)) best = { name, fit };
  }
  return best?.name ?? null;
}

/** Returns names in an encoding; null if one of them is not in it. */
function decodedAs(encoding: string, raw: readonly Uint8Array[]): string[] | null {
  try {
    const decoder = new TextDecoder(encoding, { fatal: true });
    return raw.map((bytes) => decoder.decode(bytes));
  } catch {
    return null;
  }
}

/** Returns the fraction of the letters of two bytes in names that are common ones. */
function commonIn(raw: readonly Uint8Array[], isCommon: Encoding["isCommon"]): number {
  let [letters, common] = [0, 0];
  for (const bytes of raw) {
    for (let k = 0; k < bytes.length; k++) {
      const first = bytes[k] as number;
      if (first < 0x80) continue;
      letters += 1;
      if (isCommon(first, bytes[k + 1] ?? 0)) common += 1;
      k += 1;
    }
  }
  return letters === 0 ? 0 : common / letters;
}
