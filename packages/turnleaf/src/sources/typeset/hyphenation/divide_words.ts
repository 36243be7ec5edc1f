/** Divides words at the ends of lines where the browser is asked to and does not know their language. */

import { type Divide, loadPatterns, patternsOf } from "./patterns.ts";

/** A word that is divided in every language that there are patterns for. */
const probe = "internationale";

/** What may be divided: a text that is longer is no prose. */
const mostLetters = 100_000;

/** Whether the browser divides words of a language. */
const divides = new Map<string, boolean>();

/**
 * Puts soft hyphens into the words of a section whose style asks for hyphens, in languages that the
 * browser does not divide and of which there are patterns. Rejects with a `BookError` if these cannot
 * be loaded.
 *
 * @param body the section's body, with its style sheets
 */
export async function divideWords(body: Element): Promise<void> {
  const { ownerDocument } = body;
  const view = ownerDocument.defaultView as Window;
  const texts = new Map<string, Text[]>();
  const walker = ownerDocument.createTreeWalker(body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode() as Text | null; node; node = walker.nextNode() as Text | null) {
    const parent = node.parentElement as Element;
    if (node.length > mostLetters || !/\p{L}{5}/u.test(node.data)) continue;
    const { hyphens, whiteSpace } = view.getComputedStyle(parent);
    if (hyphens !== "auto" || whiteSpace.startsWith("pre")) continue;
    const language = languageOf(parent);
    const name = patternsOf(language);
    if (name === null || canDivide(body, language)) continue;
    const alike = texts.get(name);
    if (alike) alike.push(node);
    else texts.set(name, [node]);
  }
  const named = await Promise.all(
    [...texts].map(async ([name, nodes]) => [await loadPatterns(name), nodes] as const),
  );
  for (const [divide, nodes] of named) for (const node of nodes) divideText(node, divide);
}

function divideText(node: Text, divide: Divide): void {
  const divided = divide(node.data);
  if (divided !== node.data) node.data = divided;
}

/** Returns the language of an element's text; "" if none is said. */
export function languageOf(element: Element): string {
  const said = element.closest("[lang], [xml\\:lang]");
  return said?.getAttribute("lang") ?? said?.getAttribute("xml:lang") ?? "";
}

/** Returns whether the browser itself divides words of a language. */
export function canDivide(body: Element, language: string): boolean {
  const known = divides.get(language);
  if (known !== undefined) return known;
  const box = body.ownerDocument.createElement("div");
  box.lang = language;
  box.style.cssText =
    "all: initial; position: absolute; width: 0; hyphens: auto; font: 16px/16px serif";
  box.textContent = probe;
  body.append(box);
  const can = box.scrollHeight > 24;
  box.remove();
  divides.set(language, can);
  return can;
}
