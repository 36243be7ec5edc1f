/** The menu: what it offers, and what that asks of the book. On a test double of the book, in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { addFakeBook } from "../for_tests/fake_book.ts";
import { active, named } from "../for_tests/shown_controls.ts";

afterEach(() => document.body.replaceChildren());

test("the menu works by key and chooses a theme", async () => {
  const { book, root } = addFakeBook();
  const more = named(root, "More");
  more.focus();
  await userEvent.keyboard("{Enter}");
  expect(active(root)).toBe("Start the slide-show");
  await userEvent.keyboard("{ArrowDown}{ArrowDown}{ArrowDown}{ArrowDown}{ArrowDown}");
  expect(active(root)).toBe("Download");
  await userEvent.keyboard("{Enter}");
  expect(book.asked).toEqual(["download"]);
  expect(root.activeElement).toBe(more);
  await userEvent.keyboard("{Enter}{Enter}");
  expect(book.playing).toBe(true);
  await userEvent.keyboard("{Enter}");
  expect(active(root)).toBe("Stop the slide-show");
  await userEvent.keyboard("{End}{Enter}");
  expect(book.getAttribute("theme")).toBe("night");
  expect((root.activeElement as HTMLElement).ariaChecked).toBe("true");
  await userEvent.keyboard("{Escape}");
  expect(root.activeElement).toBe(more);
  book.allows = { print: false, download: false };
  more.click();
  const items = [...root.querySelectorAll<HTMLElement>("[role=menuitem]")];
  const seen = items.filter((item) => item.offsetParent).map((item) => item.textContent);
  expect(seen).toEqual(["Stop the slide-show", "Keys"]);
});

test("the menu has the eye lean back and look from above again", async () => {
  const { book, root } = addFakeBook();
  const choose = async (): Promise<void> => {
    named(root, "More").focus();
    await userEvent.keyboard("{Enter}{ArrowDown}{ArrowDown}");
    expect(active(root)).toBe("Seen at an angle");
    await userEvent.keyboard("{Enter}");
  };
  await choose();
  expect(book.getAttribute("tilt")).toBe("12");
  await choose();
  expect(book.getAttribute("tilt")).toBe("0");
});

test("the menu folds out, tears and crumples where there is something to", async () => {
  const { book, root } = addFakeBook();
  const more = named(root, "More");
  const items = () =>
    [...root.querySelectorAll<HTMLElement>("[role=menuitem]")]
      .filter((item) => item.offsetParent)
      .map((item) => item.textContent);
  const choose = async (name: string): Promise<void> => {
    more.focus();
    await userEvent.keyboard("{Enter}");
    for (let k = 0; active(root) !== name && k < 20; k++) await userEvent.keyboard("{ArrowDown}");
    expect(active(root)).toBe(name);
    await userEvent.keyboard("{Enter}");
    expect(root.activeElement).toBe(more);
  };
  more.click();
  expect(items()).toEqual(["Start the slide-show", "Print", "Download", "Keys"]);
  more.click();
  Object.assign(book, { foldOut: "shut", tearablePage: 5 });
  await choose("Unfold this page");
  book.foldOut = "open";
  await choose("Fold this page in");
  await choose("Tear this page out");
  Object.assign(book, { tornLeaves: 1, wholeSheet: "flat" });
  await choose("Crumple the torn page");
  await choose("Tear the torn page across");
  await choose("Put the torn page back");
  expect(book.asked).toEqual([
    "fold-out",
    "fold-out",
    "tear out 5",
    "crumple",
    "tear across",
    "put back",
  ]);
});
