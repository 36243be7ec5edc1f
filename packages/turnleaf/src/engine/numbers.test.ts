/**
 * Every number passed to the engine's WASM is valid, whatever the book's
 * methods are called with.
 */

import { afterEach, expect, test, vi } from "vitest";
import { applyPaper, type Paper } from "../book/paper.ts";
import { PeeledBook } from "../canvas2d/peeled_book.ts";
import type { BookEngine, BookSize } from "./book_engine.ts";
import { Cover, maxGrabs, Side } from "./phases.ts";
import type { StockFigures, Vec3 } from "./shapes.ts";
import { WasmBook } from "./wasm_book.ts";

const size = { width: 0.14, height: 0.21, leaves: 40, thickness: 0.012 };

const nasty = [
  Number.NaN,
  Number.POSITIVE_INFINITY,
  Number.NEGATIVE_INFINITY,
  -1,
  -0.5,
  0,
  -0,
  0.5,
  1.5,
  1e9,
  2 ** 32,
  -(2 ** 31),
  1e39,
  -1e308,
  5e-324,
];

/** Arguments that WASM takes as unsigned integers, by function and position after the book. */
const counts: Readonly<Record<string, readonly number[]>> = {
  tl_book_new: [2],
  tl_book_set_stock: [0],
  tl_book_set_binding: [0],
  tl_book_set_assist: [0],
  tl_book_lay: [0],
  tl_book_lift: [0, 1, 2],
  tl_book_grab: [0, 1],
  tl_book_hold: [0, 1],
  tl_book_release: [0, 1],
  tl_book_play: [0, 1],
  tl_book_step_frame: [0],
  tl_book_phase: [0],
  tl_book_surface: [0],
  tl_book_dress: [0],
  tl_book_pile: [0],
  tl_board_hold: [0],
  tl_board_release: [0],
  tl_board_play: [0, 1],
  tl_board_lay: [0, 1],
  tl_board_step: [0, 1],
  tl_board_angle: [0],
};

afterEach(() => vi.restoreAllMocks());

/** Returns a list of the invalid arguments that reach WASM, by call. */
function watchWasm(): string[] {
  const faults: string[] = [];
  const { instantiate } = WebAssembly;
  vi.spyOn(WebAssembly, "instantiate").mockImplementation((async (
    module: WebAssembly.Module,
    imports: WebAssembly.Imports,
  ) => {
    const instance = await instantiate(module, imports);
    const { exports } = instance;
    // Node's own `Response` runs on WASM.
    if (!("tl_tick" in exports)) return instance;
    const watched = Object.entries(exports).map(([name, value]) => {
      if (typeof value !== "function") return [name, value];
      const call = (...passed: number[]): unknown => {
        const [, ...own] = name === "tl_book_new" ? [0, ...passed] : passed;
        const isTaken = own.every(
          (number, place) =>
            Number.isFinite(Math.fround(number)) &&
            (!counts[name]?.includes(place) || (Number.isInteger(number) && number >= 0)),
        );
        if (!isTaken) faults.push(`${name}(${passed})`);
        return value(...passed);
      };
      return [name, call];
    });
    return { exports: Object.fromEntries(watched) };
  }) as typeof WebAssembly.instantiate);
  return faults;
}

/** Returns a generator of numbers from 0 to 1, the same for the same seed. */
function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/**
 * Calls a book's methods at random. Returns whether every drawn number was
 * finite after each call.
 */
function askAtRandom(book: BookEngine, seed: number, questions: number): boolean {
  const random = randomNumbers(seed);
  const among = <T>(values: readonly T[]): T => values[Math.floor(random() * values.length)];
  /** Usually a number in bounds, now and then an invalid one. */
  const number = (least: number, most: number): number =>
    random() < 0.25 ? among(nasty) : least + (most - least) * random();
  const count = (most: number): number =>
    random() < 0.25 ? among(nasty) : Math.floor((most + 1) * random());
  const side = (): Side => among([Side.left, Side.right]);
  const cover = (): Cover => among([Cover.front, Cover.back]);
  const vector = (): Vec3 => [number(-0.3, 0.3), number(-0.3, 0.3), number(-0.3, 0.3)];
  const figures = (): StockFigures => ({
    grammage: number(20, 400),
    caliper: number(30, 500),
    stiffnessAlong: number(0.01, 10),
    stiffnessAcross: number(0.01, 10),
  });
  let id = 0;
  const anId = (): number => (random() < 0.2 ? among(nasty) : id);
  const asks: readonly (() => void)[] = [
    () => book.lay(count(40)),
    () => {
      const read = book.read;
      id = book.pickUp(Side.right, read, read + 1) || id;
    },
    () => {
      id = book.pickUp(side(), count(40), count(40)) || id;
    },
    () => book.grab(anId(), count(maxGrabs), number(0, 1), number(0, 1)),
    () => book.hold(anId(), count(maxGrabs), ...vector()),
    () => book.release(anId(), count(maxGrabs)),
    () => book.play(anId(), side(), number(0.1, 2)),
    () => {
      if (random() < 0.5) book.beginFrame();
      book.stepFrame(random() < 0.9 ? Math.floor(13 * random()) : among([Number.NaN, -1, -0.5]));
    },
    () => void book.phase(anId()),
    () => book.holdBoard(cover(), number(0, Math.PI)),
    () => book.releaseBoard(cover()),
    () => book.playBoard(cover(), side(), number(0.1, 2)),
    () => book.layBoard(cover(), side()),
    () => void book.stepBoard(cover(), count(12)),
    () => void book.setStock(random() < 0.1 ? figures() : "book"),
    () => void book.setBinding("along", number(0, 1)),
    () => void book.setWind(vector()),
  ];
  for (let k = 0; k < questions; k++) {
    among(asks)();
    book.update();
    for (let index = 0; index < book.flights; index++) {
      if (!book.surface(index).positions.every(Number.isFinite)) return false;
    }
    for (const on of [Side.left, Side.right]) {
      if (!book.pile(on).curves.every(Number.isFinite)) return false;
    }
    if (![Cover.front, Cover.back].every((cover) => Number.isFinite(book.boardAngle(cover))))
      return false;
  }
  return true;
}

for (const [over, create] of [
  ["the engine", (size: BookSize): Promise<BookEngine> => WasmBook.create(size)],
  ["flat leaves", async (size: BookSize): Promise<BookEngine> => new PeeledBook(size)],
] as const) {
  test(`whatever ${over} is asked, what is drawn are numbers`, async () => {
    const faults = watchWasm();
    for (const seed of [1, 2, 3, 4]) {
      const book = await create(size);
      expect(askAtRandom(book, seed, 600), `seed ${seed}`).toBe(true);
      book.destroy();
    }
    expect(faults).toEqual([]);
  });

  test(`time that goes backwards, or is none, moves nothing of ${over}`, async () => {
    const book = await create(size);
    book.lay(10);
    const id = book.pickUp(Side.right, 10, 11);
    book.play(id, Side.left, 0.8);
    book.beginFrame();
    book.stepFrame(20);
    book.update();
    const before = [...book.surface(0).positions];
    for (const ticks of [-1, -0.5, Number.NaN, Number.NEGATIVE_INFINITY, 0, 0.5]) {
      book.beginFrame();
      book.stepFrame(ticks);
    }
    book.update();
    expect([...book.surface(0).positions]).toEqual(before);
    // And no number of ticks takes for ever.
    for (let frame = 0; frame < 200 && book.flights > 0; frame++) {
      book.beginFrame();
      book.stepFrame(Number.POSITIVE_INFINITY);
    }
    expect([book.flights, book.read]).toEqual([0, 11]);
    book.destroy();
  });
}

test("no book is made of sizes that are none", async () => {
  const faults = watchWasm();
  for (const key of ["width", "height", "leaves", "thickness"] as const) {
    for (const value of nasty.filter((value) => !(value >= 0 && value < 2) || key === "leaves")) {
      if (value === 0) continue;
      await expect(WasmBook.create({ ...size, [key]: value }), `${key} ${value}`).rejects.toThrow(
        "The engine does not accept a book of this size.",
      );
    }
  }
  expect(faults).toEqual([]);
});

test("paper that is none is the usual paper", async () => {
  const faults = watchWasm();
  const book = await WasmBook.create(size);
  for (const value of nasty) {
    const stock = {
      grammage: value,
      caliper: value,
      stiffnessAlong: value,
      stiffnessAcross: value,
    };
    const papers: Paper[] = [
      { stock },
      { stock: "none" as Paper["stock"] },
      { binding: value },
      { wind: [0, value, 0] },
      { wind: [] as unknown as Vec3 },
    ];
    for (const paper of papers) applyPaper(paper, book);
  }
  expect(faults).toEqual([]);
  book.destroy();
});
