import { expect, test } from "vitest";
import source from "../../../../engine/src/stock.rs?raw";
import {
  type LeafTurn,
  LooseLeaf,
  leafStocks,
  type Model,
  models,
  springsOf,
  standardGravity,
} from "./models.ts";

const quick = (model: Model) =>
  model === "shell" ? { model, nodes: [7, 5] as const, timeStep: 1 / 120 } : { model };

test("every model turns a leaf over from either side", async () => {
  for (const model of models) {
    const preset = "book" as const;
    const leaf = await LooseLeaf.create({ ...quick(model), preset, points: [9, 7] });
    for (const [from, sign] of [
      ["right", 1],
      ["left", -1],
    ] as const) {
      leaf.play("edge", from, 0.8);
      leaf.update();
      const start = leaf.surface();
      const last = 3 * (start.columns - 1);
      expect(sign * (start.positions[last] ?? 0)).toBeCloseTo(0.148, 5);
      leaf.advance(0.4);
      expect(leaf.playing).toBe(true);
      expect(leaf.measure().kinetic).toBeGreaterThan(1e-5);
      leaf.advance(1.2);
      expect(leaf.playing).toBe(false);
      leaf.update();
      expect(-sign * (leaf.surface().positions[last] ?? 0), model).toBeGreaterThan(0.12);
    }
    leaf.destroy();
  }
});

test("a grab leads a leaf, and a released leaf falls", async () => {
  for (const model of ["sheet", "peel", "cylinder", "cone", "rigid"] as const) {
    const leaf = await LooseLeaf.create({ model, points: [9, 7] });
    leaf.grab(1, 0);
    for (let k = 0; k <= 30; k++) {
      const angle = (k / 30) * 2;
      leaf.hold(0.13 * Math.cos(angle), 0.01, 0.13 * Math.sin(angle));
      leaf.advance(1 / 60);
    }
    leaf.update();
    expect(leaf.surface().positions[3 * 8] ?? 1, model).toBeLessThan(0);
    leaf.release();
    leaf.advance(3);
    leaf.update();
    expect(leaf.surface().positions[3 * 8] ?? 1, model).toBeLessThan(-0.12);
    leaf.destroy();
  }
});

test("a leaf is drawn where it is asked to be", async () => {
  const leaf = await LooseLeaf.create({ model: "sheet" });
  leaf.drawAt([0, 0.1, 0.7, 1], new Float32Array([0, 0.4, 1]));
  leaf.update();
  const { columns, rows, positions } = leaf.surface();
  expect([columns, rows]).toEqual([4, 3]);
  expect(positions[3 * 6]).toBeCloseTo(0.7 * 0.148, 6);
  expect(positions[3 * 6 + 1]).toBeCloseTo(0.4 * 0.21, 6);
  expect(() => leaf.drawAt([0, 0], [0, 1])).toThrow(RangeError);
  const many = new Float32Array(1025);
  expect(() => leaf.drawAt(many, [0, 1])).toThrow("at 1024 columns and rows at most");
  expect(() => leaf.drawAt([0, 1], many)).toThrow(RangeError);
  leaf.destroy();
});

test("a record is a file of key frames", async () => {
  const leaf = await LooseLeaf.create({ model: "cone", points: [5, 4] });
  leaf.play("corner", "right", 0.5);
  leaf.record(0.1);
  leaf.advance(0.5);
  const bytes = leaf.finishRecord();
  expect(new TextDecoder().decode(bytes.subarray(0, 4))).toBe("TLKF");
  expect(bytes.length).toBe(36 + 4 * 6 * (1 + 3 * 20) + 8);
  expect(leaf.finishRecord().length).toBe(0);
  leaf.destroy();
});

test("a sheet is creased, folded and drawn with its crease", async () => {
  const leaf = await LooseLeaf.create({ model: "sheet", points: [25, 33] });
  expect(leaf.surface().creased).toBeUndefined();
  expect(leaf.creaseState(0)).toBeNull();
  leaf.crease([{ through: [0.6, 0, 1, 0.3], rest: 0 }]);
  const { creased } = leaf.surface();
  expect([creased?.places.length, creased?.parts.length]).toEqual([1650, 1536]);
  for (let step = 1; step <= 60; step++) {
    leaf.press(0, (step / 60) * 2.5);
    leaf.advance(1 / 120);
  }
  leaf.advance(1);
  leaf.update();
  const state = leaf.creaseState(0);
  expect(state?.rest).toBeCloseTo(2.5, 5);
  expect(Math.abs((state?.angle ?? 0) - 2.5)).toBeLessThan(0.3);
  // The moment is that of the difference: what the flap weighs opens or shuts it.
  expect(Math.sign(state?.moment ?? 0)).toBe(Math.sign((state?.angle ?? 0) - 2.5));
  const { positions } = leaf.surface();
  expect(positions[3 * 24]).toBeLessThan(0.135);
  expect(positions[3 * 24 + 2]).toBeGreaterThan(0);
  expect(leaf.surface().creased).toBe(creased);
  expect(() => leaf.crease([{ through: [0, 0.5, 1, 0.5], rest: 1 }])).toThrow("spine");
  expect(leaf.surface().creased).toBe(creased);
  leaf.crease([]);
  expect(leaf.surface().creased).toBeUndefined();
  leaf.destroy();
  const cone = await LooseLeaf.create({ model: "cone" });
  expect(() => cone.crease([{ through: [0.6, 0, 1, 0.3], rest: 0 }])).toThrow("only the sheet");
  cone.destroy();
});

test("what makes no leaf is rejected in one sentence", async () => {
  await expect(LooseLeaf.create({ model: "cone", width: 0 })).rejects.toThrow(/lies between/);
  await expect(LooseLeaf.create({ model: "none" as Model })).rejects.toThrow("no model number 0");
  const stock = { ...leafStocks.book, grammage: -1 };
  await expect(LooseLeaf.create({ model: "sheet", stock })).rejects.toThrow(/\.$/);
  const leaf = await LooseLeaf.create({ model: "rigid" });
  leaf.play("none" as LeafTurn, "right", Number.NaN);
  leaf.hold(Number.NaN, 0, 0);
  leaf.advance(Number.NaN);
  leaf.update();
  expect(leaf.surface().positions.every(Number.isFinite)).toBe(true);
});

test("the paper's grid has its 158 springs", () => {
  expect(springsOf(6, 6).length).toBe(158);
});

test("standard gravity is the engine's", () => {
  expect(standardGravity).toBe(Number(/const GRAVITY: f64 = ([\d.]+);/.exec(source)?.[1]));
});
