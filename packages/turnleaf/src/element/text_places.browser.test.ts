import { afterEach, describe, expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { countOn, holdCounting } from "../for_tests/held_counting.ts";
import { isLong } from "../for_tests/long.ts";
import { fuzz, Random } from "../for_tests/random_numbers.ts";
import { spansOf } from "../for_tests/text_books.ts";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";
import { tinyFb2 } from "../sources/fb2/tiny_fb2.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";

/** A book of six chapters of unequal length and kind, whose estimates are wrong. */
const chapters = Array.from({ length: 6 }, (_, k) =>
  prose(3 + ((5 * k) % 7))
    .replaceAll("word", `w${k}c`)
    .replaceAll('<p id="', k % 2 === 0 ? '<p style="font-size: 1.3em" id="' : '<p id="'),
);
const epub = () => new File([tinyEpub({ chapters })], "places.epub");

const shown: TurnleafBook[] = [];

async function open(
  attributes: Record<string, string> = {},
  pages: TurnleafBook["pages"] = epub(),
): Promise<TurnleafBook> {
  const element = book(null, { duration: "0", cover: "none", ...attributes });
  element.style.cssText = "position: fixed; left: 0; top: 0; width: 700px; height: 480px";
  shown.push(element);
  const loaded = happens(element, "load");
  element.pages = pages;
  await loaded;
  return element;
}

const counted = (element: TurnleafBook): Promise<void> => clock.until(() => !element.estimated);

/** Returns the first word of the first open page. */
async function headOf(element: TurnleafBook): Promise<string> {
  await settled(element);
  let head = "";
  await eventually(() => {
    head = spansOf(element)[0]?.textContent?.trim().split(" ")[0] ?? "";
    return head;
  }).not.toBe("");
  return head;
}

afterEach(() => {
  for (const element of shown.splice(0)) element.remove();
  localStorage.clear();
  history.replaceState(null, "", location.pathname + location.search);
});

describe("the place of a reader in flowing text", () => {
  const plain = chapters.map((chapter) => chapter.replace(/<[^>]*>/g, "\n\n"));
  const sections = plain.map((chapter) => `<section><p>${chapter}</p></section>`).join("");
  const books: readonly (readonly [string, () => TurnleafBook["pages"]])[] = [
    ["an EPUB", epub],
    ["a text", () => new File([plain.join("\n\n")], "places.txt")],
    ["a FictionBook", () => new File([tinyFb2(sections)], "places.fb2")],
    ["a PDF", () => new File([tinyPdf({ pages: Array(20).fill("") })], "places.pdf")],
    ["a comic", () => scans(16)],
  ];

  test.each(books.map((book, index) => [...book, index] as const))(
    "is that of the same word however %s is loaded again, while pages are counted too",
    async (_name, pages, index) => {
      const random = new Random();
      const head = (element: TurnleafBook): Promise<string | number> =>
        element.canTypeset ? headOf(element) : settled(element).then(() => element.page);
      // Of half of the books all pages are counted first, and of each in turn where samples are long.
      for (let round = index; round < index + (isLong ? 2 : 1) * fuzz; round++) {
        const first = await open({ remember: "", address: "" }, pages());
        if (round % 2 === 0) await counted(first);
        await first.goTo(2 + random.below(first.pageCount - 2));
        const expected = await head(first);
        let address = location.hash;
        let { page } = first;
        first.remove();
        for (const [k, how] of [
          "the address",
          "what is remembered",
          "the page's number",
        ].entries()) {
          const asked = { "the address": address, "the page's number": `#page=${page}` }[how] ?? "";
          history.replaceState(null, "", location.pathname + location.search + asked);
          // Half of them while pages are counted.
          if ((round + k) % 2 > 0) holdCounting();
          const again = await open({ remember: "", address: "" }, pages());
          expect(await head(again), `by ${how}`).toBe(expected);
          countOn();
          await counted(again);
          expect(await head(again), `counted, by ${how}`).toBe(expected);
          if (location.hash !== "") address = location.hash;
          page = again.page;
          again.remove();
        }
      }
    },
    120_000 * fuzz,
  );

  test("is that of the same page after a reload in a window that was made larger by less than text is set anew for", async () => {
    const first = await open({ remember: "" });
    await counted(first);
    await settled(first);
    const { pageCount } = first;
    // By 3 %: the page has another line, as its text is set from the beginning for it.
    first.style.height = "494px";
    await clock.pass(500);
    await first.goTo(14);
    const head = await headOf(first);
    expect(first.pageCount).toBe(pageCount);
    first.remove();
    const again = book(null, { duration: "0", cover: "none", remember: "" });
    again.style.cssText = first.style.cssText;
    shown.push(again);
    const loaded = happens(again, "load");
    again.pages = epub();
    await loaded;
    await counted(again);
    expect(await headOf(again)).toBe(head);
    expect(again.pageCount).toBe(pageCount);
  });

  test("has the number of pages that was counted before from the beginning, unless text is set otherwise", async () => {
    const first = await open({ remember: "" });
    await counted(first);
    await first.goTo(9);
    const { pageCount } = first;
    first.remove();
    holdCounting();
    // Left while its pages are counted again, it keeps what it knew.
    for (let visit = 0; visit < 2; visit++) {
      const again = await open({ remember: "" });
      expect([again.pageCount, again.guessed, again.estimated]).toEqual([pageCount, false, true]);
      again.remove();
    }
    countOn();
    const last = await open({ remember: "" });
    const changes: number[] = [];
    last.addEventListener("pageschange", (event) => changes.push(event.detail.pageCount));
    await counted(last);
    expect(new Set([pageCount, ...changes])).toEqual(new Set([pageCount]));
    last.remove();
    holdCounting();
    const larger = await open({ remember: "", "font-size": "1.5" });
    expect(larger.guessed).toBe(true);
  });

  test("keeps its side and its words while what is before it is counted; its address is renewed", async () => {
    holdCounting();
    const element = await open({ address: "" });
    for (const page of [14, 21]) {
      await element.goTo(page);
      const head = await headOf(element);
      const isLeft = (): boolean => element.spread.left === element.page;
      const was = isLeft();
      for (let chapter = 0; chapter < 2; chapter++) {
        countOn(1);
        await clock.pass(100);
        expect(await headOf(element)).toBe(head);
        expect(isLeft()).toBe(was);
      }
    }
    const head = await headOf(element);
    countOn();
    await counted(element);
    expect(await headOf(element)).toBe(head);
    expect(location.hash).toMatch(new RegExp(`^#page=${element.page}&at=`));
  });

  test("is as far through the book as the number that was typed, while that is an estimate", async () => {
    holdCounting();
    const element = await open();
    const asked = Math.round(0.6 * element.pageCount);
    await element.goTo(asked);
    const chapterOf = async (): Promise<number> =>
      Number(/w(\d)c/.exec(await headOf(element))?.[1]);
    const chapter = await chapterOf();
    expect(Math.abs(chapter - 0.6 * 6)).toBeLessThan(2);
    const head = await headOf(element);
    countOn();
    await counted(element);
    expect(await headOf(element)).toBe(head);
  });
});

test("a jump is a step in the history, and leads back until one reads on", async () => {
  const element = await open({ address: "", controls: "" });
  await counted(element);
  const back = () => element.shadowRoot?.querySelector<HTMLButtonElement>(".return");
  await eventually(back).toBeTruthy();
  await element.goTo(5);
  const { page } = element;
  const head = await headOf(element);
  const steps = history.length;
  await element.showHit((await element.search("w4c2x3"))[0] ?? null);
  const there = element.page;
  expect(there).toBeGreaterThan(page + 4);
  expect(history.length).toBe(steps + 1);
  expect([back()?.hidden, back()?.textContent]).toEqual([false, `Back to page ${page}`]);
  history.back();
  await eventually(() => element.page).toBe(page);
  expect(await headOf(element)).toBe(head);
  expect(back()?.hidden).toBe(true);
  history.forward();
  await eventually(() => element.page).toBe(there);
  const [hit] = await element.search("w1c0x0");
  await element.showHit(hit ?? null);
  expect(back()?.hidden).toBe(false);
  back()?.click();
  await eventually(() => element.page).toBe(there);
  expect(back()?.hidden).toBe(true);
  await element.showHit(hit ?? null);
  await element.next();
  expect(back()?.hidden).toBe(true);
});

test("the browser's Back calls off a jump that is under way", async () => {
  const element = await open({ address: "", controls: "", duration: "400" });
  await counted(element);
  await element.goTo(5);
  const { page } = element;
  const [hit] = await element.search("w4c2x3");
  const shown = element.showHit(hit ?? null);
  await eventually(() => element.state).toBe("turning");
  history.back();
  await shown;
  await eventually(() => element.settled).toBe(true);
  expect(element.page).toBe(page);
  expect(element.jumpedFrom).toBe(null);
  await element.next();
  expect(element.jumpedFrom).toBe(null);
});

/** Opens a tab of the panel, by its name: where there is no button for it in the bar, by the panel's own. */
function openTab(root: ShadowRoot, name: string): void {
  const buttons = () =>
    [...root.querySelectorAll<HTMLElement>("button[aria-label]")].filter((button) =>
      button.checkVisibility(),
    );
  const press = (name: string) => buttons().find(({ ariaLabel }) => ariaLabel === name);
  if (!press(name)) press("Contents")?.click();
  press(name)?.click();
}

test.each([
  { width: 1280, height: 800, beside: true },
  { width: 1920, height: 1080, beside: true },
  { width: 1024, height: 768, beside: true },
  // Beside the panel its page would be too small.
  { width: 820, height: 1180, beside: false },
  { width: 844, height: 390, beside: false },
  { width: 390, height: 844, beside: false },
])(
  "a panel changes no page of a book in $width × $height, nor does its end",
  async ({ width, height, beside }) => {
    const element = await open({ controls: "" });
    element.style.cssText += `; width: ${width}px; height: ${height}px`;
    const root = element.shadowRoot as ShadowRoot;
    const part = (selector: string) => root.querySelector<HTMLElement>(selector);
    await eventually(() => part(".bar")).not.toBeNull();
    await clock.pass(1000);
    await counted(element);
    await element.goTo(5);
    const head = await headOf(element);
    const pages = () => [element.pageCount, element.page, element.shownLayout];
    const before = pages();
    const room = part("[part=stage]")?.clientWidth ?? 0;
    for (const tab of ["Search", "Contents"]) {
      openTab(root, tab);
      await clock.pass(1000);
      await counted(element);
      const panel = part("[part=panel]")?.getBoundingClientRect() ?? new DOMRect();
      expect(panel.width).toBeGreaterThan(0);
      expect(pages(), tab).toEqual(before);
      expect(await headOf(element)).toBe(head);
      const stage = part("[part=stage]")?.clientWidth ?? 0;
      expect(stage).toBe(beside ? room - panel.width : room);
      // Nothing of it lies under the panel.
      if (beside) {
        expect(element.bookBounds?.left).toBeGreaterThanOrEqual(panel.right);
        expect(element.bookBounds?.right).toBeLessThanOrEqual(width);
      }
    }
    part("[part=panel] [aria-label=Close]")?.click();
    await clock.pass(1000);
    await counted(element);
    expect(pages()).toEqual(before);
    expect(await headOf(element)).toBe(head);
  },
);

test("a search finds the same while pages are counted, wherever they are, and its places stay", async () => {
  const queries = ["w3c1x5", "x59", "w5c3x1 w5c3x2"];
  const placesIn = async (element: TurnleafBook, query: string): Promise<string[]> =>
    (await element.search(query)).map(({ before, text, after }) => before + text + after);
  // As large as the others: lines are broken by the size of the page.
  const first = await open({ controls: "" });
  await counted(first);
  const expected = [];
  for (const query of queries) expected.push(await placesIn(first, query));
  expect(expected.map(({ length }) => length)).toEqual([11, 37, 1]);
  first.remove();
  // In seconds after opening, and how many chapters are counted by then.
  const starts = [
    [0, 0],
    [0.5, 1],
    [2, 3],
    [10, chapters.length],
  ] as const;
  for (const [seconds, laid] of starts) {
    holdCounting();
    const element = await open({ controls: "" });
    countOn(laid);
    await clock.pass(1000 * seconds);
    const streamed: number[] = [];
    const hits = element.search("x59", {
      onHits: (found) => streamed.push(...found.map(({ page }) => page)),
    });
    const others = queries
      .filter((query) => query !== "x59")
      .map((query) => placesIn(element, query));
    countOn();
    await counted(element);
    expect(await Promise.all(others), `after ${seconds} s`).toEqual([expected[0], expected[2]]);
    expect((await hits).length).toBe(37);
    expect(streamed.length).toBe(37);
    // They say where their text is now.
    for (const hit of [(await hits)[0], (await hits).at(-1)]) {
      await element.showHit(hit ?? null);
      const { left, right } = element.spread;
      expect([left, right]).toContain(hit?.page);
    }
    element.remove();
  }
});
