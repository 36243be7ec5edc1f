/** A book in other people's transformations is as sharp as the screen shows it. */

import { afterEach, expect, test } from "vitest";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

afterEach(() => {
  document.body.replaceChildren();
  document.adoptedStyleSheets = [];
});

test("by any transform and zoom, and anew after each change of them", async () => {
  const around = document.createElement("div");
  const element = book(scans(4));
  document.body.append(around);
  around.append(element);
  await happens(element, "load");
  await settled(element);
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const usual = canvas.width;
  /** Returns how many times as wide the bitmap is as untransformed. */
  const sharpness = async (): Promise<number> => {
    await settled(element);
    return Math.round((100 * canvas.width) / usual) / 100;
  };
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(".large { scale: 2 }");
  document.adoptedStyleSheets = [sheet];
  for (const [style, expected] of [
    ["transform: scale(2)", 2],
    ["zoom: 1.5", 1.5],
    ["transform: rotate(30deg) scale(1.5)", 1.5],
    ["zoom: 2; transform: scale(0.5)", 1],
    ["scale: -1 2", 2],
    ["transform: scale(0.5)", 0.5],
    ["", 1],
  ] as const) {
    around.style.cssText = style;
    await eventually(sharpness).toBe(expected);
  }
  around.className = "large";
  await eventually(sharpness).toBe(2);
  // A rule of the page's own that no attribute shows: it is seen as its transition ends.
  sheet.replaceSync(".large { scale: 1.5 }");
  around.dispatchEvent(new Event("transitionend", { bubbles: true }));
  await eventually(sharpness).toBe(1.5);
  // However large it is, the canvas is bounded.
  around.style.transform = "scale(300)";
  await eventually(async () => (await sharpness()) > 2).toBe(true);
  expect(canvas.width * canvas.height).toBeLessThanOrEqual(16e6);
});
