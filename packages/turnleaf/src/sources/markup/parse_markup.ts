import { trustedMarkup } from "../trusted_script.ts";
import { styleAttribute } from "../typeset/flow_book.ts";

/** Kinds of markup that the browser parses. */
export type MarkupType =
  | "application/xhtml+xml"
  | "image/svg+xml"
  | "application/xml"
  | "text/html";

/** An element's own style, in a tag. */
const ownStyle = /(<[a-z][^<>]*?\s)style(?=\s*=)/gi;

/**
 * Returns markup as a document in which nothing runs and nothing is loaded. The
 * elements' own styles are in `styleAttribute`.
 */
export function parseMarkup(text: string, type: MarkupType): Document {
  const markup = text.replace(ownStyle, `$1${styleAttribute}`);
  return new DOMParser().parseFromString(trustedMarkup(markup), type);
}

/** Returns where XML could not be parsed, which the browser then explains in it; null if it could be. */
export function errorIn(document: Document): { readonly line: number | null } | null {
  const [error] = document.getElementsByTagName("parsererror");
  if (error === undefined) return null;
  const line = /\bline(?: number)? (\d{1,9})/i.exec(error.textContent ?? "")?.[1];
  return { line: line === undefined ? null : Number(line) };
}
