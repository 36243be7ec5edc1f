/**
 * Validates numbers on their way into the engine. WASM takes any number: -1 as
 * a count is 4,294,967,295, and a NaN in a leaf stays there.
 */

import { maxGrabs } from "./phases.ts";

/** Returns a whole number from 0 to `most`; 0 for NaN. */
export function whole(value: number, most: number): number {
  return Math.floor(clamp(value || 0, 0, most));
}

/** Returns the ticks to step by: none for a time that went backwards, no more than a minute's. */
export function wholeTicks(ticks: number, tick: number): number {
  return whole(ticks, 60 / tick);
}

/** Returns the seconds of a turn, 0 to an hour; 1 for NaN. */
export function turnSeconds(seconds: number): number {
  return Number.isNaN(seconds) ? 1 : clamp(seconds, 0, 3600);
}

/** Returns whether `grab` is the number of a grab, and its numbers are finite. */
export function isGrab(grab: number, ...numbers: readonly number[]): boolean {
  return Number.isInteger(grab) && grab >= 0 && grab < maxGrabs && areFinite(numbers);
}

/** Returns whether all are numbers that single precision holds. */
export function areFinite(numbers: readonly number[]): boolean {
  return numbers.every((number) => Number.isFinite(Math.fround(number)));
}

/** Returns a value clamped to bounds; NaN stays NaN. */
export function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}
