/** The face in which a book sets its titles, for what is stamped on its boards. */

import type { TitleFont } from "../page_source.ts";
import { serif } from "./serif.ts";

/** A face as a section names it: its font, and the rules of the fonts that the section is set in. */
export interface TitleFace extends TitleFont {
  readonly rules: readonly string[];
}

/** A face that is loaded in the page itself. */
export interface LoadedTitleFont extends TitleFont {
  /** Removes it from the page. */
  close(): void;
}

/** Faces so far, of all books. */
let made = 0;

/**
 * Returns the face of a section's first heading, of its text where it has none; null if the book chose
 * none for that.
 *
 * @param html the section, laid out
 * @param rules returns the rules of the fonts in which it is set, as `cleanCss` writes them
 */
export function titleFaceIn(html: Element, rules: () => readonly string[]): TitleFace | null {
  const view = html.ownerDocument.defaultView as Window;
  const titled = html.querySelector("h1, h2, h3, h4, h5, h6") ?? html.querySelector("body") ?? html;
  const { fontFamily, fontStyle, fontVariantCaps, fontWeight } = view.getComputedStyle(titled);
  if (nameOf(fontFamily) === nameOf(serif)) return null;
  // A canvas knows no others in a font.
  const caps = fontVariantCaps === "small-caps" ? "small-caps" : "normal";
  return {
    style: `${fontStyle} ${caps} ${fontWeight}`,
    family: fontFamily,
    rules: rules(),
  };
}

/**
 * Loads a face's fonts in the page itself, under names of its own. Never rejects: a font that cannot be
 * loaded is left out.
 */
export async function loadTitleFont({ style, family, rules }: TitleFace): Promise<LoadedTitleFont> {
  const prefix = `turnleaf-title-${made++}`;
  const loaded: FontFace[] = [];
  const families = family.split(",").map((name) => name.trim());
  for (const rule of rules) {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(rule);
    const { style: said } = (sheet.cssRules[0] as CSSFontFaceRule | undefined) ?? {};
    const index = families.findIndex((name) => nameOf(name) === nameOf(saidOf(said, "family")));
    if (index < 0) continue;
    try {
      const face = new FontFace(`${prefix}-${index}`, saidOf(said, "src"), {
        weight: saidOf(said, "weight") || "normal",
        style: saidOf(said, "style") || "normal",
        unicodeRange: saidOf(said, "unicode-range") || "U+0-10FFFF",
      });
      document.fonts.add(await face.load());
      loaded.push(face);
    } catch {
      // Damaged, or the page's policy does not allow it.
    }
  }
  const names = families.map((name, index) =>
    loaded.some((face) => nameOf(face.family) === `${prefix}-${index}`)
      ? `"${prefix}-${index}"`
      : name,
  );
  return {
    style,
    family: names.join(", "),
    close: () => {
      for (const face of loaded) document.fonts.delete(face);
    },
  };
}

/** Returns what a rule says of a font; "" for nothing. */
function saidOf(said: CSSStyleDeclaration | undefined, name: string): string {
  const isUnprefixed = name === "src" || name === "unicode-range";
  return said?.getPropertyValue(isUnprefixed ? name : `font-${name}`) ?? "";
}

/** Returns families without what may be written otherwise: quotes, blanks and capitals. */
function nameOf(family: string): string {
  return family.replace(/["'\s]/g, "").toLowerCase();
}
