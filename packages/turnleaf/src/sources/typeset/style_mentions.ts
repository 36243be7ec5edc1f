/**
 * What the style of a section says anything of. A chapter may have tens of thousands of elements, and each
 * question for a computed style may have the browser lay out: what no style mentions is not asked for.
 */

import { textElements } from "./text_elements.ts";

/** Pictures and fonts in style sheets, as `cleanCss` writes them. */
const dataAddress = /url\("data:[^"]*"\)/g;

/** Characters of a property's name, at most. */
const longestName = 40;

/** The properties that style sheets name, by the list of these: that of a chapter is the same for all its pieces. */
const named = new WeakMap<readonly string[], ReadonlySet<string>>();

/** Returns the elements in a section's body but for the ends of lines, which are no boxes. */
export function boxesIn(body: Element): NodeListOf<HTMLElement> {
  return body.querySelectorAll<HTMLElement>(":not(br, wbr)");
}

/** The style of one section. */
export class StyleMentions {
  readonly #names: ReadonlySet<string>;
  readonly #html: Element;

  /**
   * @param sheets the section's style sheets, as `cleanCss` writes them: each property has its usual name
   * @param html its element, with its inline styles
   */
  constructor(sheets: readonly string[], html: Element) {
    this.#names = named.get(sheets) ?? new Set(sheets.flatMap(namesIn));
    named.set(sheets, this.#names);
    this.#html = html;
  }

  /** Returns whether style sheets, or elements by themselves, now give any of some properties a value. */
  has(properties: readonly string[]): boolean {
    if (properties.some((name) => this.#names.has(name))) return true;
    // Drawings have properties as attributes.
    if (this.#html.querySelector(properties.map((name) => `[${name}]`).join(","))) return true;
    const own = [this.#html, ...this.#html.querySelectorAll("[style]")];
    return own.some((element) =>
      namesIn(element.getAttribute("style") ?? "").some((name) => properties.includes(name)),
    );
  }

  /**
   * Returns the elements in a section's body to which some properties may apply: all boxes where style
   * mentions one, and else those to which browsers may give them: none of text.
   */
  boxesWith(body: Element, properties: readonly string[]): NodeListOf<HTMLElement> {
    return this.has(properties)
      ? boxesIn(body)
      : body.querySelectorAll<HTMLElement>(`:not(br, ${textElements})`);
  }
}

/** Returns the names in a style sheet that stand before a colon: those of all its properties, and others. */
function namesIn(css: string): readonly string[] {
  return css
    .replace(dataAddress, "")
    .split(":")
    .map(
      (before) =>
        before
          .trimEnd()
          .slice(-longestName)
          .split(/[^\w-]/)
          .pop() ?? "",
    );
}
