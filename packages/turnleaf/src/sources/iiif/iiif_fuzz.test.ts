/** Whatever IIIF's JSON says, a book within the bounds comes of it, or one sentence. */

import { expect } from "vitest";
import { canvas2, canvas3, manifest2, manifest3, server } from "../../for_tests/image_server.ts";
import { clue, fuzzed, type Random } from "../../for_tests/random_numbers.ts";
import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";
import { textOn } from "./annotations.ts";
import { parseInfo, partsFor } from "./image_service.ts";
import { parsePresentation } from "./presentation.ts";
import type { Value } from "./values.ts";

const wild: readonly unknown[] = [
  null,
  -1,
  0,
  1e-300,
  1e300,
  "",
  "x".repeat(9000),
  "javascript:alert(1)",
  "#xywh=0,0,1e9,1",
  "<".repeat(5000),
  [],
  {},
  [[]],
  { id: "r1", type: "Range", items: [{ id: "r1" }] },
  true,
];

/** Replaces some of a value's members, at any depth, by others. */
function mutate(random: Random, value: unknown): unknown {
  const copy = structuredClone(value);
  for (let count = random.below(4); count >= 0; count--) {
    let at = copy as Record<string, unknown>;
    for (;;) {
      const keys = Object.keys(at);
      if (keys.length === 0) break;
      const key = random.among(keys);
      const inner = at[key];
      if (typeof inner === "object" && inner !== null && random.below(4) > 0) {
        at = inner as Record<string, unknown>;
        continue;
      }
      at[key] = structuredClone(random.among(wild));
      break;
    }
  }
  return copy;
}

const box = { type: "TextualBody", value: "Call me" };
const note = { motivation: "supplementing", body: box, target: "c#xywh=1,2,30,40" };
const ranges = [
  {
    id: "r",
    type: "Range",
    label: { en: ["All"] },
    items: [{ id: "r1", type: "Range", label: { en: ["One"] }, items: [canvas3("a")] }],
  },
];
const more = {
  rights: "https://x.example/",
  requiredStatement: { label: "By", value: { en: ["us"] } },
  behavior: ["paged"],
  provider: [{ label: "L" }],
};
const three = manifest3(
  [
    canvas3("a", { annotations: [{ items: [note] }] }),
    canvas3("b", { behavior: ["facing-pages"] }),
  ],
  { ...more, structures: ranges, start: { id: `${server}/canvas/b` } },
);
const two = manifest2([canvas2("a"), canvas2("b")], {
  structures: [{ "@id": "r", label: "R", canvases: [`${server}/canvas/b`] }],
});

fuzzed(
  "a mutated manifest of IIIF is a book within the bounds or fails in one sentence",
  3000,
  (random) => {
    const value = mutate(random, random.among([three, two])) as Value;
    const text = JSON.stringify(value).slice(0, 3000);
    try {
      const book = parsePresentation(value, `${server}/m.json`, "m.json", ["en"]);
      expect(book.title.length, clue(text)).toBeLessThanOrEqual(limits.titleLength);
      expect(book.openingPage ?? 1, clue(text)).toBeLessThanOrEqual(book.pages.length);
      for (const { href } of book.details) expect(href ?? "https:", clue(text)).toMatch(/^https?:/);
      for (const page of book.pages) {
        const { canvas, part, images, annotations } = page;
        expect(canvas.width * canvas.height > 0 && part.width > 0, clue(text)).toBe(true);
        expect(Math.max(canvas.width, canvas.height), clue(text)).toBeLessThanOrEqual(
          limits.pageSide,
        );
        for (const { src, service, on } of images) {
          expect(src, clue(text)).toMatch(/^(https?:|$)/);
          expect(service, clue(text)).toMatch(/^(https?:|$)/);
          expect(on.width > 0 && on.height > 0, clue(text)).toBe(true);
        }
        for (const run of textOn(page, annotations)) {
          expect(
            Number.isFinite(run.x + run.y) && run.width > 0 && run.text !== "",
            clue(text),
          ).toBe(true);
        }
      }
    } catch (error) {
      expect(error, clue(text)).toBeInstanceOf(BookError);
      expect((error as Error).message, clue(text)).toMatch(/^[^\n]+\.$/);
    }
  },
);

const info = {
  "@context": "http://iiif.io/api/image/3/context.json",
  type: "ImageService3",
  profile: "level0",
  width: 2000,
  height: 3000,
  maxWidth: 1000,
  sizes: [{ width: 500, height: 750 }],
  tiles: [{ width: 256, height: 256, scaleFactors: [1, 2, 4] }],
};

fuzzed(
  "mutated information about an image names a bounded number of parts of it",
  3000,
  (random) => {
    const value = mutate(random, info);
    const text = JSON.stringify(value).slice(0, 3000);
    const found = parseInfo(value, `${server}/a`);
    if (found === null) return;
    const { width, height } = found;
    const [x, y] = [random.below(100) / 100, random.below(100) / 100];
    const wanted = {
      x: x * width,
      y: y * height,
      width: (1 - x) * width,
      height: (1 - y) * height,
    };
    const parts = partsFor(found, wanted, random.among([0.001, 0.1, 0.5, 1, 7]));
    expect(parts.length, clue(text)).toBeGreaterThan(0);
    expect(parts.length, clue(text)).toBeLessThanOrEqual(320);
    for (const { url, box: part } of parts) {
      expect(url, clue(text)).not.toMatch(/NaN|Infinity|e[+-]|\/0,\/|undefined/);
      expect(part.width > 0 && part.height > 0, clue(text)).toBe(true);
      expect(part.x + part.width, clue(text)).toBeLessThanOrEqual(width + 1);
    }
  },
);
