/** A few words set as the reader has chosen, in the size that they have in the book. */

import { pageThemeOf } from "../element/page_theme.ts";
import { typographyOf } from "../element/typography.ts";
import { loadedOnce } from "../sources/loaded_once.ts";
import {
  familyOf,
  fontsOf,
  stackOf,
  type TypefaceName,
} from "../sources/typeset/typefaces/typefaces.ts";
import { coloursOf } from "../themes.ts";
import { make } from "./make.ts";

/** Size of usual type, CSS pixels, and its line height, where neither is chosen. */
const usual = { size: 16, line: 1.45 };

const makeKnown = loadedOnce(async (name: TypefaceName) => {
  for (const { bytes, weight, style, range } of await fontsOf(name)) {
    const face = new FontFace(familyOf(name), bytes, {
      ...{ weight: String(weight), style, unicodeRange: range },
    });
    document.fonts.add(face);
  }
});

/** Makes a typeface of the package known to the web page, so that controls can show it. */
export function showTypeface(name: TypefaceName): void {
  // Without it its name is shown in another; a book that is set in it says what is missing.
  makeKnown(name).catch(() => {});
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
      fontFamily: stackOf(font),
      fontSize: `${usual.size * size}px`,
      lineHeight: String(lineHeight || usual.line),
      textAlign: align || "start",
      hyphens: hyphens || "manual",
      letterSpacing: `${letterSpacing}em`,
      wordSpacing: `${wordSpacing}em`,
    });
  }
}
