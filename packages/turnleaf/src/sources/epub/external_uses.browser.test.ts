/** Drawings that use parts of another file of the book. */

import { expect, test } from "vitest";
import { closeEpubs, laidOutEpub, textOf } from "../../for_tests/epub_books.ts";

closeEpubs();

const svg = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"';

const icons = `<svg ${svg}>
  <linearGradient id="base"><stop stop-color="#0f0"/></linearGradient>
  <linearGradient id="green" xlink:href="#base"/>
  <symbol id="star" viewBox="0 0 10 10"><rect width="10" height="10" fill="url(#green)"/></symbol>
  <g id="word"><rect width="100" height="100" fill="#00f"/><text y="20">sprite</text><use href="#star"/></g>
</svg>`;

test("what drawings use of another file is drawn, with what that refers to; what is not there has a warning", async () => {
  const use = (attribute: string): string =>
    `<svg ${svg} width="300" height="150"><use ${attribute} width="300" height="150"/></svg>`;
  const source = await laidOutEpub({
    chapters: [
      use('href="icons.svg#star"'),
      use('xlink:href="./icons.svg#word"') + use('href="icons.svg#word"'),
      `<p id="word">own</p>${use('href="icons.svg#none"')}${use('href="none.svg#star"')}`,
    ],
    files: { "icons.svg": icons },
  });
  const never = new AbortController().signal;
  const coloursOf = async (index: number): Promise<Set<string>> => {
    const picture = (await source.draw(index, 244, never)) as ImageBitmap;
    const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, picture.width, picture.height);
    const found = new Set<string>();
    for (let k = 0; k < data.length; k += 4) found.add(data.slice(k, k + 3).join());
    return found;
  };
  expect(await coloursOf(0)).toContain("0,255,0");
  const second = await coloursOf(1);
  expect(second).toContain("0,0,255");
  expect(second).toContain("0,255,0");
  expect(await textOf(source, 2)).toContain("own");
  expect(source.warnings?.map(({ code, page, source: of }) => [code, page, of])).toEqual([
    ["image", 3, "OEBPS/icons.svg"],
    ["image", 3, "OEBPS/none.svg"],
  ]);
});
