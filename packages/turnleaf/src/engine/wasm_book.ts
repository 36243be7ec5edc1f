/**
 * The engine through WASM: one instance per book, so that dropping the book
 * frees all of its memory. Only numbers and flat arrays cross the boundary.
 */

import { DrawnRecord } from "../drawn_record.ts";
import type { BookEngine, BookSize } from "./book_engine.ts";
import { DrawnSurface } from "./drawn_surface.ts";
import { engineCode } from "./machine_code.ts";
import { areFinite, clamp, isGrab, turnSeconds, whole, wholeTicks } from "./numbers.ts";
import type { Cover, Phase, Side } from "./phases.ts";
import {
  type LeafPapers,
  type LeafStockName,
  leafStockNames,
  type Pile,
  type Stock,
  type StockFigures,
  type Surface,
  stocks,
  type Vec3,
} from "./shapes.ts";

/** The functions of the engine's WASM. */
export interface Exports {
  memory: WebAssembly.Memory;
  tl_tick(): number;
  tl_book_new(width: number, height: number, leaves: number, thickness: number): number;
  tl_book_drop(book: number): void;
  tl_book_set_stock(book: number, stock: number): number;
  tl_book_set_figures(
    book: number,
    grammage: number,
    caliper: number,
    along: number,
    across: number,
  ): number;
  tl_book_set_leaf_stock(book: number, first: number, end: number, stock: number): number;
  tl_book_set_leaf_figures(
    book: number,
    first: number,
    end: number,
    grammage: number,
    caliper: number,
    along: number,
    across: number,
  ): number;
  tl_book_set_binding(book: number, acrossSpine: number, stiffness: number): number;
  tl_book_set_wind(book: number, x: number, y: number, z: number): number;
  tl_book_set_assist(book: number, on: number): void;
  tl_book_set_scale(book: number, scale: number): number;
  tl_book_lay(book: number, read: number): void;
  tl_book_lift(book: number, side: Side, low: number, high: number): number;
  tl_book_grab(book: number, id: number, grab: number, u: number, v: number): void;
  tl_book_hold(book: number, id: number, grab: number, x: number, y: number, z: number): void;
  tl_book_release(book: number, id: number, grab: number): void;
  tl_book_play(book: number, id: number, side: Side, seconds: number): void;
  tl_book_step(book: number, ticks: number): void;
  tl_book_asleep(book: number): number;
  tl_book_begin_frame(book: number): void;
  tl_book_step_frame(book: number, ticks: number): number;
  tl_book_phase(book: number, id: number): Phase;
  tl_book_read(book: number): number;
  tl_book_flights(book: number): number;
  tl_book_update(book: number): void;
  tl_book_columns(book: number): number;
  tl_book_rows(book: number): number;
  tl_book_layers(book: number): number;
  tl_book_u(book: number): number;
  tl_book_surface(book: number, index: number): number;
  tl_book_dress(book: number, index: number): number;
  tl_book_pile(book: number, side: Side): number;
  tl_board_hold(book: number, cover: Cover, angle: number): void;
  tl_board_release(book: number, cover: Cover): void;
  tl_board_play(book: number, cover: Cover, side: Side, seconds: number): void;
  tl_board_lay(book: number, cover: Cover, side: Side): void;
  tl_board_step(book: number, cover: Cover, ticks: number): Phase;
  tl_board_angle(book: number, cover: Cover): number;
}

/**
 * Bounds of arguments: numbers of flights, of flights at once, of leaves;
 * metres from the spine.
 */
const mostIds = 2 ** 32 - 1;
const mostFlights = 16;
const mostLeaves = 1e6;
const farthest = 1000;

/**
 * One bound book in the engine, with several leaves of paper in flight. A
 * flight is identified by the number that `lift` returns; a command to one that
 * is over changes nothing. Flights are listed from left to right.
 *
 * Numbers are clamped to what the engine accepts, places to 1 km, and a command
 * with a place that is not a number does nothing.
 */
export class WasmBook implements BookEngine {
  readonly tick: number;
  protected readonly wasm: Exports;
  /** The book's address there. */
  protected readonly book: number;
  readonly #leaves: number;
  /** Surfaces by the address of their positions: the engine reuses a few. */
  readonly #surfaces = new Map<number, DrawnSurface>();
  /** Finds what of its leaves may lie on other paper. */
  protected readonly papers: LeafPapers | undefined;
  readonly #piles: (Pile | undefined)[] = [undefined, undefined];

  protected constructor(wasm: Exports, size: BookSize) {
    this.wasm = wasm;
    const { width, height, leaves, thickness } = size;
    this.tick = wasm.tl_tick();
    this.#leaves = whole(leaves, mostLeaves);
    const isBook = this.#leaves === leaves && areFinite([width, height, thickness]);
    this.book = isBook ? wasm.tl_book_new(width, height, leaves, thickness) : 0;
    if (this.book === 0) throw new Error("The engine does not accept a book of this size.");
  }

  /** Makes a book with the compiled code, by default that in the package. Rejects if WebAssembly is unavailable. */
  static async create(
    size: BookSize,
    code: Promise<WebAssembly.Module> = engineCode(),
  ): Promise<WasmBook> {
    const instance = await WebAssembly.instantiate(await code, {});
    return new WasmBook(instance.exports as unknown as Exports, size);
  }

  another(size: BookSize): BookEngine {
    return new WasmBook(this.wasm, size);
  }

  destroy(): void {
    this.wasm.tl_book_drop(this.book);
  }

  setStock(stock: Stock | StockFigures): boolean {
    if (typeof stock === "string") {
      const number = stocks.indexOf(stock);
      return number >= 0 && this.#changed(this.wasm.tl_book_set_stock(this.book, number));
    }
    const figures = inUnits(stock);
    if (!areFinite(figures)) return false;
    return this.#changed(this.wasm.tl_book_set_figures(this.book, ...figures));
  }

  setLeafStock(first: number, end: number, stock: LeafStockName | StockFigures): boolean {
    if (!isRange(first, end, this.#leaves)) return false;
    const [wasm, book] = [this.wasm, this.book];
    if (typeof stock === "string") {
      const number = leafStockNames.indexOf(stock);
      return number >= 0 && this.#changed(wasm.tl_book_set_leaf_stock(book, first, end, number));
    }
    const figures = inUnits(stock);
    if (!areFinite(figures)) return false;
    return this.#changed(wasm.tl_book_set_leaf_figures(book, first, end, ...figures));
  }

  setBinding(grain: "along" | "across", stiffness: number): boolean {
    const across = grain === "across" ? 1 : 0;
    if (!areFinite([stiffness])) return false;
    return this.#changed(this.wasm.tl_book_set_binding(this.book, across, stiffness));
  }

  setWind(wind: Vec3): boolean {
    const [x, y, z] = wind;
    if (!areFinite([x, y, z])) return false;
    return this.#changed(this.wasm.tl_book_set_wind(this.book, x, y, z));
  }

  setAssist(on: boolean): void {
    this.wasm.tl_book_set_assist(this.book, on ? 1 : 0);
    this.#changed(1);
  }

  setScale(scale: number): boolean {
    return this.#changed(this.wasm.tl_book_set_scale(this.book, scale));
  }

  /** New leaves lie elsewhere in the engine's memory: views of the old ones are invalid. */
  #changed(result: number): boolean {
    this.#surfaces.clear();
    return result !== 0;
  }

  lay(read: number): void {
    this.wasm.tl_book_lay(this.book, whole(read, this.#leaves));
  }

  pickUp(side: Side, low: number, high: number): number {
    const most = this.#leaves;
    return this.wasm.tl_book_lift(this.book, side, whole(low, most), whole(high, most));
  }

  grab(id: number, grab: number, u: number, v: number): void {
    if (!isGrab(grab, u, v)) return;
    const [inU, inV] = [clamp(u, 0, 1), clamp(v, 0, 1)];
    this.wasm.tl_book_grab(this.book, whole(id, mostIds), grab, inU, inV);
  }

  hold(id: number, grab: number, x: number, y: number, z: number): void {
    if (!isGrab(grab, x, y, z)) return;
    const near = (metres: number): number => clamp(metres, -farthest, farthest);
    this.wasm.tl_book_hold(this.book, whole(id, mostIds), grab, near(x), near(y), near(z));
  }

  release(id: number, grab: number): void {
    if (isGrab(grab)) this.wasm.tl_book_release(this.book, whole(id, mostIds), grab);
  }

  play(id: number, side: Side, seconds: number): void {
    this.wasm.tl_book_play(this.book, whole(id, mostIds), side, turnSeconds(seconds));
  }

  /** Steps all flights by whole ticks, however much work they are: for tests of motions. */
  step(ticks: number): void {
    this.wasm.tl_book_step(this.book, wholeTicks(ticks, this.tick));
  }

  beginFrame(): void {
    this.wasm.tl_book_begin_frame(this.book);
  }

  stepFrame(ticks: number): number {
    return this.wasm.tl_book_step_frame(this.book, wholeTicks(ticks, this.tick));
  }

  get isAsleep(): boolean {
    return this.wasm.tl_book_asleep(this.book) !== 0;
  }

  phase(id: number): Phase {
    return this.wasm.tl_book_phase(this.book, whole(id, mostIds));
  }

  get read(): number {
    return this.wasm.tl_book_read(this.book);
  }

  get flights(): number {
    return this.wasm.tl_book_flights(this.book);
  }

  update(): void {
    this.wasm.tl_book_update(this.book);
  }

  get columns(): Float32Array {
    const wasm = this.wasm;
    const count = wasm.tl_book_columns(this.book);
    return new Float32Array(wasm.memory.buffer, wasm.tl_book_u(this.book), count);
  }

  surface(index: number): Surface {
    const at = this.wasm.tl_book_surface(this.book, whole(index, mostFlights));
    const record = new DrawnRecord(this.wasm.memory, at);
    const surface = this.#surfaces.get(record.address) ?? new DrawnSurface(this.papers);
    this.#surfaces.set(record.address, surface);
    return surface.at(record);
  }

  overrideSurface(index: number): Float32Array | null {
    const wasm = this.wasm;
    const at = wasm.tl_book_dress(this.book, whole(index, mostFlights));
    const count = wasm.tl_book_columns(this.book) * wasm.tl_book_rows(this.book);
    return at === 0 ? null : new Float32Array(wasm.memory.buffer, at, 3 * count);
  }

  pile(side: Side): Pile {
    const wasm = this.wasm;
    let pile = this.#piles[side];
    if (pile === undefined || pile.curves.buffer !== wasm.memory.buffer) {
      const columns = wasm.tl_book_columns(this.book);
      const layers = wasm.tl_book_layers(this.book);
      const at = wasm.tl_book_pile(this.book, side);
      const curves = new Float32Array(wasm.memory.buffer, at, 2 * columns * layers);
      pile = { columns, layers, curves };
      this.#piles[side] = pile;
    }
    return pile;
  }

  holdBoard(cover: Cover, angle: number): void {
    if (areFinite([angle])) this.wasm.tl_board_hold(this.book, cover, clamp(angle, 0, Math.PI));
  }

  releaseBoard(cover: Cover): void {
    this.wasm.tl_board_release(this.book, cover);
  }

  playBoard(cover: Cover, side: Side, seconds: number): void {
    this.wasm.tl_board_play(this.book, cover, side, turnSeconds(seconds));
  }

  layBoard(cover: Cover, side: Side): void {
    this.wasm.tl_board_lay(this.book, cover, side);
  }

  stepBoard(cover: Cover, ticks: number): Phase {
    return this.wasm.tl_board_step(this.book, cover, wholeTicks(ticks, this.tick));
  }

  boardAngle(cover: Cover): number {
    return this.wasm.tl_board_angle(this.book, cover);
  }
}

/** Returns the figures of a stock in the engine's units: kg/m^2, m, N m. */
function inUnits({ grammage, caliper, stiffnessAlong, stiffnessAcross }: StockFigures) {
  return [grammage * 1e-3, caliper * 1e-6, stiffnessAlong * 1e-3, stiffnessAcross * 1e-3] as const;
}

/** Returns whether there are leaves from `first` to before `end` among so many. */
function isRange(first: number, end: number, leaves: number): boolean {
  return [first, end].every(Number.isInteger) && first >= 0 && first < end && end <= leaves;
}
