/**
 * The controls in real Chromium, on a test double: what each requests of the
 * book, by pointer and by key.
 */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { pageTap } from "../element/page_tap.ts";
import { clock } from "../for_tests/clock.ts";
import { eventually } from "../for_tests/eventually.ts";
import { addFakeBook } from "../for_tests/fake_book.ts";
import { addLanguage } from "../words/languages.ts";
import { askPassword } from "./password_dialog.ts";

afterEach(() => document.body.replaceChildren());

const named = (root: ShadowRoot, name: string): HTMLElement => {
  const all = root.querySelectorAll<HTMLElement>(`[aria-label="${name}"]`);
  const found = [...all].find((element) => element.offsetParent !== null);
  if (!found) throw new Error(`Nothing in sight is called ${name}.`);
  return found;
};
const frameOf = (root: ShadowRoot): Element | null => root.querySelector(".frame");
const active = (root: ShadowRoot): string => {
  const { activeElement } = root;
  if (activeElement === frameOf(root)) return "book";
  return activeElement?.getAttribute("aria-label") ?? activeElement?.textContent ?? "";
};

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

test("everything that is pressed is 44 pixels tall and wide, on a desk and on a phone", () => {
  for (const width of [780, 390]) {
    const { root, book } = addFakeBook(width);
    named(root, "More").click();
    const small = [...root.querySelectorAll<HTMLElement>("button, input[type=range]")]
      .filter((element) => element.offsetParent !== null)
      .filter(({ offsetWidth, offsetHeight }) => Math.min(offsetWidth, offsetHeight) < 44)
      .map((element) => element.outerHTML);
    expect(small).toEqual([]);
    // Nothing overflows.
    const bars = [...root.querySelectorAll<HTMLElement>(".bar, .pages")];
    for (const bar of bars) expect(bar.scrollWidth).toBeLessThanOrEqual(width);
    book.remove();
  }
});

test("the slider says where it is and turns as it is dragged", async () => {
  const { book, root } = addFakeBook();
  const slider = root.querySelector<HTMLInputElement>("[part=slider]") as HTMLInputElement;
  expect(slider.getAttribute("aria-valuetext")).toBe("Page iv, 4 of 30");
  slider.focus();
  await userEvent.keyboard("{ArrowRight}{ArrowRight}");
  expect(book.asked).toEqual(["turnTo 5", "turnTo 6"]);
  expect(slider.getAttribute("aria-valuetext")).toBe("Page vi, 6 of 30");
  await userEvent.keyboard("{End}");
  expect(book.asked.at(-1)).toBe("turnTo 30");
  expect(root.querySelector(".bubble")?.textContent).toBe("24");
  expect(named(root, "Next page").ariaDisabled).toBe("true");
  // A book bound at the right runs the other way.
  book.direction = "rtl";
  book.dispatchEvent(new CustomEvent("layoutchange"));
  expect(getComputedStyle(slider).direction).toBe("rtl");
});

test("the page field finds labels and numbers, and says what is not there", async () => {
  const { book, root } = addFakeBook();
  const field = root.querySelector<HTMLInputElement>(".entry") as HTMLInputElement;
  const said = () => root.querySelector(".pages [role=status]")?.textContent;
  expect(field.value).toBe("iv");
  expect(root.querySelector(".count")?.textContent).toBe("4 of 30");
  field.focus();
  await userEvent.keyboard("VI{Enter}");
  await eventually(() => book.asked).toEqual(["turnTo 6"]);
  expect(document.activeElement).toBe(book);
  field.focus();
  await userEvent.keyboard("99{Enter}");
  expect(field.ariaInvalid).toBe("true");
  expect(said()).toBe("There is no page 99");
  await userEvent.keyboard("{Escape}");
  expect(field.value).toBe("vi");
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
  expect(seen).toEqual(["Stop the slide-show"]);
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
  expect(items()).toEqual(["Start the slide-show", "Print", "Download"]);
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

test("a number of pages that is an estimate says so, and a jump can be taken back", () => {
  const { book, root, remove } = addFakeBook(780, { estimated: true, jumpedFrom: 8 });
  expect(root.querySelector(".count")?.textContent).toContain("of about 30");
  const back = root.querySelector<HTMLButtonElement>(".return");
  expect([back?.hidden, back?.textContent]).toEqual([false, "Back to page 2"]);
  back?.click();
  expect(book.asked).toEqual(["jumpBack"]);
  Object.assign(book, { guessed: true, label: () => "Cover" });
  book.dispatchEvent(new CustomEvent("pageschange"));
  expect(root.querySelector(".count")?.textContent).toContain("of …");
  expect(back?.textContent).toBe("Back to “Cover”");
  Object.assign(book, { estimated: false, guessed: false, jumpedFrom: null });
  book.dispatchEvent(new CustomEvent("pageschange"));
  expect(root.querySelector(".count")?.textContent).toContain("of 30");
  expect(back?.hidden).toBe(true);
  remove();
  book.remove();
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

test("bars that lie over the book hide as a page is turned by hand, and come back by a tap or a key", async () => {
  const { book, root, remove } = addFakeBook(844);
  const stage = root.querySelector("[part=stage]") as HTMLElement;
  const frame = root.querySelector(".frame") as HTMLElement;
  const isBare = (): boolean => frame.classList.contains("bare");
  const turnBy = (on: Element | null): void => {
    on?.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true, composed: true }));
    book.dispatchEvent(new CustomEvent("turnstart"));
  };
  // Beside the book they stay.
  turnBy(stage);
  book.dispatchEvent(new CustomEvent("load"));
  await clock.pass(4000);
  expect(isBare()).toBe(false);
  stage.style.inset = "0";
  book.dispatchEvent(new CustomEvent("load"));
  expect(isBare()).toBe(false);
  await clock.pass(4000);
  expect(isBare()).toBe(true);
  stage.dispatchEvent(new Event(pageTap));
  await clock.pass(4000);
  expect(isBare()).toBe(false);
  turnBy(root.querySelector("[part=pages] button"));
  expect(isBare()).toBe(false);
  turnBy(stage);
  expect(isBare()).toBe(true);
  stage.dispatchEvent(new Event(pageTap));
  expect(isBare()).toBe(false);
  turnBy(stage);
  frame.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
  book.dispatchEvent(new CustomEvent("turnstart"));
  expect(isBare()).toBe(false);
  remove();
  book.remove();
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

test("a tap on the middle of a page hides the bars on a tablet too, unless a panel is open beside it", async () => {
  const { book, root, remove } = addFakeBook(1180);
  const stage = root.querySelector<HTMLElement>("[part=stage]");
  const isBare = () => root.querySelector(".frame")?.classList.contains("bare");
  const tap = () => stage?.dispatchEvent(new Event(pageTap));
  const height = stage?.clientHeight ?? 0;
  tap();
  expect([isBare(), stage?.clientHeight]).toEqual([true, height + 100]);
  tap();
  expect([isBare(), stage?.clientHeight]).toEqual([false, height]);
  root.querySelector<HTMLElement>("[part=toolbar] [aria-label=Contents]")?.click();
  await eventually(() => root.querySelector(".frame")?.classList.contains("open")).toBe(true);
  tap();
  expect([isBare(), stage?.clientHeight]).toEqual([false, height]);
  remove();
  book.remove();
});

test("on a phone Type is in the bar, and a tap on the middle of a page hides the bars and shows them", () => {
  const { book, root, remove } = addFakeBook(390, { canTypeset: true });
  const type = root.querySelector<HTMLElement>("[part=toolbar] [aria-label=Type]");
  expect(type?.offsetParent).not.toBeNull();
  const stage = root.querySelector<HTMLElement>("[part=stage]");
  const isBare = () => root.querySelector(".frame")?.classList.contains("bare");
  const height = stage?.clientHeight ?? 0;
  stage?.dispatchEvent(new Event(pageTap));
  expect(isBare()).toBe(true);
  expect(stage?.clientHeight).toBe(height + 100);
  stage?.dispatchEvent(new Event(pageTap));
  expect([isBare(), stage?.clientHeight]).toEqual([false, height]);
  remove();
  book.remove();
});
