/** Text in encodings from before Unicode that it does not declare, or declares wrongly. */

import { analyse } from "chardet";
import { eastAsianEncoding } from "./archive/legacy_names.ts";

/** Bytes from which an encoding is found: of text, without its tags. */
const sampleLength = 1 << 16;

/** Tags, whose letters say nothing of the text's language. */
const tags = /<[^<>]*>/g;

/** Files in a text, as in a FictionBook's: their letters are of no language either. */
const files = /[A-Za-z0-9+/=]{40,}/g;

/** Confidence of the detector, of 100, from which it is right for a line of text; and that with which it knows nothing. */
const [sure, unsure] = [35, 10];

/** What stands for bytes that are no character of an encoding. */
const replacement = "\ufffd";

/** Encodings of Western Europe, which are guessed where a text has many letters of ASCII beside others. */
const western = /^(iso-8859-1|windows-1252)$/i;

/** Returns text whose bytes are no UTF-8, in the encoding that fits its letters best. */
export function legacyText(bytes: Uint8Array): string {
  const sample = sampleOf(bytes);
  const isInRuns = standInRuns(sample);
  if (!isInRuns && isOfMac(sample)) return new TextDecoder("macintosh").decode(bytes);
  if (isInRuns && isOfDos(sample)) return new TextDecoder("ibm866").decode(bytes);
  const words = isInRuns ? otherWords(sample) : sample;
  const found = analyse(words).filter(({ confidence }) => confidence > unsure);
  // Letters that an encoding does not have are of another: Windows' have more than those of ISO 8859.
  const best =
    found.find(({ name }) => !decoderOf(name).decode(words).includes(replacement)) ?? found[0];
  if (best?.name === "ISO-8859-7" && isGreekOfWindows(sample)) {
    return new TextDecoder("windows-1253").decode(bytes);
  }
  const isSure = best !== undefined && best.confidence >= sure && !western.test(best.name);
  const other = !isSure && isInRuns ? eastAsianEncoding([sample]) : null;
  return decoderOf(other ?? best?.name ?? "").decode(bytes);
}

/** Returns bytes of a text without its tags and most of what is ASCII. */
function sampleOf(bytes: Uint8Array): Uint8Array {
  const first = Math.max(bytes.findIndex((byte) => byte >= 0x80) - sampleLength / 2, 0);
  const part = bytes.subarray(first, first + 2 * sampleLength);
  // One letter a byte, each with the number of its byte or one above 255.
  const letters = new TextDecoder("x-user-defined")
    .decode(part)
    .replace(tags, " ")
    .replace(files, " ");
  return Uint8Array.from(letters.slice(0, sampleLength), (letter) => letter.charCodeAt(0) & 0xff);
}

/**
 * Returns whether a text is in the Cyrillic of DOS, which the detector does not know: its letters are where
 * later encodings have signs, and it leaves out what the bytes of East Asian letters are of.
 */
function isOfDos(bytes: Uint8Array): boolean {
  const others = bytes.filter((byte) => byte >= 0x80);
  const isLow = (byte: number): boolean => byte < 0xb0;
  const letters = others.filter((byte) => isLow(byte) || (byte >= 0xe0 && byte < 0xf2));
  const low = letters.filter(isLow);
  return letters.length > 0.97 * others.length && low.length > others.length / 2;
}

/** Returns how many bytes of a text are some of these, and follow others. */
function countOf(
  bytes: Uint8Array,
  isWanted: (byte: number) => boolean,
  isBefore: (byte: number) => boolean,
): number {
  return bytes.filter((byte, k) => isWanted(byte) && isBefore(bytes[k - 1] ?? 0)).length;
}

const isSmall = (byte: number): boolean => byte >= 0x61 && byte <= 0x7a;

/** Bytes of letters of Macs that other encodings have signs or capitals for, which follow no small letter. */
const lettersOfMac: ReadonlySet<number> = new Set([
  ...[0x87, 0x88, 0x8a, 0x8b, 0x8d, 0x8e, 0x8f, 0x90, 0x91, 0x99, 0x9a, 0x9d, 0x9e, 0x9f],
]);

/** Bytes of small letters of Western Europe by DOS, for which Macs have capitals. */
const lettersOfDos: ReadonlySet<number> = new Set([0x81, 0x82, 0x84, 0x85, 0x94]);

/**
 * Returns whether a text is in the letters of Western Europe as Macs had them, which the detector does not
 * know: after small letters there are few where Windows has its own.
 */
function isOfMac(bytes: Uint8Array): boolean {
  const after = (isWanted: (byte: number) => boolean) => countOf(bytes, isWanted, isSmall);
  const mac = after((byte) => lettersOfMac.has(byte));
  const dos = after((byte) => lettersOfDos.has(byte));
  // Macs have quotation marks among these.
  const windows = after((byte) => byte >= 0xd6 || (byte >= 0xc0 && byte < 0xd2));
  return mac > 1 && mac > 4 * (dos + windows);
}

/**
 * Returns whether Greek is in Windows' encoding rather than in that of ISO 8859, by its capital alpha with an
 * accent at the beginnings of words: all other letters are alike.
 */
function isGreekOfWindows(bytes: Uint8Array): boolean {
  const begun = (alpha: number): number =>
    bytes.filter((byte, k) => {
      const [before = 0, after = 0] = [bytes[k - 1], bytes[k + 1]];
      return byte === alpha && before < 0x80 && after >= 0xc1;
    }).length;
  return begun(0xa2) > begun(0xb6);
}

/** Returns the words of a text in which letters are that are not of ASCII: what else is in it is of another language. */
function otherWords(bytes: Uint8Array): Uint8Array {
  const kept = new Uint8Array(bytes.length);
  let length = 0;
  let [from, isOther] = [0, false];
  for (let k = 0; k < bytes.length; k++) {
    if ((bytes[k] as number) >= 0x80) isOther = true;
    const isEnd = (bytes[k] as number) <= 0x20 || k === bytes.length - 1;
    if (!isEnd) continue;
    if (isOther) {
      kept.set(bytes.subarray(from, k + 1), length);
      length += k + 1 - from;
    }
    [from, isOther] = [k + 1, false];
  }
  return kept.subarray(0, length);
}

/** Returns whether letters that are not of ASCII stand beside each other rather than alone, as those of Western Europe do. */
function standInRuns(bytes: Uint8Array): boolean {
  let [all, beside] = [0, 0];
  for (let k = 0; k < bytes.length; k++) {
    if ((bytes[k] as number) < 0x80) continue;
    all += 1;
    if ((bytes[k - 1] ?? 0) >= 0x80 || (bytes[k + 1] ?? 0) >= 0x80) beside += 1;
  }
  return beside > all / 2;
}

/** Returns what decodes an encoding; that of Western Europe if browsers do not know it. */
function decoderOf(encoding: string): TextDecoder {
  try {
    return new TextDecoder(encoding);
  } catch {
    return new TextDecoder("windows-1252");
  }
}
