/** The engine's numbers for sides, covers and phases of a leaf. */

/** A side of the open book, as the engine numbers them. */
export const Side = { right: 0, left: 1 } as const;
export type Side = (typeof Side)[keyof typeof Side];

/** The phase of a leaf or a board. */
export const Phase = {
  restingRight: 0,
  restingLeft: 1,
  held: 2,
  fallingRight: 3,
  fallingLeft: 4,
  playingRight: 5,
  playingLeft: 6,
  /** The leaf has joined its pile: no flight of this number is left. */
  over: 7,
} as const;
export type Phase = (typeof Phase)[keyof typeof Phase];

/** Which cover board. */
export const Cover = { front: 0, back: 1 } as const;
export type Cover = (typeof Cover)[keyof typeof Cover];

/** Number of grabs on a leaf; they are numbered from 0. */
export const maxGrabs: number = 4;

/** Returns whether a phase is one of rest. */
export function isResting(phase: Phase): boolean {
  return phase === Phase.restingRight || phase === Phase.restingLeft;
}

/**
 * Returns the side where a leaf or board rests or is bound for; null while it
 * is held, and once it is over.
 */
export function sideOf(phase: Phase): Side | null {
  switch (phase) {
    case Phase.restingRight:
    case Phase.fallingRight:
    case Phase.playingRight:
      return Side.right;
    case Phase.restingLeft:
    case Phase.fallingLeft:
    case Phase.playingLeft:
      return Side.left;
    default:
      return null;
  }
}
