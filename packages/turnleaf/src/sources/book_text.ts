import { limits } from "./limits.ts";

/** Control and direction-override characters, which a title or label must not smuggle in. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: they are what is removed
const unprintable = /[\u0000-\u001f\u007f-\u009f\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff]/g;

/** `text` on one line, without unprintable characters, of at most `length` characters. */
export function cleanText(text: unknown, length: number = limits.titleLength): string {
  if (typeof text !== "string") return "";
  const line = text
    .slice(0, 8 * length)
    .replace(unprintable, " ")
    .replace(/\s+/g, " ")
    .trim();
  return [...line].slice(0, length).join("");
}

/** A piece of a page's text as it is: spaces stay, unprintable characters go, lone halves of characters too. */
export function cleanRun(text: unknown): string {
  if (typeof text !== "string") return "";
  return text
    .slice(0, limits.runLength)
    .replace(/[\t\n\r\u2028\u2029]+/g, " ")
    .replace(unprintable, "")
    .replace(/\p{Surrogate}/gu, "");
}

/** An address that a book's link may lead to, of the web or of mail; empty where `address` is none. */
export function cleanAddress(address: unknown): string {
  if (typeof address !== "string" || address.length > limits.urlLength) return "";
  try {
    const { protocol, href } = new URL(address);
    return /^(https?|mailto):$/.test(protocol) ? href : "";
  } catch {
    return "";
  }
}

/** A BCP 47 tag in its canonical form; empty where `tag` is none. */
export function cleanLanguage(tag: unknown): string {
  const text = cleanText(tag, 60).replaceAll("_", "-");
  try {
    return text === "" ? "" : (Intl.getCanonicalLocales(text)[0] ?? "");
  } catch {
    return "";
  }
}

/**
 * What a sentence calls the file at `url`: the last part of its path, decoded;
 * "this book" where it has none (a blob or data URL).
 */
export function nameOfUrl(url: string): string {
  if (/^(blob|data):/i.test(url)) return "this book";
  const path = url.split(/[?#]/, 1)[0] ?? "";
  const last = path.replace(/\/+$/, "").split("/").pop() ?? "";
  return cleanText(decode(last), 80) || "this book";
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
