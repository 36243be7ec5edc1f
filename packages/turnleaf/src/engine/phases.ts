/** How the engine counts sides, covers and hands, and what it says a leaf is doing. */

/** A side of the open book, as the engine counts them. */
export const Side = { right: 0, left: 1 } as const;
export type Side = (typeof Side)[keyof typeof Side];

/** What a leaf or a board is doing. */
export const Phase = {
  restingRight: 0,
  restingLeft: 1,
  held: 2,
  fallingRight: 3,
  fallingLeft: 4,
  playingRight: 5,
  playingLeft: 6,
  /** The leaf joined its pile: no flight of this number is left. */
  over: 7,
} as const;
export type Phase = (typeof Phase)[keyof typeof Phase];

/** Which cover board. */
export const Cover = { front: 0, back: 1 } as const;
export type Cover = (typeof Cover)[keyof typeof Cover];

/** Hands that a leaf tells apart, numbered from 0. */
export const maxGrabs: number = 4;

/** Whether a phase is one of rest. */
export function isResting(phase: Phase): boolean {
  return phase === Phase.restingRight || phase === Phase.restingLeft;
}

/** The side where a leaf or board rests or is bound for; null while a hand holds it, and once it is over. */
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
