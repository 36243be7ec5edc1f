/** Keys and the focus: where each goes, and what it asks of the book. On a test double of the book, in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { eventually } from "../for_tests/eventually.ts";
import { addFakeBook } from "../for_tests/fake_book.ts";
import { active, named } from "../for_tests/shown_controls.ts";

afterEach(() => document.body.replaceChildren());

test("Tab goes through the book, the toolbar, the panel and the row of pages, and on", async () => {
  const { book, root } = addFakeBook();
  const before = document.createElement("button");
  const after = document.createElement("button");
  book.before(before);
  book.after(after);
  named(root, "Contents").click();
  await eventually(() => root.querySelectorAll(".contents .line").length).toBe(5);
  before.focus();
  const way: string[] = [];
  for (let i = 0; i < 20 && document.activeElement !== after; i++) {
    await userEvent.tab();
    way.push(document.activeElement === after ? "after" : active(root));
  }
  expect(way).toEqual([
    "book",
    "Contents",
    "Close",
    "Loomingsii",
    "The Carpet-Bag1",
    "The Inn3",
    "Elsewhere",
    "Previous page",
    "Page",
    "Next page",
    "Page",
    "after",
  ]);
});

test("arrows go along the toolbar; each button says what it does", async () => {
  const { book, root } = addFakeBook();
  named(root, "Contents").focus();
  const way = [active(root)];
  for (let i = 0; i < 9; i++) {
    await userEvent.keyboard("{ArrowRight}");
    way.push(active(root));
  }
  expect(way).toEqual([
    "Contents",
    "Thumbnails",
    "Search",
    "Bookmarks",
    "Zoom out",
    "Zoom in",
    "One page",
    "Bookmark this page",
    "Full screen",
    "More",
  ]);
  await userEvent.keyboard("{Home}");
  expect(active(root)).toBe("Contents");
  // None of it turned a page.
  expect(book.asked).toEqual([]);

  expect(named(root, "Zoom out").ariaDisabled).toBe("true");
  named(root, "Zoom out").click();
  named(root, "Zoom in").click();
  expect(book.asked).toEqual(["zoom 1.5"]);
  expect(named(root, "Zoom out").ariaDisabled).toBe("false");
  named(root, "Bookmark this page").click();
  expect(book.bookmarks).toEqual([4]);
  expect(named(root, "Remove the bookmark").ariaPressed).toBe("true");
  named(root, "One page").click();
  expect(book.getAttribute("layout")).toBe("single");
});

test("Escape leads back to the book, whose keys turn, where the panel was opened by a pointer or a key of the book's", async () => {
  const { book, root } = addFakeBook();
  await userEvent.click(named(root, "Search"));
  await eventually(() => active(root)).toBe("Find in this book");
  await userEvent.keyboard("{Escape}");
  // It is read on, without a frame around it.
  const framed = (): boolean => {
    const stage = root.querySelector("[part=stage]") as HTMLElement;
    return getComputedStyle(stage, "::after").content !== "none";
  };
  expect([active(root), framed()]).toEqual(["book", false]);
  await userEvent.keyboard(" /{Escape} ");
  const turns = () => book.asked.filter((asked) => asked === "next").length;
  expect(turns()).toBe(2);
  const field = root.querySelector<HTMLInputElement>(".entry") as HTMLInputElement;
  await userEvent.click(field);
  await userEvent.keyboard("6{Enter}");
  expect([active(root), framed()]).toEqual(["book", false]);
  // From beside the book it does so too.
  named(root, "Contents").focus();
  await userEvent.keyboard("{Escape} ");
  expect(turns()).toBe(3);
  // A reader who goes by Tab sees where.
  await userEvent.tab();
  await userEvent.tab({ shift: true });
  expect([active(root), framed()]).toEqual(["book", true]);
});

test("Ctrl and z put a torn leaf back, and belong to the browser where none is out", async () => {
  const { book } = addFakeBook();
  const undo = (): boolean => {
    const event = new KeyboardEvent("keydown", { key: "z", ctrlKey: true, cancelable: true });
    return !book.dispatchEvent(event);
  };
  expect([undo(), book.asked]).toEqual([false, []]);
  book.tornLeaves = 1;
  expect([undo(), book.asked]).toEqual([true, ["put back"]]);
  expect([undo(), book.asked]).toEqual([false, ["put back"]]);
});

test("keys turn, zoom and search; those of a field and of the browser are left alone", async () => {
  const { book, root } = addFakeBook();
  book.focus();
  await userEvent.keyboard(" {Shift>} {/Shift}{End}{Home}+-0fbo");
  expect(book.asked).toEqual([
    "next",
    "previous",
    "turnTo Infinity",
    "turnTo 1",
    "zoom 1.5",
    "announce zoom 1.5",
    "zoom 1",
    "announce zoom 1",
    "zoom 1",
    "announce zoom 1",
    "fullscreen",
    "announce Bookmarks: i",
  ]);
  expect([book.bookmarks, book.shifts]).toEqual([[1], [1]]);
  book.asked.length = 0;
  const find = new KeyboardEvent("keydown", { key: "f", ctrlKey: true, cancelable: true });
  book.dispatchEvent(find);
  expect(find.defaultPrevented).toBe(false);
  expect(book.asked).toEqual([]);
  await userEvent.keyboard("b");
  expect(book.asked).toEqual(["announce No page is bookmarked yet."]);
  book.asked.length = 0;
  await userEvent.keyboard("/");
  expect(active(root)).toBe("Find in this book");
  await userEvent.keyboard("f+ b0");
  expect(root.querySelector<HTMLInputElement>(".query")?.value).toBe("f+ b0");
  expect(book.asked).toEqual([]);
});

test("keys go to the book after a pointer has pressed a button, and to the button after a key has", async () => {
  const { book, root } = addFakeBook();
  await userEvent.click(named(root, "Bookmark this page"));
  expect(book.bookmarks).toEqual([4]);
  await userEvent.keyboard(" ");
  expect([book.bookmarks, book.asked]).toEqual([[4], ["next"]]);
  await userEvent.click(named(root, "Contents"));
  await eventually(() => root.querySelectorAll(".contents .line").length).toBe(5);
  await userEvent.click(root.querySelectorAll(".contents .line")[1] as HTMLElement);
  await userEvent.click(named(root, "More"));
  const items = [...root.querySelectorAll<HTMLElement>(".menu [role^=menuitem]")];
  await userEvent.click(items.find((item) => item.checkVisibility()) as HTMLElement);
  book.asked.length = 0;
  await userEvent.keyboard(" ");
  expect(book.asked).toEqual(["next"]);
  // More opens and shuts its menu.
  for (const isOpen of [true, false]) {
    await userEvent.click(named(root, "More"));
    expect(root.querySelector<HTMLElement>(".menu")?.hidden).toBe(!isOpen);
  }
  named(root, "Zoom in").focus();
  await userEvent.keyboard("{Enter}{End}{Enter}{Escape}");
  expect([active(root), book.zoom]).toEqual(["More", 1.5]);
});

test("in a dialog of the web page's own, keys are the book's, and Escape closes the panel first", async () => {
  const { book, root } = addFakeBook();
  const dialog = document.createElement("dialog");
  document.body.append(dialog);
  dialog.append(book);
  dialog.showModal();
  book.focus();
  await userEvent.keyboard(" +b");
  expect(book.asked.filter((asked) => !asked.startsWith("announce"))).toEqual(["next", "zoom 1.5"]);
  expect(book.bookmarks).toEqual([6]);
  await userEvent.keyboard("/");
  expect(active(root)).toBe("Find in this book");
  await userEvent.keyboard("{Escape}");
  expect([root.querySelector<HTMLElement>(".panel")?.hidden, dialog.open]).toEqual([true, true]);
  await userEvent.keyboard("{Escape}");
  expect(dialog.open).toBe(false);
  dialog.remove();
});
