/** A book in other people's transformations: a pointer does there what it does in an upright one. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { clickMouse, dragMouse, mouse, type WindowPlace } from "../for_tests/real_mouse.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";

afterEach(() => {
  getSelection()?.removeAllRanges();
  document.body.replaceChildren();
  document.body.style.cssText = "";
});

/** The style of an element around the book, and the book's own. */
const transformations: readonly (readonly [name: string, around: string, own: string])[] = [
  ["larger", "transform: scale(1.5)", ""],
  ["smaller", "transform: scale(0.6)", ""],
  ["zoomed", "zoom: 1.4", ""],
  ["turned", "transform: rotate(20deg)", ""],
  ["on its side", "rotate: 90deg", ""],
  ["upside down", "", "transform: rotate(180deg)"],
  ["skewed", "transform: skew(20deg, 8deg)", ""],
  ["mirrored", "scale: -1 1", ""],
  ["in perspective", "perspective: 600px", "transform: rotateY(35deg) rotateX(15deg)"],
  ["in all of them", "zoom: 0.8; transform: rotate(-12deg) skewX(9deg)", "scale: 1.3 1.1"],
];

const item = (kind: string, more: string): string => `<< /Type /Annot /Subtype /${kind} ${more} >>`;

/** Eight pages; on the second lie a line of text, a link to the sixth and a field. */
function pdf(): File {
  const bytes = tinyPdf({
    pages: Array.from({ length: 8 }, () => "BT /F1 16 Tf 30 230 Td (Call me) Tj ET\n"),
    resources: `/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >> >> /Annots [10 0 R 11 0 R] /Ignored <<`,
    objects: [
      item("Link", "/Rect [30 100 150 130] /Dest [6 /Fit]"),
      item("Widget", "/Rect [30 150 150 180] /FT /Tx /T (name)"),
    ],
    catalog: "/AcroForm << /Fields [11 0 R] >>",
  });
  return new File([bytes], "whale.pdf");
}

/** A book in the middle of the window, inside an element that a web page may transform. */
class PlacedBook {
  readonly element: TurnleafBook = book(null, { cover: "none", page: "2", duration: "60" });
  readonly #around = document.createElement("div");
  readonly #probe = document.createElement("div");

  constructor(around: string, own = "") {
    const place = "position: absolute; left: 0; top: 0; width: 300px; height: 220px";
    this.#around.style.cssText = `position: fixed; left: 200px; top: 150px; width: 300px; height: 220px; ${around}`;
    this.element.style.cssText = `${place}; ${own}`;
    this.#probe.style.cssText = `${place}; ${own}; pointer-events: none`;
    this.#around.append(this.element, this.#probe);
    document.body.append(this.#around);
  }

  async open(pages: TurnleafBook["pages"]): Promise<void> {
    this.element.pages = pages;
    await happens(this.element, "load");
    await settled(this.element);
  }

  /** Returns where the browser shows a place of the element, by an element that lies there. */
  seen(x: number, y: number): WindowPlace {
    const point = document.createElement("div");
    point.style.cssText = `position: absolute; left: ${x}px; top: ${y}px`;
    this.#probe.append(point);
    const box = point.getBoundingClientRect();
    point.remove();
    return { x: box.x, y: box.y };
  }

  /** Returns where the browser shows a place of something laid over the page, in fractions of it. */
  seenOn(element: HTMLElement, u: number, v: number): WindowPlace {
    const { width, height, transform } = element.style;
    const [x, y] = [u * Number.parseFloat(width), v * Number.parseFloat(height)];
    const at = new DOMMatrix(transform).transformPoint({ x, y });
    return this.seen(at.x, at.y);
  }

  all<T extends HTMLElement>(selector: string): T[] {
    return [...(this.element.shadowRoot as ShadowRoot).querySelectorAll<T>(selector)];
  }

  one<T extends HTMLElement>(selector: string): T {
    return this.all<T>(selector)[0] as T;
  }

  /** Goes back to the second page. */
  async back(): Promise<void> {
    await this.element.goTo(2, { motion: false });
    await settled(this.element);
    await eventually(() => this.all(".text span").length).toBe(2);
  }
}

const rounded = (numbers: readonly number[]): number[] =>
  numbers.map((n) => Math.round(10 * n) / 10);

/** Reads, clicks, drags, rolls and pinches. Returns what came of each. */
async function used(placed: PlacedBook): Promise<Record<string, unknown>> {
  const { element } = placed;
  await placed.open(pdf());
  await placed.back();
  const seen: Record<string, unknown> = {};
  const [text] = placed.all(".text span");

  await dragMouse(placed.seenOn(text, 0.01, 0.5), placed.seenOn(text, 0.99, 0.5));
  seen.selected = String(getSelection());
  await clickMouse(placed.seenOn(placed.one(".field"), 0.5, 0.5));
  await userEvent.keyboard("Ahab");
  seen.typed = placed.one<HTMLInputElement>(".field").value;

  await clickMouse(placed.seenOn(placed.one("a"), 0.5, 0.5));
  await eventually(() => element.page).toBe(6);
  await placed.back();
  // At the fore-edge.
  await clickMouse(placed.seen(258, 60));
  await clock.pass(20);
  await settled(element);
  seen.clicked = element.page;
  await placed.back();
  await mouse("mouseMoved", placed.seen(250, 190));
  await mouse("mousePressed", placed.seen(250, 190), 1);
  for (const x of [230, 190, 150, 110, 70, 50]) {
    await mouse("mouseMoved", placed.seen(x, 180), 1);
    await clock.pass(16);
  }
  await settled(element);
  await mouse("mouseReleased", placed.seen(50, 180));
  await settled(element);
  seen.dragged = element.page;
  await placed.back();

  const pointer = new TestPointer(element);
  const at = (x: number, y: number): { clientX: number; clientY: number } => {
    const place = placed.seen(x, y);
    return { clientX: place.x, clientY: place.y };
  };
  const laid = (): number[] => {
    const { e, f } = new DOMMatrix(placed.one(".text span").style.transform);
    return rounded([element.zoom, e, f]);
  };
  pointer.roll(0, -40, { ctrlKey: true, ...at(90, 80) });
  await settled(element);
  seen.wheeled = laid();
  element.zoom = 1;
  await settled(element);
  const [a, b] = [1, 2].map((pointerId) => ({ pointerType: "touch", pointerId }));
  pointer.point("pointerdown", 0, 0, { ...a, ...at(140, 110) });
  pointer.point("pointerdown", 0, 0, { ...b, ...at(160, 110) });
  pointer.point("pointermove", 0, 0, { ...a, ...at(120, 105) });
  pointer.point("pointermove", 0, 0, { ...b, ...at(180, 120) });
  pointer.point("pointerup", 0, 0, { ...b, ...at(180, 120) });
  pointer.point("pointerup", 0, 0, { ...a, ...at(120, 105) });
  await settled(element);
  seen.pinched = laid();
  element.zoom = 1;
  await settled(element);

  const { x, y, width, height } = element.bookBounds as DOMRect;
  seen.bounds = rounded([x, y, width, height]);
  const { clientX, clientY } = at(33, 77);
  const point = element.pointAt(clientX, clientY);
  seen.point = rounded([point?.x ?? 0, point?.y ?? 0]);
  element.remove();
  return seen;
}

let upright: Promise<Record<string, unknown>> | null = null;

test.each(transformations)("%s", async (_, around, own) => {
  upright ??= used(new PlacedBook(""));
  const expected = await upright;
  expect(expected).toMatchObject({ selected: "Call me", typed: "Ahab", clicked: 4, dragged: 4 });
  expect(expected.point).toEqual([33, 77]);
  const { wheeled, pinched, ...seen } = await used(new PlacedBook(around, own));
  const { wheeled: wheeledUpright, pinched: pinchedUpright, ...others } = expected;
  expect(seen).toEqual(others);
  // A wheel says where it is in whole pixels of the window, and print lies on those of the screen.
  for (const [places, asUpright] of [
    [wheeled, wheeledUpright],
    [pinched, pinchedUpright],
  ] as number[][][]) {
    for (const [k, place] of places.entries()) {
      // A pixel of the screen is up to two of the element where that is seen smaller.
      expect(Math.abs(place - asUpright[k])).toBeLessThan(2);
    }
  }
});

test("a finger scrolls the page along the book's spine, whichever way that goes, and flicks across it", async () => {
  for (const [around, action, way] of [
    ["", "pan-y", [-60, 0]],
    ["rotate: 90deg", "pan-x", [0, -60]],
    ["rotate: 180deg", "pan-y", [60, 0]],
    ["scale: -1 1", "pan-y", [60, 0]],
  ] as const) {
    const placed = new PlacedBook(around);
    await placed.open(scans(12));
    const { element } = placed;
    const pointer = new TestPointer(element);
    expect(getComputedStyle(pointer.stage).touchAction).toBe(action);
    const { x, y } = placed.seen(200, 110);
    const touch = { pointerType: "touch", pointerId: 7 };
    const at = (k: number) => ({ ...touch, clientX: x + k * way[0], clientY: y + k * way[1] });
    pointer.point("pointerdown", 0, 0, at(0));
    for (const k of [0.25, 0.5, 0.75, 1]) pointer.point("pointermove", 0, 0, at(k));
    pointer.point("pointerup", 0, 0, at(1));
    await clock.pass(20);
    await settled(element);
    expect(element.page).toBe(4);
    element.remove();
  }
});

test("a swipe of a trackpad moves a mirrored book's pages as fingers do, and a wheel reads on", async () => {
  const placed = new PlacedBook("scale: -1 1");
  await placed.open(scans(12));
  const { element } = placed;
  const pointer = new TestPointer(element);
  pointer.roll(-120, 0);
  await clock.pass(20);
  await settled(element);
  expect(element.page).toBe(4);
  pointer.wait(1000);
  pointer.roll(0, 120);
  await clock.pass(20);
  await settled(element);
  expect(element.page).toBe(6);
});
