/**
 * The order of leaves. Those in flight are a run between the two piles, listed
 * from left to right, and none passes another: a leaf is picked up from the end
 * of the run at its pile, and one comes to rest only after those between it and
 * the pile.
 */

import { Side } from "../engine/phases.ts";

/** The range of spreads that a leaf, or a sheaf that flies as one, lies between. */
export interface Between {
  /** The spread visible when it lies on the right, and on the left. */
  readonly low: number;
  readonly high: number;
}

/** Returns the spreads left and right of everything in flight: both `spread` if nothing is. */
export function outermost(flights: readonly Between[], spread: number): Between {
  return {
    low: nextTo(Side.left, flights)?.low ?? spread,
    high: nextTo(Side.right, flights)?.high ?? spread,
  };
}

/** Returns the uppermost leaf of the pile on `side`, whether or not the book has it. */
export function uppermost(side: Side, flights: readonly Between[], spread: number): Between {
  const { low, high } = outermost(flights, spread);
  return side === Side.right ? { low: high, high: high + 1 } : { low: low - 1, high: low };
}

/** Returns the flight next to the pile on `side`, which lies over its pages. */
export function nextTo<Flight>(side: Side, flights: readonly Flight[]): Flight | undefined {
  return side === Side.right ? flights.at(-1) : flights[0];
}

/** Returns the flights with one more, picked up from `side`. */
export function withPickedUp<Flight>(
  side: Side,
  flights: readonly Flight[],
  flight: Flight,
): Flight[] {
  return side === Side.right ? [...flights, flight] : [flight, ...flights];
}

/** Returns the flights between one and the pile on `side`, which must land before it there. */
export function inWay<Flight>(side: Side, flights: readonly Flight[], flight: Flight): Flight[] {
  const at = flights.indexOf(flight);
  return side === Side.right ? flights.slice(at + 1) : flights.slice(0, at);
}

/** Returns flights in the order in which they land: on either side from the pile outward. */
export function landingOrder<Flight extends { readonly to: Side }>(
  flights: readonly Flight[],
): Flight[] {
  const left = flights.filter(({ to }) => to === Side.left);
  const right = flights.filter(({ to }) => to === Side.right);
  return [...left, ...right.reverse()];
}

/** Returns the side where a flight was picked up at the spread `from`. */
export function sideBefore({ from, low }: { readonly from: number } & Between): Side {
  return from === low ? Side.right : Side.left;
}
