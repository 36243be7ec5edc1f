/** A language as the controls use it. */

import { sentenceOf } from "../element/failure_detail.ts";
import { BookError } from "../sources/page_source.ts";
import {
  type CountedBook,
  countOf,
  list,
  number,
  pageNamed,
  textsFor,
} from "../words/languages.ts";
import { plural } from "../words/plural.ts";
import type { ControlTexts, Plural } from "../words/texts.ts";
import { en } from "./texts_en.ts";

/** The texts of the controls, and how numbers are written. */
export interface Wording {
  readonly texts: ControlTexts;
  /** Returns a page by its label, such as "Page iv" or "Cover". */
  pageNamed(label: string): string;
  number(n: number): string;
  /** The number of a book's pages, as an estimate while it is one. */
  count(book: CountedBook): string;
  list(words: readonly string[]): string;
  plural(forms: Plural, n: number): string;
  /** Returns the sentence for an error. */
  sentence(error: Error): string;
}

/** Returns the controls' texts in a language, English if it is unknown. */
export function wordingFor(tag: string): Wording {
  return {
    texts: textsFor(tag, en),
    pageNamed: (label) => pageNamed(tag, label),
    number: (n) => number(tag, n),
    count: (book) => countOf(tag, book),
    list: (words) => list(tag, words),
    plural: (forms, n) => plural(tag, forms, n),
    sentence: (error) => (error instanceof BookError ? sentenceOf(error, tag) : error.message),
  };
}

/** Returns a page (from 1) by its own name, such as "Page iv" or "Cover". */
export const namePage = (
  { pageNamed }: Wording,
  book: { label(page: number): string },
  page: number,
): string => pageNamed(book.label(page));
