import { limits } from "./limits.ts";

/** Control and direction-override characters, which are not allowed in titles and labels. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: they are what is removed
const unprintable = /[\u0000-\u001f\u007f-\u009f\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff]/g;

/** Returns `text` on one line, without unprintable characters, of at most `length` characters. */
export function cleanText(text: unknown, length: number = limits.titleLength): string {
  if (typeof text !== "string") return "";
  const line = text
    .slice(0, 8 * length)
    .replace(unprintable, " ")
    .replace(/\s+/g, " ")
    .trim();
  return [...line].slice(0, length).join("");
}

/**
 * Returns a piece of a page's text as it is, with its spaces, but without
 * unprintable characters and lone surrogates.
 */
export function cleanRun(text: unknown): string {
  if (typeof text !== "string") return "";
  return text
    .slice(0, limits.runLength)
    .replace(/[\t\n\r\u2028\u2029]+/g, " ")
    .replace(unprintable, "")
    .replace(/\p{Surrogate}/gu, "");
}

/**
 * Returns an address that a book's link may lead to, of the web or of mail;
 * empty if `address` is none.
 */
export function cleanAddress(address: unknown): string {
  if (typeof address !== "string" || address.length > limits.urlLength) return "";
  try {
    const { protocol, href } = new URL(address);
    return /^(https?|mailto):$/.test(protocol) ? href : "";
  } catch {
    return "";
  }
}

/** Returns a part of an address with its escapes decoded; as it is if they are none. */
export function decodeEscapes(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

/** Returns a BCP 47 tag in its canonical form; empty if `tag` is none. */
export function cleanLanguage(tag: unknown): string {
  const text = cleanText(tag, 60).replaceAll("_", "-");
  try {
    return text === "" ? "" : (Intl.getCanonicalLocales(text)[0] ?? "");
  } catch {
    return "";
  }
}

/**
 * Returns the name of the file at `url` for sentences: the last part of its
 * path, decoded, or "this book" for a blob or data URL.
 */
export function nameOfUrl(url: string): string {
  if (/^(blob|data):/i.test(url)) return "this book";
  const path = url.split(/[?#]/, 1)[0] ?? "";
  const last = path.split("/").findLast((part) => part !== "") ?? "";
  return cleanText(decodeEscapes(last), 80) || "this book";
}
