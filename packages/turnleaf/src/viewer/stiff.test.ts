/** Leaves of board and of card over the real engine. */

import { expect, test } from "vitest";
import { bind, paperLeaves } from "../book/spreads.ts";
import { type Flight, Turning } from "../book/turning.ts";
import { Side } from "../engine/phases.ts";
import type { Surface } from "../engine/shapes.ts";
import { WasmBook } from "../engine/wasm_book.ts";
import { Stiffening } from "./stiff.ts";

const width = 0.14;

async function open(hardPages: number[], cover: "soft" | "none" = "none") {
  const binding = bind(20, cover, { hardPages });
  const size = { width, height: 0.21, leaves: paperLeaves(binding), thickness: 0.01 };
  const engine = await WasmBook.create(size);
  const events = { started: () => {}, landed: () => {}, rested: () => {} };
  const turning = new Turning(engine, binding, events);
  return { binding, engine, turning, stiffening: new Stiffening(binding, width) };
}

/**
 * Returns the maximum distance of a leaf's points from the straight line from
 * its spine to its fore-edge, metres.
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
  return most;
}

test("board turns flat, card bends half as much as paper, and paper is left as it is", async () => {
  for (const [hardPages, cover, least, most] of [
    [[1], "none", 0, 1e-6],
    [[], "soft", 0.35, 0.65],
    [[], "none", 1, 1],
  ] as const) {
    const { engine, turning, stiffening } = await open([...hardPages], cover);
    turning.lay(0);
    void turning.turn(1);
    turning.step(40);
    engine.update();
    const paper = engine.surface(0);
    const leaf = stiffening.leaf(paper, turning.flights[0]);
    expect(bend(paper)).toBeGreaterThan(0.005);
    expect(bend(leaf) / bend(paper)).toBeGreaterThanOrEqual(least);
    expect(bend(leaf) / bend(paper)).toBeLessThanOrEqual(most);
    // The same until the leaf moves: a frame without motion costs nothing.
    expect(stiffening.leaf(engine.surface(0), turning.flights[0])).toBe(leaf);
  }
});

test("a leaf of board lands where it then lies", async () => {
  const { engine, turning, stiffening } = await open([5, 6]);
  turning.lay(2);
  void turning.turn(1);
  let last: { leaf: Surface; flight: Flight } | null = null;
  for (let tick = 0; tick < 2000 && turning.moving; tick++) {
    turning.step(1);
    engine.update();
    const [flight] = turning.flights;
    if (flight) last = { leaf: stiffening.leaf(engine.surface(0), flight), flight };
  }
  expect(turning.spread).toBe(3);
  const [left] = stiffening.piles(engine.pile(Side.left), engine.pile(Side.right), 3, [], []);
  const { positions, columns } = (last as { leaf: Surface }).leaf;
  for (let column = 0; column < columns; column++) {
    expect(positions[3 * column]).toBeCloseTo(left.curves[2 * column], 2.5);
    expect(positions[3 * column + 2]).toBeCloseTo(left.curves[2 * column + 1], 2.5);
  }
  // Its pages lie flat; those of paper on the other side do not.
  const [, right] = stiffening.piles(engine.pile(Side.left), engine.pile(Side.right), 3, [], []);
  expect(right).toBe(engine.pile(Side.right));
});
