/** Pages changed without motion, where the open book lies, and how strong its shadows are. */

import { afterEach, expect, test } from "vitest";
import type { BookState } from "../book/turning.ts";
import type { TurnleafBook } from "../element.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";
import type { TurnDetail } from "./events.ts";

afterEach(() => document.body.replaceChildren());

async function opened(attributes: Record<string, string> = {}): Promise<TurnleafBook> {
  const element = book(scans(12), { page: "6", cover: "none", ...attributes });
  await happens(element, "load");
  await settled(element);
  return element;
}

test("a page is gone to without motion, also from the middle of a turn", async () => {
  const element = await opened();
  const states: BookState[] = [];
  const pages: TurnDetail[] = [];
  element.addEventListener("statechange", ({ detail }) => states.push(detail.state));
  element.addEventListener("pagechange", ({ detail }) => pages.push(detail));
  expect(await element.goTo(10, { motion: false })).toBe(true);
  expect(element.page).toBe(10);
  await settled(element);
  expect(states).toEqual([]);
  const turned = element.previous();
  await happens(element, "statechange");
  expect(element.state).toBe("turning");
  expect(await element.goTo(2, { motion: false })).toBe(true);
  // The turn back that was under way has been overtaken: the book lies farther back.
  expect(await turned).toBe(true);
  await settled(element);
  expect(states).toEqual(["turning", "resting"]);
  expect(pages.map(({ to }) => to)).toEqual([10, 2]);
});

test("a book that is removed in the middle of a turn is at rest", async () => {
  const element = await opened();
  void element.next();
  await happens(element, "statechange");
  const resting = happens<{ state: BookState }>(element, "statechange");
  element.remove();
  expect((await resting).state).toBe("resting");
  expect(element.bookBounds).toBeNull();
});

test.each<Record<string, string>>([
  { cover: "hard", layout: "spread" },
  { cover: "soft", layout: "spread" },
  { cover: "hard", layout: "single" },
  { cover: "hard", layout: "spread", binding: "right" },
])("the bounds of the open book are known while it is shut, %o", async (attributes) => {
  const element = await opened({ ...attributes, page: "1" });
  const shut = element.bookBounds as DOMRect;
  await element.goTo(6, { motion: false });
  await settled(element);
  const { left, right, top, bottom } = element.bookBounds as DOMRect;
  await element.goTo(Number.POSITIVE_INFINITY, { motion: false });
  await settled(element);
  const back = element.bookBounds as DOMRect;
  for (const closed of [shut, back]) {
    expect(Math.abs(closed.left - left)).toBeLessThan(1);
    expect(Math.abs(closed.right - right)).toBeLessThan(1);
    expect(Math.abs(closed.top - top)).toBeLessThan(1);
    expect(Math.abs(closed.bottom - bottom)).toBeLessThan(1);
  }
});

test.each([
  { attributes: { layout: "spread" }, ratio: (2 * 90) / 120 },
  { attributes: { layout: "single" }, ratio: 90 / 120 },
  { attributes: { layout: "spread", binding: "top" }, ratio: 90 / (2 * 120) },
])("the bounds of the open book, $attributes", async ({ attributes, ratio }) => {
  const element = await opened(attributes as unknown as Record<string, string>);
  const bounds = element.bookBounds as DOMRect;
  expect(bounds.width / bounds.height).toBeCloseTo(ratio, 1);
  // A page that stands alone lies a little toward its fore-edge.
  expect(Math.abs((bounds.left + bounds.right) / 2 - 150)).toBeLessThan(12);
  await element.goTo(1, { motion: false });
  await settled(element);
  expect(element.bookBounds?.toJSON()).toEqual(bounds?.toJSON());
  // A point just inside is the book's, one outside is not.
  await element.goTo(6, { motion: false });
  await settled(element);
  const pointer = new TestPointer(element);
  const cursorAt = (x: number, y: number): string => {
    pointer.point("pointermove", x, y);
    return pointer.canvas.style.cursor;
  };
  const middle = (bounds.left + bounds.right) / 2;
  expect(cursorAt(middle + 10, bounds.bottom - 6)).toBe("grab");
  expect(cursorAt(middle + 10, bounds.bottom + 8)).toBe("");
});

test.each([
  ["ltr", ""],
  ["rtl", "right"],
])(
  "the buttons turn as far as the keys do: until the boards are closed, %s",
  async (_, binding) => {
    const options = { controls: "", duration: "0", binding, cover: "hard", offset: "0" };
    const element = book(scans(6), { ...options, layout: "spread" });
    await happens(element, "load");
    await settled(element);
    const named = (label: string) =>
      element.shadowRoot?.querySelector(`[aria-label="${label}"]`) as HTMLElement;
    await eventually(() => named("Next page")?.ariaDisabled).toBe("false");
    for (const [label, by] of [
      ["Next page", 1],
      ["Previous page", -1],
    ] as const) {
      let presses = 0;
      while (named(label).ariaDisabled === "false" && presses < 20) {
        named(label).click();
        await settled(element);
        presses++;
      }
      // Closed, and no key turns it any further.
      expect(Object.values(element.spread)).toEqual([null, null]);
      expect(await element.press(by)).toBe(false);
      expect(await element.press(-by as 1 | -1)).toBe(true);
      await settled(element);
      expect(named(label).ariaDisabled).toBe("false");
    }
  },
);
