/** Style sheets of books: what could fetch anything is taken out or put in as data. */

import { limits } from "../limits.ts";
import type { LostPart } from "../typeset/flow_book.ts";
import { carriedName, withCarriedShorthands } from "./carried_shorthands.ts";
import { pagedDeclaration } from "./paged_css.ts";
import { withoutPrefixes } from "./prefixed_css.ts";

/** Functions that name something to load, in any of their spellings. */
const loading = /(url|src|image|image-set|-webkit-image-set|cross-fade|-webkit-cross-fade)\s*\(/i;

/** An address as the browser writes it, in double quotes. */
const address = /url\("((?:[^"\\]|\\.)*)"\)/g;

/** A string of a style sheet; it ends where the line does, so that each is gone through once. */
const string = /"(?:[^"\\\n\r\f]|\\[\s\S])*"?|'(?:[^'\\\n\r\f]|\\[\s\S])*'?/g;

/**
 * Pseudo-classes that are true of other elements, or of none, where a section is drawn than where it is
 * laid out, and selectors that are as specific and mean the same in both.
 */
const drawnNames: Readonly<Record<string, string>> = {
  ":root": "html",
  ":link": ":where(a, area)[href]",
  ":any-link": ":where(a, area)[href]",
  ":visited": ":not(*)",
};
const unlikeInDrawing = /:(?:root|link|any-link|visited)\b/g;

/** Characters of a condition that could end its rule, or a string in it. */
const endsRule = /["'{};\\]/;

/** The name of a layer, or of an animation; one of other characters could end its rule. */
const layerName = /^[\w.-]*$/;

/** The name of a property; a custom one of other characters could end its declaration. */
const propertyName = /^[\w\u0080-\uffff-]+$/;

/** A picture or a font in a clean style sheet. */
const dataAddress = /url\("data:[^"]*"\)/g;

/** Returns the data of an address of a style sheet, null if there are none. */
export type ResolveCss = (address: string) => Promise<string | null>;

/** How the addresses of a style sheet are resolved: those of fonts may be alternatives of one. */
interface Resolvers {
  readonly font: ResolveCss;
  readonly picture: ResolveCss;
}

/** A clean style sheet. */
export interface CleanSheet {
  /** Its prefixes of namespaces, which stand before all rules. */
  readonly namespaces: string;
  readonly rules: string;
  /** What it names and cannot be shown, or it itself if it cannot be read. */
  readonly lost?: readonly LostPart[];
}

/**
 * Returns a style sheet as the browser understands it, its addresses replaced
 * by data. What cannot be replaced is left out, and so are imports: these are
 * resolved before.
 *
 * @param nameOf returns how a warning names the file at an address
 */
export async function cleanCss(
  css: string,
  resolve: ResolveCss,
  nameOf: (address: string) => string = (address) => address,
): Promise<CleanSheet> {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(readable(css));
  const namespaces = [...sheet.cssRules].filter((rule) => rule instanceof CSSNamespaceRule);
  const lost: LostPart[] = [];
  const picture: ResolveCss = async (address) => {
    const data = await resolve(address);
    if (data === null && lost.length < limits.warnings) {
      lost.push({ code: "image", source: nameOf(address) });
    }
    return data;
  };
  return {
    namespaces: namespaces.map((rule) => rule.cssText).join("\n"),
    rules: await cleanRules(sheet.cssRules, { font: resolve, picture }),
    lost,
  };
}

/** Returns style sheets that apply to some media as the browser writes these; "" for all. */
export function inMedia(sheets: readonly CleanSheet[], media: string): readonly CleanSheet[] {
  const { mediaText } = new CSSStyleSheet({ media }).media;
  if (mediaText === "") return sheets;
  // A browser keeps conditions that it does not know.
  const known = endsRule.test(mediaText) ? "not all" : mediaText;
  return sheets.map((sheet) => ({ ...sheet, rules: `@media ${known} { ${sheet.rules} }` }));
}

/**
 * Reads clean style sheets one after the other. The first one that is too much for a chapter, and all
 * after it, are left out.
 */
export async function readSheets(
  readers: Iterable<() => Promise<readonly CleanSheet[]>>,
): Promise<readonly CleanSheet[]> {
  const sheets: CleanSheet[] = [];
  let [length, bare] = [0, 0];
  for (const read of readers) {
    for (const sheet of await read()) {
      length += lengthOf(sheet);
      bare += sheet.rules.replace(dataAddress, "").length;
      if (length > limits.chapterBytes || bare > limits.markupBytes) return sheets;
      sheets.push(sheet);
    }
  }
  return sheets;
}

/** Returns a style sheet's characters. */
export function lengthOf({ namespaces, rules }: CleanSheet): number {
  return namespaces.length + rules.length;
}

/** Returns a clean style sheet as text. */
export function cssOf({ namespaces, rules }: CleanSheet): string {
  return namespaces === "" ? rules : `${namespaces}\n${rules}`;
}

/** Returns the declarations of a style attribute, cleaned alike. */
export async function cleanStyleAttribute(css: string, resolve: ResolveCss): Promise<string> {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(`x { ${readable(css.replace(/[{}]/g, ""))} }`);
  const [rule] = sheet.cssRules;
  return rule instanceof CSSStyleRule ? await cleanDeclarations(rule.style, resolve) : "";
}

/** Returns a style sheet, or declarations, as the browser understands all of it. */
function readable(css: string): string {
  return withCarriedShorthands(withoutPrefixes(css));
}

async function cleanDeclarations(style: CSSStyleDeclaration, resolve: ResolveCss): Promise<string> {
  const kept: string[] = [];
  for (const property of style) {
    const name = carriedName(property);
    if (!propertyName.test(name)) continue;
    const value = await cleanValue(style.getPropertyValue(property), resolve);
    const priority = style.getPropertyPriority(property) === "" ? "" : " !important";
    if (value !== null) kept.push(pagedDeclaration(name, value, priority));
  }
  return kept.join(" ");
}

/** Declarations without a document, by which the browser parses values. */
const [probe] = (() => {
  const sheet = new CSSStyleSheet();
  sheet.insertRule("x {}");
  return [...sheet.cssRules] as [CSSStyleRule];
})();

/** Returns whether an attribute is a property of CSS, as those that present drawings are, and could load anything. */
export function mayLoad({ name, value }: Attr): boolean {
  // Data of pictures is long, and has neither.
  const isCandidate = value.includes("\\") || (value.includes("(") && loading.test(value));
  return isCandidate && CSS.supports(name, "inherit");
}

/** Returns the value of an attribute that is a property, cleaned alike; null if it would load anything else. */
export async function cleanAttribute(
  { name, value }: Attr,
  resolve: ResolveCss,
): Promise<string | null> {
  probe.style.setProperty(name, value);
  const parsed = probe.style.getPropertyValue(name);
  probe.style.removeProperty(name);
  return parsed === "" ? null : await cleanValue(parsed, resolve);
}

async function cleanRules(rules: CSSRuleList, files: Resolvers): Promise<string> {
  const kept: string[] = [];
  for (const rule of rules) kept.push(await cleanRule(rule, files));
  return kept.filter((rule) => rule !== "").join("\n");
}

async function cleanRule(rule: CSSRule, files: Resolvers): Promise<string> {
  if (rule instanceof CSSStyleRule) {
    const selector = drawnSelector(rule.selectorText);
    const nested = await cleanRules(rule.cssRules ?? [], files);
    return `${selector} { ${await cleanDeclarations(rule.style, files.picture)} ${nested} }`;
  }
  // What follows a rule within another.
  if (isNestedDeclarations(rule)) return await cleanDeclarations(rule.style, files.picture);
  if (rule instanceof CSSFontFaceRule) {
    const text = await cleanDeclarations(rule.style, files.font);
    return text.includes("src:") ? `@font-face { ${text} }` : "";
  }
  if (rule instanceof CSSMediaRule) {
    return `@media ${rule.conditionText} { ${await cleanRules(rule.cssRules, files)} }`;
  }
  if (rule instanceof CSSSupportsRule) {
    return `@supports ${rule.conditionText} { ${await cleanRules(rule.cssRules, files)} }`;
  }
  if (rule instanceof CSSLayerBlockRule) {
    const name = layerName.test(rule.name) ? rule.name : "";
    return `@layer ${name} { ${await cleanRules(rule.cssRules, files)} }`;
  }
  if (rule instanceof CSSLayerStatementRule) {
    return rule.nameList.every((name) => layerName.test(name)) ? rule.cssText : "";
  }
  if (rule instanceof CSSCounterStyleRule) return loading.test(rule.cssText) ? "" : rule.cssText;
  if (rule instanceof CSSKeyframesRule) return await cleanKeyframes(rule, files);
  return await cleanNewerRule(rule, files);
}

/** Returns the frames of an animation, of which a page shows the end. */
async function cleanKeyframes(
  { name, cssRules }: CSSKeyframesRule,
  files: Resolvers,
): Promise<string> {
  if (!layerName.test(name)) return "";
  const frames = [...cssRules].map(async (frame) =>
    frame instanceof CSSKeyframeRule
      ? `${frame.keyText} { ${await cleanDeclarations(frame.style, files.picture)} }`
      : "",
  );
  return `@keyframes ${name} { ${(await Promise.all(frames)).join(" ")} }`;
}

/** Returns a rule of a kind that older browsers do not know, nor its name; "" for all others. */
async function cleanNewerRule(rule: CSSRule, files: Resolvers): Promise<string> {
  const { cssRules, containerName, containerQuery, start, end } = rule as Partial<NewerRule>;
  switch (rule.constructor.name) {
    case "CSSContainerRule": {
      const query = `${containerName ?? ""} ${containerQuery ?? ""}`;
      if (!cssRules || endsRule.test(query)) return "";
      return `@container ${query} { ${await cleanRules(cssRules, files)} }`;
    }
    case "CSSScopeRule": {
      if (!cssRules) return "";
      const [from, to] = [start, end].map((selector) => selector && drawnSelector(selector));
      // Without a root of its own it is of what its style sheet is in.
      const limit = to ? ` to (${to})` : "";
      return `@scope (${from || "html"})${limit} { ${await cleanRules(cssRules, files)} }`;
    }
    case "CSSPropertyRule":
      return loading.test(rule.cssText) || rule.cssText.includes("\\") ? "" : rule.cssText;
  }
  return "";
}

/** What rules have that older browsers do not know. */
interface NewerRule {
  readonly cssRules: CSSRuleList;
  readonly containerName: string;
  readonly containerQuery: string;
  readonly start: string | null;
  readonly end: string | null;
}

/** Returns a selector that is true of the same elements where a section is drawn as where it is laid out. */
function drawnSelector(selector: string): string {
  return selector.replace(unlikeInDrawing, (name) => drawnNames[name] ?? name);
}

/** Returns whether a rule is declarations alone; older browsers have no such rules. */
function isNestedDeclarations(
  rule: CSSRule,
): rule is CSSRule & { readonly style: CSSStyleDeclaration } {
  return rule.constructor.name === "CSSNestedDeclarations" && "style" in rule;
}

/** Returns a value with data in place of addresses; null if it would load anything else. */
async function cleanValue(value: string, resolve: ResolveCss): Promise<string | null> {
  const bare = value.replace(string, '""');
  // The browser has resolved escapes, but for those in custom properties: they could hide anything.
  if (bare.includes("\\")) return null;
  if (!loading.test(bare)) return value;
  if (loading.test(bare.replaceAll('url("")', ""))) return null;
  const parts: string[] = [];
  let from = 0;
  for (const match of value.matchAll(address)) {
    const named = match[1] ?? "";
    // What is in the same document, as a pattern of a drawing, is not loaded.
    const data = named.startsWith("#") ? named : await resolve(withoutEscapes(named));
    parts.push(value.slice(from, match.index), `url("${data ?? "data:,"}")`);
    from = match.index + match[0].length;
  }
  return parts.join("") + value.slice(from);
}

function withoutEscapes(text: string): string {
  return text
    .replace(/\\([0-9a-f]{1,6})\s?/gi, (_, digits) => {
      const code = Number.parseInt(digits, 16);
      return code > 0 && code < 0x110000 ? String.fromCodePoint(code) : "";
    })
    .replace(/\\(.)/g, "$1");
}
