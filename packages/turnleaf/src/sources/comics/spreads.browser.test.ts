import { strToU8, type Zippable, zipSync } from "fflate";
import { afterEach, expect, test } from "vitest";
import "../../index.ts";
import { book, happens } from "../../for_tests/element_books.ts";
import { eventually } from "../../for_tests/eventually.ts";

afterEach(() => document.body.replaceChildren());

async function image(width: number, height: number): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d");
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

/** Returns a comic of 9 scans, the fourth of which is of a spread: 10 pages. */
async function comic(manga: string): Promise<Blob> {
  const files: Zippable = {
    "ComicInfo.xml": strToU8(`<ComicInfo><Manga>${manga}</Manga></ComicInfo>`),
  };
  for (let k = 1; k <= 9; k++) files[`${k}.png`] = await image(k === 4 ? 80 : 40, 60);
  return new Blob([zipSync(files) as Uint8Array<ArrayBuffer>]);
}

test("a wide scan lies across the spread, and is split where one page is shown", async () => {
  const element = book(await comic("Yes"), { layout: "spread", page: "4" });
  await happens(element, "load");
  // Page 4 may lie on the left as it is.
  expect(element.spread).toEqual({ left: 4, right: 5 });
  // With the offset of 0 it may not: page 3 stays alone.
  element.offset = 0;
  await element.goTo(3);
  await eventually(() => element.spread).toEqual({ left: 3, right: null });
  await element.next();
  expect(element.spread).toEqual({ left: 4, right: 5 });
  element.layout = "single";
  await eventually(() => element.shownLayout).toBe("single");
  await element.next();
  expect(element.page).toBe(5);
});

test("read from right to left, its right half comes first", async () => {
  const element = book(await comic("YesAndRightToLeft"), { layout: "spread", page: "4" });
  await happens(element, "load");
  expect(element.direction).toBe("rtl");
  expect(element.spread).toEqual({ left: 5, right: 4 });
});
