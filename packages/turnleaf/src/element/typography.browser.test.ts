import { expect, test } from "vitest";
import { book, happens } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";
import type { PageSource, TextRun } from "../sources/page_source.ts";

const words = async (element: ReturnType<typeof book>): Promise<string> =>
  ((await element.search("word15x0"))[0]?.page ?? 0).toString();

test("an EPUB is set as the attributes say, and keeps the reader's place when they change", async () => {
  const element = book(tinyEpub({ chapters: [prose(30)] }), { controls: "", duration: "0" });
  await happens(element, "load");
  await eventually(() => element.canTypeset).toBe(true);
  const before = element.pageCount;
  await element.goTo(Number(await words(element)));
  const changed = happens(element, "pageschange");
  element.fontSize = 1.6;
  await changed;
  expect(element.pageCount).toBeGreaterThan(before);
  const page = Number(await words(element));
  expect(Math.abs(page - element.page)).toBeLessThanOrEqual(1);
  expect([element.getAttribute("font-size"), element.font, element.lineHeight]).toEqual([
    "1.6",
    "",
    0,
  ]);
  element.remove();
});

test("the reader chooses in a tab, which other books do not have", async () => {
  const element = book(tinyEpub({ chapters: [prose(4)] }), { controls: "", duration: "0" });
  await happens(element, "load");
  const root = element.shadowRoot as ShadowRoot;
  const tab = (): HTMLButtonElement | null => root.querySelector('.bar [aria-label="Type"]');
  await eventually(() => tab()?.hidden).toBe(false);
  tab()?.click();
  const button = (group: string, name: string): HTMLElement => {
    const all = [...root.querySelectorAll<HTMLElement>(`[aria-label="${group}"] button`)];
    return all.find((one) => (one.ariaLabel ?? one.textContent)?.endsWith(name)) as HTMLElement;
  };
  expect(root.querySelector("select")).toBe(null);
  const sample = root.querySelector(".sample") as HTMLElement;
  const changed = happens(element, "pageschange");
  for (const [group, name] of [
    ["Size", "Larger type"],
    ["Size", "Larger type"],
    ["Typeface", "Atkinson"],
    ["Line spacing", "more"],
    ["Margins", "less"],
    ["Alignment", "Ragged"],
    ["Hyphenation", "On"],
    ["Letter spacing", "more"],
    ["Word spacing", "more"],
  ] as const) {
    button(group, name).click();
  }
  await changed;
  expect([element.fontSize, element.font, element.lineHeight, element.margins]).toEqual([
    1.3,
    "legible",
    1.2,
    0.75,
  ]);
  expect([element.textAlign, element.hyphens]).toEqual(["start", "auto"]);
  expect([element.letterSpacing, element.wordSpacing]).toEqual([0.02, 0.05]);
  await eventually(() => sample.style.fontSize).toBe("20.8px");
  expect(sample.style.fontFamily).toContain("turnleaf-legible");
  await eventually(() => button("Typeface", "Atkinson").ariaChecked).toBe("true");
  // A theme too, by arrows as in any row of which one is chosen.
  const themes = [...root.querySelectorAll<HTMLElement>('[role="radiogroup"] .swatch')].map(
    (swatch) => swatch.parentElement as HTMLElement,
  );
  themes[0]?.focus();
  for (const name of ["keydown", "keyup"]) {
    root.activeElement?.dispatchEvent(
      new KeyboardEvent(name, { key: "ArrowRight", bubbles: true }),
    );
  }
  expect([element.theme, themes.map(({ tabIndex }) => tabIndex)]).toEqual([
    "light",
    [-1, 0, -1, -1, -1],
  ]);
  // By keys too, as far as there are steps.
  for (let k = 0; k < 12; k++) {
    element.dispatchEvent(new KeyboardEvent("keydown", { key: "<", bubbles: true }));
  }
  expect(element.fontSize).toBe(0.7);
  root.querySelector<HTMLElement>(".typeset > .plain")?.click();
  expect(element.font).toBe("");
  const canvas = document.createElement("canvas");
  const loaded = happens(element, "load");
  element.pages = [canvas.toDataURL()];
  await loaded;
  await eventually(() => tab()?.hidden).toBe(true);
  element.remove();
});

test("a remembered book opens with the reader's type, at the text where he was", async () => {
  const chapters = [prose(20), prose(30), prose(20)];
  const open = async (): Promise<ReturnType<typeof book>> => {
    const element = book(tinyEpub({ chapters }), { duration: "0", remember: "", layout: "single" });
    await Promise.all([happens(element, "load"), happens(element, "pageschange")]);
    return element;
  };
  const placesOf = async (element: ReturnType<typeof book>): Promise<number[]> =>
    (await element.search("word15x0")).map(({ page }) => page);
  localStorage.clear();
  const first = await open();
  const changed = happens(first, "pageschange");
  first.fontSize = 1.6;
  await changed;
  await eventually(async () => (await placesOf(first)).length).toBe(3);
  const [, there = 0, later = 0] = await placesOf(first);
  await first.goTo(there);
  first.toggleBookmark(later);
  const { pageCount } = first;
  first.remove();
  const second = await open();
  expect([second.fontSize, second.page]).toEqual([1.6, there]);
  await eventually(() => second.pageCount).toBe(pageCount);
  expect(second.page).toBe(there);
  expect(second.bookmarks).toEqual([later]);
  second.remove();
  localStorage.clear();
});

test("a typeface of the package, spaces and alignment are seen in the lines", async () => {
  const css = "p { text-align: justify; margin: 0 } h2 { text-align: center }";
  const chapters = [`<h2>One</h2>${prose(12)}`];
  const element = book(tinyEpub({ chapters, css }), { duration: "0", layout: "single" });
  element.style.cssText = "width: 500px; height: 700px";
  await happens(element, "load");
  const signal = new AbortController().signal;
  const lines = async (): Promise<readonly TextRun[]> => {
    const { source } = element as unknown as { readonly source: PageSource };
    return (await source.text?.(0, signal)) ?? [];
  };
  // What is counted meanwhile is reported too.
  const set = async (name: string, value: string): Promise<readonly TextRun[]> => {
    const before = JSON.stringify(await lines());
    element.setAttribute(name, value);
    await eventually(async () => JSON.stringify(await lines())).not.toBe(before);
    return await lines();
  };
  const [title, ...own] = await lines();
  const letters = (runs: readonly TextRun[]): number =>
    runs.slice(1, 8).reduce((sum, { text }) => sum + text.length, 0);
  /** Returns how wide a letter of the first line is, on the average. */
  const widthOf = (runs: readonly TextRun[]): number =>
    (runs[1]?.width ?? 0) / (runs[1]?.text.length ?? 1);
  const ends = (runs: readonly TextRun[]): number[] =>
    runs.slice(1, 7).map(({ x, width }) => Math.round(x + width));
  const edge = Math.max(...ends([title as TextRun, ...own]));
  expect(ends([title as TextRun, ...own]).every((end) => edge - end <= 1)).toBe(true);
  expect(ends(await set("text-align", "start")).every((end) => edge - end > 2)).toBe(true);
  expect((await lines())[0]?.x).toBeCloseTo(title?.x ?? 0, 0);
  const sans = widthOf(await set("font", "sans-serif"));
  const legible = widthOf(await set("font", "legible"));
  expect(legible).not.toBe(sans);
  expect(widthOf(await set("font", "dyslexic"))).toBeGreaterThan(1.1 * sans);
  expect(letters(await set("letter-spacing", "0.2"))).toBeLessThan(letters(own));
  element.remove();
});
