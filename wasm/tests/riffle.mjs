/**
 * The riffle of the engine's `trials`, through the exports that the viewer
 * calls: what a golden test and a benchmark learn from it holds for the machine
 * code that is shipped.
 */

import { importTs } from "../../scripts/import_ts.mjs";
import { drawnOf } from "./drawn.mjs";

const { presetStocks } = await importTs("stocks.ts");

/** Presets by the engine's numbers. */
export const stocks = Object.keys(presetStocks);

const [RIGHT, LEFT] = [0, 1];
const OVER = 7;

/** Folds a corner of 30 mm of an A5 leaf over, to 20 degrees open: an engine with creases can. */
export function foldCorner(engine, book, leaf) {
  const corner = [1 - 0.03 / 0.148, 1, 1, 1 - 0.03 / 0.21, (160 / 180) * Math.PI];
  new Float64Array(engine.memory.buffer, engine.tl_creases(), corner.length).set(corner);
  if (engine.tl_book_crease(book, leaf, 1) === 0) throw new Error(`Leaf ${leaf} is not folded.`);
}

/** A thumb that lets the leaves of a book go, one after another, `most` of them in flight. */
export class Riffle {
  #engine;
  #book;
  #most;
  #next = 1000;
  #flights = [];

  constructor(engine, stock, most) {
    this.#engine = engine;
    this.#most = most;
    this.#book = engine.tl_book_new(0.148, 0.21, 4000, 0.016);
    engine.tl_book_set_stock(this.#book, stocks.indexOf(stock));
    engine.tl_board_lay(this.#book, 0, LEFT);
    engine.tl_book_lay(this.#book, this.#next);
    for (let frame = 0; frame < 120; frame++) this.frame();
  }

  /** Folds a corner of each of its leaves over. */
  foldCorners() {
    for (let leaf = 1000; leaf <= 3900; leaf++) foldCorner(this.#engine, this.#book, leaf);
  }

  /** A frame at 60 Hz: a leaf is let go where too few fly; all are stepped and drawn. */
  frame() {
    const [engine, book] = [this.#engine, this.#book];
    if (engine.tl_book_flights(book) < this.#most) {
      const id = engine.tl_book_lift(book, RIGHT, this.#next, this.#next + 1);
      if (id !== 0) {
        engine.tl_book_play(book, id, LEFT, 0.6);
        this.#flights.push(id);
        this.#next++;
      }
    }
    if (this.#next > 3900) {
      this.#next = 1000;
      engine.tl_book_lay(book, this.#next);
    }
    engine.tl_book_step(book, 2);
    engine.tl_book_update(book);
    this.#flights = this.#flights.filter((id) => engine.tl_book_phase(book, id) !== OVER);
  }

  /** Two grabs catch the fourth leaf in flight from the left and pull it about. */
  catchOne() {
    const [engine, book, id] = [this.#engine, this.#book, this.#flights[3]];
    if (id === undefined) return;
    engine.tl_book_grab(book, id, 0, 1.0, 0.1);
    engine.tl_book_grab(book, id, 1, 0.8, 0.9);
    engine.tl_book_hold(book, id, 0, 0.3, -0.2, 0.2);
    engine.tl_book_hold(book, id, 1, -0.1, 0.3, 0.05);
  }

  /** The bytes of what is drawn now: of each leaf in flight its positions and its normals. */
  *drawn() {
    const [engine, book] = [this.#engine, this.#book];
    for (let index = 0; index < engine.tl_book_flights(book); index++) {
      for (const { buffer, byteOffset, byteLength } of drawnOf(engine, book, index)) {
        yield new Uint8Array(buffer, byteOffset, byteLength);
      }
    }
  }

  /** Frees the book. */
  drop() {
    this.#engine.tl_book_drop(this.#book);
  }
}
