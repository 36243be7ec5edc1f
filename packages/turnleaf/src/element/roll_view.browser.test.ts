import { afterEach, expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { prose, type TinyEpub, tinyEpub } from "../sources/epub/tiny_epub.ts";

afterEach(() => document.body.replaceChildren());

const flow = (value: string): string => `<meta property="rendition:flow">${value}</meta>`;

const rollOf = (element: TurnleafBook): HTMLElement =>
  element.shadowRoot?.querySelector("[part=roll]") as HTMLElement;

const sheetsOf = (element: TurnleafBook): HTMLElement[] => [
  ...rollOf(element).querySelectorAll<HTMLElement>(".roll-page"),
];

/** Opens an EPUB in a place of some size, and waits until all its pages are counted and drawn. */
async function opened(epub: TinyEpub, attributes: Record<string, string> = {}) {
  const element = book(tinyEpub(epub), attributes);
  element.style.cssText = "width: 500px; height: 300px";
  await happens(element, "load");
  // Not by an event: where the estimate is right, no page comes or goes.
  await eventually(() => element.estimated).toBe(false);
  await settled(element);
  await eventually(() => rollOf(element).querySelectorAll("canvas").length).toBeGreaterThan(0);
  return element;
}

/** The words of a page's text over its drawing that are seen in the window. */
function wordsInSight(element: TurnleafBook): string {
  const window = rollOf(element).getBoundingClientRect();
  const pieces = [...rollOf(element).querySelectorAll<HTMLElement>(".text .print span")];
  const seen = pieces.filter((piece) => {
    const { top, bottom } = piece.getBoundingClientRect();
    return top >= window.top && bottom <= window.bottom;
  });
  return seen.map(({ textContent }) => textContent).join(" ");
}

test("each chapter is scrolled by itself; the open page follows, and a command scrolls to its page", async () => {
  const chapters = [prose(20), prose(20)];
  const element = await opened({ chapters, metadata: flow("scrolled-doc") }, { controls: "" });
  const roll = rollOf(element);

  const count = sheetsOf(element).length;
  // The chapter that is not in sight is only estimated.
  expect(Math.abs(count - element.pageCount / 2)).toBeLessThan(1);
  expect(roll.scrollHeight).toBeGreaterThan(3 * roll.clientHeight);
  // The pages hang together, and are as wide as the place of their text.
  const first = sheetsOf(element)[0] as HTMLElement;
  expect(first.offsetWidth).toBe((first.offsetParent as HTMLElement).offsetWidth);
  const boxes = sheetsOf(element).map((sheet) => sheet.getBoundingClientRect());
  for (const [k, box] of boxes.entries()) {
    if (k > 0) expect(box.top - (boxes[k - 1]?.bottom ?? 0)).toBeCloseTo(0, 2);
  }
  const turned = happens<{ to: number }>(element, "pagechange");
  roll.scrollTop = (sheetsOf(element)[2] as HTMLElement).offsetTop + 40;
  expect((await turned).to).toBe(3);
  expect(element.page).toBe(3);
  expect(await element.goTo(2)).toBe(true);
  await eventually(() => roll.scrollTop).toBe((sheetsOf(element)[1] as HTMLElement).offsetTop);
  await eventually(() => wordsInSight(element)).toMatch(/word\d+x\d+/);
  // The last page cannot lie at the head of the window.
  expect(await element.goTo(count)).toBe(true);
  await clock.pass(500);
  expect(element.page).toBe(count);
  expect(await element.next()).toBe(true);
  await eventually(() => [roll.scrollTop, element.page]).toEqual([0, count + 1]);
  await eventually(() => wordsInSight(element)).toContain("word0x0");
});

test("a finger across, or a wheel, leads to the next chapter and back; one down scrolls", async () => {
  const chapters = [prose(20), prose(20), prose(1)];
  const element = await opened({ chapters, metadata: flow("scrolled-doc") });
  const roll = rollOf(element);
  const [first, second] = [1, 1 + sheetsOf(element).length];
  const swipe = (x: number, y: number): void => {
    const init = { pointerId: 5, pointerType: "touch", bubbles: true, composed: true };
    roll.dispatchEvent(new PointerEvent("pointerdown", { ...init, clientX: 200, clientY: 150 }));
    const to = { clientX: 200 + x, clientY: 150 + y };
    roll.dispatchEvent(new PointerEvent("pointerup", { ...init, ...to }));
  };
  swipe(-100, 10);
  expect(element.page).toBe(second);
  swipe(-100, 90);
  swipe(-20, 0);
  expect(element.page).toBe(second);
  await eventually(() => sheetsOf(element).length).toBe(second - first);
  swipe(100, -10);
  expect(element.page).toBe(first);
  await eventually(() => wordsInSight(element)).toContain("word0x0");
  const wheel = (deltaX: number, deltaY: number): boolean =>
    roll.dispatchEvent(
      new WheelEvent("wheel", { deltaX, deltaY, bubbles: true, cancelable: true }),
    );
  // The browser scrolls.
  expect(wheel(0, 100)).toBe(true);
  expect([wheel(40, 0), wheel(40, 0), wheel(40, 0), element.page]).toEqual([
    ...[false, false, false],
    second,
  ]);
  element.focus();
  await eventually(() => roll.scrollTop).toBe(0);
  const key = new KeyboardEvent("keydown", { key: "ArrowDown", bubbles: true, composed: true });
  element.shadowRoot?.activeElement?.dispatchEvent(key);
  await eventually(() => roll.scrollTop).toBe(60);
});

test("continuous chapters are one roll, with links, marks of a search, another type and a zoom", async () => {
  const chapters = ['<p><a href="c2.xhtml">on</a></p>', prose(20), prose(3)];
  const element = await opened({ chapters, metadata: flow("scrolled-continuous") });
  const roll = rollOf(element);
  expect(sheetsOf(element).length).toBe(element.pageCount);
  const link = (): HTMLElement | null => roll.querySelector(".text a");
  await eventually(() => link()?.offsetWidth).toBeGreaterThan(5);
  link()?.click();
  await eventually(() => element.page).toBe(2);
  const [hit] = await element.search("word19x59");
  if (!hit) throw new Error("The word was not found.");
  expect(await element.showHit(hit)).toBe(true);
  const mark = (): DOMRect | undefined => roll.querySelector(".mark.here")?.getBoundingClientRect();
  const window = roll.getBoundingClientRect();
  await eventually(() => {
    const { top = 0, bottom = 0 } = mark() ?? {};
    return top > window.top && bottom < window.bottom && bottom > top;
  }).toBe(true);
  const changed = happens(element, "pageschange");
  element.fontSize = 2;
  await changed;
  await eventually(() => sheetsOf(element).length).toBe(element.pageCount);
  const wide = roll.clientWidth;
  expect((sheetsOf(element)[0] as HTMLElement).offsetWidth).toBe(wide);
  element.zoom = 2;
  await eventually(() => (sheetsOf(element)[0] as HTMLElement).offsetWidth).toBe(2 * wide);
});

test("a link and a line of the contents lead to their line, on another page and on the one that is read", async () => {
  const line = `<p id="deep">Deepline <a href="#far">farther</a></p>`;
  const chapters = [
    '<p><a href="c2.xhtml#deep">on</a></p>',
    `${prose(6)}${line}<p>1</p><p>2</p><p>3</p><p id="far">Farline</p>${prose(12)}`,
  ];
  const toc = '<li><a href="c1.xhtml">One</a></li><li><a href="c2.xhtml#far">Far</a></li>';
  const element = await opened({ chapters, metadata: flow("scrolled-doc"), toc });
  const roll = rollOf(element);
  const follow = async (title: string): Promise<void> => {
    const link = (): HTMLElement | undefined =>
      [...roll.querySelectorAll<HTMLElement>(".text a")].find(
        (a) => a.ariaLabel === title && a.offsetWidth > 5,
      );
    await eventually(link).toBeDefined();
    link()?.click();
  };
  /** How far under the head of the window a word stands, and its page's head. */
  const placeOf = (word: string): [number, number] | null => {
    const spans = [...roll.querySelectorAll<HTMLElement>(".text .print span")];
    const span = spans.find(({ textContent }) => textContent.includes(word));
    const { top } = roll.getBoundingClientRect();
    const page = sheetsOf(element)[element.page - 2];
    if (!span || !page) return null;
    return [span.getBoundingClientRect().top - top, page.getBoundingClientRect().top - top];
  };
  const isAtHead = (word: string): boolean => Math.abs(placeOf(word)?.[0] ?? 99) < 8;
  await follow("on");
  await eventually(() => isAtHead("Deepline")).toBe(true);
  // The page's head is elsewhere.
  expect(placeOf("Deepline")?.[1]).toBeLessThan(-20);
  const page = element.page;
  await follow("farther");
  await eventually(() => isAtHead("Farline")).toBe(true);
  expect(element.page).toBe(page);
  // Another window leaves it there.
  element.style.width = "420px";
  await eventually(() => roll.clientWidth).toBe(420);
  await eventually(() => isAtHead("Farline")).toBe(true);
  const [one, far] = await element.outline();
  expect(await element.goTo(one?.page ?? 0)).toBe(true);
  expect(far?.page).toBe(page);
  expect(await element.goTo(page, { top: far?.top ?? 0 })).toBe(true);
  await eventually(() => isAtHead("Farline")).toBe(true);
  expect(await element.goTo(page, { top: Number.NaN })).toBe(true);
  expect(isAtHead("Farline")).toBe(true);
});

test("pages of fixed layout among them are turned, and those of a roll as wide as the window", async () => {
  const fixed = (width: number, height: number): string =>
    `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title><meta name="viewport" content="width=${width}, height=${height}"/></head><body><p>fixed</p></body></html>`;
  const mixed = await opened({
    chapters: [prose(1), fixed(600, 800), prose(1)],
    properties: { 1: "rendition:layout-pre-paginated" },
    metadata: flow("scrolled-continuous"),
  });
  const canvas = mixed.shadowRoot?.querySelector("canvas[part=canvas]") as HTMLElement;
  const seen = (): unknown[] => [rollOf(mixed).hidden, getComputedStyle(canvas).visibility];
  expect(seen()).toEqual([false, "hidden"]);
  expect(await mixed.goTo(2)).toBe(true);
  await eventually(seen).toEqual([true, "visible"]);
  expect(await mixed.goTo(3)).toBe(true);
  await eventually(seen).toEqual([false, "hidden"]);
  mixed.remove();
  const roll = await opened({
    chapters: [fixed(300, 200), fixed(800, 200)],
    metadata: '<meta property="rendition:layout">roll</meta>',
  });
  await eventually(() =>
    sheetsOf(roll).map(({ offsetWidth, offsetHeight }) => [offsetWidth, offsetHeight]),
  ).toEqual([
    [rollOf(roll).clientWidth, Math.round((rollOf(roll).clientWidth * 200) / 300)],
    [rollOf(roll).clientWidth, Math.round(rollOf(roll).clientWidth / 4)],
  ]);
  roll.remove();
  expect(document.querySelectorAll("iframe").length).toBe(0);
});
