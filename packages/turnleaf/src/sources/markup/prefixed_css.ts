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

/** A declaration of the forms of letters: with one that it does not know, a browser knows none of its words. */
const letterForms =
  /(?<=^|[\s;{}"'])text-transform\s?:\s{0,9}([a-z][a-z\s-]{0,60})(!\s?important\s{0,9})?(?=[;}"']|$)/gi;

/** The forms that are applied as text is laid out, where the browser does not know them. */
const ownForms = ["full-width", "full-size-kana"].filter(
  (form) => !CSS.supports("text-transform", form),
);

/** The property by which those are handed on: it is inherited as `text-transform` is. */
export const letterFormsProperty = "--laid-letter-forms";

/** Stands beside a declaration of that property which is more than none. */
export const letterFormsMark = "--laid-by-letter-form";

/** Returns a style sheet, or declarations, in today's properties. */
export function withoutPrefixes(css: string): string {
  if (!/-epub-|-webkit-initial|break-|text-transform/i.test(css)) return css;
  return renamed
    .reduce((text, [prefixed, today]) => text.replace(prefixed, today), css)
    .replace(/(^|[\s;{"])-epub-/gi, "$1")
    .replace(letterForms, knownForms);
}

/** Returns a declaration in the forms that the browser knows, and beside it those that it does not. */
function knownForms(declaration: string, value: string, important = ""): string {
  if (ownForms.length === 0) return declaration;
  const words = value.trim().toLowerCase().split(/\s+/);
  const own = words.filter((word) => ownForms.includes(word));
  const [first = ""] = words;
  if (own.length === 0) {
    const inherited = /^(?:inherit|unset|revert|revert-layer)$/.test(first) ? first : "none";
    return `${declaration}; ${letterFormsProperty}: ${inherited} ${important}`;
  }
  const known = words.filter((form) => CSS.supports("text-transform", form));
  return `text-transform: ${known.join(" ") || "none"} ${important}; ${letterFormsProperty}: ${own.join(" ")} ${important}; ${letterFormsMark}: 1`;
}
