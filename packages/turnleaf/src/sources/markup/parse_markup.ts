import { trustedMarkup } from "../trusted_script.ts";
import { styleAttribute } from "../typeset/flow_book.ts";
import { withBoundedTags } from "./bounded_tags.ts";

/** Kinds of markup that the browser parses. */
export type MarkupType =
  | "application/xhtml+xml"
  | "image/svg+xml"
  | "application/xml"
  | "text/html";

/** An element's own style, in a tag. */
const ownStyle = /(<[a-z][^<>]*?\s)style(?=\s*=)/gi;

/** The tags of a style sheet, up to its name. */
const styleTag = /(<\/?(?:[\w.-]{1,99}:)?)style(?=[\s/>])/gi;

/** What stands for a style sheet: an element whose text means nothing, wherever and in whatever markup it is. */
export const styleStandIn = "noframes";

/**
 * Returns markup as a document in which nothing runs and nothing is loaded, and no element stands for a
 * member of it. The elements' own styles are in `styleAttribute`, and each style sheet is a `styleStandIn`:
 * where a page's policy forbids inline styles, the browser would report both.
 */
export function parseMarkup(text: string, type: MarkupType): Document {
  return parseBounded(withBoundedTags(text), type);
}

/** As `parseMarkup`, of text that `withBoundedTags` has returned. */
export function parseBounded(text: string, type: MarkupType): Document {
  const markup = text
    .replace(ownStyle, `$1${styleAttribute}`)
    .replace(styleTag, `$1${styleStandIn}`);
  const document = new DOMParser().parseFromString(trustedMarkup(markup), type);
  removeClobberingNames(document);
  return document;
}

/** Elements that are properties of their form or document, by their `id` or `name`. */
const namedElements =
  "button, embed, fieldset, form, iframe, img, input, object, output, select, textarea";

/**
 * Removes names that would replace a member of a form or a document, as `<input name="attributes">` does.
 * The members used here are those of prototypes, as the document's own may be replaced.
 */
function removeClobberingNames(document: Document): void {
  const { getAttribute, removeAttribute } = Element.prototype;
  for (const element of Document.prototype.querySelectorAll.call(document, namedElements)) {
    for (const attribute of ["id", "name"]) {
      const name = getAttribute.call(element, attribute);
      if (name === null) continue;
      const isMember = name in Document.prototype || name in HTMLFormElement.prototype;
      if (isMember) removeAttribute.call(element, attribute);
    }
  }
}

/** Returns where XML could not be parsed, which the browser then explains in it; null if it could be. */
export function errorIn(document: Document): { readonly line: number | null } | null {
  const [error] = document.getElementsByTagName("parsererror");
  if (error === undefined) return null;
  const line = /\bline(?: number)? (\d{1,9})/i.exec(error.textContent ?? "")?.[1];
  return { line: line === undefined ? null : Number(line) };
}
