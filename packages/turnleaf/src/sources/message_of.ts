/** For tests only. */

import { expect } from "vitest";
import { BookError } from "./page_source.ts";

/** Returns the message that a promise rejects with; the test fails if it is not a `BookError`. */
export async function messageOf(promise: Promise<unknown>): Promise<string> {
  const error = await promise.then(
    () => new Error("It did not fail."),
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(BookError);
  return (error as Error).message;
}
