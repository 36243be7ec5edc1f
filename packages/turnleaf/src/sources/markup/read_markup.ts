/** Markup of books as a document, whether it is well-formed or not. */

import { loadPart } from "../load_part.ts";
import { withBoundedTags } from "./bounded_tags.ts";
import { errorIn, type MarkupType, parseBounded, parseMarkup } from "./parse_markup.ts";

/** Control characters that no text has, by themselves or by number: letters of Windows' encoding that were taken for Unicode. */
const windowsLetters = /[\u0080-\u009f]|&#(1(?:2[89]|[345]\d)|x[89][\da-f]);/gi;

/** A document as it was read. */
export interface ReadMarkup {
  readonly document: Document;
  /** What it was parsed from: well-formed, unless nothing could be made of it. */
  readonly text: string;
  /** The line in which something is missing; null if that is not known, undefined if nothing is. */
  readonly damagedLine?: number | null;
}

/** Languages in which a chapter may be written. */
const languages = ["1999/xhtml", "2000/svg", "1998/Math/MathML"].map(
  (one) => `http://www.w3.org/${one}`,
);

/**
 * Returns whether a root is of no language that is shown, by its namespace, if it has one. Elements of others,
 * as of DTBook, mostly have the names of HTML's.
 */
function isForeign({ localName, namespaceURI }: Element): boolean {
  const [xhtml] = languages;
  return localName === "html" ? namespaceURI !== xhtml : !languages.includes(namespaceURI ?? "");
}

/**
 * Reads XML: as it is if it is well-formed, otherwise repaired; elements of HTML that even so are none of
 * XML are read as browsers read web pages.
 */
export async function readMarkup(
  source: string,
  type: Exclude<MarkupType, "text/html">,
): Promise<ReadMarkup> {
  const text = withBoundedTags(source.replace(windowsLetters, letterOf));
  const document = parseBounded(text, type);
  const error = errorIn(document);
  const isHtml = type === "application/xhtml+xml";
  if (error === null && !(isHtml && isForeign(document.documentElement))) return { document, text };
  const { repairedXml } = await loadPart(import("./repaired_xml.ts"));
  const repaired = repairedXml(text, isHtml);
  const damaged = { damagedLine: error?.line ?? null };
  if (repaired !== null && repaired.xml !== "") {
    const whole = parseMarkup(repaired.xml, type);
    if (errorIn(whole) === null) {
      return { document: whole, text: repaired.xml, ...(repaired.isCutOff ? damaged : {}) };
    }
  }
  return { document: isHtml ? parseBounded(text, "text/html") : document, text, ...damaged };
}

/** Returns the letter that a control character, or a reference to one, stands for. */
function letterOf(control: string, number?: string): string {
  const code = number ? Number(number.replace(/^x/i, "0x")) : control.charCodeAt(0);
  return new TextDecoder("windows-1252").decode(Uint8Array.of(code));
}
