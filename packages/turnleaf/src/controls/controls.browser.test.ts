/** The controls as a whole: languages, their removal, selection. On a test double of the book, in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { eventually } from "../for_tests/eventually.ts";
import { addFakeBook } from "../for_tests/fake_book.ts";
import { active, named } from "../for_tests/shown_controls.ts";
import { addLanguage } from "../words/languages.ts";

afterEach(() => document.body.replaceChildren());

test("it speaks Chinese, and what it is taught", async () => {
  const { book, root } = addFakeBook();
  book.lang = "zh-CN";
  await eventually(() => root.querySelector("[role=toolbar]")?.ariaLabel).toBe("阅读器");
  expect(root.querySelector("[part=slider]")?.getAttribute("aria-valuetext")).toBe(
    "页码 iv，第 4 页，共 30 页",
  );
  addLanguage("ar", { contents: "فهرس الكتاب" });
  book.lang = "ar";
  book.dir = "rtl";
  await eventually(() => root.querySelector("[role=toolbar]")?.ariaLabel).toBe("القارئ");
  // The toolbar begins at the right, and its arrows follow.
  named(root, "فهرس الكتاب").focus();
  await userEvent.keyboard("{ArrowLeft}");
  expect(active(root)).toBe("مصغّرات الصفحات");
  // An unknown language, and an invalid one.
  book.lang = "xx-not a language";
  await eventually(() => root.querySelector("[role=toolbar]")?.ariaLabel).toBe("Reader");
});

test("removed, nothing is left, and no key does anything", async () => {
  const { book, root, remove } = addFakeBook();
  named(root, "Thumbnails").click();
  remove();
  expect(root.querySelectorAll("button, input, section").length).toBe(0);
  expect(root.adoptedStyleSheets.length).toBe(1);
  book.focus();
  await userEvent.keyboard(" f");
  expect(book.asked.filter((what) => what !== "hit none")).toEqual([]);
});

test("all that is selected is the book's text: no field is selected that is not being used", () => {
  const { book, root, remove } = addFakeBook(390);
  const field = root.querySelector("[part=field]") as HTMLInputElement;
  expect(getComputedStyle(field).userSelect).toBe("none");
  field.focus();
  expect(getComputedStyle(field).userSelect).toBe("text");
  remove();
  book.remove();
});
