import { expect, test } from "vitest";
import { prose, tinyEpub } from "../epub/tiny_epub.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";
import { divide } from "./divide.ts";

const never = new AbortController().signal;

/** Returns the root of a chapter with a body. */
function chapter(body: string): Element {
  return new DOMParser().parseFromString(body, "text/html").documentElement;
}

const letters = (count: number): string => "letters ".repeat(count / 8);
const textOf = (roots: readonly Element[]): string =>
  roots.map(({ textContent }) => textContent).join("");

test("a chapter of usual length is one piece, as it is", () => {
  const root = chapter(`<p>${letters(100_000)}</p>`);
  expect(divide(root)).toEqual([root]);
});

test("a long chapter is divided into bounded pieces that have all of it, in order", () => {
  const bodies = [
    `<section><h1>One</h1>${prose(2000)}</section>`,
    `<p>${"<i>a</i> ".repeat(50_000)}</p>`,
    `<div><pre>${letters(1_000_000)}</pre></div>`,
    `<p>${"\u{1f600}".repeat(300_000)}</p>`,
    `<ul>${"<li>a</li>".repeat(20_000)}</ul>`,
  ];
  for (const body of bodies) {
    const root = chapter(body);
    const pieces = divide(root);
    expect(pieces.length).toBeGreaterThan(2);
    expect(textOf(pieces)).toBe(root.textContent);
    for (const piece of pieces) {
      const text = piece.textContent ?? "";
      expect(text.length + 50 * piece.querySelectorAll("*").length).toBeLessThan(201_000);
      expect(text).not.toMatch(/^[\udc00-\udfff]/);
    }
  }
});

test("a piece goes on as the chapter would: its containers, its numbers, and what is before it", () => {
  const items = Array.from({ length: 9000 }, (_, k) => `<li id="i${k}">a</li>`).join("");
  const [, second] = divide(chapter(`<div id="d" class="x"><ol start="5">${items}</ol></div>`));
  const list = second?.querySelector(".x > ol");
  const [before, next] = list?.children ?? [];
  expect(second?.querySelector("#d")).toBe(null);
  expect(before?.textContent).toBe("");
  const number = Number(next?.id.slice(1));
  expect(list?.getAttribute("start")).toBe(String(number + 5));
});

test("a piece ends before a heading rather than after it", () => {
  const pieces = divide(chapter(`<h2>Part</h2><p>${letters(120_000)}</p>`.repeat(4)));
  expect(pieces.map((piece) => piece.querySelectorAll("h2").length)).toEqual([1, 1, 1, 1]);
});

/** Returns the text of a page. */
const textOn = async (source: PageSource, index: number): Promise<string> =>
  ((await source.text?.(index, never)) ?? []).map(({ text }) => text).join("");

test("the pages of a long chapter have its text, its links and its places", async () => {
  const frames = document.getElementsByTagName("iframe");
  const before = frames.length;
  const end = '<p id="end">The end. <a href="#p0">Back.</a></p>';
  const source = await openSource(
    tinyEpub({ chapters: [`<p><a href="#end">On.</a></p>${prose(1500)}${end}`] }),
  );
  await new Promise<void>((resolve) =>
    source.watchPages?.((change) => {
      change();
      resolve();
    }),
  );
  const last = source.pageCount - 1;
  expect(await textOn(source, 0)).toContain("word0x0");
  const middle = await textOn(source, last >> 1);
  expect(middle).toMatch(/word\d+x\d+/);
  expect(await textOn(source, last)).toContain("The end.");
  const [on] = (await source.links?.(0, never)) ?? [];
  expect(on?.to).toEqual({ page: last + 1 });
  const [back] = (await source.links?.(last, never)) ?? [];
  expect(back?.to).toEqual({ page: 1 });
  const anchor = source.anchor?.(last) ?? "";
  expect(await source.findAnchors?.([anchor])).toEqual([last]);
  const picture = await source.draw(last >> 1, 60, never);
  if ("close" in picture) picture.close();
  // No more frames are kept than are read.
  expect(frames.length - before).toBeLessThan(4);
  source.close();
  await Promise.resolve();
  expect(frames.length).toBe(before);
});
