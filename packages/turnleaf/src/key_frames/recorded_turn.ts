import type { Model } from "../model_names.ts";
import type { PaperMesh } from "../paper_mesh.ts";
import { blend, mixAt } from "./blend.ts";

/** The contents of a recording. */
export interface TurnRecord {
  /** Columns of points, from the spine, and rows, from the foot: u and v of each, from 0 to 1. */
  readonly u: Float32Array;
  readonly v: Float32Array;
  /** Size of the leaf, metres. */
  readonly width: number;
  readonly height: number;
  /** The model that was recorded. */
  readonly model: Model;
  /** Maximum distance of the replay from the original, over the width; NaN if unknown. */
  readonly error: number;
  /** Times of the key frames, seconds since the start. */
  readonly times: Float32Array;
  /** Frame after frame x, y, z of each point, metres, row by row from the foot. */
  readonly positions: Float32Array;
  /** How the points lie on the flat paper if the leaf is creased. */
  readonly creased?: PaperMesh | undefined;
}

/** How a recording is played. */
interface Playback {
  readonly pace: number;
  readonly isBackward: boolean;
  readonly isMirrored: boolean;
  readonly scale: number;
}

/** Sizes whose ratios differ by less than this count as one ratio. */
const sameRatio = 0.005;

/**
 * A recorded turn, which can be played on any page of its ratio, by any number
 * of pages at once: playing changes nothing in it. The results of `reversed`
 * and the like use the same frames.
 *
 * x across the spine to the right, y along it to the head, z up from the table.
 */
export class RecordedTurn {
  private readonly record: TurnRecord;
  private readonly way: Playback;
  private readonly first: number;
  private readonly length: number;

  /** @internal */
  constructor(
    record: TurnRecord,
    way: Playback = { pace: 1, isBackward: false, isMirrored: false, scale: 1 },
  ) {
    this.record = record;
    this.way = way;
    const { times } = record;
    this.first = times[0];
    this.length = times[times.length - 1] - times[0];
  }

  /** Columns of points, from the spine. */
  get columns(): number {
    return this.record.u.length;
  }

  /** Rows of points, from the foot. */
  get rows(): number {
    return this.record.v.length;
  }

  /** u of each column, from 0 at the spine to 1. */
  get u(): Float32Array {
    return this.record.u;
  }

  /** v of each row, from 0 at the foot to 1. */
  get v(): Float32Array {
    return this.record.v;
  }

  /**
   * How the points lie on the flat paper and hang together if the leaf is creased; undefined if
   * it is a grid's at `u` and `v`. `splitMesh` returns the vertices to be drawn of it.
   */
  get creased(): PaperMesh | undefined {
    return this.record.creased;
  }

  /** Width of the leaf, metres. */
  get width(): number {
    return this.record.width * this.way.scale;
  }

  /** Height of the leaf, metres. */
  get height(): number {
    return this.record.height * this.way.scale;
  }

  /** The model that was recorded. */
  get model(): TurnRecord["model"] {
    return this.record.model;
  }

  /** Maximum distance of the replay from the original, over the width; NaN if unknown. */
  get error(): number {
    return this.record.error;
  }

  /** Number of key frames. */
  get frames(): number {
    return this.record.times.length;
  }

  /** Its duration, seconds. */
  get duration(): number {
    return this.length / this.way.pace;
  }

  /** Times of the key frames, seconds from 0 to the duration. */
  get times(): Float64Array {
    const { isBackward, pace } = this.way;
    const times = Float64Array.from(this.record.times, (time) =>
      isBackward ? this.length - (time - this.first) : time - this.first,
    );
    return (isBackward ? times.reverse() : times).map((time) => time / pace);
  }

  /**
   * Writes x, y, z of every point at a time in seconds, metres, row by row from
   * the foot. Before 0 and after the duration the leaf lies as at these.
   *
   * @param out of 3 * columns * rows floats
   * @throws RangeError if it has another length
   */
  sample(time: number, out: Float32Array): void {
    const { times, positions } = this.record;
    const { isBackward, isMirrored, pace, scale } = this.way;
    if (out.length !== 3 * this.columns * this.rows) {
      throw new RangeError(`A frame of this turn takes ${3 * this.columns * this.rows} floats.`);
    }
    const passed = Math.min(Math.max(time * pace, 0), this.length) || 0;
    const at = this.first + (isBackward ? this.length - passed : passed);
    blend(mixAt(times, at), positions, out);
    if (scale !== 1) for (let i = 0; i < out.length; i++) out[i] *= scale;
    if (isMirrored) for (let i = 0; i < out.length; i += 3) out[i] = -out[i];
  }

  /** Returns the same turn from its end to its beginning. */
  reversed(): RecordedTurn {
    return this.variant({ isBackward: !this.way.isBackward });
  }

  /**
   * Returns the same turn mirrored in the spine: from left to right if it went
   * from right to left.
   */
  mirrored(): RecordedTurn {
    return this.variant({ isMirrored: !this.way.isMirrored });
  }

  /**
   * Returns the same turn in less time.
   *
   * @param factor 2 for twice as fast, 0.5 for half
   * @throws RangeError unless it is above 0
   */
  faster(factor: number): RecordedTurn {
    if (!(factor > 0 && factor < Number.POSITIVE_INFINITY)) {
      throw new RangeError("A turn is played faster by a factor above 0.");
    }
    return this.variant({ pace: this.way.pace * factor });
  }

  /**
   * Returns the same turn of a leaf of another size, metres.
   *
   * @throws RangeError if that has another ratio: paper that long would bend
   * otherwise
   */
  scaled(width: number, height: number): RecordedTurn {
    const ratio = (width * this.height) / (height * this.width);
    if (!(width > 0 && Math.abs(ratio - 1) < sameRatio)) {
      const own = `${this.width.toFixed(3)} x ${this.height.toFixed(3)} m`;
      throw new RangeError(
        `This turn is of a leaf of ${own}; a leaf of another ratio needs another recording.`,
      );
    }
    return this.variant({ scale: (this.way.scale * width) / this.width });
  }

  private variant(way: Partial<Playback>): RecordedTurn {
    return new RecordedTurn(this.record, { ...this.way, ...way });
  }
}

/**
 * Writes smooth unit normals of a surface, on the side that is up where the
 * leaf lies on the right: cross products of the differences along u and v.
 * Points whose neighbours coincide keep their values in `normals`.
 */
export function writeNormals(
  columns: number,
  rows: number,
  positions: Float32Array,
  normals: Float32Array,
): void {
  for (let row = 0; row < rows; row++) {
    const below = row > 0 ? -3 * columns : 0;
    const above = row < rows - 1 ? 3 * columns : 0;
    for (let column = 0; column < columns; column++) {
      const at = 3 * (row * columns + column);
      const left = column > 0 ? at - 3 : at;
      const right = column < columns - 1 ? at + 3 : at;
      // Unrolled: this runs for every point of every frame.
      const ux = positions[right] - positions[left];
      const uy = positions[right + 1] - positions[left + 1];
      const uz = positions[right + 2] - positions[left + 2];
      const vx = positions[at + above] - positions[at + below];
      const vy = positions[at + above + 1] - positions[at + below + 1];
      const vz = positions[at + above + 2] - positions[at + below + 2];
      const x = uy * vz - uz * vy;
      const y = uz * vx - ux * vz;
      const z = ux * vy - uy * vx;
      const length = Math.sqrt(x * x + y * y + z * z);
      if (!(length > 0)) continue;
      normals[at] = x / length;
      normals[at + 1] = y / length;
      normals[at + 2] = z / length;
    }
  }
}
