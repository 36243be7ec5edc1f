import { expect, it } from "vitest";
import { elementTexts, fill, list, number } from "./languages.ts";
import { plural } from "./plural.ts";

it("speaks the language nearest to the one asked for, English where it knows none", () => {
  const zh = elementTexts("zh").back;
  expect(zh).not.toBe(elementTexts("en").back);
  expect(elementTexts("zh-Hans-CN").back).toBe(zh);
  expect(elementTexts("EN-us").back).toBe("Back of {n}");
  for (const tag of ["", "xx", "constructor", "__proto__", "not a tag"]) {
    expect(elementTexts(tag).back).toBe("Back of {n}");
  }
});

it("fills in texts, and writes numbers and lists as the language does", () => {
  expect(fill("{page} of {n} {else}", { page: "3", n: "{page}" })).toBe("3 of {page} {else}");
  expect(number("de", 12345)).toBe("12.345");
  expect(list("en", ["iv", "v"])).toBe("iv and v");
  expect(plural("en", { one: "{n} place", other: "{n} places" }, 1)).toBe("1 place");
  expect(plural("pl", { few: "{n} miejsca", other: "{n} miejsc" }, 3)).toBe("3 miejsca");
  expect(plural("zh", { one: "no", other: "{n}" }, 1)).toBe("1");
  expect([number("not a tag", 5), list("not a tag", ["a"])]).toEqual(["5", "a"]);
});
