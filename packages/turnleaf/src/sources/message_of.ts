/** For tests alone. */

import { expect } from "vitest";
import { BookError } from "./page_source.ts";

/** The sentence that a promise fails with; a test fails where it is no `BookError`. */
export async function messageOf(promise: Promise<unknown>): Promise<string> {
  const error = await promise.then(
    () => new Error("It did not fail."),
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(BookError);
  return (error as Error).message;
}
