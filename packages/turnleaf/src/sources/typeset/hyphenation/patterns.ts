/** The patterns by which words of a language are divided, each loaded when a book needs it. */

import { loadPart } from "../../load_part.ts";
import { loadedOnce } from "../../loaded_once.ts";

/** Returns a text with soft hyphens where its words may be divided. */
export type Divide = (text: string) => string;

/** What loads the patterns of a language. */
const languages: Readonly<Record<string, () => Promise<{ readonly default: unknown }>>> = {
  "en-us": () => import("hyphen/patterns/en-us.js"),
  "en-gb": () => import("hyphen/patterns/en-gb.js"),
  de: () => import("hyphen/patterns/de-1996.js"),
  fr: () => import("hyphen/patterns/fr.js"),
  es: () => import("hyphen/patterns/es.js"),
  it: () => import("hyphen/patterns/it.js"),
  pt: () => import("hyphen/patterns/pt.js"),
};

/** English of these countries is divided as that of the United States; all other as that of Britain. */
const american = new Set(["", "us", "ca"]);

/** Returns the name of the patterns for a language (BCP 47); null if there are none. */
export function patternsOf(tag: string): string | null {
  const parts = tag.toLowerCase().split("-");
  const [language = ""] = parts;
  if (language === "en") {
    const country = parts.find((part, k) => k > 0 && part.length === 2) ?? "";
    return american.has(country) ? "en-us" : "en-gb";
  }
  return Object.hasOwn(languages, language) ? language : null;
}

/** Before the end of a word of less than three letters, which is not worth a line of its own. */
const shortEnd = /\u00ad(?=\p{L}{1,2}(?![\p{L}\u00ad]))/gu;

/** Returns what divides words by patterns that `patternsOf` names. Rejects with a `BookError` if it cannot be loaded. */
export const loadPatterns: (name: string) => Promise<Divide> = loadedOnce(async (name) => {
  const [{ default: create }, patterns] = await loadPart(
    Promise.all([import("hyphen/hyphen.js"), languages[name]?.()]),
  );
  const divide = create(patterns?.default, { html: false });
  return (text) => divide(text).replace(shortEnd, "");
});
