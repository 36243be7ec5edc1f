/**
 * What the viewer needs of an engine, which moves a book's leaves and boards.
 * Two implement it: `WasmBook` (simulated paper) and `PeeledBook` (flat
 * leaves). Only numbers and flat arrays cross it; lengths are metres, angles
 * radians, times seconds. For book space see `shapes.ts`.
 */

import type { Cover, Phase, Side } from "./phases.ts";
import type {
  Crease,
  LeafStockName,
  Pile,
  Stock,
  StockFigures,
  Surface,
  TearLine,
  Vec3,
} from "./shapes.ts";

/** The size of a book as an engine sees it. */
export interface BookSize {
  /** A page's width and height, metres. */
  readonly width: number;
  readonly height: number;
  /** Leaves of paper, boards not counted. */
  readonly leaves: number;
  /** Thickness of all the paper together, metres. */
  readonly thickness: number;
}

/**
 * The creased leaves of a book. Where one lies uppermost on a side it is drawn by itself: its
 * surface is the first on the left, the last on the right.
 */
export interface CreasedLeaves {
  /**
   * Creases a leaf of paper, counted from 0 at the front, along lines in place of those it
   * has. Returns whether it can be; if not, nothing changes.
   */
  crease(leaf: number, creases: readonly Crease[]): boolean;
  /**
   * Turns the rest of one of its creases to an angle, radians; the next steps turn it there.
   * Nothing happens unless the leaf is in flight or lies uppermost.
   */
  press(leaf: number, crease: number, rest: number): void;
  /** Lets seconds pass in which nothing moved: creases of leaves under others creep. */
  wait(seconds: number): void;
  /**
   * Returns whether a creased leaf lies uppermost on a side. Uncovered, it lies pressed flat, and
   * steps open its creases to where they rest, also while no leaf is in flight.
   */
  lies(side: Side): boolean;
}

/** How a leaf is torn out of a book. */
export interface TearOptions {
  readonly line: TearLine;
  /** The rows between which the spine still holds it, from the foot; all by default. */
  readonly bound?: BoundRows | undefined;
  /** Height of the table, metres: 0 if the pages lie on it, less if boards do. */
  readonly table: number;
  /** How far boards reach beyond the pages, metres; 0 if there are none. */
  readonly rim: number;
}

/** u and v of a place on a leaf, each 0 to 1. */
export type UV = readonly [u: number, v: number];

/** Rows of a leaf that the spine holds, counted from the foot; equal if it holds none. */
export type BoundRows = readonly [from: number, to: number];

/**
 * A leaf that is being torn out, or is a loose sheet. A grab holds it, or two. It outlives its book's
 * engine where that makes another.
 */
export interface TornSheet {
  /** What still binds it. */
  readonly bound: BoundRows;
  /** Whether it does not move until the next command. */
  readonly isAsleep: boolean;
  /** What is drawn of it; valid until the next step. */
  readonly surface: Surface;
  /** Grabs it at (u, v), by the first grab or, to tear it across, by the second (1). */
  grab(u: number, v: number, grab?: 0 | 1): void;
  /** Pulls a grab to a place in book space, metres. */
  pull(place: Vec3, grab?: 0 | 1): void;
  /** Releases all grabs. */
  release(): void;
  /** Tears what still holds at the spine or across, at once. */
  cut(): void;
  /**
   * Begins to tear it across from (u, v) to (u, v), each on an edge of its page: it holds along
   * that line, and its tear opens from the first as two grabs pull it apart. All grabs are
   * released. Returns whether it does: not if it is bound, crumpled or torn across, and not if
   * the line leaves a piece narrower than some 16 mm.
   *
   * @param turns if true, what is not torn yet of the line turns as the way from one grab's pull to
   * the other's swings on the sheet, from where both first pulled; the surface's mesh changes
   * whenever it does
   */
  tearAcross(from: UV, to: UV, turns?: boolean): boolean;
  /** Whether it is being torn across, and something holds. */
  readonly holdsAcross: boolean;
  /**
   * Parts it once it is torn through: it is what lies to the right of the line from then on, and
   * what is returned is what lies to the left. Null if it is not torn through.
   */
  part(): TornSheet | null;
  /** Whether it is crumpled, or being crumpled. */
  readonly isCrumpled: boolean;
  /**
   * Presses it into a ball, in a little over a second of its own time; its grab is released.
   * Returns whether it does: false if it is still bound, or crumpled.
   */
  crumple(): boolean;
  /** Returns the work done in tearing and crumpling it since it was last asked for, J. */
  takeWork(): number;
  /** Frees it. Nothing may be called afterwards. */
  destroy(): void;
}

/** Tears leaves out of a book. */
export interface LeafTearing {
  /**
   * Begins to tear the leaf of a flight out, from where it is drawn; the flight itself stays as
   * it is. Returns null if there is no such flight, or folds of its leaf lie upon folds.
   */
  tear(id: number, options: TearOptions): TornSheet | null;
  /**
   * Tears one sheet across that nobody sees and crumples another, a part of that whenever its
   * iterator goes on: the first of a reader's takes no longer than others then.
   */
  rehearse(): Iterator<void>;
  /** Steps a torn sheet of this book, or of one that it came from, by whole ticks on and beside this book. */
  step(sheet: TornSheet, ticks: number): void;
  /**
   * Steps loose sheets by whole ticks on and beside this book and upon each other, those that are
   * listed later upon those before. One that is grabbed comes to the top as soon as nothing lies upon
   * it; those that are asleep stay so unless what they lie upon moves. At most 16.
   */
  stepTogether(sheets: readonly TornSheet[], ticks: number): void;
  /** Wakes those of some loose sheets that lie upon one which is about to be freed. */
  wakeUpon(sheet: TornSheet, sheets: readonly TornSheet[]): void;
}

/** Where the flap of a fold-out is, on the uppermost page of a side. */
export interface FlapPlace {
  readonly side: Side;
  /** Distance of the fold from the spine, in page widths, 0.5 to 1. */
  readonly fold: number;
  /** Width of the flap, in page widths: of each of its panels 0.05 to `fold`. */
  readonly width: number;
  /** Panels of one width into which it is folded to both sides by turns, 1 to 3. */
  readonly panels: number;
  /** Height of the table, metres: 0 if the pages lie on it, less if boards do. */
  readonly table: number;
  /** How far boards reach beyond the pages, metres; 0 if there are none. */
  readonly rim: number;
}

/**
 * The flap of a fold-out: the part of a leaf beyond its fold, while the leaf lies uppermost. One
 * grab holds it. It ends before its book's engine does.
 */
export interface FlapSheet {
  /** Whether it does not move until the next command. */
  readonly isAsleep: boolean;
  /** Angle at which the end of its first panel is seen from the fold, radians: 0 open and level, pi shut. */
  readonly angle: number;
  /** What is drawn of it, a row from the fold outward; valid until the next step. */
  readonly surface: Surface;
  /** Grabs it at (u, v), u from the fold. */
  grab(u: number, v: number): void;
  /** Pulls the grab to a place in book space, metres. */
  pull(place: Vec3): void;
  /** Releases the grab: it falls, and its fold is pressed open or shut. */
  release(): void;
  /** Turns it by its edge, open or shut, and releases it. */
  turn(isToOpen: boolean): void;
  /** Advances it by whole ticks. */
  step(ticks: number): void;
  /** Frees it. Nothing may be called afterwards. */
  destroy(): void;
}

/**
 * One bound book with several leaves of paper in flight. A flight is identified
 * by the number that `lift` returns; a command to one that is over changes
 * nothing. Flights are listed from left to right.
 *
 * Numbers are clamped to what an engine accepts, and a command with a place
 * that is not a finite number does nothing.
 */
export interface BookEngine {
  /** Length of a tick, seconds. */
  readonly tick: number;
  /** u of each column of leaves and piles, 0 at the spine to 1 at the fore-edge. */
  readonly columns: Float32Array;
  /** Leaves of paper on the left pile. */
  readonly read: number;
  /** Number of leaves in flight. */
  readonly flights: number;
  /** Its creased leaves; missing where leaves cannot be creased. */
  readonly creases?: CreasedLeaves;
  /** Tears its leaves out; missing where they cannot be torn. */
  readonly tearing?: LeafTearing;
  /**
   * Makes the flap of a fold-out, shut; null if no leaf lies there. Missing where fold-outs
   * cannot be opened.
   */
  readonly flap?: (place: FlapPlace) => FlapSheet | null;

  /**
   * Makes another book beside this one, in the same memory if it has one.
   *
   * @throws Error if a book of this size cannot be made
   */
  another(size: BookSize): BookEngine;
  /** Frees the book. Nothing may be called afterwards. */
  destroy(): void;

  /**
   * Sets the stock of all leaves: a preset, or one in figures. This and the
   * next four lay down the leaves in flight. Returns whether the stock is
   * valid; if not, nothing changes.
   */
  setStock(stock: Stock | StockFigures): boolean;
  /**
   * Sets the stock of the leaves of paper from `first` to before `end`, counted from 0
   * at the front. Each then moves as that stock does and counts by its thickness in
   * the piles. Returns whether there are such leaves and the stock is valid; if
   * not, nothing changes.
   */
  setLeafStock(first: number, end: number, stock: LeafStockName | StockFigures): boolean;
  /**
   * Sets the direction of the grain and the stiffness of the binding against
   * turning in the gutter, N (0 to 1). Returns whether they are valid.
   */
  setBinding(grain: "along" | "across", stiffness: number): boolean;
  /** Sets the velocity of the air, m/s, each component within 20. Returns whether it is valid. */
  setWind(wind: Vec3): boolean;
  /** Sets whether a released leaf is helped over to its side, or left to gravity. */
  setAssist(on: boolean): void;
  /**
   * Sets how many times as large as its places say the book is whose leaves move, 0.02 to 50.
   * Returns whether it is valid.
   */
  setScale(scale: number): boolean;

  /** Lays the book open with `read` leaves of paper on the left and none in flight. */
  lay(read: number): void;
  /**
   * Picks up the uppermost leaves of `side`: with them on the right `low`
   * leaves are read, on the left `high`. Returns the flight's number, or 0 if
   * these are not the uppermost or too many fly.
   */
  pickUp(side: Side, low: number, high: number): number;
  /** Grabs a flight at (u, v); `grab` is its number, 0 to 3. */
  grab(id: number, grab: number, u: number, v: number): void;
  /** Pulls a grab to a place in book space, metres. */
  hold(id: number, grab: number, x: number, y: number, z: number): void;
  /** Releases a grab; with no other on it, the leaf falls, and those in its way with it. */
  release(id: number, grab: number): void;
  /**
   * Plays a flight to `side` from where it is, `seconds` for a whole turn, and
   * those in its way too.
   */
  play(id: number, side: Side, seconds: number): void;
  /** Begins a frame: the work of its steps is counted from here on. */
  beginFrame(): void;
  /**
   * Steps all flights by at most `ticks`: by fewer where those of the frame are as much work as
   * one may have, so that leaves slow down instead of the next frame coming later still. Returns
   * by how many.
   */
  stepFrame(ticks: number): number;
  /**
   * Whether nothing moves until the next command: whatever is in flight, or a
   * board, is held and lies still, and so do creased leaves that lie uppermost.
   */
  readonly isAsleep: boolean;
  /** Returns what a flight is doing. */
  phase(id: number): Phase;

  /** Updates surfaces and piles from the last step. */
  update(): void;
  /**
   * Returns the drawn mesh at `index`, counted from the left, of those of the leaves in flight and of
   * creased ones that lie uppermost; valid until the next step.
   */
  surface(index: number): Surface;
  /** Returns the pages at rest on `side`; valid until the next step. */
  pile(side: Side): Pile;
  /**
   * Returns the points of the flight at `index` over a flat table, to be
   * overwritten: x, y, z in metres, at the surface's columns and rows, as its
   * sheet has them now. The next `update` draws them in the sheet's place, bent
   * into the gutter between the piles. Null if surfaces cannot be overridden.
   */
  overrideSurface(index: number): Float32Array | null;

  /** Holds a board at an angle, radians from the right-hand side. */
  holdBoard(cover: Cover, angle: number): void;
  /** Releases a board. */
  releaseBoard(cover: Cover): void;
  /** Swings a board to `side`, `seconds` for a whole half turn. */
  playBoard(cover: Cover, side: Side, seconds: number): void;
  /** Puts a board down on `side` at once. */
  layBoard(cover: Cover, side: Side): void;
  /** Steps a board by whole ticks. Returns what it is doing then. */
  stepBoard(cover: Cover, ticks: number): Phase;
  /** Returns a board's angle from the right-hand side, radians. */
  boardAngle(cover: Cover): number;
}
