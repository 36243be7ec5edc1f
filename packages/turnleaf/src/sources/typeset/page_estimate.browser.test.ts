import { expect, test } from "vitest";
import { countOn, holdCounting } from "../../for_tests/held_counting.ts";
import { isLong } from "../../for_tests/long.ts";
import { prose, tinyEpub } from "../epub/tiny_epub.ts";
import { openSource } from "../open.ts";
import type { FlowSection } from "./flow_book.ts";
import type { FlowSource } from "./flow_source.ts";
import { linesIn, SectionLengths } from "./page_estimate.ts";
import { ownTypography } from "./typography.ts";

const never = new AbortController().signal;

/** Returns so many words of some length, always the same. */
const words = (count: number, seed = 0): string =>
  Array.from({ length: count }, (_, k) => "abcdefghij".slice(0, 2 + ((7 * k + 3 * seed) % 8))).join(
    " ",
  );

const times = (count: number, make: (k: number) => string): string =>
  Array.from({ length: count }, (_, k) => make(k)).join("");

const paragraphs = (count: number, length: number): string =>
  times(count, (k) => `<p>${words(length + ((k * 13) % length), k)}.</p>`);

/** Returns how many there are of something in a chapter: chapters are of unequal length. */
const some = (count: number, k: number): number => Math.round(count * (0.5 + 0.35 * (k % 4)));

/** A chapter with a heading. */
const chapter = (k: number, body: string): string => `<h1>Chapter ${k + 1}</h1>${body}`;

const wide = "山路を登りながら、こう考えた。智に働けば角が立つ。".repeat(6);

/** Books of twenty kinds: their chapters and their style. `make test` has every fourth of them. */
const kinds: Readonly<
  Record<string, { readonly css?: string; readonly chapter: (k: number) => string }>
> = {
  "a novel": { chapter: (k) => chapter(k, paragraphs(14 + (k % 5), 60)) },
  "a novel of long paragraphs": { chapter: (k) => chapter(k, paragraphs(some(5, k), 260)) },
  "a play, line by line": { chapter: (k) => chapter(k, paragraphs(some(60, k), 8)) },
  "small type": {
    css: "body { font-size: 0.8em }",
    chapter: (k) => chapter(k, paragraphs(some(20, k), 60)),
  },
  "large type": {
    css: "body { font-size: 1.25em }",
    chapter: (k) => chapter(k, paragraphs(some(12, k), 60)),
  },
  "close lines": {
    css: "p { line-height: 1.15; margin: 0 }",
    chapter: (k) => chapter(k, paragraphs(some(20, k), 60)),
  },
  "wide lines": {
    css: "p { line-height: 2 }",
    chapter: (k) => chapter(k, paragraphs(some(12, k), 60)),
  },
  "indented paragraphs": {
    css: "p { margin: 0; text-indent: 1.5em }",
    chapter: (k) => chapter(k, paragraphs(some(16, k), 50)),
  },
  verse: {
    chapter: (k) =>
      chapter(
        k,
        times(some(16, k), (v) => `<p>${times(6, (l) => `${words(6, l + v)}<br/>`)}</p>`),
      ),
  },
  lists: {
    chapter: (k) =>
      chapter(
        k,
        times(some(6, k), (l) => `<ul>${times(9, (i) => `<li>${words(9, i + l)}</li>`)}</ul>`),
      ),
  },
  "a dictionary": {
    chapter: () =>
      `<dl>${times(40, (d) => `<dt>${words(1, d)}</dt><dd>${words(18, d)}</dd>`)}</dl>`,
  },
  tables: {
    chapter: (k) =>
      chapter(
        k,
        times(
          some(3, k),
          (t) =>
            `<table>${times(14, (r) => `<tr><td>${words(3, r + t)}</td><td>${words(4, r)}</td></tr>`)}</table>`,
        ),
      ),
  },
  "markup without end": {
    chapter: (k) =>
      chapter(
        k,
        times(
          some(16, k),
          (p) =>
            `<p class="a b c d e f">${times(60, (w) => `<span class="word word-${w}" id="w${k}-${p}-${w}">${words(1, w)}</span> `)}</p>`,
        ),
      ),
  },
  Japanese: {
    css: "body { font-family: serif }",
    chapter: (k) =>
      chapter(
        k,
        times(some(9, k), () => `<p>${wide}</p>`),
      ),
  },
  headings: {
    chapter: (k) =>
      chapter(
        k,
        times(some(12, k), (h) => `<h2>Section ${h}</h2>${paragraphs(1, 45)}`),
      ),
  },
  code: {
    chapter: (k) =>
      chapter(
        k,
        times(
          some(6, k),
          (c) => `<p>${words(20, c)}</p><pre>${times(8, (l) => `${words(5, l)}\n`)}</pre>`,
        ),
      ),
  },
  quotations: {
    css: "blockquote { margin: 1em 3em }",
    chapter: (k) =>
      chapter(
        k,
        times(some(10, k), (q) => `<blockquote><p>${words(45, q)}</p></blockquote>`),
      ),
  },
  "wide margins": {
    css: "body > * { margin-left: 4em; margin-right: 4em }",
    chapter: (k) => chapter(k, paragraphs(some(10, k), 60)),
  },
  "short chapters": { chapter: (k) => chapter(k, paragraphs(3 + (k % 3), 60)) },
  "a collection of very unequal parts": {
    chapter: (k) => chapter(k, paragraphs(k % 3 === 0 ? 40 : 4, 50)),
  },
};

test("the first number of pages of many kinds of books is near the last", async () => {
  const off: Record<string, number> = {};
  const sample = Object.entries(kinds).filter((_, k) => isLong || k % 4 === 0);
  for (const [kind, { css = "", chapter }] of sample) {
    const title = '<div style="text-align: center"><h1>Title</h1><p>An author</p></div>';
    const chapters = [title, ...Array.from({ length: 9 }, (_, k) => chapter(k))];
    holdCounting();
    const source = await openSource(tinyEpub({ chapters, css }));
    // What is announced is what is shown.
    source.watchPages?.((change) => change());
    // Before anything of it is set the number is not to be shown.
    expect(source.isGuessed, kind).toBe(true);
    await (source as FlowSource).estimated;
    const first = source.pageCount;
    expect([source.isGuessed, source.isEstimated], kind).toEqual([false, true]);
    countOn();
    await source.settle?.();
    expect(source.isEstimated, kind).toBe(false);
    off[kind] = first / source.pageCount - 1;
    source.close();
  }
  const sorted = Object.values(off)
    .map(Math.abs)
    .sort((a, b) => a - b);
  const median = (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
  expect(median, JSON.stringify(off)).toBeLessThan(0.05);
  expect(sorted.at(-1), JSON.stringify(off)).toBeLessThan(0.3);
});

test("of a book that is alike throughout two pieces are laid out before its first number of pages", async () => {
  const frames = async (chapters: readonly string[]): Promise<number> => {
    let made = 0;
    const watcher = new MutationObserver((changes) => {
      const added = changes.flatMap(({ addedNodes }) => [...addedNodes]);
      made += added.filter((node) => node instanceof HTMLIFrameElement).length;
    });
    watcher.observe(document, { childList: true, subtree: true });
    holdCounting();
    const source = await openSource(tinyEpub({ chapters: [...chapters] }));
    made = 0;
    watcher.takeRecords();
    await (source as FlowSource).estimated;
    await new Promise<void>((resolve) => queueMicrotask(resolve));
    source.close();
    watcher.disconnect();
    return made;
  };
  const alike = Array.from({ length: 17 }, () => prose(16));
  expect(await frames(alike)).toBe(2);
  const unlike = alike.map((text, k) => `<div style="font-size: ${1 + (k % 5)}em">${text}</div>`);
  expect(await frames(unlike)).toBeGreaterThan(2);
});

test("sections are read together, and those that are not read in the order in which they are spread", async () => {
  let [reading, most] = [0, 0];
  const sections = Array.from({ length: 40 }, (_, k) => ({
    length: 100,
    isFixed: false,
    lines: async (): Promise<number> => {
      most = Math.max(most, ++reading);
      await new Promise<void>((resolve) => queueMicrotask(resolve));
      reading -= 1;
      if (k === 7) throw new Error("It cannot be read.");
      return k;
    },
  })) as unknown as FlowSection[];
  const lengths = new SectionLengths(sections);
  await lengths.read(never, 3);
  const known = (): number[] => sections.flatMap((_, k) => lengths.known(k) ?? []);
  expect(known()).toEqual(lengths.spread.slice(0, 3).toSorted((a, b) => a - b));
  await lengths.read(never);
  expect(known()).toEqual(sections.flatMap((_, k) => (k === 7 ? [] : k)));
  expect([most > 3, most < 40]).toEqual([true, true]);
});

test("set in another size a book is estimated by what was set of it before", async () => {
  // Close lines, of which more fit on a page than usual ones, and a first chapter unlike the others.
  const css = "p { line-height: 1.1; margin: 0 } .wide p { line-height: 2.2 }";
  const first = `<div class="wide">${prose(16)}</div>`;
  const chapters = [first, ...Array.from({ length: 11 }, () => prose(20))];
  const source = await openSource(tinyEpub({ chapters, css }));
  source.watchPages?.((change) => change());
  await source.settle?.();
  for (const size of [1.5, 0.8]) {
    holdCounting();
    await source.typeset?.({ ...ownTypography, size });
    expect(source.isEstimated).toBe(true);
    const estimate = source.pageCount;
    countOn();
    await source.settle?.();
    expect(Math.abs(estimate / source.pageCount - 1)).toBeLessThan(0.1);
  }
  source.close();
});

test("the number of pages is estimated once the first pages are drawn", async () => {
  const chapters = Array.from({ length: 12 }, () => prose(16));
  holdCounting();
  const source = await openSource(tinyEpub({ chapters }));
  const announced = new Promise<void>((resolve) => {
    source.watchPages?.((change) => {
      change();
      resolve();
    });
  });
  const drawn = await Promise.all([0, 1].map((index) => source.draw(index, 100, never)));
  for (const picture of drawn) if ("close" in picture) picture.close();
  expect(source.isGuessed).toBe(true);
  await announced;
  expect([source.isGuessed, source.isEstimated]).toEqual([false, true]);
  source.close();
});

test("a page whose number is an estimate has the text that is as far through its chapter", async () => {
  // Pieces of others are laid out first: of those at the eighths of the book.
  const chapters = Array.from({ length: 17 }, (_, k) =>
    k === 5 ? `<div style="font-size: 1.7em">${prose(16)}</div>` : prose(16),
  );
  holdCounting();
  const source = await openSource(tinyEpub({ chapters }));
  source.watchPages?.((change) => change());
  await (source as FlowSource).estimated;
  const found = async (): Promise<[first: number, pages: number]> => {
    const entries = (await source.outline?.(never)) ?? [];
    const [first = 0, next = 0] = entries.slice(5, 7).map(({ page }) => page ?? 0);
    return [first, next - first];
  };
  const [first, estimated] = await found();
  const asked = Math.floor(0.75 * estimated);
  const runs = await source.text?.(first - 1 + asked, never);
  const paragraph = Number(/word(\d+)x/.exec(runs?.[0]?.text ?? "")?.[1]);
  expect(Math.abs(paragraph / 16 - asked / estimated)).toBeLessThan(1.5 / 16);
  countOn();
  await source.settle?.();
  expect((await found())[1]).toBeGreaterThan(2 * estimated);
  source.close();
});

test("lines are counted by paragraphs, without what is not seen", () => {
  expect(linesIn("<p>one</p>\n  <p>two <b>words</b></p>")).toBe(2);
  expect(linesIn(`<p>${"x".repeat(109)}</p>`)).toBe(3);
  expect(linesIn("<head><title>T</title></head><style>p { color: red }</style><p>one</p>")).toBe(1);
  expect(linesIn("<p>&#160;&amp;</p>")).toBe(1);
  expect(linesIn(`<p>${"山".repeat(54)}</p>`)).toBe(2);
  expect(linesIn(`<math><annotation>${"y".repeat(500)}</annotation><mi>x</mi></math>`)).toBe(1);
  // Preformatted text has its own lines, and an empty one among them.
  expect(linesIn("<pre>one\n  two\n\nthree</pre>")).toBe(4);
  // Of a row the highest cell counts, in columns that are equally wide.
  const cells = (...lengths: number[]): string =>
    `<tr>${lengths.map((length) => `<td>${"z".repeat(length)}</td>`).join("")}</tr>`;
  expect(linesIn(`<table>${cells(5, 5, 5)}${cells(50, 10, 40)}</table><p>one</p>`)).toBe(1 + 3 + 1);
  expect(linesIn("<table><tr><td><p>one</p><p>two</p></td><td>three</td></tr></table>")).toBe(2);
  // Markup without an end takes no longer than another.
  expect(linesIn("<head".repeat(100_000))).toBeLessThan(20_000);
});

test("the first estimate holds where a book is set anew while it is made, and lists that are hidden count nothing", async () => {
  const pages = times(300, (k) => `<li><a href="c2.xhtml">${k}</a></li>`);
  const contents = `<ol>${times(40, (k) => `<li>${words(5, k)}</li>`)}</ol><nav hidden="hidden"><ol>${pages}</ol></nav>`;
  expect(linesIn(contents)).toBe(40);
  const book = tinyEpub({ chapters: [contents, prose(200)] });
  const source = (await openSource(new File([book], "hidden.epub"))) as FlowSource;
  holdCounting();
  const { estimated } = source;
  await source.typeset?.({ ...ownTypography, width: 340 });
  await source.findAnchors(["0:0"]);
  await estimated;
  source.watchPages((change) => void change());
  const { pageCount, isGuessed } = source;
  expect(isGuessed).toBe(false);
  countOn();
  await source.settle();
  expect(Math.abs(pageCount / source.pageCount - 1)).toBeLessThan(0.3);
  source.close();
});
