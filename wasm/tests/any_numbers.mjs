/**
 * Calls the exports of the shipped machine code with any numbers: the process that
 * `numbers.test.mjs` runs. The last call is printed where one traps.
 *
 *     node wasm/tests/any_numbers.mjs book|leaf|step SEED
 */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { drawnOf } from "./drawn.mjs";

const root = join(import.meta.dirname, "../../packages/turnleaf/src");
const [, , what, seed] = process.argv;

/** Calls of any function of each kind. */
const calls = 4000;

/** Most ticks of one call. */
const mostTicks = 7200;

async function load(file) {
  const code = readFileSync(join(root, file));
  return (await WebAssembly.instantiate(code, {})).instance.exports;
}

/** SplitMix32-like numbers of a seed, 0 to 1. */
function randomOf(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x9e3779b9) >>> 0;
    let z = Math.imul(state ^ (state >>> 16), 0x21f0aaad);
    z = Math.imul(z ^ (z >>> 15), 0x735a2d97);
    return ((z ^ (z >>> 15)) >>> 0) / 2 ** 32;
  };
}

const random = randomOf(Number(seed));
const below = (count) => Math.floor(random() * count);
const pick = (list) => list[below(list.length)];

const strange = [
  Number.NaN,
  Number.POSITIVE_INFINITY,
  Number.NEGATIVE_INFINITY,
  -0,
  -1,
  1e-300,
  Number.MAX_VALUE,
  -Number.MAX_VALUE,
  2 ** 31,
  2 ** 32 - 1,
  1e9,
  undefined,
];

/** A number that is sensible in four of five cases. */
function any() {
  const kind = below(10);
  if (kind < 2) return pick(strange);
  if (kind < 6) return below(6);
  return random() * 2 - 0.5;
}

/** Calls functions, each with any numbers but for its first, a handle. */
function callAny(engine, handles, names, isLong) {
  for (let k = 0; k < calls; k++) {
    const name = pick(names);
    const handle = below(20) === 0 ? any() : pick(handles);
    const rest = Array.from({ length: engine[name].length - 1 }, any);
    // A minute of each costs more than a test has.
    if (isLong(name, rest)) continue;
    const words = `${name}(${[handle, ...rest].join(", ")})`;
    try {
      engine[name](handle, ...rest);
    } catch (error) {
      throw new Error(`Call ${k}: ${words} trapped.`, { cause: error });
    }
  }
}

async function books() {
  const engine = await load("engine/turnleaf.wasm");
  const handles = [
    engine.tl_book_new(0.14, 0.21, 40, 0.004),
    engine.tl_book_new(0.02, 0.05, 300, 0.03),
  ];
  for (let k = 0; k < 100; k++) {
    const book = engine.tl_book_new(any(), any(), any(), any());
    engine.tl_book_drop(book);
  }
  const names = Object.keys(engine).filter(
    (name) => /^tl_(book|board)_/.test(name) && !/_(new|drop)$/.test(name),
  );
  const steps = (ticks) => ticks >>> 0 > 120;
  callAny(engine, handles, names, (name, [a]) => name === "tl_book_step" && steps(a));
  for (const book of handles) {
    engine.tl_book_update(book);
    for (let index = 0; index < engine.tl_book_flights(book); index++) {
      for (const drawn of drawnOf(engine, book, index)) {
        assert.ok(drawn.every(Number.isFinite), `flight ${index}`);
      }
    }
    engine.tl_book_drop(book);
    engine.tl_book_drop(book);
    assert.equal(engine.tl_book_lift(book, 0, 0, 1), 0);
  }
}

async function leaves() {
  const engine = await load("models/models.wasm");
  const make = (change) => {
    const room = engine.tl_leaf_figures();
    const usual = [0, 0.148, 0.21, 0.07, 90e-6, 0.27e-3, 0.12e-3, 0, 9.8, 1];
    const rest = [0, 0, 0, 9, 7, 0, 0, 0.6, 0, 0, 0.5];
    const figures = [...usual, ...rest];
    change(figures);
    new Float64Array(engine.memory.buffer, room, figures.length).set(figures);
    return engine.tl_leaf_new(room);
  };
  const kinds = [1, 2, 4, 5, 6, 7];
  const handles = kinds.map((kind) => make((figures) => figures.fill(kind, 0, 1)));
  assert.ok(handles.every((handle) => handle !== 0));
  for (let k = 0; k < 300; k++) {
    const leaf = make((figures) => {
      figures[0] = pick(kinds);
      for (let change = 0; change < 3; change++) figures[below(figures.length)] = any();
    });
    if (leaf !== 0) engine.tl_leaf_advance(leaf, engine.tl_leaf_step(leaf));
    engine.tl_leaf_drop(leaf);
    assert.equal(engine.tl_leaf_new(any()), 0);
  }
  const names = Object.keys(engine).filter(
    (name) => /^tl_leaf_/.test(name) && !/_(new|drop|figures|error|error_length|hash)$/.test(name),
  );
  callAny(engine, handles, names, (name, [a]) => name === "tl_leaf_advance" && a > 0.1);
  for (const leaf of handles) engine.tl_leaf_drop(leaf);
}

/** The height of a leaf that a hand holds up, and of a board, after so many ticks. */
function heldFor(engine, ticks) {
  const book = engine.tl_book_new(0.14, 0.21, 40, 0.004);
  const id = engine.tl_book_lift(book, 0, 0, 1);
  engine.tl_book_grab(book, id, 0, 1, 0.1);
  engine.tl_book_hold(book, id, 0, 0.05, 0.03, 0.1);
  engine.tl_book_step(book, ticks);
  engine.tl_book_update(book);
  const drawn = [...drawnOf(engine, book, 0)[0]];
  engine.tl_board_hold(book, 0, 1);
  engine.tl_board_step(book, 0, ticks);
  drawn.push(engine.tl_board_angle(book, 0));
  engine.tl_book_drop(book);
  return drawn;
}

async function steps() {
  const engine = await load("engine/turnleaf.wasm");
  const most = heldFor(engine, mostTicks);
  for (const ticks of [-1, 2 ** 31]) {
    assert.deepEqual(heldFor(engine, ticks), most, `${ticks} ticks`);
  }
  assert.deepEqual(heldFor(engine, Number.NaN), heldFor(engine, 0));
}

await { book: books, leaf: leaves, step: steps }[what]();
