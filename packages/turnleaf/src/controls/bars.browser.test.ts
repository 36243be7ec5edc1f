/** The bars over and under the book, and when they hide. On a test double of the book, in real Chromium. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { pageTap } from "../element/page_tap.ts";
import { clock } from "../for_tests/clock.ts";
import { eventually } from "../for_tests/eventually.ts";
import { addFakeBook } from "../for_tests/fake_book.ts";
import { named } from "../for_tests/shown_controls.ts";

afterEach(() => document.body.replaceChildren());

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
