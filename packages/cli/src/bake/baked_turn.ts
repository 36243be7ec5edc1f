/** A turn simulated from its beginning to its rest, and reduced to key frames. */

import { writeNormals } from "turnleaf/keyframes";
import { type LeafCrease, LooseLeaf, leafStocks, type PaperMesh } from "turnleaf/models";
import { Problem } from "../problem.ts";
import type { BakeCommand } from "./bake_arguments.ts";

/** Minimum of frames per second at which the turn is sampled: at whole steps of its model. */
const rate = 120;
/** Maximum time for the leaf to come to rest after its release, seconds. */
const patience = 4;
/**
 * Imperceptible motion from frame to frame, over the width; and the consecutive
 * frames below it that count as rest.
 */
const unseen = 2e-5;
const stillFrames = 12;

/** One moment of a turn. */
export interface Frame {
  /** Seconds since the start. */
  readonly time: number;
  /** x, y, z of each point, metres, row by row from the foot. */
  readonly positions: Float32Array;
}

/** A simulated turn. */
export interface Turn {
  readonly frames: Frame[];
  /** How the points lie on the flat paper if the leaf is creased. */
  readonly creased: PaperMesh | undefined;
}

/** Where the points are on the leaf: u of each column and v of each row. */
export interface Points {
  readonly u: Float32Array;
  readonly v: Float32Array;
}

/** Returns the points of a command. */
export function pointsOf({ points }: BakeCommand): Points {
  const even = (n: number) => Float32Array.from({ length: n }, (_, i) => i / (n - 1));
  return { u: even(points[0]), v: even(points[1]) };
}

/**
 * Simulates the turn, or the folds one after another, until the leaf is at rest.
 *
 * @param tell called with the progress: seconds, and an estimate of their total
 * @throws Problem if the model rejects the leaf
 */
export async function simulate(
  command: BakeCommand,
  tell: (seconds: number, about: number) => void,
  signal: AbortSignal,
): Promise<Turn> {
  const { model, gesture, stock, width, height, points, creases } = command;
  const isFolded = gesture === "fold";
  const seconds = command.seconds * (isFolded ? creases.length : 1);
  // Masses and springs as paper has them, drawn by as many points as any other model.
  const springs = { preset: "book", interpolate: true } as const;
  const options = { model, width, height, stock: leafStocks[stock], points, ...springs };
  const leaf = await LooseLeaf.create(options).catch((error: unknown) => {
    throw new Problem(error instanceof Error ? error.message : "The leaf could not be made.");
  });
  try {
    crease(leaf, isFolded ? creases.map((one) => ({ ...one, rest: 0 })) : creases);
    if (!isFolded) leaf.play(gesture, "right", seconds);
    const frames: Frame[] = [];
    const apart = leaf.timeStep * Math.max(Math.floor(1 / (rate * leaf.timeStep) + 1e-6), 1);
    let still = 0;
    for (let step = 0; still < stillFrames && step * apart <= seconds + patience; step++) {
      if (step > 0) {
        if (isFolded) fold(leaf, command, step * apart);
        leaf.advance(apart);
      }
      const { time } = leaf;
      leaf.update();
      const positions = leaf.surface().positions.slice();
      if (!positions.every(Number.isFinite)) throw new Problem("The leaf flew apart.");
      const last = frames.at(-1)?.positions ?? positions;
      const isStill = time > seconds && farthest(last, positions) < unseen * width;
      still = isStill ? still + 1 : 0;
      frames.push({ time, positions });
      tell(time, seconds + 1);
      // Lets Ctrl+C be handled.
      if (step % 30 === 0) await new Promise((resolve) => setImmediate(resolve));
      signal.throwIfAborted();
    }
    leaf.update();
    const { creased } = leaf.surface();
    return { frames: frames.slice(0, frames.length - Math.max(still - 1, 0)), creased };
  } finally {
    leaf.destroy();
  }
}

/** @throws Problem if the leaf cannot be creased so */
function crease(leaf: LooseLeaf, creases: readonly LeafCrease[]): void {
  if (creases.length === 0) return;
  try {
    leaf.crease(creases);
  } catch (error) {
    throw new Problem(error instanceof Error ? error.message : "The leaf cannot be creased so.");
  }
}

/** Turns the rest of each crease in its own time, one after another, with a soft start and end. */
function fold(leaf: LooseLeaf, { creases, seconds }: BakeCommand, time: number): void {
  for (const [k, { rest }] of creases.entries()) {
    const part = Math.min(Math.max(time / seconds - k, 0), 1);
    leaf.press(k, part * part * (3 - 2 * part) * rest);
  }
}

/**
 * Returns few frames between which the others lie on straight lines, within
 * `tolerance`, metres: from each the longest line that holds.
 */
export function keepFrames(frames: readonly Frame[], tolerance: number): Frame[] {
  const kept = frames.slice(0, 1);
  for (let from = 0; from < frames.length - 1; ) {
    let to = from + 1;
    while (to + 1 < frames.length && isStraight(frames, from, to + 1, tolerance)) to++;
    kept.push(frames[to] as Frame);
    from = to;
  }
  return kept;
}

function isStraight(frames: readonly Frame[], from: number, to: number, tolerance: number) {
  const ends = [frames[from] as Frame, frames[to] as Frame] as const;
  return frames
    .slice(from + 1, to)
    .every(({ time, positions }) => farthest(between(...ends, time), positions) <= tolerance);
}

/** Interpolates positions linearly between two frames. */
export function between(a: Frame, b: Frame, time: number): Float32Array {
  const fraction = (time - a.time) / (b.time - a.time);
  return a.positions.map((value, i) => value + fraction * ((b.positions[i] ?? 0) - value));
}

/** Returns the turn at a constant rate, from its first frame to its last. */
export function atRate(frames: readonly Frame[], fps: number): Frame[] {
  const end = frames.at(-1)?.time ?? 0;
  const steady: Frame[] = [];
  for (let at = 0, k = 0; k / fps < end + 0.5 / fps; k++) {
    const time = Math.min(k / fps, end);
    while (at + 2 < frames.length && (frames[at + 1]?.time ?? 0) <= time) at++;
    const [a, b] = [frames[at] as Frame, frames[at + 1] as Frame];
    steady.push({ time: k / fps, positions: between(a, b, time) });
  }
  return steady;
}

/** Returns the longest distance between points of two frames. */
export function farthest(a: Float32Array, b: Float32Array): number {
  let most = 0;
  for (let i = 0; i < a.length; i += 3) {
    const square = [0, 1, 2].reduce((sum, k) => sum + ((a[i + k] ?? 0) - (b[i + k] ?? 0)) ** 2, 0);
    most = Math.max(most, square);
  }
  return Math.sqrt(most);
}

/** Returns the unit normals of a frame, up where the leaf lies on the right. */
export function normalsOf({ u, v }: Points, positions: Float32Array): Float32Array {
  const normals = Float32Array.from(positions, (_, i) => (i % 3 === 2 ? 1 : 0));
  writeNormals(u.length, v.length, positions, normals);
  return normals;
}
