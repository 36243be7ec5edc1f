/** The dialogs: printing, and passwords. On a test double of the book, in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { eventually } from "../for_tests/eventually.ts";
import { addFakeBook } from "../for_tests/fake_book.ts";
import { frameOf, named } from "../for_tests/shown_controls.ts";
import { askPassword } from "./password_dialog.ts";

afterEach(() => document.body.replaceChildren());

test("the print dialog asks for pages and closes when they are printed", async () => {
  const { book, root } = addFakeBook();
  named(root, "More").click();
  [...root.querySelectorAll<HTMLElement>("[role=menuitem]")]
    .find((item) => item.textContent === "Print")
    ?.click();
  const dialog = root.querySelector("dialog") as HTMLDialogElement;
  expect(dialog.open).toBe(true);
  const [from] = [...dialog.querySelectorAll("input")];
  if (from) from.value = "nowhere";
  dialog.querySelector<HTMLElement>("[type=submit]")?.click();
  expect(dialog.querySelector("[role=status]")?.textContent).toBe("There is no page nowhere");
  expect(book.asked).toEqual([]);
  if (from) from.value = "iv";
  dialog.querySelector<HTMLElement>("[type=submit]")?.click();
  await eventually(() => root.querySelector("dialog")).toBe(null);
  expect(book.asked).toEqual(["print"]);
});

test("Ctrl and P asks which pages are to be printed: the open ones at first, or all", async () => {
  const { book, root } = addFakeBook();
  const dialog = () => root.querySelector<HTMLDialogElement>("dialog");
  const pages = (): string[] =>
    [...(dialog()?.querySelectorAll("input") ?? [])].map(({ value }) => value);
  const key = (options: KeyboardEventInit): KeyboardEvent => {
    const event = new KeyboardEvent("keydown", {
      key: "p",
      bubbles: true,
      composed: true,
      cancelable: true,
      ...options,
    });
    frameOf(root)?.dispatchEvent(event);
    return event;
  };
  expect(key({ ctrlKey: true }).defaultPrevented).toBe(true);
  expect(dialog()?.open).toBe(true);
  expect(pages()).toEqual(["iv", "v"]);
  [...(dialog()?.querySelectorAll("button") ?? [])]
    .find(({ textContent }) => textContent === "All pages")
    ?.click();
  expect(pages()).toEqual(["i", "24"]);
  dialog()?.close();
  await eventually(dialog).toBe(null);
  // The browser prints what it sees where the file allows no more, and what it is asked for otherwise.
  book.allows = { print: false, download: true };
  expect(key({ metaKey: true }).defaultPrevented).toBe(false);
  book.allows = { print: true, download: true };
  expect(key({ ctrlKey: true, shiftKey: true }).defaultPrevented).toBe(false);
  expect(key({}).defaultPrevented).toBe(false);
  expect(dialog()).toBe(null);
});

test("the password dialog returns what is typed, or null, and says that one was wrong", async () => {
  const { book, root } = addFakeBook();
  const dialog = () => root.querySelector<HTMLDialogElement>("dialog");
  const opening = new AbortController();
  const given = askPassword(book, false, opening.signal);
  expect(dialog()?.textContent).toContain("protected by a password");
  await userEvent.keyboard("secret{Enter}");
  expect(await given).toBe("secret");
  expect(dialog()).toBeNull();
  const none = askPassword(book, true, opening.signal);
  expect(dialog()?.textContent).toContain("not its password");
  await userEvent.keyboard("{Escape}");
  expect(await none).toBeNull();
  // Another book is opened meanwhile.
  const left = askPassword(book, false, opening.signal);
  opening.abort();
  expect([await left, dialog()]).toEqual([null, null]);
  expect(await askPassword(book, false, opening.signal)).toBeNull();
});

test("the help says what keys do, in the book that is open; ? opens and closes it", async () => {
  const { book, root } = addFakeBook();
  const dialog = () => root.querySelector<HTMLDialogElement>("dialog");
  const rows = (): (string | null)[] =>
    [...(dialog()?.querySelectorAll("dt, dd") ?? [])].map(({ textContent }) => textContent);
  book.canTypeset = true;
  book.focus();
  await userEvent.keyboard("?");
  await eventually(() => dialog()?.open).toBe(true);
  expect(rows().slice(0, 4)).toEqual(["Next page", "→Space", "Previous page", "←⇧ Space"]);
  expect(rows()).toContain("Larger type");
  await userEvent.keyboard("?");
  await eventually(dialog).toBe(null);
  Object.assign(book, { direction: "rtl", canTypeset: false });
  book.allows = { print: false, download: true };
  named(root, "More").click();
  [...root.querySelectorAll<HTMLElement>("[role=menuitem]")]
    .find((item) => item.textContent === "Keys")
    ?.click();
  await eventually(() => dialog()?.open).toBe(true);
  expect(rows().slice(0, 2)).toEqual(["Next page", "←Space"]);
  expect(rows()).not.toContain("Larger type");
  expect(rows()).not.toContain("Print");
  [...(dialog()?.querySelectorAll("button") ?? [])].at(-1)?.click();
  await eventually(dialog).toBe(null);
});
