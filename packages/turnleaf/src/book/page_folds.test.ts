import { expect, it } from "vitest";
import { creasesOf } from "./creases.ts";
import { meetsSpine, type PageFold } from "./page_folds.ts";
import { bind, type Edge, spineOf } from "./spreads.ts";

const shape = { width: 2, height: 3 };

const fold = (page: number, line: readonly number[], angle = 90): PageFold => {
  const [x, y, toX, toY] = line;
  return { page, from: { x, y }, to: { x: toX, y: toY }, angle };
};

it.each<[Edge, number, readonly number[], number]>([
  // Near the fore-edge and the head, as the page is read.
  ["left", 3, [0.75, 0.25, 0.875, 0.5], 1],
  ["left", 2, [0.25, 0.25, 0.125, 0.5], -1],
  ["right", 3, [0.25, 0.25, 0.125, 0.5], -1],
  ["right", 2, [0.75, 0.25, 0.875, 0.5], 1],
  // Its spine above it: outward is down, the head is on the right.
  ["top", 3, [0.25, 0.75, 0.5, 0.875], 1],
])(
  "bound at the %s, page %i is folded where and to where it is asked to be",
  (edge, page, line, sign) => {
    const binding = bind(12, "none", { edge });
    const [[leaf, [crease]]] = [...creasesOf([fold(page, line)], binding, shape)];
    const read = (page - 1) >> 1;
    expect(leaf).toBe(edge === "right" ? 5 - read : read);
    const across = edge === "top" ? [line[1], line[3]] : [line[0], line[2]];
    const isMirrored = spineOf(binding, page) === "right";
    const [u, toU] = isMirrored ? across.map((x) => 1 - x) : across;
    expect([crease.through[0], crease.through[2]]).toEqual([u, toU]);
    const head = edge === "top" ? [line[0], line[2]] : [1 - line[1], 1 - line[3]];
    expect([crease.through[1], crease.through[3]]).toEqual(head);
    expect(crease.rest).toBeCloseTo((sign * Math.PI) / 2);
  },
);

it("a fold that was opened leaves a line an eighth of its angle off flat", () => {
  const binding = bind(12, "none");
  const opened = [{ ...fold(3, [0.5, 0, 0.5, 1], 160), isOpened: true }];
  const [[, [crease]]] = [...creasesOf(opened, binding, shape)];
  expect((crease.rest / Math.PI) * 180).toBeCloseTo(20);
});

it("a line that meets the spine, on the page or where it goes on, is distinguished from one that does not", () => {
  const across = [0, 0.5, 1, 0.5];
  const upright = [0.4, 0, 0.4, 1];
  const slanted = [0.4, 0.9, 0.6, 0.8];
  const steep = [0.1, 0, 0.4, 1];
  const met = (line: readonly number[], edge: Edge) => meetsSpine(fold(1, line), edge);
  expect([across, upright, slanted, steep].map((line) => met(line, "left"))).toEqual([
    true,
    false,
    false,
    false,
  ]);
  expect([across, upright].map((line) => met(line, "top"))).toEqual([false, true]);
  expect([across, upright, slanted].map((line) => met(line, "right"))).toEqual([true, false, true]);
  expect([across, upright].map((line) => met(line, "bottom"))).toEqual([false, true]);
  expect(met([0, 0.2, 0, 0.8], "left")).toBe(true);
  // It meets the spine's line beyond the end of the spine.
  expect(met([0.5, 0.1, 1, 0.6], "left")).toBe(false);
});

it.each<Edge>(["left", "right"])(
  "no leaf is folded for a page beyond the last, bound at the %s",
  (edge) => {
    const binding = bind(11, "none", { edge });
    const beyond = [12, 13, 99].map((page) => fold(page, [0.5, 0, 0.5, 1]));
    expect(creasesOf(beyond, binding, shape).size).toBe(0);
  },
);
