/** A few words set as the reader has chosen, in the size that they have in the book. */

import { pageThemeOf } from "../element/page_theme.ts";
import { typographyOf } from "../element/typography.ts";
import {
  familyOf,
  fontsOf,
  isTypeface,
  type TypefaceName,
} from "../sources/typeset/typefaces/typefaces.ts";
import { coloursOf } from "../themes.ts";
import { make } from "./make.ts";

/** Size of usual type, CSS pixels, and its line height, where neither is chosen. */
const usual = { size: 16, line: 1.45 };

/** The families of the browser's typefaces, as books are set in them. */
const families: Readonly<Record<string, string>> = {
  "": 'Georgia, "Liberation Serif", "Times New Roman", serif',
  serif: "serif",
  "sans-serif": "sans-serif",
};

const shown = new Map<TypefaceName, Promise<void>>();

/** Returns the family in which a typeface is shown in the controls. */
export function familyShown(font: string): string {
  return isTypeface(font) ? `${familyOf(font)}, sans-serif` : (families[font] ?? "serif");
}

/** Makes a typeface of the package known to the web page, so that controls can show it. */
export function showTypeface(name: TypefaceName): void {
  if (shown.has(name)) return;
  const loading = fontsOf(name).then((fonts) => {
    for (const { bytes, weight, style, range } of fonts) {
      const face = new FontFace(familyOf(name), bytes, {
        ...{ weight: String(weight), style, unicodeRange: range },
      });
      document.fonts.add(face);
    }
  });
  shown.set(name, loading);
  // Without it its name is shown in another; a book that is set in it says what is missing.
  loading.catch(() => shown.delete(name));
}

/** A sample of the type. */
export class TypeSample {
  readonly element: HTMLElement;
  readonly #book: Element;

  /** @param text some words in the reader's language */
  constructor(text: string, book: Element) {
    this.#book = book;
    this.element = make("p", { class: "sample", "aria-hidden": "true" }, text);
  }

  /** Shows it as the type is chosen now. */
  refresh(): void {
    const { font, size, lineHeight, align, hyphens, letterSpacing, wordSpacing } = typographyOf(
      this.#book,
    );
    const colours = coloursOf(pageThemeOf(this.#book), "");
    Object.assign(this.element.style, {
      background: colours?.paper ?? "#fff",
      color: colours?.ink ?? "#000",
      fontFamily: familyShown(font),
      fontSize: `${usual.size * size}px`,
      lineHeight: String(lineHeight || usual.line),
      textAlign: align || "start",
      hyphens: hyphens || "manual",
      letterSpacing: `${letterSpacing}em`,
      wordSpacing: `${wordSpacing}em`,
    });
  }
}
