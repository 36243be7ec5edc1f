/** The element's size if its page gives it none, and its message if it has no book. */

import { afterEach, expect, test } from "vitest";
import "../index.ts";
import type { TurnleafBook } from "../element.ts";
import { happens, scan, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { toolSession } from "../for_tests/real_mouse.ts";

afterEach(() => document.body.replaceChildren());

/**
 * Shows an element in a box, both styled as a page may; its pages are so many
 * pixels wide and high.
 */
async function shown(
  box: string,
  style = "",
  [width, height]: readonly [number, number] = [90, 135],
  attributes: Record<string, string> = {},
): Promise<DOMRect> {
  const outside = document.createElement("div");
  outside.style.cssText = box;
  const element = document.createElement("turnleaf-book") as TurnleafBook;
  element.style.cssText = style;
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.pages = Array.from({ length: 6 }, (_, k) => ({ src: scan(k, width, height) }));
  outside.append(element);
  document.body.append(outside);
  await happens(element, "load");
  return element.getBoundingClientRect();
}

test("without a height it is as high as two of the book's pages ask for", async () => {
  const upright = await shown("width: 480px");
  expect([upright.width, upright.height]).toEqual([480, 360]);
  const wide = await shown("width: 480px", "", [160, 90]);
  expect(wide.height).toBe(192);
  const calendar = await shown("width: 400px", "", [120, 80], { binding: "top" });
  expect(calendar.width / calendar.height).toBeLessThan(0.9);
  // No higher than the window.
  const large = await shown("width: 1000px");
  expect(large.height).toBeLessThanOrEqual(innerHeight);
});

test("in a flex row it has a width, and in a grid", async () => {
  expect((await shown("display: flex; width: 700px")).width).toBe(320);
  // Two pages of 200 pixels, and as much of larger ones as there is room for.
  const row = "display: flex; width: 700px";
  expect((await shown(row, "", [200, 300])).width).toBe(400);
  expect((await shown(row, "", [900, 1350])).width).toBe(700);
  expect((await shown(row, "", [500, 300], { binding: "top" })).width).toBe(500);
  expect((await shown("width: 700px; float: left", "float: left", [200, 300])).width).toBe(400);
  expect((await shown("display: flex; width: 700px", "flex: 1")).width).toBe(700);
  expect((await shown("display: grid; width: 700px")).width).toBe(700);
});

test.each([
  { style: "height: 300px", width: 500, height: 300 },
  { style: "width: 150px; height: 200px", width: 150, height: 200 },
  { style: "position: absolute; inset: 0", width: 500, height: 440 },
  { style: "width: 200px; aspect-ratio: 1", width: 200, height: 200 },
])("its page's CSS goes before: $style", async ({ style, width, height }) => {
  const box = await shown("position: relative; width: 500px; height: 440px", style);
  expect([box.width, box.height]).toEqual([width, height]);
});

test("given no book it says what to give it, until it is given one", async () => {
  const element = document.createElement("turnleaf-book") as TurnleafBook;
  document.body.append(element);
  const message = element.shadowRoot?.querySelector<HTMLElement>("[part=message]");
  expect(message?.textContent).toBe("There is no book here yet: give the element a src, or pages.");
  expect(message?.checkVisibility()).toBe(true);
  const loaded = happens(element, "load");
  element.pages = [{ src: scan(1) }];
  await loaded;
  expect(message?.hidden).toBe(true);
});

test("by night the web page's own print has ink on light paper, before its pages are drawn by day too", async () => {
  await shown("width: 700px", "height: 500px", [90, 135], { theme: "night" });
  const element = document.querySelector("turnleaf-book") as TurnleafBook;
  const stage = element.shadowRoot?.querySelector("[part=stage]") as HTMLElement;
  const printed = (attributes: Record<string, string>): string => {
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    window.dispatchEvent(new Event("beforeprint"));
    return stage.style.getPropertyValue("--printed");
  };
  expect(printed({})).toBe("brightness(1.25)");
  expect(printed({ "dark-pages": "invert" })).toMatch(/^invert/);
  expect(getComputedStyle(stage).filter).toBe("none");
  expect(printed({ theme: "light" })).toBe("none");
});

test("the web page's own print has the open spread as it is seen, and no bars", async () => {
  await shown("width: 700px", "height: 500px", [90, 135], { controls: "" });
  const element = document.querySelector("turnleaf-book") as TurnleafBook;
  const root = element.shadowRoot as ShadowRoot;
  const stage = root.querySelector("[part=stage]") as HTMLElement;
  await eventually(() => root.querySelector(".bar")).not.toBeNull();
  await settled(element);
  const { width, height } = stage.getBoundingClientRect();
  expect([width, height]).toEqual([700, 400]);
  await toolSession().send("Emulation.setEmulatedMedia", { media: "print" });
  // As wide as a sheet of paper.
  element.style.cssText = "width: 350px; height: 500px";
  const [printed, page] = [stage, element].map((at) => at.getBoundingClientRect());
  const bars = [...root.querySelectorAll(".bar, .pages")].map((bar) => bar.checkVisibility());
  const drawn = [stage.clientWidth, stage.clientHeight];
  await toolSession().send("Emulation.setEmulatedMedia", { media: "" });
  expect(bars).toEqual([false, false]);
  expect(drawn).toEqual([700, 400]);
  expect([printed.width, printed.height]).toEqual([350, 200]);
  expect(printed.left).toBe(page.left);
  expect(printed.top - page.top).toBe(150);
});
