/**
 * A book in the engine whose leaves can be creased, torn out and folded out: loaded when a book
 * has its first crease, may be torn or opens a fold-out, as its WASM is nearly twice as large.
 */

import { unpack } from "../packed.ts";
import type {
  BookEngine,
  BookSize,
  CreasedLeaves,
  FlapPlace,
  FlapSheet,
  LeafTearing,
} from "./book_engine.ts";
import code from "./creases.wasm";
import { type FlapExports, flapsOf } from "./flap_sheets.ts";
import { leafPapers } from "./leaf_papers.ts";
import { areFinite, whole } from "./numbers.ts";
import type { Side } from "./phases.ts";
import type { Crease, LeafPapers } from "./shapes.ts";
import { type TearingExports, tearingOf } from "./torn_sheets.ts";
import { WasmBook } from "./wasm_book.ts";

/** What the engine exports beside the functions of all books. */
interface CreasingExports extends TearingExports, FlapExports {
  tl_creases(): number;
  tl_book_crease(book: number, leaf: number, count: number): number;
  tl_book_press(book: number, leaf: number, crease: number, rest: number): void;
  tl_book_wait(book: number, seconds: number): void;
  tl_book_lies_creased(book: number, side: Side): number;
}

/** Creases of a leaf at most, and the numbers of each: two places and an angle. */
const mostCreases = 16;
const numbersOfCrease = 5;

const mostLeaves = 1e6;

/** A book whose leaves can be creased, torn out and folded out. */
export class CreasableBook extends WasmBook {
  readonly creases: CreasedLeaves;
  readonly tearing: LeafTearing;
  readonly flap: (place: FlapPlace) => FlapSheet | null;
  protected override readonly papers: LeafPapers = leafPapers;

  private constructor(wasm: CreasingExports, size: BookSize) {
    super(wasm, size);
    const { book } = this;
    this.tearing = tearingOf(wasm, book, this.tick);
    this.flap = flapsOf(wasm, book, this.tick);
    this.creases = {
      crease: (leaf, creases) => {
        const numbers = creases.flatMap(numbersOf);
        if (creases.length > mostCreases || !areFinite(numbers)) return false;
        new Float64Array(wasm.memory.buffer, wasm.tl_creases(), numbers.length).set(numbers);
        return wasm.tl_book_crease(book, whole(leaf, mostLeaves), creases.length) !== 0;
      },
      press: (leaf, crease, rest) => {
        if (areFinite([rest])) wasm.tl_book_press(book, whole(leaf, mostLeaves), crease, rest);
      },
      wait: (seconds) => wasm.tl_book_wait(book, seconds),
      lies: (side) => wasm.tl_book_lies_creased(book, side) !== 0,
    };
  }

  /** Makes a book. Rejects if WebAssembly is unavailable. */
  static async creasable(size: BookSize): Promise<CreasableBook> {
    const { instance } = await WebAssembly.instantiate(await unpack(code), {});
    return new CreasableBook(instance.exports as unknown as CreasingExports, size);
  }

  override another(size: BookSize): BookEngine {
    return new CreasableBook(this.#wasm, size);
  }

  get #wasm(): CreasingExports {
    return this.wasm as CreasingExports;
  }
}

function numbersOf({ through, rest }: Crease): number[] {
  const numbers = [...through, rest];
  return numbers.length === numbersOfCrease ? numbers : [Number.NaN];
}
