/**
 * The engine through its WASM face: one instance a book, so that dropping the
 * book frees all of its memory. Numbers and flat arrays alone cross the wall.
 */

import type { Pile, Surface } from "./shapes.ts";
import code from "./turnleaf.wasm";

/** A side of the open book, as the engine counts them. */
export const Side = { right: 0, left: 1 } as const;
export type Side = (typeof Side)[keyof typeof Side];

/** What a leaf or a board is doing. */
export const Phase = {
  restingRight: 0,
  restingLeft: 1,
  held: 2,
  fallingRight: 3,
  playing: 4,
  fallingLeft: 5,
} as const;
export type Phase = (typeof Phase)[keyof typeof Phase];

/** Which cover board. */
export const Cover = { front: 0, back: 1 } as const;
export type Cover = (typeof Cover)[keyof typeof Cover];

/** Length of the engine's tick in seconds. */
export const tickSeconds: number = 1 / 240;

/** Whether a phase is one of rest. */
export function isResting(phase: Phase): boolean {
  return phase === Phase.restingRight || phase === Phase.restingLeft;
}

interface Exports {
  memory: WebAssembly.Memory;
  tl_book_new(width: number, height: number, leaves: number, thickness: number): number;
  tl_book_drop(book: number): void;
  tl_book_lay(book: number, read: number): void;
  tl_book_lift(book: number, side: Side, low: number, high: number): void;
  tl_book_grab(book: number, u: number, v: number): void;
  tl_book_hold(book: number, x: number, y: number, z: number): void;
  tl_book_release(book: number): void;
  tl_book_play(book: number, side: Side, seconds: number): void;
  tl_book_step(book: number, ticks: number): Phase;
  tl_book_update(book: number): void;
  tl_book_columns(book: number): number;
  tl_book_rows(book: number): number;
  tl_book_layers(book: number): number;
  tl_book_u(book: number): number;
  tl_book_positions(book: number): number;
  tl_book_normals(book: number): number;
  tl_book_version(book: number): number;
  tl_book_pile(book: number, side: Side): number;
  tl_board_hold(book: number, cover: Cover, angle: number): void;
  tl_board_release(book: number, cover: Cover): void;
  tl_board_play(book: number, cover: Cover, side: Side, seconds: number): void;
  tl_board_lay(book: number, cover: Cover, side: Side): void;
  tl_board_step(book: number, cover: Cover, ticks: number): Phase;
  tl_board_angle(book: number, cover: Cover): number;
}

let compiled: Promise<WebAssembly.Module> | undefined;

/** Compiles the engine once a page, at the first book. */
function compile(): Promise<WebAssembly.Module> {
  compiled ??= (async () => {
    const bytes = Uint8Array.from(atob(code), (c) => c.charCodeAt(0));
    return WebAssembly.compile(bytes);
  })();
  return compiled;
}

/** The size of a book as the engine sees it. */
export interface BookSize {
  /** A page's width and height, metres. */
  readonly width: number;
  readonly height: number;
  /** Leaves of paper, boards not counted. */
  readonly leaves: number;
  /** Thickness of all the paper together, metres. */
  readonly thickness: number;
}

/** One bound book in the engine, with at most one leaf of paper in flight. */
export class EngineBook {
  readonly #wasm: Exports;
  readonly #book: number;
  #surface: Surface | undefined;
  readonly #piles: (Pile | undefined)[] = [undefined, undefined];

  private constructor(wasm: Exports, size: BookSize) {
    this.#wasm = wasm;
    this.#book = wasm.tl_book_new(size.width, size.height, size.leaves, size.thickness);
    if (this.#book === 0) throw new Error("The engine refused a book of this size.");
  }

  /** Makes a book. Rejects where WebAssembly is not to be had. */
  static async create(size: BookSize): Promise<EngineBook> {
    const instance = await WebAssembly.instantiate(await compile(), {});
    return new EngineBook(instance.exports as unknown as Exports, size);
  }

  /** Frees the book in the engine. Nothing may be called afterwards. */
  destroy(): void {
    this.#wasm.tl_book_drop(this.#book);
  }

  /** Lays the book open with `read` leaves of paper on the left and none in flight. */
  lay(read: number): void {
    this.#wasm.tl_book_lay(this.#book, read);
  }

  /** Takes up the uppermost leaf of `side`; with it on the right `low` leaves are read, on the left `high`. */
  lift(side: Side, low: number, high: number): void {
    this.#wasm.tl_book_lift(this.#book, side, low, high);
  }

  /** A hand takes hold of the leaf in flight at (u, v). */
  grab(u: number, v: number): void {
    this.#wasm.tl_book_grab(this.#book, u, v);
  }

  /** The hand pulls what it holds to a place in book space, metres. */
  hold(x: number, y: number, z: number): void {
    this.#wasm.tl_book_hold(this.#book, x, y, z);
  }

  /** The hand lets go. */
  release(): void {
    this.#wasm.tl_book_release(this.#book);
  }

  /** Plays the recorded turn to `side` from where the leaf is, `seconds` for a whole one. */
  play(side: Side, seconds: number): void {
    this.#wasm.tl_book_play(this.#book, side, seconds);
  }

  /** Steps the leaf by whole ticks of `tickSeconds`; answers what it is doing then. */
  step(ticks: number): Phase {
    return this.#wasm.tl_book_step(this.#book, ticks);
  }

  /** Brings surface and piles up to date with the last step. */
  update(): void {
    this.#wasm.tl_book_update(this.#book);
  }

  /** u of each column of leaves and piles, as a view of the engine's memory. */
  get columns(): Float32Array {
    const wasm = this.#wasm;
    const count = wasm.tl_book_columns(this.#book);
    return new Float32Array(wasm.memory.buffer, wasm.tl_book_u(this.#book), count);
  }

  /** The leaf in flight, as a view of the engine's memory. */
  get surface(): Surface {
    const wasm = this.#wasm;
    const version = wasm.tl_book_version(this.#book);
    let surface = this.#surface;
    if (surface === undefined || surface.positions.buffer !== wasm.memory.buffer) {
      const columns = wasm.tl_book_columns(this.#book);
      const rows = wasm.tl_book_rows(this.#book);
      const view = (at: number) => new Float32Array(wasm.memory.buffer, at, 3 * columns * rows);
      surface = {
        columns,
        rows,
        positions: view(wasm.tl_book_positions(this.#book)),
        normals: view(wasm.tl_book_normals(this.#book)),
        version,
      };
    } else if (surface.version !== version) {
      surface = { ...surface, version };
    }
    this.#surface = surface;
    return surface;
  }

  /** The pages at rest on `side`, as a view of the engine's memory. */
  pile(side: Side): Pile {
    const wasm = this.#wasm;
    let pile = this.#piles[side];
    if (pile === undefined || pile.curves.buffer !== wasm.memory.buffer) {
      const columns = wasm.tl_book_columns(this.#book);
      const layers = wasm.tl_book_layers(this.#book);
      const at = wasm.tl_book_pile(this.#book, side);
      const curves = new Float32Array(wasm.memory.buffer, at, 2 * columns * layers);
      pile = { columns, layers, curves };
      this.#piles[side] = pile;
    }
    return pile;
  }

  /** A hand holds a board at an angle (radians from the right-hand side). */
  holdBoard(cover: Cover, angle: number): void {
    this.#wasm.tl_board_hold(this.#book, cover, angle);
  }

  /** The hand lets a board go. */
  releaseBoard(cover: Cover): void {
    this.#wasm.tl_board_release(this.#book, cover);
  }

  /** Swings a board to `side`, `seconds` for a whole half turn. */
  playBoard(cover: Cover, side: Side, seconds: number): void {
    this.#wasm.tl_board_play(this.#book, cover, side, seconds);
  }

  /** Puts a board down on `side` at once. */
  layBoard(cover: Cover, side: Side): void {
    this.#wasm.tl_board_lay(this.#book, cover, side);
  }

  /** Steps a board by whole ticks; answers what it is doing then. */
  stepBoard(cover: Cover, ticks: number): Phase {
    return this.#wasm.tl_board_step(this.#book, cover, ticks);
  }

  /** A board's angle from the right-hand side, radians. */
  boardAngle(cover: Cover): number {
    return this.#wasm.tl_board_angle(this.#book, cover);
  }
}
