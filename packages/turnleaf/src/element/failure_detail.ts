/** What an element says of an error, in its language. */

import { nameAndMessage } from "../sources/failures.ts";
import { BookError } from "../sources/page_source.ts";
import { elementTexts, errorText, fill, number } from "../words/languages.ts";
import type { FailureDetail } from "./events.ts";

/**
 * Returns what an element reports of an error.
 *
 * @param tag the language of its sentence
 * @param page the page (from 1) that it is about, in place of the one that the error knows
 */
export function failureDetail(error: unknown, tag: string, page?: number): FailureDetail {
  if (!(error instanceof BookError)) {
    const { notOpened } = elementTexts(tag);
    return { message: `${notOpened} (${nameAndMessage(error)})`, code: "failed" };
  }
  const { code, status, source } = error;
  return {
    message: sentenceOf(error, tag, page),
    code,
    ...(status !== undefined && { status }),
    ...((page ?? error.page) !== undefined && { page: page ?? error.page }),
    ...(source !== undefined && { source }),
  };
}

/** Returns the sentence for an error in a language; the error's own, which is English, if it has none. */
export function sentenceOf(
  error: BookError,
  tag: string,
  page: number | undefined = error.page,
): string {
  const text = errorText(tag, error.code);
  if (text === undefined) return error.message;
  const sentence = fill(text, {
    source: error.source ?? errorText(tag, "thisBook") ?? "",
    status: String(error.status ?? ""),
    detail: error.message,
  });
  const around = page === undefined ? undefined : errorText(tag, "onPage");
  return around === undefined ? sentence : fill(around, { page: number(tag, page ?? 0), sentence });
}
