/** What an element says of an error, in its language. */

import { nameAndMessage } from "../sources/failures.ts";
import { BookError, type BookWarning } from "../sources/page_source.ts";
import { elementTexts, errorText, fill, number, warningText } from "../words/languages.ts";
import type { FailureDetail, WarningDetail } from "./events.ts";

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

/** Returns what an element reports of a warning, its sentence in a language. */
export function warningDetail(warning: BookWarning, tag: string): WarningDetail {
  const { code, message, source, page, error } = warning;
  const text = warningText(tag, code);
  const own = text === undefined ? message : fill(text, { source: source ?? "" });
  return {
    // A page says itself why it cannot be drawn; its number is given beside that.
    message: code === "page" && error ? sentenceOf(error, tag, null) : own,
    code,
    ...(source !== undefined && { source }),
    ...(page !== undefined && { page }),
  };
}

/**
 * Returns the sentence for an error in a language; the error's own, which is English, if it has none.
 *
 * @param page the page (from 1) that the sentence names; null for none
 */
export function sentenceOf(
  error: BookError,
  tag: string,
  page: number | null | undefined = error.page,
): string {
  const text = errorText(tag, error.code);
  if (text === undefined) return error.message;
  const sentence = fill(text, {
    source: error.source ?? errorText(tag, "thisBook") ?? "",
    status: String(error.status ?? ""),
    detail: error.message,
  });
  const around = typeof page === "number" ? errorText(tag, "onPage") : undefined;
  return around === undefined ? sentence : fill(around, { page: number(tag, page ?? 0), sentence });
}
