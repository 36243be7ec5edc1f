/** The XML in which files beside a comic's pages say what it is. */

import { cleanText } from "../book_text.ts";
import { readMarkup } from "../markup/read_markup.ts";

/** Returns the root of a document, repaired if need be; null if it is another's. */
export async function metadataRoot(xml: string, name: string): Promise<Element | null> {
  // It has no declarations, and those of others could define entities of any size.
  if (/<!DOCTYPE/i.test(xml)) return null;
  const root = (await readMarkup(xml, "application/xml")).document.documentElement;
  return root.localName.toLowerCase() === name.toLowerCase() ? root : null;
}

/**
 * Returns the text of the first element of a name, without that of others in it: what stands after an element
 * without an end is within that.
 */
export function textIn(root: Element | undefined, name: string): string {
  return textOf(root?.getElementsByTagNameNS("*", name)[0]);
}

/** Returns the texts of all elements of a name, up to a number of them. */
export function textsIn(root: Element, name: string, most: number): string[] {
  const all = [...root.getElementsByTagNameNS("*", name)].slice(0, most).map(textOf);
  return all.filter((text) => text !== "");
}

function textOf(element: Element | undefined): string {
  const nodes = [...(element?.childNodes ?? [])].filter(({ nodeType }) => nodeType !== 1);
  return cleanText(nodes.map(({ nodeValue }) => nodeValue).join(""));
}
