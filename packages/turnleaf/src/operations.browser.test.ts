/**
 * Any sequence of operations on a book: at rest each visible page is shown, and
 * WebGL reports no error.
 */

import { afterEach, expect, test } from "vitest";
import { commands } from "vitest/browser";
import type { TurnleafBook } from "./element.ts";
import { book, happens, keepWhatIsDrawn, settled } from "./element_for_tests.ts";

keepWhatIsDrawn();

afterEach(() => document.body.replaceChildren());

/** Degrees of hue between consecutive pages: no two visible ones are alike. */
const hueStep = 67;

const pictures = new Map<string, { src: string }>();

/**
 * Returns a page of one hue; every fifth has other proportions, so that it is
 * fitted to its leaf.
 */
function plainPage(hue: number, number: number): { src: string } {
  const isWide = number % 5 === 3;
  const key = `${hue} ${isWide}`;
  const known = pictures.get(key);
  if (known) return known;
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = isWide ? [120, 120] : [90, 120];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = `hsl(${hue} 100% 50%)`;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  const page = { src: canvas.toDataURL("image/png") };
  pictures.set(key, page);
  return page;
}

/** Returns a generator of numbers from 0 to 1, the same for the same seed. */
function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Returns the fraction of pixels by hue in steps of 10 degrees, of all pixels that have one. */
function hues(element: TurnleafBook): number[] {
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const small = document.createElement("canvas");
  [small.width, small.height] = [120, 90];
  const pen = small.getContext("2d", { willReadFrequently: true }) as CanvasRenderingContext2D;
  pen.drawImage(canvas, 0, 0, 120, 90);
  const { data } = pen.getImageData(0, 0, 120, 90);
  const counts = Array.from({ length: 36 }, () => 0);
  for (let k = 0; k < data.length; k += 4) {
    const [r, g, b] = data.subarray(k, k + 3);
    const [most, least] = [Math.max(r, g, b), Math.min(r, g, b)];
    if (most < 60 || (most - least) / most < 0.7) continue;
    const part =
      most === r
        ? (g - b) / (most - least)
        : most === g
          ? 2 + (b - r) / (most - least)
          : 4 + (r - g) / (most - least);
    counts[Math.floor((60 * part + 360 + 5) / 10) % 36] += 1 / (120 * 90);
  }
  return counts;
}

/** Returns the fraction of pixels near a hue. */
function shareOf(counts: readonly number[], hue: number): number {
  const middle = Math.floor((hue + 5) / 10);
  return [-1, 0, 1].reduce((sum, by) => sum + counts[(middle + by + 36) % 36], 0);
}

test("at rest every page in sight is seen, whatever was asked before", {
  timeout: 1_000_000,
}, async () => {
  const seed = Number(import.meta.env.VITE_SEED ?? 1);
  const count = Number(import.meta.env.VITE_OPERATIONS ?? 40);
  const random = randomNumbers(seed);
  const among = <T>(values: readonly T[]): T => values[Math.floor(random() * values.length)];
  const whole = (least: number, most: number): number =>
    least + Math.floor(random() * (most - least + 1));
  let made = 0;
  const fresh = (): number => (made++ * hueStep) % 360;
  const make = (hues: readonly number[]) => hues.map((hue) => plainPage(hue, hue));
  let pages = Array.from({ length: 40 }, fresh);
  let given = [...pages];
  const element = book(make(pages), { duration: "60", cloth: "#222222", cover: "hard" });
  await happens(element, "load");
  const attribute = (name: string, values: readonly string[]) => () =>
    element.setAttribute(name, among(values));
  const operations: Readonly<Record<string, () => unknown>> = {
    goTo: () => void element.goTo(whole(1, pages.length)),
    next: () => void element.next(),
    previous: () => void element.previous(),
    many: () => Array.from({ length: whole(2, 30) }, () => element.next()),
    insert: async () => {
      const [at, added] = [whole(1, pages.length + 1), Array.from({ length: whole(1, 3) }, fresh)];
      if (await element.insertPages(at, make(added))) pages.splice(at - 1, 0, ...added);
    },
    remove: async () => {
      if (pages.length < 20) return;
      const at = whole(1, pages.length - 3);
      if (await element.removePages(at, 2)) pages.splice(at - 1, 2);
    },
    replace: async () => {
      const [at, added] = [whole(1, pages.length), [fresh()]];
      if (await element.replacePage(at, make(added))) pages.splice(at - 1, 1, ...added);
    },
    other: async () => {
      pages = Array.from({ length: whole(4, 60) }, fresh);
      given = [...pages];
      const loaded = happens(element, "load");
      element.pages = make(pages);
      if (random() < 0.8) await loaded;
    },
    nothing: async () => {
      element.style.width = element.style.height = among(["0px", "1px", "3px"]);
      await new Promise((resolve) => setTimeout(resolve, 60 * random()));
      element.style.cssText = "width: 300px; height: 220px";
    },
    narrow: () => {
      element.style.width = among(["120px", "200px", "300px"]);
    },
    hide: async () => {
      element.style.display = "none";
      await new Promise((resolve) => setTimeout(resolve, 60 * random()));
      element.style.display = "";
    },
    cover: attribute("cover", ["hard", "soft", "none"]),
    binding: attribute("binding", ["left", "right", "top", "bottom"]),
    layout: attribute("layout", ["spread", "single", "auto"]),
    offset: attribute("offset", ["0", "1"]),
    hardPages: attribute("hard-pages", ["", "3-4", "1-8", "9"]),
    duration: attribute("duration", ["0", "60", "300"]),
    stock: attribute("stock", ["bible", "book", "card"]),
    model: attribute("model", ["sheet", "cylinder", "peel", "sheet"]),
    zoom: () => element.zoomTo(among([1, 2.5, 6])),
    away: async () => {
      const loaded = happens(element, "load");
      element.remove();
      await new Promise((resolve) => setTimeout(resolve, 30 * random()));
      document.body.append(element);
      await loaded;
      // It opens the pages that were set.
      pages = [...given];
    },
  };
  const done: string[] = [];
  for (let k = 0; k < count; k++) {
    const name = among(Object.keys(operations));
    done.push(name);
    await operations[name]();
    if (random() < 0.5) await new Promise((resolve) => setTimeout(resolve, 120 * random()));
    if (random() < 0.65) continue;
    element.zoomTo(1);
    await expect.poll(() => element.pageCount, { timeout: 20_000 }).toBe(pages.length);
    await settled(element);
    await expect.poll(() => element.turning, { timeout: 20_000 }).toBe(false);
    await settled(element);
    const counts = hues(element);
    const { left, right } = element.spread;
    for (const page of [left, right]) {
      if (page === null) continue;
      const share = shareOf(counts, pages[page - 1]);
      const told = `seed ${seed}, after ${done.slice(-8).join(", ")}: page ${page} of ${pages.length}, ${element.outerHTML}`;
      expect(share, told).toBeGreaterThan(0.02);
    }
    expect(await commands.webglComplaints(), `seed ${seed}, after ${done.slice(-8)}`).toEqual([]);
  }
});
