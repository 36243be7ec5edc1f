/**
 * Type that is larger than a page. A browser scrolls to what has no room in its window; on paper a letter
 * that is wider than a line, or a line that is higher than a page, is cut. It is made as large as there is
 * room for, in text and in what style sheets add to it.
 */

import { setStyles } from "./box_styles.ts";
import { drawingOf } from "./frame.ts";

/** How high a line of usual typefaces is, over the size of its type. */
const lineHeight = 1.5;

/** Names the parts of an element, of those that style sheets make, that are fitted. */
const generatedAttribute = "data-turnleaf-generated";

/** What such a part has for the size of its type, where its own has no room. */
const typeProperty = "--laid-largest-type";

const typeDeclarations = `font-size: var(${typeProperty}) !important; line-height: normal !important;`;

/** The style sheet of what is fitted in elements that style sheets make. */
export const generatedStyle: string = `
${["first-letter", "before", "after"]
  .map((part) => `[${generatedAttribute}~="${part}-type"]::${part} { ${typeDeclarations} }`)
  .join("\n")}
[${generatedAttribute}~="initial"]::first-letter { initial-letter: normal !important; }
${["before", "after"]
  .map(
    (part) =>
      `[${generatedAttribute}~="${part}-room"]::${part} { block-size: auto !important; min-block-size: 0 !important; padding-block: 0 !important; border-block-width: 0 !important; margin-block: 0 !important; }`,
  )
  .join("\n")}
`;

/** What of a part that style sheets make is fitted. */
type GeneratedFit =
  | `${"first-letter" | "before" | "after"}-type`
  | `${"before" | "after"}-room`
  | "initial";

/** Has a part that style sheets make of an element fit. */
export function fitGenerated(element: Element, fit: GeneratedFit): void {
  const own = element.getAttribute(generatedAttribute)?.split(" ") ?? [];
  element.setAttribute(generatedAttribute, [...new Set([...own, fit])].join(" "));
}

/** Has such a part be as its style sheets say again. */
export function unfitGenerated(element: Element, fit: GeneratedFit): void {
  const others = element
    .getAttribute(generatedAttribute)
    ?.split(" ")
    .filter((one) => one !== fit);
  if (others && others.length > 0) element.setAttribute(generatedAttribute, others.join(" "));
  else element.removeAttribute(generatedAttribute);
}

/**
 * Makes the type in a section fit.
 *
 * @param body the section's body, laid out
 * @param line the length of its lines, CSS pixels
 * @param page the length of a page across them, likewise; infinite if pages hang together
 * @param styles the style sheets of the section
 */
export function fitType(
  body: HTMLElement,
  { line, page }: { readonly line: number; readonly page: number },
  styles: readonly string[],
): void {
  const view = body.ownerDocument.defaultView as Window;
  const largest = Math.min(line, page / lineHeight);
  const known = new Set<Element>();
  const texts = body.ownerDocument.createTreeWalker(body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { nodeValue, parentElement } = texts.currentNode;
    if (!nodeValue?.trim() || !parentElement) continue;
    // What a box in a line is in stands in the line too.
    for (let box = parentElement; !known.has(box); box = box.parentElement as HTMLElement) {
      known.add(box);
      // Type of a drawing is in its own units.
      if (drawingOf(box, body) !== box) break;
      const style = view.getComputedStyle(box);
      const change = typeChange(box, style, page, largest);
      if (Object.keys(change).length > 0) setStyles(box, change);
      if (box === body || style.display !== "inline") break;
    }
  }
  const parts = (["first-letter", "before", "after"] as const).filter((part) =>
    styles.some((css) => css.includes(`:${part}`)),
  );
  if (parts.length === 0) return;
  body.style.setProperty(typeProperty, `${largest}px`, "important");
  for (const element of body.querySelectorAll<HTMLElement>("*")) {
    const { width, height } = element.getBoundingClientRect();
    // Such a part is larger than a page only if what it is in is, or goes on on the next; a letter may float in it.
    const isLarge = Math.max(width, height) > largest;
    for (const part of parts) {
      if (!isLarge && part !== "first-letter") continue;
      const { content, fontSize } = view.getComputedStyle(element, `::${part}`);
      const isThere = part === "first-letter" || !/^(?:none|normal)$/.test(content);
      if (isThere && Number.parseFloat(fontSize) > largest) fitGenerated(element, `${part}-type`);
    }
  }
}

/** Returns the styles by which the type of a box fits. */
function typeChange(
  box: HTMLElement,
  style: CSSStyleDeclaration,
  page: number,
  largest: number,
): Record<string, string> {
  // Zoom is not in lengths that are computed.
  const zoom = (box as Partial<{ currentCSSZoom: number }>).currentCSSZoom ?? 1;
  const px = (value: string): number =>
    (value.endsWith("px") ? Number.parseFloat(value) : 0) * zoom;
  const change: Record<string, string> = {};
  if (px(style.fontSize) > largest) change["font-size"] = `${largest / zoom}px`;
  if (px(style.lineHeight) > page) change["line-height"] = "normal";
  // A line about letters that is as wide as they are covers them, and takes long to draw.
  const isCovered = px(style.webkitTextStrokeWidth) > px(style.fontSize);
  if (isCovered) change["-webkit-text-stroke-width"] = "0";
  if (Math.abs(px(style.verticalAlign)) > page / 2) change["vertical-align"] = "baseline";
  return change;
}
