/** Wordings that depend on a number. */

import { attempt, fill, number } from "./languages.ts";
import type { Plural } from "./texts.ts";

/** The wording for a number, which is filled in for `{n}`. */
export function plural(tag: string, forms: Plural, n: number): string {
  const form = attempt(() => forms[new Intl.PluralRules(tag).select(n)]) ?? forms.other;
  return fill(form, { n: number(tag, n) });
}
