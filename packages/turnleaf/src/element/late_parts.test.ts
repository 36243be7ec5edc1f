/** Parts that are loaded late and cannot be: reported once, in one sentence. */

import { expect, test, vi } from "vitest";
import type { ControlledBook } from "../controls/book.ts";
import { ControlsLoader } from "../controls/controls_loader.ts";
import { loadPart } from "../sources/load_part.ts";
import { BookError } from "../sources/page_source.ts";
import type { TextTarget } from "./book_text_overlay.ts";
import { ReadableBook } from "./readable_book.ts";

vi.mock("../controls/controls.ts", () => {
  throw new TypeError("Failed to fetch");
});
vi.mock("./book_text_overlay.ts", () => {
  throw new TypeError("Failed to fetch");
});

const sentence = "A part of the reader could not be loaded; load the web page again.";

/** What the mocks above fail with comes wrapped in an error of vitest's. */
const failure = expect.objectContaining({
  name: "BookError",
  message: expect.stringMatching(/^A part of the reader /),
});

test("a part that exists is loaded, and a missing one is reported", async () => {
  expect(await loadPart(Promise.resolve(7))).toBe(7);
  const failing = loadPart(Promise.reject(new TypeError("Failed to fetch")));
  await expect(failing).rejects.toEqual(new BookError(sentence, { code: "partMissing" }));
});

test("a part whose code fails in this browser says what failed", async () => {
  const cause = new TypeError("x.toReversed is not a function");
  const error: unknown = await loadPart(Promise.reject(cause)).catch((error) => error);
  expect(error).toEqual(
    new BookError(
      "A part of the reader failed (TypeError: x.toReversed is not a function); update the browser, or load the web page again.",
    ),
  );
  expect((error as Error).cause).toBe(cause);
});

test("controls that cannot be loaded are reported once per request", async () => {
  const reports: unknown[] = [];
  const loader = new ControlsLoader((error) => reports.push(error));
  const book = { closest: () => ({ getAttribute: () => "en" }) };
  const show = (shown: boolean): void =>
    loader.set(shown, book as unknown as ControlledBook, {} as HTMLElement, {} as HTMLElement);
  show(true);
  await expect.poll(() => reports).toEqual([failure]);
  show(true);
  show(false);
  show(true);
  await expect.poll(() => reports.length).toBe(2);
});

test("a book whose text cannot be loaded is reported once, and cannot be searched", async () => {
  const reports: unknown[] = [];
  const reading = new ReadableBook({ source: {} } as TextTarget, (error) => reports.push(error));
  reading.mark(null);
  reading.changed();
  await expect(reading.search("leaf")).rejects.toEqual(failure);
  expect(reports).toEqual([failure]);
  expect(await reading.outline()).toEqual([]);
});

test("a book that is closed before its text came tells nothing", async () => {
  const reports: unknown[] = [];
  const reading = new ReadableBook({ source: {} } as TextTarget, (error) => reports.push(error));
  const search = reading.search("leaf");
  reading.destroy();
  await expect(search).rejects.toThrow();
  expect(reports).toEqual([]);
});
