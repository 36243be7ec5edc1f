import { expect, test } from "vitest";
import docs from "../../../../docs/page-flip.md?raw";
import issues from "./issues.browser.test.ts?raw";
import dropIn from "./page_flip.browser.test.ts?raw";
import patterns from "./patterns.browser.test.ts?raw";

test("the table of page-flip's issues has every issue, and its tests are there", () => {
  const [, table = ""] = docs.split("## Its issues, one by one");
  const rows = [...table.matchAll(/^\| ([#\d, ]+) \| (.+) \| (.+) \|$/gm)];
  const numbers = rows.flatMap(([, issues]) => issues.match(/\d+/g) ?? []);
  expect(new Set(numbers).size).toBe(52);
  expect(numbers.length).toBe(52);
  const tests = [issues, dropIn, patterns];
  for (const [, , , here] of rows) {
    for (const [, name] of here.matchAll(/`test: ([^`]+)`/g)) {
      expect(
        tests.some((text) => text.includes(name)),
        name,
      ).toBe(true);
    }
  }
  // A test of an issue is in its row.
  for (const [, name] of issues.matchAll(/^test\("(#[^"]+)"/gm)) {
    expect(table, name).toContain(`test: ${name.split(":")[0]}`);
  }
});
