import { expect, test } from "vitest";
import { style as elementStyle } from "../element/shadow_tree.ts";
import { textStyle } from "../text/text.css.ts";
import { style } from "./controls.css.ts";
import { themes } from "./themes.css.ts";

/** Returns the classes that a style sheet names. */
const classesIn = (css: string): Set<string> =>
  new Set(Array.from(css.matchAll(/\.(-?[a-z_][\w-]*)/gi), ([, name = ""]) => name));

test("no class of the controls means something in the text over the pages: both are in one tree", () => {
  const ofControls = classesIn(style + themes);
  const ofText = classesIn(textStyle);
  expect(ofText.size).toBeGreaterThan(5);
  expect([...ofText].filter((name) => ofControls.has(name))).toEqual([]);
  expect([...ofText].filter((name) => classesIn(elementStyle).has(name))).toEqual([]);
});
