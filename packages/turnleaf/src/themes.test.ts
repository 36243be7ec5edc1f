import { expect, test } from "vitest";
import { coloursOf, pageThemes, themeLooks } from "./themes.ts";

/** Returns the relative luminance of a colour, as WCAG has it. */
function luminance(colour: string): number {
  const [red, green, blue] = [1, 3, 5].map((at) => {
    const value = Number.parseInt(colour.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

test.for(pageThemes)("ink on paper has a contrast of at least 7 to 1 in the theme %s", (theme) => {
  const { ink, link, paper, isDark } = themeLooks[theme];
  for (const print of [ink, link]) {
    const [dark, bright] = [luminance(print), luminance(paper)].sort((a, b) => a - b) as [
      number,
      number,
    ];
    expect((bright + 0.05) / (dark + 0.05)).toBeGreaterThanOrEqual(7);
  }
  expect(luminance(paper) < luminance(ink)).toBe(isDark);
});

test("by day pages have their own colours", () => {
  expect(coloursOf("light", "invert")).toBeNull();
  expect(coloursOf("night", "dim")).toMatchObject({ isDark: true, pictures: "dim" });
});
