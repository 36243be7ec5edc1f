/** The typefaces of a page as data: an image of it has no others but the system's. */

import { dataUrl } from "../data_url.ts";
import { fetchChecked, readBounded } from "../fetch_bytes.ts";

/** Bytes of one font, and how many a page has. */
const mostBytes = 4_000_000;
const mostFonts = 40;

/** Fonts by their addresses, as data; null if one cannot be read. */
const fonts = new Map<string, Promise<string | null>>();

/**
 * Returns the rules of the loaded fonts of some families, with the fonts in
 * them. A font that cannot be read again is left out.
 *
 * @param families in lower case
 * @param root of the tree in which they are used
 */
export async function fontRules(
  document: Document,
  families: ReadonlySet<string>,
  root: Node,
): Promise<string> {
  const loaded = new Set<string>();
  for (const { family, status, unicodeRange } of document.fonts) {
    if (status === "loaded") loaded.add(`${unquoted(family)} ${unicodeRange.toLowerCase()}`);
  }
  if (loaded.size === 0) return "";
  const sheets = [document, root].flatMap((tree) =>
    "styleSheets" in tree ? [...tree.styleSheets, ...tree.adoptedStyleSheets] : [],
  ) as CSSStyleSheet[];
  const rules = [...new Set(sheets)].flatMap(fontFacesIn).filter(({ style }) => {
    const family = unquoted(style.getPropertyValue("font-family"));
    const range = style.getPropertyValue("unicode-range").toLowerCase() || "u+0-10ffff";
    return families.has(family) && loaded.has(`${family} ${range}`);
  });
  const texts = rules.slice(0, mostFonts).map((rule) => embedded(rule, document.baseURI));
  return (await Promise.all(texts)).join("");
}

/** Returns the rules of fonts in a style sheet or a group of rules; none of a sheet that may not be read. */
function fontFacesIn(sheet: { readonly cssRules: CSSRuleList }): CSSFontFaceRule[] {
  try {
    return [...sheet.cssRules].flatMap((rule) => {
      if (rule.constructor.name === "CSSFontFaceRule") return rule as CSSFontFaceRule;
      const { styleSheet } = rule as CSSImportRule;
      if (styleSheet) return fontFacesIn(styleSheet);
      return "cssRules" in rule ? fontFacesIn(rule as CSSGroupingRule) : [];
    });
  } catch {
    // Of another site, which does not let this one read it.
    return [];
  }
}

async function embedded(rule: CSSFontFaceRule, base: string): Promise<string> {
  const source = rule.style.getPropertyValue("src");
  const address = /url\("((?:[^"\\]|\\.)*)"\)/.exec(source)?.[1];
  if (address === undefined) return "";
  const data = await fontAt(new URL(address, rule.parentStyleSheet?.href ?? base).href);
  if (data === null) return "";
  let text = "";
  for (const name of rule.style) {
    if (name !== "src") text += `${name}:${rule.style.getPropertyValue(name)};`;
  }
  return `@font-face{${text}src:url("${data}")}`;
}

function fontAt(address: string): Promise<string | null> {
  const known = fonts.get(address);
  if (known) return known;
  const font = address.startsWith("data:")
    ? Promise.resolve(address)
    : fetchChecked(address, address, {})
        .then((response) => readBounded(response, mostBytes, address))
        .then((bytes) => dataUrl(bytes, "font/woff2"))
        .catch(() => null);
  fonts.set(address, font);
  return font;
}

/** Returns the name of a typeface as it is compared. */
export function unquoted(family: string): string {
  return family
    .trim()
    .replace(/^(["'])(.*)\1$/, "$2")
    .toLowerCase();
}
