/** Selects the element's language, and fills in texts. */

import type { ElementTexts, ErrorTexts, Plural, Texts, WarningTexts } from "./texts.ts";

/** Texts that a page has added, and those built in that are loaded, by their tags. */
const added = new Map<string, Partial<Texts>>();
const loaded = new Map<string, Texts>();

/** The languages that are built in besides English, each loaded when an element speaks it. */
const builtIn: Readonly<Record<string, () => Promise<{ readonly texts: Texts }>>> = {
  ar: () => import("./texts_ar.ts"),
  de: () => import("./texts_de.ts"),
  es: () => import("./texts_es.ts"),
  fr: () => import("./texts_fr.ts"),
  ja: () => import("./texts_ja.ts"),
  zh: () => import("./texts_zh.ts"),
};

/**
 * Adds a language to every `<turnleaf-book>`, or replaces texts of one.
 * Elements use it from when they are next shown or their `lang` changes.
 *
 * @param tag BCP 47, such as "nl" or "pt-BR"; "pt" serves every kind of
 * Portuguese
 * @param texts the texts of the language; for those that are missing a text of the
 * language without its region stands in, or the English one
 */
export function addLanguage(tag: string, texts: Partial<Texts>): void {
  added.set(tag.toLowerCase(), texts);
}

/**
 * Loads the texts that are built in of a language. Resolves to whether any came: not if it is
 * English or unknown, if they were there before, or if they could not be loaded.
 */
export async function loadLanguage(tag: string): Promise<boolean> {
  const name = kindsOf(tag).find((kind) => Object.hasOwn(builtIn, kind));
  if (name === undefined || loaded.has(name)) return false;
  try {
    loaded.set(name, (await builtIn[name]()).texts);
    return true;
  } catch {
    return false;
  }
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
  about: "about {n}",
};

/** Returns the element's own texts in a language. */
export const elementTexts = (tag: string): ElementTexts => textsFor(tag, en);

/** Returns the sentence for errors with a code, in a language; undefined if it has none. */
export const errorText = (tag: string, code: keyof ErrorTexts): string | undefined =>
  textsFor<{ readonly errors: Partial<ErrorTexts> }>(tag, { errors: {} }).errors[code];

/** Returns the sentence for warnings with a code, in a language; undefined if it has none. */
export const warningText = (tag: string, code: keyof WarningTexts): string | undefined =>
  textsFor<{ readonly warnings: Partial<WarningTexts> }>(tag, { warnings: {} }).warnings[code];

/**
 * Returns the texts for a language, each the first there is: added, built in, likewise of the
 * language without its region, English.
 */
export function textsFor<T extends object>(tag: string, english: T): T {
  const kinds = kindsOf(tag).flatMap((kind) => [added.get(kind), loaded.get(kind)]);
  return merged(english, kinds.reverse());
}

/** Returns texts with those of others in their place, of the last that has one of the same form. */
function merged<T extends object>(english: T, others: readonly unknown[]): T {
  const texts = { ...english } as Record<string, unknown>;
  for (const other of others) {
    for (const [name, text] of Object.entries(Object(other))) {
      if (name === "errors" || name === "warnings")
        texts[name] = merged(Object(texts[name]), [text]);
      else if (isPlural(texts[name]) ? isPlural(text) : typeof text === "string")
        texts[name] = text;
    }
  }
  return texts as T;
}

const isPlural = (text: unknown): text is Plural => typeof Object(text).other === "string";

/** Returns the tags that serve a language, the nearest first: "pt-br" and "pt". */
function kindsOf(tag: string): string[] {
  const parts = tag.toLowerCase().split("-");
  return parts.map((_, k) => parts.slice(0, parts.length - k).join("-"));
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

/** Returns whether a page's label names it, as "Cover" does, and is no number of any kind. */
export function isName(label: string): boolean {
  return /\p{L}{2}/u.test(label) && !/^[ivxlcdm]+$/i.test(label);
}

/**
 * Returns a page by its label, such as "Page iv" or "Cover".
 *
 * @param tag of the language
 */
export function pageNamed(tag: string, label: string): string {
  return isName(label) ? label : fill(elementTexts(tag).pageNamed, { label });
}

/** Returns a number as a language writes it; plainly if the tag is invalid. */
export function number(tag: string, n: number): string {
  return attempt(() => new Intl.NumberFormat(tag).format(n)) ?? String(n);
}

/** A book's number of pages, whether that is an estimate, and whether it is less than one. */
export interface CountedBook {
  readonly pageCount: number;
  readonly estimated: boolean;
  readonly guessed: boolean;
}

/**
 * Returns a book's number of pages as a language writes it: such as "about 300" while it is an estimate,
 * and "…" while it is only a guess.
 */
export function countOf(tag: string, { pageCount, estimated, guessed }: CountedBook): string {
  if (guessed) return "…";
  const n = number(tag, pageCount);
  return estimated ? fill(elementTexts(tag).about, { n }) : n;
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
