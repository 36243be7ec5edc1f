import { models } from "../model_names.ts";
import type { PaperMesh } from "../paper_mesh.ts";
import { BitWriter, costOf } from "./bits.ts";
import { blend, mixAt } from "./blend.ts";
import {
  checksum,
  expected,
  meshHeader,
  mostAlong,
  mostMultiple,
  mostPoints,
  mostQuantum,
  packedHeader,
} from "./file.ts";
import { packMesh, requireMesh } from "./packed_mesh.ts";
import { PolynomialBasis } from "./polynomial_basis.ts";
import type { TurnRecord } from "./recorded_turn.ts";

/** The leaf that is recorded. */
export interface RecordedLeaf {
  /** Metres. */
  readonly width: number;
  readonly height: number;
  /** u of each column of points and v of each row, rising from 0 to 1; 256 at most. */
  readonly u: ArrayLike<number>;
  readonly v: ArrayLike<number>;
  /** The model that moves it. The default is "sheet". */
  readonly model?: TurnRecord["model"];
  /** How the points lie on the flat paper if the leaf is creased: the same in every frame. */
  readonly creased?: PaperMesh | undefined;
}

/** A turn in a file. */
export interface TurnFile {
  /** The bytes for `decodeTurn`. */
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Maximum distance of a replay from the recording, over the width. */
  readonly error: number;
  /** Number of key frames kept. */
  readonly frames: number;
}

/** The fraction of the tolerance for rounding; the rest is the blend's. */
const rounding = 0.4;

/** Returns the coarsest quantum that is tried for points that may be so far off, metres. */
const firstQuantum = (most: number): number => Math.fround(4 * most);

/**
 * Records a turn frame by frame, from any source, and keeps what a replay
 * needs.
 *
 * ```ts
 * const recorder = new TurnRecorder({ width: 0.14, height: 0.21, u, v });
 * recorder.add(time, surface.positions); // for every frame
 * const { bytes, error } = recorder.finish();
 * ```
 */
export class TurnRecorder {
  private readonly leaf: RecordedLeaf;
  private readonly u: Float32Array;
  private readonly v: Float32Array;
  private readonly basis: PolynomialBasis;
  private readonly times: number[] = [];
  private readonly frames: Float32Array[] = [];

  /** @throws RangeError if the size, `u`, `v` or the mesh are invalid */
  constructor(leaf: RecordedLeaf) {
    this.leaf = leaf;
    this.u = placesOf(leaf.u);
    this.v = placesOf(leaf.v);
    if (!(leaf.width > 0 && leaf.height > 0 && leaf.width < 1e6 && leaf.height < 1e6)) {
      throw new RangeError("A leaf's width and height are above 0.");
    }
    if (leaf.creased) requireMesh(leaf.creased, this.u.length, this.v.length);
    this.basis = new PolynomialBasis(this.u, this.v);
  }

  /**
   * Adds a frame: x, y, z of each point, metres, row by row from the foot. It
   * is copied.
   *
   * @param time seconds, after that of the frame before
   * @throws RangeError if it is not, or if the positions are not a frame's
   * numbers
   */
  add(time: number, positions: ArrayLike<number>): void {
    const last = this.times.at(-1);
    // As stored in the file: two frames must not coincide.
    const at = Math.fround(time);
    if (!Number.isFinite(at) || (last !== undefined && at <= last)) {
      throw new RangeError("A frame is recorded after the one before.");
    }
    const length = 3 * this.u.length * this.v.length;
    const frame = Float32Array.from(positions);
    if (frame.length !== length || !frame.every(Number.isFinite)) {
      throw new RangeError(`A frame of this leaf is ${length} finite numbers.`);
    }
    if ((this.times.length + 1) * (length / 3) > mostPoints) {
      throw new RangeError("The recording is too long; end it.");
    }
    this.times.push(at);
    this.frames.push(frame);
  }

  /**
   * Ends the recording.
   *
   * @param tolerance maximum distance of a replay from it, over the width
   * @throws RangeError if nothing was recorded, or the tolerance is too small
   * for it or so large that no file has it
   */
  finish(tolerance = 0.001): TurnFile {
    if (this.times.length === 0) throw new RangeError("Nothing was recorded.");
    if (!(tolerance > 0)) throw new RangeError("The tolerance is above 0.");
    // In single precision, as the engine's encoder has it.
    const most = Math.fround(Math.fround(tolerance) * Math.fround(this.leaf.width));
    if (!(firstQuantum(most) < mostQuantum)) throw new RangeError("The tolerance is too large.");
    const { quantum, multiples, rounded } = this.round(most);
    const { keys, error } = chooseKeys(this.times, this.frames, rounded, most);
    const kept = keys.flatMap((key) => multiples.slice(3 * key, 3 * key + 3));
    const times = keys.map((key) => this.times[key]);
    const bytes = this.write(times, kept, quantum, error / this.leaf.width);
    return { bytes, error: error / this.leaf.width, frames: keys.length };
  }

  /** Finds the coarsest quantum whose rounding moves no point farther than allowed. */
  private round(most: number) {
    const length = 3 * this.u.length * this.v.length;
    const coefficients = this.frames.flatMap((frame) =>
      [0, 1, 2].map((axis) => this.basis.coefficients(frame, axis)),
    );
    const rounded = new Float32Array(length * this.frames.length);
    for (let quantum = firstQuantum(most); ; quantum = Math.fround(Math.fround(0.8) * quantum)) {
      const multiples = coefficients.map((axis) =>
        Int32Array.from(axis, (coefficient) => Math.round(coefficient / quantum)),
      );
      const isTooFine = coefficients.some((axis) =>
        axis.some((coefficient) => !(Math.abs(coefficient / quantum) <= mostMultiple)),
      );
      if (isTooFine) throw new RangeError("The tolerance is too fine for this leaf.");
      const isNear = this.frames.every((frame, at) => {
        const here = rounded.subarray(at * length, (at + 1) * length);
        for (let axis = 0; axis < 3; axis++) {
          const whole = Float64Array.from(multiples[3 * at + axis], (m) => m * quantum);
          this.basis.write(whole, here, axis);
        }
        return farthest(here, frame) <= rounding * most;
      });
      if (isNear) return { quantum, multiples, rounded };
    }
  }

  private write(
    times: readonly number[],
    multiples: readonly Int32Array[],
    quantum: number,
    error: number,
  ) {
    const { width, height, model = "sheet", creased } = this.leaf;
    const packed = pack(multiples, times, this.basis.order);
    const mesh = creased ? packMesh(creased, this.u, this.v) : new Uint8Array();
    const reals = [...this.u, ...this.v, ...times];
    const header = creased ? meshHeader : packedHeader;
    const end = header + 4 * reals.length + mesh.length + packed.length;
    const bytes = new Uint8Array(end + 8);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, 0x544c4b46);
    view.setUint16(4, creased ? 3 : 2, true);
    view.setUint16(6, 1, true);
    view.setUint32(8, models.indexOf(model) + 1, true);
    view.setFloat32(16, width, true);
    view.setFloat32(20, height, true);
    const counts = [this.u.length, this.v.length, times.length];
    for (const [i, count] of counts.entries()) view.setUint32(24 + 4 * i, count, true);
    view.setFloat32(36, quantum, true);
    view.setFloat32(40, error, true);
    view.setUint32(44, packed.length, true);
    if (creased) {
      view.setUint32(48, creased.parts.length, true);
      view.setUint32(52, mesh.length, true);
    }
    for (const [i, real] of reals.entries()) view.setFloat32(header + 4 * i, real, true);
    bytes.set(mesh, header + 4 * reals.length);
    bytes.set(packed, end - packed.length);
    bytes.set(checksum(bytes.subarray(0, end)), end);
    return bytes;
  }
}

function placesOf(places: ArrayLike<number>): Float32Array {
  const all = Float32Array.from(places);
  const rise = all.every((place, i) => i === 0 || place > all[i - 1]);
  if (all.length < 2 || all.length > mostAlong || !rise || all[0] !== 0 || all.at(-1) !== 1) {
    throw new RangeError(`u and v are 2 to ${mostAlong} numbers that rise from 0 to 1.`);
  }
  return all;
}

function pack(
  multiples: readonly Int32Array[],
  times: readonly number[],
  order: Uint32Array,
): Uint8Array {
  const writer = new BitWriter();
  for (const [at, own] of multiples.entries()) {
    const before = [multiples[at - 3], multiples[at - 6]] as const;
    const frame = Math.floor(at / 3);
    const ways = [0, 1, 2].slice(0, Math.min(frame, 2) + 1).map((way) => {
      const rest = Int32Array.from(
        order,
        (place) => own[place] - expected(before, times, frame, way, place),
      );
      return { way, rest, cost: costOf(rest) };
    });
    const best = ways.reduce((a, b) => (b.cost < a.cost ? b : a));
    writer.bits(best.way, 2);
    writer.run(best.rest);
  }
  return writer.bytes;
}

/**
 * Returns the frames to keep, rising, so that a blend of their rounded
 * positions is nowhere farther from the recording than `tolerance`, metres; and
 * its maximum distance.
 */
function chooseKeys(
  times: readonly number[],
  frames: readonly Float32Array[],
  rounded: Float32Array,
  tolerance: number,
): { keys: number[]; error: number } {
  const last = times.length - 1;
  const length = frames[0].length;
  let keys = last === 0 ? [0] : [0, last];
  let errors = new Float64Array(times.length);
  const blended = new Float32Array(length);
  const measure = (from: number, to: number): void => {
    const keyTimes = keys.map((key) => times[key]);
    for (let at = from; at <= to; at++) {
      const { frame, weight } = mixAt(keyTimes, times[at]);
      const [a, b, c, d] = frame.map((key) => keys[key]);
      blend({ frame: [a, b, c, d], weight }, rounded, blended);
      errors[at] = farthest(blended, frames[at]);
    }
  };
  // A tangent reaches two keys away.
  const measureAbout = (at: number): void =>
    measure(keys[Math.max(at - 2, 0)], keys[Math.min(at + 2, keys.length - 1)]);
  measure(0, last);
  for (
    let worst = worstOf(errors, keys);
    errors[worst] > tolerance;
    worst = worstOf(errors, keys)
  ) {
    const at = keys.findIndex((key) => key > worst);
    keys.splice(at, 0, worst);
    measureAbout(at);
  }
  for (let at = 1; at + 1 < keys.length; ) {
    const [keysBefore, errorsBefore] = [[...keys], errors.slice()];
    keys.splice(at, 1);
    measureAbout(at);
    if (errors.every((error) => error <= tolerance)) continue;
    [keys, errors] = [keysBefore, errorsBefore];
    at++;
  }
  return { keys, error: Math.max(...errors) };
}

/** Returns the frame with the largest error that is not kept yet; a kept one if all are. */
function worstOf(errors: Float64Array, keys: readonly number[]): number {
  const kept = new Set(keys);
  let worst = keys[0];
  for (let at = 0; at < errors.length; at++) {
    if (!kept.has(at) && (kept.has(worst) || errors[at] > errors[worst])) worst = at;
  }
  return worst;
}

/** Returns the longest distance between points of two frames. */
function farthest(a: Float32Array, b: Float32Array): number {
  let most = 0;
  for (let i = 0; i < a.length; i += 3) {
    const [x, y, z] = [a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]];
    most = Math.max(most, x * x + y * y + z * z);
  }
  return Math.sqrt(most);
}
