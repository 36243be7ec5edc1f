/**
 * Shorthands with variables in their values, such as `border: 1px solid var(--ink)`. What such a one says of a
 * part is not known before the variables are, so browsers have no value for the parts, nor for the shorthand
 * once another declaration overrides a part. They are carried through the browser's reading of a style sheet
 * as custom properties, which it keeps as they are written, in their place among the others.
 */

/** What the name of the custom property begins with. */
const prefix = "--carried-";

/** A comment, or a string, in which one may seem to begin. */
const commentOrString =
  /"(?:[^"\\\n\r\f]|\\[\s\S])*"?|'(?:[^'\\\n\r\f]|\\[\s\S])*'?|\/\*[\s\S]*?(?:\*\/|$)/g;

/** A declaration with what is before it; a selector goes on with a block. */
const declaration = /(^|[{};])(\s*)([a-z-]+)(\s*:[^{};]*)(?=[;}]|$)/gi;

const variable = /\bvar\(/i;

/** Shorthands, by names that are looked for. */
const shorthands = new Map<string, boolean>();

/** A rule without a document, by which the browser says what a property is. */
const probe = (() => {
  const sheet = new CSSStyleSheet();
  sheet.insertRule("x {}");
  return (sheet.cssRules[0] as CSSStyleRule).style;
})();

/** Returns a style sheet, or declarations, with its shorthands carried where variables are in them. */
export function withCarriedShorthands(css: string): string {
  if (!variable.test(css)) return css;
  return css
    .replace(commentOrString, (text) => (text.startsWith("/") ? "" : text))
    .replace(declaration, (text, before: string, space: string, name: string, value: string) =>
      variable.test(value) && isShorthand(name.toLowerCase())
        ? `${before}${space}${prefix}${name.toLowerCase()}${value}`
        : text,
    );
}

/** Returns the name of a property, which is another than its own if it carries a shorthand. */
export function carriedName(name: string): string {
  return name.startsWith(prefix) ? name.slice(prefix.length) : name;
}

function isShorthand(name: string): boolean {
  const known = shorthands.get(name);
  if (known !== undefined) return known;
  probe.setProperty(name, "inherit");
  // Another name for a property, such as `page-break-before`, is like one.
  const isOne = probe.length > 1 || (probe.length === 1 && probe[0] !== name);
  probe.cssText = "";
  shorthands.set(name, isOne);
  return isOne;
}
