/** Selects the element's language, and fills in texts. */

import type { ElementTexts, Texts } from "./texts.ts";

const added = new Map<string, Texts>();

/**
 * Adds a language to every `<turnleaf-book>`, or replaces texts of one.
 * Elements use it from when they are next shown or their `lang` changes.
 *
 * @param tag BCP 47, such as "de" or "pt-BR"; "pt" serves every kind of
 * Portuguese
 * @param texts every text of the language
 */
export function addLanguage(tag: string, texts: Texts): void {
  added.set(tag.toLowerCase(), texts);
}

const en: ElementTexts = {
  opening: "Opening the book …",
  missing: "There is no book here yet: give the element a src, or pages.",
  pageOpen: "Page {pages} of {n}",
  pagesOpen: "Pages {pages} of {n}",
  back: "Back of {n}",
  notOpened: "The book could not be opened; load the page again.",
  pageNamed: "Page {label}",
  slowPage:
    "Page {label} takes long to draw. It is still being drawn; the other pages can be read.",
  leaving: "This link leads out of the book, to {address}",
  leave: "Open it",
};

const zh: ElementTexts = {
  opening: "正在打开书籍…",
  missing: "这里还没有书：请设置 src 或 pages。",
  pageOpen: "第 {pages} 页，共 {n} 页",
  pagesOpen: "第 {pages} 页，共 {n} 页",
  back: "封底，共 {n} 页",
  notOpened: "无法打开此书，请重新加载页面。",
  pageNamed: "第 {label} 页",
  slowPage: "第 {label} 页仍在绘制中，请稍候。",
  leaving: "此链接指向书外：{address}",
  leave: "打开",
};

/** Returns the element's own texts in a language. */
export const elementTexts = (tag: string): ElementTexts => textsFor(tag, { en, zh });

/**
 * Returns the texts for a language: the first of those added, those built in,
 * those of the language without its region, English.
 */
export function textsFor<T>(tag: string, own: { readonly [tag: string]: T; readonly en: T }): T {
  let name = tag.toLowerCase();
  while (name !== "") {
    const texts = (added.get(name) as T | undefined) ?? (Object.hasOwn(own, name) && own[name]);
    if (texts) return texts;
    name = name.slice(0, Math.max(name.lastIndexOf("-"), 0));
  }
  return own.en;
}

/** Returns the language of an element: its own, an ancestor's, or the browser's. */
export function languageOf(element: Element): string {
  let at: Element | null = element;
  while (at) {
    const tag = at.closest("[lang]")?.getAttribute("lang");
    if (tag) return tag;
    const root: Node = at.getRootNode();
    at = root instanceof ShadowRoot ? root.host : null;
  }
  return navigator.language;
}

/** Returns a text with its placeholders in braces filled in. */
export function fill(text: string, values: Readonly<Record<string, string>>): string {
  return text.replace(/\{(\w+)\}/g, (whole, name: string) =>
    Object.hasOwn(values, name) ? values[name] : whole,
  );
}

/** Returns a number as a language writes it; plainly if the tag is invalid. */
export function number(tag: string, n: number): string {
  return attempt(() => new Intl.NumberFormat(tag).format(n)) ?? String(n);
}

/** Returns a ratio in percent as a language writes it, such as "150%". */
export function percent(tag: string, ratio: number): string {
  const format = () => new Intl.NumberFormat(tag, { style: "percent" }).format(ratio);
  return attempt(format) ?? `${Math.round(100 * ratio)}%`;
}

/** Returns words in a list, such as "iv and v". */
export function list(tag: string, words: readonly string[]): string {
  return attempt(() => new Intl.ListFormat(tag).format(words)) ?? words.join(", ");
}

/** Returns the result of `make`; undefined if Intl throws at an invalid tag. */
export function attempt<T>(make: () => T): T | undefined {
  try {
    return make();
  } catch {
    return undefined;
  }
}
