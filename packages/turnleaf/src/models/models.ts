/**
 * Loose leaves: one leaf over a table, moved by any of the engine's models and
 * turned by the same gestures and grabs. For pages that compare models, play
 * with them or bake a turn; no book needs it. Its machine code is its own, so
 * that the viewer does not carry it. Runs in browsers and in Node.
 *
 * Metres, kilograms, seconds and radians; x across the spine to the right, y
 * along it to the head, z up from the table. Over a leaf u runs from 0 at the
 * spine to 1 at the fore-edge, v from 0 at the foot to 1 at the head.
 */

import { DrawnRecord } from "../drawn_record.ts";
import { type Model, models } from "../model_names.ts";
import { unpack } from "../packed.ts";
import type { PaperMesh } from "../paper_mesh.ts";
import { presetStocks } from "../stocks.ts";
import code from "./models.wasm";

export { type Model, models, type PaperMesh };

/** A paper's figures: kg/m^2, m, and N m of stiffness along and across the grain. */
export interface LeafStock {
  /** Mass per square metre, kg/m^2. */
  readonly grammage: number;
  /** Thickness, m. */
  readonly caliper: number;
  /** Bending stiffness along the grain, which runs along the spine, N m. */
  readonly stiffnessAlong: number;
  /** Bending stiffness across the grain, N m. */
  readonly stiffnessAcross: number;
  /** Coefficient of friction on the table. Default 0.5. */
  readonly friction?: number;
}

const { board: _, ...papers } = presetStocks;

/** The name of a preset paper. */
export type LeafStockName = Exclude<keyof typeof presetStocks, "board">;

/** The engine's preset papers, from the lightest to the heaviest. */
export const leafStocks: Readonly<Record<LeafStockName, LeafStock>> = papers;

/** Standard gravity, m/s^2, as the engine has it. */
export const standardGravity = 9.80665;

/** The options of a loose leaf. */
export interface LeafOptions {
  /** The model that moves it. */
  readonly model: Model;
  /** Width in metres, from the spine to the fore-edge. Default 0.148. */
  readonly width?: number;
  /** Height in metres, from the foot to the head. Default 0.21. */
  readonly height?: number;
  /** The paper. Default book paper. */
  readonly stock?: LeafStock;
  /** Side on which it rests at first. Default right. */
  readonly side?: LeafSide;
  /** Acceleration of gravity downward, m/s^2. Default `standardGravity`. */
  readonly gravity?: number;
  /** Density of the air relative to real air: 0 is a vacuum. Default 1. */
  readonly air?: number;
  /**
   * Columns and rows of nodes. Default the model's own; ignored by those without
   * nodes, which follow a rule.
   */
  readonly nodes?: readonly [columns: number, rows: number];
  /** Length of a step, seconds. Default the model's own. */
  readonly timeStep?: number;
  /** Columns and rows of drawn points. Default 26 x 26. */
  readonly points?: readonly [columns: number, rows: number];
  /**
   * For mass-spring: the paper's own constants, or paper's weight and
   * stiffness. Default paper-2014.
   */
  readonly preset?: "paper-2014" | "book";
  /**
   * For mass-spring and sheet: which lines are kept parallel; a number is the
   * dog-ear line's angle with the spine, radians. Default none.
   */
  readonly synchronise?: "off" | "columns" | number;
  /**
   * For mass-spring: whether the drawn points are interpolated between its
   * nodes, or are its nodes. Default false.
   */
  readonly interpolate?: boolean;
  /** For shell: the discretisation of its bending. Default grid. */
  readonly discretisation?: "grid" | "triangles";
}

/** A side of the spine. */
export type LeafSide = "left" | "right";

/** How a leaf is turned: by its fore-edge, by its foot corner, or by that and released upright. */
export type LeafTurn = "edge" | "corner" | "let-go";

const turns: readonly LeafTurn[] = ["edge", "corner", "let-go"];

/** Energies and strains of a leaf's nodes as if they were paper's. */
export interface LeafFigures {
  /** Kinetic energy, J. */
  readonly kinetic: number;
  /** Energy of bending and twist, J. */
  readonly bending: number;
  /** Potential energy, J. */
  readonly gravity: number;
  /** Largest stretch of an edge between neighbouring nodes: 0.01 is one per cent longer than at rest. */
  readonly stretch: number;
  /** Largest compression of an edge, below 0. */
  readonly compression: number;
}

/** A grid in the engine's memory: valid until the leaf's next `update`. */
export interface LeafGrid {
  /** Points along a row, from the spine. */
  readonly columns: number;
  /** Rows, from the foot. */
  readonly rows: number;
  /** x, y, z of each point, row by row, metres. */
  readonly positions: Float32Array;
}

/** The drawn surface of a leaf. */
export interface LeafSurface extends LeafGrid {
  /** Unit normal of each point; up for a leaf that lies on the right. */
  readonly normals: Float32Array;
  /**
   * How the points lie on the flat paper if the leaf is creased; another object when that
   * changes. Normals are then those of a leaf that is bent there: see `splitMesh` of
   * `turnleaf/keyframes` for those of either side of a crease.
   */
  readonly creased?: PaperMesh | undefined;
}

/** A straight crease of a leaf, from edge to edge, that does not meet the spine. */
export interface LeafCrease {
  /** u, v, u, v of two places on its line, each 0 to 1. */
  readonly through: readonly [number, number, number, number];
  /** Angle at which it rests, radians: 0 is flat; above it the parts turn toward the recto. */
  readonly rest: number;
}

/** A crease as it is now. */
export interface CreaseState {
  /** Its angle, radians as `LeafCrease.rest`: the mean over its length. */
  readonly angle: number;
  /** The angle at which it bears no moment, likewise. */
  readonly rest: number;
  /** Moment per length, N: its stiffness times the angle less the rest. */
  readonly moment: number;
}

/** Maximum of creases of a leaf, and the numbers that the engine reads of each. */
const mostCreases = 16;
const numbersOfCrease = 5;

/** The nodes of a leaf. */
export interface LeafNodes extends LeafGrid {
  /** Velocity of each node, m/s. */
  readonly velocities: Float32Array;
}

interface Exports {
  memory: WebAssembly.Memory;
  tl_leaf_figures(): number;
  tl_leaf_new(figures: number): number;
  tl_leaf_drop(leaf: number): void;
  tl_leaf_error(): number;
  tl_leaf_error_length(): number;
  /** Called only by the golden test. */
  tl_leaf_hash(kind: number): bigint;
  tl_leaf_lay(leaf: number, side: number): void;
  tl_leaf_samples(leaf: number, columns: number, rows: number): number;
  tl_leaf_draw(leaf: number, columns: number): number;
  tl_leaf_creases(leaf: number): number;
  tl_leaf_crease(leaf: number, count: number): number;
  tl_leaf_press(leaf: number, crease: number, rest: number): void;
  tl_leaf_crease_state(leaf: number, crease: number): number;
  tl_leaf_play(leaf: number, by: number, from: number, seconds: number): void;
  tl_leaf_playing(leaf: number): number;
  tl_leaf_grab(leaf: number, u: number, v: number): void;
  tl_leaf_hold(leaf: number, x: number, y: number, z: number): void;
  tl_leaf_release(leaf: number): void;
  tl_leaf_advance(leaf: number, seconds: number): void;
  tl_leaf_step(leaf: number): number;
  tl_leaf_time(leaf: number): number;
  tl_leaf_update(leaf: number): void;
  tl_leaf_surface(leaf: number): number;
  tl_leaf_node_columns(leaf: number): number;
  tl_leaf_node_rows(leaf: number): number;
  tl_leaf_nodes(leaf: number): number;
  tl_leaf_velocities(leaf: number): number;
  tl_leaf_measure(leaf: number): number;
  tl_leaf_record(leaf: number, interval: number): void;
  tl_leaf_finish_record(leaf: number): number;
  tl_leaf_record_bytes(leaf: number): number;
}

let compiled: Promise<WebAssembly.Module> | undefined;

function compile(): Promise<WebAssembly.Module> {
  compiled ??= unpack(code).then((bytes) => WebAssembly.compile(bytes));
  return compiled;
}

const sideNumber = (side: LeafSide) => (side === "left" ? 1 : 0);

/** Returns the arguments of `tl_leaf_new`, in their order. */
function figuresOf(options: LeafOptions): number[] {
  const { stock = leafStocks.book, synchronise = "off" } = options;
  const [nodeColumns, nodeRows] = options.nodes ?? [0, 0];
  const [columns, rows] = options.points ?? [26, 26];
  const angle = typeof synchronise === "number" ? synchronise : 0;
  const parallel = typeof synchronise === "number" ? 2 : synchronise === "columns" ? 1 : 0;
  return [
    models.indexOf(options.model) + 1,
    options.width ?? 0.148,
    options.height ?? 0.21,
    stock.grammage,
    stock.caliper,
    stock.stiffnessAlong,
    stock.stiffnessAcross,
    sideNumber(options.side ?? "right"),
    options.gravity ?? standardGravity,
    options.air ?? 1,
    nodeColumns,
    nodeRows,
    options.timeStep ?? 0,
    columns,
    rows,
    options.preset === "book" ? 1 : 0,
    parallel,
    angle,
    options.interpolate ? 1 : 0,
    options.discretisation === "triangles" ? 1 : 0,
    stock.friction ?? 0.5,
  ];
}

/**
 * A loose leaf, in an engine of its own except for `another`: dropping all of
 * them frees its memory.
 *
 * ```ts
 * const leaf = await LooseLeaf.create({ model: "cone" });
 * leaf.play("corner", "right", 1.2);
 * leaf.advance(1 / 60);
 * leaf.update();
 * draw(leaf.surface());
 * ```
 */
export class LooseLeaf {
  /** Its options. */
  readonly options: LeafOptions;
  private readonly wasm: Exports;
  private readonly leaf: number;
  private creased: PaperMesh | undefined;

  private constructor(wasm: Exports, options: LeafOptions) {
    this.wasm = wasm;
    this.options = options;
    const room = wasm.tl_leaf_figures();
    const figures = figuresOf(options);
    new Float64Array(wasm.memory.buffer, room, figures.length).set(figures);
    this.leaf = wasm.tl_leaf_new(room);
    if (this.leaf === 0) throw this.error();
  }

  /**
   * Makes a leaf, flat and at rest on its side.
   *
   * @throws Error if the options are invalid, or if there is no WebAssembly
   */
  static async create(options: LeafOptions): Promise<LooseLeaf> {
    const instance = await WebAssembly.instantiate(await compile(), {});
    return new LooseLeaf(instance.exports as unknown as Exports, options);
  }

  /**
   * Makes another leaf in the same memory, synchronously.
   *
   * @throws Error if the options are invalid
   */
  another(options: LeafOptions): LooseLeaf {
    return new LooseLeaf(this.wasm, options);
  }

  /** Lays the leaf flat, but for its creases, and at rest on a side, held by nothing. */
  lay(side: LeafSide): void {
    this.wasm.tl_leaf_lay(this.leaf, sideNumber(side));
  }

  /**
   * Draws at every pair of `u` and `v` instead of evenly, each 2 to 1024
   * numbers that rise within 0 to 1. Mass-spring without interpolation still
   * draws its nodes. Ends a running record.
   *
   * @throws RangeError if they are invalid, or if a creased leaf's do not reach from 0 to 1 or
   * are too few for its creases
   */
  drawAt(u: ArrayLike<number>, v: ArrayLike<number>): void {
    const [wasm, leaf] = [this.wasm, this.leaf];
    const places = [...Array.from(u), ...Array.from(v)];
    const room = wasm.tl_leaf_samples(leaf, u.length, v.length);
    if (room === 0) throw new RangeError("A leaf is drawn at 1024 columns and rows at most.");
    new Float32Array(wasm.memory.buffer, room, places.length).set(places);
    if (wasm.tl_leaf_draw(leaf, u.length) === 0) throw new RangeError(this.error().message);
    this.readMesh();
  }

  /**
   * Creases a sheet along lines, pressed by hand, in place of the creases that it has. It stays
   * where it is. Creases yield while the leaf is held: a grab opens them. Ends a running record;
   * `record` does nothing for a creased leaf, which `TurnRecorder` records.
   *
   * @param creases 16 at most, none for a leaf without
   * @throws Error if the leaf is of another model or synchronised, a line meets the spine or is
   * otherwise invalid, or there are too many for the leaf's nodes; it is then as it was
   */
  crease(creases: readonly LeafCrease[]): void {
    const [wasm, leaf] = [this.wasm, this.leaf];
    const numbers = creases.slice(0, mostCreases).flatMap(({ through, rest }) => {
      const own = [...through, rest];
      return own.length === numbersOfCrease ? own : Array(numbersOfCrease).fill(Number.NaN);
    });
    new Float64Array(wasm.memory.buffer, wasm.tl_leaf_creases(leaf), numbers.length).set(numbers);
    if (wasm.tl_leaf_crease(leaf, creases.length) === 0) throw this.error();
    this.readMesh();
  }

  /** Turns the rest of a crease, counted from 0, to an angle, radians. */
  press(crease: number, rest: number): void {
    this.wasm.tl_leaf_press(this.leaf, crease, rest);
  }

  /** Returns a crease as it is now, counted from 0; null if there is none of that number. */
  creaseState(crease: number): CreaseState | null {
    const at = this.wasm.tl_leaf_crease_state(this.leaf, crease);
    if (at === 0) return null;
    const [angle = 0, rest = 0, moment = 0] = new Float64Array(this.wasm.memory.buffer, at, 3);
    return { angle, rest, moment };
  }

  /** Lays the leaf on a side and starts a turn to the other one that takes `seconds`, 0.01 to 3600. */
  play(by: LeafTurn, from: LeafSide, seconds: number): void {
    this.wasm.tl_leaf_play(this.leaf, turns.indexOf(by), sideNumber(from), seconds);
  }

  /** Whether such a turn is in progress: the leaf's own grab still leads it. */
  get playing(): boolean {
    return this.wasm.tl_leaf_playing(this.leaf) !== 0;
  }

  /** Grabs the leaf at (u, v), and ends a turn in progress. */
  grab(u: number, v: number): void {
    this.wasm.tl_leaf_grab(this.leaf, u, v);
  }

  /** Pulls the grabbed point to a place, metres: the leaf follows as far as its model allows. */
  hold(x: number, y: number, z: number): void {
    this.wasm.tl_leaf_hold(this.leaf, x, y, z);
  }

  /** Releases the leaf, held or turning: it falls. */
  release(): void {
    this.wasm.tl_leaf_release(this.leaf);
  }

  /**
   * Advances by seconds (at most 60), in whole steps of the model; the
   * remainder is carried over to the next call.
   */
  advance(seconds: number): void {
    this.wasm.tl_leaf_advance(this.leaf, seconds);
  }

  /** Length of a step of the model, seconds. */
  get timeStep(): number {
    return this.wasm.tl_leaf_step(this.leaf);
  }

  /** Seconds of its own time since it was made. */
  get time(): number {
    return this.wasm.tl_leaf_time(this.leaf);
  }

  /** Updates `surface` and `nodes`. */
  update(): void {
    this.wasm.tl_leaf_update(this.leaf);
  }

  /** Returns the drawn surface as of the last `update`. */
  surface(): LeafSurface {
    const { columns, rows, positions, normals } = this.drawn();
    return { columns, rows, positions, normals, creased: this.creased };
  }

  /** Returns the model's nodes as of the last `update`: its masses, if it has masses. */
  nodes(): LeafNodes {
    const [wasm, leaf] = [this.wasm, this.leaf];
    const [columns, rows] = [wasm.tl_leaf_node_columns(leaf), wasm.tl_leaf_node_rows(leaf)];
    const floats = (address: number) =>
      new Float32Array(wasm.memory.buffer, address, 3 * columns * rows);
    return {
      columns,
      rows,
      positions: floats(wasm.tl_leaf_nodes(leaf)),
      velocities: floats(wasm.tl_leaf_velocities(leaf)),
    };
  }

  /** Returns the current energies and strains. */
  measure(): LeafFigures {
    const at = this.wasm.tl_leaf_measure(this.leaf);
    const figures = new Float64Array(this.wasm.memory.buffer, at, 5);
    const [kinetic = 0, bending = 0, gravity = 0, stretch = 0, compression = 0] = figures;
    return { kinetic, bending, gravity, stretch, compression };
  }

  /** Records the drawn surface from now on, a frame every `interval` seconds. */
  record(interval: number): void {
    this.wasm.tl_leaf_record(this.leaf, interval);
  }

  /**
   * Ends the record. Returns the bytes of a file of key frames, none if
   * `record` was not called.
   */
  finishRecord(): Uint8Array {
    const length = this.wasm.tl_leaf_finish_record(this.leaf);
    const at = this.wasm.tl_leaf_record_bytes(this.leaf);
    return new Uint8Array(this.wasm.memory.buffer, at, length).slice();
  }

  /** Frees the leaf. Nothing may be called afterwards. */
  destroy(): void {
    this.wasm.tl_leaf_drop(this.leaf);
  }

  /** Returns why the last leaf could not be made, drawn or creased. */
  private error(): Error {
    const wasm = this.wasm;
    const [at, length] = [wasm.tl_leaf_error(), wasm.tl_leaf_error_length()];
    return new Error(new TextDecoder().decode(new Uint8Array(wasm.memory.buffer, at, length)));
  }

  private drawn(): DrawnRecord {
    return new DrawnRecord(this.wasm.memory, this.wasm.tl_leaf_surface(this.leaf));
  }

  /** Keeps the mesh of a creased leaf. */
  private readMesh(): void {
    this.wasm.tl_leaf_update(this.leaf);
    this.creased = this.drawn().mesh();
  }
}

/** A spring of a mass-spring leaf: the numbers of its two nodes, and which kind it is. */
export interface Spring {
  /** Number of a node, row by row. */
  readonly from: number;
  /** Number of the other. */
  readonly to: number;
  /** Between neighbours, across a cell, or over every other node (Provot 1995). */
  readonly kind: "structural" | "shear" | "bend";
}

/** Returns the springs of a grid of masses. */
export function springsOf(columns: number, rows: number): Spring[] {
  const springs: Spring[] = [];
  const steps = [
    ["structural", 1, 0],
    ["structural", 0, 1],
    ["shear", 1, 1],
    ["shear", -1, 1],
    ["bend", 2, 0],
    ["bend", 0, 2],
  ] as const;
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      for (const [kind, across, up] of steps) {
        const [c, r] = [column + across, row + up];
        if (c < 0 || c >= columns || r >= rows) continue;
        springs.push({ from: row * columns + column, to: r * columns + c, kind });
      }
    }
  }
  return springs;
}
