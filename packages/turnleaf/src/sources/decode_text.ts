/** Bytes of XML documents, style sheets and plain text as text. */

import { loadPart } from "./load_part.ts";
import { decodeUtf32, utf32Order } from "./utf32.ts";

/** An encoding as a document declares it: in XML, in a style sheet, and as web pages do. */
const declaration =
  /^(?:\xef\xbb\xbf)?\s*(?:<\?xml[^>]{0,200}\bencoding\s*=\s*["']|@charset ")([\w:.-]{1,40})/;

/** An encoding as web pages declare it. */
const webDeclaration = /<meta\s[^<>]{0,200}?charset\s{0,4}=\s{0,4}["']?([\w:.-]{1,40})/i;

/** Bytes in which a declaration is looked for. */
const headLength = 1024;

/** Encodings of bytes below 128, in which the others are no UTF-8. */
const sevenBit = /^iso-2022-/;

/**
 * Returns the text of an XML document, a style sheet or plain text. Its bytes say in which encoding it is;
 * what it declares is asked where they do not, as many declare one that they were converted from. If that
 * is UTF-8, or nothing, it is guessed by its letters.
 */
export async function decodeText(bytes: Uint8Array): Promise<string> {
  const order = utf32Order(bytes);
  if (order) return decodeUtf32(bytes, order);
  const wide = wideEncoding(bytes);
  if (wide) return new TextDecoder(wide).decode(bytes);
  const declared = declaredEncoding(bytes);
  if (sevenBit.test(declared)) return new TextDecoder(declared).decode(bytes);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return await damagedOrLegacy(bytes, declared);
  }
}

/** Returns text that is no UTF-8 throughout. */
async function damagedOrLegacy(bytes: Uint8Array, declared: string): Promise<string> {
  if (declared !== "" && declared !== "utf-8") return new TextDecoder(declared).decode(bytes);
  const text = new TextDecoder().decode(bytes);
  // One damaged byte of UTF-8 is one letter.
  if (isMostlyWhole(text)) return text;
  const { legacyText } = await loadPart(import("./legacy_encoding.ts"));
  return legacyText(bytes);
}

/** What stands for bytes that are no character of UTF-8. */
const replacement = "\ufffd";

/** Returns whether most characters that are not of ASCII were read as such. */
function isMostlyWhole(text: string): boolean {
  const lost = text.split(replacement).length - 1;
  const all = text.match(/[^\0-\x7f]/g)?.length ?? 0;
  return all - lost > lost;
}

/** Returns the encoding of bytes that are two a character; null for others. */
function wideEncoding([first, second, third]: Uint8Array): string | null {
  if (first === 0xfe && second === 0xff) return "utf-16be";
  if (first === 0xff && second === 0xfe) return "utf-16le";
  // Without a mark, a letter of ASCII tells: none of these texts has a NUL.
  if (first === 0 && second) return "utf-16be";
  return first && second === 0 && third ? "utf-16le" : null;
}

/** Returns the encoding that a document of one byte a character, or more, declares; "" if none is known. */
function declaredEncoding(bytes: Uint8Array): string {
  const head = String.fromCharCode(...bytes.subarray(0, headLength));
  // Of two the one that is no UTF-8 says more: the other is written by many programs, whatever they write.
  const found = [declaration, webDeclaration].map((one) => encodingOf(one.exec(head)?.[1]));
  return found.find((one) => one !== "" && one !== "utf-8") ?? found.find((one) => one) ?? "";
}

/** Returns an encoding's usual name; "" if browsers do not know it. */
function encodingOf(label: string | undefined): string {
  try {
    const { encoding } = new TextDecoder(label ?? "x-none");
    // Its declaration could not be read if it were.
    return encoding.startsWith("utf-16") ? "" : encoding;
  } catch {
    return "";
  }
}
