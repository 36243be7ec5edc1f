/** No text that a book puts somewhere lies upon the text that it flows around. */

import { expect, test } from "vitest";
import { closeBooks, laidOut, pagesOf } from "../../for_tests/laid_out_books.ts";
import { prose, tinyEpub } from "../epub/tiny_epub.ts";
import type { PageSource, TextRun } from "../page_source.ts";

const never = new AbortController().signal;

closeBooks();

/** Returns the lines of a page that lie upon others, by most of their height. */
function covered(runs: readonly TextRun[]): string[] {
  return runs
    .filter((run) =>
      runs.some((other) => {
        const across =
          Math.min(run.x + run.width, other.x + other.width) - Math.max(run.x, other.x);
        const down =
          Math.min(run.y + run.height, other.y + other.height) - Math.max(run.y, other.y);
        return other !== run && across > 4 && down > Math.min(run.height, other.height) / 2;
      }),
    )
    .map(({ text }) => text);
}

async function coveredIn(source: PageSource): Promise<string[]> {
  const pages: string[] = [];
  for (let index = 0; index < source.pageCount; index++) {
    pages.push(...covered((await source.text?.(index, never)) ?? []));
  }
  return pages;
}

test.each<[string, string]>([
  ["fixed at the foot of the view", "position: fixed; bottom: 0"],
  ["fixed at its head", "position: fixed; top: 0; right: 0"],
  ["at the foot of the page", "position: absolute; bottom: 0; width: 100%"],
  ["at a height that others have", "position: absolute; top: 300px; left: 20px"],
])("a box %s does not lie upon text", async (_, style) => {
  const source = await laidOut(
    tinyEpub({ chapters: [`<div style="${style}">running words</div>${prose(20)}`] }),
  );
  expect(await coveredIn(source)).toEqual([]);
  expect((await pagesOf(source)).join(" ")).toContain("running words");
});

test("a box at the foot of one that was as high as a larger page does not lie upon its text", async () => {
  const foot = '<div style="position: absolute; bottom: 0; right: 0">page 12</div>';
  const page = `<div style="position: relative; height: 1000px">${prose(20)}${foot}</div>`;
  const source = await laidOut(tinyEpub({ chapters: [page.repeat(2)] }));
  expect(await coveredIn(source)).toEqual([]);
});

test.each<[string, string]>([
  ["where nothing else is", '<p>one</p><p style="position: absolute; bottom: 0">low words</p>'],
  [
    "upon a letter, in its line",
    '<p><span style="position: relative">low<i style="position: absolute; left: 0; top: 0">words</i></span></p>',
  ],
  [
    "behind text",
    '<p style="position: absolute; top: 0; left: 9px; z-index: -1">low words</p><p>one two three four</p>',
  ],
  [
    "and is larger than the text that it decorates",
    '<p style="position: absolute; top: 0; left: 9px; margin: 0; font-size: 70px">low words</p><p>one</p>',
  ],
])("a box that is put %s stays there", async (_, body) => {
  const source = await laidOut(tinyEpub({ chapters: [`<div>${body}</div>`] }));
  const still = await laidOut(
    tinyEpub({ chapters: [`<div>${body}</div>`.replace("absolute", "static")] }),
  );
  const wordOn = async (book: PageSource): Promise<TextRun | undefined> =>
    (await book.text?.(0, never))?.find(({ text }) => text.includes("words"));
  const [put, flowing] = [await wordOn(source), await wordOn(still)];
  expect([put?.x, put?.y]).not.toEqual([flowing?.x, flowing?.y]);
});
