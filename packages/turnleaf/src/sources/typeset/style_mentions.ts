/**
 * What the style of a section says anything of. A chapter may have tens of thousands of elements, and each
 * question for a computed style may have the browser lay out: what no style mentions is not asked for.
 */

import { textElements } from "./text_elements.ts";

/** Pictures and fonts in style sheets, as `cleanCss` writes them. */
const dataAddress = /url\("data:[^"]*"\)/g;

/** Characters of a property's name, at most. */
const longestName = 40;

/** Style sheets without the data of their pictures and fonts, and the properties that they name. */
interface SheetContents {
  readonly sheets: readonly string[];
  readonly names: ReadonlySet<string>;
}

/** These by the list of style sheets: that of a chapter is the same for all its pieces. */
const known = new WeakMap<readonly string[], SheetContents>();

/** Returns the elements in a section's body but for the ends of lines, which are no boxes. */
export function boxesIn(body: Element): NodeListOf<HTMLElement> {
  return body.querySelectorAll<HTMLElement>(":not(br, wbr)");
}

/** The style of one section. */
export class StyleMentions {
  /** The section's style sheets without their pictures and fonts, which may be megabytes. */
  readonly sheets: readonly string[];
  readonly #names: ReadonlySet<string>;
  readonly #html: Element;

  /**
   * @param sheets the section's style sheets, as `cleanCss` writes them: each property has its usual name
   * @param html its element, with its inline styles
   */
  constructor(sheets: readonly string[], html: Element) {
    const contents = known.get(sheets) ?? contentsOf(sheets);
    known.set(sheets, contents);
    this.sheets = contents.sheets;
    this.#names = contents.names;
    this.#html = html;
  }

  /** Returns whether style sheets, or elements by themselves, now give any of some properties a value. */
  has(properties: readonly string[]): boolean {
    if (properties.some((name) => this.#names.has(name))) return true;
    // Drawings have properties as attributes.
    if (this.#html.querySelector(properties.map((name) => `[${name}]`).join(","))) return true;
    const own = [this.#html, ...this.#html.querySelectorAll("[style]")];
    return own.some((element) =>
      namesIn(withoutData(element.getAttribute("style") ?? "")).some((name) =>
        properties.includes(name),
      ),
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

/** Returns a style sheet, or declarations, without the data of pictures and fonts. */
function withoutData(css: string): string {
  return css.replace(dataAddress, "");
}

/** Returns what there is in style sheets. */
function contentsOf(sheets: readonly string[]): SheetContents {
  const bare = sheets.map(withoutData);
  return { sheets: bare, names: new Set(bare.flatMap(namesIn)) };
}

/** Returns the names in a style sheet that stand before a colon: those of all its properties, and others. */
function namesIn(css: string): readonly string[] {
  return css.split(":").map(
    (before) =>
      before
        .trimEnd()
        .slice(-longestName)
        .split(/[^\w-]/)
        .pop() ?? "",
  );
}
