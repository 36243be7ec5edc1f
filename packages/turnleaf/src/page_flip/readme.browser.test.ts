/** The example of page-flip's own README, as it stands there. */

import readme from "page-flip/README.md?raw";
import { afterEach, expect, test } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import { PageFlip } from "./index.ts";

afterEach(() => document.body.replaceChildren());

/** Returns the first block of code of a language after a sentence of the README. */
function block(language: string, after: string): string {
  const rest = readme.slice(readme.indexOf(after));
  const [, code] = new RegExp(`\`\`\`${language}\\n([\\s\\S]*?)\`\`\``).exec(rest) ?? [];
  if (code === undefined) throw new Error(`No ${language} after ${after}`);
  return code;
}

test("the README's example of HTML pages runs unchanged", async () => {
  document.body.innerHTML = block("html", "For example:");
  const code = block("js", "For example:");
  expect(code).toContain("loadFromHTML(document.querySelectorAll('.my-page'))");
  const run = new Function("PageFlip", `${code}; return pageFlip;`);
  const pageFlip: PageFlip = run(PageFlip);
  const listened = block("js", "To listen events use the method");
  const alerts: unknown[] = [];
  new Function("pageFlip", "alert", listened)(pageFlip, (said: unknown) => alerts.push(said));
  await new Promise((resolve) => pageFlip.on("init", resolve));
  expect(pageFlip.getPageCount()).toBe(6);
  pageFlip.flipNext();
  await eventually(() => alerts).toEqual([2]);
  expect(pageFlip.getCurrentPageIndex()).toBe(2);
});
