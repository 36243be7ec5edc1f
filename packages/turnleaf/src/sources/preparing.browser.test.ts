import { afterEach, expect, test, vi } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import { openSource } from "./open.ts";

afterEach(() => vi.restoreAllMocks());

test("the code that an address makes likely is loaded while its first bytes are awaited", async () => {
  let respond: (response: Response) => void = () => {};
  vi.spyOn(globalThis, "fetch").mockImplementation(
    () =>
      new Promise((resolve) => {
        respond = resolve;
      }),
  );
  const scripts = vi.spyOn(URL, "createObjectURL");
  const opening = openSource("https://books.invalid/a%20book.pdf?x=y.epub#page=2");
  // The two workers of pdf.js.
  await eventually(() => scripts.mock.calls.length).toBe(2);
  // The bytes alone decide.
  respond(new Response("<!doctype html><p>Not here.</p>"));
  await expect(opening).rejects.toThrow("is a web page, not a book");
});
