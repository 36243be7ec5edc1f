/** Flaps of fold-outs in the engine through WASM. */

import { DrawnRecord } from "../drawn_record.ts";
import type { FlapPlace, FlapSheet } from "./book_engine.ts";
import { DrawnSurface } from "./drawn_surface.ts";
import { leafPapers } from "./leaf_papers.ts";
import { areFinite, clamp, whole, wholeTicks } from "./numbers.ts";
import type { Surface, Vec3 } from "./shapes.ts";
import type { Exports } from "./wasm_book.ts";

/** What the engine exports for flaps. */
export interface FlapExports extends Exports {
  tl_flap_new(
    book: number,
    on: number,
    fold: number,
    width: number,
    panels: number,
    table: number,
    rim: number,
  ): number;
  tl_flap_drop(flap: number): void;
  tl_flap_step(flap: number, book: number, ticks: number): void;
  tl_flap_grab(flap: number, u: number, v: number): void;
  tl_flap_pull(flap: number, x: number, y: number, z: number): void;
  tl_flap_release(flap: number): void;
  tl_flap_turn(flap: number, isToOpen: number): void;
  tl_flap_angle(flap: number): number;
  tl_flap_asleep(flap: number): number;
  tl_flap_surface(flap: number): number;
}

const farthest = 1000;

/** More panels than the engine folds are asked for as this many. */
const mostPanels = 255;

/**
 * Returns what makes flaps on the pages of a book.
 *
 * @param book the book's address there
 */
export function flapsOf(
  wasm: FlapExports,
  book: number,
  tick: number,
): (place: FlapPlace) => FlapSheet | null {
  return ({ side, fold, width, panels, table, rim }) => {
    if (!areFinite([fold, width, table, rim])) return null;
    const count = whole(panels, mostPanels);
    const flap = wasm.tl_flap_new(book, side, fold, width, count, table, rim);
    return flap === 0 ? null : new WasmFlap(wasm, book, flap, tick);
  };
}

class WasmFlap implements FlapSheet {
  readonly #wasm: FlapExports;
  readonly #book: number;
  readonly #flap: number;
  readonly #tick: number;
  readonly #surface: DrawnSurface;

  constructor(wasm: FlapExports, book: number, flap: number, tick: number) {
    this.#wasm = wasm;
    this.#book = book;
    this.#flap = flap;
    this.#tick = tick;
    this.#surface = new DrawnSurface(leafPapers);
  }

  get isAsleep(): boolean {
    return this.#wasm.tl_flap_asleep(this.#flap) !== 0;
  }

  get angle(): number {
    return this.#wasm.tl_flap_angle(this.#flap);
  }

  get surface(): Surface {
    const at = this.#wasm.tl_flap_surface(this.#flap);
    return this.#surface.at(new DrawnRecord(this.#wasm.memory, at));
  }

  grab(u: number, v: number): void {
    if (areFinite([u, v])) this.#wasm.tl_flap_grab(this.#flap, clamp(u, 0, 1), clamp(v, 0, 1));
  }

  pull(place: Vec3): void {
    if (!areFinite(place)) return;
    const [x, y, z] = place.map((metres) => clamp(metres, -farthest, farthest));
    this.#wasm.tl_flap_pull(this.#flap, x, y, z);
  }

  release(): void {
    this.#wasm.tl_flap_release(this.#flap);
  }

  turn(isToOpen: boolean): void {
    this.#wasm.tl_flap_turn(this.#flap, isToOpen ? 1 : 0);
  }

  step(ticks: number): void {
    this.#wasm.tl_flap_step(this.#flap, this.#book, wholeTicks(ticks, this.#tick));
  }

  destroy(): void {
    this.#wasm.tl_flap_drop(this.#flap);
  }
}
