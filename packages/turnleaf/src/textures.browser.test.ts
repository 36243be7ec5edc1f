/**
 * Pictures and their textures over whole turns: none is uploaded to the
 * graphics card once it is freed.
 */

import { afterEach, expect, test } from "vitest";
import { book, happens, scans, settled } from "./for_tests/element_books.ts";

afterEach(() => document.body.replaceChildren());

test("a far jump in a hard-bound book sends no freed picture to the graphics card", async () => {
  const element = book(scans(200), { duration: "200" });
  await happens(element, "load");
  await settled(element);
  expect(await element.goTo(64)).toBe(true);
  await settled(element);
  expect(await element.goTo(1)).toBe(true);
  await settled(element);
});
