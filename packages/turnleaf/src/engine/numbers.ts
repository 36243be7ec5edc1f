/**
 * Numbers on their way into the engine. WASM takes whatever number it is given:
 * -1 as a count is 4,294,967,295, and NaN in a leaf stays there.
 */

import { maxGrabs } from "./phases.ts";

/** A whole number from 0 to `most`; 0 for NaN. */
export function whole(value: number, most: number): number {
  return Math.floor(clamp(value || 0, 0, most));
}

/** Ticks to step by: none for a time that went backwards, no more than a minute's. */
export function wholeTicks(ticks: number, tick: number): number {
  return whole(ticks, 60 / tick);
}

/** Seconds of a turn, 0 to an hour; 1 for NaN. */
export function turnSeconds(seconds: number): number {
  return Number.isNaN(seconds) ? 1 : clamp(seconds, 0, 3600);
}

/** Whether a hand is one that a leaf tells apart, and its numbers are numbers. */
export function isHand(hand: number, ...numbers: readonly number[]): boolean {
  return Number.isInteger(hand) && hand >= 0 && hand < maxGrabs && areFinite(numbers);
}

/** Whether all are numbers that single precision holds. */
export function areFinite(numbers: readonly number[]): boolean {
  return numbers.every((number) => Number.isFinite(Math.fround(number)));
}

/** A value kept within bounds; NaN stays NaN. */
export function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}
