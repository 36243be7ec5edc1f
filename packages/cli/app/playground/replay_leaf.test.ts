import {
  type LeafNodes,
  type LeafStock,
  LooseLeaf,
  leafStocks,
  standardGravity,
} from "turnleaf/models";
import { expect, test } from "vitest";
import { paperFigures } from "./paper_figures.ts";
import { ReplayLeaf } from "./replay_leaf.ts";

const options = { model: "sheet", width: 0.148, height: 0.21, points: [25, 33] } as const;

/** Returns the maximum distance between points, metres. */
function apart(a: Pick<LeafNodes, "positions">, b: Pick<LeafNodes, "positions">): number {
  let most = 0;
  for (let i = 0; i < a.positions.length; i += 3) {
    const way = [0, 1, 2].map((k) => a.positions[i + k] - b.positions[i + k]);
    most = Math.max(most, Math.hypot(...way));
  }
  return most;
}

/** Returns x of the fore-edge's middle, over the width. */
const edgeOf = ({ columns, rows, positions }: LeafNodes): number =>
  positions[3 * ((rows >> 1) * columns + columns - 1)] / 0.148;

test("a replay is where the live leaf is, by either gesture, and mirrored from the left", async () => {
  const live = await LooseLeaf.create(options);
  const replay = await ReplayLeaf.create(options);
  for (const by of ["edge", "corner"] as const) {
    live.play(by, "right", 1.2);
    replay.play(by, "right", 1.2);
    for (let frame = 0; frame < 80; frame++) {
      live.advance(1 / 60);
      replay.advance(1 / 60);
      live.update();
      expect(apart(live.surface(), replay.surface())).toBeLessThan(0.003);
    }
  }
  replay.play("edge", "left", 1.2);
  replay.advance(0.3);
  const mirrored = edgeOf(replay.nodes());
  replay.play("edge", "right", 1.2);
  replay.advance(0.3);
  expect(edgeOf(replay.nodes())).toBeCloseTo(-mirrored, 6);
});

test("it turns as fast as it is asked to, and then lies", async () => {
  const replay = await ReplayLeaf.create(options);
  replay.play("edge", "right", 0.4);
  replay.advance(0.3);
  expect(replay.playing).toBe(true);
  replay.advance(0.4);
  expect(replay.playing).toBe(false);
  expect(edgeOf(replay.nodes())).toBeLessThan(-0.95);
  expect(replay.measure().kinetic).toBeLessThan(1e-3);
});

test("it follows a pointer by how far over that is, and falls to the nearer side", async () => {
  const replay = await ReplayLeaf.create(options);
  replay.grab();
  for (const fraction of [0.7, 0.3, 0.6]) {
    replay.hold(0.1 * Math.cos(Math.PI * fraction), 0.1, 0.1 * Math.sin(Math.PI * fraction));
    replay.advance(1 / 60);
    const { columns, rows, positions } = replay.nodes();
    const at = 3 * ((rows >> 1) * columns + columns - 1);
    expect(Math.atan2(positions[at + 2], positions[at]) / Math.PI).toBeCloseTo(fraction, 1);
  }
  replay.release();
  for (let k = 0; k < 120; k++) replay.advance(1 / 60);
  expect(edgeOf(replay.nodes())).toBeLessThan(-0.95);
  replay.grab();
  replay.hold(-0.1, 0.1, 0.02);
  replay.release();
  for (let k = 0; k < 120; k++) replay.advance(1 / 60);
  expect(edgeOf(replay.nodes())).toBeLessThan(-0.95);
});

test("energies and strains of points are those that the engine finds of nodes", async () => {
  for (const stock of [leafStocks.book, leafStocks.card] as LeafStock[]) {
    const leaf = await LooseLeaf.create({ ...options, stock });
    leaf.play("corner", "right", 1.2);
    leaf.advance(0.5);
    leaf.update();
    const found = paperFigures({ ...options, stock, gravity: standardGravity }, leaf.nodes());
    const wanted = leaf.measure();
    for (const name of ["kinetic", "bending", "gravity"] as const) {
      expect(Math.abs(found[name] / wanted[name] - 1)).toBeLessThan(0.01);
    }
    expect(found.stretch).toBeCloseTo(wanted.stretch, 5);
    expect(found.compression).toBeCloseTo(wanted.compression, 5);
  }
});
