/** What style sheets of books say in words that the browser does not know: EPUB 3's prefixed properties, and breaks. */

/** Names and values that are not the same without the prefix, by EPUB's own list of them. */
const renamed: readonly (readonly [prefixed: RegExp, today: string])[] = [
  [/-epub-text-combine\s*:\s*horizontal/gi, "text-combine-upright: all"],
  [/-epub-text-combine(-horizontal)?(?=\s*:)/gi, "text-combine-upright"],
  [/-epub-(text-orientation\s*:\s*)(sideways-right|rotate-right|rotate-normal)/gi, "$1sideways"],
  [/-epub-(text-orientation\s*:\s*)vertical-right/gi, "$1mixed"],
  [/-epub-(text-underline-position\s*:\s*)alphabetic/gi, "$1auto"],
  [/-epub-fullwidth/gi, "full-width"],
  // No browser knows this value, though CSS has it.
  [/(?<![\w-])(break-(?:before|after)\s*:\s*)(?:always|all)\b/gi, "$1page"],
];

/** Returns a style sheet, or declarations, in today's properties. */
export function withoutPrefixes(css: string): string {
  if (!/-epub-|break-/i.test(css)) return css;
  return renamed
    .reduce((text, [prefixed, today]) => text.replace(prefixed, today), css)
    .replace(/(^|[\s;{"])-epub-/gi, "$1");
}
