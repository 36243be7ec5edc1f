/** What cannot be shown, or takes long, reported by the element in its language. */

import { afterEach, expect, test, vi } from "vitest";
import { book, happens, scan, scans } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { slowTime } from "../pages/page_pool.ts";
import { addLanguage } from "../words/languages.ts";
import type { FailureDetail } from "./events.ts";

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

test("a book that failed while its page was being parsed is not tried again once that is parsed", async () => {
  const loading = vi.spyOn(document, "readyState", "get").mockReturnValue("loading");
  const element = document.createElement("turnleaf-book");
  element.src = "/none.pdf";
  const errors = vi.fn();
  element.addEventListener("error", errors);
  document.body.append(element);
  await happens(element, "error");
  loading.mockRestore();
  document.dispatchEvent(new Event("DOMContentLoaded"));
  expect(element.isOpening).toBe(false);
  expect(errors).toHaveBeenCalledTimes(1);
});

test("children that are parsed after their element are its pages", async () => {
  const loading = vi.spyOn(document, "readyState", "get").mockReturnValue("loading");
  const element = document.createElement("turnleaf-book");
  document.body.append(element);
  element.append(document.createElement("section"), document.createElement("section"));
  expect(element.isOpening).toBe(false);
  loading.mockRestore();
  document.dispatchEvent(new Event("DOMContentLoaded"));
  await happens(element, "load");
  expect(element.pageCount).toBe(2);
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

/** Responds 404 to an address, and as before to others. */
function missAt(address: string): void {
  const fetch = globalThis.fetch;
  vi.spyOn(globalThis, "fetch").mockImplementation((input, init) =>
    String(input) === address
      ? Promise.resolve(new Response("", { status: 404 }))
      : fetch(input, init),
  );
}

test.each([
  ["en", "none.pdf was not found; check the address and open it again."],
  ["zh", "找不到none.pdf，请检查地址后重新打开。"],
  ["de-CH", "none.pdf wurde nicht gefunden; prüfen Sie die Adresse und öffnen Sie es noch einmal."],
  ["ar", "لم يُعثر على \u2068none.pdf\u2069؛ تحقّق من العنوان ثم أعد المحاولة."],
])("in %s a book that is not there: a sentence, and what a program asks", async (lang, message) => {
  missAt("https://a.example/none.pdf");
  const element = document.createElement("turnleaf-book");
  element.lang = lang;
  element.src = "https://a.example/none.pdf";
  document.body.append(element);
  const detail = await happens<FailureDetail>(element, "error");
  expect(detail).toEqual({ message, code: "absent", status: 404, source: "none.pdf" });
  expect(element.shadowRoot?.querySelector("[part=message]")?.textContent).toBe(message);
});

test("a page that is not there: on the page and in the event, in the element's language", async () => {
  missAt("https://a.example/none.png");
  const written = vi.spyOn(CanvasRenderingContext2D.prototype, "fillText");
  const pages = [
    { src: scan(1) },
    { src: "https://a.example/none.png", width: 90, height: 120 },
    { src: scan(3) },
  ];
  const element = book(pages, { offset: "0", cover: "none", lang: "fr" });
  const detail = await happens<FailureDetail>(element, "pageerror");
  expect(detail).toMatchObject({ code: "absent", status: 404, page: 2 });
  expect(detail.message).toMatch(/^Page 2 : .* est introuvable ; vérifiez l’adresse/);
  const lines = () => written.mock.calls.map(([line]) => line).join(" ");
  await eventually(() => lines()).toContain("introuvable");
});

test("a language with texts missing shows the book, in English where they are missing", async () => {
  addLanguage("nn", { pageNamed: "Side {label}" });
  addLanguage("nb", null as never);
  for (const lang of ["nn", "nb"]) {
    const element = book(scans(4), { lang, controls: "" });
    await happens(element, "load");
    const root = element.shadowRoot as ShadowRoot;
    await eventually(() => root.querySelector("[role=toolbar]")?.ariaLabel).toBe("Reader");
    expect(root.querySelector("canvas")?.ariaLabel).toContain("Page 1 of 4");
    element.remove();
  }
});

test("another lang is spoken once it is loaded", async () => {
  const element = document.createElement("turnleaf-book");
  element.lang = "es";
  document.body.append(element);
  const said = () => element.shadowRoot?.querySelector("[part=message]")?.textContent;
  await eventually(said).toMatch(/^Aquí aún no hay ningún libro/);
  element.pages = scans(4);
  await happens(element, "load");
  const canvas = () => element.shadowRoot?.querySelector("canvas")?.ariaLabel;
  expect(canvas()).toContain("Página 1 de 4");
  element.lang = "ja";
  await eventually(canvas).toContain("全 4 ページ");
});
