/** The controls as axe sees them: names, roles, contrast, in every theme with every panel. */

import axe from "axe-core";
import { afterEach, expect, test } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import { addFakeBook } from "../for_tests/fake_book.ts";

afterEach(() => document.body.replaceChildren());

/** Returns the serious faults, in words. */
async function faults(element: Element): Promise<string[]> {
  const { violations } = await axe.run(element, {
    rules: { region: { enabled: false } },
  });
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .flatMap(({ id, nodes }) =>
      nodes.map(({ target, failureSummary }) => `${id}: ${target}: ${failureSummary}`),
    );
}

const hit = { page: 2, before: "the white ", text: "whale", after: " of it" };

for (const theme of ["light", "sepia", "grey", "night"]) {
  for (const width of [780, 390]) {
    test(`${theme}, ${width} pixels wide: nothing serious in any panel`, async () => {
      const { book, root } = addFakeBook(width, { hits: [hit], bookmarks: [2, 4] });
      book.setAttribute("theme", theme);
      const press = (selector: string) => root.querySelector<HTMLElement>(selector)?.click();
      expect(await faults(book)).toEqual([]);
      press(".group button");
      await eventually(() => root.querySelectorAll(".contents .line").length).toBe(5);
      expect(await faults(book)).toEqual([]);
      for (const tab of ["thumbnails", "search", "bookmarks"]) {
        press(`#tab-${tab}`);
        if (tab === "search") {
          const field = root.querySelector<HTMLInputElement>(".query");
          if (field) field.value = "whale";
          root.querySelector<HTMLFormElement>(".ask")?.requestSubmit();
          await eventually(() => root.querySelectorAll(".hit").length).toBe(1);
          press(".hit");
          if (width === 390) press(".group button:nth-child(3)");
        }
        expect(await faults(book)).toEqual([]);
      }
      press("[aria-haspopup=menu]");
      expect(await faults(book)).toEqual([]);
      [...root.querySelectorAll<HTMLElement>("[role=menuitem]")]
        .find((item) => item.textContent === "Print")
        ?.click();
      expect(await faults(book)).toEqual([]);
    });
  }
}
