import { expect, test } from "vitest";
import { Cover, EngineBook, isResting, Phase, Side } from "./engine.ts";
import { columnPlace } from "./shapes.ts";

const size = { width: 0.14, height: 0.21, leaves: 40, thickness: 0.012 };

test("columns lie where the viewer's pictures expect them", async () => {
  const book = await EngineBook.create(size);
  const u = book.columns;
  for (let k = 0; k < u.length; k++) expect(u[k]).toBeCloseTo(columnPlace(k, u.length), 6);
  expect(book.surface.columns).toBe(u.length);
  expect(book.pile(Side.left).columns).toBe(u.length);
  book.destroy();
});

test("a leaf is lifted, played and laid down on the other pile", async () => {
  const book = await EngineBook.create(size);
  book.lay(10);
  book.lift(Side.right, 10, 11);
  const { version } = book.surface;
  book.play(Side.left, 0.8);
  expect(book.step(96)).toBe(Phase.playing);
  book.update();
  expect(book.surface.version).toBeGreaterThan(version);
  expect(book.surface.positions.every(Number.isFinite)).toBe(true);
  let ticks = 96;
  while (!isResting(book.step(1))) expect(++ticks).toBeLessThan(200);
  book.update();
  // At rest it is the uppermost curve of its pile, in every row.
  const { positions, columns, rows } = book.surface;
  const { curves } = book.pile(Side.left);
  for (let row = 0; row < rows; row++) {
    for (let k = 0; k < columns; k++) {
      const at = 3 * (row * columns + k);
      const apart = Math.hypot(
        positions[at] - curves[2 * k],
        positions[at + 2] - curves[2 * k + 1],
      );
      expect(apart).toBeLessThan(2.5e-4);
    }
  }
  book.destroy();
});

test("a held leaf follows the hand; let go it falls", async () => {
  const book = await EngineBook.create(size);
  book.lift(Side.right, 0, 1);
  book.grab(1, 0);
  book.hold(0.06, 0.02, 0.07);
  for (let k = 0; k < 60; k++) {
    book.step(4);
    book.update();
    book.hold(0.06, 0.02, 0.07);
  }
  const { positions, columns } = book.surface;
  const corner = [...positions.slice(3 * (columns - 1), 3 * columns)];
  expect(Math.hypot(corner[0] - 0.06, corner[1] - 0.02, corner[2] - 0.07)).toBeLessThan(0.012);
  book.release();
  for (let k = 0; k < 600 && !isResting(book.step(1)); k++);
  expect(book.step(1)).toBe(Phase.restingRight);
  book.destroy();
});

test("boards swing and lie down", async () => {
  const book = await EngineBook.create(size);
  expect(book.boardAngle(Cover.front)).toBe(0);
  book.playBoard(Cover.front, Side.left, 0.5);
  for (let k = 0; k < 200 && !isResting(book.stepBoard(Cover.front, 1)); k++);
  expect(book.boardAngle(Cover.front)).toBeCloseTo(Math.PI, 6);
  book.destroy();
});

test("sizes that are no book's are refused", async () => {
  for (const bad of [
    { ...size, width: 0 },
    { ...size, height: Number.NaN },
    { ...size, thickness: -1 },
    { ...size, width: Number.POSITIVE_INFINITY },
  ]) {
    await expect(EngineBook.create(bad)).rejects.toThrow("size");
  }
});
