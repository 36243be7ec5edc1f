import { expect, test } from "vitest";
import { bind } from "../book/spreads.ts";
import { Turning } from "../book/turning.ts";
import { Side } from "../engine/phases.ts";
import { type Stock, stocks } from "../engine/shapes.ts";
import { WasmBook } from "../engine/wasm_book.ts";
import { CornerPeek } from "./corner_peek.ts";

const [width, height] = [0.14, 0.21];

/** Opens a book of 100 leaves of a stock in its middle. */
async function openBook(stock: (typeof stocks)[number]) {
  const engine = await WasmBook.create({ width, height, leaves: 100, thickness: 0.02 });
  engine.setStock(stock);
  const binding = bind(200, "none");
  const nothing = () => {};
  const turning = new Turning(engine, binding, {
    started: nothing,
    landed: nothing,
    rested: nothing,
  });
  turning.lay(50);
  const peek = new CornerPeek(turning, binding, { width, height }, nothing);
  return { engine, turning, peek };
}

test.each(stocks)(
  "a lifted corner of %s paper stands off, holds still soon, and falls back",
  async (stock) => {
    for (const side of [Side.right, Side.left]) {
      const { engine, turning, peek } = await openBook(stock);
      const top = engine.pile(side).curves[2 * engine.pile(side).columns - 1];
      expect(peek.begin(side, 0.04, top)).toBe(true);
      // There is no second peek at the same time.
      expect(peek.begin(side, 0.96, top)).toBe(false);
      let frames = 0;
      for (let still = false; !still && frames < 1200; frames++) {
        turning.step(2);
        engine.update();
        peek.step(1 / 60);
        still = turning.isHeld && engine.isAsleep;
      }
      // Stiff paper is still within a second. Limp paper loses no more to its
      // bending than real paper does, and swings on a little; the thinnest
      // trembles, and is ignored after a while.
      const limp: Partial<Record<Stock, number>> = { bible: 300, book: 120 };
      const most = limp[stock] ?? 60;
      expect(frames).toBeLessThan(most);
      const { positions, columns } = engine.surface(0);
      const corner = positions[3 * (columns - 1) + 2];
      expect(corner - top).toBeGreaterThan(0.006);
      expect(peek.flight).not.toBeNull();
      peek.end();
      for (let k = 0; k < 1200 && turning.moving; k++) turning.step(2);
      expect(turning.moving).toBe(false);
      expect(turning.spread).toBe(50);
      expect(peek.flight).toBeNull();
      engine.destroy();
    }
  },
);
