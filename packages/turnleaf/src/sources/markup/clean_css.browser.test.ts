/** What is left of style sheets of books: all of what they say, and nothing that could be loaded. */

import { expect, test } from "vitest";
import { cleanCss, cleanStyleAttribute } from "./clean_css.ts";

const none = async (): Promise<null> => null;

/** Returns what a browser makes of a style sheet's first rule, with `--a` and `--b` set. */
async function computed(css: string, ...names: string[]): Promise<readonly string[]> {
  const { rules } = await cleanCss(css, none);
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(rules);
  document.adoptedStyleSheets = [sheet];
  const element = document.createElement("i");
  document.body.append(element);
  element.style.cssText = "--a: 7px; --b: red; color: blue; display: block";
  const style = getComputedStyle(element);
  const values = names.map((name) => style.getPropertyValue(name));
  element.remove();
  document.adoptedStyleSheets = [];
  return values;
}

test.each([
  ["i { margin: var(--a) }", { "margin-top": "7px", "margin-left": "7px" }],
  ["i{margin:var(--a)}", { "margin-top": "7px" }],
  ["i { margin: var(--a); margin-top: 1px }", { "margin-top": "1px", "margin-left": "7px" }],
  ["i { margin-top: 1px; margin: var(--a) }", { "margin-top": "7px" }],
  ["i { margin-top: 1px !important; margin: var(--a) }", { "margin-top": "1px" }],
  ["i { margin: var(--a) !important; margin-top: 1px }", { "margin-top": "7px" }],
  [
    "i { border: 2px solid var(--b); border-bottom: none }",
    { "border-top-color": "rgb(255, 0, 0)", "border-bottom-style": "none" },
  ],
  ["i { MARGIN : calc( 2 * VAR(--a) ) }", { "margin-top": "14px" }],
  [
    "/* a: b; padding: var(--a) */ i { /* b: c */ margin: var(--a) /* ; */ }",
    { "margin-top": "7px" },
  ],
  ["i { background: var(--b) }", { "background-color": "rgb(255, 0, 0)" }],
  ["i { font: italic var(--a)/1 serif }", { "font-size": "7px", "font-style": "italic" }],
  ['i { quotes: ";margin: var(--a)" "x"; margin: 3px }', { "margin-top": "3px" }],
  ["@media all { i { margin: var(--a) } }", { "margin-top": "7px" }],
  [
    "i { b { color: red } margin: var(--a); padding: 4px }",
    { "margin-top": "7px", "padding-top": "4px" },
  ],
])("%s is kept", async (css, expected) => {
  expect(await computed(css, ...Object.keys(expected))).toEqual(Object.values(expected));
});

test("a shorthand with variables is kept in a style attribute", async () => {
  expect(await cleanStyleAttribute("margin: var(--a); color: red", none)).toBe(
    "margin: var(--a); color: red;",
  );
});

test("addresses in shorthands with variables, and what names hide, load nothing", async () => {
  for (const css of [
    "i { background: var(--b) url(https://elsewhere.invalid/a.png) }",
    "i { --carried-background: url(https://elsewhere.invalid/a.png) }",
    "i { --x\\7d *\\7b background\\3a url\\28 https\\3a //elsewhere.invalid/a\\29 : 1 }",
    "i { --carried-x\\7d *\\7b background\\3a url\\28 https\\3a //elsewhere.invalid/a\\29 : 1 }",
    "i { --a: u\\72l(https://elsewhere.invalid/a.png); background: var(--a) }",
  ]) {
    expect((await cleanCss(css, none)).rules, css).not.toContain("elsewhere");
  }
});
