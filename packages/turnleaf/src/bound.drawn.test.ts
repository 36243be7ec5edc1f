/**
 * Books bound in other ways, turned by dragging in real Chromium: which page is
 * seen where, by its colour.
 */

import { expect, test } from "vitest";
import type { TurnleafBook } from "./element.ts";
import { clock } from "./for_tests/clock.ts";
import {
  bookInPlace,
  drawRoughly,
  happens,
  keepWhatIsDrawn,
  settled,
} from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { TestPointer } from "./for_tests/test_pointer.ts";
import { openSource } from "./sources/open_source.ts";
import type { PageSource } from "./sources/page_source.ts";

keepWhatIsDrawn();
drawRoughly();

/** A colour for each page, distinguished by its hue. */
const hueOf = (page: number): number => (page * 47) % 360;

function plain(page: number, width = 80, height = 120): { src: string } {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = `hsl(${hueOf(page)} 90% 60%)`;
  pen.fillRect(0, 0, width, height);
  return { src: canvas.toDataURL("image/png") };
}

const pages = (count: number): { src: string }[] =>
  Array.from({ length: count }, (_, k) => plain(k + 1));

/** Returns what a settled element shows. */
async function pictureOf(element: TurnleafBook): Promise<ImageData> {
  await settled(element);
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const copy = new OffscreenCanvas(canvas.width, canvas.height);
  const pen = copy.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(canvas, 0, 0);
  return pen.getImageData(0, 0, copy.width, copy.height);
}

/**
 * Returns the hue at a place of a picture, in fractions of its size; null if
 * there is no strong colour.
 */
function hueIn({ data, width, height }: ImageData, x: number, y: number): number | null {
  const [column, row] = [Math.floor(x * width), Math.floor(y * height)];
  const [r, g, b] = data.subarray(4 * (row * width + column));
  const most = Math.max(r, g, b);
  const span = most - Math.min(r, g, b);
  if (span < 60) return null;
  const sixth = most === r ? (g - b) / span : most === g ? 2 + (b - r) / span : 4 + (r - g) / span;
  return (60 * sixth + 360) % 360;
}

/** Returns the hue at a place of a settled element, likewise. */
const hueAt = async (element: TurnleafBook, x: number, y: number): Promise<number | null> =>
  hueIn(await pictureOf(element), x, y);

/** Expects a page's colour at a place. */
async function expectPage(element: TurnleafBook, page: number, x: number, y: number) {
  const hue = await hueAt(element, x, y);
  expect(hue, `page ${page} at ${x}, ${y}`).not.toBeNull();
  const off = Math.abs((hue as number) - hueOf(page));
  expect(Math.min(off, 360 - off), `page ${page} at ${x}, ${y}`).toBeLessThan(12);
}

/**
 * Drags from one place to another, in fractions of the element's size, slowly
 * enough for the leaf to follow: once it moves, it goes on when `isHeld`.
 */
async function drag(
  element: TurnleafBook,
  from: [number, number],
  to: [number, number],
  steps = 40,
  isHeld = () => true,
) {
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  canvas.setPointerCapture = () => {};
  const box = canvas.getBoundingClientRect();
  const point = (name: string, x: number, y: number) =>
    canvas.dispatchEvent(
      new PointerEvent(name, {
        pointerId: 1,
        isPrimary: true,
        pointerType: "mouse",
        button: 0,
        bubbles: true,
        clientX: box.left + x * box.width,
        clientY: box.top + y * box.height,
      }),
    );
  point("pointerdown", ...from);
  for (let step = 1; step <= steps; step++) {
    const t = step / steps;
    point("pointermove", from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t);
    await new Promise((resolve) => requestAnimationFrame(resolve));
    if (step === 4) await clock.until(isHeld);
  }
  point("pointerup", ...to);
  await settled(element);
}

const opened = (attributes: Record<string, string>, size = [420, 300], sheets = pages(12)) =>
  bookInPlace(sheets, { duration: "80", ...attributes }, size);

/** Opens a book of which the fifth page is another, with room beside it. */
function openedWithFoldOut(page: { src: string }): Promise<TurnleafBook> {
  return opened({ page: "4", cover: "none" }, [560, 300], pages(12).with(4, page));
}

test("bound on the right: the second page is on the right, and on is dragged from the left", async () => {
  const element = await opened({ binding: "right", page: "4" });
  expect(element.direction).toBe("rtl");
  expect(element.spread).toEqual({ left: 5, right: 4 });
  await expectPage(element, 5, 0.35, 0.6);
  await expectPage(element, 4, 0.65, 0.6);
  await drag(element, [0.14, 0.6], [0.85, 0.6]);
  expect([element.page, element.spread]).toEqual([6, { left: 7, right: 6 }]);
  await expectPage(element, 7, 0.35, 0.6);
  await expectPage(element, 6, 0.65, 0.6);
  element.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
  await eventually(() => element.page).toBe(8);
  element.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
  await eventually(() => element.page).toBe(6);
});

test("bound at the top: pages lie above each other, and on is dragged from below", async () => {
  const element = await opened({ binding: "top", layout: "spread", page: "4" }, [300, 420]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  await expectPage(element, 4, 0.5, 0.35);
  await expectPage(element, 5, 0.5, 0.75);
  await drag(element, [0.5, 0.9], [0.5, 0.2]);
  expect(element.page).toBe(6);
  await expectPage(element, 6, 0.5, 0.35);
  await expectPage(element, 7, 0.5, 0.75);
  element.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowDown" }));
  await eventually(() => element.page).toBe(8);
});

test("bound at the bottom, the next page lies above", async () => {
  const element = await opened({ binding: "bottom", layout: "spread", page: "4" }, [300, 420]);
  await expectPage(element, 5, 0.5, 0.35);
  await expectPage(element, 4, 0.5, 0.75);
  expect(await element.next()).toBe(true);
  await expectPage(element, 7, 0.5, 0.35);
});

test("a narrow place shows one page, and a wide one two, at the same place in the book", async () => {
  const element = await opened({ page: "5" });
  const canvas = element.shadowRoot?.querySelector("canvas");
  expect(element.spread).toEqual({ left: 4, right: 5 });
  const laidOut = happens(element, "layoutchange");
  [element.style.width, element.style.height] = ["200px", "400px"];
  expect(await laidOut).toEqual({ layout: "single", binding: "left" });
  await settled(element);
  expect(element.spread).toEqual({ left: null, right: 5 });
  await expectPage(element, 5, 0.5, 0.5);
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(6);
  await expectPage(element, 6, 0.5, 0.5);
  expect(await element.next()).toBe(true);
  const back = happens(element, "layoutchange");
  [element.style.width, element.style.height] = ["420px", "300px"];
  expect(await back).toEqual({ layout: "spread", binding: "left" });
  expect(element.spread).toEqual({ left: 6, right: 7 });
  element.setAttribute("layout", "single");
  expect(element.page).toBe(7);
  expect(element.shadowRoot?.querySelector("canvas")).toBe(canvas);
});

test("a page that is to be shown by itself stands in the middle, and its neighbours in spreads", async () => {
  const single = async (): Promise<PageSource> => {
    const source = await openSource(pages(9));
    return Object.assign(source, { inSpread: (k: number) => (k === 4 ? "single" : undefined) });
  };
  const options = { duration: "80", cover: "none", page: "2" };
  const element = await bookInPlace(single, options, [420, 300]);
  expect([element.shownLayout, element.spread]).toEqual(["spread", { left: 2, right: 3 }]);
  expect(await element.next()).toBe(true);
  await settled(element);
  expect([element.shownLayout, element.spread]).toEqual(["spread", { left: 4, right: null }]);
  expect(await element.next()).toBe(true);
  await settled(element);
  expect([element.shownLayout, element.spread]).toEqual(["single", { left: null, right: 5 }]);
  await expectPage(element, 5, 0.5, 0.5);
  expect([await hueAt(element, 0.12, 0.5), await hueAt(element, 0.88, 0.5)]).toEqual([null, null]);
  expect(await element.next()).toBe(true);
  await settled(element);
  expect([element.shownLayout, element.spread]).toEqual(["spread", { left: 6, right: 7 }]);
  expect(await element.goTo(5)).toBe(true);
  await settled(element);
  expect(element.shownLayout).toBe("single");
  expect(await element.previous()).toBe(true);
  await settled(element);
  expect([element.shownLayout, element.spread]).toEqual(["spread", { left: 4, right: null }]);
  // What the web page asks for goes first: nothing lies beside the page.
  element.layout = "spread";
  expect(await element.goTo(5)).toBe(true);
  await settled(element);
  expect([element.shownLayout, element.spread]).toEqual(["spread", { left: 5, right: null }]);
});

test("a page alone is drawn away from its spine to bring the one before it back", async () => {
  for (const [binding, from, to] of [
    ["left", [0.4, 0.6], [0.95, 0.6]],
    ["right", [0.6, 0.6], [0.05, 0.6]],
  ] as [string, [number, number], [number, number]][]) {
    const element = await opened({ page: "5", binding, layout: "single" }, [220, 360]);
    await drag(element, from, to);
    expect(element.page, binding).toBe(4);
  }
});

test("what is bound anew in the middle of a turn lands first", async () => {
  const element = await opened({ page: "4", cover: "none" });
  const turned = element.next();
  element.setAttribute("offset", "0");
  element.setAttribute("binding", "right");
  expect(await turned).toBe(true);
  await settled(element);
  // Page 6 has become visible; beside it now lies 5.
  expect(element.spread).toEqual({ left: 6, right: 5 });
  await expectPage(element, 6, 0.35, 0.6);
  await expectPage(element, 5, 0.65, 0.6);
});

test("the closed book lies in the middle, front and back, with boards or without", async () => {
  for (const cover of ["hard", "none"]) {
    const element = await opened({ cover, page: "1" });
    await expectPage(element, 1, 0.5, 0.5);
    expect(await hueAt(element, 0.12, 0.5)).toBeNull();
    expect(await element.goTo(12)).toBe(true);
    await expectPage(element, 12, 0.5, 0.5);
    expect(await hueAt(element, 0.88, 0.5)).toBeNull();
  }
});

/** A page twice as wide as others: its own colour, and another's on the half that folds out. */
function wide(page: number, beyond: number): { src: string } {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [140, 120];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  for (const [k, hue] of [hueOf(page), hueOf(beyond)].entries()) {
    pen.fillStyle = `hsl(${hue} 90% 60%)`;
    pen.fillRect(78 * k, 0, 80, 120);
  }
  return { src: canvas.toDataURL("image/png") };
}

test("a fold-out is folded in, unfolds beside the book, and folds in before a turn", async () => {
  const element = await openedWithFoldOut(wide(5, 30));
  // The flap's back lies on most of the page.
  await expectPage(element, 5, 0.52, 0.6);
  expect(await hueAt(element, 0.65, 0.6)).toBeNull();
  expect(await element.unfold(4)).toBe(false);
  expect(await element.unfold(5)).toBe(true);
  await expectPage(element, 5, 0.5, 0.6);
  await expectPage(element, 30, 0.8, 0.6);
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(6);
  await expectPage(element, 7, 0.6, 0.6);
  expect(await element.previous()).toBe(true);
  await settled(element);
  expect(await hueAt(element, 0.65, 0.6)).toBeNull();
  // Commands that come while it is folded in for the one before wait for that together.
  expect(await element.unfold(5)).toBe(true);
  expect(await Promise.all([element.next(), element.foldIn(), element.next()])).toEqual([
    true,
    undefined,
    true,
  ]);
  expect(element.page).toBe(8);
});

test("an open fold-out of one colour shows no line at its folds", async () => {
  for (const sheet of [wide(5, 5), leporello(5, 5, 5)]) {
    const element = await openedWithFoldOut(sheet);
    expect(await element.unfold(5)).toBe(true);
    const picture = await pictureOf(element);
    const { data, width } = picture;
    const printed = Array.from({ length: width }, (_, x) => x).filter(
      (x) => Math.abs((hueIn(picture, x / width, 0.5) ?? 0) - hueOf(5)) < 12,
    );
    // Without the gutter's curve, and the paper's edge.
    const [first, last] = [
      printed[Math.ceil(0.1 * printed.length)],
      (printed.at(-1) as number) - 3,
    ];
    const row = Math.floor(0.5 * picture.height) * width;
    const brightness = (x: number): number =>
      data.slice(4 * (row + x), 4 * (row + x) + 3).reduce((sum, value) => sum + value);
    const steps: number[] = [];
    for (let x = first; x < last; x++) steps.push(Math.abs(brightness(x + 1) - brightness(x)));
    expect(Math.max(...steps)).toBeLessThan(12);
  }
});

test("a pointer opens a fold-out by its flap, shuts it again, and turns its leaf by any other pull", async () => {
  const element = await openedWithFoldOut(wide(5, 30));
  await drag(element, [0.58, 0.55], [0.86, 0.55], 40, () => element.foldOut === "open");
  await expectPage(element, 5, 0.5, 0.6);
  await expectPage(element, 30, 0.8, 0.6);
  expect([element.page, element.state]).toEqual([4, "resting"]);
  await drag(element, [0.8, 0.55], [0.55, 0.55]);
  await expectPage(element, 5, 0.52, 0.6);
  expect(await hueAt(element, 0.65, 0.6)).toBeNull();
  // Let go where it was taken, it falls shut.
  await drag(element, [0.58, 0.55], [0.61, 0.55]);
  expect(await hueAt(element, 0.65, 0.6)).toBeNull();
  await drag(element, [0.68, 0.6], [0.3, 0.6]);
  expect(element.page).toBe(6);
  await expectPage(element, 7, 0.6, 0.6);
});

test("a fold-out whose corner is lifted under a mouse unfolds, by command and by a pull at that corner", async () => {
  const element = await openedWithFoldOut(wide(5, 30));
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  const lift = async (): Promise<void> => {
    pointer.point("pointermove", right - 5, top + 5);
    await eventually(() => element.state).toBe("lifting");
  };
  await lift();
  expect(await element.unfold(5)).toBe(true);
  expect(element.state).toBe("resting");
  pointer.point("pointermove", right - 80, top + 80);
  await element.foldIn();
  await settled(element);
  await lift();
  await drag(
    element,
    [(right - 14) / 560, (top + 14) / 300],
    [0.97, (top + 18) / 300],
    40,
    () => element.foldOut === "open",
  );
  await expectPage(element, 30, 0.8, 0.6);
  expect([element.page, element.state]).toEqual([4, "resting"]);
});

/** A page folded out in two panels more, each of another page's colour. */
function leporello(...numbers: readonly number[]): { src: string } {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [78 + 76 * (numbers.length - 1), 120];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  for (const [k, number] of numbers.entries()) {
    pen.fillStyle = `hsl(${hueOf(number)} 90% 60%)`;
    pen.fillRect(k === 0 ? 0 : 78 + 76 * (k - 1), 0, 80, 120);
  }
  return { src: canvas.toDataURL("image/png") };
}

/** Returns the pages whose colours are seen along a line across the element, from its middle on. */
async function seenAcross(element: TurnleafBook, numbers: readonly number[]): Promise<number[]> {
  const seen: number[] = [];
  const picture = await pictureOf(element);
  for (let x = 0.4; x < 1; x += 0.01) {
    const hue = hueIn(picture, x, 0.55);
    if (hue === null) continue;
    const number = numbers.find((page) => {
      const off = Math.abs(hue - hueOf(page));
      return Math.min(off, 360 - off) < 12;
    });
    if (number !== undefined && seen.at(-1) !== number) seen.push(number);
  }
  return seen;
}

test("a leporello opens panel by panel, by command and by a pull, shuts and turns with its page", async () => {
  const element = await openedWithFoldOut(leporello(5, 30, 34));
  const seen = () => seenAcross(element, [5, 30, 34]);
  // The last panel lies uppermost, its face up.
  expect(await seen()).toEqual([5, 34]);
  expect(await element.unfold(5)).toBe(true);
  expect(await seen()).toEqual([5, 30, 34]);
  await element.foldIn();
  expect(await seen()).toEqual([5, 34]);
  // It is drawn in panels, which takes the browser a while, before the pointer has it and the eye steps back.
  await drag(element, [0.66, 0.55], [0.97, 0.55], 40, () => element.foldOut === "open");
  expect(await seen()).toEqual([5, 30, 34]);
  expect([element.page, element.state, element.foldOut]).toEqual([4, "resting", "open"]);
  expect(await element.next()).toBe(true);
  expect([element.page, element.foldOut]).toEqual([6, "none"]);
  await expectPage(element, 7, 0.6, 0.6);
  expect(await element.previous()).toBe(true);
  expect(await seen()).toEqual([5, 34]);
});

test("Enter on the book unfolds a fold-out, and folds it in", async () => {
  const element = await openedWithFoldOut(wide(5, 30));
  const pointer = new TestPointer(element);
  expect(element.foldOut).toBe("shut");
  pointer.key("Enter");
  await eventually(() => element.foldOut).toBe("open");
  await expectPage(element, 30, 0.8, 0.6);
  pointer.key("Enter");
  await eventually(() => element.foldOut).toBe("shut");
  await expectPage(element, 5, 0.52, 0.6);
  await settled(element);
  expect(await hueAt(element, 0.65, 0.6)).toBeNull();
  expect(await element.next()).toBe(true);
  const key = new KeyboardEvent("keydown", { key: "Enter", bubbles: true, cancelable: true });
  // Where nothing folds out the key is not the book's.
  expect([element.page, element.dispatchEvent(key)]).toEqual([6, true]);
});

test("a smaller page lies at the spine, and beside it the page beneath is seen", async () => {
  const sheets = pages(12);
  sheets[4] = plain(5, 50, 120);
  sheets[5] = plain(6, 50, 120);
  const element = await opened({ page: "4", cover: "none" }, [420, 300], sheets);
  // The page beneath is one of those that a turn may bring into sight.
  await eventually(() => element.ready).toBe(true);
  await expectPage(element, 5, 0.6, 0.6);
  await expectPage(element, 7, 0.82, 0.6);
  expect(await element.next()).toBe(true);
  await expectPage(element, 6, 0.4, 0.6);
  await expectPage(element, 4, 0.18, 0.6);
});

test("pages are added, taken out and replaced while the book lies open, which keeps its place", async () => {
  const element = await opened({ page: "6" });
  const changes: number[] = [];
  element.addEventListener("pageschange", (event) =>
    changes.push((event as CustomEvent<{ pageCount: number }>).detail.pageCount),
  );
  element.bookmarks = [5, 7, 12];
  expect(await element.insertPages(1, [plain(20), plain(21)])).toBe(true);
  expect(element.bookmarks).toEqual([7, 9, 14]);
  await settled(element);
  expect([element.pageCount, element.page]).toEqual([14, 8]);
  await expectPage(element, 6, 0.35, 0.6);
  await expectPage(element, 7, 0.65, 0.6);
  expect(await element.removePages(1, 2)).toBe(true);
  expect([element.pageCount, element.page]).toEqual([12, 6]);
  expect(await element.replacePage(7, [plain(25)])).toBe(true);
  expect(element.bookmarks).toEqual([5, 7, 12]);
  await settled(element);
  await expectPage(element, 6, 0.35, 0.6);
  await expectPage(element, 25, 0.65, 0.6);
  // In the middle of a turn: the leaf lands first.
  const turned = element.next();
  const removed = element.removePages(6, 2);
  expect([await turned, await removed]).toEqual([true, true]);
  await settled(element);
  expect([element.pageCount, element.page]).toEqual([10, 6]);
  // A removed page is no longer bookmarked.
  expect(element.bookmarks).toEqual([5, 10]);
  await expectPage(element, 8, 0.35, 0.6);
  expect(changes).toEqual([14, 12, 12, 10]);
  await expect(element.removePages(10, 2)).rejects.toThrow("pages 1 to 10 alone");
  await expect(element.removePages(1, 10)).rejects.toThrow("needs a page");
  await expect(element.replacePage(1, [])).rejects.toThrow();
  expect(element.pageCount).toBe(10);
});
