/** A package as foliate-js takes it: what is missing in one item must not fail the book. */

import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";
import { modernPackage } from "./legacy_package.ts";

/** Elements of a package: foliate-js goes through the manifest for every line of the spine. */
const mostElements = 50_000;

/** Characters of an attribute `prefix`, which foliate-js searches in quadratic time. */
const longestPrefix = 4000;

/** Types of documents that are chapters, however the manifest writes them. */
const chapterTypes = /^(application\/xhtml\+xml|text\/html|text\/x-oeb1-document)$/;

/**
 * Checks an XML document of an EPUB, takes out of a package what cannot be read
 * and adds what is missing. Throws a `BookError` if it has too many elements.
 *
 * @param name the book's name in sentences
 */
export function checkPackage(document: Document, name: string): Document {
  const most = document.documentElement?.localName === "package" ? mostElements : limits.elements;
  if (document.getElementsByTagName("*").length > most) {
    throw new BookError(`${name} has a list of more than ${most} elements; split it.`, {
      code: "tooLarge",
      source: name,
    });
  }
  if (document.documentElement?.localName !== "package") return document;
  const root = modernPackage(document);
  for (const attribute of [...root.attributes]) {
    if (attribute.localName === "prefix" && attribute.value.length > longestPrefix) {
      root.removeAttributeNode(attribute);
    }
  }
  for (const element of [...document.getElementsByTagNameNS("*", "*")]) {
    const needed = neededAttributes[element.localName] ?? [];
    if (needed.some((attribute) => !element.hasAttribute(attribute))) element.remove();
  }
  complete(root);
  return document;
}

/**
 * Adds the parts that are missing in a package. One whose spine names no chapter is read in the order in which
 * its manifest lists them.
 */
function complete(root: Element): void {
  const [, manifest, spine] = ["metadata", "manifest", "spine"].map((name) => {
    const part = [...root.children].find(({ localName }) => localName === name);
    return part ?? root.appendChild(root.ownerDocument.createElementNS(root.namespaceURI, name));
  }) as [Element, Element, Element];
  const items = [...manifest.children];
  const ids = new Set(items.map(({ id }) => id));
  if ([...spine.children].some((line) => ids.has(line.getAttribute("idref") ?? ""))) return;
  for (const item of items) {
    const isNavigation = /\bnav\b/.test(item.getAttribute("properties") ?? "");
    if (isNavigation || !chapterTypes.test(item.getAttribute("media-type") ?? "")) continue;
    const line = root.ownerDocument.createElementNS(root.namespaceURI, "itemref");
    line.setAttribute("idref", item.id);
    spine.append(line);
  }
}

/** Attributes without which an element says nothing. */
const neededAttributes: Readonly<Record<string, readonly string[]>> = {
  item: ["id", "href", "media-type"],
  itemref: ["idref"],
  reference: ["type", "href"],
};
