/** Stocks of leaves, from a list of pages to the real engine. */

import { expect, test } from "vitest";
import { Side } from "../engine/phases.ts";
import type { Surface } from "../engine/shapes.ts";
import { WasmBook } from "../engine/wasm_book.ts";
import { bookThickness, readStocks, stockRuns } from "./leaf_stocks.ts";
import { applyPaper } from "./paper.ts";
import { type BindOptions, bind, type CoverKind, paperLeaves } from "./spreads.ts";
import { Turning } from "./turning.ts";

const width = 0.14;

function runs(list: string, cover: CoverKind = "none", options: BindOptions = {}) {
  return stockRuns(bind(20, cover, options), list).map(
    ({ first, end, stock }) => `${stock} ${first}-${end - 1}`,
  );
}

test("a list of stocks names leaves by their pages", () => {
  expect(runs("card 1-2, coated 7-10")).toEqual(["card 0-0", "coated 3-4"]);
  // A number alone is of the stock before it; one page of a leaf is enough.
  expect(runs("coated 3, 6 ,9-9")).toEqual(["coated 1-2", "coated 4-4"]);
  // The last one wins where two pages differ.
  expect(runs("card 3, bible 4, card 5, bible 1-2")).toEqual(["bible 0-1", "card 2-2"]);
  expect(runs("card 19-99")).toEqual(["card 9-9"]);
  expect(runs("")).toEqual([]);
});

test("covers and pages of board have their stocks, which a list may change", () => {
  expect(runs("", "soft")).toEqual(["card 0-0", "card 9-9"]);
  expect(runs("coated 1", "soft")).toEqual(["coated 0-0", "card 9-9"]);
  expect(runs("", "none", { hardPages: [5] })).toEqual(["board 2-2"]);
  // The boards of a hard cover are no leaves of paper: page 3 is on the first of these.
  expect(runs("card 1-4", "hard")).toEqual(["card 0-0"]);
  // Counted from the other end of the engine's book.
  expect(runs("card 1-2", "none", { edge: "right" })).toEqual(["card 9-9"]);
  expect(runs("card 1-2", "none", { layout: "single" })).toEqual(["card 0-1"]);
});

test.each([
  ["vellum 3", "vellum 3"],
  ["3-4", "3-4"],
  ["card 1-2, card", "card"],
  ["card x-y, board 5", "card x-y"],
  ["coated 1-2-3", "coated 1-2-3"],
  ["toString 1", "toString 1"],
])("of %o one sentence says what is wrong", (list, bad) => {
  const { errors } = readStocks(list);
  expect(errors).toHaveLength(1);
  expect(errors[0]).toMatch(`${JSON.stringify(bad)} is not a stock`);
  expect(errors[0]).not.toContain("\n");
});

test("a book is as thick as its leaves, but bounded", () => {
  const thickness = (pages: number, hardPages: number[] = []) => {
    const binding = bind(pages, "none", { hardPages });
    return bookThickness(binding, stockRuns(binding, ""));
  };
  expect(thickness(2)).toBeCloseTo(0.0004, 5);
  expect(thickness(2, [1])).toBeCloseTo(0.0016, 3);
  expect(thickness(20, [1])).toBeCloseTo(0.0046, 3);
  expect(thickness(10_000)).toBeLessThanOrEqual(0.024);
});

async function open(list: string) {
  const binding = bind(20, "none");
  const stocks = stockRuns(binding, list);
  const thickness = bookThickness(binding, stocks);
  const size = { width, height: 0.21, leaves: paperLeaves(binding), thickness };
  const engine = await WasmBook.create(size);
  applyPaper({}, engine, stocks);
  const events = { started: () => {}, landed: () => {}, rested: () => {} };
  return { engine, turning: new Turning(engine, binding, events) };
}

/**
 * Returns the maximum distance of a leaf's points from the straight line from
 * its spine to its fore-edge, as a fraction of its width.
 */
function bend({ positions, columns, rows }: Surface): number {
  let most = 0;
  for (let row = 0; row < rows; row++) {
    const root = 3 * row * columns;
    const edge = root + 3 * (columns - 1);
    const [dx, dz] = [positions[edge] - positions[root], positions[edge + 2] - positions[root + 2]];
    for (let at = root; at <= edge; at += 3) {
      const [x, z] = [positions[at] - positions[root], positions[at + 2] - positions[root + 2]];
      most = Math.max(most, Math.abs(x * dz - z * dx) / Math.hypot(dx, dz));
    }
  }
  return most / width;
}

test("in one book board turns flat, card less bent than paper, and their edges are visible", async () => {
  const bends: number[] = [];
  for (const [spread, thickness] of [
    [2, 0.0016],
    [3, 0.0003],
    [4, 0],
  ]) {
    const { engine, turning } = await open("board 5-6, card 7-8");
    turning.lay(spread);
    void turning.turn(1);
    let most = 0;
    for (let tick = 0; tick < 400 && turning.moving; tick++) {
      turning.step(1);
      engine.update();
      if (engine.flights === 0) continue;
      expect(engine.surface(0).thickness).toBeCloseTo(thickness, 6);
      most = Math.max(most, bend(engine.surface(0)));
    }
    expect(turning.spread).toBe(spread + 1);
    bends.push(most);
    engine.destroy();
  }
  const [board, card, paper] = bends;
  expect(board).toBeLessThan(0.01);
  expect(card).toBeGreaterThan(0.02);
  expect(card).toBeLessThan(paper);
});

test("a leaf of board lands where it then lies, flat", async () => {
  const { engine, turning } = await open("board 5-6");
  turning.lay(2);
  void turning.turn(1);
  let last: Float32Array = new Float32Array();
  for (let tick = 0; tick < 2000 && turning.moving; tick++) {
    turning.step(1);
    engine.update();
    if (engine.flights > 0) last = engine.surface(0).positions.slice();
  }
  expect(turning.spread).toBe(3);
  const { curves, columns } = engine.pile(Side.left);
  const end = 2 * (columns - 1);
  for (let column = 0; column < columns; column++) {
    expect(last[3 * column]).toBeCloseTo(curves[2 * column], 3);
    expect(last[3 * column + 2]).toBeCloseTo(curves[2 * column + 1], 3);
    const chord = (curves[end + 1] * curves[2 * column]) / curves[end];
    expect(Math.abs(curves[2 * column + 1] - chord)).toBeLessThan(0.01 * width);
  }
});
