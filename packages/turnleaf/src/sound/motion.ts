/**
 * The audible motion of a book: how fast its leaves bend, and how hard they and
 * the boards land.
 */

import type { Surface } from "../engine/shapes.ts";
import type { BookPose } from "../stage/book_pose.ts";

/** Points along a row and along the spine at which a leaf is sampled. */
const places = 5;

/** Points that sink slower than this make no sound when they are stopped, m/s. */
const leastFall = 0.15;

/** How loud a book's motion would be. */
export interface Motion {
  /** Bending speed of the leaves in flight, summed: radians a second between neighbouring places. */
  readonly bending: number;
  /** Speed that falling paper and boards lost in this frame, m/s: their impact. */
  readonly impact: number;
  /** Work done in tearing, J a second. */
  readonly tearing: number;
}

/** The state kept of a leaf: for each place its normal, its height and its vertical speed. */
type LeafSamples = Float32Array;
const each = 5;

/** Follows a book from frame to frame. */
export class MotionMeter {
  /** By where a leaf lies in the engine's memory. */
  #leaves = new Map<Float32Array, LeafSamples>();
  #boards: number[] = [];
  #swing: number[] = [];

  /**
   * Returns the motion since the previous frame, `seconds` ago. A leaf that was
   * not there then is silent yet.
   *
   * @param work done in tearing since then, J
   */
  measure(pose: BookPose, seconds: number, work = 0): Motion {
    if (!(seconds > 0)) return { bending: 0, impact: 0, tearing: 0 };
    let [bending, impact] = [0, 0];
    const leaves = new Map<Float32Array, LeafSamples>();
    for (const leaf of pose.leaves) {
      const before = this.#leaves.get(leaf.positions);
      const now = sample(leaf, before, seconds);
      leaves.set(leaf.positions, now);
      if (before === undefined) continue;
      bending += bendingBetween(before, now) / seconds;
      impact += impactBetween(before, now);
    }
    this.#leaves = leaves;
    const boards = [pose.frontBoard, pose.backBoard];
    const swing = boards.map((angle, k) => (angle - (this.#boards[k] ?? angle)) / seconds);
    for (const [k, speed] of swing.entries()) {
      const lost = Math.abs(this.#swing[k] ?? 0) - Math.abs(speed);
      // A board that stops within a frame has hit what it falls on; its edge is some 15 cm out.
      if (speed === 0 && lost > 0) impact += 0.15 * lost;
    }
    this.#boards = boards;
    this.#swing = swing;
    return { bending, impact, tearing: work / seconds };
  }
}

function sample(leaf: Surface, before: LeafSamples | undefined, seconds: number): LeafSamples {
  const kept = new Float32Array(each * places * places);
  for (let j = 0; j < places; j++) {
    const row = Math.round((j * (leaf.rows - 1)) / (places - 1));
    for (let i = 0; i < places; i++) {
      const column = Math.round((i * (leaf.columns - 1)) / (places - 1));
      const from = 3 * (row * leaf.columns + column);
      const to = each * (j * places + i);
      for (let axis = 0; axis < 3; axis++) kept[to + axis] = leaf.normals[from + axis];
      kept[to + 3] = leaf.positions[from + 2];
      kept[to + 4] = before ? (kept[to + 3] - before[to + 3]) / seconds : 0;
    }
  }
  return kept;
}

/**
 * Returns the mean change of the angles between neighbouring places of a row,
 * radians: 0 for a leaf that turns stiffly.
 */
function bendingBetween(before: LeafSamples, now: LeafSamples): number {
  let sum = 0;
  for (let at = 0; at + each < now.length; at += each) {
    if ((at / each + 1) % places === 0) continue;
    // Leaves of a flat book have no normals: they are heard only as they land.
    sum += Math.abs(angle(now, at) - angle(before, at)) || 0;
  }
  return sum / (places * (places - 1));
}

function angle(kept: LeafSamples, at: number): number {
  const next = at + each;
  const across = Math.hypot(
    kept[at] - kept[next],
    kept[at + 1] - kept[next + 1],
    kept[at + 2] - kept[next + 2],
  );
  return 2 * Math.asin(Math.min(across / 2, 1));
}

/** Returns the mean speed that sinking places lost. */
function impactBetween(before: LeafSamples, now: LeafSamples): number {
  let sum = 0;
  for (let at = 4; at < now.length; at += each) {
    if (before[at] < -leastFall) sum += Math.max(now[at] - before[at], 0);
  }
  return sum / (places * places);
}
