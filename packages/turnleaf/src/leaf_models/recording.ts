/**
 * Plays a recorded turn by the fraction of it that is done, rather than by
 * time, at the points of another leaf.
 */

import { blend, type Mix, mixAt } from "../key_frames/blend.ts";
import type { RecordedTurn } from "../key_frames/recorded_turn.ts";
import { BookError } from "../sources/page_source.ts";
import { fractionTurned } from "./lying_sheet.ts";

/** Number of samples of a recording, between which its time is interpolated. */
const looks = 400;

/**
 * A turn must lead at least from one to the other of these fractions: the rest
 * is the leaf's landing.
 */
const [begun, done] = [0.1, 0.9];

/** The leaf on which a recording is played. */
export interface ReplayedLeaf {
  /** u of its columns and v of its rows, rising from 0 to 1. */
  readonly u: ArrayLike<number>;
  readonly v: ArrayLike<number>;
  /** Its size, metres. */
  readonly width: number;
  readonly height: number;
  /** Whether it lay on the left. */
  readonly isMirrored: boolean;
  /** Whether its head moves as the recorded foot did. */
  readonly isUpsideDown: boolean;
}

/** A recorded turn from right to left. Playing changes nothing in it but its buffers. */
export class Recording {
  /** The model that was recorded. */
  readonly model: RecordedTurn["model"];
  readonly #turn: RecordedTurn;
  /** When each fraction of the turn is first done, seconds. */
  readonly #times = new Float64Array(looks + 1);
  readonly #frame: Float32Array;
  /** The leaf of the last call, and how its points mix from those recorded. */
  #u: ArrayLike<number> = [];
  #v: ArrayLike<number> = [];
  #across: Mix[] = [];
  #up: Mix[] = [];

  /**
   * @param turn from either side to the other
   *
   * @param name its name in errors
   * @throws BookError if it turns a leaf less far, or one that is creased
   */
  constructor(turn: RecordedTurn, name: string) {
    if (turn.creased) {
      throw new BookError(`${name} is of a creased leaf, which a book's leaves are not drawn as.`, {
        code: "misused",
        source: name,
      });
    }
    this.model = turn.model;
    this.#frame = new Float32Array(3 * turn.columns * turn.rows);
    const fraction = (of: RecordedTurn, time: number): number => {
      of.sample(time, this.#frame);
      return fractionTurned(this.#frame, of.columns, of.rows);
    };
    const isToRight = fraction(turn, 0) > fraction(turn, turn.duration);
    this.#turn = isToRight ? turn.mirrored() : turn;
    let next = 0;
    for (let look = 0; look <= looks; look++) {
      const time = (look / looks) * turn.duration;
      const now = fraction(this.#turn, time);
      if (look === 0 && now > begun) break;
      for (; next <= looks * Math.min(now, 1); next++) this.#times[next] = time;
    }
    if (next <= looks * done) {
      throw new BookError(
        `${name} leads its leaf only a part of the way over; record a turn from one side to the other.`,
        { code: "misused", source: name },
      );
    }
    this.#times.fill(turn.duration, next);
  }

  /**
   * Writes x, y, z of the points of a leaf, metres, row by row from the foot,
   * when a fraction of its turn is done. A leaf of another ratio is stretched
   * along the spine.
   */
  write(leaf: ReplayedLeaf, fraction: number, out: Float32Array): void {
    const { columns, rows, width, height } = this.#turn;
    this.#turn.sample(this.#timeAt(fraction), this.#frame);
    this.#mixFor(leaf);
    const rowLength = 3 * this.#across.length;
    const wide = new Float32Array(rows * rowLength);
    for (let row = 0; row < rows; row++) {
      const start = 3 * row * columns;
      let at = row * rowLength;
      for (const { frame, weight } of this.#across) {
        for (let axis = 0; axis < 3; axis++) {
          let sum = 0;
          for (let k = 0; k < 4; k++) sum += weight[k] * this.#frame[start + 3 * frame[k] + axis];
          wide[at++] = sum;
        }
      }
    }
    const count = this.#up.length;
    for (const [row, mix] of this.#up.entries()) {
      const at = (leaf.isUpsideDown ? count - 1 - row : row) * rowLength;
      blend(mix, wide, out.subarray(at, at + rowLength));
    }
    const across = leaf.width / width;
    const along = leaf.height / height;
    for (let at = 0; at < out.length; at += 3) {
      const y = along * out[at + 1];
      out[at] *= leaf.isMirrored ? -across : across;
      out[at + 1] = leaf.isUpsideDown ? leaf.height - y : y;
      out[at + 2] *= across;
    }
  }

  #timeAt(fraction: number): number {
    const at = Math.min(Math.max(fraction, 0), 1) * looks;
    const low = Math.min(Math.floor(at), looks - 1);
    const [before, after] = [this.#times[low], this.#times[low + 1]];
    return before + (at - low) * (after - before);
  }

  #mixFor({ u, v }: ReplayedLeaf): void {
    if (u === this.#u && v === this.#v) return;
    [this.#u, this.#v] = [u, v];
    this.#across = Array.from(u, (place) => mixAt(this.#turn.u, place));
    this.#up = Array.from(v, (place) => mixAt(this.#turn.v, place));
  }
}
