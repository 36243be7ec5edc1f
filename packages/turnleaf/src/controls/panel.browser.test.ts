/** The panel beside the book: contents, search, bookmarks and thumbnails. On a test double of the book, in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { clock } from "../for_tests/clock.ts";
import { eventually } from "../for_tests/eventually.ts";
import { addFakeBook } from "../for_tests/fake_book.ts";
import { active, frameOf, named } from "../for_tests/shown_controls.ts";

afterEach(() => document.body.replaceChildren());

test("the panel takes the focus and gives it back", async () => {
  const { book, root } = addFakeBook();
  const button = named(root, "Contents");
  button.focus();
  await userEvent.keyboard("{Enter}");
  expect(button.ariaExpanded).toBe("true");
  // The visible chapter.
  await eventually(() => active(root)).toBe("Loomingsii");
  expect(root.activeElement?.getAttribute("aria-current")).toBe("true");
  await userEvent.keyboard("{Escape}");
  expect(active(root)).toBe("Contents");
  expect(button.ariaExpanded).toBe("false");
  expect(root.querySelector<HTMLElement>("[part=panel]")?.hidden).toBe(true);

  button.click();
  [...root.querySelectorAll<HTMLElement>(".contents .line")][2]?.click();
  expect(book.asked).toEqual(["turnTo 9 at 0.25"]);
  // Only web links are links.
  const links = [...root.querySelectorAll<HTMLAnchorElement>(".contents a")];
  expect(links.map(({ href, rel }) => [href, rel])).toEqual([
    ["https://example.org/", "noopener noreferrer"],
  ]);
});

test("what the book's owner wants to be shown stands under the contents", async () => {
  const rights = "https://creativecommons.org/licenses/by/4.0/";
  const { root } = addFakeBook(780, {
    details: [
      { label: "Rights", value: "CC BY", href: rights },
      { label: "", value: "A trap", href: "javascript:alert(1)" },
    ],
  });
  named(root, "Contents").click();
  const lines = () => [...root.querySelectorAll<HTMLElement>(".details li")];
  await eventually(() => lines().map((line) => line.textContent)).toEqual([
    "Rights CC BY",
    "A trap",
  ]);
  const links = [...root.querySelectorAll<HTMLAnchorElement>(".details a")];
  expect(links.map(({ href, rel }) => [href, rel])).toEqual([[rights, "noopener noreferrer"]]);
});

test("on a narrow element the panel goes when something is picked", async () => {
  const { book, root } = addFakeBook(390);
  named(root, "Contents").click();
  await eventually(() => root.querySelectorAll(".contents .line").length).toBe(5);
  const tabs = [...root.querySelectorAll<HTMLElement>("[role=tab]:not([hidden])")];
  expect(tabs.every((tab) => tab.offsetHeight >= 44)).toBe(true);
  tabs[0]?.focus();
  await userEvent.keyboard("{ArrowRight}{ArrowRight}");
  expect(tabs.map((tab) => tab.ariaSelected)).toEqual(["false", "false", "true", "false"]);
  await userEvent.keyboard("{Home}");
  root.querySelector<HTMLElement>(".contents .line")?.click();
  expect(book.asked).toContain("turnTo 2");
  expect(root.querySelector<HTMLElement>("[part=panel]")?.hidden).toBe(true);
  expect(document.activeElement).toBe(book);
  expect(root.activeElement).toBe(frameOf(root));
});

test("a panel beside which the book would be too small lies over it, and goes when a place is picked, whose marks stay until one turns on", async () => {
  const hits = [{ page: 9, before: "a ", text: "whale", after: "" }];
  let fraction = 0.7;
  const { book, root } = addFakeBook(820, { hits, fractionBeside: () => fraction });
  const stage = root.querySelector("[part=stage]") as HTMLElement;
  const panel = root.querySelector("[part=panel]") as HTMLElement;
  const hit = () => root.querySelector<HTMLElement>(".hit");
  named(root, "Search").click();
  expect([stage.clientWidth, panel.clientWidth]).toEqual([820, 303]);
  await userEvent.keyboard("whale{Enter}");
  await eventually(hit).not.toBeNull();
  hit()?.click();
  expect([panel.hidden, book.asked.at(-1)]).toEqual([true, "hit 9"]);
  await clock.task();
  book.dispatchEvent(new CustomEvent("turnstart"));
  expect(book.asked.at(-1)).toBe("hit none");
  // Of another shape it lies beside it, and both stay.
  named(root, "Search").click();
  fraction = 0.9;
  book.dispatchEvent(new CustomEvent("layoutchange"));
  expect(stage.clientWidth).toBe(820 - 304);
  hit()?.click();
  await clock.task();
  book.dispatchEvent(new CustomEvent("turnstart"));
  expect([panel.hidden, book.asked.at(-1)]).toEqual([false, "hit 9"]);
});

test("a search lists its places with what stands about them, and counts them", async () => {
  const hits = Array.from({ length: 450 }, (_, i) => ({
    page: (i % 30) + 1,
    before: "the white ",
    text: "<b>Whale</b>",
    after: ` ${i}`,
  }));
  const { book, root } = addFakeBook(780, { hits });
  named(root, "Search").click();
  await userEvent.keyboard("whale{Enter}");
  const status = () => root.querySelector(".found [role=status]")?.textContent;
  await eventually(status).toBe("450 places");
  const rows = () => [...root.querySelectorAll<HTMLElement>(".hit")];
  expect(rows().length).toBe(200);
  expect(rows()[0]?.querySelector("mark")?.textContent).toBe("<b>Whale</b>");
  expect(rows()[0]?.querySelector("b")).toBe(null);
  [...root.querySelectorAll<HTMLElement>(".found .line")].at(-1)?.click();
  expect(rows().length).toBe(400);
  expect(root.activeElement).toBe(rows()[200]);
  rows()[2]?.click();
  expect(book.asked.at(-1)).toBe("hit 3");
  expect(rows()[2]?.getAttribute("aria-current")).toBe("true");
  // The marks disappear with the panel.
  named(root, "Close").click();
  expect(book.asked.at(-1)).toBe("hit none");
  book.hits = [];
  named(root, "Search").click();
  await userEvent.keyboard("shark{Enter}");
  await eventually(status).toBe("Nothing found.");
  // In a book of pictures the reader learns why.
  book.mayHaveText = false;
  await userEvent.keyboard("{Enter}");
  await eventually(status).toMatch(/pictures, without text/);
});

test("Enter in the search field goes to one hit after another, and searches for other words", async () => {
  const hits = [3, 9].map((page) => ({ page, before: "a ", text: "whale", after: "" }));
  const { book, root } = addFakeBook(1280, { hits });
  named(root, "Search").click();
  await userEvent.keyboard("whale{Enter}");
  await eventually(() => root.querySelectorAll(".hit").length).toBe(2);
  for (const went of ["hit 3", "hit 9", "hit 3"]) {
    await userEvent.keyboard("{Enter}");
    await eventually(() => book.asked.at(-1)).toBe(went);
  }
  expect(root.activeElement?.className).toBe("query");
  book.hits = [];
  await userEvent.keyboard("s{Enter}");
  const status = root.querySelector(".found [role=status]");
  await eventually(() => status?.textContent).toBe("Nothing found.");
});

test("bookmarks are listed in the book's order and can be taken off", async () => {
  const { book, root } = addFakeBook();
  named(root, "Bookmarks").click();
  expect(active(root)).toBe("Bookmark this page");
  await userEvent.keyboard("{Enter}");
  book.toggleBookmark(2);
  const names = () => [...root.querySelectorAll(".rows .line")].map((row) => row.textContent);
  expect(names()).toEqual(["Page ii", "Page iv"]);
  root.querySelectorAll<HTMLElement>(".rows .line")[0]?.click();
  expect(book.asked).toEqual(["turnTo 2"]);
  named(root, "Remove the bookmark: Page iv").click();
  expect(names()).toEqual(["Page ii"]);
});

test("of 5,000 small pages only those in sight exist, and one is drawn at a time", async () => {
  const { book, root } = addFakeBook(780, { pageCount: 5000, page: 2500 });
  named(root, "Thumbnails").click();
  expect(active(root)).toBe("Page 2494");
  const cells = () => root.querySelectorAll(".sheet li").length;
  await eventually(() => book.drawn).toBe(cells());
  expect(cells()).toBeLessThan(24);
  for (let i = 0; i < 6; i++) {
    await userEvent.keyboard("{PageDown}");
    expect(cells()).toBeLessThan(24);
  }
  expect(active(root)).toBe("Page 2530");
  await userEvent.keyboard("{End}");
  expect(active(root)).toBe("Page 4994");
  expect(book.mostDrawing).toBe(1);
  await userEvent.keyboard("{Enter}");
  expect(book.asked.at(-1)).toBe("turnTo 5000");
  // Nothing is drawn after the panel has closed.
  named(root, "Close").click();
  expect(cells()).toBe(0);
  await eventually(() => book.drawing).toBe(0);
});

test("thumbnails of pages that face each other are in one row, wherever the offset is shifted", async () => {
  const { book, root } = addFakeBook();
  named(root, "Thumbnails").click();
  const rows = (): string[] => {
    const found = new Map<number, string[]>();
    for (const item of root.querySelectorAll<HTMLElement>(".sheet li")) {
      const { top, left } = item.getBoundingClientRect();
      const isLeft = left < (item.parentElement as HTMLElement).getBoundingClientRect().left + 20;
      const row = found.get(top) ?? ["-", "-"];
      row[isLeft ? 0 : 1] = item.textContent ?? "";
      found.set(top, row);
    }
    return [...found.values()].map((row) => row.join(" ")).slice(0, 4);
  };
  expect(rows()).toEqual(["- i", "ii iii", "iv v", "vi 1"]);
  book.toggleShift(3);
  expect(rows()).toEqual(["- i", "ii -", "iii iv", "v vi"]);
  book.toggleShift(1);
  expect(rows()).toEqual(["i ii", "iii iv", "v vi", "1 2"]);
});

test("hits come in while the book is searched, and stay, on other pages, when it is counted anew", async () => {
  const hit = { page: 9, before: "a ", text: "whale", after: "" };
  const { book, root, remove } = addFakeBook(780);
  let done = (): void => {};
  book.search = (_, options) => {
    options?.onHits?.([hit]);
    return new Promise((resolve) => {
      done = () => resolve([hit]);
    });
  };
  root.querySelector<HTMLElement>("[aria-label=Search]")?.click();
  const field = root.querySelector<HTMLInputElement>(".query") as HTMLInputElement;
  field.value = "whale";
  field.form?.requestSubmit();
  const status = root.querySelector(".found [role=status]");
  expect(status?.textContent).toBe("1 place – Searching …");
  const label = () => root.querySelector(".hit .label")?.textContent;
  expect(label()).toBe("Page 3");
  hit.page = 12;
  book.dispatchEvent(new CustomEvent("pageschange"));
  expect(label()).toBe("Page 6");
  done();
  await eventually(() => status?.textContent).toBe("1 place");
  expect(label()).toBe("Page 6");
  // The status is seen: beneath the field, and not over the page.
  const [asked, said] = [field, status as Element].map((at) => at.getBoundingClientRect());
  expect(said?.top).toBeGreaterThanOrEqual(asked?.bottom ?? 0);
  expect((said?.top ?? 0) - (asked?.bottom ?? 0)).toBeLessThan(20);
  remove();
  book.remove();
});

test("what a panel gives the focus to is framed for readers who go by keys, and not by a pointer", async () => {
  const { root } = addFakeBook();
  const framed = (): boolean =>
    getComputedStyle(root.activeElement as Element).outlineStyle !== "none";
  await userEvent.click(named(root, "Contents"));
  await eventually(() => root.activeElement?.matches(".line")).toBe(true);
  expect(framed()).toBe(false);
  await userEvent.keyboard("{ArrowDown}");
  expect(framed()).toBe(true);
});
