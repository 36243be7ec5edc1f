/** Leaves that are torn out of a book in the engine through WASM. */

import { DrawnRecord } from "../drawn_record.ts";
import type { BoundRows, LeafTearing, TearOptions, TornSheet, UV } from "./book_engine.ts";
import { DrawnSurface } from "./drawn_surface.ts";
import { leafPapers } from "./leaf_papers.ts";
import { areFinite, clamp, whole, wholeTicks } from "./numbers.ts";
import { type Surface, tearLines, type Vec3 } from "./shapes.ts";
import type { Exports } from "./wasm_book.ts";

/** What the engine exports for torn leaves. */
export interface TearingExports extends Exports {
  tl_torn_new(
    book: number,
    id: number,
    line: number,
    low: number,
    high: number,
    table: number,
    rim: number,
  ): number;
  tl_torn_blank(book: number, table: number, rim: number): number;
  tl_torn_drop(leaf: number): void;
  tl_torn_step(leaf: number, book: number, ticks: number): void;
  tl_torn_sheets(): number;
  tl_torn_step_together(count: number, book: number, ticks: number): void;
  tl_torn_wake_upon(count: number, index: number, book: number): void;
  tl_torn_grab(leaf: number, grab: number, u: number, v: number): void;
  tl_torn_pull(leaf: number, grab: number, x: number, y: number, z: number): void;
  tl_torn_release(leaf: number): void;
  tl_torn_cut(leaf: number): void;
  tl_torn_bound_low(leaf: number): number;
  tl_torn_bound_high(leaf: number): number;
  tl_torn_crumple(leaf: number): number;
  tl_torn_crumpled(leaf: number): number;
  tl_torn_across(
    leaf: number,
    u0: number,
    v0: number,
    u1: number,
    v1: number,
    turns: number,
  ): number;
  tl_torn_part(leaf: number): number;
  tl_torn_opened(leaf: number): number;
  tl_torn_layer(leaf: number): number;
  tl_torn_work(leaf: number): number;
  tl_torn_asleep(leaf: number): number;
  tl_torn_surface(leaf: number): number;
}

/** Rows of a leaf's nodes. */
const nodeRows = 14;

/** Sheets that are stepped together at most. */
const mostSheets = 16;

const mostIds = 2 ** 32 - 1;
const farthest = 1000;

/**
 * Returns what tears leaves out of a book.
 *
 * @param book the book's address there
 */
export function tearingOf(wasm: TearingExports, book: number, tick: number): LeafTearing {
  return {
    tear: (id, { line, bound = [0, nodeRows], table, rim }: TearOptions) => {
      if (!areFinite([table, rim])) return null;
      const [low, high] = bound.map((row) => whole(row, nodeRows));
      const number = tearLines.indexOf(line);
      const at = wasm.tl_torn_new(book, whole(id, mostIds), number, low, high, table, rim);
      return at === 0 ? null : new WasmTornSheet(wasm, at);
    },
    rehearse: () => rehearsed(wasm, book),
    step: (sheet, ticks) => {
      if (sheet instanceof WasmTornSheet) sheet.step(book, wholeTicks(ticks, tick));
    },
    stepTogether: (sheets, ticks) => {
      const count = writeSheets(wasm, sheets);
      wasm.tl_torn_step_together(count, book, wholeTicks(ticks, tick));
    },
    wakeUpon: (sheet, sheets) => {
      const count = writeSheets(wasm, [sheet, ...sheets.filter((other) => other !== sheet)]);
      wasm.tl_torn_wake_upon(count, 0, book);
    },
  };
}

/** Writes the addresses of sheets for the engine's next call. Returns how many there are. */
function writeSheets(wasm: TearingExports, sheets: readonly TornSheet[]): number {
  const known = sheets.filter((sheet) => sheet instanceof WasmTornSheet).slice(0, mostSheets);
  const addresses = new Uint32Array(wasm.memory.buffer, wasm.tl_torn_sheets(), mostSheets);
  addresses.set(known.map((sheet) => sheet.address));
  return known.length;
}

/**
 * Tears one blank sheet across that nobody sees and crumples another, a part of that whenever it is
 * asked to go on: the code is compiled when it first runs, which takes longer than a frame has.
 *
 * @param book the book's address
 */
function* rehearsed(wasm: TearingExports, book: number): Generator<void> {
  const blank = (): WasmTornSheet | null => {
    const at = wasm.tl_torn_blank(book, 0, 0);
    return at === 0 ? null : new WasmTornSheet(wasm, at);
  };
  const torn = blank();
  yield;
  torn?.tearAcross([0, 0.5], [1, 0.5]);
  yield;
  torn?.step(book, 1);
  yield;
  torn?.cut();
  torn?.part()?.destroy();
  torn?.destroy();
  const crumpled = blank();
  yield;
  crumpled?.crumple();
  yield;
  crumpled?.step(book, 1);
  crumpled?.destroy();
}

class WasmTornSheet implements TornSheet {
  readonly #wasm: TearingExports;
  readonly #leaf: number;
  readonly #surface: DrawnSurface;

  constructor(wasm: TearingExports, leaf: number) {
    this.#wasm = wasm;
    this.#leaf = leaf;
    this.#surface = new DrawnSurface(leafPapers);
  }

  /** Its address in the engine. */
  get address(): number {
    return this.#leaf;
  }

  /** @param book address of the book on and beside which it lies */
  step(book: number, ticks: number): void {
    this.#wasm.tl_torn_step(this.#leaf, book, ticks);
  }

  get bound(): BoundRows {
    return [this.#wasm.tl_torn_bound_low(this.#leaf), this.#wasm.tl_torn_bound_high(this.#leaf)];
  }

  get isAsleep(): boolean {
    return this.#wasm.tl_torn_asleep(this.#leaf) !== 0;
  }

  get surface(): Surface {
    const [wasm, leaf] = [this.#wasm, this.#leaf];
    return this.#surface.at(new DrawnRecord(wasm.memory, wasm.tl_torn_surface(leaf)), {
      opened: wasm.tl_torn_opened(leaf),
      layer: wasm.tl_torn_layer(leaf) >>> 0,
    });
  }

  grab(u: number, v: number, grab: 0 | 1 = 0): void {
    if (!areFinite([u, v])) return;
    this.#wasm.tl_torn_grab(this.#leaf, grab, clamp(u, 0, 1), clamp(v, 0, 1));
  }

  pull(place: Vec3, grab: 0 | 1 = 0): void {
    if (!areFinite(place)) return;
    const [x, y, z] = place.map((metres) => clamp(metres, -farthest, farthest));
    this.#wasm.tl_torn_pull(this.#leaf, grab, x, y, z);
  }

  release(): void {
    this.#wasm.tl_torn_release(this.#leaf);
  }

  cut(): void {
    this.#wasm.tl_torn_cut(this.#leaf);
  }

  tearAcross(from: UV, to: UV, turns = false): boolean {
    const [u0, v0, u1, v1] = [...from, ...to].map((at) => clamp(at, 0, 1));
    if (!areFinite([u0, v0, u1, v1])) return false;
    return this.#wasm.tl_torn_across(this.#leaf, u0, v0, u1, v1, turns ? 1 : 0) !== 0;
  }

  get holdsAcross(): boolean {
    const { opened = Infinity } = this.surface;
    return opened < Infinity;
  }

  part(): TornSheet | null {
    const at = this.#wasm.tl_torn_part(this.#leaf);
    return at === 0 ? null : new WasmTornSheet(this.#wasm, at);
  }

  crumple(): boolean {
    return this.#wasm.tl_torn_crumple(this.#leaf) !== 0;
  }

  get isCrumpled(): boolean {
    return this.#wasm.tl_torn_crumpled(this.#leaf) !== 0;
  }

  takeWork(): number {
    return this.#wasm.tl_torn_work(this.#leaf);
  }

  destroy(): void {
    this.#wasm.tl_torn_drop(this.#leaf);
  }
}
