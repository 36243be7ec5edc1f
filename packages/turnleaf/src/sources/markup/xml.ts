/** Documents as XML that every browser parses: what is drawn as an image of SVG is written by this alone. */

/** Characters that no XML may contain, not even escaped (XML 1.0, 2.2), and halves of characters. */
export const forbidden: RegExp =
  // biome-ignore lint/suspicious/noControlCharactersInRegex: they are what is found
  /[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]|\p{Surrogate}/gu;

/** Names that HTML and XML allow alike for an attribute, of letters that books use for them. */
const plainName = /^[A-Z_a-z][\w.-]*$/;

/** Returns an element and what is in it as well-formed XML, without the characters that XML forbids. */
export function xmlOf(element: Element): string {
  return new XMLSerializer().serializeToString(element).replace(forbidden, "");
}

/** Returns text as XML: escaped, without the characters that XML forbids. */
export function xmlText(text: string): string {
  // Of ">" XML forbids "]]>".
  const legal = text.replace(forbidden, "").replaceAll("&", "&amp;");
  return legal.replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

/**
 * Returns whether an attribute can be written as XML: HTML allows names that XML
 * does not, and prefixes that nothing declares.
 */
export function isXmlAttribute({ name, namespaceURI }: Attr): boolean {
  return namespaceURI === null ? plainName.test(name) || name === "xml:lang" : true;
}
