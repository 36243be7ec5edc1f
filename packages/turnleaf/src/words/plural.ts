/** Wordings that depend on a number. */

import { attempt, fill, number } from "./languages.ts";
import type { Plural } from "./texts.ts";

/** Returns the wording for a number, with `{n}` filled in. */
export function plural(tag: string, forms: Plural, n: number): string {
  const form = attempt(() => forms[new Intl.PluralRules(tag).select(n)]) ?? forms.other;
  return fill(form, { n: number(tag, n) });
}
