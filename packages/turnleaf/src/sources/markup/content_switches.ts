/** Content switches, of EPUB 3.0 and of SVG: one content in several languages of markup, of which a reader shows one. */

import { takeContent } from "./take_content.ts";

const html = "http://www.w3.org/1999/xhtml";
const ops = "http://www.idpf.org/2007/ops";
const math = "http://www.w3.org/1998/Math/MathML";

/** Languages of markup that the browser shows. */
const shown: ReadonlySet<string> = new Set([
  html,
  "http://www.w3.org/2000/svg",
  ...("MathMLElement" in globalThis ? [math] : []),
]);

/**
 * Replaces each switch of a document by the content of its first case that the browser shows, or else by
 * its default. A link to the switch leads to what is shown of it.
 *
 * @param lost called with a switch of which nothing can be shown, and the language of its first case
 */
export function resolveSwitches(
  document: Document,
  lost: (element: Element, language: string) => void,
): void {
  for (const element of [...document.getElementsByTagName("*")]) {
    if (!isNamed(element, "switch") || !element.isConnected) continue;
    const children = [...element.children];
    const cases = children.filter((one) => isNamed(one, "case"));
    const chosen =
      cases.find((one) => shown.has(languageOf(one))) ??
      children.find((one) => isNamed(one, "default"));
    if (chosen) {
      keepId(element, chosen);
      element.replaceWith(takeContent(chosen));
    } else {
      lost(element, cases[0] ? languageOf(cases[0]) : "");
      element.remove();
    }
  }
}

/**
 * Leaves out the parts of a document's drawings that ask for a language of markup that is not shown. EPUB's own
 * stands for XHTML in them.
 */
export function resolveExtensions(root: Element): void {
  for (const element of root.querySelectorAll("[requiredExtensions]")) {
    const asked = (element.getAttribute("requiredExtensions") ?? "").split(/\s+/).filter(Boolean);
    if (asked.length === 0 || !asked.every((one) => one === ops || shown.has(one)))
      element.remove();
    else element.removeAttribute("requiredExtensions");
  }
}

const languageOf = (one: Element): string => (one.getAttribute("required-namespace") ?? "").trim();

/** Returns whether an element is a part of a switch: with a prefix, which is a part of its name in HTML, or without. */
function isNamed({ namespaceURI, localName }: Element, name: string): boolean {
  return namespaceURI === html
    ? localName === `epub:${name}`
    : namespaceURI === ops && localName === name;
}

/** Gives the first element of what is shown the id of its switch, or puts one before it that has it. */
function keepId(element: Element, chosen: Element): void {
  const { id } = element;
  if (id === "") return;
  const first = chosen.firstElementChild;
  if (first && first.id === "") first.id = id;
  else {
    const place = element.ownerDocument.createElementNS(html, "span");
    place.id = id;
    chosen.prepend(place);
  }
}
