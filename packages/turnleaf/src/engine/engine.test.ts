import { expect, test } from "vitest";
import { applyPaper } from "../book/paper.ts";
import { Cover, isResting, Phase, Side } from "./phases.ts";
import { columnPlace, stocks } from "./shapes.ts";
import { WasmBook } from "./wasm_book.ts";

const size = { width: 0.14, height: 0.21, leaves: 40, thickness: 0.012 };

test("columns lie where the viewer's pictures expect them", async () => {
  const book = await WasmBook.create(size);
  const u = book.columns;
  for (let k = 0; k < u.length; k++) expect(u[k]).toBeCloseTo(columnPlace(k, u.length), 6);
  book.pickUp(Side.right, 0, 1);
  expect(book.surface(0).columns).toBe(u.length);
  expect(book.pile(Side.left).columns).toBe(u.length);
  book.destroy();
});

/** Opens a book so that its leaves can turn: a closed board would press on them. */
async function open(): Promise<WasmBook> {
  const book = await WasmBook.create(size);
  book.layBoard(Cover.front, Side.left);
  return book;
}

/** Steps a book until no leaf is in flight. Returns the ticks it took. */
function rest(book: WasmBook): number {
  for (let ticks = 0; ticks < 2000; ticks++) {
    if (book.flights === 0) return ticks;
    book.step(1);
  }
  throw new Error("The leaves never came to rest.");
}

test("a leaf is lifted, played and laid down on the other pile", async () => {
  const book = await open();
  book.lay(10);
  const id = book.pickUp(Side.right, 10, 11);
  const { version } = book.surface(0);
  book.play(id, Side.left, 0.8);
  book.step(Math.round(0.4 / book.tick));
  expect(book.phase(id)).toBe(Phase.playingLeft);
  book.update();
  const surface = book.surface(0);
  expect(surface.version).toBeGreaterThan(version);
  expect(surface.positions.every(Number.isFinite)).toBe(true);
  expect(rest(book) * book.tick).toBeLessThan(0.45);
  expect([book.phase(id), book.read]).toEqual([Phase.over, 11]);
  book.destroy();
});

test("twelve leaves fly at once, each with its own surface", async () => {
  const book = await open();
  const ids = Array.from({ length: 12 }, (_, k) => {
    const id = book.pickUp(Side.right, k, k + 1);
    book.play(id, Side.left, 0.8);
    book.step(Math.round(0.05 / book.tick));
    return id;
  });
  book.update();
  expect(book.flights).toBe(12);
  const surfaces = ids.map((_, index) => book.surface(index));
  expect(new Set(surfaces.map(({ positions }) => positions.byteOffset)).size).toBe(12);
  const heights = surfaces.map(({ positions }) => Math.max(...positions));
  expect(heights.every((height) => height > 0.001 && height < 0.3)).toBe(true);
  // A repeated call returns the same view, also after the engine's memory grew.
  expect(book.surface(3)).toBe(surfaces[3]);
  rest(book);
  expect(book.read).toBe(12);
  book.destroy();
});

test("a held leaf follows the grab; released, it falls", async () => {
  const book = await open();
  const id = book.pickUp(Side.right, 0, 1);
  book.grab(id, 0, 1, 0);
  const tick = Math.round(1 / 60 / book.tick);
  for (let k = 0; k < 60; k++) {
    book.hold(id, 0, 0.06, 0.02, 0.07);
    book.step(tick);
    book.update();
  }
  expect(book.phase(id)).toBe(Phase.held);
  const { positions, columns } = book.surface(0);
  const corner = [...positions.slice(3 * (columns - 1), 3 * columns)];
  expect(Math.hypot(corner[0] - 0.06, corner[1] - 0.02, corner[2] - 0.07)).toBeLessThan(0.012);
  book.release(id, 0);
  expect(book.phase(id)).toBe(Phase.fallingRight);
  rest(book);
  expect([book.phase(id), book.read]).toEqual([Phase.over, 0]);
  book.destroy();
});

test("boards swing and lie down", async () => {
  const book = await WasmBook.create(size);
  expect(book.boardAngle(Cover.front)).toBe(0);
  book.playBoard(Cover.front, Side.left, 0.5);
  for (let k = 0; k < 200 && !isResting(book.stepBoard(Cover.front, 1)); k++);
  expect(book.boardAngle(Cover.front)).toBeCloseTo(Math.PI, 6);
  book.destroy();
});

test("sizes that no book has are rejected", async () => {
  for (const bad of [
    { ...size, width: 0 },
    { ...size, height: Number.NaN },
    { ...size, thickness: -1 },
    { ...size, width: Number.POSITIVE_INFINITY },
  ]) {
    await expect(WasmBook.create(bad)).rejects.toThrow("size");
  }
});

/** Returns the positions of a leaf of a paper, held by its corner for half a second. */
async function hang(change: (book: WasmBook) => void): Promise<number[]> {
  const book = await open();
  book.lay(10);
  change(book);
  const id = book.pickUp(Side.right, 10, 11);
  book.grab(id, 0, 1, 0);
  book.hold(id, 0, 0.06, 0.02, 0.07);
  book.step(Math.round(0.5 / book.tick));
  book.update();
  const positions = [...book.surface(0).positions];
  book.destroy();
  return positions;
}

test("the paper's usual figures are the engine's own", async () => {
  const usual = await hang(() => {});
  expect(await hang((book) => applyPaper({}, book))).toEqual(usual);
  expect(await hang((book) => void book.setStock("book"))).toEqual(usual);
  const figures = { grammage: 70, caliper: 90, stiffnessAlong: 0.27, stiffnessAcross: 0.12 };
  const inFigures = await hang((book) => void book.setStock(figures));
  for (const [k, x] of inFigures.entries()) expect(x).toBeCloseTo(usual[k], 6);
});

test("each paper, binding and wind hangs in its own way, and an invalid one changes nothing", async () => {
  const ways = [
    ...stocks.map((stock) => hang((book) => expect(book.setStock(stock)).toBe(true))),
    hang((book) => expect(book.setBinding("across", 0.02)).toBe(true)),
    hang((book) => expect(book.setWind([-2, 0, 0])).toBe(true)),
    hang((book) => expect(book.setScale(0.5)).toBe(true)),
  ];
  const seen = new Set((await Promise.all(ways)).map((positions) => positions.join()));
  expect(seen.size).toBe(ways.length);
  const usual = await hang(() => {});
  const rejected = await hang((book) => {
    expect(book.setStock("vellum" as never)).toBe(false);
    expect(book.setStock({} as never)).toBe(false);
    expect(book.setBinding("along", -1)).toBe(false);
    expect(book.setWind([Number.NaN, 0, 0])).toBe(false);
    for (const scale of [0, -1, 51, Number.NaN]) expect(book.setScale(scale)).toBe(false);
    applyPaper({ stock: "vellum" as never, binding: 7, wind: [1e9, 0, 0] }, book);
  });
  expect(rejected).toEqual(usual);
});

test("both piles are as thick as the leaves that lie on them", async () => {
  const book = await open();
  /** Returns the height of a side's uppermost page in its middle, metres. */
  const height = (side: Side): number => {
    const { columns, curves } = book.pile(side);
    const middle = Array.from({ length: columns }, (_, k) => k).find(
      (k) => Math.abs(curves[2 * k]) > size.width / 2,
    );
    return curves[2 * (middle ?? 0) + 1];
  };
  const read = [4, 12, 20, 28, 36];
  const heights = read.map((leaves) => {
    book.lay(leaves);
    return [height(Side.left), height(Side.right)];
  });
  for (let k = 1; k < read.length; k++) {
    // Eight leaves of forty are a fifth of the book's 12 mm.
    const grown = heights[k][0] - heights[k - 1][0];
    const shrunk = heights[k - 1][1] - heights[k][1];
    for (const change of [grown, shrunk]) expect(Math.abs(change - 0.0024)).toBeLessThan(0.0002);
  }
  book.destroy();
});
