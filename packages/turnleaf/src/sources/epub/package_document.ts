/** A package as foliate-js takes it: what is missing in one item must not fail the book. */

import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";

/** Elements of a package: foliate-js goes through the manifest for every line of the spine. */
const mostElements = 50_000;

/** Characters of an attribute `prefix`, which foliate-js searches in quadratic time. */
const longestPrefix = 4000;

/**
 * Checks an XML document of an EPUB, and takes out of a package what cannot be
 * read. Throws a `BookError` if it has too many elements.
 *
 * @param name the book's name in sentences
 */
export function checkPackage(document: Document, name: string): Document {
  const root = document.documentElement;
  const most = root?.localName === "package" ? mostElements : limits.elements;
  if (document.getElementsByTagName("*").length > most) {
    throw new BookError(`${name} has a list of more than ${most} elements; split it.`, {
      code: "tooLarge",
      source: name,
    });
  }
  if (root?.localName !== "package") return document;
  for (const attribute of [...root.attributes]) {
    if (attribute.localName === "prefix" && attribute.value.length > longestPrefix) {
      root.removeAttributeNode(attribute);
    }
  }
  for (const element of [...document.getElementsByTagNameNS("*", "*")]) {
    const needed = neededAttributes[element.localName] ?? [];
    if (needed.some((attribute) => !element.hasAttribute(attribute))) element.remove();
  }
  return document;
}

/** Attributes without which an element says nothing. */
const neededAttributes: Readonly<Record<string, readonly string[]>> = {
  item: ["id", "href", "media-type"],
  itemref: ["idref"],
  reference: ["type", "href"],
};
