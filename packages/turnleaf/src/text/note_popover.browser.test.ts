import { expect, test, vi } from "vitest";
import { userEvent } from "vitest/browser";
import { book, happens } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { tinyEpub } from "../sources/epub/tiny_epub.ts";

test("a link to a note shows it over the page, by the keyboard too, and Escape closes it", async () => {
  const chapters = [
    '<p>Text<a epub:type="noteref" href="c3.xhtml#n">1</a></p>',
    "<p>Between.</p>",
    '<aside id="n" epub:type="footnote">Said of it.</aside>',
  ];
  // In a dialog of the web page's own, which Escape closes only where nothing of the book is open.
  const dialog = document.createElement("dialog");
  document.body.append(dialog);
  dialog.showModal();
  const element = book(tinyEpub({ chapters }), { duration: "0" });
  dialog.append(element);
  // Once every chapter is set, the links are made anew.
  await Promise.all([happens(element, "load"), happens(element, "pageschange")]);
  const root = element.shadowRoot as ShadowRoot;
  const link = (): HTMLAnchorElement | null => root.querySelector(".text a[aria-haspopup]");
  await eventually(link).not.toBeNull();
  const note = root.querySelector(".note") as HTMLElement;
  const isOpen = (): boolean => note.matches(":popover-open");
  link()?.focus();
  await userEvent.keyboard("{Enter}");
  await eventually(isOpen).toBe(true);
  expect(note.querySelector("p")?.textContent).toBe("Said of it.");
  expect(root.activeElement).toBe(note);
  expect(element.page).toBe(1);
  const box = note.getBoundingClientRect();
  expect(box.left >= 0 && box.right <= innerWidth && box.bottom <= innerHeight).toBe(true);
  await userEvent.keyboard("{Escape}");
  await eventually(isOpen).toBe(false);
  expect(root.activeElement).toBe(link());
  expect(dialog.open).toBe(true);
  // Its button turns to where it is printed.
  link()?.click();
  await eventually(isOpen).toBe(true);
  note.querySelector("button")?.click();
  expect(isOpen()).toBe(false);
  await eventually(() => element.page).toBeGreaterThan(1);
  dialog.remove();
});

test("a link out of an EPUB is followed only after its address was shown", async () => {
  const chapters = [
    '<p><a href="https://example.org/a?b">out</a> <a href="mailto:a@example.org">mail</a></p>',
  ];
  const element = book(tinyEpub({ chapters }), { duration: "0", lang: "en" });
  const root = element.shadowRoot as ShadowRoot;
  const links = (): HTMLAnchorElement[] => [...root.querySelectorAll<HTMLAnchorElement>(".text a")];
  await eventually(() => links().length).toBe(2);
  const followed: string[] = [];
  const click = vi.spyOn(HTMLAnchorElement.prototype, "click").mockImplementation(function (
    this: HTMLAnchorElement,
  ) {
    followed.push(`${this.href} ${this.target} ${this.rel}`);
  });
  const note = root.querySelector(".note") as HTMLElement;
  for (const [k, address] of ["https://example.org/a?b", "mailto:a@example.org"].entries()) {
    const event = new MouseEvent("click", { bubbles: true, cancelable: true });
    expect(links()[k]?.dispatchEvent(event)).toBe(false);
    expect(note.matches(":popover-open")).toBe(true);
    expect(note.querySelector("p")?.textContent).toBe(
      `This link leads out of the book, to ${address}`,
    );
    expect(followed.length).toBe(k);
    note.querySelector("button")?.click();
    expect(note.matches(":popover-open")).toBe(false);
    expect(followed[k]).toBe(`${address} _blank noopener noreferrer`);
  }
  click.mockRestore();
  element.remove();
});

test.each(["", "zoom: 1.5", "rotate: 20deg; scale: 0.8", "scale: -1 1"])(
  "a note stands at the foot, and not on its link, where what is around the book says '%s'",
  async (style) => {
    const chapters = [
      '<p>Text<a epub:type="noteref" href="c2.xhtml#n">1</a></p>',
      '<aside id="n" epub:type="footnote">Said of it.</aside>',
    ];
    const element = book(tinyEpub({ chapters }), { duration: "0" });
    const around = document.createElement("div");
    around.style.cssText = `position: fixed; left: 60px; top: 40px; ${style}`;
    document.body.append(around);
    around.append(element);
    await Promise.all([happens(element, "load"), happens(element, "pageschange")]);
    const root = element.shadowRoot as ShadowRoot;
    await eventually(() => root.querySelector(".text a[aria-haspopup]")).not.toBeNull();
    const link = root.querySelector(".text a[aria-haspopup]") as HTMLAnchorElement;
    link.click();
    const [note, beside] = [root.querySelector(".note") as HTMLElement, link].map((at) =>
      at.getBoundingClientRect(),
    );
    const foot = Math.min(
      root.querySelector(".reading")?.getBoundingClientRect().bottom ?? 0,
      innerHeight,
    );
    expect(note.bottom).toBeCloseTo(foot - 8, 0);
    expect(note.top).toBeGreaterThanOrEqual(beside.bottom + 7);
    expect(note.left).toBeLessThan(beside.right);
    expect(note.right).toBeGreaterThan(beside.left);
    around.remove();
  },
);
