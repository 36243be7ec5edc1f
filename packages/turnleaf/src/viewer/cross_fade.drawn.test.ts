/**
 * Readers who prefer reduced motion: a fade in place of the turn, in WebGL and
 * on the 2D canvas.
 */

import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import type { TurnDetail } from "../element/events.ts";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, drawRoughly, happens, settled } from "../for_tests/element_books.ts";

drawRoughly();

const realMedia = globalThis.matchMedia;
const realContext = HTMLCanvasElement.prototype.getContext;
let isCalm = true;

/** Returns a page of one colour. */
function plainPage(colour: string): { src: string } {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [90, 120];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = colour;
  pen.fillRect(0, 0, 90, 120);
  return { src: canvas.toDataURL("image/png") };
}

/** Pages 2 and 3 red, 4 and 5 blue, and so on. */
const pages = () => Array.from({ length: 12 }, (_, k) => plainPage((k + 1) & 2 ? "#f00" : "#00f"));

const canvases = (element: TurnleafBook) =>
  [...(element.shadowRoot?.querySelectorAll("canvas") ?? [])].filter(({ width }) => width > 0);

/** Returns red and blue in the middle of the page on the right, as mixed. */
function seen(element: TurnleafBook): { red: number; blue: number } | null {
  const mix = canvases(element).find((canvas) => canvas.ariaHidden === "true");
  if (!mix) return null;
  const pen = mix.getContext("2d") as CanvasRenderingContext2D;
  const { width, height } = mix;
  const [red, , blue] = pen.getImageData(width * 0.65, height / 2, 1, 1).data;
  return { red, blue };
}

beforeEach(() => {
  isCalm = true;
  globalThis.matchMedia = (query) =>
    query.includes("reduced-motion") ? ({ matches: isCalm } as MediaQueryList) : realMedia(query);
});

afterEach(() => {
  vi.restoreAllMocks();
  globalThis.matchMedia = realMedia;
  HTMLCanvasElement.prototype.getContext = realContext;
  document.body.replaceChildren();
});

describe.each([
  ["in space", true],
  ["on the flat", false],
])("%s", (_, hasWebGL) => {
  beforeEach(() => {
    if (hasWebGL) return;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...a: unknown[]) {
      return a[0] === "webgl2" ? null : Reflect.apply(realContext, this, a);
    } as typeof realContext;
  });

  test("one spread fades into the other, and then nothing is left of it", async () => {
    const element = book(pages(), { page: "2", cover: "none", layout: "spread" });
    await happens(element, "load");
    await settled(element);
    const heard: string[] = [];
    for (const name of ["turnstart", "pagechange"] as const) {
      element.addEventListener(name, (event) => {
        const { from, to, direction } = (event as CustomEvent<TurnDetail>).detail;
        heard.push(`${name} ${from} ${to} ${direction}`);
      });
    }
    const mixed: { red: number; blue: number }[] = [];
    clock.hold();
    const turned = element.next().then((landed) => heard.push(`landed ${landed}`));
    expect(heard).toEqual(["turnstart 2 4 forward"]);
    expect(element.page).toBe(4);
    while (canvases(element).length > 1) {
      clock.frames(1);
      const colours = seen(element);
      if (colours) mixed.push(colours);
    }
    await turned;
    expect(heard).toEqual(["turnstart 2 4 forward", "pagechange 2 4 forward", "landed true"]);
    // It starts at the old picture and grows into the new one.
    expect(mixed.length).toBeGreaterThan(10);
    expect(mixed[0].red).toBeGreaterThan(150);
    for (const [k, { red, blue }] of mixed.entries()) {
      if (k === 0) continue;
      expect(red).toBeLessThanOrEqual(mixed[k - 1].red + 3);
      expect(blue).toBeGreaterThanOrEqual(mixed[k - 1].blue - 3);
    }
    await clock.until(() => element.settled);
    expect(canvases(element).map(({ style }) => style.opacity)).toEqual([""]);
  });

  test("fades that follow each other are one change, and keep what they promised", async () => {
    const element = book(pages(), { page: "2", cover: "none", layout: "spread" });
    await happens(element, "load");
    await settled(element);
    const changes: TurnDetail[] = [];
    element.addEventListener("pagechange", (event) => {
      changes.push((event as CustomEvent<TurnDetail>).detail);
    });
    const turns = [element.next(), element.next(), element.goTo(9), element.previous()];
    expect(await Promise.all(turns)).toEqual([true, true, false, true]);
    expect(element.page).toBe(6);
    expect(changes).toEqual([{ from: 2, to: 6, direction: "forward" }]);
    // At the end of the book there is nothing to fade to.
    expect(await element.goTo(12)).toBe(true);
    expect(await element.next()).toBe(false);
    expect(element.page).toBe(12);
  });

  test("what the reader asks the system for counts at once, also in mid-turn", async () => {
    isCalm = false;
    const element = book(pages(), { page: "2", cover: "none", layout: "spread", duration: "400" });
    await happens(element, "load");
    await settled(element);
    const turned = element.next();
    await happens(element, "turnstart");
    expect(canvases(element).length).toBe(1);
    isCalm = true;
    const faded = element.goTo(9);
    expect(canvases(element).length).toBe(2);
    expect(await faded).toBe(true);
    // The book lies farther on than the turn went.
    expect(await turned).toBe(true);
    isCalm = false;
    expect(await element.previous()).toBe(true);
    expect(element.page).toBe(6);
  });

  test("a book taken away in mid-fade keeps nobody waiting and nothing running", async () => {
    const element = book(pages(), { page: "2", cover: "none", layout: "spread" });
    await happens(element, "load");
    await settled(element);
    const turned = element.next();
    element.remove();
    expect(await turned).toBe(false);
    expect(canvases(element)).toEqual([]);
    document.body.append(element);
    await happens(element, "load");
    element.addEventListener("turnstart", () => element.remove());
    expect(await element.next()).toBe(false);
  });
});
