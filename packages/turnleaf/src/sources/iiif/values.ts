/**
 * Values of IIIF's JSON, of Presentation 2 and 3 alike: nothing is where it
 * should be until it has been checked.
 */

import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { isRecord } from "../manifest_checks.ts";
import type { PageBox } from "../page_source.ts";

/** A JSON object. */
export type Value = Readonly<Record<string, unknown>>;

/** Maximum of characters of a text before it is cleaned. */
const longestText = 4 * limits.titleLength;

/** Returns the objects in a list, or a single one, at most `most`. */
export function objectsIn(value: unknown, most: number = limits.pages): Value[] {
  const list = Array.isArray(value) ? value : [value];
  return list.slice(0, most).filter(isRecord);
}

/** Returns the objects in a list, or a single one; a string is the address of one. */
export function referencesIn(value: unknown, most: number): Value[] {
  const list = Array.isArray(value) ? value : [value];
  return list
    .slice(0, most)
    .map((one) => (typeof one === "string" ? { id: one } : one))
    .filter(isRecord);
}

/** Returns the strings in a list, or a single one. */
export function stringsIn(value: unknown): string[] {
  const list = Array.isArray(value) ? value.slice(0, 100) : [value];
  return list.filter((item) => typeof item === "string");
}

/** Returns what identifies an object, or the string that stands for one; "" if nothing does. */
export function idOf(value: unknown): string {
  const id = isRecord(value) ? (value.id ?? value["@id"]) : value;
  return typeof id === "string" ? id : "";
}

/** Returns an object's type, such as "Canvas", without the prefix that version 2 has. */
export function typeOf(value: Value): string {
  const [type = ""] = stringsIn(value.type ?? value["@type"]);
  return type.replace(/^\w+:/, "");
}

/** Returns the behaviors of an object; version 2 calls them viewing hints. */
export function behaviorsOf(value: Value): string[] {
  return [...stringsIn(value.behavior), ...stringsIn(value.viewingHint)];
}

/**
 * Returns an address of the web, relative ones resolved; "" for anything else.
 *
 * @param base absolute
 */
export function addressOf(value: unknown, base: string): string {
  const id = idOf(value);
  if (id === "" || id.length > limits.urlLength) return "";
  try {
    const { href, protocol } = new URL(id, base);
    return /^https?:$/.test(protocol) ? href : "";
  } catch {
    return "";
  }
}

/** Returns a number from above 0 to the longest side of a page, or one in words of digits; 0 for anything else. */
export function lengthOf(value: unknown): number {
  const length = typeof value === "string" ? Number(value) : value;
  return typeof length === "number" && length > 0 && length <= limits.pageSide ? length : 0;
}

/** Returns a number of pixels, whole and at least 1; 0 for anything else. */
export function pixelsOf(value: unknown): number {
  return Math.floor(lengthOf(value));
}

/**
 * Returns a text in the first of some languages that it is in, otherwise in one
 * that has no language, otherwise in its first. Markup is taken away.
 */
export function textIn(value: unknown, languages: readonly string[]): string {
  const texts = textsOf(value);
  const of = (wanted: string): string | undefined => texts.find(([tag]) => tag === wanted)?.[1];
  for (const language of languages) {
    const [main = ""] = language.toLowerCase().split("-");
    const text = of(language.toLowerCase()) ?? of(main) ?? startingWith(texts, `${main}-`);
    if (text !== undefined) return text;
  }
  return of("none") ?? texts[0]?.[1] ?? "";
}

type Texts = readonly (readonly [language: string, text: string])[];

function startingWith(texts: Texts, start: string): string | undefined {
  return texts.find(([tag]) => tag.startsWith(start))?.[1];
}

/** Returns texts by their languages in lower case, "none" for those without. */
function textsOf(value: unknown): Texts {
  if (typeof value === "string") return [["none", plain(value)]];
  if (Array.isArray(value)) {
    const all = value.slice(0, 100).flatMap(textsOf);
    const languages = new Set(all.map(([language]) => language));
    return [...languages].map((language) => [
      language,
      joined(all.filter(([tag]) => tag === language).map(([, text]) => text)),
    ]);
  }
  if (!isRecord(value)) return [];
  if ("@value" in value) {
    const language = stringsIn(value["@language"])[0]?.toLowerCase() ?? "none";
    return [[language, plain(String(value["@value"]))]];
  }
  return Object.entries(value)
    .slice(0, 100)
    .map(([tag, texts]) => [tag.toLowerCase(), joined(stringsIn(texts).map(plain))]);
}

function joined(texts: readonly string[]): string {
  return cleanText(texts.join("; "));
}

const entities: Readonly<Record<string, string>> = { amp: "&", lt: "<", gt: ">", quot: '"' };

/** Returns a text without tags. */
export function plain(text: string): string {
  const bare = text.slice(0, longestText).replace(/<[^<>]*>/g, " ");
  return cleanText(bare.replace(/&(amp|lt|gt|quot);/g, (_, name: string) => entities[name] ?? ""));
}

/** Characters of a drawing that are read. */
const longestPath = 20_000;

/** Returns the box around a path or polygon of SVG in absolute places; null for anything else. */
export function boxAround(svg: string, width: number, height: number): PageBox | null {
  const path = /\s(?:d|points)=["']([^"']+)["']/.exec(svg.slice(0, longestPath))?.[1] ?? "";
  const numbers = (path.match(/-?[\d.]+/g) ?? []).map(Number);
  // Steps from place to place, or along one axis, are not followed.
  if (/[abd-yHVA]/.test(path) || numbers.length < 4 || !numbers.every(Number.isFinite)) return null;
  const [across, down] = [0, 1].map((axis) => numbers.filter((_, k) => k % 2 === axis));
  const [x, y] = [Math.max(Math.min(...across), 0), Math.max(Math.min(...down), 0)];
  const box = { x, y, width: Math.max(...across) - x, height: Math.max(...down) - y };
  return box.width > 0 && box.height > 0 && x < width && y < height ? box : null;
}

/** Returns the box in a media fragment such as "#xywh=1,2,3,4"; null if there is none. */
export function boxIn(fragment: string, width: number, height: number): PageBox | null {
  const found = /xywh=(pixel:|percent:)?([\d.]+),([\d.]+),([\d.]+),([\d.]+)/.exec(
    fragment.slice(-limits.urlLength),
  );
  if (!found) return null;
  const [across, down] = found[1] === "percent:" ? [width / 100, height / 100] : [1, 1];
  const [x, y, w, h] = found.slice(2).map(Number) as [number, number, number, number];
  const box = { x: x * across, y: y * down, width: w * across, height: h * down };
  const isBox = box.width > 0 && box.height > 0 && box.x < width && box.y < height;
  return isBox ? box : null;
}
