import { expect, it } from "vitest";
import { hashWithPage, pageOfHash } from "./address.ts";

it("reads the page from a fragment, wherever it stands in it", () => {
  const pages = ["#page=12", "#a=1&page=3&b", "#page=0", "#page=", "", "#page=1e3", "#mypage=4"];
  expect(pages.map(pageOfHash)).toEqual([12, 3, null, null, null, null, null]);
  expect(pageOfHash("#page=12345678")).toBe(null);
});

it("writes the page and leaves all else of the fragment as it is", () => {
  expect(hashWithPage("", 5)).toBe("#page=5");
  expect(hashWithPage("#", 5)).toBe("#page=5");
  expect(hashWithPage("#page=4", 5)).toBe("#page=5");
  expect(hashWithPage("#a=%20&page=4&b", 5)).toBe("#a=%20&page=5&b");
  expect(hashWithPage("#chapter-2", 5)).toBe("#chapter-2&page=5");
  expect(hashWithPage("#mypage=4", 5)).toBe("#mypage=4&page=5");
});
