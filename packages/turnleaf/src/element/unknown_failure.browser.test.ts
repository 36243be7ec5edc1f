/** An unforeseen error, reported by the element. */

import { afterEach, expect, test, vi } from "vitest";
import { book, happens, scans } from "../element_for_tests.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

test("it says in the element's language that the book is not there, and what failed", async () => {
  const pages = scans(2);
  vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockImplementation(() => {
    throw new TypeError("This canvas draws nothing");
  });
  const element = book(pages, { lang: "zh" });
  const { message } = await happens<{ message: string }>(element, "error");
  expect(message).toBe("无法打开此书，请重新加载页面。 (TypeError: This canvas draws nothing)");
  expect(element.shadowRoot?.querySelector("[part=message]")?.textContent).toBe(message);
});
