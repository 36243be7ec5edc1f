/** What style sheets of books say in words that the browser does not know: prefixed properties, as EPUB 3's, and breaks. */

/** Names and values that are not the same without the prefix, by EPUB's own list of them. */
const renamed: readonly (readonly [prefixed: RegExp, today: string])[] = [
  [/-epub-text-combine\s*:\s*horizontal/gi, "text-combine-upright: all"],
  [/-epub-text-combine(-horizontal)?(?=\s*:)/gi, "text-combine-upright"],
  [/-epub-(text-orientation\s*:\s*)(sideways-right|rotate-right|rotate-normal)/gi, "$1sideways"],
  [/-epub-(text-orientation\s*:\s*)vertical-right/gi, "$1mixed"],
  [/-epub-(text-underline-position\s*:\s*)alphabetic/gi, "$1auto"],
  [/-epub-fullwidth/gi, "full-width"],
  // As WebKit calls it.
  [/-webkit-(?=initial-letter\s*:)/gi, ""],
  // No browser knows this value, though CSS has it.
  [/(?<![\w-])(break-(?:before|after)\s*:\s*)(?:always|all)\b/gi, "$1page"],
];

/** The forms of letters that a style asks for: the words of one value, with which a browser knows all or none. */
const letterForms = /(?<=text-transform\s?:\s{0,9})[a-z][a-z\s-]{0,60}/gi;

/** Returns a style sheet, or declarations, in today's properties. */
export function withoutPrefixes(css: string): string {
  if (!/-epub-|-webkit-initial|break-|full-/i.test(css)) return css;
  return renamed
    .reduce((text, [prefixed, today]) => text.replace(prefixed, today), css)
    .replace(/(^|[\s;{"])-epub-/gi, "$1")
    .replace(letterForms, knownForms);
}

/** Returns the forms of a value that the browser knows, if it knows any. */
function knownForms(forms: string): string {
  const known = forms.split(/\s+/).filter((form) => CSS.supports("text-transform", form));
  return known.length > 0 ? known.join(" ") : forms;
}
