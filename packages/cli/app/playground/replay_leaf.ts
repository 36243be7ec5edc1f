/** A leaf that replays a recording of a live one: grabs and turns over key frames. */

import { decodeTurn, type RecordedTurn, writeNormals } from "turnleaf/keyframes";
import {
  type LeafFigures,
  type LeafNodes,
  type LeafOptions,
  type LeafSide,
  type LeafSurface,
  type LeafTurn,
  LooseLeaf,
  leafStocks,
  standardGravity,
} from "turnleaf/models";
import { paperFigures } from "./paper_figures.ts";

/** What the playground needs of a leaf, live or recorded. */
export type AnyLeaf = Pick<
  LooseLeaf,
  | "options"
  | "lay"
  | "play"
  | "playing"
  | "grab"
  | "hold"
  | "release"
  | "advance"
  | "timeStep"
  | "update"
  | "surface"
  | "nodes"
  | "measure"
  | "destroy"
>;

/**
 * The recording: a turn of this length and the time after it, with a frame at
 * this interval, seconds.
 */
const turnTime = 1.2;
const afterTime = 0.6;
const between = 1 / 60;

/** Number of samples between which the time of a fraction of the turn is interpolated. */
const looks = 200;

/** A turn from right to left, and when each fraction of it is first done, seconds. */
interface Recorded {
  readonly turn: RecordedTurn;
  readonly times: Float64Array;
}

/**
 * Replays the turns of the leaf that its options make, each recorded when it is
 * first played. Held, it is where the turn by the fore-edge is as far over as
 * the pointer; released, it goes on in that turn to the nearer side.
 */
export class ReplayLeaf implements AnyLeaf {
  readonly options: LeafOptions;
  readonly timeStep = 1 / 120;
  readonly #live: LooseLeaf;
  readonly #recorded = new Map<LeafTurn, Recorded>();
  readonly #surface: LeafSurface;
  readonly #velocities: Float32Array;
  #now: Recorded;
  #isMirrored: boolean;
  /**
   * Seconds of the recording; how many of them pass in a second; and whether a
   * played turn is in progress.
   */
  #time = 0;
  #pace = 0;
  #isPlaying = false;

  private constructor(live: LooseLeaf) {
    this.#live = live;
    this.options = live.options;
    const { columns, rows, positions } = live.surface();
    const { length } = positions;
    this.#surface = {
      columns,
      rows,
      positions: new Float32Array(length),
      normals: new Float32Array(length),
    };
    this.#velocities = new Float32Array(length);
    this.#isMirrored = live.options.side === "left";
    this.#now = this.#record("edge");
    this.#move();
    this.#velocities.fill(0);
  }

  /** Records the leaf of the options. Rejects if they are invalid. */
  static async create(options: LeafOptions): Promise<ReplayLeaf> {
    const live = await LooseLeaf.create(options);
    live.update();
    return new ReplayLeaf(live);
  }

  get playing(): boolean {
    return this.#isPlaying;
  }

  lay(side: LeafSide): void {
    this.#begin("edge", side);
    this.#pace = 0;
    this.#move();
    this.#velocities.fill(0);
  }

  play(by: LeafTurn, from: LeafSide, seconds: number): void {
    this.#begin(by, from);
    this.#pace = turnTime / seconds;
    this.#isPlaying = true;
  }

  grab(): void {
    const { columns, rows, positions } = this.#surface;
    const isLeft = fractionTurned(positions, columns, rows) > 0.5;
    this.#begin("edge", isLeft ? "left" : "right");
    this.#pace = 0;
  }

  hold(x: number, _y: number, z: number): void {
    const fraction = Math.atan2(Math.max(z, 0), this.#isMirrored ? -x : x) / Math.PI;
    const at = fraction * looks;
    const low = Math.min(Math.floor(at), looks - 1);
    const [before, after] = [this.#now.times[low], this.#now.times[low + 1]];
    this.#time = before + (at - low) * (after - before);
    this.#pace = 0;
  }

  release(): void {
    const { times } = this.#now;
    this.#pace = this.#time > times[looks / 2] ? 1 : -1;
    this.#isPlaying = false;
  }

  advance(seconds: number): void {
    const { duration } = this.#now.turn;
    this.#time = Math.min(Math.max(this.#time + seconds * this.#pace, 0), duration);
    if (this.#time === 0 || this.#time === duration) {
      this.#isPlaying = false;
      this.#pace = 0;
    }
    const before = this.#surface.positions.slice();
    this.#move();
    const { positions } = this.#surface;
    for (let i = 0; i < before.length; i++) {
      this.#velocities[i] = (positions[i] - before[i]) / seconds;
    }
  }

  update(): void {
    const { columns, rows, positions, normals } = this.#surface;
    writeNormals(columns, rows, positions, normals);
  }

  surface(): LeafSurface {
    return this.#surface;
  }

  nodes(): LeafNodes {
    const { columns, rows, positions } = this.#surface;
    return { columns, rows, positions, velocities: this.#velocities };
  }

  measure(): LeafFigures {
    const {
      width = 0.148,
      height = 0.21,
      stock = leafStocks.book,
      gravity = standardGravity,
    } = this.options;
    return paperFigures({ width, height, stock, gravity }, this.nodes());
  }

  destroy(): void {
    this.#live.destroy();
  }

  #begin(by: LeafTurn, from: LeafSide): void {
    this.#now = this.#recorded.get(by) ?? this.#record(by);
    this.#isMirrored = from === "left";
    this.#time = 0;
    this.#isPlaying = false;
  }

  #move(): void {
    const { positions } = this.#surface;
    this.#now.turn.sample(this.#time, positions);
    if (this.#isMirrored)
      for (let i = 0; i < positions.length; i += 3) positions[i] = -positions[i];
  }

  #record(by: LeafTurn): Recorded {
    const live = this.#live;
    live.play(by, "right", turnTime);
    live.record(between);
    live.advance(turnTime + afterTime);
    const turn = decodeTurn(live.finishRecord());
    const { columns, rows, duration } = turn;
    const points = new Float32Array(3 * columns * rows);
    const times = new Float64Array(looks + 1).fill(duration);
    for (let next = 0, time = 0; time <= duration; time += between / 2) {
      turn.sample(time, points);
      const fraction = fractionTurned(points, columns, rows);
      for (; next <= looks * fraction; next++) times[next] = time;
    }
    const recorded = { turn, times };
    this.#recorded.set(by, recorded);
    return recorded;
  }
}

/** Returns how far the fore-edge has turned on the whole, from 0 on the right to 1 on the left. */
function fractionTurned(points: Float32Array, columns: number, rows: number): number {
  let sum = 0;
  for (let row = 1; row <= rows; row++) {
    const edge = 3 * (row * columns - 1);
    sum += Math.atan2(Math.max(points[edge + 2], 0), points[edge]);
  }
  return sum / (rows * Math.PI);
}
