/** Lines and pages: what the breaker and the pager promise. */
import { describe, expect, it } from "vitest";
import { setChapter } from "./chapters.mjs";
import { settings } from "./knuth_plass.mjs";
import { MEASURE, ROWS } from "./measures.mjs";
import { paginate } from "./paginate.mjs";
import { Paper } from "./paper.mjs";
import { chapter } from "./text.mjs";

const box = (w) => ({ kind: "box", w, left: 0, right: 0 });
const glue = { kind: "glue", w: 3, stretch: 2, shrink: 1 };
const end = [
  { kind: "glue", w: 0, stretch: 1e5, shrink: 0, fill: true },
  { kind: "penalty", w: 0, cost: -10000 },
];

describe("line breaking", () => {
  it("breaks at every box that fills a line", () => {
    const items = [box(50), glue, box(47), glue, box(50), glue, box(47), ...end];
    const { breaks } = settings(items, () => 100).get(2);
    expect(breaks.map((b) => [b.start, b.end])).toEqual([
      [0, 3],
      [4, 8],
    ]);
  });

  it("offers settings a line longer where the glue allows", () => {
    const items = [];
    for (let i = 0; i < 200; i++) items.push(...(i ? [glue] : []), box(11 + (i % 5)));
    const found = settings([...items, ...end], () => 110);
    expect(found.size).toBeGreaterThan(1);
  });

  it("never sets a line of a chapter wider than the measure by more than a hair", () => {
    const paper = new Paper({ Title: "test" });
    for (const page of setChapter(paper, 3).pages) {
      for (const { line } of page) {
        const spaces = line.pieces.filter((p) => p.run.glyphs[0].codePoints[0] === 32).length;
        const width = line.natural + spaces * line.gap;
        expect(width).toBeLessThan(MEASURE + 6); // hung marks stand outside
      }
    }
  });
});

describe("paging", () => {
  const lines = (n) => Array.from({ length: n }, () => ({}));

  it("leaves no single line of a paragraph at a page's foot or head", () => {
    const blocks = [9, 2, 7, 5, 11, 3, 8, 4, 6].map((n) => ({
      settings: [{ lines: lines(n), cost: 0 }],
    }));
    const owner = new Map();
    blocks.forEach((block, b) => {
      for (const line of block.settings[0].lines) owner.set(line, b);
    });
    const pages = paginate(blocks, 8, 10);
    pages.forEach((page, p) => {
      const first = owner.get(page[0].line);
      const before = p ? pages[p - 1].filter((put) => owner.get(put.line) === first).length : 0;
      const here = page.filter((put) => owner.get(put.line) === first).length;
      if (before) expect(Math.min(before, here)).toBeGreaterThan(1);
    });
  });

  it("fills every page of prose to the last row", () => {
    const paper = new Paper({ Title: "test" });
    for (let n = 1; n <= 14; n++) {
      if (chapter(n).blocks.some((block) => block.kind === "tablet" || block.kind === "verse"))
        continue;
      const { pages } = setChapter(paper, n);
      for (const page of pages.slice(1, -1)) expect(page.at(-1).row, `chapter ${n}`).toBe(ROWS - 1);
    }
  });
});
