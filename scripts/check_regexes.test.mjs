/** What `make check` says of a regular expression that a book could keep busy. */
import { expect, test } from "vitest";
import { expressionsIn, faultOf } from "./check_regexes.mjs";

test.each([
  ["a comment in a repeat", /^(\s|<!--[\s\S]*?-->)*<svg/i, "exponential"],
  ["a tag that does not end", /<[^>]*>/g, "2nd degree polynomial"],
  ["spaces before the end", /\s+$/, "2nd degree polynomial"],
  ["an element within a large bound", /<guide\b[\s\S]{0,20000}?<\/guide>/i, "2nd degree"],
  ["a string that does not end", /"(?:[^"\\]|\\.)*"/g, "2nd degree polynomial"],
])("%s is found", (_, { source, flags }, fault) => {
  expect(faultOf(source, flags)).toContain(fault);
});

test.each([
  ["a tag that ends at the next", /<[^<>]*>/g],
  ["words", /\w+/g],
  ["a string that may end with the text", /"(?:[^"\\\n]|\\[\s\S])*"?/g],
  ["a bounded number", /^(\d{1,400})-(\d{0,15})$/],
])("%s is linear", (_, { source, flags }) => {
  expect(faultOf(source, flags)).toBeNull();
});

test("literals are found, and what is made of constants", () => {
  const found = expressionsIn(`
    const most = 9;
    const digits = \`\\\\d{1,\${most}}\`;
    const made = new RegExp(\`^\${digits}$\`, "u");
    text.replace(/a\\/b/gi, "");
    RegExp("c");
  `);
  expect(found).toEqual([
    { line: 4, source: "^\\d{1,9}$", flags: "u" },
    { line: 5, source: "a\\/b", flags: "gi" },
    { line: 6, source: "c", flags: "" },
  ]);
});

test("what is made of anything else is named", () => {
  expect(expressionsIn("const of = (name) => new RegExp(name);")).toEqual([
    { line: 1, source: null, flags: "" },
  ]);
});
