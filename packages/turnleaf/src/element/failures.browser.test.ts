/** An unforeseen error, and a page that takes long, reported by the element. */

import { afterEach, expect, test, vi } from "vitest";
import { book, happens, scan, scans } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { slowTime } from "../pages/page_pool.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

test("a book that is not there says so in the element's language, and what failed", async () => {
  const pages = scans(2);
  vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockImplementation(() => {
    throw new TypeError("This canvas draws nothing");
  });
  const element = book(pages, { lang: "zh" });
  const { message } = await happens<{ message: string }>(element, "error");
  expect(message).toBe("无法打开此书，请重新加载页面。 (TypeError: This canvas draws nothing)");
  expect(element.shadowRoot?.querySelector("[part=message]")?.textContent).toBe(message);
});

test("a page that takes long says so in the element's language, and the others are drawn", async () => {
  const fetch = globalThis.fetch;
  vi.spyOn(globalThis, "fetch").mockImplementation((input, init) =>
    String(input).endsWith("/never.png") ? new Promise(() => {}) : fetch(input, init),
  );
  const timer = vi.spyOn(globalThis, "setTimeout");
  const written = vi.spyOn(CanvasRenderingContext2D.prototype, "fillText");
  const lines = () => written.mock.calls.map(([line]) => line);
  const pages = [
    { src: scan(1) },
    { src: "https://a.example/never.png", width: 90, height: 120 },
    { src: scan(3) },
  ];
  const element = book(pages, { offset: "0", cover: "none", lang: "zh" });
  await happens(element, "load");
  const slow = () => timer.mock.calls.filter(([, milliseconds]) => milliseconds === slowTime);
  await eventually(() => slow().length).toBeGreaterThan(0);
  // The page is drawn after the first, if not before.
  await eventually(() => lines()).toContain("2");
  expect(element.settled).toBe(false);
  for (const [call] of slow()) (call as () => void)();
  expect(lines()).toContain("第 2 页仍在绘制中，请稍候。");
  expect((await element.drawPage(3, 30)).width).toBe(30);
});
